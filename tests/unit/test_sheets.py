"""Sheets: every refusal to the letter, and TOML out and in again."""

import math
from typing import Annotated, Literal

import pytest
from pydantic import Field, TypeAdapter, ValidationError

from kaidan import catalog
from kaidan.errors import InputError, fault
from kaidan.robot import Drive, FlipperPair, Payload, Posture, Robot, Track, Uncertainty
from kaidan.sheet import PLACEHOLDER
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs
from kaidan.terrain.stairs_uncertainty import StairsUncertainty

TRACK = {"flat_length": 0.5}
ROBOT = {"name": "r", "com_from_front": 0.25, "com_height": 0.1, "track": TRACK}
FLIPPER = {"length": 0.33, "root_radius": 0.089, "tip_radius": 0.029, "pivot_height": 0.089}
FLIGHT = {"rise": 0.18, "going": 0.28}
SURFACE = {"friction_low": 0.5, "friction_high": 0.6}
ROBOT_FIELDS = (
    "name, title, mass, com_from_front, com_height, com_range, inertia, max_impact_speed, "
    "fall_reserve, width, height and 12 more"
)


def refusal(sheet, data):
    with pytest.raises(InputError) as caught:
        sheet.model_validate(data)
    return str(caught.value)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        (
            {"com_height": 100},
            "robot: com_height = 100 m is not within 0.005 to 3 m "
            "(in millimetres? that would be 0.1 m)",
        ),
        (
            {"com_height": 4.0},
            "robot: com_height = 4 m is not within 0.005 to 3 m "
            "(in inches? that would be 0.1016 m)",
        ),
        ({"com_height": -0.1}, "robot: com_height = -0.1 m is not within 0.005 to 3 m"),
        ({"com_height": 0}, "robot: com_height = 0 m is not within 0.005 to 3 m"),
        ({"com_height": math.nan}, "robot: com_height = nan m is not within 0.005 to 3 m"),
        ({"com_height": math.inf}, "robot: com_height = inf m is not within 0.005 to 3 m"),
        ({"com_height": -math.inf}, "robot: com_height = -inf m is not within 0.005 to 3 m"),
        (
            {"drive": {"efficiency": 1.0000001}},
            "robot: drive: efficiency = 1.0000001 is not within 0.05 to 1",
        ),
        (
            {"mass": 38700},
            "robot: mass = 38700 kg is not within 0.1 to 5000 kg (in grams? that would be 38.7 kg)",
        ),
        (
            {"mass": 10**400},
            "robot: mass = a number of more than 300 digits kg is not within 0.1 to 5000 kg",
        ),
        (
            {"com_height": "0.1"},
            "robot: com_height = '0.1' has no unit; write 0.1mm or 0.1cm or 0.1m",
        ),
        (
            {"com_height": "0,1m"},
            "robot: com_height = '0,1m' has a decimal comma; write 0.1m",
        ),
        (
            {"com_height": "290mm", "mass": "4kN"},
            "robot: mass = '4kN': 'kN' is no unit of mass; known: g, kg, lb",
        ),
        ({"com_height": "-9m"}, "robot: com_height = -9 m is not within 0.005 to 3 m"),
        ({"drive": {"efficiency": "0.9"}}, 'robot: drive: efficiency = "0.9" is not a number'),
        ({"com_height": True}, "robot: com_height = true is not a number"),
        ({"com_height": None}, "robot: com_height = None is not a number"),
        ({"com_height": [0.1]}, "robot: com_height = a list is not a number"),
        ({"com_height": {"mm": 100}}, "robot: com_height = a table is not a number"),
        (
            {"com_height": "100 millimetres, measured by tilting " * 9},
            "robot: com_height = '100 millimetres, measured by tilting 100 millimetres, me... "
            "is no length; write for example 180mm",
        ),
        ({"name": 5}, "robot: name = 5 is not a text"),
        ({"track": 5}, "robot: track = 5 is not a table of fields"),
        ({"track": [TRACK]}, "robot: track = a list is not a table of fields"),
        (
            {"track": {"flat_length": 470}},
            "robot: track: flat_length = 470 m is not within 0.05 to 5 m "
            "(in millimetres? that would be 0.47 m)",
        ),
        (
            {"track": {}},
            "robot: track: flat_length is missing (length of the flat underside of the track)",
        ),
        (
            {"com_hight": 0.1},
            f"robot: com_hight is not a known field; did you mean com_height? Known: "
            f"{ROBOT_FIELDS}",
        ),
        (
            {"gauge": 0.3},
            f"robot: gauge is not a known field; did you mean track.gauge? Known: {ROBOT_FIELDS}",
        ),
        (
            {"a\n\x1b[31m": 0.1},
            f'robot: "a\\n\\u001b[31m" is not a known field; known: {ROBOT_FIELDS}',
        ),
        (
            {"com_height": PLACEHOLDER},
            "robot: com_height is still to be filled in: centroid above the underside of the "
            "track, 0.005 to 3 m",
        ),
        (
            {"sources": {"mass": 5}},
            "robot: sources.mass = 5 is not a text",
        ),
        (
            {"drive": {"acceleration_control": "perhaps"}},
            'robot: drive: acceleration_control = "perhaps" is neither true nor false',
        ),
        (
            {"drive": {"efficiency": 85}},
            "robot: drive: efficiency = 85 is not within 0.05 to 1",
        ),
        (
            {"uncertainty": {"com_height": 5}},
            "robot: uncertainty: com_height = 5 m is not within 0 to 0.5 m "
            "(in millimetres? that would be 0.005 m)",
        ),
        (
            {"front_flippers": {**FLIPPER, "stowed_angle": 90}},
            "robot: flippers: stowed_angle = 90 rad is not within -3.14159 to 3.14159 rad "
            "(in degrees? that would be 1.5708 rad)",
        ),
        # contradictions
        (
            {"com_from_front": 0.6},
            "robot: com_from_front = 0.6 m puts the centroid outside the robot: allowed 0 to 0.5 m",
        ),
        (
            {"com_from_front": -0.1},
            "robot: com_from_front = -0.1 m puts the centroid outside the robot: "
            "allowed 0 to 0.5 m",
        ),
        (
            {"com_from_front": 0.65, "track": {**TRACK, "front_radius": 0.1, "rear_radius": 0.1}},
            "robot: com_from_front = 0.65 m puts the centroid outside the robot: "
            "allowed -0.1 to 0.6 m",
        ),
        (
            {"front_flippers": {**FLIPPER, "mass": 1.5}},
            "robot: mass is missing: the flippers' mass moves the centroid",
        ),
        (
            {"mass": 3, "front_flippers": {**FLIPPER, "mass": 3}},
            "robot: mass = 3 kg is not more than its flippers' 3 kg",
        ),
        (
            {"front_flippers": {**FLIPPER, "length": 0.05}},
            "robot: flippers: length = 0.05 m is too short to lay the tip in line with the track "
            "from a pivot 0.089 m above it",
        ),
    ],
)
def test_robot_refuses_to_the_letter(change, text):
    assert refusal(Robot, {**ROBOT, **change}) == text


