"""Building models that the test authored itself: each figure is the one that was drawn."""

import math
import os
import re
import zipfile
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("ifcopenshell", reason="skipped: ifcopenshell not installed")

from ifc_cases import House, boards, monolith, parsed_here, regular, wedges
from kaidan.errors import InputError
from kaidan.readers import found_in
from kaidan.readers.assembly import building_of
from kaidan.readers.formats.ifc import read
from kaidan.readers.hints import Hints
from kaidan.readers.opening import Source

NEAR = 1e-4
"""What the reader promises of a drawn step [m]."""


def building(path):
    return building_of(read(Source.of(path), Hints()))


def drawn(house):
    """All that a reader must find, side by side in one model."""
    h = house
    # as it is drawn, rotated, mirrored by a map
    h.add("IfcStairFlight", "plain", [monolith(h, *regular(10, 0.18, 0.27))])
    h.add("IfcStairFlight", "rotated", [monolith(h, *regular(10, 0.18, 0.27), width=1.2)],
          at=(10, 0, 0), degrees=33)  # fmt: skip
    h.add("IfcStairFlight", "mirrored", at=(20, 0, 0), degrees=-120,
          shape=h.mapped([monolith(h, *regular(10, 0.17, 0.29))], mirrored=True))  # fmt: skip
    h.add("IfcStair", "boards", boards(h, *regular(8, 0.19, 0.25)), at=(30, 0, 0))
    # half-turn: the last risers are left to landing and slab
    turn = h.add("IfcStair", "half-turn", at=(40, 0, 0))
    half = {
        "rises": regular(8, 0.1875, 0.22)[0],
        "goings": regular(8, 0.1875, 0.22)[1],
        "last": False,
    }
    h.add("IfcStairFlight", "lower", [monolith(h, **half)], at=(40, 0, 0), parent=turn)
    h.add("IfcSlab", "landing", [h.slab([(0, -0.5), (1.2, -0.5), (1.2, 1.7), (0, 1.7)], 0)],
          at=(41.54, 0, 1.5), parent=turn)  # fmt: skip
    h.add("IfcStairFlight", "upper", [monolith(h, **half)], at=(41.54, 1.2, 1.5), degrees=180,
          parent=turn)  # fmt: skip
    h.add("IfcSlab", "floor", [h.slab([(38, 0), (40, 0), (40, 2), (38, 2)], 3.0)])
    # a landing inside one run; what nobody called stairs; steps that differ
    h.add("IfcStairFlight", "resting", [monolith(h, [0.18] * 10, [0.27] * 4 + [1.0] + [0.27] * 4)],
          at=(50, 0, 0))  # fmt: skip
    h.add("IfcSlab", "slabs", boards(h, *regular(6, 0.17, 0.28), overhang=0), at=(60, 0, 0))
    h.add("IfcBuildingElementProxy", "Treppe", [monolith(h, *regular(6, 0.17, 0.28))],
          at=(65, 0, 0))  # fmt: skip
    uneven = [0.18, 0.18, 0.185, 0.18, 0.178, 0.18, 0.15], [0.27, 0.272, 0.27, 0.265, 0.27, 0.27]
    h.add("IfcStairFlight", "uneven", [monolith(h, *uneven)], at=(70, 0, 0))
    h.add("IfcWall", "wall", [h.slab([(-1, 0.5), (5, 0.5), (5, 0.6), (-1, 0.6)], 4, 4)],
          at=(70, 0, 0))  # fmt: skip
    h.add("IfcRailing", "rail", [h.slab([(-1, -0.45), (5, -0.45), (5, -0.4), (-1, -0.4)], 3, 3)],
          at=(70, 0, 0))  # fmt: skip
    h.add("IfcSlab", "ceiling", [h.slab([(-1, -0.5), (5, -0.5), (5, 0.6), (-1, 0.6)], 3.2)],
          at=(70, 0, 0))  # fmt: skip
    # concrete with a finish of boards on it
    h.add("IfcStairFlight", "finished", [
        monolith(h, *regular(6, 0.17, 0.28)),
        *boards(h, [0.2] + [0.17] * 5, [0.28] * 5, overhang=0.0, thickness=0.03),
    ], at=(80, 0, 0))  # fmt: skip
    # what turns
    h.add("IfcStair", "spiral", wedges(h, 12, 25), at=(90, 0, 0))
    h.add("IfcStair", "curve", wedges(h, 14, 12, inner=1, outer=2), at=(95, 0, 0))
    winding = h.add("IfcStair", "winding", at=(100, 0, 0))
    four = regular(4, 0.18, 0.28)
    h.add("IfcStairFlight", "w1", [monolith(h, *four)], at=(100, 0, 0), parent=winding)
    h.add("IfcStairFlight", "w2", wedges(h, 3, 30, inner=0.001, outer=1.0, first=0.72),
          at=(101.12, 0.5, 0), parent=winding)  # fmt: skip
    h.add("IfcStairFlight", "w3", [monolith(h, *four)], at=(101.62, 0.5, 1.26), degrees=90,
          parent=winding)  # fmt: skip
    h.add("IfcRamp", "ramp", [h.side([(0, 0), (6, 0.5), (6, 0.3), (0, -0.2)], 1.2)], at=(110, 0, 0))
    return h


