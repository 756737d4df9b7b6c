"""Every stair, flight, ramp, lift and escalator is judged, refused, or not understood."""

import csv
import io
import math
import re
from itertools import pairwise

import pytest

pytest.importorskip("ifcopenshell", reason="skipped: ifcopenshell not installed")

from ifc_cases import House, blocks, box, half_turn_house, monolith, parsed_here, regular, wedges
from kaidan.files import csv_text
from kaidan.readers import found_in
from kaidan.readers.assembly import building_of
from kaidan.readers.formats.ifc import read
from kaidan.readers.hints import Hints
from kaidan.readers.opening import Source
from kaidan.readers.solids.levels import plates_of
from kaidan.readers.solids.rays import Triangles
from kaidan.text.building_page import page
from kaidan.verbs.building import building as verb

NEAR = 1e-4
"""What the reader promises of a drawn step [m]."""
SCHEMAS = [("IFC2X3", "m"), ("IFC4", "mm"), ("IFC4X3_ADD2", "ft")]
SCHEMAS_ID = [f"{schema} in {unit}" for schema, unit in SCHEMAS]


@pytest.fixture(scope="module", autouse=True)
def parser():
    """Sound models; the process that it has of its own is tested in test_ifc.py."""
    with pytest.MonkeyPatch.context() as patch:
        parsed_here(patch)
        yield


def building(house, folder):
    return building_of(read(Source.of(house.write(folder / "house.ifc")), Hints()))


def outcomes(found):
    return {each.name: (each.kind, each.outcome) for each in found.elements}


def reasons(found):
    return {each.name: str(each) for each in found.refusals}


def rises_of(flight):
    return flight.estimate.drawn_rises


def floors(house, low, high, level, storey=1):
    corners = [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]
    return house.add("IfcSlab", "floor", [house.slab(corners, level)], storey=storey)


# Which side of a face is up


def balusters(count, going, rise, width):
    faces = []
    for k in range(count):
        s, z = (k + 0.5) * going, (k + 1) * rise
        faces += box((s - 0.01, width / 2 - 0.04, z), (s + 0.01, width / 2 - 0.02, z + 0.9))
    return faces


@pytest.mark.parametrize(("schema", "unit"), SCHEMAS, ids=SCHEMAS_ID)
@pytest.mark.parametrize(
    "kind", ["open shell", "open shell turned", "boxes turned", "half turned", "no sides"]
)
def test_an_element_is_read_whichever_way_its_faces_look(tmp_path, schema, unit, kind):
    """8 x 180/250, with balusters in the same element, mirrored and askew."""
    h = House(schema, unit, storeys=((0.0, "Ground"), (1.44, "First")))
    rises, goings = regular(8, 0.18, 0.25)
    faces = blocks(rises, goings, thick=0.1, shell=kind.startswith("open"))
    if kind == "no sides":  # tops and undersides 280 mm below, with room for a foot between
        faces = [each for each in faces if len({z for _, _, z in each}) == 1]
    if "turned" in kind:
        faces = [each[::-1] if k % 2 or kind != "half turned" else each
                 for k, each in enumerate(faces)]  # fmt: skip
    faces += balusters(7, 0.25, 0.18, 1.0)
    faces = [[(x, -y, z) for x, y, z in each] for each in faces]
    h.add("IfcStairFlight", "A", [h.faces(faces)], at=(3, -4, 0), degrees=-70)
    (flight,) = building(h, tmp_path).flights
    assert rises_of(flight) == pytest.approx([0.18] * 8, abs=NEAR)
    assert goings_of(flight) == pytest.approx([0.25] * 7, abs=NEAR)


def goings_of(flight):
    s = flight.estimate.line()[:, 0]
    return [high - low for low, high in pairwise(s)]