def test_a_robot_names_all_its_wrong_fields_at_once():
    assert refusal(Robot, {**ROBOT, "mass": -1, "com_height": 9999}) == (
        "robot: mass = -1 kg is not within 0.1 to 5000 kg; "
        "robot: com_height = 9999 m is not within 0.005 to 3 m"
    )


def test_a_robot_of_nothing_says_what_it_needs():
    assert refusal(Robot, {}) == (
        "robot: name is missing (short name, used on the command line); "
        "robot: com_from_front is missing (centroid behind the front end of the flat underside); "
        "robot: com_height is missing (centroid above the underside of the track); "
        "robot: track is missing (main tracks)"
    )


def test_the_tolerated_impact_is_the_sheets_or_that_of_an_end_let_go_from_100_mm():
    """By hand: a thin even body falls flat about its other edge with v^2 = 3 g h."""
    robot = Robot(**ROBOT)
    assert robot.tolerated_impact == pytest.approx(math.sqrt(3 * 9.80665 * 0.1), abs=0.05)  # stated
    assert Robot(**ROBOT, max_impact_speed=0.8).tolerated_impact == 0.8


@pytest.mark.parametrize("data", [5, "kenaf", None, [1, 2]])
def test_what_is_no_table_is_no_sheet(data):
    assert refusal(Surface, data).endswith(" is not a table of fields")


