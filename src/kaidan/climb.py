"""The whole climb, or descent, of a robot on any profile: entering, traversing, landing.

The quasi-static contact model (`kaidan.contact`) in the words of robots and stairs. The kernel
drives towards +x; going down, the profile is reflected so that the way still leads there.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.errors import InputError
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.oblique import edge_energy
from kaidan.outline import Outline
from kaidan.profile import Profile

Array = NDArray[np.float64]

SLACK = 2e-3
"""How far below the flat a nosing may lie and still count as on it [m], for the criterion of no
rotation: hand measurement step by step is good to 2.8 mm, rubber tracks yield more."""
LONG = 20_000
"""Points and poses above which the plain kernel would take a minute."""
LONGEST = 400_000
"""Points and poses above which a traverse is refused: half a minute compiled."""
_AT_ONCE = 8
_TIE = 1e-9
_CLEARANCE = 0.05
_ON = 1e-6


class Phase(StrEnum):
    """Part of the way."""

    ENTER = "enter"
    """From the lower (going down: upper) landing until the trailing end has left it."""
    TRAVERSE = "traverse"
    """On the flight alone."""
    LAND = "land"
    """From the first contact with the other landing until the whole robot stands on it."""


@dataclass(frozen=True, kw_only=True)
class Happening:
    """An event along the way."""

    phase: Phase
    step: int
    """Nosing number from the bottom, 1 the first; 0 before it."""
    what: str
    """made, lost, nose-drops, tips-back, caught, tail-rests, fell-forward, ..."""
    way_m: float
    """Arclength of the centroid's path [m]."""
    inclination_deg: float
    """Inclination of the body, uphill positive when going up, downhill when going down [deg]."""
    swing_deg: float | None
    """How far it turned, for caught [deg]."""
    toppled_with_momentum: bool | None
    """Whether the momentum gained would carry it over, for caught."""


@dataclass(frozen=True, kw_only=True)
class PhaseFound:
    """Worst figures of a phase; None where it has no pose."""

    phase: Phase
    required_friction: float
    """Largest required friction of any pose [1]."""
    required_friction_step: int
    energy_margin_mm: float
    """Smallest rise of the centroid that a fall towards the downhill end needs [mm]; traversing,
    that any turn needs: about the contact that stays, as in the paper, whatever may catch it."""
    energy_margin_step: int
    uphill_energy_margin_mm: float
    """The same towards the uphill end [mm], as long as the next nosing uphill is still to come:
    over the last one the robot has to drop onto the landing."""
    static_margin_mm: float
    """Smallest static stability margin towards the downhill end [mm]."""
    traction_over_weight: float
    """Largest tractive force over weight [1]."""
    largest_swing_deg: float
    """Largest turn caught by the next contact [deg]."""
    belly_touches: bool
    """Whether the belly carries the robot somewhere (high-centring)."""


@dataclass(frozen=True)
class Climb:
    """What the contact model found; see `climb`."""

    status: contact.Status
    descending: bool
    profile: Profile
    """As driven: reflected when descending."""
    outline: Outline
    """As driven: x towards the leading end."""
    run: contact.Traverse
    criterion: contact.GradeOne
    """The paper's criterion of no rotation (grade one)."""
    phases: tuple[PhaseFound, ...]
    happenings: tuple[Happening, ...]

    @property
    def arrived(self) -> bool:
        """Grade two: the whole robot stands on the other landing."""
        return self.status is contact.Status.OK

    @property
    def held_with_momentum(self) -> bool:
        """Grade three: no release topples with the momentum gained."""
        return self.run.held_with_momentum

    @property
    def phase_of_pose(self) -> NDArray[np.str_]:
        """Phase of each pose of the run."""
        return _phases(self.run, self.profile, self.descending)

    @property
    def downhill_margin(self) -> float:
        """Margin of slope against turning about the lowest contact that stays [rad]; NaN: none."""
        one = self.criterion
        return one.front_margin_angle if self.descending else one.back_margin_angle

    @property
    def uphill_margin(self) -> float:
        """Margin of slope against turning about the highest contact that stays [rad]; NaN: none."""
        one = self.criterion
        return one.back_margin_angle if self.descending else one.front_margin_angle

    @property
    def centroid_margin(self) -> float:
        """How far the centroid may move along the flat before it turns [m]; NaN: no criterion."""
        return float(np.fmin(self.criterion.back_margin, self.criterion.front_margin))


