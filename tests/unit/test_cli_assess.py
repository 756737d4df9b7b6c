"""`kaidan assess` on the command line: exit codes, options, refusals to the letter, the page.

Most pages are the closed form's, whose figures follow by hand; the default, the contact model, has
its own.
"""

import io
import json
import math
import os
import signal
import subprocess
import sys
import time

import pytest
from typer.testing import CliRunner

from kaidan import Payload, Posture, Robot, Stairs, Surface, assess
from kaidan.cli import app
from kaidan.cli import run as command_line
from kaidan.cli import run as ended_with
from kaidan.modes import Verdict

KENAF_40 = ["kenaf", "--angle", "40deg", "--nosing-spacing", "150mm"]
GRIP = ["--friction", "2"]
CLOSED = ["--model", "closed-form"]


def run(*words):
    """As `by_default`, by the closed form."""
    return by_default(*CLOSED, *words)


def by_default(*words):
    """Exit code and standard output; whatever else is raised is the test's to see."""
    result = CliRunner().invoke(app, ["assess", *words])
    if result.exception and not isinstance(result.exception, SystemExit):
        raise result.exception
    return result.exit_code, result.stdout


def run_json(*words):
    code, text = run(*words, "--json")
    document = json.loads(text)
    assert code == Verdict(document["verdict"]).exit_code
    return document


def refusal(capsys, monkeypatch, *words):
    """One line on standard error and exit code 2, through `main` as a shell would."""
    monkeypatch.setattr(sys, "argv", ["kaidan", "assess", *words])
    ended = ended_with(sys.argv[1:])
    shown = capsys.readouterr()
    assert ended == 2
    assert shown.out == ""
    assert shown.err.startswith("kaidan: ")
    assert shown.err.count("\n") == 1
    return shown.err.removeprefix("kaidan: ").rstrip("\n")


def flight(angle, p, **more):
    return Stairs.inclined(angle=math.radians(angle), nosing_spacing=p, **more)


# Exit codes


@pytest.mark.parametrize(
    ("angle", "word", "code"), [("40deg", "GO", 0), ("56deg", "UNSURE", 5), ("62deg", "NO-GO", 1)]
)
def test_exit_codes(angle, word, code):
    words = ["kenaf", "--angle", angle, "--nosing-spacing", "150mm", *GRIP]
    for extra in ([], ["--json"]):
        assert run(*words, *extra)[0] == code
    assert run(*words)[1].split()[0] == word


def test_rough_is_four():
    """Between the paper's 60.2 deg and grade two's 62.5 deg the next nosing arrests a rotation."""
    words = ["kenaf", "--angle", "61.5deg", "--nosing-spacing", "150mm", "--friction", "3"]
    code, said = by_default(*words, "--fall-reserve", "0deg")
    assert (code, said.split()[0]) == (4, "ROUGH")


def test_outside_the_model_is_three():
    for extra in ([], ["--json"]):
        assert run("kenaf", "ibc", *extra)[0] == 3
    assert run("kenaf", "ibc")[1].startswith("OUTSIDE THE MODEL  kenaf on ibc, up nose first\n")


@pytest.mark.parametrize(
    "words",
    [
        [],
        ["kenaf", "ibc", "more"],
        ["kenaf", "ibc", "--nonsense"],
        ["kenaf", "ibc", "--risk", "often"],
        ["kenaf", "--rise", "180mm", "--going", "280mm", "--steps", "many"],
        ["kenaf", "ibc", "--friction"],
    ],
)
def test_usage_errors_are_two(words):
    result = CliRunner().invoke(app, ["assess", *words])
    assert result.exit_code == 2
    assert result.stdout == ""
    assert "Error: " in result.stderr


# One JSON object, the same as from Python


def test_json_is_the_answer_of_the_api():
    code, text = run(*KENAF_40, *GRIP, "--json")
    assert (code, text[0], text[-2:]) == (0, "{", "}\n")
    flat = assess("kenaf", flight(40, 0.15), friction=2.0, model="closed-form")
    assert text == flat.to_json() + "\n"
    assert by_default(*KENAF_40, *GRIP, "--json") == by_default(
        *KENAF_40, *GRIP, "--model", "contact", "--json"
    )
    answer = assess("kenaf", flight(40, 0.15), friction=2.0)
    assert by_default(*KENAF_40, *GRIP, "--json")[1] == answer.to_json() + "\n"
    assert answer.model == "contact"


