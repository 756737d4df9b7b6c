"""Changes of posture of poses made by hand: what counts on the way, and which postures it takes."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import Robot, contact
from kaidan.contact import Placement
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.modes import Phase
from kaidan.outline import Outline
from kaidan.robot import Posture
from kaidan.traversal import moves
from kaidan.traversal.moves import SNAP, TURN, Move, move

ABSOLEM = Robot.named("absolem")


class Given(Move):
    """A change of which the poses' torques are given, not worked out."""

    @property
    def poses(self):
        return self.path.torques


def made(*, x=(), z=(), rear=(), front=(), energy=(), torques=(), postures=None):
    points = [np.reshape(np.array(each, dtype=float), (-1, 2)) for each in (rear, front)]
    path = SimpleNamespace(
        x=np.array(x), z=np.array(z), margins=SimpleNamespace(energy=np.array(energy)),
        poses=SimpleNamespace(rear_point=points[0], front_point=points[1]),
        torques=[SimpleNamespace(torque=each) for each in torques],
    )  # fmt: skip
    return Given(
        robot=ABSOLEM, facing="nose-first", before=Phase.LAND, turn=0.0, seconds=None,
        postures=(Posture(),) * (len(x) if postures is None else postures), outlines=(), path=path,
        rocks=0.0,
    )  # fmt: skip


def test_of_the_poses_on_the_way_the_least_energy_and_the_largest_torque_count():
    found = made(energy=[0.3, 0.1, 0.2], torques=[{"front": 4.0, "rear": 9.0}, {"front": 6.0}])
    assert found.energy == 0.1
    assert found.torque == 9.0
    assert made().energy == math.inf
    assert math.isnan(made().torque)


def test_the_tilt_on_the_way_is_that_about_the_outermost_contact():
    """By hand: contacts 0.1 m high, the centroid 0.3 to 0.5 m above them and 0.1 m nearer."""
    x, z = [0.0, 0.1, 0.0], [0.5, 0.5, 0.4]
    found = made(x=x, z=z, rear=[(-0.3, 0.1)] * 3, front=[(0.4, 0.1)] * 3)
    assert found.tilt(1.0) == math.inf  # the least at its end
    assert found.tilt(-1.0) == pytest.approx(math.atan2(0.3, 0.4))
    assert made(x=x[::2], z=z[::2], rear=[(-0.3, 0.1)] * 2, postures=2).tilt(1.0) == math.inf
    # it stood in three of four postures
    short = made(x=x, z=z, rear=[(-0.3, 0.1)] * 3, front=[(0.4, 0.1)] * 3, postures=4)
    assert short.tilt(-1.0) == math.inf


@pytest.mark.parametrize(("fastest", "seconds"), [((1.0, 0.25), 0.4), ((0.25, 1.0), 1.2),
                                                  ((1.0, None), None)])  # fmt: skip
def test_all_flippers_turn_together_until_the_farthest_is_there(fastest, seconds, monkeypatch):
    """The front pair by 0.3 rad, the rear one by 0.1; each pose at most 5 deg after another."""
    pairs = {
        f"{end}_flippers": getattr(ABSOLEM, f"{end}_flippers").model_copy(
            update={"max_speed": most}
        )
        for end, most in zip(("front", "rear"), fastest, strict=True)
    }
    inclinations = [0.0, 0.02, 0.02 - 0.01 - SNAP * TURN, 0.01]

    def stand_in_turn(ground, parts, kinds, x, inclination):
        assert (x, inclination) == (0.2, 0.01)
        return SimpleNamespace(inclination=np.array(inclinations), poses=parts)

    monkeypatch.setattr(contact, "stand_in_turn", stand_in_turn)
    found = move(
        ABSOLEM.model_copy(update=pairs), Posture(front=0.0, rear=0.1),
        Posture(front=0.3, rear=0.2), before=Phase.LAND, start=Placement(0.2, 0.0, 0.01),
        ground=np.zeros((2, 2)),
    )  # fmt: skip
    assert found.turn == pytest.approx(0.3)
    count = math.ceil(0.3 / TURN)
    assert [each.front for each in found.postures] == pytest.approx(np.linspace(0, 0.3, count + 1))
    assert [each.rear for each in found.postures] == pytest.approx(np.linspace(0.1, 0.2, count + 1))
    assert found.seconds == (None if seconds is None else pytest.approx(seconds))
    # from 0.02 rad to 0.01 rad less than what a flipper's turn allows, once
    assert found.rocks == pytest.approx(0.01)


@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
def test_the_torque_of_a_contact_that_pulls_and_pushes_on_a_slope(facing, monkeypatch):
    """Moments in complex numbers: the force at the tip about the pivot, and its own weight."""
    phi, load, pull = 0.3, 40.0, -15.0
    posture = Posture(front=0.4, rear=-0.2)
    outline = Outline.of(ABSOLEM, posture)
    outline = outline if facing == "nose-first" else outline.turned_round()
    place = Placement(0.7, 0.5, phi)
    flippers = [k for k, kind in enumerate(outline.kinds) if kind == contact.FLIPPER]
    row = flippers[1]  # the rear pair comes first, whichever end leads
    first = facing == "nose-first"
    part = outline.parts[row]
    pivot = complex(*(part[:2] if first else part[3:5]))
    point, normal = (1.1, 0.45), (math.sin(-0.2), math.cos(-0.2))
    code = contact.Feature(3, row, contact.FeatureKind.DISC_2).code
    other = contact.Feature(1, 0, contact.FeatureKind.VERTEX).code
    each = (SimpleNamespace(feature=other, point=(0.2, 0.1), normal=(0.0, 1.0)),
            SimpleNamespace(feature=code, point=point, normal=normal))  # fmt: skip
    path = SimpleNamespace(
        carrying=lambda row: each, poses=SimpleNamespace(placement=lambda row: place)
    )
    monkeypatch.setattr(contact, "pair_forces", lambda *given: (0.3, 50.0, 5.0, load, pull))
    angles = {"front": 0.4, "rear": -0.2}
    found = moves._torques(ABSOLEM, angles, outline, path, 0, facing)
    n = complex(*normal)
    force = load * n + pull * n * -1j  # ahead lies a quarter of a turn from the normal
    arm = complex(*point) - (complex(place.x, place.z) + pivot * np.exp(1j * phi))
    moment = ABSOLEM.mass * abs((arm.conjugate() * force).imag)
    front, rear = (
        pair.mass * STANDARD_GRAVITY * pair.com_from_pivot * math.cos(angles[end])
        for end, pair in ABSOLEM.flippers().items()
    )
    assert found == {"front": pytest.approx(front + moment), "rear": pytest.approx(rear)}