def stacked(storeys, count, rise, going, landing):
    """One sheet of treads, risers and landings: half-turns one above another, in a shaft."""
    faces, z, end, across = [], 0.0, going * (count - 1), 1.1
    flight = blocks([rise] * count, [going] * (count - 1), shell=True)
    last = [(end, 0.5, rise * (count - 1)), (end, -0.5, rise * (count - 1)),
            (end, -0.5, rise * count), (end, 0.5, rise * count)]  # fmt: skip
    for number in range(2 * storeys):
        for each in [*flight, last]:
            back = number % 2
            faces.append([(end - x if back else x, across - y if back else y, h + z)
                          for x, y, h in each])  # fmt: skip
        z += rise * count
        near, far = (end, end + landing) if number % 2 == 0 else (0.0, -landing)
        faces.append([(near, -0.5, z), (far, -0.5, z), (far, 1.6, z), (near, 1.6, z)])
    shaft = [(-landing, -0.5), (end + landing, -0.5), (end + landing, 1.6), (-landing, 1.6)]
    for (x, y), (u, v) in zip(shaft, [*shaft[1:], shaft[0]], strict=True):
        faces.append([(x, y, 0), (u, v, 0), (u, v, z), (x, y, z)])
    return faces


@pytest.mark.parametrize("heading", [0, 50, 205])
@pytest.mark.parametrize("storeys", [2, 3, 4])
def test_flights_above_one_another_in_one_sheet_are_all_read(tmp_path, storeys, heading):
    h = House(storeys=tuple((2.88 * k, f"S{k}") for k in range(storeys + 1)))
    sheet = h.triangles(stacked(storeys, 8, 0.18, 0.27, 1.2))
    h.add("IfcStair", "S", [sheet], degrees=heading)
    found = building(h, tmp_path)
    assert len(found.flights) == 2 * storeys
    for flight in found.flights:
        assert rises_of(flight) == pytest.approx([0.18] * 8, abs=NEAR)
    assert outcomes(found) == {"S": ("stair", "judged")}


@pytest.mark.parametrize(("schema", "unit"), SCHEMAS, ids=SCHEMAS_ID)
@pytest.mark.parametrize("deck", ["finish turned", "all turned", "one sheet turned"])
def test_a_landing_joins_its_flights_whichever_way_its_top_looks(tmp_path, schema, unit, deck):
    """One element: two flights of 7 x 160/280 and a landing of 1.4 m, 30 mm of finish on it."""
    h = House(schema, unit, storeys=((0.0, "Ground"), (2.24, "First")))
    rises, goings = regular(7, 0.16, 0.28)
    end = 6 * 0.28
    lower = blocks(rises, goings)
    upper = [[(end - x, 1.1 - y, z + 1.12) for x, y, z in each] for each in lower]
    concrete = box((end, -0.5, 0.9), (end + 1.4, 1.6, 1.09))
    finish = box((end, -0.5, 1.09), (end + 1.4, 1.6, 1.12))
    if deck == "one sheet turned":
        made = [
            [(end, -0.5, 1.12), (end, 1.6, 1.12), (end + 1.4, 1.6, 1.12), (end + 1.4, -0.5, 1.12)]
        ]
    else:
        made = [each[::-1] for each in finish]
        made += [each[::-1] for each in concrete] if deck == "all turned" else concrete
    h.add("IfcStair", "S", [h.faces([*lower, *made, *upper])], at=(8, 2, 0), degrees=33)
    floors(h, (-30, -30), (30, 30), 0.0, storey=0)
    found = building(h, tmp_path)
    one, two = found.flights
    assert one.upper == two.lower
    (staircase,) = found_in(tmp_path / "house.ifc").staircases
    assert abs(staircase.landings[1].turn) == pytest.approx(math.pi, abs=1e-6)
    assert staircase.landings[1].depth == pytest.approx(1.4, abs=0.005)
    assert staircase.landings[1].level == pytest.approx(1.12, abs=NEAR)
    assert outcomes(found) == {"S": ("stair", "judged")}


def test_the_underside_of_a_thick_solid_is_no_floor(tmp_path):
    """0.5 m of concrete, turned inside out and not: room for a foot within it, and none stands."""
    for turned in (False, True):
        h = House()
        faces = box((0, 0, 0), (4, 4, 0.5))
        h.add("IfcSlab", "thick", [h.faces([each[::-1] for each in faces] if turned else faces)])
        path = h.write(tmp_path / f"{turned}.ifc")
        (body,) = read(Source.of(path), Hints()).bodies
        (plate,) = plates_of(Triangles.of([(body.vertices, body.faces)]))
        assert plate.level == pytest.approx(0.5, abs=NEAR)


# What the parser skips