def test_every_option_reaches_the_question():
    sheet = Robot.named("absolem").model_dump()
    sheet["track"]["flat_length"] = 0.5
    sheet |= {"mass": 40.0, "com_height": 0.1, "com_from_front": 0.25}
    sheet["uncertainty"] = {"com_from_front": 0.005, "flat_length": 0.001, "com_height": 0.002}
    stairs = flight(25, 0.2, steps=9).model_dump()
    stairs["uncertainty"] = {"angle": math.radians(0.5), "nosing_spacing": 0.001}
    expected = assess(
        Robot.model_validate(sheet),
        Stairs.model_validate(stairs),
        surface=Surface(
            name="friction 0.6..1.1",
            friction_low=0.6,
            friction_high=1.1,
            friction_uncertainty=0.05,
        ),
        acceleration=-0.25,
        speed=0.3,
        direction="down",
        facing="tail-first",
        flippers=Posture(front=math.radians(20), rear="flat"),
        payload=[
            Payload(mass=5, from_front=0.2, height=0.3),
            Payload(mass=0.5, from_front=-0.01, height=0.2),
        ],
        theta_d=(math.radians(1), math.radians(2)),
        theta_M=math.radians(0.5),
        risk=0.05,
        model="closed-form",
    )
    words = """absolem --angle 25deg --nosing-spacing 20cm --steps 9 --friction 0.6..1.1
        --acceleration -0.25m/s2 --speed 30cm/s --direction down --facing tail-first
        --flippers 20deg,flat --payload 5kg@200mm,300mm --payload 500g@-1cm,0.2m
        --theta-d 1deg..2deg --theta-m 0.5deg --risk 0.05 --model closed-form
        --override com_height=100mm,mass=40kg --override flat_length=0.5m
        --override com_from_front=250mm
        --uncertainty com_from_front=5mm,com_height=2mm --uncertainty flat_length=1mm
        --uncertainty angle=0.5deg,nosing_spacing=1mm,friction=0.05"""
    found, expected = run_json(*words.split()), json.loads(expected.to_json())
    assert set(found) == set(expected)
    for name, value in expected.items():
        assert_close(found[name], value, name)


def assert_close(found, expected, name):
    """Equal to what degrees and millimetres cost in rounding on their way in."""
    if isinstance(expected, dict):
        assert set(found) == set(expected)
        for key, value in expected.items():
            assert_close(found[key], value, f"{name}.{key}")
    elif isinstance(expected, list):
        assert len(found) == len(expected)
        for index, (one, other) in enumerate(zip(found, expected, strict=True)):
            assert_close(one, other, f"{name}[{index}]")
    elif isinstance(expected, float):
        assert found == pytest.approx(expected, rel=1e-9, abs=1e-9), name
    else:
        assert found == expected, name


@pytest.mark.parametrize(
    "words",
    [
        ["--rise", "7in", "--going", "11in"],
        ["--rise", "177.8mm", "--going", "27.94cm"],
        ["--angle", "32.471192290848492deg", "--nosing-spacing", "331.17548218429455mm"],
    ],
)
def test_both_spellings_of_stairs(words):
    found = run_json("absolem", *words, "--flippers", "flat", *GRIP)
    assert found["angle_deg"] == pytest.approx(math.degrees(math.atan2(7, 11)), abs=1e-6)
    assert found["nosing_spacing_m"] == pytest.approx(math.hypot(7, 11) * 0.0254, abs=1e-9)


def test_files_work_like_names(tmp_path):
    robot, stairs, ground = (tmp_path / name for name in ("r.toml", "with space é.toml", "g.toml"))
    robot.write_text(Robot.named("kenaf").to_toml(), encoding="utf-8")
    stairs.write_text(
        f'rises = {[0.1] * 6}\ngoings = {[0.12] * 5}\nname = "treppe 階段"',
        encoding="utf-8",
    )
    ground.write_text('name = "ground"\nfriction_low = 1.5\nfriction_high = 2.0', encoding="utf-8")
    found = run_json(str(robot), str(stairs), "--surface", str(ground))
    names = [found["question"][name]["name"] for name in ("robot", "terrain", "surface")]
    assert names == ["kenaf", "treppe 階段", "ground"]
    assert found["verdict"] == "go"
    assert "kenaf on treppe 階段" in run(str(robot), str(stairs))[1]


# The page for people