class _Turn(NamedTuple):
    """Turn about the contact that stays, as one is lost or made."""

    side: float
    """+1 to the back, -1 to the front."""
    rise: float
    """Of the centroid [m]."""
    x: float
    """Of the leading end of the flat [m]."""


def climb(
    profile: Profile,
    outline: Outline,
    *,
    descending: bool = False,
    facing: Literal["nose-first", "tail-first"] = "nose-first",
    acceleration: float = 0.0,
    with_margins: bool = True,
    with_energy: bool = False,
    step: float = contact.STEP,
    compiled: bool | None = None,
) -> Climb:
    """Drive a robot from landing to landing.

    Parameters
    ----------
    profile : Profile
        Terrain from the lower to the upper landing. The landings are taken as long enough.
    outline : Outline
        Robot, x towards its nose.
    descending : bool
        From the upper landing to the lower one.
    facing : {"nose-first", "tail-first"}
        Which end leads.
    acceleration : float
        Acceleration UP the stairs [m/s^2].
    with_margins : bool
        Work out forces and margins at every pose.
    with_energy : bool
        The energy margin along the flow too at every pose, not only the least of each phase.
    step : float
        Arclength between poses [m]; events are located whatever it is.
    compiled : bool, optional
        Whether to use the compiled kernel; None: if numba is loaded already, or if the profile is
        long and numba is there to be loaded.

    Returns
    -------
    Climb
        A robot that falls is an answer, not an error.

    Raises
    ------
    InputError
        A profile too long for the kernel at hand.
    """
    compiled = _kernel_for(profile, step, compiled)
    way = profile.reflected() if descending else profile
    body = outline if facing == "nose-first" else outline.turned_round()
    back, ahead = body.reach
    first, last = _span(way, descending)
    room = back + ahead + 1.0
    ends = way.points[[0, -1]] + np.array([[-room, 0.0], [room, 0.0]])
    ground = np.vstack([ends[0], way.points, ends[1]])
    along = -acceleration if descending else acceleration
    run = contact.traverse(
        ground, body.parts, first - ahead - _CLEARANCE, last + back + _CLEARANCE,
        kinds=body.kinds, acceleration=along, gyration=body.gyration,
        step=step, with_margins=with_margins, with_energy=with_energy, compile_kernel=compiled,
    )  # fmt: skip
    criterion = contact.grade_one(
        ground, body.parts, kinds=body.kinds, acceleration=along, slack=SLACK,
        compile_kernel=compiled,
    )  # fmt: skip
    phase = _phases(run, way, descending)
    return Climb(
        status=run.status,
        descending=descending,
        profile=way,
        outline=body,
        run=run,
        criterion=criterion,
        phases=_found(run, way, phase, descending, _turns(criterion, body, along), compiled)
        if run.margins is not None
        else (),
        happenings=_happenings(run, way, phase, descending),
    )


def _kernel_for(profile: Profile, step: float, compiled: bool | None) -> bool | None:
    """Whether to compile: a long profile is not driven by the plain kernel (seconds a metre)."""
    work = len(profile.points) + float(np.abs(np.diff(profile.points, axis=0)).sum()) / step
    if compiled is None and work > LONG and not contact.numba_is_loaded():
        if not contact.numba_is_installed():
            raise InputError(
                f"profile: {len(profile.points)} points over "
                f"{profile.points[-1, 0] - profile.points[0, 0]:.0f} m are too many without the "
                "compiled kernel: pip install 'kaidan[fast]', or cut or thin the profile"
            )
        compiled = True
    if work > LONGEST:
        raise InputError(
            f"profile: {len(profile.points)} points over "
            f"{profile.points[-1, 0] - profile.points[0, 0]:.0f} m are more than one traverse "
            "takes: cut or thin it"
        )
    return compiled


