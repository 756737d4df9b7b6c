"""Random calls of what is public: an answer, or one line that says what is wrong.

From Python the only exceptions are kaidan's own; the command ends with its exit codes and never
with 70. Some values make sense and most do not, so that a call gets past its first argument.
"""

import io
import math
import random
import sys
import warnings
from contextlib import redirect_stderr, redirect_stdout
from inspect import signature
from pathlib import Path
from traceback import format_exc

import numpy as np
import pytest

import kaidan
from kaidan import Payload, Posture, Profile, Question, Robot, Stairs, Surface, units
from kaidan.allowance import Allowance
from kaidan.cli import app_for, run
from kaidan.errors import KaidanError
from kaidan.lab.campaign.plans import plan_from
from kaidan.modes import Verdict
from kaidan.sweeps.pairs import INPUTS as SYMBOLS
from kaidan.work.query import state_of

FLIGHT = Stairs.inclined(angle=0.6, nosing_spacing=0.15)
KENAF, ABSOLEM = Robot.named("kenaf"), Robot.named("absolem")
LONG = "x" * 10_000
NUMBERS = [0, 1, -1, 2, 0.5, 1e-9, 1e9, -0.0, 1e308, 10**400, math.nan, math.inf, -math.inf]
THINGS = [None, True, False, [], {}, (), set(), b"x", object(), len, float, ..., 1j, range(3)]
ARRAYS = [np.array([]), np.array([1.0, 2.0]), np.float32(0.5), np.bool_(True), np.array("x")]
# fmt: off
TEXTS = ["", " ", "x", "flat", "up", "nan", "inf", "0,8", "1..0", "..", "1-", "\x00", "\ud800",
         "a\nb", "\x1b[31m", LONG, "9" * 5000, "é", "-1", "../..", "/", "~", "x.toml", "-", "--",
         "1e400m", "5 ft/s", "7 1/0in", "kenaf", "ibc", "concrete-dry", "+", "ibc+", "=", "a=b"]
# fmt: on
GOOD = {
    "robot": ["kenaf", "absolem", KENAF, ABSOLEM],
    "stairs": ["ibc", FLIGHT, "ibc+ada", [FLIGHT, FLIGHT], "nist-arena"],
    "surface": ["concrete-dry", Surface.of_friction(0.8)],
    "friction": [0.8, (0.6, 1.0), "0.6..1.0", "0.6 to 1.0", "1"],
    "length": ["180mm", 0.18, "7 1/2in", '11"', "0.3 m"],
    "angle": ["35deg", 0.6, "20°", "-5deg", 0],
    "acceleration": ["0.3m/s2", 0.0, -0.5, "0.05g0"],
    "speed": ["0.1m/s", 0.2, "0.5km/h"],
    "flippers": ["stowed", "flat", "20deg,-5deg", "20deg", Posture()],
    "payload": ["2kg@200mm,300mm", Payload(mass=1, from_front=0.2, height=0.1), ()],
    "allowance": [0.01, (0.0, 0.04), "1..2.6deg", "1deg", None],
    "direction": ["up", "down"],
    "facing": ["nose-first", "tail-first"],
    "model": ["contact", "closed-form", "support-polygon"],
    "number": [0.5, 1, 2.0, "0.5"],
    "text": ["a", "kenaf", "180mm"],
    "points": [[(0, 0), (1, 0), (1, 0.18), (2, 0.18)], [[0, 0], [1, 1]]],
    "toml": ["rise = 0.18\ngoing = 0.28\n", 'rise = "180mm"\ngoing = "28cm"', KENAF.to_toml()],
    "override": ["com_height=80mm", {"com_height": 0.08}, ()],
    "uncertainty": ["angle=0.5deg,friction=0.05", {"com_height": 0.01}, ()],
    "kind": ["length", "angle", "number", "mass"],
    "json": ["{}", "[]", "null", "1", '{"question": 5}'],
}
INPUTS = dict.fromkeys([*SYMBOLS, "x"], "number")
MANNER = {
    **dict.fromkeys(("acceleration", "speed", "flippers", "payload", "direction", "facing")),
    **{name: name for name in ("friction", "surface", "model", "override")},
    **dict.fromkeys(("theta_d", "theta_M"), "allowance"),
    "yaw": "angle",
    "flipper_tolerance": "angle",
    "risk": "number",
    "uncertainty": "uncertainty",
}
MANNER = {name: kind or name for name, kind in MANNER.items()}
SHEETS = {
    Robot: {"name": "text", "com_from_front": "length", "com_height": "length", "mass": "number"},
    Stairs: {"rise": "length", "going": "length", "steps": "number", "rises": "points"},
    Surface: {"friction_low": "number", "friction_high": "number", "name": "text"},
    Payload: {"mass": "number", "from_front": "length", "height": "length"},
    Posture: {"front": "angle", "rear": "angle"},
    Allowance: {"low": "angle", "high": "angle"},
    Question: {"robot": "robot", "terrain": "stairs", "surface": "surface", "yaw": "angle"},
}

