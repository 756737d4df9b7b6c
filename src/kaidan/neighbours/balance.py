r"""Static balance along a way, and balance lost on purpose (after Magid et al. 2010).

Their robot finds its way through a field of random steps by a search over poses: a pose is stable,
at the edge of balance or unstable, and where the way ends in front of a step down, the robot may
lose its balance on purpose, if the turn to the next stable pose is a good one. Here the poses, the
turns and where they lead come from the contact model, on any profile.

::

    inclination
        |     stretch 1    .       \ loses balance: one way only
        |   ____________ .´         \
        | .´   continuous            \__________ stretch 3
        +------------------------------------------------ way

Source:
Magid, Tsubouchi, Koyanagi & Yoshida 2010, "Static balance for rescue robot navigation: losing
balance on purpose within random step environment", IROS, 349-356. Re-derived: the quality figure,
the thresholds and the mechanics are ours.
"""

import math
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.climb import Climb, climb
from kaidan.contact.forces import contacts_at
from kaidan.errors import InputError
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.measures import kinetic_energy_height
from kaidan.outline import Outline
from kaidan.profile import Profile

Array = NDArray[np.float64]

SPEED = 0.1
"""Speed whose energy a pose must be able to take up to count as stable [m/s]: the paper's."""


class Balance(StrEnum):
    """Static balance of a pose."""

    STABLE = "stable"
    """Two contacts hold it, and a sudden stop from the stated speed does not turn it over."""
    EDGE = "edge"
    """Two contacts hold it, but such a stop may turn it over."""
    UNSTABLE = "unstable"
    """It turns by itself."""


class Change(StrEnum):
    """How one stretch of poses leads to the next."""

    CONTINUOUS = "continuous"
    """A contact replaces another and the robot does not turn: it can be driven both ways."""
    NOSE_DROPS = "nose-drops"
    """Loses its balance over the front contact: one way only."""
    TIPS_BACK = "tips-back"
    """Loses its balance over the rear contact: one way only."""


@dataclass(frozen=True, kw_only=True)
class Stretch:
    """Poses one after the other with the same contacts: a node of the graph."""

    number: int
    rows: tuple[int, int]
    """First pose and the one after the last, of the traverse."""
    x: tuple[float, float]
    """Centroid at its ends [m]."""
    inclination: tuple[float, float]
    """Inclination at its ends, leading end up positive [rad]."""
    balance: Balance
    """Worst of its poses."""
    static_margin: float
    """Smallest horizontal distance of the centroid from a contact [m]."""
    energy_margin: float
    """Smallest normalised energy stability margin: rise of the centroid that a turn about the
    outermost contacts needs [m]."""


@dataclass(frozen=True, kw_only=True)
class Transition:
    """What a stretch leads to: an edge of the graph."""

    change: Change
    start: int
    """Stretch it begins on."""
    end: int | None
    """Stretch it leads to; None if the robot falls, or is wedged."""
    x: tuple[float, float]
    """Centroid before and after [m]."""
    inclination: tuple[float, float]
    """Inclination before and after [rad]."""
    rotation: float
    """Angle turned, nose up positive [rad]."""
    fall: float
    """Fall of the centroid [m]."""
    energy: float
    """Energy released, of each kilogram [J/kg]."""
    rate: float
    """Rate of turn just before the last impact [rad/s]."""
    impact_speed: float
    """Speed with which the point that hits comes down [m/s]; NaN if it falls."""
    topples: bool
    """Whether the momentum carries it over the contact that should catch it."""
    quality: float
    """From 0, do not, to 1, as good as standing still; see `quality`."""

    @property
    def reversible(self) -> bool:
        """Whether driving back leads back."""
        return self.change is Change.CONTINUOUS


@dataclass(frozen=True)
class BalanceWay:
    """Balance along a way; see `balance_along`."""

    climb: Climb
    balance: NDArray[np.str_]
    """Class of each pose of the traverse, shape (n,)."""
    stretches: tuple[Stretch, ...]
    transitions: tuple[Transition, ...]

    @property
    def losses(self) -> tuple[Transition, ...]:
        """Transitions in which balance is lost on purpose."""
        return tuple(each for each in self.transitions if not each.reversible)

    @property
    def arrived(self) -> bool:
        """Whether the way leads to the other landing."""
        return self.climb.arrived

    @property
    def quality(self) -> float:
        """Worst quality of all transitions; 0 if it does not arrive, 1 if nothing happens."""
        if not self.arrived:
            return 0.0
        return min((each.quality for each in self.transitions), default=1.0)

    def leads_to(self) -> dict[int, tuple[int, ...]]:
        """Stretches that each stretch leads to, driving ahead or back: the graph."""
        graph: dict[int, tuple[int, ...]] = {each.number: () for each in self.stretches}
        for each in self.transitions:
            if each.end is not None:
                graph[each.start] += (each.end,)
                if each.reversible:
                    graph[each.end] += (each.start,)
        return graph