def rows(text):
    """Rows of a page by their names."""
    return {line[2:18].strip(): line[18:] for line in text.splitlines()[1:] if line[2:3].strip()}


def test_the_answer_fits_on_a_screen_with_the_verdict_first():
    lines = run(*KENAF_40, *GRIP)[1].splitlines()
    # hand: atan(124/71) - 40 less the sheet's 2.65 + 2.65 (at best 2.55 + 1.15) = 14.9
    # (16.5); tan 40 = 0.84
    assert lines[0] == "GO  kenaf on 40 deg at 150 mm, up nose first"
    assert lines[1] == (
        "  It holds with 14.9 deg to spare; nearest is tipping over its downhill end."
    )
    found = rows("\n".join(lines[1:]))
    assert found == {
        "margin": "+14.9 deg (tip_downhill) in the worst case, +16.5 deg in the best, on 40.0 deg, "
        "150 mm from nosing to nosing",
        "friction": "0.84 required, 2.00 stated",
        "not known": "the drive's traction: measure it",
    }
    code, text = run(*KENAF_40, *GRIP, "--direction", "down", "--flippers", "stowed")
    assert code == 1
    assert text.startswith("NO-GO  kenaf on 40 deg at 150 mm, down nose first\n")
    assert rows(text)["do"] == "Go down tail first: GO (+17.6 deg)"
    assert rows(text)["not known"] == "the drive's traction: measure it"


def test_the_answer_in_one_line():
    assert run(*KENAF_40, *GRIP, "--short")[1] == (
        "GO  kenaf on 40 deg at 150 mm, up nose first  +14.9 deg  tip_downhill\n"
    )


def test_the_details_are_all_that_was_found():
    text = run(*KENAF_40, *GRIP, "--details")[1]
    # hand: 124 - 71 tan 45.3 deg = 52.3; g (124/71 cos 45.3 - sin 45.3) = 5.08;
    # -g (46/71 cos 37.35 + sin 37.35) = -11.00; atan 2 - 40 = 23.4
    found = rows(text)
    assert found["stairs"] == "40.0 deg, 150 mm from nosing to nosing"
    assert found["margin"] == "+14.9 deg (tip_downhill) in the worst case, +16.5 deg in the best"
    assert found["allowances"].startswith("theta_d 2.6 to 2.6 deg (measured), theta_M 1.1 to 2.6")
    assert found["tip_downhill"] == "+14.9 deg, at best +16.5 (tipping over its downhill end)"
    assert found["slides_down"] == "+23.4 deg (sliding down for lack of friction)"
    assert found["drive"] == "not known (too little traction of the drive)"
    assert found["limit"] == "tips beyond 60.2 deg"
    assert found["acceleration"] == "safe from -11.00 to +5.08 m/s2 up the stairs, area D"
    assert "max. start acceleration 5.08 m/s2; max. braking 11.00 m/s2" in text
    assert found["centroid"] == "+52 mm along the track"
    assert found["friction"] == "0.84 required, 2.00 stated"
    assert found["load"].endswith("highest to lowest, as the lowest one leaves")
    assert "What would help" not in text
    down = run(*KENAF_40, *GRIP, "--direction", "down", "--details", "--flippers", "stowed")[1]
    assert "\n    Go down tail first: GO (+17.6 deg)\n" in down
    found = run(*KENAF_40, *GRIP, "--direction", "down", "--details")[1]
    assert found.startswith("GO  kenaf on 40 deg at 150 mm, down tail first\n")
    assert "\n    Go tail first\n" in found
    assert "\n    Nose first was tried too and is no better." in found


def test_the_details_without_numbers_that_are_not_known():
    outside = run("kenaf", "ibc", "--details")[1]
    assert rows(outside)["margin"] == "not known"
    assert rows(outside)["friction"] == "0.64 required, none stated"
    assert "acceleration" not in rows(outside)
    steep = run(
        *["kenaf", "--angle", "80deg", "--nosing-spacing", "150mm", *GRIP, "--details"],
        *["--theta-d", "17deg", "--theta-m", "17deg"],
    )[1]
    assert "centroid" not in rows(steep)
    assert "Friction is in doubt too: 5.67 is required, 2.00 is stated." in steep
    empty = ["kenaf", "--angle", "10deg", "--nosing-spacing", "220mm", "--friction", "0.2"]
    found = rows(run(*empty, "--details")[1])
    assert found["acceleration"] == "none is safe throughout, area C"
    doubt = run(*KENAF_40, *GRIP, "--uncertainty", "com_height=5mm", "--risk", "0.05", "--details")
    assert rows(doubt[1])["uncertain"].startswith("95 % of margins within ")
    assert rows(doubt[1])["uncertain"].endswith("(accepted: 0.05)")