def _span(way: Profile, descending: bool) -> tuple[float, float]:
    """Where the flight begins and ends along the way: landings lie before and behind."""
    if len(way.nosings) == 0:
        return float(way.points[0, 0]), float(way.points[-1, 0])
    first, last = float(way.nosings[0, 0]), float(way.nosings[-1, 0])
    if descending:  # the foot of the last riser
        last = max(
            last,
            float(way.points[way.points[:, 1] > way.points[-1, 1] + 1e-9, 0].max(initial=last)),
        )
    return first, last


def _phases(run: contact.Traverse, way: Profile, descending: bool) -> NDArray[np.str_]:
    """Phase of each pose, from where its two contacts stand."""
    start_level, end_level = way.points[0, 1], way.points[-1, 1]
    first, last = _span(way, descending)
    rear, front = run.poses[:, 6:8], run.poses[:, 8:10]
    # before the edge whatever the height (measured landings are not level), on it by the height
    entering = (rear[:, 0] < first - _ON) | (
        (np.abs(rear[:, 1] - start_level) < _ON) & (rear[:, 0] <= first + _ON)
    )
    landing = (front[:, 0] > last + _ON) | (
        (np.abs(front[:, 1] - end_level) < _ON) & (front[:, 0] >= last - _ON)
    )
    phase = np.full(len(run.poses), Phase.TRAVERSE.value, dtype="<U8")
    phase[entering] = Phase.ENTER.value
    phase[landing] = Phase.LAND.value
    return phase


def _step(way: Profile, x: float, descending: bool) -> int:
    """Nosing number from the bottom at a place along the way."""
    passed = way.step_of(x)
    return len(way.nosings) - passed + 1 if descending and passed else passed


def _found(
    run: contact.Traverse,
    way: Profile,
    phase: NDArray[np.str_],
    descending: bool,
    turns: tuple[_Turn, ...],
    compiled: bool | None,
) -> tuple[PhaseFound, ...]:
    table = run.margins
    assert table is not None
    swings = _swings(run)
    found = []
    for name in Phase:
        rows = np.flatnonzero(phase == name.value)
        if len(rows) == 0:
            continue
        of = table[rows]
        friction = np.where(np.isfinite(of[:, 0]), of[:, 0], np.inf)
        downhill, side = (7, -1.0) if descending else (6, 1.0)
        below = rows[~_over_the_top(run, way, descending)[rows]]
        of_turns = turns if name is Phase.TRAVERSE else ()
        energy, at = _least_energy(run, rows, side, of_turns, compiled)
        uphill, _ = _least_energy(run, below, -side, of_turns, compiled)
        hardest = int(np.argmax(friction))
        places = run.poses[:, 8]
        found.append(
            PhaseFound(
                phase=name,
                required_friction=float(friction[hardest]),
                required_friction_step=_step(way, float(places[rows[hardest]]), descending),
                energy_margin_mm=1e3 * energy,
                energy_margin_step=_step(way, at, descending),
                uphill_energy_margin_mm=1e3 * uphill,
                static_margin_mm=1e3 * float(np.nanmin(of[:, downhill])),
                traction_over_weight=float(np.nanmax(np.abs(of[:, 5]))) / STANDARD_GRAVITY,
                largest_swing_deg=math.degrees(
                    max((turn for at, turn in swings if phase[at] == name.value), default=0.0)
                ),
                belly_touches=bool((of[:, 15] > 0).any()),
            )
        )
    return tuple(found)


