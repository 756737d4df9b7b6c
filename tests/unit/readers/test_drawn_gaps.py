"""What is drawn beyond the ends of a flight: gaps, holes, floors that are not there."""

import numpy as np
import pytest

pytest.importorskip("ifcopenshell", reason="skipped: ifcopenshell not installed")

import kaidan
from drawn_flights import (
    END,
    GOING,
    HEAD,
    RISE,
    blocks,
    flight,
    heights,
    obj,
    seen_from_above,
    solid,
)
from ifc_cases import parsed_here
from kaidan.readers import found_in
from kaidan.readers.assembly import building_of
from kaidan.readers.formats.ifc import read
from kaidan.readers.hints import Hints
from kaidan.readers.interpreters import heights as maps
from kaidan.readers.interpreters import points as clouds
from kaidan.readers.kinds import Heights, Known, Points, Provenance
from kaidan.readers.opening import Source

NEAR = 1e-4
"""What the reader promises of a drawn length [m]."""


@pytest.fixture(autouse=True)
def _parsed(monkeypatch):
    parsed_here(monkeypatch)


def drawn(house, folder):
    """The flight that was drawn."""
    path = house.write(folder / "house.ifc")
    (found,) = building_of(read(Source.of(path), Hints())).flights
    return found.estimate


def judged(house, folder, **manner):
    """Absolem's cell of the one flight, and the notes of the flight."""
    path = house.write(folder / "house.ifc")
    answer = kaidan.building(path, ["absolem"], friction=1.0, **manner)
    return answer.cells[0], answer.flights[0].notes


def spans(estimate):
    """Where its gaps begin and end [m]."""
    return [(each.start, each.end) for each in estimate.gaps]


@pytest.mark.parametrize(
    ("schema", "unit", "how"),
    [
        ("IFC2X3", "m", {}),
        ("IFC4", "mm", {"degrees": 37, "at": (30, 20, 0)}),
        ("IFC4X3_ADD2", "ft", {"mirrored": True, "degrees": -120}),
    ],
)
@pytest.mark.parametrize("gap", [0.05, 0.1, 0.15, 0.3, 0.5])
def test_a_gap_before_the_floor_at_the_head(tmp_path, schema, unit, how, gap):
    """The last nosing is the far edge; what the others are like does not hang on it."""
    found = drawn(flight(schema, unit, gap=gap, **how), tmp_path)
    (only,) = found.gaps
    assert (only.start, only.end) == pytest.approx((END, END + gap), abs=NEAR)
    assert only.depth == pytest.approx(HEAD - RISE, abs=NEAR)
    assert found.line()[-1] == pytest.approx((END + gap, HEAD), abs=NEAR)
    assert (found.regular.rise, found.regular.going) == pytest.approx((RISE, GOING), abs=NEAR)


@pytest.mark.parametrize("drop", [0.3, 1.0, 1.5])
def test_how_deep_a_gap_is(tmp_path, drop):
    found = drawn(flight(gap=0.3, level=HEAD - RISE - drop), tmp_path)
    assert found.gaps[0].depth == pytest.approx(drop, abs=NEAR)


@pytest.mark.parametrize("gap", [0.0, 0.01, 0.02])
def test_a_joint_is_no_gap(tmp_path, gap):
    """The issue's figure: 10 to 20 mm between stairs and slab stay a GO."""
    cell, notes = judged(flight(gap=gap), tmp_path)
    assert (cell.verdict, notes) == ("go", ())


@pytest.mark.parametrize("direction", ["up", "down"])
def test_a_gap_that_an_end_may_drop_into_is_named_and_no_go(tmp_path, direction):
    """Absolem's flippers end in a radius of 29 mm, 58 mm across: they would drop in."""
    cell, notes = judged(flight(gap=0.3), tmp_path, direction=direction)
    assert (cell.verdict, cell.governs, cell.binds) == ("unsure", "gap", "gap")
    assert cell.reason == (
        "A gap of 300 mm lies before step 10: an end of the robot, 58 mm across, may drop in."
    )
    assert notes == ("a gap of 300 mm, 1.53 m deep, lies before step 10",)