@pytest.mark.parametrize("columns", ["20", "0", "-5", "x"])
def test_any_width_of_the_screen(monkeypatch, columns):
    monkeypatch.setenv("COLUMNS", columns)
    assert run(*KENAF_40, *GRIP)[1].startswith("GO  kenaf on 40 deg at 150 mm")


def test_names_cannot_steer_the_screen_or_fake_a_line(tmp_path):
    path = tmp_path / "odd.toml"
    odd = '"\\u001b[31m\\nGO\\u0007 \\u009b2J"'
    path.write_text(
        f"name = {odd}\ncom_from_front = 0.196\ncom_height = 0.071\nnotes = {odd}\n"
        "[track]\nflat_length = 0.47\n",
        encoding="utf-8",
    )
    text = run(str(path), "ibc")[1]
    assert text.startswith("OUTSIDE THE MODEL  ")
    assert " on ibc" in text.splitlines()[0]
    assert all(character.isprintable() or character == "\n" for character in text)
    robot = json.loads(run(str(path), "ibc", "--json")[1])["question"]["robot"]
    assert robot["name"] == "\x1b[31m\nGO\x07 \x9b2J"


# Refusals, to the letter


REFUSALS = {
    "no unit": (
        ["kenaf", "--rise", "180", "--going", "280mm"],
        "--rise '180' has no unit; write 180mm or 180cm or 180m",
    ),
    "no unit of angle": (
        ["kenaf", "--angle", "40", "--nosing-spacing", "150mm"],
        "--angle '40' has no unit; write 40deg or 40° or 40rad",
    ),
    "no unit of acceleration": (
        [*KENAF_40, "--acceleration", "0.5"],
        "acceleration '0.5' has no unit; write 0.5m/s2 or 0.5m/s^2 or 0.5g0",
    ),
    "no unit of speed": (
        [*KENAF_40, "--speed", "0.1"],
        "speed '0.1' has no unit; write 0.1mm/s or 0.1cm/s or 0.1m/s",
    ),
    "unit of something else": (
        ["kenaf", "--rise", "180kg", "--going", "280mm"],
        "--rise '180kg': 'kg' is no unit of length; known: mm, cm, m, in, ft",
    ),
    "millimetres": (
        ["kenaf", "--rise", "180m", "--going", "280m"],
        "stairs: rise = 180 m is not within 0.02 to 0.6 m (in millimetres? that would be 0.18 m); "
        "stairs: going = 280 m is not within 0.02 to 2.5 m (in millimetres? that would be 0.28 m)",
    ),
    "no stairs": (
        ["kenaf"],
        "no stairs: give a catalogue name (kaidan stairs), a TOML file, --rise with --going, or "
        "--angle with --nosing-spacing",
    ),
    "half stairs": (
        ["kenaf", "--rise", "180mm", "--angle", "30deg"],
        "no stairs: give a catalogue name (kaidan stairs), a TOML file, --rise with --going, or "
        "--angle with --nosing-spacing",
    ),
    "both stairs": (
        ["kenaf", "ibc", "--rise", "180mm"],
        "give either the stairs 'ibc' or --rise, not both",
    ),
    "steps of a name": (
        ["kenaf", "ibc", "--steps", "5"],
        "give either the stairs 'ibc' or --steps, not both",
    ),
    "angle": (
        ["kenaf", "--angle", "-5deg", "--nosing-spacing", "150mm"],
        "--angle '-5deg' is not within 0 to 89 deg",
    ),
    "friction": (
        [*KENAF_40, "--friction", "nan"],
        "friction 'nan' is not a plain number such as 0.8",
    ),
    "friction negative": (
        [*KENAF_40, "--friction", "-0.5"],
        "friction = -0.5 is not within 0 to 5",
    ),
    "friction backwards": (
        [*KENAF_40, "--friction", "1.0..0.6"],
        "friction '1.0..0.6': the low end of a range comes first",
    ),
    "half a range": (
        [*KENAF_40, "--friction", "0.6.."],
        "friction '0.6..': a range has two ends, LOW..HIGH",
    ),
    "surface and friction": (
        [*KENAF_40, "--friction", "0.6", "--surface", "concrete-dry"],
        "give either a surface or a friction, not both",
    ),
    "payload": (
        ["absolem", "ibc", "--payload", "5kg"],
        "payload '5kg': write MASS@BEHIND_FRONT,HEIGHT, for example 5kg@200mm,300mm",
    ),
    "payload without units": (
        ["absolem", "ibc", "--payload", "5@200mm,300mm"],
        "payload '5' has no unit; write 5g or 5kg or 5lb",
    ),
    "payload of a robot without mass": (
        [*KENAF_40, "--payload", "5kg@200mm,300mm"],
        "robot 'kenaf': mass is not published, so a payload cannot be placed; give the robot's "
        "mass",
    ),
    "set": (
        [*KENAF_40, "--override", "height=5mm"],
        "override 'height' is not known; did you mean com_height? Write NAME=VALUE with a name of "
        "com_from_front, "
        "com_height, flat_length, gauge, mass",
    ),
    "set twice": (
        [*KENAF_40, "--override", "mass=5kg", "--override", "mass=6kg"],
        "override mass is given twice",
    ),
    "set outside": (
        [*KENAF_40, "--override", "com_from_front=2m"],
        "robot: com_from_front = 2 m puts the centroid outside the robot: allowed -0.065 to "
        "0.535 m",
    ),
    "uncertainty": (
        [*KENAF_40, "--uncertainty", "tread=5mm"],
        "uncertainty 'tread' is not known; write NAME=VALUE with a name of com_from_front, "
        "com_height, flat_length, angle, nosing_spacing, rise, going, friction",
    ),
    "uncertainty of no friction": (
        [*KENAF_40, "--uncertainty", "friction=0.1"],
        "uncertainty of friction needs a friction or a surface",
    ),
    "flippers": (
        ["absolem", "ibc", "--flippers", "20deg"],
        "flippers '20deg' is one angle for two pairs; write FRONT,REAR, for example 20deg,-5deg",
    ),
    "no flippers": ([*KENAF_40, "--flippers", "flat"], "robot 'kenaf' has no flippers"),
    "theta_d": (
        [*KENAF_40, "--theta-d", "50deg"],
        "theta_d: allowance: high = 0.872664625997 rad is not within 0 to 0.6 rad (in degrees? "
        "that would be 0.0152309 rad)",
    ),
    "direction": (
        [*KENAF_40, "--direction", "Up"],
        "direction = 'Up' is not known; known: up, down",
    ),
    "facing": (
        [*KENAF_40, "--facing", "sideways"],
        "facing = 'sideways' is not known; known: nose-first, tail-first",
    ),
    "model": (
        [*KENAF_40, "--model", "luck"],
        "model = 'luck' is not known; known: contact, closed-form, support-polygon, physics",
    ),
    "risk": ([*KENAF_40, "--risk", "0"], "question: risk = 0 is not within 0.0001 to 0.5"),
    "risk nan": ([*KENAF_40, "--risk", "nan"], "question: risk = nan is not within 0.0001 to 0.5"),
    "acceleration": (
        [*KENAF_40, "--acceleration", "-2g0"],
        "question: acceleration = -19.6133 m/s^2 is not within -9.8 to 9.8 m/s^2",
    ),
    "speed": (
        ["absolem", "ibc", "--speed", "1m/s"],
        "speed = 1 is not within 0 to 0.4 m/s, the most absolem can do",
    ),
    "robot": (
        ["kenav", "ibc"],
        "no robot is called 'kenav' and no such file exists. Did you mean 'kenaf'? Known: "
        "absolem, absolem-flat, csiro-dtr, kenaf, marmotte, marv, ozbot-atr, packbot-510, quince, "
        "superdroid-hd2, talon, taurob-tracker.",
    ),
    "folder": (["/", "ibc"], "/: cannot be read: a folder, not a TOML file"),
    "endless": (["/dev/zero", "ibc"], "/dev/zero: cannot be read: not a regular file"),
}