def energy_class(margin: float, *, speed: float = SPEED) -> Balance:
    """Class of a pose by its energy margin.

    Parameters
    ----------
    margin : float
        Rise of the centroid that a fall needs [m]; negative beyond the edge.
    speed : float
        Speed whose energy a sudden stop sets free [m/s].

    Returns
    -------
    Balance

    Raises
    ------
    InputError
        A speed that is negative or not finite.

    Examples
    --------
    By hand, 0.1 m/s are worth 0.01/(2 9.80665) m = 0.51 mm:

    >>> [energy_class(mm / 1000).value for mm in (0.6, 0.4, -0.1)]
    ['stable', 'edge', 'unstable']
    """
    if not 0.0 <= speed < math.inf:
        raise InputError(f"speed = {speed:g} m/s: write a speed from 0 on")
    if margin < 0.0:
        return Balance.UNSTABLE
    return Balance.STABLE if margin >= kinetic_energy_height(v=speed) else Balance.EDGE


def quality(*, fall: float, com_height: float, kinetic: float, barrier: float) -> float:
    """Quality of a loss of balance, for a planner to weigh.

    ``max(0, 1 - fall/com_height) max(0, 1 - kinetic/barrier)``

    The first factor is what the impact spares: a centroid that falls by its own height above the
    track has nothing left to lose. The second is what the catch keeps: momentum that reaches the
    top of what is still to climb topples the robot. Both are ours, and pure numbers, so that the
    figure is the same for a robot and its enlarged copy.

    Parameters
    ----------
    fall, com_height : float
        Fall of the centroid, and its height above the underside [m].
    kinetic, barrier : float
        Energy left after the last impact, and what going on turning needs [J/kg].

    Returns
    -------
    float
        From 0 to 1.

    Examples
    --------
    >>> quality(fall=0.05, com_height=0.2, kinetic=0.3, barrier=0.6)
    0.375
    """
    kept = 1.0 - kinetic / barrier if barrier > 0.0 else float(kinetic <= 0.0)
    return max(0.0, min(1.0, 1.0 - fall / com_height)) * max(0.0, kept)


def balance_along(
    profile: Profile,
    outline: Outline,
    *,
    descending: bool = False,
    facing: Literal["nose-first", "tail-first"] = "nose-first",
    speed: float = SPEED,
    step: float = contact.STEP,
    compiled: bool | None = None,
) -> BalanceWay:
    """Static balance of every pose along a way, and what leads from pose to pose.

    Parameters
    ----------
    profile : Profile
        Terrain from the lower to the upper landing.
    outline : Outline
        Robot in its posture.
    descending, facing, step, compiled
        See ``kaidan.climb.climb``.
    speed : float
        Speed whose energy a stable pose must be able to take up [m/s].

    Returns
    -------
    BalanceWay
        A way that ends in a fall is an answer, not an error.

    Raises
    ------
    InputError
        A speed without meaning, or a profile too long.

    Examples
    --------
    Up a kerb the robot does what Magid et al. call losing balance on purpose: over the edge its
    nose drops.

    >>> from kaidan.robot import Robot
    >>> kerb = Profile.of_points([(-2, 0), (0, 0), (0, 0.1), (2, 0.1)])
    >>> way = balance_along(kerb, Outline.of(Robot.named("kenaf")), step=0.02, compiled=False)
    >>> [(loss.change.value, loss.end) for loss in way.losses]
    [('nose-drops', 2)]
    """
    energy_class(0.0, speed=speed)  # refuses a speed without meaning
    found = climb(
        profile, outline, descending=descending, facing=facing, step=step, compiled=compiled
    )
    classes = [energy_class(each, speed=speed) for each in _energy(found.run).tolist()]
    marks = _marks(found.run)
    stretches = tuple(
        _stretch(number, found.run, classes, first, last)
        for number, (first, last) in enumerate(pairwise(marks))
    )
    return BalanceWay(
        climb=found,
        balance=np.array([each.value for each in classes], dtype="<U8"),
        stretches=stretches,
        transitions=tuple(_transitions(found, stretches, speed)),
    )