@pytest.mark.parametrize(("schema", "unit"), SCHEMAS, ids=SCHEMAS_ID)
@pytest.mark.parametrize("star", ["*", " * "])
def test_an_asterisk_for_a_name_is_no_name(tmp_path, schema, unit, star):
    h = House(schema, unit, storeys=((0.0, "Ground"), (1.7, "First")))
    h.add("IfcStairFlight", "NAME", [monolith(h, *regular(10, 0.17, 0.29), last=False)])
    h.storeys[0].Description = "a,*,b(*)"
    path = h.write(tmp_path / "house.ifc")
    text = path.read_text()
    changed = re.sub(r"'NAME'", star, text)
    assert changed.count("*") == text.count("*") + 1
    path.write_text(changed)
    found = building_of(read(Source.of(path), Hints()))
    (flight,) = found.flights
    assert rises_of(flight) == pytest.approx([0.17] * 10, abs=NEAR)
    assert found.provenance.notes == (
        "asterisks in it where nothing is derived are read as not given",
    )


# What is no flight


def transport(house, name, how, kind):
    """A transport element of a kind, by its own type, that of its type, its name, or a proxy."""
    new = house.file.schema != "IFC2X3"
    if how == "proxy":
        return house.add(
            "IfcBuildingElementProxy", name, [house.faces(blocks([0.2] * 9, [0.4] * 8))]
        )
    if how == "stair":
        return house.add("IfcStair", name, [house.faces(blocks([0.2] * 9, [0.4] * 8))])
    own = {("PredefinedType" if new else "OperationType"): kind} if how == "own" else {}
    made = house.add("IfcTransportElement", name if how == "name" else "T", [], **own)
    if how == "type":
        of = house.root("IfcTransportElementType", Name="t", PredefinedType=kind)
        house.root("IfcRelDefinesByType", RelatedObjects=[made], RelatingType=of)
    return made


@pytest.mark.parametrize("schema", [schema for schema, _ in SCHEMAS])
@pytest.mark.parametrize(
    ("kind", "name", "is_kind", "said"),
    [
        ("ELEVATOR", "Lift 1", "lift", "It is a lift: robots are not judged on lifts."),
        ("ESCALATOR", "Fahrtreppe", "escalator",
         "It is an escalator: its steps move, so they are not judged as stairs."),
        ("MOVINGWALKWAY", "Travelator", "moving walk",
         "It is a moving walk: it moves, so it is not judged."),
    ],
)  # fmt: skip
@pytest.mark.parametrize("how", ["own", "type", "name", "proxy", "stair"])
def test_lifts_and_escalators_are_named(tmp_path, schema, kind, name, is_kind, said, how):
    if how == "stair" and kind == "ELEVATOR":
        pytest.skip("stairs that are called lift are stairs")
    h = House(schema, "m")
    made = transport(h, name, how, kind)
    found = building(h, tmp_path)
    assert found.flights == ()
    (element,) = found.elements
    assert (element.identity, element.kind, element.outcome) == (made.GlobalId, is_kind, "refused")
    assert [str(each) for each in element.refusals] == [said]


def test_a_transport_element_of_no_known_type_is_named_too(tmp_path):
    h = House()
    h.add("IfcTransportElement", "Hoist", [], PredefinedType="CRANEWAY")
    found = building(h, tmp_path)
    assert outcomes(found) == {"Hoist": ("transport element", "refused")}


@pytest.mark.parametrize("schema", [schema for schema, _ in SCHEMAS])
@pytest.mark.parametrize("kind", ["IfcRamp", "IfcRampFlight", "IfcSlab", "IfcBuildingElementProxy"])
def test_ramps_are_named_with_their_slope(tmp_path, schema, kind):
    """1 in 10, which is 5.7 deg, over 8 m; drawn as a wedge, inside out, mirrored."""
    h = House(schema, "m")
    faces = [
        [(0, 0, 0), (8, 0, 0), (8, 0, 0.8)], [(0, 1.2, 0), (8, 1.2, 0.8), (8, 1.2, 0)],
        [(0, 0, 0), (0, 1.2, 0), (8, 1.2, 0), (8, 0, 0)],
        [(8, 0, 0), (8, 1.2, 0), (8, 1.2, 0.8), (8, 0, 0.8)],
        [(0, 0, 0), (8, 0, 0.8), (8, 1.2, 0.8), (0, 1.2, 0)],
    ]  # fmt: skip
    h.add(kind, "Access ramp 2", [h.faces([each[::-1] for each in faces])], degrees=140)
    found = building(h, tmp_path)
    ((of, outcome),) = outcomes(found).values()
    assert of in ("ramp", "ramp flight")
    assert outcome == "refused"
    assert reasons(found)["Access ramp 2"] == (
        "It is a ramp of 5.7 deg, 0.80 m high: there are no steps to judge."
    )