CASES = {
    # name: (rises, goings, width, heading in degrees)
    "plain": ([0.18] * 11, [0.27] * 10, 1.0, 0),
    "rotated": ([0.18] * 11, [0.27] * 10, 1.2, 33),
    "mirrored": ([0.17] * 11, [0.29] * 10, 1.0, 240),
    "boards": ([0.19] * 9, [0.25] * 8, 1.0, 0),
    "lower": ([0.1875] * 8, [0.22] * 7, 1.0, 0),
    "upper": ([0.1875] * 8, [0.22] * 7, 1.0, 180),
    "resting 1": ([0.18] * 5, [0.27] * 4, 1.0, 0),
    "resting 2": ([0.18] * 6, [0.27] * 5, 1.0, 0),
    "slabs": ([0.17] * 7, [0.28] * 6, 1.0, 0),
    "Treppe": ([0.17] * 7, [0.28] * 6, 1.0, 0),
    "finished": ([0.2] + [0.17] * 6, [0.28] * 6, 1.0, 0),
    "w1": ([0.18] * 5, [0.28] * 4, 1.0, 0),
    "w3": ([0.18] * 5, [0.28] * 4, 1.0, 90),
}
"""One riser more than drawn treads, up to a floor: of its storey, or as the others."""


@pytest.fixture(
    scope="module",
    params=[("IFC2X3", "m"), ("IFC4", "mm"), ("IFC4X3_ADD2", "ft")],
    ids=lambda param: f"{param[0]} in {param[1]}",
)
def model(request, tmp_path_factory):
    schema, unit = request.param
    path = tmp_path_factory.mktemp("ifc") / "house.ifc"
    return building(drawn(House(schema, unit)).write(path))


@pytest.mark.parametrize("name", CASES)
def test_every_step_to_a_tenth_of_a_millimetre(model, name):
    rises, goings, width, heading = CASES[name]
    (flight,) = model.named(name)
    estimate = flight.estimate
    line = estimate.line()
    assert np.diff(np.r_[0.0, line[:, 1]]) == pytest.approx(rises, abs=NEAR)
    for lateral in (-0.4, 0.0, 0.4):
        assert np.diff(estimate.line(lateral)[:, 0]) == pytest.approx(goings, abs=NEAR)
    assert estimate.width == pytest.approx(width, abs=NEAR)
    off = math.remainder(math.degrees(estimate.heading) - heading, 360)
    assert off == pytest.approx(0.0, abs=1e-3)
    (sheet,) = found_sheets(model, flight)
    assert sheet.rise == pytest.approx(rises[1], abs=NEAR)
    assert sheet.uncertainty == type(sheet.uncertainty)()


def found_sheets(model, flight):
    return [flight.estimate.stairs(flight.name)]


