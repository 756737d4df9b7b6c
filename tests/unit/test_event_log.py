"""The event log on records made by hand; no kernel."""

from types import SimpleNamespace

import numpy as np
import pytest

from kaidan.contact import BELLY, FLIPPER, Event
from kaidan.traversal.event_log import event_log, place_of

NOSINGS = np.array([(0.0, 0.1), (0.3, 0.2), (0.6, 0.3), (1.6, 0.4)])  # a landing behind the third
CORNERS = np.array([
    (-3.0, 0.0), (0.0, 0.0), (0.0, 0.1), (0.3, 0.1), (0.3, 0.2), (0.6, 0.2), (0.6, 0.3),
    (1.6, 0.3), (1.6, 0.4), (4.0, 0.4),
])  # fmt: skip
POINT, PART = 64, 4
NOSING_1, NOSING_2, CORNER_2 = 2 * POINT, 4 * POINT, 3 * POINT
PARTS = [[-0.2, 0, 0.1, 0.2, 0, 0.1], [-0.1, 0, 0.1, 0.5, 0, 0.05], [-0.5, 0, 0.1, 0.3, 0, 0.05]]


def record(kind, feature=NOSING_1, other=NOSING_2, rotation=None, topples=None):
    return SimpleNamespace(
        kind=kind, feature=feature, other_feature=other, phase=SimpleNamespace(value="enter"),
        path=1.5, inclination=0.25, rotation=rotation, topples_with_momentum=topples,
    )  # fmt: skip


def made(*events, descending=False, nosings=NOSINGS):
    mirror = np.array([-1.0 if descending else 1.0, 1.0])
    corners = CORNERS * mirror
    return SimpleNamespace(
        events=events, descending=descending,
        path=SimpleNamespace(
            ground=SimpleNamespace(points=corners[::-1] if descending else corners)
        ),
        profile=SimpleNamespace(nosings=nosings * mirror),
        outline=SimpleNamespace(
            kinds=[0, FLIPPER, FLIPPER, BELLY], parts=np.array([*PARTS, PARTS[0]]),
            stance=SimpleNamespace(flat_length=0.4),
        ),
    )  # fmt: skip


def entries(*events, leading="nose"):
    return event_log(made(*events), leading)


@pytest.mark.parametrize(
    ("kind", "leading", "told"),
    [
        (Event.REACHED, "nose", ("reached", None, [1])),
        (Event.LEFT, "nose", ("left", None, [1])),
        (Event.MADE, "nose", ("passes", None, [1, 2])),
        (Event.LOST, "nose", ("passes", None, [1, 2])),
        (Event.TAIL_RESTS, "nose", ("rests", "tail", [1, 2])),
        (Event.TAIL_RESTS, "tail", ("rests", "nose", [1, 2])),
        (Event.FELL_FORWARD, "nose", ("falls", "nose", [1])),
        (Event.FELL_BACKWARD, "nose", ("falls", "tail", [1])),
        (Event.FELL_BACKWARD, "tail", ("falls", "nose", [1])),
        (Event.STUCK, "nose", ("stuck", None, [1])),
        (Event.ARRIVED, "nose", ("arrives", None, [])),
        (Event.NOSE_DROPS, "nose", ("resettled", None, [1])),
    ],
)
def test_what_one_event_is(kind, leading, told):
    (one,) = entries(record(kind), leading=leading)
    assert (one.kind, one.end, [each.number for each in one.places]) == told
    assert (one.phase, one.path, one.inclination, one.rotation) == ("enter", 1.5, 0.25, 0.0)
    assert one.topples_with_momentum is False
    assert one.step == (told[2][0] if told[2] else None)


@pytest.mark.parametrize(
    ("begins", "kind", "number"), [(Event.NOSE_DROPS, "drops", 2), (Event.TIPS_BACK, "rises", 1)]
)
def test_a_rotation_and_its_end_are_one_entry(begins, kind, number):
    # nose down the new contact is the other one, nose up it is the feature itself
    end = record(Event.ARRESTED, rotation=0.5, topples=True)
    one, after = entries(record(begins, CORNER_2), end, record(Event.LEFT))
    assert (one.kind, one.end, one.rotation, one.topples_with_momentum) == (kind, "nose", 0.5, True)
    assert [each.what for each in one.places] == ["nosing", "corner of step"]
    assert one.places[0].number == number
    assert after.kind == "left"


@pytest.mark.parametrize("first", [Event.MADE, Event.TAIL_RESTS])
def test_a_contact_made_as_another_is_lost_is_one_entry(first):
    assert len(entries(record(first), record(Event.LOST))) == 1
    assert len(entries(record(first), record(Event.MADE))) == 2
    assert len(entries(record(Event.REACHED), record(Event.LOST))) == 2
    assert len(entries(record(Event.LOST), record(Event.ARRESTED))) == 2
    assert len(entries(record(first))) == 1


@pytest.mark.parametrize("descending", [False, True])
@pytest.mark.parametrize(
    ("corner", "disc", "what", "number"),
    [
        (4, 0, "nosing", 2),
        (3, 0, "corner of step", 2),
        (3, 1, "riser", 2),
        (1, 2, "riser", 1),
        (0, 1, "the lower landing", None),
        (2, 1, "tread", 1),
        (4, 1, "tread", 2),
        (6, 1, "the landing behind step", 3),
        (8, 1, "the upper landing", None),
    ],
)
def test_what_a_feature_is_on_these_stairs(corner, disc, what, number, descending):
    if descending:  # the ground of the path is the mirror image, its segments begin at the top
        corner = len(CORNERS) - 1 - corner - (1 if disc else 0)
    place = place_of(made(descending=descending), POINT * corner + disc, "nose")
    assert (place.what, place.number, place.part) == (what, number, "track")


def test_parts_of_the_robot_and_a_floor():
    names = [place_of(made(), NOSING_1 + PART * part, "nose").part for part in range(4)]
    assert names == ["track", "front flipper", "rear flipper", "belly"]
    assert place_of(made(), NOSING_1 + PART, "tail").part == "rear flipper"
    assert place_of(made(), NOSING_1 + 2 * PART, "tail").part == "front flipper"
    floor = made(nosings=np.empty((0, 2)))
    assert place_of(floor, POINT * 8 + 1, "nose").what == "ground"
