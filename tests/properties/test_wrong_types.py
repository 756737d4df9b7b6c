"""Arguments of a wrong type, and unknown ones, for every public function: InputError, one line.

What they must give is stated by hand where a value has a meaning for nobody; anything else may be
an answer too, as a text is a spelling of a number.
"""

import inspect

import pytest

import kaidan
from kaidan import InputError, KaidanError, Stairs, lab
from kaidan.errors import LONGEST

LOW = Stairs(name="low", rise=0.1, going=0.3, steps=3)
STEEP = Stairs.inclined(angle=0.6, nosing_spacing=0.15)
FAST = {"model": "closed-form", "friction": 1.0}
PAIR = {
    "flat_length": 0.47, "com_from_uphill": 0.196, "com_height": 0.071, "angle": 0.6,
    "nosing_spacing": 0.15, "friction": 2.0, "acceleration": 0.1, "theta_d": 0.0, "theta_M": 0.0,
    "theta_d_spare": 0.0, "theta_M_spare": 0.0,
}  # fmt: skip
SOUND = {
    "assess": {"robot": "absolem", "stairs": STEEP, "flippers": "flat", **FAST},
    "posture": {"robot": "absolem", "stairs": LOW, "friction": 1.0},
    "traverse": {"robot": "kenaf", "stairs": LOW, "friction": 1.0},
    "margin": {"robot": "kenaf"},
    "plane": {"robot": "kenaf", "stairs": STEEP, "friction": 1.0},
    "compare": {"robots": ["kenaf"], "stairs": [LOW], **FAST},
    "building": {"file": "nowhere.ifc", "robots": ["kenaf"], "friction": 1.0},
    "design": {"robot": "kenaf", "stairs": STEEP, "free": {"com_height": (0.05, 0.1)}, "tries": 3,
               **FAST},
    "report": {"robots": "kenaf", "stairs": STEEP, **FAST},
    "doctor": {},
    "reproduce": {},
    "known_outcomes": {},
    "agree": {"robot": "nowhere", "stairs": LOW},
    "experiment": {"robot": "kenaf", "angles": "none"},
    "sensitivity": {"robot": "kenaf", "stairs": STEEP, "samples": 8, **FAST,
                    "uncertainty": "com_height=5mm"},
    "sweep": {"robot": "kenaf", "stairs": STEEP, **FAST},
    "verdicts": {"inputs": PAIR},
    "stream": {"chunks": []},
    "monitor": {"robot": "kenaf", "stairs": STEEP, "samples": []},
    "read": {"file": "nowhere.urdf"},
    "measure_robot": {"flat_length": "500mm", "front_scale": "5kg", "rear_scale": "6kg"},
    "measure_stairs": {"total_rise": "1700mm", "total_going": "2900mm", "risers": 10},
}  # fmt: skip
"""Of each public function arguments that it takes, or that it refuses for one reason."""


class Unwritable:
    def __repr__(self):
        raise RuntimeError("no text of it")


def nested(depth):
    made = []
    for _ in range(depth):
        made = [made]
    return made


LOOP = []
LOOP.append(LOOP)
ODD = {
    "1": 1, "1.5": 1.5, "text": "x", "bytes": b"x", "list": [1], "table": {1: 2}, "None": None,
    "digits": 10**5000, "nested": nested(100_000), "loop": LOOP, "object": Unwritable(),
}  # fmt: skip


def verbs():
    functions = {name: getattr(house, name) for house in (kaidan, lab) for name in house.__all__}
    return {name: each for name, each in functions.items() if inspect.isfunction(each)}


def put(name, /, **given):
    """One line, or an answer."""
    try:
        answer = verbs()[name](**SOUND[name] | given)
        list(answer) if name == "stream" else None
    except KaidanError as error:
        text = str(error)
        assert text.isprintable(), "one line, nothing that steers a terminal"
        assert len(text) < 300
        assert len(text) <= LONGEST
        return text
    return ""


def test_every_public_function_is_here():
    assert set(verbs()) == set(SOUND)


CALLS = [
    (name, parameter)
    for name, function in verbs().items()
    for parameter, each in inspect.signature(function).parameters.items()
    if each.kind is not inspect.Parameter.VAR_KEYWORD and parameter not in ("store", "workers")
]


@pytest.mark.parametrize(("name", "parameter"), CALLS)
def test_arguments_of_any_type(name, parameter):
    for value in ODD.values():
        put(name, **{parameter: value})


MANNER = [
    each for each in inspect.signature(kaidan.Question.of).parameters
    if each not in ("robot", "stairs", "trials")
]  # fmt: skip


@pytest.mark.parametrize("parameter", MANNER)
@pytest.mark.parametrize("name", ["assess", "sweep"])
def test_the_manner_of_a_question(name, parameter):
    given = {"surface": {"friction": None}}.get(parameter, {})
    for value in ODD.values():
        put(name, **given | {parameter: value})


@pytest.mark.parametrize("name", SOUND)
def test_an_unknown_argument_is_refused(name):
    assert "frictoin" in put(name, frictoin=1)


@pytest.mark.parametrize(
    ("name", "given", "text"),
    [
        ("assess", {"frictoin": 1}, "question: 'frictoin' is not known; did you mean friction?"),
        ("posture", {"limit": 1}, "question: 'limit' is not known"),
        ("compare", {"robot": 1}, "multiple values for argument 'robot'"),
        ("read", {"joint": 1}, "read: 'joint' is not known; did you mean joints?"),
        ("read", {"joints": 1}, "joints = 1 is not a list"),
        ("measure_stairs", {"rises": 0.1}, "rises = 0.1 is not a list"),
        ("margin", {"points": 1.5}, "points = 1.5 is not a whole number within 2 to 100000"),
        ("design", {"free": [1]}, "free = [1] is not a table of names and values"),
        ("compare", {"robots": "kenaf"}, "robots = 'kenaf' is not a list"),
        ("assess", {"friction": 10**5000}, "friction = inf is not a finite number"),
        ("assess", {"yaw": 10**5000},
         "yaw = a number of more than 300 digits is beyond any figure"),
        ("plane", {"accelerate": "no"}, "accelerate = 'no' is neither true nor false"),
    ],
)  # fmt: skip
def test_what_is_said(name, given, text):
    assert text in put(name, **given)


def test_a_missing_argument_is_said():
    with pytest.raises(InputError, match=r"measure_stairs\(\) missing 1 required keyword-only"):
        kaidan.measure_stairs(total_rise="2m", total_going="3m")


def test_a_type_error_within_a_function_stays_one(monkeypatch):
    """Only what the caller wrote is an input: a fault of kaidan's own must not look like one."""

    def broken(*_, **__):
        raise TypeError("a fault")

    monkeypatch.setattr("kaidan.assessment.answer_to", broken)
    with pytest.raises(TypeError, match="a fault"):
        kaidan.assess("kenaf", STEEP)