def test_a_gap_before_the_first_riser(tmp_path):
    cell, notes = judged(flight(foot=0.3), tmp_path)
    assert (cell.verdict, cell.governs) == ("unsure", "gap")
    assert notes == ("a gap of 300 mm, 1.50 m deep, lies before the first riser",)
    assert spans(drawn(flight(foot=0.1), tmp_path)) == [pytest.approx((-0.1, 0.0), abs=NEAR)]
    assert spans(drawn(flight(foot=0.02), tmp_path)) == []


@pytest.mark.parametrize(
    ("how", "where"),
    [
        ({"head": False}, "behind the last nosing"),
        ({"head": False, "storeys": False}, "behind the last nosing"),
        ({"base": False}, "before the first riser"),
    ],
)
def test_a_floor_that_is_not_drawn_is_a_doubt(tmp_path, how, where):
    cell, notes = judged(flight(**how), tmp_path)
    assert (cell.verdict, cell.governs) == ("unsure", "gap")
    assert cell.reason == f"No floor was found {where}: look there before you drive."
    assert f"no floor was found {where}" in notes


@pytest.mark.parametrize(
    ("category", "z", "whole"),
    [
        ("IfcBeam", (1.3, HEAD), True),
        ("IfcWall", (-0.2, HEAD), True),
        ("IfcCovering", (HEAD - 0.01, HEAD), True),
        ("IfcRailing", (1.3, HEAD), False),
    ],
)
def test_what_fills_a_gap_carries(tmp_path, category, z, whole):
    """The top of a wall or of a beam is a floor; a railing is none."""
    filled = flight(gap=0.3, more=[(category, solid((END, END + 0.3), (-3, 3), z))])
    assert (drawn(filled, tmp_path).gaps == ()) is whole


def test_a_wall_through_the_floor_is_no_gap(tmp_path):
    wall = ("IfcWall", solid((END + 1.5, END + 1.7), (-3, 3), (-0.2, 4)))
    assert drawn(flight(more=[wall]), tmp_path).gaps == ()


HOLE = (0.2, 0.5)


def test_a_hole_in_the_floor_at_the_head(tmp_path):
    found = drawn(flight(hole=(HOLE, (-0.6, 0.6))), tmp_path)
    assert spans(found) == [pytest.approx((END + 0.2, END + 0.5), abs=NEAR)]
    assert found.gaps[0].beside == 0.0


@pytest.mark.parametrize(("width", "verdict"), [(1.0, "unsure"), (1.6, "go")])
def test_the_way_past_a_hole(tmp_path, width, verdict):
    """The hole takes the left half: 0.5 or 0.8 m are left, and Absolem needs 716 mm off line."""
    house = flight(width=width, hole=(HOLE, (0.0, width / 2)))
    estimate = drawn(house, tmp_path)
    # lines 80 mm apart at most, the outer ones 30 mm from the sides
    assert width / 2 - 0.03 - 0.08 <= estimate.gaps[0].beside <= width / 2 - 0.03
    assert judged(house, tmp_path)[0].verdict == verdict


def test_a_landing_ends_at_a_hole_that_lies_beyond_it(tmp_path):
    """Landing with its flippers down Absolem is longer than the 0.8 m before the hole."""
    cell, _ = judged(flight(hole=((0.8, 1.2), (-0.6, 0.6))), tmp_path)
    assert (cell.verdict, cell.governs) == ("unsure", "landing_room")


