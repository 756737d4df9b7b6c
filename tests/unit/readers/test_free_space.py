"""What is free across a flight and above it: everything that stands or hangs along the way."""

import math

import pytest

pytest.importorskip("ifcopenshell", reason="skipped: ifcopenshell not installed")

import kaidan
from drawn_flights import END, GOING, HEAD, RISE, along, flight, solid
from ifc_cases import monolith, parsed_here
from kaidan.readers.assembly import building_of
from kaidan.readers.formats.ifc import read
from kaidan.readers.hints import Hints
from kaidan.readers.opening import Source

NEAR = 1e-4
"""What the reader promises of a drawn length [m]."""


@pytest.fixture(autouse=True)
def _parsed(monkeypatch):
    parsed_here(monkeypatch)


def drawn(house, folder):
    path = house.write(folder / "house.ifc")
    (found,) = building_of(read(Source.of(path), Hints())).flights
    return found.estimate


def both(t, z, category="IfcRailing"):
    """The same on both sides."""
    return [(category, along(t, z)), (category, along((-t[1], -t[0]), z))]


WALL = (0.0, 4.0)
ACROSS = (-2.0, 2.0)
CASES = {
    # name: (what is drawn, width, headroom, (height, width) where they differ)
    "nothing": ([], 1.0, None, []),
    "handrails": (both((0.43, 0.48), (0.68, 0.73)), 0.86, None, [(0.68, 1.0), (100, 0.86)]),
    "one handrail": (both((0.43, 0.48), (0.85, 0.9))[:1], 0.93, None, [(0.85, 1.0), (100, 0.93)]),
    "a rail in the middle": (
        [("IfcRailing", along((-0.025, 0.025), (0.0, 0.9)))], 0.475, None, [(0, 1.0), (100, 0.475)],
    ),
    "a pane of 12 mm": (
        [("IfcRailing", along((0.4, 0.412), (0.05, 1.0)))], 0.9, None, [(0.05, 1.0), (100, 0.9)],
    ),
    "stringers of 60 mm": (both((0.45, 0.5), (-0.2, 0.06)), 0.9, None, [(0, 1.0), (100, 0.9)]),
    "stringers of 10 mm": (both((0.45, 0.5), (-0.2, 0.01)), 1.0, None, []),
    "a wall": ([("IfcWall", solid((-1, 6), (0.4, 0.6), WALL))], 0.9, None, [(0, 1.0), (100, 0.9)]),
    "a wall from half way": (
        [("IfcWall", solid((1.5, 6), (0.2, 0.6), WALL))], 0.7, None, [(0, 1.0), (100, 0.7)],
    ),
    "a column": (
        [("IfcColumn", solid((1.2, 1.4), (0.2, 0.5), WALL))], 0.7, None, [(0, 1.0), (100, 0.7)],
    ),
    "a column on the landing": (
        [("IfcColumn", solid((END + 0.3, END + 0.5), (-0.1, 0.1), WALL))],
        0.4, None, [(0, 1.0), (100, 0.4)],
    ),
    # over the line of the nosings at s = 1.3: 0.17 + 1.3 / 0.29 0.17
    "a beam between two nosings": (
        [("IfcBeam", solid((1.2, 1.3), ACROSS, (1.7, 2.0)))],
        1.0, 1.7 - RISE - 1.3 / GOING * RISE, [],
    ),
    "a beam before the foot": (
        [("IfcBeam", solid((-0.6, -0.5), ACROSS, (0.6, 0.9)))], 1.0, 0.6, [],
    ),
    "a beam behind the head": (
        [("IfcBeam", solid((END + 0.4, END + 0.5), ACROSS, (HEAD + 0.5, HEAD + 0.9)))],
        1.0, 0.5, [],
    ),
    "handrails below a ceiling": (
        [*both((0.43, 0.48), (0.85, 0.9)), ("IfcSlab", solid((-1, 4), ACROSS, (3.8, 4.0)))],
        0.86, 3.8 - HEAD, [(0.85, 1.0), (3.8 - HEAD, 0.86)],
    ),
}  # fmt: skip


