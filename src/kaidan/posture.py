"""Flipper angles that make the most of a robot on given stairs: one for all, or one a phase.

What is sought is the best verdict of the contact model, and among equal ones the largest margin.
A coarse grid of the angles is driven over a short flight without forces, its best are judged in
full, the winner is refined by halving steps, and the result is confirmed on the flight asked about.
"""

import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from itertools import product
from typing import Literal, NamedTuple

from kaidan.assessment.answer import Verdict
from kaidan.assessment.case import Case
from kaidan.assessment.contact_model import profile_of
from kaidan.assessment.readings import phase_margins
from kaidan.assessment.ruling import Accept, Ruling, ruling
from kaidan.climb import Climb, Phase, climb
from kaidan.errors import InputError
from kaidan.outline import Outline
from kaidan.robot import FlipperPair, Posture

RANK: dict[Verdict, int] = {"go": 0, "caution": 1, "no-go": 2, "outside-model": 3}
"""Order of the verdicts, the best first."""
LIMITS = (math.radians(-60.0), math.radians(120.0))
"""Angles tried where nobody states any [rad]: from pushed down to folded back a little."""
TRIED = {1: 13, 2: 5}
"""Angles of the coarse grid for each pair, by the number of pairs; stowed and flat come on top."""
JUDGED = 5
"""Postures of the coarse grid that are judged in full."""
REFINED = tuple(math.radians(x) for x in (8.0, 4.0))
"""Steps of the refinement [rad]: flippers are set to some degrees."""
COARSE, FINE = 0.04, 0.02
"""Arclength between poses while searching and while judging [m]; events are located anyway."""
WORTH = math.radians(0.05)
"""Margin that counts as better [rad]."""
TEST_SPEED = 0.1
"""Speed where nobody states one [m/s]: the paper's."""

Angles = tuple[float | None, float | None]
"""Front and rear [rad]; None for a pair the robot does not have."""


@dataclass(frozen=True, kw_only=True)
class Tried:
    """A posture and what the contact model says of it."""

    front_deg: float | None
    """Angle of the front flippers [deg]; null without a pair."""
    rear_deg: float | None
    verdict: Verdict
    margin_deg: float | None
    """Smallest margin of slope, allowances off [deg]."""
    governs: str
    reason: str


@dataclass(frozen=True, kw_only=True)
class PhasePosture:
    """Best posture of a phase."""

    phase: Literal["enter", "traverse", "land"]
    front_deg: float | None
    rear_deg: float | None
    verdict: Verdict
    """Of this phase alone."""
    margin_deg: float | None
    required_friction: float | None
    """Null: no friction is enough."""
    largest_swing_deg: float


@dataclass(frozen=True, kw_only=True)
class PostureChange:
    """Change of posture between two phases, to be done within one nosing spacing."""

    before: Literal["traverse", "land"]
    """Phase that it prepares."""
    turn_deg: float
    """Largest turn of a flipper [deg]."""
    needs_s: float | None
    """Time by the flippers' largest speed [s]; null where that is not known."""
    has_s: float
    """Time in which the robot covers a nosing spacing [s]."""
    too_slow: bool | None
    """Whether the robot has to slow down or wait for it."""
    holds_between: bool
    """Whether the robot gets as far with the flippers half way too."""


@dataclass(frozen=True, kw_only=True)
class PostureAnswer:
    """What flipper angles can do for a robot on stairs; see `best_posture`."""

    robot: str
    stairs: str
    before: Tried
    after: Tried
    """Best posture for the whole way."""
    helps: bool
    """Whether it is better than before."""
    phases: tuple[PhasePosture, ...]
    """Best posture of each phase; empty where no posture gets through one of them."""
    changes: tuple[PostureChange, ...]
    phases_help: bool
    """Whether changing between phases is better than the best fixed posture."""
    speed: float
    """Speed at which the changes are timed [m/s]."""
    tried: int
    """Postures driven."""
    notes: tuple[str, ...]

    @property
    def exit_code(self) -> int:
        """Of the best fixed posture: 0 go or caution, 1 no-go, 3 outside the model."""
        return {0: 0, 1: 0, 2: 1, 3: 3}[RANK[self.after.verdict]]

    def to_json(self) -> str:
        """One JSON object, indented."""
        import json

        return json.dumps(asdict(self), indent=2, ensure_ascii=False, allow_nan=False)


