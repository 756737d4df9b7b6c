"""Whatever goes in: an answer that is sound, or InputError and exit code 2; never a traceback.

Command line texts, TOML texts and arguments from Python. An answer counts as sound if it keeps to
the schema (so: no NaN, no infinity), if its figures are physical, and if no number that was not
finite went in. Nothing is left behind in the folder.
"""

import json
import math
import os
import sys
from decimal import Decimal
from fractions import Fraction

import hypothesis.strategies as st
import jsonschema
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from typer.testing import CliRunner

from amounts import SHARE, examples
from kaidan import Assessment, InputError, Payload, Posture, Robot, Stairs, assess, sweep, verdicts
from kaidan.allowance import Allowance
from kaidan.cli import app
from kaidan.cli import run as ended_with
from kaidan.modes import CLOSED_FORM, CONTACT, Verdict

SCHEMA = jsonschema.Draft202012Validator(Assessment.json_schema())
WORDS = {verdict.label.split()[0]: verdict.exit_code for verdict in Verdict}


def fuzz(whole, /, share=SHARE, **strategies):
    """Warnings are errors here too."""
    return lambda test: settings(
        max_examples=examples(whole, share),
        deadline=None,
        suppress_health_check=list(HealthCheck),
    )(given(**strategies)(test))


def assert_refused_well(text):
    assert text
    assert text.isprintable(), "one line, nothing that steers a terminal"
    assert len(text) < 300


def assert_sound(answer):
    SCHEMA.validate(json.loads(answer.to_json(), parse_constant=pytest.fail))
    assert 0 < answer.angle_deg < 90
    assert 0.01 < answer.nosing_spacing_m < 4
    assert answer.flat_length_m > 0
    assert answer.com_height_m > 0
    assert -1 < answer.com_from_front_m < answer.flat_length_m + 1
    assert abs(answer.question.acceleration) <= 9.8
    if answer.verdict == "go":
        assert answer.margin_deg > 0
        assert answer.friction is not None
        # what the weight asks of the contacts is within what friction gives
        assert answer.required_friction <= answer.friction[0] + 1e-9
        # on treads as long as the robot each step is a flight of its own, entered and left
        phases = [] if answer.contact is None else [each.phase for each in answer.contact.phases]
        if answer.model == "closed-form" or "traverse" in phases:
            assert 2 * answer.nosing_spacing_m <= answer.flat_length_m * (1 + 1e-9)


# Arguments from Python

numbers = (
    st.floats()
    | st.integers()
    | st.sampled_from([10**400, -(10**400), 0, -0.0, 1e-320, math.inf, -math.inf, math.nan])
    | st.floats(-10, 10)
)
odd = (
    st.none()
    | st.booleans()
    | numbers
    | st.text(max_size=8)
    | st.sampled_from(["0.5", "flat", "up", "", "nan", "kenaf", "\ud800", "é階", "x" * 300])
    | st.binary(max_size=4)
    | st.decimals()
    | st.fractions()
    | st.complex_numbers()
    | st.lists(numbers, max_size=3)
    | st.tuples(numbers, numbers)
    | st.dictionaries(st.text(max_size=3), numbers, max_size=2)
    | st.sets(st.integers(0, 3), max_size=2)
)
of_numpy = st.sampled_from(
    [
        np.float64(0.5),
        np.float32(0.5),
        np.float16(0.5),
        np.int8(1),
        np.uint64(2**63),
        np.float64("nan"),
        np.float64("inf"),
        np.array(0.5),
        np.array([0.5]),
        np.array([0.5, 0.6]),
        np.array([]),
        np.array("0.5"),
        np.bool_(True),
        np.complex128(0.5),
        np.datetime64("2020-01-01"),
        np.ma.masked,
        np.longdouble("0.5"),
        float,
        object(),
        len,
    ]
)
anything = odd | of_numpy
ARGUMENTS = (
    *("surface", "friction", "acceleration", "speed", "direction", "facing", "flippers"),
    *("payload", "theta_d", "theta_M", "risk", "model", "yaw"),
)
FLIGHT = Stairs.inclined(angle=0.6, nosing_spacing=0.15)
models = st.sampled_from([CONTACT.name, CLOSED_FORM.name])


