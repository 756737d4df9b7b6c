r"""Static balance along a path, and balance lost on purpose (after Magid et al. 2010).

Their robot finds its path through a field of random steps by a search over poses: a pose is stable,
at the edge of balance or unstable, and where the path ends in front of a step down, the robot may
lose its balance on purpose, if the rotation to the next stable pose is a good one. Here the poses,
the rotations and where they lead come from the contact model, on any profile.

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
from kaidan.contact import RotationRecord
from kaidan.errors import InputError
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.measures import kinetic_energy_height
from kaidan.outline import Outline
from kaidan.terrain.profile import Profile
from kaidan.traversal import Traverse, traverse

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
    """Smallest normalised energy stability margin: rise of the centroid that a rotation about the
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
    """Whether the momentum carries it over the contact that should arrest it."""
    quality: float
    """From 0, do not, to 1, as good as standing still; see `quality`."""

    @property
    def reversible(self) -> bool:
        """Whether driving back leads back."""
        return self.change is Change.CONTINUOUS


@dataclass(frozen=True)
class BalanceAlong:
    """Balance along a path; see `balance_along`."""

    traverse: Traverse
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
        return self.traverse.arrived

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
    By hand, 0.1 m/s lift by 0.01/(2 9.80665) m = 0.51 mm:

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
    track has nothing left to lose. The second is what the next contact holds: momentum that
    reaches the top of what is still to climb topples the robot. Both are ours, and pure numbers, so
    that the figure is the same for a robot and its enlarged copy.

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
) -> BalanceAlong:
    """Static balance of every pose along a path, and what leads from pose to pose.

    Parameters
    ----------
    profile : Profile
        Terrain from the lower to the upper landing.
    outline : Outline
        Robot in its posture.
    descending, facing, step
        See ``kaidan.traversal.traverse``.
    speed : float
        Speed whose energy a stable pose must be able to take up [m/s].

    Returns
    -------
    BalanceAlong
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
    >>> way = balance_along(kerb, Outline.of(Robot.named("kenaf")), step=0.02)
    >>> [(loss.change.value, loss.end) for loss in way.losses]
    [('nose-drops', 2)]
    """
    energy_class(0.0, speed=speed)  # refuses a speed without meaning
    found = traverse(profile, outline, descending=descending, facing=facing, step=step)
    classes = [energy_class(each, speed=speed) for each in _energy(found.path).tolist()]
    marks = _marks(found.path)
    stretches = tuple(
        _stretch(number, found.path, classes, first, last)
        for number, (first, last) in enumerate(pairwise(marks))
    )
    return BalanceAlong(
        traverse=found,
        balance=np.array([each.value for each in classes], dtype="<U8"),
        stretches=stretches,
        transitions=tuple(_transitions(found, stretches, speed)),
    )


def _energy(run: contact.Path) -> Array:
    """Normalised energy stability margin of each pose: Hirose's, about the outermost contacts."""
    assert run.margins is not None
    least: Array = np.minimum(run.margins.back_rise, run.margins.front_rise)
    return least


def _marks(run: contact.Path) -> list[int]:
    """Rows at which a new stretch begins, and one past the last row."""
    made = (contact.Event.MADE, contact.Event.TAIL_RESTS, contact.Event.ARRESTED)
    begins = {each.pose for each in run.events if each.kind in made}
    return sorted({0, len(run.poses), *begins})


def _stretch(
    number: int, run: contact.Path, classes: list[Balance], first: int, last: int
) -> Stretch:
    assert run.margins is not None
    margins = run.margins[first:last]
    seen = classes[first:last]
    order = (Balance.UNSTABLE, Balance.EDGE, Balance.STABLE)
    return Stretch(
        number=number,
        rows=(first, last),
        x=(float(run.x[first]), float(run.x[last - 1])),
        inclination=(float(run.inclination[first]), float(run.inclination[last - 1])),
        balance=min(seen, key=order.index),
        static_margin=float(min(margins.back.min(), margins.front.min())),
        energy_margin=float(_energy(run)[first:last].min()),
    )


def _transitions(found: Traverse, stretches: tuple[Stretch, ...], speed: float) -> list[Transition]:
    run = found.path
    firsts = {each.rows[0]: each.number for each in stretches}
    transitions: list[Transition] = []
    begun = -1
    speeds = contact.impact_speeds(run).tolist()
    kinds = {
        contact.Event.NOSE_DROPS: Change.NOSE_DROPS,
        contact.Event.TIPS_BACK: Change.TIPS_BACK,
    }
    for each in run.events:
        event, row = each.kind, each.pose
        if event in (contact.Event.MADE, contact.Event.TAIL_RESTS) and firsts[row] > 0:
            transitions.append(_continuous(run, firsts[row], row, speed))
        elif event in kinds:
            begun += 1
            rotation = run.rotations[begun]
            start = next(s.number for s in stretches if s.rows[0] <= row < s.rows[1])
            transitions.append(_loss(found, rotation, speeds[begun], kinds[event], start))
    return transitions


def _continuous(run: contact.Path, end: int, row: int, speed: float) -> Transition:
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


def _loss(
    found: Traverse, rotation: RotationRecord, speed: float, change: Change, start: int
) -> Transition:
    """Balance lost in a rotation."""
    fall = rotation.start.z - rotation.end.z
    topples = rotation.topples_with_momentum
    end = start + 1 if rotation.arrested else None
    return Transition(
        change=change,
        start=start,
        end=end,
        x=(rotation.start.x, rotation.end.x),
        inclination=(rotation.start.inclination, rotation.end.inclination),
        rotation=rotation.sense * rotation.angle,
        fall=fall,
        energy=STANDARD_GRAVITY * fall,
        rate=rotation.rate_before,
        impact_speed=speed,
        topples=topples,
        quality=0.0
        if topples or end is None
        else quality(
            fall=fall,
            com_height=found.outline.stance.com_height,
            kinetic=rotation.kinetic,
            barrier=rotation.barrier,
        ),
    )
