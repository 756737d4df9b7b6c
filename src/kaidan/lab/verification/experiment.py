"""The paper's verification test in MuJoCo, planned, carried out and counted in one call."""

import math
import tempfile
from collections.abc import Iterable, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any, NamedTuple

from kaidan.arguments import known_arguments
from kaidan.errors import InputError, shown
from kaidan.lab.calibration.fitted import fitted
from kaidan.lab.campaign import Condition, Setting, VerificationTest, carry_out
from kaidan.lab.verification.verification import Verification, usual_conditions, verification
from kaidan.spelling import robot_of
from kaidan.units import parse, value_of
from kaidan.work import read_batches

PAPER = "150mm,180mm,200mm,220mm"
"""Nosing spacings of the paper's test."""
NOSINGS = 10
"""Nosings that a trial passes: a run on the paper's rig passed about so many, each at its own phase
of the grousers."""
SLOPES = (0.01, 1.5533)
"""Slopes that can be tested, up to 89 degrees [rad]."""


class Experiment(NamedTuple):
    """What the trials come to, and how many were in the store before."""

    verification: Verification
    found: int
    """Trials that the store had already."""


@known_arguments
def experiment(robot: Any, *, store: str | Path | None = None, **options: Any) -> Verification:
    """Test in MuJoCo at which slopes a robot falls: the paper's verification test.

    Parameters
    ----------
    robot : Robot, str or path
        Robot, its name in the catalogue, or a TOML file.
    store : path, optional
        Folder that keeps the trials; what it has is not done again.
    **options
        Those of `plan_of` (spacings, angles, trials, descent, seed, and a setting's flippers,
        payload, override, friction, speed, track, ground), and those of
        `kaidan.lab.campaign.carry_out` (workers, scheduler, progress).

    Raises
    ------
    InputError
        An input without physical meaning; the text names it.
    MissingExtraError
        MuJoCo or pyarrow is not installed.

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, "Verification test", Figs. 12-21.
    """
    if not isinstance(store, str | Path | None):
        raise InputError(f"store = {shown(store)} is not a path")
    how = {name: options.pop(name) for name in _HOW if name in options}
    return carried_out(plan_of(robot, **options), store, **how).verification


_HOW = ("workers", "scheduler", "progress")


def carried_out(plan: VerificationTest, store: str | Path | None = None, **how: Any) -> Experiment:
    """Plan carried out, in a folder that passes away without a store.

    Parameters
    ----------
    store : path, optional
        Folder that keeps the trials.
    **how
        workers, scheduler, progress, as `kaidan.lab.campaign.carry_out` has them.
    """
    with ExitStack() as stack:
        folder = store or stack.enter_context(tempfile.TemporaryDirectory())
        tally = carry_out(plan, folder, **how)
        batches = read_batches(folder, ("id", "outcome", "largest_extra_deg"))
        found = verification(plan, (row for batch in batches for row in batch.to_pylist()))
    return Experiment(found, tally.found)


def plan_of(
    robot: Any,
    *,
    spacings: Any = PAPER,
    angles: Any = None,
    trials: int = 5,
    descent: bool = False,
    seed: int = 0,
    nosings: int = NOSINGS,
    **setting: Any,
) -> VerificationTest:
    """Plan of what people write.

    Parameters
    ----------
    robot : Robot, str or path
        Robot, its name in the catalogue, or a TOML file.
    spacings : str or sequence of float or str
        Nosing spacings [m]; as text "150mm,180mm".
    angles : str or sequence of float or str, optional
        Slopes [rad]; as text "50deg,52deg" or "44deg..66deg/12". Twelve around the margins of
        each spacing without.
    trials : int
        A condition.
    descent : bool
        Whether it comes down too, tail first.
    seed : int
        Of all start offsets and grousers' phases.
    nosings : int
        To be passed in a trial.
    **setting
        Of `kaidan.lab.campaign.Setting.of`: flippers, payload, override, friction, speed, track,
        ground. Without a track that of `kaidan.lab.calibration.fitted.fitted`.

    Raises
    ------
    InputError
        An input without physical meaning; a condition that cannot be tried.
    """
    distances = list(dict.fromkeys(_values(spacings, "length", "spacings")))
    if not distances:
        raise InputError("spacings: none is given")
    for p in distances:
        Condition(nosing_spacing=p, angle=math.radians(45.0))  # refuses what no stairs have
    if setting.get("track") is None:
        sheet = robot_of(robot, setting.pop("override", ())).weighed
        robot, setting["track"] = fitted(sheet)
    shared = Setting.of(robot, **setting)
    if angles is None:
        conditions = usual_conditions(shared, distances, descent=descent)
    else:
        slopes = angles_of(angles)
        directions = ("up", "down") if descent else ("up",)
        conditions = tuple(
            Condition.model_validate({"nosing_spacing": p, "angle": angle, "direction": direction})
            for p in distances
            for direction in directions
            for angle in slopes
        )
    plan = VerificationTest(
        setting=shared,
        conditions=conditions,
        trials=trials,
        seed=seed,
        nosings=nosings,
        stratified=True,
    )
    for condition in plan.conditions:
        plan.spec(condition, 0)  # refuses what cannot be tried before anything is begun
    return plan


def angles_of(given: Any) -> list[float]:
    """Slopes of a list with ranges, each once, from gentle to steep [rad].

    Examples
    --------
    >>> [round(math.degrees(angle)) for angle in angles_of("50deg,44deg..48deg/3")]
    [44, 46, 48, 50]
    """
    found: set[float] = set()
    for part in _parts(given, "angles"):
        low, dots, rest = part.partition("..") if isinstance(part, str) else (part, "", "")
        if not dots:
            found.add(value_of(part, "angle", option="angles"))
            continue
        high, _, count = rest.partition("/")
        if not count.strip().isdecimal() or not 2 <= int(count) <= 1000:
            raise InputError(
                f"angles {shown(part)}: write LOW..HIGH/COUNT with a count of 2 to 1000, for "
                "example 44deg..66deg/12"
            )
        first, last = (parse(end, "angle", option="angles") for end in (low, high))
        if not first < last:
            raise InputError(f"angles {shown(part)}: LOW is not less than HIGH")
        steps = int(count) - 1
        slopes = (math.degrees(first + (last - first) * k / steps) for k in range(steps + 1))
        found |= {math.radians(round(slope, 9)) for slope in slopes}
    for angle in found:
        if not SLOPES[0] <= angle <= SLOPES[1]:
            raise InputError(f"angles: {math.degrees(angle):g} deg is not within 1 to 89 deg")
    if not found:
        raise InputError("angles: none is given")
    return sorted(found)


def _values(given: Any, kind: str, name: str) -> list[float]:
    return [value_of(part, kind, option=name) for part in _parts(given, name)]


def _parts(given: Any, name: str) -> Sequence[Any]:
    """Items of a list, or of a text with commas."""
    if isinstance(given, str):
        return given.split(",")
    if isinstance(given, Iterable):
        return list(given)
    return [given]