@pytest.mark.parametrize("name", REFUSALS)
def test_refusals(name, capsys, monkeypatch):
    words, text = REFUSALS[name]
    assert refusal(capsys, monkeypatch, *words) == text
    assert refusal(capsys, monkeypatch, *words, "--json") == text


# As a process


def process(*words, **more):
    command = [sys.executable, "-m", "kaidan", "assess", *words]
    return subprocess.run(command, capture_output=True, timeout=60, check=False, **more)


def test_as_a_process():
    done = process(*KENAF_40, *GRIP, "--json")
    assert (done.returncode, done.stderr) == (0, b"")
    assert json.loads(done.stdout)["verdict"] == "go"
    done = process("kenaf", "nowhere")
    assert (done.returncode, done.stdout) == (2, b"")
    assert done.stderr.startswith(b"kaidan: no staircase is called 'nowhere'")
    assert done.stderr.count(b"\n") == 1


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["kenaf", "ibc", *CLOSED], 3),
        # hand: before the first nosing bears it, the centroid would have to lie over it:
        # 178 / sin(phi) = 274 - 71 tan(phi), which no phi solves (45 deg: 252 > 203)
        (["kenaf", "ibc"], 1),
        (["kenaf", "ibc", "--nonsense"], 2),
    ],
)
def test_exit_codes_of_the_process(words, code, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["kaidan", "assess", *words])
    ended = ended_with(sys.argv[1:])
    assert ended == code
    assert (capsys.readouterr().out == "") is (code == 2)


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "utf-8"])
def test_any_encoding_of_the_screen(encoding, tmp_path, monkeypatch):
    path = tmp_path / "odd.toml"
    sheet = Robot.named("kenaf").model_dump(exclude_none=True) | {"name": "Käfer 階段"}
    path.write_text(Robot.model_validate(sheet).to_toml(), encoding="utf-8")
    words = [str(path), *KENAF_40[1:], *GRIP]

    def printed(*words):
        screen = io.TextIOWrapper(io.BytesIO(), encoding, errors="strict")
        with monkeypatch.context() as patch:
            patch.setattr(sys, "stdout", screen)
            assert command_line(["assess", *words]) == 0
        return screen.buffer.getvalue()

    assert printed(*words).startswith(b"GO  K")
    document = json.loads(printed(*words, "--json"))
    assert document["question"]["robot"]["name"] == "Käfer 階段"
    if encoding == "ascii":
        done = process(*words, env=os.environ | {"PYTHONIOENCODING": "ascii:strict"})
        assert (done.returncode, done.stderr) == (0, b"")
        assert done.stdout == printed(*words)


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
def test_a_full_disk_is_no_verdict():
    with open("/dev/full", "wb") as full:
        command = [sys.executable, "-m", "kaidan", "assess"]
        done = subprocess.run(
            [*command, *KENAF_40, *GRIP, "--json"],
            stdout=full,
            stderr=subprocess.PIPE,
            timeout=60,
            check=False,
        )
    assert done.returncode == 2
    assert done.stderr == (b"kaidan: the answer cannot be written: No space left on device\n")


