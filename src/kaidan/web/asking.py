"""What a client writes, as questions of the verbs: names of the catalogue and sheets, no path."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from inspect import Parameter, signature
from itertools import islice
from typing import TYPE_CHECKING, Any

from kaidan.answer import Answer, plain
from kaidan.arguments import refuse_unknown
from kaidan.errors import InputError, shown
from kaidan.question import Question
from kaidan.robot import Robot
from kaidan.web.keywords import READ, made, robot_of, sheet_of

if TYPE_CHECKING:
    from kaidan.verbs.report import Report

MOST_CELLS = 2_000
"""Largest sweep that is answered at once; a larger one is a job."""
MOST_RECORDED = 500_000
"""Most samples of a recording that is replayed: an hour at more than 100 Hz."""


@dataclass(frozen=True)
class Verb:
    """A verb as the service offers it."""

    function: str
    """Module and function, with a colon between."""
    answer: str
    """Module and class of what it answers."""
    required: tuple[str, ...] = ("robot", "stairs")
    """What a body must have, but for one with a whole question."""
    several: frozenset[str] = frozenset()
    """Keywords of which it takes a list."""
    open: bool = False
    """Whether its function looks after the names of keywords itself."""

    def load(self) -> Callable[..., Answer]:
        """Its function."""
        found: Callable[..., Answer] = _loaded(self.function)
        return found

    def answers(self) -> type[Answer]:
        """Class of what it answers."""
        found: type[Answer] = _loaded(self.answer)
        return found

    @cache  # noqa: B019 - there are no others than those below
    def parameters(self) -> Mapping[str, Parameter]:
        """Keywords that a body may have: those of its function, then those of a question."""
        own = signature(self.load()).parameters
        found = {name: each for name, each in own.items() if each.kind is not Parameter.VAR_KEYWORD}
        if len(found) < len(own):
            left_out = {"robot"} if "robots" in own else set()
            of = signature(Question.of).parameters
            found |= {name: each for name, each in of.items() if name not in {*found, *left_out}}
        return found

    @property
    def takes_question(self) -> bool:
        """Whether a whole question may stand in the place of robot and stairs."""
        return self.required == ("robot", "stairs")


def _loaded(place: str) -> Any:
    module, _, name = place.partition(":")
    return getattr(import_module(module), name)


def sweep_summary(*, go_only: bool = False, **values: Any) -> Answer:
    """Summary of a sweep over whatever is a list.

    Parameters
    ----------
    go_only : bool
        Spare the contact model cells of which the closed form alone says that they are no GO.
    **values
        As in `kaidan.sweep`: a value, or a list of values of it.
    """
    from kaidan.sweeps.plan import Plan
    from kaidan.sweeps.running import carried_out
    from kaidan.sweeps.summary import summary_of

    plan = Plan.of(values, screen=go_only)
    if len(plan) > MOST_CELLS:
        raise InputError(f"sweep: {len(plan):,} cells are more than {MOST_CELLS:,}: make it a job")
    return summary_of(carried_out(plan, workers=1))


def estimate(robot: Any, stairs: Any = None, **manner: Any) -> Answer:
    """First estimate by the closed form, without advice: what a slider shows while it moves.

    Parameters
    ----------
    robot, stairs, **manner
        As in `kaidan.assess`.
    """
    from kaidan.assessment import answer_to

    question = Question.ask(robot, stairs, **{"model": "closed-form", **manner})
    return answer_to(question, advice=False)


def pose_map_of(robot: Any, stairs: Any = None, **manner: Any) -> Answer:
    """Pose map along the traverse of a question, coarse enough for a page.

    Parameters
    ----------
    robot, stairs, **manner
        As in `kaidan.traverse`, in one posture.
    """
    from kaidan.verbs.pose_map import pose_map
    from kaidan.verbs.traverse import driven

    question = Question.ask(robot, stairs, **manner)
    if question.best_of:
        raise InputError("pose map: it is of one posture; state angles, flat or stowed")
    return pose_map(question, driven(question), columns=211, rows=91)


VERBS: Mapping[str, Verb] = {
    "assess": Verb("kaidan.assessment:assess", "kaidan.assessment.answer:Assessment"),
    "estimate": Verb("kaidan.web.asking:estimate", "kaidan.assessment.answer:Assessment"),
    "traverse": Verb(
        "kaidan.verbs.traverse:traverse", "kaidan.verbs.traverse_report:TraverseReport"
    ),
    "posture": Verb("kaidan.verbs.posture:posture", "kaidan.verbs.posture:PostureAnswer"),
    "margin": Verb(
        "kaidan.verbs.margin_curve:margin",
        "kaidan.verbs.margin_curve:MarginCurve",
        required=("robot",),
        several=frozenset({"stairs"}),
    ),
    "plane": Verb("kaidan.verbs.d_a_plane:plane", "kaidan.verbs.d_a_plane:Plane"),
    "pose-map": Verb("kaidan.web.asking:pose_map_of", "kaidan.verbs.pose_map:PoseMap"),
    "measure-robot": Verb(
        "kaidan.verbs.measure_robot:measure_robot",
        "kaidan.verbs.measure_robot:RobotMeasurement",
        required=("flat_length",),
    ),
    "measure-stairs": Verb(
        "kaidan.verbs.measure_stairs:measure_stairs",
        "kaidan.verbs.measure_stairs:StairsMeasurement",
        required=("total_rise", "total_going", "risers"),
    ),
    "compare": Verb(
        "kaidan.verbs.comparison:compare",
        "kaidan.verbs.comparison:Comparison",
        required=(),
        several=frozenset({"robots", "stairs"}),
    ),
    "sweep": Verb(
        "kaidan.web.asking:sweep_summary",
        "kaidan.sweeps.summary:SweepSummary",
        required=("robot",),
        several=frozenset({"robot", "stairs", "surface", "flippers"}),
        open=True,
    ),
}
"""Verbs by name."""


def answered(verb: str, body: Mapping[str, Any]) -> Answer:
    """Answer of a verb to what a client wrote.

    Parameters
    ----------
    verb : str
        Name in `VERBS`.
    body : mapping
        Keywords of its function, as JSON has them; or "question", as answers have it, with what
        is changed of it.

    Raises
    ------
    InputError
        An unknown or a missing keyword, or an input without physical meaning.

    Examples
    --------
    >>> answered("margin", {"robot": "kenaf", "points": 3}).robot
    'kenaf'
    """
    asked = VERBS[verb]
    values = {name: value for name, value in body.items() if value is not None}
    whole = values.pop("question", None) if asked.takes_question else None
    if not asked.open:
        refuse_unknown(verb, values, asked.parameters())
        one = {name for name in values if name in asked.several}
        values |= {name: [values[name]] for name in one if not isinstance(values[name], list)}
    for name in asked.required if whole is None else ():
        if name not in values:
            hint = ": give a name of the catalogue or a sheet" if name in READ else ""
            raise InputError(f"{verb}: no {name}{hint}")
    keywords = made(values, asked.several)
    if whole is not None:
        if not isinstance(whole, Mapping):
            raise InputError(f"question = {shown(whole)} is not a table")
        keywords["robot"] = Question.model_validate(whole)
    return asked.load()(**keywords)


def report_of(body: Mapping[str, Any]) -> "Report":
    """Report, see `kaidan.report`.

    Parameters
    ----------
    body : mapping
        robot or robots, stairs (a list is of several missions), and everything else of a question;
        or "question", one or a list of those that answers have, with what is changed of them.
    """
    from kaidan.verbs.report import report

    values = {name: value for name, value in body.items() if value is not None}
    whole = values.pop("question", None)
    refuse_unknown("report", values, {"robots", *signature(Question.of).parameters})
    if "robots" in values and "robot" in values:
        raise InputError("report: give robot or robots, not both")
    robots = values.pop("robots", values.pop("robot", None))
    keywords = made(values, {"stairs"})
    if whole is not None:
        questions = whole if isinstance(whole, list) else [whole]
        for each in questions:
            if not isinstance(each, Mapping):
                raise InputError(f"question = {shown(each)} is not a table")
        return report([Question.model_validate(each) for each in questions], **keywords)
    for name, given in (("robot", robots), ("stairs", values.get("stairs"))):
        if given is None:
            raise InputError(f"report: no {name}: give a name of the catalogue or a sheet")
    each_robot = robots if isinstance(robots, list) else [robots]
    return report([robot_of(each) for each in each_robot], keywords.pop("stairs"), **keywords)


_LIVE = ("robot", "stairs", "direction", "facing", "flippers", "payload", "override")


def live_question(body: Mapping[str, Any]) -> Question:
    """Question of a climb that is watched; see `kaidan.monitor`."""
    values = {name: value for name, value in body.items() if value is not None}
    refuse_unknown("live", values, _LIVE)
    for name in ("robot", "stairs"):
        if name not in values:
            raise InputError(f"live: no {name}: give a name of the catalogue or a sheet")
    keywords = made(values)
    return Question.in_one_posture(keywords.pop("robot"), keywords.pop("stairs"), **keywords)


def samples_of_file(file: str, body: Mapping[str, Any]) -> dict[str, Any]:
    """Samples of a file, as JSON has them; the body may say that the nose is "down" the stairs."""
    from kaidan.verbs.monitor import open_samples

    refuse_unknown("samples", body, ("nose",))
    if body.get("nose", "up") not in ("up", "down"):
        raise InputError(f"nose = {shown(body['nose'])} is not known; known: up, down")
    with open_samples(file, nose_up=body.get("nose", "up") == "up") as samples:
        found = list(islice(samples, MOST_RECORDED + 1))
    if len(found) > MOST_RECORDED:
        raise InputError(f"{file}: more than {MOST_RECORDED:,} samples")
    return {"samples": [plain(each._asdict()) for each in found]}


def read_of(file: str, body: Mapping[str, Any]) -> Answer:
    """What a file holds, see `kaidan.read`; the body has its hints, and which ``part`` of it."""
    from kaidan.verbs.read import read

    hints = dict(body)
    part = hints.pop("part", "")
    refuse_unknown("read", hints, signature(read).parameters.keys() - {"file"})
    return read(f"{file}#{part}" if part else file, **hints)


def building_of(file: str, body: Mapping[str, Any]) -> Answer:
    """What robots can do in a building, see `kaidan.building`; the body has everything else.

    Robots are names with commas between them, or several fields, each a name or a sheet in JSON.
    """
    from kaidan.verbs.building import building

    values = dict(body)
    known = signature(building).parameters.keys() | signature(Question.of).parameters.keys()
    refuse_unknown("building", values, known - {"file", "manner", "robot", "stairs"})
    given = values.pop("robots", ())
    texts = [given] if isinstance(given, str) else given
    robots = [_robot_of_text(each) for text in texts for each in _parts(text)]
    return building(file, robots, **made(values))


def _parts(text: str) -> list[str]:
    return [text] if text.lstrip().startswith("{") else text.split(",")


def _robot_of_text(text: str) -> Robot:
    return Robot.from_json(text) if text.lstrip().startswith("{") else sheet_of(text, Robot)