@fuzz(600, name=st.sampled_from(ARGUMENTS), value=anything, model=models)
def test_any_argument(name, value, model):
    try:
        answer = assess("kenaf", FLIGHT, **({"model": model} | {name: value}))
    except InputError as error:
        assert_refused_well(str(error))
    else:
        assert_sound(answer)
        if name in ("friction", "acceleration", "risk"):
            assert not isinstance(value, bool | Decimal)  # texts are a spelling


@fuzz(300, robot=anything, stairs=anything, surface=anything, model=models)
def test_anything_for_a_sheet(robot, stairs, surface, model):
    for question in ((robot, FLIGHT, None), ("kenaf", stairs, None), ("kenaf", FLIGHT, surface)):
        try:
            answer = assess(*question[:2], surface=question[2], model=model)
        except InputError as error:
            assert_refused_well(str(error))
        else:
            assert_sound(answer)


good = {
    "friction": st.floats(0.0, 5.0),
    "acceleration": st.floats(-9.8, 9.8),
    "speed": st.floats(0, 0.4),
    "direction": st.sampled_from(["up", "down"]),
    "facing": st.sampled_from(["nose-first", "tail-first"]),
    "flippers": st.sampled_from(["flat", "stowed", Posture(front=0.3), Posture(rear="flat")]),
    "payload": st.just(Payload(mass=5.0, from_front=0.2, height=0.3)),
    "theta_d": st.floats(0.0, 0.6),
    "theta_M": st.tuples(st.floats(0.0, 0.3), st.floats(0.3, 0.6))
    | st.just(Allowance(low=0, high=0)),
    "risk": st.floats(1e-3, 0.5),
}


@fuzz(
    300,
    question=st.fixed_dictionaries({}, optional=good),
    angle=st.floats(0.05, 1.5),
    spacing=st.floats(0.03, 0.7),
    model=models,
)
def test_every_sound_question_has_an_answer(question, angle, spacing, model):
    """Each argument within its range, together in every way: an answer, never a refusal."""
    rise, going = spacing * math.sin(angle), spacing * math.cos(angle)
    if not (0.02 <= rise <= 0.6 and 0.02 <= going <= 2.5):
        return
    assert_sound(assess("absolem", Stairs(rise=rise, going=going), model=model, **question))


@fuzz(300, name=st.sampled_from(["front", "rear"]), value=anything, model=models)
def test_any_posture(name, value, model):
    try:
        answer = assess("absolem", FLIGHT, flippers=Posture(**{name: value}), model=model)
    except InputError as error:
        assert_refused_well(str(error))
    else:
        assert_sound(answer)


PAIR = {
    "flat_length": 0.470,
    "com_from_uphill": 0.196,
    "com_height": 0.071,
    "angle": 0.6,
    "nosing_spacing": 0.15,
    "friction": 2.0,
    "acceleration": 0.1,
    "theta_d": 0.01,
    "theta_M": 0.01,
    "theta_d_spare": 0.01,
    "theta_M_spare": 0.01,
}


@fuzz(400, name=st.sampled_from([*PAIR, "mass", ""]), value=anything)
def test_any_input_of_pairs(name, value):
    try:
        found = verdicts(PAIR | {name: value}, engine="numpy")
    except InputError as error:
        assert_refused_well(str(error))
    else:
        for array in found:
            assert np.all((array == array) | (found.verdict != 0)), "no NaN beside a GO"
        assert np.isfinite(np.asarray(value, dtype=float)).all() or name == "friction"


@fuzz(
    150,
    name=st.sampled_from(["angle", "nosing_spacing", "friction", "com_height", "slope"]),
    value=anything,
)
def test_any_parameter_of_a_sweep(name, value):
    try:
        table = sweep("kenaf", **({"angle": 0.6, "nosing_spacing": 0.15} | {name: value}))
    except InputError as error:
        assert_refused_well(str(error))
    else:
        assert set(np.unique(table.verdict)) <= {0, 1, 2, 3}
        assert not isinstance(value, str | bytes | bool)


# The command line