def test_steps_that_differ_stay_as_they_are(model):
    (flight,) = model.named("uneven")
    rises = np.diff(np.r_[0.0, flight.estimate.line()[:, 1]])
    assert rises[:7] == pytest.approx([0.18, 0.18, 0.185, 0.18, 0.178, 0.18, 0.15], abs=NEAR)
    sheet = flight.estimate.stairs("uneven")
    assert sheet.rises is not None
    assert sheet.irregularity == pytest.approx(0.035, abs=NEAR)


def test_walls_railings_and_ceilings_limit_a_flight(model):
    """From the wall at +0.5 to the railing at -0.4 m; 3.0 m over the last nosing, which leads to a
    floor that is not drawn: at 1.233 m and the mean of the six risers above the first."""
    estimate = model.named("uneven")[0].estimate
    assert estimate.width == pytest.approx(0.9, abs=NEAR)
    assert estimate.headroom == pytest.approx(3.0 - 1.233 - (1.233 - 0.18) / 6, abs=NEAR)
    assert math.isnan(model.named("plain")[0].estimate.headroom)


def test_open_risers_are_seen(model):
    assert model.named("boards")[0].estimate.open_risers
    assert not model.named("plain")[0].estimate.open_risers


def test_flights_meet_on_landings_and_floors(model):
    (lower,), (upper,) = model.named("lower"), model.named("upper")
    assert lower.upper == upper.lower
    landing = model.floors[lower.upper]
    assert (landing.level, landing.storey) == (pytest.approx(1.5), "")
    assert model.floors[lower.lower].name == "Ground"
    assert model.floors[upper.upper].name == "First"
    assert {lower, upper} in [set(group) for group in model.staircases]
    one, two = model.named("resting")
    assert one.upper == two.lower
    assert model.floors[one.upper].level == pytest.approx(0.9)


def test_what_turns_is_refused_with_its_angle(model):
    said = sorted((each.why, round(each.numbers.get("turn_deg", 0))) for each in model.refusals)
    assert said == [("curved", 144), ("curved", 250), ("ramp-element", 0), ("winders", 90)]
    assert model.named("spiral") == ()


@pytest.fixture(scope="module")
def hard(tmp_path_factory):
    """Far from the origin: a slab with a hole, one flight above another, odd treads."""
    h = House(storeys=((0.0, "G"), (3.0, "F"), (6.0, "S")))
    x, y = 5e5, 4e6
    end, floor = 14 * 0.28, [(-3, -3), (8, -3), (8, 3), (-3, 3)]
    steps = {"rises": [0.2] * 15, "goings": [0.28] * 14, "last": False}
    h.add("IfcStairFlight", "far", [monolith(h, **steps)], at=(x, y, 0), degrees=20)
    h.add("IfcStairFlight", "above", [monolith(h, **steps)], at=(x, y, 3), degrees=20, storey=1)
    h.add("IfcSlab", "ground", [h.slab(floor, 0.0)], at=(x, y, 0), degrees=20)
    hole = [(-0.2, -0.6), (end, -0.6), (end, 0.6), (-0.2, 0.6)]
    h.add("IfcSlab", "holed", [h.slab(floor, 3.0, hole=hole)], at=(x, y, 0), degrees=20)
    run, rise = 0.28, 0.18
    wide = [h.side([(0, 0), (0, rise), (run, rise), (run, 0)], 1.6, 0.8)]
    wide += [h.side([(run * k, 0), (run * k, rise * (k + 1)), (run * (k + 1), rise * (k + 1)),
                     (run * (k + 1), 0)], 1.0, 0.5) for k in range(1, 8)]  # fmt: skip
    h.add("IfcStairFlight", "wide first step", wide, at=(x + 20, y, 0))
    falling = [h.side([(run * k, rise * (k + 1) - 0.1), (run * k, rise * (k + 1) - 0.0042),
                       (run * (k + 1), rise * (k + 1)), (run * (k + 1), rise * (k + 1) - 0.1)],
                      1.0, 0.5) for k in range(8)]  # fmt: skip
    h.add("IfcStairFlight", "falling treads", falling, at=(x + 30, y, 0))
    top = []
    for k in range(8):
        z = rise * (k + 1)
        top += [(run * k, z - 0.01), (run * k + 0.01, z), (run * (k + 1), z)]
    body = [(0, 0), *top, (run * 8, rise * 8 - 0.3), (0.3, 0)]
    h.add("IfcStairFlight", "bevelled", [h.side(body, 1.0, 0.5)], at=(x + 40, y, 0))
    return building(h.write(tmp_path_factory.mktemp("ifc") / "hard.ifc"))