def _least_energy(
    run: contact.Traverse,
    rows: NDArray[np.int64],
    side: float,
    turns: Sequence[_Turn],
    compiled: bool | None,
) -> tuple[float, float]:
    """Smallest rise of the centroid that a fall to one side needs, and at which contact [m].

    Of a pose the flow's own barrier where that side is the nearer, else the pivot's rise, which is
    never more: so only poses whose pivot's rise is below the least found are worked out.
    """
    assert run.margins is not None
    of_turns = [(turn.rise, turn.x) for turn in turns if turn.side == side]
    least, place = min(of_turns, default=(math.inf, math.nan))
    if len(rows) == 0:
        return least, place
    bound = run.margins[rows, 8 if side > 0 else 9]
    order = np.argsort(bound, kind="stable")
    values = np.full(len(rows), np.inf)
    done = 0
    while done < len(order) and bound[order[done]] < min(least, values.min() + _TIE):
        some = order[done : done + _AT_ONCE]
        done += len(some)
        rise, nearer = run.energy(rows[some], compile_kernel=compiled).T
        values[some] = np.where(nearer == side, rise, bound[some])
    if values.min() < least:
        least = float(values.min())
        place = float(run.poses[rows[np.flatnonzero(values <= least + _TIE)[0]], 8])
    return least, place


def _turns(one: contact.GradeOne, body: Outline, along: float) -> tuple[_Turn, ...]:
    """Turn about the contact that stays, of each loss and each gain."""
    C_N, table = body.stance.com_height, one.table
    table = table[table[:, 7] >= 2]
    side, theta, lever = table[:, 0], table[:, 4], table[:, 5]
    x = side * lever + C_N * (np.tan(theta) + along / (STANDARD_GRAVITY * np.cos(theta)))
    rise = edge_energy(x=x, slope=0.0, C_N=C_N, theta_s=theta, psi=0.0, a=along)
    rise = np.where(lever > 0, rise, 0.0)
    return tuple(
        _Turn(*(float(value) for value in turn))
        for turn in zip(side, rise, table[:, 2], strict=True)
    )


def _over_the_top(run: contact.Traverse, way: Profile, descending: bool) -> NDArray[np.bool_]:
    """Poses whose uppermost contact is the last nosing or lies beyond it: no other will come."""
    if len(way.nosings) == 0:
        return np.zeros(len(run.poses), dtype=np.bool_)
    if descending:
        return np.asarray(run.poses[:, 6] <= way.nosings[0, 0] + _ON)
    return np.asarray(run.poses[:, 8] >= way.nosings[-1, 0] - _ON)


def _swings(run: contact.Traverse) -> list[tuple[int, float]]:
    """Row of the pose at which each caught release began, and how far it turned [rad]."""
    rows = []
    for release in run.releases:
        if release[15] == 0.0:
            row = int(np.searchsorted(run.s, release[1], side="right")) - 1
            rows.append((max(row, 0), float(release[9])))
    return rows


def _happenings(
    run: contact.Traverse, way: Profile, phase: NDArray[np.str_], descending: bool
) -> tuple[Happening, ...]:
    told = []
    release = -1
    for code, s, _, _, phi, *_, row in run.events:
        event = contact.Event(int(code))
        at = int(min(max(row, 0), len(run.poses) - 1))
        if event in (contact.Event.NOSE_DROPS, contact.Event.TIPS_BACK):
            release += 1
        caught = event is contact.Event.CAUGHT and 0 <= release < len(run.releases)
        told.append(
            Happening(
                phase=Phase(str(phase[at])),
                step=_step(way, float(run.poses[at, 8]), descending),
                what=event.name.lower().replace("_", "-"),
                way_m=float(s),
                inclination_deg=math.degrees(phi),
                swing_deg=math.degrees(run.releases[release, 9]) if caught else None,
                toppled_with_momentum=bool(run.releases[release, 14] > 0) if caught else None,
            )
        )
    return tuple(told)