QUANTITIES = """
    180mm 18cm 0.18m 7in 0.5ft 30deg 30° 0.5rad 40 -180mm 0mm 1e3mm 1e400mm nanmm infmm 180
    180MM 1,8m 180mm180mm mm 0.6 0.6..1.0 1.0..0.6 .. ..1 1.. 0.6...1 0x10mm 1_000mm +180mm 5kg
    5kg@200mm,300mm 5kg@200mm 5@2,3 5kg@,mm @,, flat stowed flat,stowed 20deg,-5deg 400deg,0deg
    , ,, com_height=71mm com_height= =71mm com_height=71 mass=5kg,mass=6kg foo=1mm friction=0.1
    up down nose-first tail-first closed-form contact caught no-rotation ibc kenaf absolem
    concrete-dry / . .. /dev/null /dev/zero /dev/full ~ -- - -h --help --json 0.01 0 1 1e-9 0.5 12
    10000 10001 -5 9.9m/s2 0.5m/s2 -0.5m/s2 0.1m/s 3km/h ½° ١٢mm ∞mm"""
AWKWARD = ["", " ", "180 mm", " 180mm ", "1mm\n2mm", "\x1b[31m", "\x00", "\udcff", "1" * 400]
AWKWARD += ["1" * 5000 + "mm", "0." + "0" * 5000 + "1mm"]
quantities = st.sampled_from(QUANTITIES.split() + AWKWARD)
values = quantities | st.text(max_size=8).filter(lambda text: "\x00" not in text)
OPTIONS = (
    *("--rise", "--going", "--angle", "--nosing-spacing", "--steps", "--surface", "--friction"),
    *("--acceleration", "--speed", "--direction", "--facing", "--flippers", "--payload"),
    *(
        "--theta-d",
        "--theta-m",
        "--override",
        "--uncertainty",
        "--risk",
        "--model",
        "--yaw",
    ),
)
options = st.tuples(st.sampled_from(OPTIONS), values).map(list)
flags = st.sampled_from([["--json"], ["--nonsense"], ["-x"], ["--"], ["--json=1"]])
robots = st.sampled_from(["kenaf", "absolem", "kenav", "dr-robot-jaguar", ""]) | values
flights = st.sampled_from(
    [["ibc"], ["japan-dwelling"], ["--rise", "100mm", "--going", "120mm"], []]
) | values.map(lambda value: [value])


@st.composite
def lines(draw):
    words = [draw(robots), *draw(flights)]
    for more in draw(st.lists(options | flags, max_size=4)):
        words += more
    return words


def assert_process(code, out, err):
    if code == 2:
        assert out == ""
        assert err.strip()
        assert "Traceback" not in err
        return
    if out.startswith("Usage: "):  # --help
        assert code == 0
        return
    assert code in (0, 1, 3, 4, 5)
    assert err == ""
    if out.startswith("{"):
        document = json.loads(out, parse_constant=pytest.fail)
        SCHEMA.validate(document)
        verdict = document["verdict"]
        assert code == Verdict(verdict).exit_code
    else:
        word = out.split()[0]
        assert code == WORDS[word]
        assert all(character.isprintable() or character == "\n" for character in out)


@fuzz(500, share=10, words=lines())  # each line is driven, and often planned
def test_any_command_line(words):
    result = CliRunner().invoke(app, ["assess", *words])
    if isinstance(result.exception, InputError):
        assert_refused_well(str(result.exception))
        assert result.stdout == ""
        return
    assert result.exception is None or isinstance(result.exception, SystemExit), words
    assert_process(result.exit_code, result.stdout, result.stderr)


@settings(
    max_examples=60,
    deadline=None,
    suppress_health_check=list(HealthCheck),
)
@given(words=lines())
def test_any_command_line_through_main(words, capsys, monkeypatch, tmp_path_factory):
    """As a shell has it: what kaidan refuses ends with exit code 2 and one line; no files."""
    folder = tmp_path_factory.getbasetemp() / "nothing-here"
    folder.mkdir(exist_ok=True)
    monkeypatch.chdir(folder)
    monkeypatch.setattr(sys, "argv", ["kaidan", "assess", *words])
    ended = ended_with(sys.argv[1:])
    shown = capsys.readouterr()
    assert_process(ended or 0, shown.out, shown.err)
    if shown.err.startswith("kaidan: "):
        assert shown.err.count("\n") == 1
    assert os.listdir(folder) == []