def test_one_tread_that_is_missing_is_a_gap_of_both_parts(tmp_path):
    house = flight(head=True)
    # boards instead of the solid flight, without the fifth
    house.file.remove(house.file.by_type("IfcStairFlight")[0])
    house.add("IfcStairFlight", "boards", [
        house.slab([(k * GOING, -0.5), ((k + 1) * GOING, -0.5), ((k + 1) * GOING, 0.5),
                    (k * GOING, 0.5)], (k + 1) * RISE, 0.15)
        for k in range(9) if k != 4
    ])  # fmt: skip
    path = house.write(tmp_path / "house.ifc")
    lower, upper = building_of(read(Source.of(path), Hints())).flights
    assert spans(lower.estimate) == [pytest.approx((4 * GOING, 5 * GOING), abs=NEAR)]
    assert spans(upper.estimate)[-1] == pytest.approx((-GOING, 0.0), abs=NEAR)


def mesh(folder, **how):
    path = folder / "stairs.obj"
    path.write_text(obj(blocks(**how)))
    (staircase,) = found_in(path, Hints(unit="m", up="+z")).staircases
    return staircase


@pytest.mark.parametrize("gap", [0.05, 0.3])
def test_a_mesh_with_a_gap_at_its_head(tmp_path, gap):
    pytest.importorskip("trimesh", reason="skipped: trimesh not installed")
    (found,) = mesh(tmp_path, gap=gap).flights
    assert spans(found) == [pytest.approx((END, END + gap), abs=NEAR)]
    assert found.ends
    assert found.line()[-1] == pytest.approx((END + gap, HEAD), abs=NEAR)


def test_ends_of_a_mesh(tmp_path):
    """A joint of 20 mm is none, a floor that is missing is said; so at the foot."""
    pytest.importorskip("trimesh", reason="skipped: trimesh not installed")
    (joint,) = mesh(tmp_path, gap=0.02).flights
    assert (joint.gaps, len(joint)) == ((), 10)
    (missing,) = mesh(tmp_path, head=False).flights
    assert spans(missing) == [(pytest.approx(END, abs=NEAR), None)]
    (foot,) = mesh(tmp_path, foot=0.3).flights
    assert spans(foot) == [pytest.approx((-0.3, 0.0), abs=NEAR)]
    assert foot.begins


def cloud(points, eye=None):
    known = Provenance("made", "", "pcd", unit=Known("m", "file"), up=Known("+z", "file"))
    viewpoint = None if eye is None else np.array(eye)
    (staircase,) = clouds.found(Points(points, known, None, viewpoint), Hints()).staircases
    return staircase.flights[0]


@pytest.mark.parametrize(
    ("how", "ends"), [({}, False), ({"gap": 0.3}, True), ({"head": False}, True)]
)
def test_a_cloud_in_which_the_last_level_was_seen_to_end(how, ends):
    found = cloud(seen_from_above(blocks(**how)))
    assert bool(found.gaps) is ends
    if ends:
        assert spans(found) == [(pytest.approx(END, abs=0.05), None)]  # a strip


def test_from_where_a_cloud_was_seen_says_whether_it_ends():
    """A sensor at the foot below the level sees no landing, nor one that stands on it."""
    points = seen_from_above(blocks(head=False))
    assert cloud(points, eye=(-1.0, 0.0, 3.0)).gaps
    assert not cloud(points, eye=(-1.0, 0.0, 1.2)).gaps
    assert not cloud(points, eye=(4.0, 0.0, 3.0)).gaps


@pytest.mark.parametrize(
    ("unknown", "start"), [(None, None), ((END, 9), END), ((END + 0.3, END + 0.6), END + 0.3)]
)
def test_an_elevation_map_that_is_unknown_behind_the_last_nosing(unknown, start):
    known = Provenance("made", "", "npy", unit=Known("m", "file"), up=Known("+z", "file"))
    z = heights(blocks(), unknown=unknown)
    (staircase,) = maps.found(Heights(z, (0.02, 0.02), known), Hints()).staircases
    (found,) = staircase.flights
    assert spans(found) == ([] if start is None else [(pytest.approx(start, abs=0.05), None)])
    (sheet,) = staircase.stairs()
    verdict = kaidan.assess("absolem", sheet, friction=1.0, flippers="flat").governs
    assert (verdict == "gap") is (start is not None)
