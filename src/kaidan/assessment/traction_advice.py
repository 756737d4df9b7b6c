"""What would help where friction decides: more of it, grousers, sharper nosings."""

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from kaidan.assessment.sentences import advice as text
from kaidan.assessment.verdict import Conclusion, conclude
from kaidan.models import judge
from kaidan.models.findings import Findings
from kaidan.modes import DRIVE, ENERGY, SUPPLIES, Undecided, Verdict
from kaidan.question import Question
from kaidan.robot.track import USUAL_GROUSERS
from kaidan.sheet import bounds
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs

if TYPE_CHECKING:
    from kaidan.assessment.plan_search import Found

LARGEST_FRICTION = bounds(Surface.model_fields["friction_low"])[2]
"""Beyond it no surface is known."""
MUCH_FRICTION = 0.15
"""Difference from which on a plan that needs less is looked for [1]."""
SLIPS = {mode.key for mode in SUPPLIES if mode is not DRIVE} | {Undecided.FRICTION_UNKNOWN.value}
"""What governs where friction decides."""


class Candidate(NamedTuple):
    """Something to try."""

    change: str
    """What to do, for people."""
    question: Question
    certain: bool = False
    """Whether it helps only where it settles something: another verdict, or a margin that holds."""
    holds: bool = False
    """Whether it changes what holds the robot, so that another plan may be the best."""
    then: Conclusion | None = None
    """Its conclusion, where it is known."""
    friction: float | None = None
    """Friction that it takes [1]; None: as it is."""
    another: bool = False
    """Whether it takes another plan."""


def more_friction(
    question: Question, found: Findings, search: "Found | None" = None
) -> Iterator[Candidate]:
    """Friction that is enough, off the angles of the flippers too."""
    required = found.required_friction
    if not math.isfinite(required):
        return
    enough = _in_hundredths(_off_its_angles(question, required, search))
    if question.uncertain and enough <= LARGEST_FRICTION:
        enough = enough_at_the_risk(question, found, enough)
    if question.robot.track.has_grousers:
        enough = _that_slips_less(question, found, enough)
    if enough <= LARGEST_FRICTION:
        yield _of_friction(question, enough, known=question.surface is not None)


def _that_slips_less(question: Question, found: Findings, enough: float) -> float:
    """Friction with which the energy of a slip onto grousers is not too much either [1].

    It falls with friction, to nothing where smooth belts hold.
    """
    figures: Any = next((each for each in found.figures if each.shown_as == "traction"), None)
    smooth = None if figures is None else figures.smooth_required_friction
    most = enough if smooth is None else _in_hundredths(smooth)

    def slips(friction: float) -> bool:
        with_it = question.changed(surface=Surface.of_friction(friction))
        return conclude(with_it, judge(with_it)).governs == ENERGY.key

    if not enough < most <= LARGEST_FRICTION or not slips(enough) or slips(most):
        return enough
    while most - enough > 0.015:
        middle = round((enough + most) / 2, 2)
        enough, most = (middle, most) if slips(middle) else (enough, middle)
    return most


def with_other_plans(question: Question, search: "Found") -> Iterator[Candidate]:
    """Friction that is enough for other plans, which are a GO with more than is stated."""
    if question.robot.com_range is not None:
        return
    for other in search.others:
        plan = question.changed(facing=other.facing, posture=other.posture, changes=other.changes)
        required = _off_its_angles(plan, search.drives.required_friction(other), search)
        enough = _in_hundredths(required) if math.isfinite(required) else math.inf
        if enough <= LARGEST_FRICTION:
            stated = question.surface is not None
            yield _of_friction(plan, enough, known=stated)._replace(another=True)