def test_a_level_slab_that_is_called_a_ramp_is_a_floor(tmp_path):
    h = House()
    floor = h.slab([(-3, -3), (3, -3), (3, 3), (-3, 3)], 0.0)
    h.add("IfcSlab", "ramp landing", [floor])
    h.add("IfcStairFlight", "A", [monolith(h, *regular(5, 0.18, 0.28))])
    found = building(h, tmp_path)
    assert outcomes(found) == {"A": ("flight", "judged")}
    assert found.floors[found.flights[0].lower].outlines


def odd_stairs(h):
    """Stairs that are none, each with its reason."""
    h.add("IfcStair", "nothing")
    line = h.make("IfcPolyline", [h.point(0, 0, 0), h.point(0, 0, 1)])
    h.add("IfcStair", "a line", [line], at=(5, 0, 0))
    h.add("IfcStair", "block", [h.faces(box((0, 0, 0), (1.2, 1.0, 0.17)))], at=(10, 0, 0))
    slope = [(0, 0), (3, 2), (3, 1.9), (0, -0.1)]
    h.add("IfcStairFlight", "chute", [h.side(slope, 1.0, 0.5)], at=(15, 0, 0))
    apart = [h.slab([(0, 2 * k), (1, 2 * k), (1, 2 * k + 1), (0, 2 * k + 1)], 0.3 * k + 0.3, 0.05)
             for k in range(4)]  # fmt: skip
    h.add("IfcStair", "plates apart", apart, at=(20, 0, 0))
    h.add("IfcStair", "spiral", wedges(h, 12, 25), at=(30, 0, 0))
    both = [*blocks(*regular(6, 0.17, 0.28)), *(face for k in range(3) for face in
            box((5 + 2 * k, 0, 2 + 0.2 * k), (5.3 + 2 * k, 1, 2.1 + 0.2 * k)))]  # fmt: skip
    h.add("IfcStair", "in part", [h.faces(both)], at=(40, 0, 0))
    return h


def test_what_makes_no_flight_says_why(tmp_path):
    found = building(odd_stairs(House("IFC2X3", "m")), tmp_path)
    assert outcomes(found) == {
        "nothing": ("stair", "not understood"),
        "a line": ("stair", "not understood"),
        "block": ("stair", "refused"),
        "chute": ("flight", "not understood"),
        "plates apart": ("stair", "not understood"),
        "spiral": ("stair", "refused"),
        "in part": ("stair", "judged in part"),
    }
    assert reasons(found) == {
        "nothing": "Not understood: nothing of it is drawn.",
        "a line": "Not understood: no shape can be made of what is drawn.",
        "block": "It is a single step of 170 mm: only flights of two risers or more are judged.",
        "chute": "Not understood: nothing of it is level and free above.",
        "plates apart": "Not understood: its 4 level surfaces, from 0.30 to 1.20 m, make no "
        "straight flight.",
        "spiral": "It is a curved flight: it turns by 250 deg.",
        "in part": "Not understood: its level surfaces from 2.10 to 2.50 m belong to none of its "
        "flights.",
    }


def test_parts_answer_for_themselves_and_their_whole_for_the_rest(tmp_path):
    found = building(half_turn_house(), tmp_path)
    assert outcomes(found) == {
        "Stair A": ("stair", "judged"), "A1": ("flight", "judged"), "A2": ("flight", "judged"),
        "Stair B": ("stair", "judged"), "B": ("flight", "judged"),
    }  # fmt: skip
    flights = {each.name: each.flights for each in found.elements}
    assert flights["Stair A"] == flights["A1"] + flights["A2"]


