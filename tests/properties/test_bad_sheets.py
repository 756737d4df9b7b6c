"""Whatever goes in: a valid sheet comes out, or InputError; never a traceback of anything else."""

import math

import hypothesis.strategies as st
import pytest
from hypothesis import HealthCheck, given, settings

from amounts import examples
from kaidan import catalog
from kaidan.errors import InputError
from kaidan.robot import Payload, Posture, Robot
from kaidan.sheet import Sheet
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs

SHEETS = {"robots": Robot, "stairs": Stairs, "surfaces": Surface}
by_sheet = pytest.mark.parametrize("sheet", SHEETS.values(), ids=SHEETS)

scalars = (
    st.none()
    | st.booleans()
    | st.floats()
    | st.floats(0.01, 1.0)
    | st.integers()
    | st.integers(min_value=10**300)
    | st.text(max_size=10)
    | st.sampled_from(["flat", "up", "FILL IN", "0.5", "nan", "\ud800", "true"])
    | st.dates()
    | st.binary(max_size=3)
)
values = st.recursive(
    scalars,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=5), inner),
    max_leaves=8,
)


def tables_of(sheet, depth=2):
    """Dictionaries that look like a sheet: its own field names, mostly, with anything in them."""
    fields = {}
    for name, field in sheet.model_fields.items():
        inner = next((t for t in _types(field.annotation) if issubclass(t, Sheet)), None)
        good = st.floats(0.02, 0.6) | st.lists(st.floats(0.05, 0.5), max_size=4)
        fields[name] = good | values if inner is None or not depth else tables_of(inner, depth - 1)
    known = st.fixed_dictionaries({}, optional=fields)
    odd = st.dictionaries(st.text(max_size=8) | st.integers(), values, max_size=1)
    return st.builds(lambda a, b: {**a, **b}, known, odd | st.just({}))


def _types(annotation):
    from typing import get_args

    parts = get_args(annotation) or (annotation,)
    return [part for part in parts if isinstance(part, type)]


def assert_sound(sheet):
    """Whatever was accepted is finite, within the bounds of the schema, and survives TOML."""
    assert all(math.isfinite(number) for number in _numbers(sheet.model_dump()))
    assert type(sheet).from_text(sheet.to_toml(), origin="again") == sheet
    if isinstance(sheet, Stairs):
        assert 0 < sheet.angle < math.pi / 2
        assert sheet.nosing_spacing > 0
        assert len(sheet.step_rises) == len(sheet.step_goings) + 1 >= 2
    if isinstance(sheet, Robot):
        stance = sheet.stance()
        assert stance.flat_length > 0
        assert stance.com_height > 0


def _numbers(value):
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list | tuple):
        for item in value:
            yield from _numbers(item)
    elif isinstance(value, int | float):
        yield value


def assert_refused_well(error, start=""):
    text = str(error)
    assert text.startswith(start)
    assert text.isprintable(), "one line, nothing that steers a terminal"
    assert len(text) < 300


@by_sheet
@settings(max_examples=examples(300), deadline=None, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_any_table_is_a_sheet_or_an_input_error(sheet, data):
    table = data.draw(tables_of(sheet) | values)
    try:
        made = sheet.model_validate(table)
    except InputError as error:
        assert_refused_well(error)
    else:
        assert_sound(made)


@by_sheet
@settings(max_examples=examples(200), deadline=None, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_any_single_change_of_a_good_sheet_is_a_sheet_or_an_input_error(sheet, data):
    kind = next(kind for kind, each in SHEETS.items() if each is sheet)
    table = sheet.named(data.draw(st.sampled_from(catalog.names(kind)))).model_dump()
    place = table
    while True:
        key = data.draw(st.sampled_from(sorted(place)) | st.text(max_size=6))
        if isinstance(place.get(key), dict) and place[key] and data.draw(st.booleans()):
            place = place[key]
            continue
        place[key] = data.draw(values)
        break
    try:
        made = sheet.model_validate(table)
    except InputError as error:
        assert_refused_well(error)
    else:
        assert_sound(made)


@by_sheet
@settings(max_examples=examples(200), deadline=None)
@given(text=st.text() | st.text(alphabet="[]{}=\"'.,#0123456789abmeftinrue \n_-+:\\x"))
def test_any_text_is_a_sheet_or_an_input_error(sheet, text):
    try:
        made = sheet.from_text(text, origin="file")
    except InputError as error:
        assert_refused_well(error, "file: ")
    else:
        assert_sound(made)


@by_sheet
@settings(max_examples=examples(150), deadline=None)
@given(data=st.data())
def test_a_damaged_file_is_a_sheet_or_an_input_error(sheet, data, tmp_path_factory):
    """Cut, drop, double or overwrite some bytes of a good file."""
    kind = next(kind for kind, each in SHEETS.items() if each is sheet)
    good = sheet.named(data.draw(st.sampled_from(catalog.names(kind)))).to_toml().encode()
    first = data.draw(st.integers(0, len(good)))
    last = data.draw(st.integers(first, min(len(good), first + 40)))
    damage = data.draw(st.binary(max_size=6) | st.just(good[first:last] * 2))
    path = tmp_path_factory.getbasetemp() / "damaged.toml"
    path.write_bytes(good[:first] + damage + good[last:])
    try:
        made = sheet.named(str(path))
    except InputError as error:
        assert_refused_well(error, f"{path}: ")
    else:
        assert_sound(made)


@by_sheet
@settings(max_examples=examples(200), deadline=None)
@given(name=st.text(max_size=30))
def test_any_name_is_a_sheet_or_an_input_error(sheet, name):
    try:
        made = sheet.named(name)
    except InputError as error:
        assert_refused_well(error)
    else:
        assert_sound(made)


@settings(max_examples=examples(200), deadline=None)
@given(
    posture=tables_of(Posture) | st.fixed_dictionaries({}, optional={"front": st.floats(-4, 4)}),
    payload=tables_of(Payload),
)
def test_any_posture_and_payload_give_a_stance_or_an_input_error(posture, payload):
    robot = Robot.named("absolem")
    try:
        loads = [Payload.model_validate(payload)] if payload else []
        stance = robot.stance(Posture.model_validate(posture), loads)
    except InputError as error:
        assert_refused_well(error)
    else:
        assert all(math.isfinite(number) for number in stance if isinstance(number, float))
        assert stance.com_height > 0