class _Judged(NamedTuple):
    angles: Angles
    case: Case
    found: Climb
    ruling: Ruling

    @property
    def merit(self) -> tuple[int, float]:
        """Verdict, then margin; larger is better."""
        margin = self.ruling.margin
        return -RANK[self.ruling.verdict], -math.inf if math.isnan(margin) else margin


def best_posture(
    case: Case,
    *,
    limits: tuple[float, float] = LIMITS,
    accept: Accept = "no-rotation",
) -> PostureAnswer:
    """Flipper angles with the best verdict and the largest margin.

    Parameters
    ----------
    case : Case
        The question; its posture is the one to compare with.
    limits : (float, float)
        Angles allowed [rad]; the stowed angle and lying flat always are.
    accept : {"no-rotation", "caught"}
        What counts as holding.

    Returns
    -------
    PostureAnswer
        Also where no posture helps; then `helps` is False.

    Raises
    ------
    InputError
        A robot without flippers, or limits without meaning.
    """
    robot = case.robot
    pairs = (robot.front_flippers, robot.rear_flippers)
    if pairs == (None, None):
        raise InputError(f"robot {robot.name!r} has no flippers, so it has no posture to choose")
    if not -math.pi <= limits[0] < limits[1] <= math.pi:
        raise InputError(
            f"limits = {limits[0]:g} to {limits[1]:g} rad: write a smaller and a larger angle "
            "within -3.14159 to 3.14159 rad"
        )
    short = shortened(case)
    now = _angles_of(case.posture, pairs)
    coarse = {
        angles: _drive(short, angles, step=COARSE, with_margins=False)
        for angles in dict.fromkeys([now, *_grid(pairs, limits)])
    }
    ranked = sorted(coarse, key=lambda angles: _promise(short, coarse[angles]), reverse=True)
    judged = {angles: _judge(short, angles, accept) for angles in ranked[:JUDGED]}
    best = _refined(short, judged, accept, pairs, limits)
    for phase in Phase:
        first = max(coarse, key=lambda angles: _phase_promise(coarse[angles], phase))
        if first not in judged:
            judged[first] = _judge(short, first, accept)
    whole = case
    before = _judge(whole, now, accept)
    confirmed = sorted({best, *ranked[:1]} - {now}, key=lambda a: judged[a].merit, reverse=True)
    after = max(
        [before, *(_judge(whole, angles, accept) for angles in confirmed[:1])],
        key=lambda each: (each.merit[0], each.merit[1] - (each is not before) * WORTH),
    )
    phases, chosen = _phases(judged, after)
    changes = tuple(_changes(short, chosen)) if phases else ()
    ranks = [RANK[each.verdict] for each in phases]
    return PostureAnswer(
        robot=robot.name,
        stairs=case.stairs.name,
        before=_told(before),
        after=_told(after),
        helps=after is not before,
        phases=phases,
        changes=changes,
        phases_help=bool(ranks) and max(ranks) < RANK[after.ruling.verdict],
        speed=_speed(case),
        tried=len(coarse.keys() | judged.keys()),
        notes=tuple(_notes(case, short, before, after, changes, limits)),
    )


def shortened(case: Case) -> Case:
    """Same question on a flight just long enough for what repeats; other stairs stay as they are.

    A uniform flight repeats itself once the robot has left the lower landing: as many nosings as
    the robot spans, and three more, hold every pose of the whole flight.
    """
    stairs = case.stairs
    if case.profile is not None or stairs.rise is None:
        return case
    reach = sum(Outline.of(case.robot, case.posture, case.payload).reach)
    for pair in (case.robot.front_flippers, case.robot.rear_flippers):
        reach += 0.0 if pair is None else pair.length
    enough = max(5, math.ceil(reach / stairs.nosing_spacing) + 3)
    return case.changed(stairs=stairs.model_copy(update={"steps": min(stairs.steps, enough)}))


def _angles_of(posture: Posture, pairs: tuple[FlipperPair | None, FlipperPair | None]) -> Angles:
    """Angles of a posture, words turned into numbers."""
    angles: list[float | None] = []
    for wanted, pair in zip((posture.front, posture.rear), pairs, strict=True):
        if pair is None:
            angles.append(None)
        elif wanted is None:
            angles.append(pair.stowed_angle)
        else:
            angles.append(pair.flat_angle if isinstance(wanted, str) else float(wanted))
    return angles[0], angles[1]