@pytest.mark.parametrize(
    ("data", "text"),
    [
        (
            {"rise": 180, "going": 280},
            "stairs: rise = 180 m is not within 0.02 to 0.6 m "
            "(in millimetres? that would be 0.18 m); "
            "stairs: going = 280 m is not within 0.02 to 2.5 m "
            "(in millimetres? that would be 0.28 m)",
        ),
        (
            {"rise": 7, "going": 11},
            "stairs: rise = 7 m is not within 0.02 to 0.6 m (in inches? that would be 0.1778 m); "
            "stairs: going = 11 m is not within 0.02 to 2.5 m (in inches? that would be 0.2794 m)",
        ),
        (
            {"rise": 0.9, "going": 0.28},
            "stairs: rise = 0.9 m is not within 0.02 to 0.6 m (in inches? that would be 0.02286 m)",
        ),
        ({"rise": 0.18}, "stairs: give rise and going, or the measured lists rises and goings"),
        ({}, "stairs: give rise and going, or the measured lists rises and goings"),
        (
            {**FLIGHT, "rises": [0.18, 0.18], "goings": [0.28]},
            "stairs: give either rise and going or rises and goings, not both",
        ),
        (
            {"rises": [0.18, 0.18], "goings": [0.28, 0.28]},
            "stairs: 2 rises need 1 goings, not 2",
        ),
        (
            {"rises": [0.18, 0.18], "goings": [0.28], "first_rise": 0.15},
            "stairs: first_rise and last_rise stand in the list rises already",
        ),
        (
            {"rises": [0.18, 0.18], "goings": [0.28], "steps": 12},
            "stairs: steps = 12 contradicts the 2 rises; leave it out",
        ),
        (
            {"rises": [0.18, 180, 0.18], "goings": [0.28, 0.28]},
            "stairs: rises[1] = 180 m is not within 0.005 to 0.6 m "
            "(in millimetres? that would be 0.18 m)",
        ),
        (
            {"rises": [0.18, 0.18, 0.18], "goings": [0.28, math.nan]},
            "stairs: goings[1] = nan m is not within 0.02 to 2.5 m",
        ),
        (
            {"rises": [0.18, "0.18"], "goings": [True]},
            "stairs: rises[1] = '0.18' has no unit; write 0.18mm or 0.18cm or 0.18m; "
            "stairs: goings[0] = true is not a number",
        ),
        (
            {"rises": [0.18], "goings": [0.28]},
            "stairs: rises has fewer than 2 items",
        ),
        ({"rises": 0.18, "goings": [0.28]}, "stairs: rises = 0.18 is not a list of numbers"),
        ({"rises": "0.18", "goings": [0.28]}, 'stairs: rises = "0.18" is not a list of numbers'),
        ({"rises": {}, "goings": [0.28]}, "stairs: rises = a table is not a list of numbers"),
        ({**FLIGHT, "steps": 12.5}, "stairs: steps = 12.5 is not a whole number"),
        ({**FLIGHT, "steps": 1}, "stairs: steps = 1 risers is not within 2 to 10000 risers"),
        ({**FLIGHT, "steps": True}, "stairs: steps = true is not a number"),
        (
            {**FLIGHT, "nosing_overhang": 30},
            "stairs: nosing_overhang = 30 m is not within 0 to 0.1 m "
            "(in millimetres? that would be 0.03 m)",
        ),
        (
            {"rise": 0.18, "going": 0.05, "nosing_overhang": 0.05},
            "stairs: nosing_overhang = 0.05 m is not less than the going 0.05 m",
        ),
        (
            {**FLIGHT, "direction": "sideways"},
            'stairs: direction = "sideways" is not one of up, down',
        ),
        (
            {**FLIGHT, "uncertainty": {"angle": 2}},
            "stairs: uncertainty: angle = 2 rad is not within 0 to 0.35 rad "
            "(in degrees? that would be 0.0349066 rad)",
        ),
        (
            {**FLIGHT, "run": 0.28},
            "stairs: run is not a known field; known: name, title, rise, going, steps, "
            "first_rise, last_rise, first_rise_drawn, last_rise_drawn, rises, goings, "
            "cross_slopes and 25 more",
        ),
        (
            {"rise": PLACEHOLDER, "going": PLACEHOLDER},
            "stairs: rise is still to be filled in: vertical distance between adjacent nosings of "
            "a uniform flight, 0.02 to 0.6 m; stairs: going is still to be filled in: horizontal "
            "distance between adjacent nosings of a uniform flight, 0.02 to 2.5 m",
        ),
    ],
)
def test_stairs_refuse_to_the_letter(data, text):
    assert refusal(Stairs, data) == text


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"friction_low": -0.1}, "surface: friction_low = -0.1 is not within 0 to 5"),
        ({"friction_high": 60}, "surface: friction_high = 60 is not within 0 to 5"),
        ({"friction_low": math.nan}, "surface: friction_low = nan is not within 0 to 5"),
        ({"friction_low": 0.7}, "surface: friction_low = 0.7 is more than friction_high = 0.6"),
        (
            {"friction_low": PLACEHOLDER},
            "surface: friction_low is still to be filled in: smallest static friction, 0 to 5",
        ),
    ],
)
def test_surface_refuses_to_the_letter(change, text):
    assert refusal(Surface, {**SURFACE, **change}) == text