# Files

tables = st.text(alphabet="[]{}=\"'.,#0123456789abmeftinrue \n_-+:\\", max_size=60)
FIELDS = """mass com_from_front com_height inertia name notes title track drive rise going steps
    rises goings friction_low friction_high uncertainty direction sources"""
VALUES = """nan inf -inf 1e400 -1 0 true "0.1" [] {} 1979-05-27 0.1 0.2 1_0.0 0x1F 1e-320 [0.1,0.2]
    [nan] {flat_length=0.5} {flat_length=nan} "up" "sideways" ''"""
LONG = ["9" * 5000, "0." + "1" * 5000, f'"{"x" * 5000}"', '"\\u0000\\u001b"', "[" * 200]
fields = st.sampled_from(FIELDS.split())
settings_of = st.sampled_from(VALUES.split() + LONG)
SHEETS = {
    "robot": 'name = "r"\ncom_from_front = 0.2\ncom_height = 0.1\n{}\n[track]\nflat_length = 0.5\n',
    "stairs": 'name = "s"\nrise = 0.1\ngoing = 0.12\n{}\n',
    "surface": 'name = "g"\nfriction_low = 0.9\nfriction_high = 1.0\n{}\n',
}


@fuzz(
    300,
    kind=st.sampled_from(sorted(SHEETS)),
    text=tables | st.builds("{} = {}".format, fields, settings_of),
    whole=st.booleans(),
    model=models,
)
def test_any_file(kind, text, whole, model, tmp_path_factory):
    path = tmp_path_factory.getbasetemp() / "any.toml"
    path.write_text(text if whole else SHEETS[kind].format(text), encoding="utf-8")
    question = {"robot": "kenaf", "stairs": FLIGHT, "surface": None} | {kind: str(path)}
    try:
        answer = assess(**question, model=model)
    except InputError as error:
        assert_refused_well(str(error).removeprefix(str(path)))
    else:
        assert_sound(answer)


@pytest.mark.parametrize(
    "content",
    [b"", b"\xff\xfe" + "name = 'x'".encode("utf-16-le"), b"\x00" * 100, b"\xef\xbb\xbf", b"\x80"],
    ids=["empty", "utf-16", "zeros", "mark", "latin"],
)
def test_odd_files(content, tmp_path):
    path = tmp_path / "odd.toml"
    path.write_bytes(content)
    for question in ((str(path), "ibc"), ("kenaf", str(path))):
        with pytest.raises(InputError) as refused:
            assess(*question)
        assert str(refused.value).startswith(f"{path}: ")
        assert_refused_well(str(refused.value))


def test_odd_places(tmp_path):
    loop, pipe, large = tmp_path / "loop", tmp_path / "pipe", tmp_path / "large.toml"
    loop.symlink_to(loop)
    os.mkfifo(pipe)
    with large.open("wb") as file:
        file.truncate(100_000_000)
    for path, text in (
        (tmp_path, "a folder, not a TOML file"),
        (pipe, "not a regular file"),
        (large, "larger than 1 MB, so not a sheet"),
        (loop, "no such file"),
        (tmp_path / "loop" / "x", "no such file"),
        ("/dev/zero", "not a regular file"),
        ("\x00", "no such file exists"),
        ("x" * 100_000, "no such file exists"),
    ):
        with pytest.raises(InputError, match=text):
            assess(str(path), "ibc")


def test_fractions_are_numbers_and_decimals_are_not():
    """As Python's own tower of numbers has it; both are exact, but only one is a Real."""
    assert assess("kenaf", FLIGHT, friction=Fraction(1, 2)).friction == (0.5, 0.5)
    with pytest.raises(InputError, match=r"friction = Decimal\('0.5'\) is not a number"):
        assess("kenaf", FLIGHT, friction=Decimal("0.5"))


def test_robots_and_stairs_cannot_be_made_unphysical():
    kenaf = Robot.named("kenaf").model_dump()
    for field in ("com_height", "com_from_front"):
        for value in (math.nan, math.inf, -5.0, 71.0, "0.071", True, None):
            with pytest.raises(InputError):
                Robot.model_validate(kenaf | {field: value})