@pytest.mark.parametrize(
    ("name", "rises", "going"),
    [
        ("far", [0.2] * 15, 0.28),
        ("above", [0.2] * 15, 0.28),
        ("wide first step", [0.18] * 9, 0.28),
        ("falling treads", [0.1758] + [0.18] * 8, 0.28),
        ("bevelled", [0.18] * 9, 0.28),
    ],
)
def test_hard_cases_to_a_tenth_of_a_millimetre_too(hard, name, rises, going):
    """A bevelled nosing counts at the corner that it was cut from."""
    (flight,) = hard.named(name)
    line = flight.estimate.line()
    assert np.diff(np.r_[0.0, line[:, 1]]) == pytest.approx(rises, abs=NEAR)
    assert np.diff(line[:, 0]) == pytest.approx([going] * (len(rises) - 1), abs=NEAR)
    assert flight.estimate.width == pytest.approx(1.0, abs=NEAR)


def test_a_flight_leads_to_the_slab_with_the_hole_above_it(hard):
    (far,), (above,) = hard.named("far"), hard.named("above")
    assert far.upper == above.lower
    assert far.estimate.notes == ()
    assert far.estimate.headroom == pytest.approx(2.5, abs=NEAR)


@pytest.fixture(scope="module")
def stated(tmp_path_factory):
    h = House("IFC4", "mm")
    flight = h.add("IfcStairFlight", "one", [monolith(h, *regular(8, 0.175, 0.28))])
    flight.RiserHeight = 0.175 / 0.3048  # feet whatever the unit
    flight.TreadLength = 300.0
    h.properties(flight, "Pset_StairFlightCommon", NumberOfRiser=9, NumberOfTreads=7,
                 RiserHeight=175.0)  # fmt: skip
    return h.write(tmp_path_factory.mktemp("ifc") / "stated.ifc")


def test_stated_figures_are_checked_in_every_plausible_unit(stated):
    (flight,) = building(stated).elements
    found = {each.name: (each.unit, each.agrees) for each in flight.stated}
    assert found == {
        "RiserHeight": ("ft", True),
        "TreadLength": ("", False),
        "Pset_StairFlightCommon.NumberOfRiser": ("model", True),
        "Pset_StairFlightCommon.NumberOfTreads": ("", False),
        "Pset_StairFlightCommon.RiserHeight": ("model", True),
    }


def test_a_disagreement_is_said_with_both_numbers(stated):
    (staircase,) = found_in(stated).staircases
    assert staircase.notes[-2:] == (
        "one: TreadLength states 300, which is 300.0 mm in the unit of the model; 280.0 mm are "
        "drawn",
        "one: Pset_StairFlightCommon.NumberOfTreads states 7 treads, 8 are drawn",
    )


def test_one_element_is_asked_for_by_its_name_or_global_id(tmp_path, monkeypatch):
    parsed_here(monkeypatch)  # seven times the same model
    path = drawn(House()).write(tmp_path / "house.ifc")
    (staircase,) = found_in(path, Hints(element="half-turn")).staircases
    assert [each.level for each in staircase.landings] == pytest.approx([0, 1.5, 3.0])
    assert abs(staircase.landings[1].turn) == pytest.approx(math.pi)
    assert staircase.landings[1].depth == pytest.approx(1.2, abs=0.005)
    identity = staircase.facts["elements"][0]
    (one,) = found_in(path, Hints(element=identity)).staircases
    assert len(one.flights) == 1
    # what the staircase is called means all of its flights
    whole = staircase.provenance.element
    for name in (whole, ":".join(staircase.facts["elements"])):
        (again,) = found_in(path, Hints(element=name)).staircases
        assert again.facts["elements"] == staircase.facts["elements"]
    assert found_in(path, Hints(element="spiral")).staircases == ()
    with pytest.raises(InputError, match=r"'attic' is not in it; flights: "):
        found_in(path, Hints(element="attic"))


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    h = House("IFC2X3", "m")
    h.add("IfcStairFlight", "one", [monolith(h, *regular(5, 0.175, 0.28))])
    return h.write(tmp_path_factory.mktemp("ifc") / "small.ifc").read_text()