def _grid(
    pairs: tuple[FlipperPair | None, FlipperPair | None], limits: tuple[float, float]
) -> Iterator[Angles]:
    many = TRIED[sum(pair is not None for pair in pairs)]
    low, high = limits
    even = [low + (high - low) * k / (many - 1) for k in range(many)]
    choices: list[list[float | None]] = [
        [None] if pair is None else [pair.flat_angle, pair.stowed_angle, *even] for pair in pairs
    ]
    yield from product(*choices)


def _with(case: Case, angles: Angles) -> Case:
    return case.changed(posture=Posture(front=angles[0], rear=angles[1]))


def _drive(case: Case, angles: Angles, *, step: float, with_margins: bool) -> Climb:
    case = _with(case, angles)
    return climb(
        profile_of(case),
        Outline.of(case.robot, case.posture, case.payload),
        descending=case.direction == "down",
        facing=case.facing,
        acceleration=case.acceleration,
        with_margins=with_margins,
        step=step,
    )


def _judge(case: Case, angles: Angles, accept: Accept) -> _Judged:
    found = _drive(case, angles, step=FINE, with_margins=True)
    then = _with(case, angles)
    return _Judged(angles, then, found, ruling(then, found, accept=accept))


def _promise(case: Case, found: Climb) -> tuple[int, float]:
    """What a drive without forces lets one hope for: arrival, no rotation, margin or swing."""
    if not found.arrived:
        reached = float(found.run.x[-1]) if len(found.run.x) else -math.inf
        return 0, reached
    one = found.criterion
    tip = min(found.downhill_margin, found.uphill_margin)
    if one.holds and tip - case.theta_d.high - case.theta_M.high > 0:
        return 3, tip
    if one.holds:
        return 2, tip
    return 1, -found.run.largest_release - (0.0 if found.held_with_momentum else math.pi)


def _phase_promise(found: Climb, phase: Phase) -> tuple[bool, bool, float, float]:
    """Passes the phase, without rotation while traversing, smallest swing, largest margin."""
    swings = [each.swing_deg or 0.0 for each in found.happenings if each.phase is phase]
    tip = min(found.downhill_margin, found.uphill_margin)
    steady = phase is not Phase.TRAVERSE or bool(found.criterion.holds)
    margin = tip if phase is Phase.TRAVERSE and not math.isnan(tip) else -math.inf
    return _passes(found, phase), steady, -round(max(swings, default=0.0), 1), margin


def _passes(found: Climb, phase: Phase) -> bool:
    """Whether the robot gets through a phase."""
    if found.arrived:
        return True
    order = list(Phase)
    ended = found.happenings[-1].phase if found.happenings else Phase.ENTER
    return order.index(ended) > order.index(phase)


def _refined(
    case: Case,
    judged: dict[Angles, _Judged],
    accept: Accept,
    pairs: tuple[FlipperPair | None, FlipperPair | None],
    limits: tuple[float, float],
) -> Angles:
    """Best of the judged after a pattern search round it; what it tries is added to `judged`."""
    best = max(judged, key=lambda angles: judged[angles].merit)
    for step in REFINED:
        for end, pair in enumerate(pairs):
            if pair is None:
                continue
            for side in (step, -step):
                moved = [*best]
                moved[end] = min(max((best[end] or 0.0) + side, limits[0]), limits[1])
                angles = (moved[0], moved[1])
                if angles not in judged:
                    judged[angles] = _judge(case, angles, accept)
                if judged[angles].merit[0] > judged[best].merit[0] or (
                    judged[angles].merit[0] == judged[best].merit[0]
                    and judged[angles].merit[1] > judged[best].merit[1] + WORTH
                ):
                    best = angles
    return best


def _phase_merit(each: _Judged, phase: Phase) -> tuple[int, float, float]:
    """Verdict of a phase alone, its margin, its swing; larger is better."""
    seen = next((p for p in each.found.phases if p.phase is phase), None)
    if seen is None or not _passes(each.found, phase):
        return -2, -math.inf, -math.inf
    margins = phase_margins(each.case, each.found, phase)
    certain = margins.steady and margins.worst > 0 and each.case.surface is not None
    return (0 if certain else -1), round(margins.worst, 6), -seen.largest_swing_deg