def test_it_writes_nothing_anywhere(tmp_path, monkeypatch):
    """Killed or refused or answered: the folder stays as it was."""
    monkeypatch.chdir(tmp_path)
    for words in (["kenaf", "nowhere"], [*KENAF_40, "--friction", "x"]):
        assert command_line(["assess", *words]) == 2
    process("kenaf", "ibc")
    command = [
        sys.executable,
        "-c",
        "from kaidan.__main__ import main; main()",
        "assess",
        *KENAF_40,
    ]
    running = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    time.sleep(0.05)
    running.send_signal(signal.SIGKILL)
    running.wait(timeout=60)
    assert list(tmp_path.iterdir()) == []


def test_points_that_are_no_stairs_and_points_that_are_not_built_across(tmp_path):
    """A floor has no stairs, exit code 3; of blocks somebody has to say what lies beside them."""

    def asked(points, *words):
        file = tmp_path / "profile.csv"
        file.write_text("x,z\n" + "".join(f"{x},{z}\n" for x, z in points))
        manner = ["--friction", "1", "--flippers", "flat"]
        code, text = by_default("absolem", "--points", str(file), *manner, *words)
        return code, text.splitlines()[0].split("  ")[0]

    floor = [(-3, 0), (3, 0)]
    blocks = [(-3, 0), (0, 0), (0, 0.05), (0.2, 0.05), (0.2, 0.01), (0.4, 0.01), (0.4, 0.06)]
    blocks += [(0.6, 0.06), (0.6, 0), (3, 0)]
    assert asked(floor) == (3, "OUTSIDE THE MODEL")
    assert asked(blocks) == (5, "UNSURE")
    assert asked(blocks, "--uniform-across") == (0, "GO")