MEASURED_STAIRS = {
    **dict.fromkeys(("width", "lower_landing", "lower_passage", "upper_leaf"), "length"),
    **dict.fromkeys(("lower_turn", "upper_turn"), "text"),
    **dict.fromkeys(("first_rise", "last_rise", "u_tape"), "length"),
    "rises": "points",
    "goings": "points",
    "name": "text",
}
MEASURED_ROBOT = {
    **dict.fromkeys(("balance", "front_radius", "rear_inset"), "length"),
    **dict.fromkeys(("front_scale", "rear_scale", "mass", "front_on_slope"), "number"),
    **dict.fromkeys(("slope", "tips_at", "u_angle"), "angle"),
    "over": "text",
    "on": "text",
}


class Draw:
    """What a call is made of; the same for the same seed."""

    def __init__(self, seed):
        self.random = random.Random(seed)

    def of(self, kind):
        if self.random.random() < 0.85:
            return self.random.choice(GOOD[kind])
        return self.random.choice(self.random.choice([NUMBERS, THINGS, ARRAYS, TEXTS]))

    def some(self, kinds, most):
        names = self.random.sample(sorted(kinds), self.random.randint(0, min(most, len(kinds))))
        return {name: self.of(kinds[name]) for name in names}

    def mutated(self, text):
        """Text with some characters dropped, doubled or exchanged."""
        letters = list(text)
        for _ in range(self.random.randint(0, 4)):
            at = self.random.randrange(len(letters) + 1)
            letters[at : at + self.random.randint(0, 3)] = self.random.choice(
                ["", "=", "0", "-", ".", "[", '"', "\n", "e", " ", "\x00", "1" * 400]
            )
        return "".join(letters)

    # Calls from Python

    def call(self):
        """Function, positional and keyword arguments."""
        return self.random.choice(
            [self.sheet, self.sheet, self.constructor, self.parser, self.text, self.verb]
        )()

    def sheet(self):
        sheet = self.random.choice(list(SHEETS))
        fields = self.some(SHEETS[sheet], 4)
        if self.random.random() < 0.3:
            name = self.random.choice(sorted(sheet.model_fields))
            fields[name] = self.of("number")
        if sheet is Robot:
            fields.setdefault("track", {"flat_length": self.of("length")})
        return self.random.choice([(sheet, (), fields), (sheet.model_validate, (fields,), {})])

    def constructor(self):
        of = self.of
        return self.random.choice(
            [
                (Stairs.inclined, (), {"angle": of("angle"), "nosing_spacing": of("length")}),
                (Surface.of_friction, (of("friction"),), self.some({"uncertainty": "number"}, 1)),
                (Profile.of_points, (of("points"),), self.some({"name": "text"}, 1)),
                (Profile.of_flights, ([FLIGHT] * self.random.randint(0, 2),), {}),
                (Allowance.of, (of("allowance"),), {"name": "theta_d"}),
                (Question.of, (of("robot"), of("stairs")), self.some(MANNER, 4)),
                (Question.ask, (of("robot"), of("stairs")), self.some(MANNER, 4)),
                (KENAF.stance, (), {"payload": [Payload(mass=1, from_front=0.2, height=0.1)]}),
            ]
        )

    def parser(self):
        texts = [value for kind in GOOD.values() for value in kind if isinstance(value, str)]
        text = self.mutated(self.random.choice(texts + TEXTS))
        kind = self.random.choice(GOOD["kind"])
        return self.random.choice(
            [
                (units.parse, (text, kind), {"option": "--x"}),
                (units.parse_range, (text, kind), {"option": "--x"}),
                (units.range_of, (self.of("friction"), kind), {"option": "x"}),
                (units.value_of, (self.of("length"), kind), {"option": "x"}),
                (Posture.parse, (text, self.random.choice([KENAF, ABSOLEM])), {}),
                (Payload.parse, (text,), {}),
                *((sheet.named, (text,), {}) for sheet in (Robot, Stairs, Surface)),
            ]
        )

    def text(self):
        text = self.mutated(self.random.choice(GOOD["toml"] + TEXTS))
        of_json = self.mutated(self.random.choice(GOOD["json"]))
        return self.random.choice(
            [
                *(
                    (sheet.from_text, (text,), {"origin": "file"})
                    for sheet in (Robot, Stairs, Surface)
                ),
                (kaidan.Assessment.from_json, (of_json,), {}),
                (plan_from, (self.of("number"),), {}),
                (state_of, (self.random.choice(TEXTS),), {}),
            ]
        )

    def verb(self):
        robot, stairs = self.of("robot"), self.of("stairs")
        inputs = {"flat_length": 0.47, "com_from_uphill": 0.2, "com_height": 0.07, "angle": 0.6}
        inputs |= {"nosing_spacing": np.array([0.15, 0.2]), **self.some(INPUTS, 2)}
        flight = {"total_rise": self.of("length"), "total_going": self.of("length")}
        flight["risers"] = self.of("number")
        length = {"flat_length": self.of("length")}
        closed = {"model": "closed-form"} if self.random.random() < 0.7 else {}
        return self.random.choice(
            [
                (kaidan.assess, (robot, stairs), self.some(MANNER, 3) | closed),
                (kaidan.verdicts, (inputs,), {}),
                (kaidan.verdicts, (self.of("number"),), {}),
                (kaidan.sweep, (robot, stairs), self.some({"friction": "friction"}, 1)),
                (kaidan.monitor, (robot, stairs, self.of("points")), {}),
                (kaidan.measure_stairs, (), flight | self.some(MEASURED_STAIRS, 4)),
                (kaidan.measure_robot, (), length | self.some(MEASURED_ROBOT, 8)),
                (lambda chunks: list(kaidan.stream(chunks)), ([inputs, inputs],), {}),
            ]
        )

    # The command

    def words(self, folder):
        """Words of a command line; the commands that take seconds get a robot that is none."""
        slow = self.random.random() < 0.3
        path, command = self.random.choice(
            [each for each in COMMANDS if (each[0][0] in SLOW) == slow]
        )
        words = list(path)
        name, file = f"{self.random.randrange(FILES)}.toml", f"{self.random.randrange(FILES)}.csv"
        robots = (
            ["", LONG, "kenav", "ibc", "no/such", folder] if slow else ["kenaf", "absolem", name]
        )
        words += [self.random.choice(robots)] if slow or self.random.random() < 0.95 else []
        if path[0] in PLANNED and words[-1] == "absolem" and self.random.random() < 0.95:
            words[-1] = "kenaf"
        shape = ["--angle", "35deg", "--nosing-spacing", "150mm"]
        terrains = [
            ["ibc"],
            ["ibc+ada"],
            shape,
            shape,
            [],
            [LONG],
            [folder],
            [name],
            [f"ibc+{name}"],
        ]
        words += [] if path[0] in NO_TERRAIN else self.random.choice(terrains)
        words += [self.random.choice(["-", file])] if path[0] == "monitor" else []
        options = [each for each in command.params if each.opts[0] not in SLOW_OPTIONS]
        for option in self.random.sample(options, min(self.random.randint(0, 3), len(options))):
            if option.opts[0].startswith("--"):
                words += [option.opts[0], *([] if option.is_flag else [self.value(option.name)])]
        if self.random.random() < 0.1:
            words += ["--points", file] if path[0] in ("assess", "traverse") else []
        if self.random.random() < 0.1:
            words.insert(self.random.randint(1, len(words)), self.random.choice(TEXTS))
        return [word.encode("utf-8", "replace").decode().replace("\0", "0") for word in words]

    def value(self, name):
        """Text for an option: mostly of its kind."""
        given = self.of(OPTIONS.get(name, "text"))
        return given if isinstance(given, str) else repr(given)[:10_000]