def _energy(run: contact.Traverse) -> Array:
    """Normalised energy stability margin of each pose: Hirose's, about the outermost contacts."""
    assert run.margins is not None
    return np.asarray(run.margins[:, 8:10].min(axis=1))


def _marks(run: contact.Traverse) -> list[int]:
    """Rows at which a new stretch begins, and one past the last row."""
    made = (contact.Event.MADE, contact.Event.TAIL_RESTS, contact.Event.CAUGHT)
    begins = {int(each[7]) for each in run.events if contact.Event(int(each[0])) in made}
    return sorted({0, len(run.poses), *begins})


def _stretch(
    number: int, run: contact.Traverse, classes: list[Balance], first: int, last: int
) -> Stretch:
    assert run.margins is not None
    seen = classes[first:last]
    order = (Balance.UNSTABLE, Balance.EDGE, Balance.STABLE)
    return Stretch(
        number=number,
        rows=(first, last),
        x=(float(run.x[first]), float(run.x[last - 1])),
        inclination=(float(run.inclination[first]), float(run.inclination[last - 1])),
        balance=min(seen, key=order.index),
        static_margin=float(run.margins[first:last, 6:8].min()),
        energy_margin=float(_energy(run)[first:last].min()),
    )


def _transitions(found: Climb, stretches: tuple[Stretch, ...], speed: float) -> list[Transition]:
    run = found.run
    firsts = {each.rows[0]: each.number for each in stretches}
    told: list[Transition] = []
    release = -1
    kinds = {
        contact.Event.NOSE_DROPS: Change.NOSE_DROPS,
        contact.Event.TIPS_BACK: Change.TIPS_BACK,
    }
    for each in run.events:
        event, row = contact.Event(int(each[0])), int(each[7])
        if event in (contact.Event.MADE, contact.Event.TAIL_RESTS) and firsts.get(row, 0) > 0:
            told.append(_continuous(run, firsts[row], row, speed))
        elif event in kinds:
            release += 1
            turn = run.releases[release]
            caught = turn[15] == 0.0
            start = next(s.number for s in stretches if s.rows[0] <= row < s.rows[1])
            told.append(_loss(found, turn, kinds[event], start, start + 1 if caught else None))
    return told


def _continuous(run: contact.Traverse, end: int, row: int, speed: float) -> Transition:
    """Change of contacts at one place: as good as the balance before and after it."""
    safe = kinetic_energy_height(v=speed)
    margin = float(_energy(run)[row - 1 : row + 1].min())
    return Transition(
        change=Change.CONTINUOUS,
        start=end - 1,
        end=end,
        x=(float(run.x[row - 1]), float(run.x[row])),
        inclination=(float(run.inclination[row - 1]), float(run.inclination[row])),
        rotation=0.0,
        fall=0.0,
        energy=0.0,
        rate=0.0,
        impact_speed=0.0,
        topples=False,
        quality=1.0 if margin >= safe else max(margin, 0.0) / safe,
    )


def _loss(found: Climb, turn: Array, change: Change, start: int, end: int | None) -> Transition:
    """Balance lost: from a row of the table of releases."""
    sense, x, z, phi, x1, z1, phi1 = (float(turn[k]) for k in (0, 3, 4, 5, 6, 7, 8))
    fall = z - z1
    topples = bool(turn[14] > 0)
    return Transition(
        change=change,
        start=start,
        end=end,
        x=(x, x1),
        inclination=(phi, phi1),
        rotation=sense * float(turn[9]),
        fall=fall,
        energy=STANDARD_GRAVITY * fall,
        rate=float(turn[10]),
        impact_speed=_impact_speed(found.run, turn) if end is not None else math.nan,
        topples=topples,
        quality=0.0
        if topples or end is None
        else quality(
            fall=fall,
            com_height=found.outline.stance.com_height,
            kinetic=float(turn[12]),
            barrier=float(turn[13]),
        ),
    )


_TOUCH = 1e-7
"""Gap up to which a contact is counted [m]."""


def _impact_speed(run: contact.Traverse, turn: Array) -> float:
    """Rate of turn before the last impact, times how far the contacts lie apart.

    Of several that meet the ground at once the farthest hits fastest; what it turned on is the
    outermost on the other side, because those beyond it have opened.
    """
    x, z, phi = (float(value) for value in turn[6:9])
    table = np.empty((32, 7))
    many, _ = contacts_at(run.ground, run.body, x, z, phi, _TOUCH, table, 0)
    points = table[:many, 1:3]
    outer = points[[int(np.argmin(points[:, 0])), int(np.argmax(points[:, 0]))]]
    return float(turn[10]) * math.dist(*outer)