def test_a_landing_of_its_own_is_judged_with_its_flights(tmp_path):
    """With a rim of 15 mm round it, as a precast one has."""
    h = House(storeys=((0.0, "Ground"), (3.0, "First")))
    steps = {"rises": [0.15] * 10, "goings": [0.30] * 9, "last": False}
    h.add("IfcStair", "A", [monolith(h, **steps)])
    rim = h.slab([(3.8, -0.5), (3.9, -0.5), (3.9, 1.7), (3.8, 1.7)], 1.515)
    deck = h.slab([(2.7, -0.5), (3.8, -0.5), (3.8, 1.7), (2.7, 1.7)], 1.5)
    h.add("IfcStair", "landing", [deck, rim])
    h.add("IfcStair", "B", [monolith(h, **steps)], at=(2.7, 1.2, 1.5), degrees=180)
    found = building(h, tmp_path)
    assert outcomes(found) == dict.fromkeys(("A", "landing", "B"), ("stair", "judged"))
    landing = next(each for each in found.elements if each.name == "landing")
    assert landing.flights == tuple(each.identity for each in found.flights)


# The sum


def mixed(h):
    odd_stairs(h)
    h.add("IfcStairFlight", "A", [monolith(h, *regular(10, 0.17, 0.29))], at=(0, 20, 0))
    whole = h.add("IfcRamp", "R", at=(0, 40, 0))
    h.add("IfcRampFlight", "R1", [h.side([(0, 0), (6, 0.5), (6, 0.3), (0, -0.2)], 1.2)],
          at=(0, 40, 0), parent=whole)  # fmt: skip
    h.add("IfcTransportElement", "Lift", [])
    return h


@pytest.mark.parametrize("schema", [schema for schema, _ in SCHEMAS])
def test_nothing_vanishes(tmp_path, schema):
    """As many elements as the text of the file has, in JSON, text, CSV and page."""
    path = mixed(House(schema, "m")).write(tmp_path / "house.ifc")
    found = verb(path, ["absolem", "kenaf"], friction=1.0)
    names = ("IFCSTAIR", "IFCSTAIRFLIGHT", "IFCRAMP", "IFCRAMPFLIGHT", "IFCTRANSPORTELEMENT")
    written = {name: len(re.findall(rf"={name}\(", path.read_text())) for name in names}
    counted = dict.fromkeys(names, 0)
    for each in found.elements:
        counted[each.category.upper()] += 1
    assert counted == written
    assert sum(written.values()) == len(found.elements) == 11
    text, html = str(found), page(found, "")
    line = (
        "6 stairs, 2 flights, 1 ramp, 1 ramp flight, 1 lift: 1 judged, 1 judged in part, 5 refused,"
        " 4 not understood"
    )
    assert line in text.splitlines()
    assert line in html
    rows = list(csv.DictReader(io.StringIO(csv_text(found.columns()))))
    judged = {each for row in rows if row["robot"] for each in row["elements"].split()}
    others = {row["elements"]: (row["outcome"], row["reason"]) for row in rows if not row["robot"]}
    for each in found.elements:
        assert (each.identity in judged) == (each.outcome in ("judged", "judged in part"))
        if each.outcome != "judged":
            assert others[each.identity] == (each.outcome, " ".join(each.reasons))
        for why in each.reasons:
            assert f"  {each.name} ({each.kind}, {each.identity}): {why}" in text.splitlines()
            assert f"{each.name} ({each.kind}, {each.identity}): {why}" in html
    said = [(each.provenance.element, str(each)) for each in found_in(path).refusals]
    assert said == [(each.identity, why) for each in found.elements for why in each.reasons]


# What is stated of the whole


def stated_half_turn(**values):
    h = half_turn_house()
    whole = next(each for each in h.file.by_type("IfcStair") if each.Name == "Stair A")
    h.properties(whole, "Pset_StairCommon", **values)
    return h


@pytest.mark.parametrize("treads", [18, 19])
def test_figures_of_a_whole_stair_are_those_of_its_flights(tmp_path, treads):
    """20 risers in two flights: 18 treads, or 19 with the landing."""
    h = stated_half_turn(NumberOfRiser=20, NumberOfTreads=treads, RiserHeight=150.0,
                         TreadLength=300.0)  # fmt: skip
    found = building(h, tmp_path)
    stated = {each.name: each.stated for each in found.elements}
    assert [each.agrees for each in stated["Stair A"]] == [True] * 4
    assert stated["A1"] == ()
    (staircase,) = [each for each in found_in(tmp_path / "house.ifc").staircases
                    if len(each.flights) == 2]  # fmt: skip
    assert not [note for note in staircase.notes if "states" in note]