def _phases(
    judged: dict[Angles, _Judged], after: _Judged
) -> tuple[tuple[PhasePosture, ...], tuple[_Judged, ...]]:
    """Best posture of each phase, the fixed one where no other is better."""
    told, chosen = [], []
    fixed = judged.get(after.angles, after)
    for phase in Phase:
        if all(p.phase is not phase for p in fixed.found.phases) and fixed.found.arrived:
            continue  # a flight so short that the robot is never on it alone
        best = max([fixed, *judged.values()], key=lambda each: _phase_merit(each, phase))
        rank, margin, _ = _phase_merit(best, phase)
        if rank == -2:
            return (), ()
        seen = next(p for p in best.found.phases if p.phase is phase)
        verdict: Verdict = "go" if rank == 0 else "caution"
        chosen.append(best)
        told.append(
            PhasePosture(
                phase=phase.value,
                front_deg=_degrees(best.angles[0]),
                rear_deg=_degrees(best.angles[1]),
                verdict=verdict,
                margin_deg=_degrees(margin if math.isfinite(margin) else None),
                required_friction=_finite(seen.required_friction),
                largest_swing_deg=seen.largest_swing_deg,
            )
        )
    return tuple(told), tuple(chosen)


def _changes(case: Case, chosen: tuple[_Judged, ...]) -> Iterator[PostureChange]:
    pairs = (case.robot.front_flippers, case.robot.rear_flippers)
    has = case.stairs.nosing_spacing / _speed(case)
    names: tuple[Literal["traverse", "land"], ...] = ("traverse", "land")
    for name, one, two in zip(names[-len(chosen) + 1 :], chosen, chosen[1:], strict=False):
        turn, needs = 0.0, 0.0
        for pair, old, new in zip(pairs, one.angles, two.angles, strict=True):
            if pair is None or old is None or new is None or old == new:
                continue
            turn = max(turn, abs(new - old))
            needs = max(
                needs, math.nan if pair.max_speed is None else abs(new - old) / pair.max_speed
            )
        if turn == 0.0:
            continue
        half = tuple(
            None if old is None or new is None else (old + new) / 2
            for old, new in zip(one.angles, two.angles, strict=True)
        )
        between = _drive(case, (half[0], half[1]), step=COARSE, with_margins=False)
        known = not math.isnan(needs)
        yield PostureChange(
            before=name,
            turn_deg=math.degrees(turn),
            needs_s=needs if known else None,
            has_s=has,
            too_slow=needs > has if known else None,
            holds_between=_passes(between, Phase.TRAVERSE if name == "traverse" else Phase.LAND),
        )


def _speed(case: Case) -> float:
    return case.speed or TEST_SPEED


def _told(each: _Judged) -> Tried:
    margin = each.ruling.margin
    return Tried(
        front_deg=_degrees(each.angles[0]),
        rear_deg=_degrees(each.angles[1]),
        verdict=each.ruling.verdict,
        margin_deg=None if math.isnan(margin) else math.degrees(margin),
        governs=each.ruling.governs,
        reason=each.ruling.reason,
    )


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _degrees(angle: float | None) -> float | None:
    return None if angle is None else math.degrees(angle)


def _notes(
    case: Case,
    short: Case,
    before: _Judged,
    after: _Judged,
    changes: tuple[PostureChange, ...],
    limits: tuple[float, float],
) -> Iterator[str]:
    if after is before:
        yield (
            f"No posture within {math.degrees(limits[0]):.0f} to {math.degrees(limits[1]):.0f} deg "
            "is better than the one asked about."
        )
    if short.stairs is not case.stairs and short.stairs.steps < case.stairs.steps:
        yield (
            f"Searched on {short.stairs.steps} risers, before and after judged on all "
            f"{case.stairs.steps}."
        )
    for change in changes:
        if change.too_slow and change.needs_s is not None:
            slowest = case.stairs.nosing_spacing / change.needs_s
            yield (
                f"The flippers are too slow to change for {_GERUND[change.before]} on the move: "
                f"{change.needs_s:.1f} s against {change.has_s:.1f} s for a nosing spacing at "
                f"{_speed(case):g} m/s; go at {slowest:.2f} m/s or less, or wait."
            )
        if change.too_slow is None:
            yield "The flippers' largest speed is not known, so their changes are not timed."
        if not change.holds_between:
            yield f"Half way to the posture for {_GERUND[change.before]} the robot does not hold."
    if case.speed is None and changes:
        yield f"No speed was stated; changes are timed at {TEST_SPEED:g} m/s, the paper's."
    if case.surface is None:
        yield "No friction was stated, so no GO can be given."


_GERUND = {"traverse": "traversing", "land": "landing"}