@pytest.mark.parametrize(
    ("sheet", "data", "text"),
    [
        (
            Payload,
            {"mass": 5, "from_front": 250, "height": 0.2},
            "payload: from_front = 250 m is not within -3 to 8 m "
            "(in millimetres? that would be 0.25 m)",
        ),
        (
            Posture,
            {"front": "up"},
            "posture: front = 'up' is no angle; write for example 50deg",
        ),
        (Posture, {"rear": 90.0}, "posture: rear = 90 rad is not within -3.14159 to 3.14159 rad"),
    ],
)
def test_payload_and_posture_refuse_to_the_letter(sheet, data, text):
    assert refusal(sheet, data) == text


def test_toml_errors_name_the_file():
    with pytest.raises(InputError) as caught:
        Surface.from_text("friction_low = ", origin="mine.toml")
    assert str(caught.value) == "mine.toml: not valid TOML: Invalid value (at end of document)"
    with pytest.raises(InputError) as caught:
        Surface.from_text("friction_low = 0.5", origin="mine.toml")
    assert str(caught.value) == (
        "mine.toml: surface: friction_high is missing (largest static friction)"
    )


def test_numbers_may_be_whole():
    assert Robot.model_validate({**ROBOT, "mass": 20}).mass == 20.0
    assert Stairs.model_validate({**FLIGHT, "steps": 5.0}).steps == 5


def test_the_ends_of_a_range_are_allowed():
    assert Track(flat_length=0.05).flat_length == 0.05
    assert Track(flat_length=5.0).flat_length == 5.0


def test_sheets_are_frozen():
    with pytest.raises(ValidationError, match="frozen"):
        Surface(**SURFACE).friction_low = 0.1


SHEETS = {
    "robots": Robot,
    "stairs": Stairs,
    "surfaces": Surface,
}


@pytest.mark.parametrize(
    ("kind", "name"), [(kind, name) for kind in SHEETS for name in catalog.names(kind)]
)
def test_every_catalogue_sheet_survives_toml(kind, name):
    sheet = SHEETS[kind].named(name)
    assert SHEETS[kind].from_text(sheet.to_toml(), origin="again") == sheet