@pytest.mark.parametrize("how", [{}, {"degrees": -70, "at": (12, 3, 0)}], ids=["", "turned"])
@pytest.mark.parametrize("name", CASES)
def test_what_stands_and_hangs_about_a_flight(tmp_path, name, how):
    more, width, headroom, clear = CASES[name]
    found = drawn(flight(more=more, **how), tmp_path)
    assert found.width == pytest.approx(width, abs=NEAR)
    assert found.headroom == pytest.approx(math.nan if headroom is None else headroom, abs=NEAR,
                                           nan_ok=True)  # fmt: skip
    heights = [(each.height, each.width) for each in found.clear]
    assert heights == [pytest.approx(each, abs=NEAR) for each in clear]


def test_a_ceiling_that_slopes_across(tmp_path):
    """From 0.4 m over the last nosing at its right to 1.9 m at its left, 1.5 m over 1.0 m: up to a
    height h it is (1.9 - h) / 1.5 wide, found to the strips of 20 mm, never more."""

    def roof(house):
        right, left = HEAD + 0.4, HEAD + 1.9
        side = [(-0.5, right), (0.5, left), (0.5, left + 0.2), (-0.5, right + 0.2)]
        return house.extruded(side, 8, house.axes((-2, 0, 0), (1, 0, 0), (0, 1, 0)))

    found = drawn(flight(more=[("IfcRoof", roof)]), tmp_path)
    assert len(found.clear) > 20
    for each in found.clear:
        exact = min((1.9 - each.height) / 1.5, 1.0)
        assert (
            exact - 0.02 - 0.01 <= each.width <= exact + NEAR
        )  # a strip, and what counts as alike


def test_stringers_that_are_part_of_the_stair(tmp_path):
    house = flight()
    stair = house.add("IfcStair", "S")
    for t in ((0.45, 0.5), (-0.5, -0.45)):
        house.add("IfcMember", "stringer", [along(t, (-0.2, 0.06))(house)], parent=stair)
    assert drawn(house, tmp_path).width == pytest.approx(0.9, abs=NEAR)


def test_what_nobody_may_be_walled_in_by_is_no_flight_of_its_own(tmp_path):
    """The steps of a flight that goes on behind a landing of 0.3 m stand in nobody's way."""
    house = flight(head=False)
    house.add("IfcSlab", "rest", [solid((END, END + 0.3), (-0.5, 0.5), (HEAD - 0.2, HEAD))(house)])
    house.add("IfcStairFlight", "next", [monolith(house, [RISE] * 4, [GOING] * 3)],
              at=(END + 0.3, 0, HEAD))  # fmt: skip
    path = house.write(tmp_path / "house.ifc")
    for each in building_of(read(Source.of(path), Hints())).flights:
        assert each.estimate.width == pytest.approx(1.0, abs=NEAR)


def verdicts(house, folder, robots):
    answer = kaidan.building(house.write(folder / "house.ifc"), robots, friction=1.0)
    return answer.flights[0], {each.robot: each for each in answer.cells}


def test_handrails_over_the_edge_are_no_ceiling(tmp_path):
    """50 mm wide, 20 mm inside the edge, 0.68 m over the nosings: below them Absolem is 0.8 m high
    and its 716 mm off line fit between them. OzBot needs 880 mm off line, 738 straight on."""
    robots = ["absolem", "ozbot-atr"]
    _, bare = verdicts(flight(), tmp_path, robots)
    shown, railed = verdicts(flight(more=CASES["handrails"][0]), tmp_path, robots)
    assert (bare["absolem"].verdict, railed["absolem"].verdict) == ("go", "go")
    assert railed["absolem"].margin_deg == bare["absolem"].margin_deg
    assert shown.width_m == pytest.approx(0.86, abs=NEAR)
    assert shown.headroom_m is None
    assert railed["ozbot-atr"].governs == "narrow"
    assert railed["ozbot-atr"].reason == (
        "The flight is 860 mm wide; the robot needs 738 mm going straight, 880 mm off line."
    )


@pytest.mark.parametrize(
    ("more", "verdict", "governs"),
    [
        (CASES["a rail in the middle"][0], "no-go", "narrow"),
        (CASES["a wall from half way"][0], "unsure", "narrow"),
        (CASES["a beam between two nosings"][0], "no-go", "low"),
    ],
)
def test_what_limits_the_way_limits_the_robot(tmp_path, more, verdict, governs):
    """Absolem needs 594 mm straight on, 716 mm off line, and 0.8 m of headroom."""
    _, cells = verdicts(flight(more=more), tmp_path, ["absolem"])
    assert (cells["absolem"].verdict, cells["absolem"].governs) == (verdict, governs)