def with_less_friction(
    question: Question, found: Findings, search: "Found", enough: float
) -> Iterator[Candidate]:
    """Friction less than some that is enough, for other plans that are a GO with it.

    They are looked for half-way between what the plan at hand requires at its angles and what is
    enough so far. The last is the least.
    """
    if question.robot.com_range is not None:
        return
    from kaidan.assessment.plan_search import better_than

    asked, stated = question.changed(best_of=search.best_of), question.surface is not None
    low = found.required_friction
    while enough - low > MUCH_FRICTION:
        middle = round((low + enough) / 2, 2)
        at_that = asked.changed(surface=Surface.of_friction(middle))
        other = better_than(Verdict.ROUGH, at_that, drives=search.drives, other_frictions=False)
        if other is None or not other.robust:
            low = middle
            continue
        enough = middle
        yield _of_friction(other.question, enough, known=stated)._replace(another=True)


def _off_its_angles(question: Question, required: float, search: "Found | None") -> float:
    """Friction that a plan requires at its angles and off them [1]."""
    if not question.tolerance:
        return required
    from kaidan.assessment.plan_off_angles import friction_off_its_angles

    drives = None if search is None else search.drives
    return max(required, friction_off_its_angles(question, drives))


def _of_friction(question: Question, enough: float, *, known: bool) -> Candidate:
    change = text.friction(enough, known=known)
    surface = Surface.of_friction(enough)
    return Candidate(change, question.changed(surface=surface), holds=True, friction=enough)


def enough_at_the_risk(question: Question, found: Findings, nominal: float) -> float:
    """Friction that is enough for all but the accepted share of what is uncertain [1]."""
    known = found if question.robot.com_range is None else None
    then = judge(question.changed(surface=Surface.of_friction(nominal)), known=known)
    slides = [one.margin(question.risk) for one in then.each if one.mode.key in SLIPS]
    lacks = -min((each for each in slides if math.isfinite(each)), default=0.0)
    if lacks <= 0 or math.atan(nominal) + lacks >= math.pi / 2:
        return nominal
    return _in_hundredths(math.tan(math.atan(nominal) + lacks))


def _in_hundredths(required: float) -> float:
    """Friction in whole hundredths, one at least beyond what is required [1]."""
    return math.ceil(round(100 * required, 6) + 1) / 100


def grousers(question: Question) -> Iterator[Candidate]:
    """Belts with grousers, where they have none; where nobody says, of unknown figures."""
    track = question.robot.track
    if track.has_grousers:
        return
    known = track.belt is not None
    update: dict[str, Any] = {"belt": "grousers"}
    if known:
        update |= USUAL_GROUSERS
    robot = question.robot.model_copy(update={"track": track.model_copy(update=update)})
    change = text.grousers() if known else text.state_grousers()
    # with no friction stated no plan is a GO
    holds = question.surface is not None
    yield Candidate(change, question.changed(robot=robot), holds=holds)


def nosings(
    question: Question, conclusion: Conclusion, judged: Callable[[Question], Conclusion]
) -> Iterator[Candidate]:
    """Largest radius of the nosings, in whole mm, up to which grousers make it a GO."""
    flight = question.terrain
    if not isinstance(flight, Stairs) or not question.robot.track.has_grousers:
        return
    if conclusion.governs not in SLIPS or not conclusion.margin_best > 0:
        return
    stairs: Stairs = flight

    def up_to(mm: int) -> Candidate:
        radii = {"nosing_radius_low": min(stairs.nosing_radii[0], 1e-3 * mm)}
        radii["nosing_radius_high"] = 1e-3 * mm
        changed = question.changed(terrain=stairs.model_copy(update=radii))
        return Candidate(text.nosings(mm), changed, then=judged(changed))

    def is_go(one: Candidate) -> bool:
        return one.then is not None and one.then.verdict is Verdict.GO

    smallest, largest = (1e3 * each for each in stairs.nosing_radii)
    holds, fails = math.ceil(smallest - 1e-9), math.ceil(largest - 1e-9)
    if holds >= fails or not is_go(best := up_to(holds)):
        return
    while fails - holds > 1:
        middle = (holds + fails) // 2
        tried = up_to(middle)
        if is_go(tried):
            holds, best = middle, tried
        else:
            fails = middle
    yield best