@pytest.mark.parametrize(
    "sheet",
    [
        Robot(
            name='odd "name" \\ with\ttab\nline, ünïcödé, \x7f and \x01',
            title="階段",
            mass=1e-1 + 0.2,
            com_from_front=1 / 3,
            com_height=0.1,
            inertia=1e-4,
            track=Track(flat_length=0.5, gauge=0.4, stiffness=3.4e4),
            front_flippers=FlipperPair(**FLIPPER, mass=0.1, max_speed=0.7854),
            drive=Drive(acceleration_control=True, max_power=1e6),
            uncertainty=Uncertainty(com_height=0.005),
            sources={"track.flat_length": "V: x", "a b": "", "": "U: y", "ä": 'q"'},
            notes='two\n"""lines"""\\',
        ),
        Stairs(rises=(0.18, 0.175, 0.18), goings=(0.28, 0.281), direction="down"),
        Stairs(
            **FLIGHT,
            steps=5,
            first_rise=0.15,
            last_rise=0.19,
            open_risers=True,
            uncertainty=StairsUncertainty(angle=0.01),
        ),
        Surface(**SURFACE, friction_uncertainty=1e-5),
    ],
    ids=["robot", "measured", "uniform", "surface"],
)
def test_odd_sheets_survive_toml(sheet):
    assert type(sheet).from_text(sheet.to_toml(), origin="again") == sheet


def test_toml_leaves_out_what_is_default():
    assert Surface(**SURFACE).to_toml() == "friction_low = 0.5\nfriction_high = 0.6\n"


@pytest.mark.parametrize("sheet", SHEETS.values(), ids=SHEETS)
def test_every_quantity_has_unit_range_and_meaning(sheet):
    """Walk the JSON schema: every number is bounded, explained and has its unit."""
    schema = sheet.model_json_schema()
    models = [schema, *schema.get("$defs", {}).values()]
    for model in models:
        for name, field in model["properties"].items():
            assert field.get("description"), name
            variants = field.get("anyOf", [field])
            for variant in variants:
                number = variant.get("items", variant)
                if number.get("type") in ("number", "integer"):
                    assert "unit" in field, name
                    assert {"minimum", "maximum"} <= number.keys(), name


def test_the_schema_of_a_list_bounds_its_items():
    rises = Stairs.model_json_schema()["properties"]["rises"]
    assert rises["unit"] == "m"
    assert rises["anyOf"][0]["items"] == {"maximum": 0.6, "minimum": 0.005, "type": "number"}


ABSOLEM = Robot.named("absolem")
REAR_ONLY = ABSOLEM.model_copy(update={"front_flippers": None})
KENAF = Robot.named("kenaf")


@pytest.mark.parametrize(
    ("text", "robot", "posture"),
    [
        ("stowed", KENAF, Posture()),
        ("stowed", ABSOLEM, Posture()),
        ("flat", ABSOLEM, Posture(front="flat", rear="flat")),
        ("flat", REAR_ONLY, Posture(rear="flat")),
        ("20deg,-5deg", ABSOLEM, Posture(front=math.radians(20), rear=math.radians(-5))),
        (" flat , stowed ", ABSOLEM, Posture(front="flat")),
        ("20deg", REAR_ONLY, Posture(rear=math.radians(20))),
    ],
)
def test_postures_from_texts(text, robot, posture):
    assert Posture.parse(text, robot) == posture


def test_postures_with_texts_for_angles():
    assert Posture(front="20deg", rear="stowed") == Posture(front=math.radians(20))
    for front in (True, "20", [1.0], math.inf, 4):
        with pytest.raises(InputError, match=r"^posture: front = "):
            Posture(front=front)


@pytest.mark.parametrize(
    ("change", "error"),
    [
        ({"angle": None}, "angle = None is not a number"),
        ({"angle": "35"}, "angle '35' has no unit; write 35deg or 35° or 35rad"),
        ({"angle": 35}, "angle = 35 rad (2005 deg) is not within 0 to 89 deg"),
        ({"angle": 0}, "angle = 0 rad (0 deg) is not within 0 to 89 deg"),
        ({"nosing_spacing": None}, "nosing_spacing = None is not a number"),
        ({"nosing_spacing": math.nan}, "nosing_spacing = nan is not a finite number"),
        (
            {"nosing_spacing": 0.05},
            "20.0535 deg at 50 mm: stairs: rise = 0.0171448903728 m is not within 0.02 to 0.6 m",
        ),
    ],
)
def test_inclined_stairs_refuse_to_the_letter(change, error):
    with pytest.raises(InputError) as caught:
        Stairs.inclined(**{"angle": 0.35, "nosing_spacing": 0.3} | change)
    assert str(caught.value) == error