def test_a_whole_stair_that_is_drawn_otherwise_is_told_once(tmp_path):
    h = stated_half_turn(NumberOfRiser=21, RiserHeight=155.0)
    answer = verb(h.write(tmp_path / "house.ifc"), ["absolem"], friction=1.0)
    assert [note for each in answer.elements for note in each.notes] == [
        "Pset_StairCommon.NumberOfRiser states 21 risers, 20 are drawn",
        "Pset_StairCommon.RiserHeight states 155, which is 155.0 mm in the unit of the model; "
        "150.0 mm are drawn",
    ]
    assert str(answer).count("states 21 risers") == 1


def test_stairs_of_which_a_part_is_refused_are_not_counted(tmp_path):
    """Two flights of four treads, and winders whose risers nobody counted."""
    h = House()
    whole = h.add("IfcStair", "winding")
    four = regular(4, 0.18, 0.28)
    h.add("IfcStairFlight", "w1", [monolith(h, *four)], parent=whole)
    h.add("IfcStairFlight", "w2", wedges(h, 3, 30, inner=0.001, outer=1.0, first=0.72),
          at=(1.12, 0.5, 0), parent=whole)  # fmt: skip
    h.add("IfcStairFlight", "w3", [monolith(h, *four)], at=(1.62, 0.5, 1.26), degrees=90,
          parent=whole)  # fmt: skip
    h.properties(whole, "Pset_StairCommon", NumberOfRiser=11, RiserHeight=180.0)
    found = building(h, tmp_path)
    (element,) = [each for each in found.elements if each.name == "winding"]
    assert element.outcome == "judged in part"
    assert [each.quantity for each in element.stated] == ["rise"]


# First and last riser


def with_finish(schema, unit, *, foot=0.0, head=0.0, stated=0.17, count=10):
    """10 x 170/290 between floors that lie below their finished levels."""
    h = House(schema, unit, storeys=((0.0, "Ground"), (1.7, "First")))
    whole = h.add("IfcStair", "S")
    h.add("IfcStairFlight", "S1", [h.faces(blocks(*regular(10, 0.17, 0.29)))], parent=whole)
    floors(h, (-5, -3), (8, 3), -foot, storey=0)
    floors(h, (2.61, -3), (8, 3), 1.7 - head)
    if stated:
        h.properties(whole, "Pset_StairCommon", NumberOfRiser=count, RiserHeight=stated * h.scale)
    return h


@pytest.mark.parametrize(("schema", "unit"), SCHEMAS, ids=SCHEMAS_ID)
def test_a_floor_without_its_finish_is_a_doubt_and_named(tmp_path, schema, unit):
    """150 mm lower: the first riser is drawn 320 mm high, 10 x 170 mm are stated."""
    path = with_finish(schema, unit, foot=0.15).write(tmp_path / "house.ifc")
    answer = verb(path, ["absolem"], friction=1.0)
    (flight,), (cell,) = answer.flights, answer.cells
    assert (flight.first_rise_m, flight.last_rise_m) == pytest.approx((0.32, 0.17), abs=NEAR)
    assert (cell.verdict, cell.governs, cell.binds) == ("unsure", "floor_finish", "drawing")
    assert cell.reason == (
        "Drawn 1.85 m, stated 1.70 m: floor finish missing? Measure it: first riser 320 mm drawn, "
        "170 mm stated."
    )
    (row,) = [line.split() for line in str(answer).splitlines() if line.startswith("S1 ")]
    assert row[2:7] == ["10", "170", "320", "170", "290"]
    assert "first 320.0, last 170.0 mm" in page(answer, "")
    rows = list(csv.DictReader(io.StringIO(csv_text(answer.columns()))))
    assert float(rows[0]["first_rise_m"]) == pytest.approx(0.32, abs=NEAR)
    assert (
        "Note: S: drawn 1.85 m, stated 1.70 m (10 risers of 170 mm): floor finish missing?"
        in str(answer).splitlines()
    )


def test_without_a_stated_rise_the_drawn_riser_counts(tmp_path):
    """320 mm are a step that Absolem does not take."""
    path = with_finish("IFC4", "mm", foot=0.15, stated=0.0).write(tmp_path / "house.ifc")
    answer = verb(path, ["absolem"], friction=1.0)
    assert answer.flights[0].sheet.first_rise == pytest.approx(0.32, abs=NEAR)
    assert answer.cells[0].verdict == "no-go"


