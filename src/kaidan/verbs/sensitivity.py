"""Sobol indices of the margin and of GO over everything that a question does not know exactly.

Every draw is judged by itself, all inputs exact: nothing is linearised. What stands in an answer as
`to_measure` is the cheap version, from the samples that the answer has already.
"""

import math
import warnings
from importlib import import_module
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.answer import Answer, Part
from kaidan.arguments import known_arguments, whole
from kaidan.assessment import found_plan
from kaidan.assessment.uncertain_inputs import GROUPS, doubts_of, without
from kaidan.errors import InputError, MissingExtraError
from kaidan.modes import Verdict
from kaidan.question import Question
from kaidan.sweeps.plan import Along, Plan
from kaidan.sweeps.running import carried_out
from kaidan.terrain.stairs import Stairs

MOST_SAMPLES = 2**20
"""Most samples."""
LARGEST_SEED = 2**31
"""Largest seed that is taken."""
SAMPLES = 256
"""Draws of each column; every input takes as many again."""
_BEYOND = 4.0
"""Standard deviations beyond which nothing is drawn."""


class Input(Part):
    """An uncertain input and what it brings."""

    name: str
    """As kaidan sweep has it."""
    what: str
    """What is measured to know it: centroid, length, stairs, friction, theta_d or theta_M."""
    margin_first: float
    """First-order Sobol index of the margin: share of its variance by this input alone."""
    margin_total: float
    """Total index: with everything that it does together with others."""
    margin_confidence: float
    """Half width of the 95 % interval of the total index."""
    go_first: float | None
    """First-order index of whether it is a GO; null where it always or never is."""
    go_total: float | None
    """Total index of that."""


class Sensitivity(Answer):
    """What the margin and the verdict hang on, the input that matters most first."""

    text_module: ClassVar[str] = "kaidan.text.sensitivity"

    robot: str
    """Name of the robot."""
    stairs: str
    """Name of the stairs."""
    facing: str
    """Which end leads."""
    flippers: str
    """Postures of its plan, as the option is written."""
    model: str
    """Which model judged."""
    judged: int
    """Draws that were judged."""
    margin_deg: float
    """Mean of the margin over what is not known [deg]."""
    deviation_deg: float
    """Standard deviation of the margin [deg]."""
    go: float
    """Share of the draws that are a GO: probability that it is one, were every input known."""
    inputs: tuple[Input, ...]
    """The input with the largest total index of the margin first."""
    left_out: tuple[str, ...]
    """Doubts that are not drawn here."""


class _Drawn(NamedTuple):
    """An input that is drawn."""

    parameter: str
    group: str
    distribution: str
    """norm or unif, as SALib has it."""
    bounds: tuple[float, float]


@known_arguments
def sensitivity(
    robot: Any,
    stairs: Any = None,
    *,
    samples: int = SAMPLES,
    seed: int = 0,
    scheduler: str = "threads",
    workers: int | None = None,
    progress: bool = False,
    **manner: Any,
) -> Sensitivity:
    """Sobol indices of the margin and of GO over the uncertain inputs of a question.

    Parameters
    ----------
    robot, stairs, **manner
        As in `kaidan.assess`, or a whole question. The best plan is found once, of the inputs as
        they are stated; every draw drives it.
    samples : int
        A power of two; the number of judgements is this times the number of inputs and two.
    seed : int
        Of the draws.
    scheduler, workers, progress
        See `kaidan.sweep`.

    Raises
    ------
    InputError
        Every input is exact, or no draw has a margin.
    MissingExtraError
        SALib is not installed.

    Examples
    --------
    >>> found = sensitivity("absolem", "iso-14122-3", flippers="flat", friction=1.4, samples=64,
    ...                     uncertainty="com_height=20mm", model="closed-form")
    >>> found.inputs[0].name
    'com_height'

    References
    ----------
    Saltelli et al. 2010, doi:10.1016/j.cpc.2009.09.018, estimators; Herman & Usher 2017,
    doi:10.21105/joss.00097, SALib.
    """
    question, _ = found_plan(Question.ask(robot, stairs, **manner))
    whole("seed", seed, 0, LARGEST_SEED)
    if whole("samples", samples, 8, MOST_SAMPLES) & (samples - 1):
        raise InputError(f"samples = {samples} is not a power of two from 8 on")
    drawn, left_out = _inputs(question)
    if not drawn:
        raise InputError("every input is exact: state --uncertainty, or ranges")
    sample, analyze = (_salib(f"SALib.{part}.sobol") for part in ("sample", "analyze"))
    problem = {
        "num_vars": len(drawn),
        "names": [each.parameter for each in drawn],
        "bounds": [list(each.bounds) for each in drawn],
        "dists": [each.distribution for each in drawn],
    }
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        rows = sample.sample(problem, samples, calc_second_order=False, seed=seed + 1)  # 0 is none
    values = _exact(question) | {
        each.parameter: Along("draw", _clipped(each, rows[:, k]).tolist())
        for k, each in enumerate(drawn)
    }
    swept = carried_out(Plan.of(values), scheduler=scheduler, workers=workers, progress=progress)
    margin = swept.variables["margin_deg"].astype(float)
    known = np.isfinite(margin)
    if not known.any():
        raise InputError("no draw has a margin: the model says nothing here")
    margin = np.where(known, margin, np.nanmin(margin[known]))
    goes = (swept.variables["verdict"] == Verdict.GO.rank).astype(float)
    of_margin = _indices(analyze, problem, margin, seed)
    of_go = _indices(analyze, problem, goes, seed) if 0 < goes.mean() < 1 else None
    inputs = [
        Input(
            name=each.parameter,
            what=each.group,
            margin_first=_within(of_margin["S1"][k]),
            margin_total=_within(of_margin["ST"][k]),
            margin_confidence=float(of_margin["ST_conf"][k]),
            go_first=None if of_go is None else _within(of_go["S1"][k]),
            go_total=None if of_go is None else _within(of_go["ST"][k]),
        )
        for k, each in enumerate(drawn)
    ]
    return Sensitivity(
        robot=question.robot.name,
        stairs=question.terrain_name,
        facing=question.facing,
        flippers=question.flippers,
        model=question.model,
        judged=len(margin),
        margin_deg=float(margin.mean()),
        deviation_deg=float(margin.std()),
        go=float(goes.mean()),
        inputs=sorted(inputs, key=lambda each: -each.margin_total),
        left_out=left_out,
    )