OPTIONS = {
    **{name: kind for name, kind in MANNER.items() if name not in ("theta_d", "theta_M")},
    **dict.fromkeys(("rise", "going", "nosing_spacing", "start", "stop"), "length"),
    **dict.fromkeys(("angle", "theta_d", "theta_m", "alarm_margin", "clear_margin"), "angle"),
    **dict.fromkeys(("steps", "points", "horizon"), "number"),
}
RAW = "Input should"
"""How texts of pydantic begin, which speak of no option and no field."""
SLOW = ("experiment", "calibrate", "physics", "agree", "posture", "compare", "campaign")
PLANNED = ("report", "sensitivity")
"""Commands of seconds for the best plan of flippers; one in twenty is of a robot with any."""
NO_TERRAIN = ("margin", "robots", "stairs", "surfaces", "schema", "new")
FILES = 20
SLOW_OPTIONS = ("--follow", "--figure", "--animation", "--pose-map", "--scheduler", "--help")


def commands():
    """Every command of the command line with its options."""
    from typer.main import get_command

    for name, command in get_command(app_for(())).commands.items():
        if name in ("reproduce", "outcomes", "serve"):  # nothing to ask, or without end
            continue
        for inner, each in getattr(command, "commands", {"": command}).items():
            yield ((name, inner) if inner else (name,)), each