def of_text(tmp_path, text, name="model.ifc"):
    path = tmp_path / name
    path.write_text(text)
    return path


def test_an_old_header_and_asterisks_are_repaired(small, tmp_path):
    old = small.replace("IFC2X3", "IFC2X_FINAL")
    old = re.sub(r"IFCLOCALPLACEMENT\(\$", "IFCLOCALPLACEMENT(*", old)
    assert old.count("*") > small.count("*")
    (staircase,) = found_in(of_text(tmp_path, old)).staircases
    assert len(staircase.flights[0]) == 6
    assert staircase.provenance.notes == (
        "its schema IFC2X_FINAL is read as IFC2X3",
        "asterisks in it where nothing is derived are read as not given",
    )


def test_a_zipped_model_is_read_and_a_bomb_is_not(small, tmp_path):
    path = tmp_path / "model.ifczip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("model.ifc", small)
    assert len(found_in(path).staircases) == 1
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr("other.ifc", small)
    with pytest.raises(InputError, match="2 models are in it"):
        found_in(path)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("model.ifc", b"\0" * 50_000_000)
    with pytest.raises(InputError, match=r"model\.ifc"):
        found_in(path)


def test_a_model_without_stairs_says_so(tmp_path):
    h = House()
    h.add("IfcWall", "wall", [h.slab([(0, 0), (1, 0), (1, 1), (0, 1)], 1)])
    found = found_in(h.write(tmp_path / "house.ifc"))
    assert [str(each) for each in found.refusals] == ["No stairs are in it."]


HOSTILE = {
    "a placement within itself": lambda text: re.sub(
        r"(#\d+)=IFCLOCALPLACEMENT\(\$", r"\1=IFCLOCALPLACEMENT(\1", text
    ),
    "an unknown schema": lambda text: text.replace("IFC2X3", "IFC9"),
    "no schema": lambda text: text.replace("FILE_SCHEMA", "FILE_SCHEME"),
    "not a model": lambda text: "ISO-10303-21;'IFC4'" + "\0" * 5000,
    "a half": lambda text: text[: len(text) // 2],
}
"""What the parser would crash on, or take for an empty model."""
LENIENT = {
    "endless parentheses": lambda text: text.replace("DATA;", "DATA;\n#9999=IFCX(" + "(" * 100_000),
    "an axis in parentheses": lambda text: re.sub(r"IFCDIRECTION\(\(", "IFCDIRECTION(((", text),
}
"""What the parser skips: nothing can be read there."""


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_files_end_with_one_line(small, tmp_path, name):
    path = of_text(tmp_path, HOSTILE[name](small))
    with pytest.raises(InputError) as refused:
        found_in(path)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("name", LENIENT)
def test_what_the_parser_skips_is_no_stairs(small, tmp_path, name):
    found = found_in(of_text(tmp_path, LENIENT[name](small)))
    assert found.refusals
    assert not found.staircases


def test_the_real_precast_flights():
    """Schependomlaan, drawn as 187.5 by 220 mm; the file is not part of the project."""
    path = os.environ.get("KAIDAN_SCHEPENDOMLAAN")
    if path is None or not Path(path).exists():
        pytest.skip("skipped: file not given (KAIDAN_SCHEPENDOMLAAN)")
    flights = building(path).flights
    assert len(flights) == 6
    for flight in flights:
        regular = flight.estimate.regular
        assert regular.rise == pytest.approx(0.1875, abs=5e-4)
        assert regular.going == pytest.approx(0.220, abs=5e-4)