def _inputs(question: Question) -> tuple[list[_Drawn], tuple[str, ...]]:
    """Inputs that are drawn, and the names of those that cannot be."""
    uniform = isinstance(question.terrain, Stairs) and question.terrain.rise is not None
    robot, found, left_out = question.robot, [], []
    middle = {
        "flat_length": robot.track.flat_length,
        "com_from_front": robot.com_from_front,
        "com_height": robot.com_height,
    }
    if uniform:
        flight = question.flight
        assert flight is not None
        middle |= {"angle": flight.angle, "nosing_spacing": flight.nosing_spacing}
    low, high = question.friction
    for each in doubts_of(question):
        if each.ends is not None:
            ends = (min(each.ends), max(each.ends))
            found.append(_Drawn(each.name, each.group, "unif", ends))
        elif each.name == "friction_uncertainty" and low == high:
            found.append(_Drawn("friction", each.group, "norm", (low, each.sigma)))
        elif each.name in middle:
            found.append(_Drawn(each.name, each.group, "norm", (middle[each.name], each.sigma)))
        else:
            left_out.append(each.name)
    if robot.com_range is not None:
        along, up = robot.com_range.from_front, robot.com_range.height
        for name, (first, last) in (("com_from_front", along), ("com_height", up)):
            if first < last:
                found.append(_Drawn(name, GROUPS[name], "unif", (first, last)))
    return found, tuple(left_out)


def _exact(question: Question) -> dict[str, Any]:
    """Values of the question with no doubt of its own."""
    for group in ("centroid", "length", "stairs"):
        question = without(question, group) or question
    ends = {"theta_d": question.allowance_d, "theta_M": question.allowance_M}
    values: dict[str, Any] = {
        "robot": question.robot.middle,
        "stairs": question.terrain,
        "direction": question.direction,
        "facing": question.facing,
        "flippers": (question.posture, *question.changes),
        "flipper_tolerance": question.flipper_tolerance,
        "payload": question.payload,
        "acceleration": question.acceleration,
        "speed": question.speed,
        "yaw": question.yaw,
        "uniform_across": question.uniform_across,
        "fall_reserve": question.fall_reserve,
        "risk": question.risk,
        "model": question.model,
    }
    values |= {name: (each.low, each.high) for name, each in ends.items()}
    if question.surface is not None:
        differs = question.surface.differs
        values |= {"surface": question.surface} if differs else {"friction": question.friction}
    return values


def _clipped(each: _Drawn, values: NDArray[Any]) -> NDArray[Any]:
    """Draws within what is possible."""
    if each.distribution == "unif":
        return values
    middle, sigma = each.bounds
    least = 0.0 if each.parameter == "friction" else 1e-3
    low, high = max(middle - _BEYOND * sigma, least), middle + _BEYOND * sigma
    return np.asarray(np.clip(values, low, high))


def _indices(analyze: Any, problem: dict[str, Any], values: NDArray[Any], seed: int) -> Any:
    if float(values.std()) == 0.0:
        nothing = np.zeros(problem["num_vars"])
        return {"S1": nothing, "ST": nothing, "ST_conf": nothing}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return analyze.analyze(problem, values, calc_second_order=False, seed=seed + 1)


def _within(index: float) -> float:
    """Index within 0 to 1, as far as the estimate strays."""
    return 0.0 if math.isnan(index) else min(max(float(index), 0.0), 1.0)


def _salib(module: str) -> Any:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return import_module(module)
    except ImportError:
        raise MissingExtraError("Sobol indices", "sensitivity") from None