def test_finishes_missing_at_both_ends_leave_the_height_as_it_is(tmp_path):
    """80 mm: 250 mm first and 90 mm last add up to 1.70 m as stated."""
    path = with_finish("IFC4", "mm", foot=0.08, head=0.08).write(tmp_path / "house.ifc")
    answer = verb(path, ["absolem"], friction=1.0)
    (flight,), (cell,) = answer.flights, answer.cells
    assert (flight.first_rise_m, flight.last_rise_m) == pytest.approx((0.25, 0.09), abs=NEAR)
    assert cell.verdict == "unsure"
    assert cell.reason == (
        "Floor finish missing? Measure it: first riser 250 mm drawn, 170 mm stated, last riser 90 "
        "mm drawn, 170 mm stated."
    )


def test_end_risers_within_the_tolerance_of_codes_are_no_finish(tmp_path):
    """15 mm, less than ISO 14122-3 allows: as drawn, and no doubt."""
    path = with_finish("IFC4", "mm", foot=0.015).write(tmp_path / "house.ifc")
    answer = verb(path, ["absolem"], friction=1.0)
    assert answer.flights[0].sheet.first_rise == pytest.approx(0.185, abs=NEAR)
    assert answer.cells[0].verdict == "go"


def test_a_height_that_no_end_riser_explains_is_said(tmp_path):
    """12 risers of 170 mm are stated, 10 are drawn."""
    path = with_finish("IFC4", "mm", count=12).write(tmp_path / "house.ifc")
    answer = verb(path, ["absolem"], friction=1.0)
    assert [note for each in answer.elements for note in each.notes] == [
        "Pset_StairCommon.NumberOfRiser states 12 risers, 10 are drawn",
        "drawn 1.70 m, stated 2.04 m (12 risers of 170 mm)",
    ]
    assert answer.cells[0].verdict == "go"


def test_a_finish_that_is_drawn_as_a_covering_is_the_floor(tmp_path):
    h = with_finish("IFC4", "mm", foot=0.15)
    corners = [(-5, -3), (0, -3), (0, 3), (-5, 3)]
    h.add("IfcCovering", "screed", [h.slab(corners, 0.0, 0.15)], PredefinedType="FLOORING")
    (flight,) = building(h, tmp_path).flights
    assert rises_of(flight) == pytest.approx([0.17] * 10, abs=NEAR)


# One answer


@pytest.mark.parametrize("how", ["ceiling", "door", "finish"])
def test_read_building_and_assess_have_the_same_flight(tmp_path, how):
    import kaidan

    if how == "finish":
        h, name = with_finish("IFC4", "mm", foot=0.15), "S1"
    else:
        h, name = half_turn_house(ceiling=1.0 if how == "ceiling" else None), "A1"
        if how == "door":
            leaf = h.slab(
                [(-0.45, -0.025), (0.45, -0.025), (0.45, 0.025), (-0.45, 0.025)], 2.1, 2.1
            )
            h.add("IfcDoor", "L", [leaf], at=(-1.2, 0, 0), degrees=-90, OverallWidth=900.0,
                  OverallHeight=2100.0, OperationType="SINGLE_SWING_LEFT")  # fmt: skip
    path = h.write(tmp_path / "house.ifc")
    answer = verb(path, ["absolem"], friction=1.0)
    (flight,) = [each for each in answer.flights if each.name == name]
    (cell,) = [each for each in answer.cells if each.flight == flight.identity]
    (staircase,) = kaidan.read(f"{path}#{flight.identity}").staircases
    (drawn,) = staircase.flights
    assert drawn.sheet == flight.sheet
    for figure in ("rise_m", "going_m", "first_rise_m", "last_rise_m", "width_m", "headroom_m"):
        assert getattr(drawn, figure) == pytest.approx(getattr(flight, figure), abs=1e-6), figure
    asked = kaidan.assess("absolem", f"{path}#{flight.identity}", friction=1.0)
    taken = asked.question.flights[0].model_copy(update={"notes": ""})
    assert taken == flight.sheet.model_copy(update={"notes": ""})
    assert (asked.verdict, asked.governs, asked.reason) == (cell.verdict, cell.governs, cell.reason)
    if how == "ceiling":  # 2.35 m less the last nosing at 1.50 m
        assert drawn.headroom_m == pytest.approx(0.85, abs=NEAR)
    if how == "door":
        assert flight.sheet.lower_leaf == pytest.approx(0.9)