def test_the_last_step_is_a_regular_one_where_no_landing_was_seen():
    """By hand: 0.1, 0.12 over two goings of 0.25; without a landing 0.1, 0.12, 0.14 over three."""
    steps = {"name": "x", "rises": (0.2, 0.1, 0.12, 0.14), "goings": (0.25, 0.25, 0.25)}
    assert Stairs(**steps).angle == pytest.approx(math.atan2(0.22, 0.5))
    assert Stairs(**steps, head_seen=False).angle == pytest.approx(math.atan2(0.36, 0.75))


def test_inclined_stairs_with_units():
    assert Stairs.inclined(angle="35deg", nosing_spacing="290mm") == Stairs.inclined(
        angle=math.radians(35), nosing_spacing=0.29
    )


@pytest.mark.parametrize(
    ("kind", "value", "said"),
    [
        (int, "x", "is not a whole number"),
        (float, "x", "is not a number"),
        (Annotated[float, Field(allow_inf_nan=False)], math.nan, "is not a finite number"),
        (Annotated[int, Field(ge=1)], 0, "is less than 1"),
        (Annotated[int, Field(gt=1)], 1, "is not more than 1"),
        (Annotated[int, Field(le=1)], 2, "is more than 1"),
        (Annotated[int, Field(lt=1)], 1, "is not less than 1"),
        (str, 5, "is not a text"),
        (bool, "x", "is neither true nor false"),
        (Literal["up", "down", "on"], "x", "is not one of up, down, on"),
        (list[int], 5, "is not a list"),
        (tuple[int, ...], 5, "is not a list"),
        (Annotated[list[int], Field(max_length=1)], [1, 2], "has more than 1 items"),
        (dict[str, int], 5, "is not a table"),
    ],
)
def test_what_pydantic_refuses_is_said_in_the_words_of_the_house(kind, value, said):
    with pytest.raises(ValidationError) as refused:
        TypeAdapter(kind).validate_python(value)
    assert fault(refused.value.errors()[0]) == said


@pytest.mark.parametrize(
    ("text", "robot", "error"),
    [
        ("flat", KENAF, "robot 'kenaf' has no flippers"),
        (
            "up",
            REAR_ONLY,
            "--flippers 'up' is no posture; write stowed, flat or angles such as 20deg",
        ),
        (
            "flta",
            ABSOLEM,
            "--flippers 'flta' is no posture; write stowed, flat or angles such as 20deg,-5deg; "
            "did you mean flat?",
        ),
        ("20", REAR_ONLY, "--flippers '20' has no unit; write 20deg or 20° or 20rad"),
        (
            "20deg",
            ABSOLEM,
            "--flippers '20deg' is one angle for two pairs; write FRONT,REAR, for example "
            "20deg,-5deg",
        ),
        (
            "1deg,2deg,3deg",
            ABSOLEM,
            "--flippers '1deg,2deg,3deg': write FRONT,REAR, for example 20deg,-5deg",
        ),
        (
            "400deg,stowed",
            ABSOLEM,
            "posture: front = 6.98132 rad is not within -3.14159 to 3.14159 rad",
        ),
    ],
)
def test_postures_that_are_none(text, robot, error):
    with pytest.raises(InputError) as caught:
        Posture.parse(text, robot, option="--flippers")
    assert str(caught.value) == error


@pytest.mark.parametrize("friction", [(0.6, 1.0), [0.6, 1], "0.6..1.0", "0.6-1.0", "0.6 to 1.0"])
def test_one_surface_of_a_friction_however_it_is_written(friction):
    surface = Surface.of_friction(friction)
    assert (surface.friction_low, surface.friction_high) == (0.6, 1.0)
    assert surface.name == "friction 0.6..1"


def test_a_friction_past_its_bounds_is_refused_once():
    with pytest.raises(InputError) as caught:
        Surface.of_friction(7)
    assert str(caught.value) == "friction = 7 is not within 0 to 5"