COMMANDS = list(commands())


def assert_one_line(text):
    assert text
    assert text.isprintable()
    assert len(text) < 300
    assert RAW not in text


def call_it(seed):
    """One call from Python: whatever it is, it ends well."""
    function, arguments, keywords = Draw(seed).call()
    given = f"{getattr(function, '__qualname__', function)} {arguments!r:.300} {keywords!r:.300}"
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            function(*arguments, **keywords)
    except KaidanError as error:
        assert_one_line(str(error))
        return False
    except Exception:
        pytest.fail(f"seed {seed}: {given}\n{format_exc()}")
    return True


def run_it(seed, folder):
    """One command line: an exit code, and one line if it is a refusal."""
    words = Draw(seed).words(str(folder))
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err), warnings.catch_warnings():
        warnings.simplefilter("error")
        code = run(words)
    said = f"seed {seed}: {words!r:.600}\nexit code {code}\n{err.getvalue():.3000}"
    assert code in {2, *(each.exit_code for each in Verdict)}, said
    if code == 2:
        assert out.getvalue() == "" or words[0] == "monitor", said  # which answers as it reads
        assert err.getvalue().startswith(("kaidan: ", "Usage: ")), said
        if err.getvalue().startswith("kaidan: "):
            assert err.getvalue().count("\n") == 1, said
            assert len(err.getvalue()) < 3_000, said
            assert RAW not in err.getvalue(), said
    return code


def litter(draw):
    """Files as people damage them, in the folder where commands run."""
    sheets = [*GOOD["toml"], Surface.of_friction("0.6..1.0").to_toml(), FLIGHT.to_toml()]
    tables = [
        "x,z\n0,0\n1,0\n1,0.18\n2,0.18\n",
        "t,inclination,inclination_rate,acceleration\n0,0.6,0,0\n1,0.7,0.1,0\n",
    ]
    for number in range(FILES):
        for texts, suffix in ((sheets, "toml"), (tables, "csv")):
            text = draw.mutated(draw.random.choice(texts))
            Path(f"{number}.{suffix}").write_text(text, encoding="utf-8")


def fuzz(seeds, folder, monkeypatch):
    monkeypatch.chdir(folder)
    monkeypatch.setenv("KAIDAN_DEBUG", "1")
    answered = codes = 0
    for seed in seeds:
        if seed % 500 == 0:
            litter(Draw(seed))
        monkeypatch.setattr(sys, "stdin", io.StringIO("time_s,inclination_deg\n0,x\n"))
        if seed % 4:
            answered += call_it(seed)
        else:
            codes += run_it(seed, folder) != 2
    # not everything is refused at the door
    assert answered > len(seeds) / 20
    assert codes > len(seeds) / 150  # many commands ask for files of their own


def test_random_calls_end_in_an_answer_or_in_one_line(tmp_path, monkeypatch):
    fuzz(range(400), tmp_path, monkeypatch)


@pytest.mark.slow
@pytest.mark.parametrize("part", range(10))
def test_100_000_random_calls(part, tmp_path, monkeypatch):
    fuzz(range(10_000 * part, 10_000 * (part + 1)), tmp_path, monkeypatch)


def test_every_public_name_that_can_be_called_is_among_them():
    """A new one is to be added to `Draw`."""
    drawn = {Draw(seed).call()[0] for seed in range(3_000)}
    owners = (getattr(each, "__self__", each) for each in drawn)
    names = {getattr(each, "__name__", "") for each in owners} | {"stream"}
    elsewhere = {
        "report",
        "posture",
        "traverse",
        "margin",
        "plane",
        "compare",
        "design",
        "sensitivity",
        "read",
        "building",
        "doctor",
    }  # seconds each, of files, or of nothing
    public = {name for name in kaidan.__all__ if callable(getattr(kaidan, name))}
    assert public - names - elsewhere == {"KaidanError", "InputError"}
    assert all(signature(getattr(kaidan, name)) for name in elsewhere)
