"""Worst figures of each phase of a way."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.climb.phases import Phase, over_the_top, step_at
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.oblique import edge_energy
from kaidan.outline import Outline
from kaidan.profile import Profile

_AT_ONCE = 8


_TIE = 1e-9


@dataclass(frozen=True, kw_only=True)
class PhaseFound:
    """Worst figures of a phase; None where it has no pose."""

    phase: Phase
    required_friction: float
    """Largest required friction of any pose [1], but of those that `slides_below` tells of."""
    required_friction_step: int
    slides_below: float | None
    """Friction below which the trailing end slides down the faces of the last risers as the robot
    lands, going down [1]: it goes where it is going, by a riser at most. None: it rests on none."""
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


class Turn(NamedTuple):
    """Turn about the contact that stays, as one is lost or made."""

    side: float
    """+1 to the back, -1 to the front."""
    rise: float
    """Of the centroid [m]."""
    x: float
    """Of the leading end of the flat [m]."""


def worst_of_phases(
    run: contact.Traverse,
    way: Profile,
    phase: NDArray[np.str_],
    descending: bool,
    turns: tuple[Turn, ...],
    room: float,
    compiled: bool | None,
) -> tuple[PhaseFound, ...]:
    """Worst figures of each phase that the way has, in their order."""
    table = run.margins
    assert table is not None
    swung = swings(run)
    found = []
    for name in Phase:
        rows = np.flatnonzero(phase == name.value)
        if len(rows) == 0:
            continue
        of = table[rows]
        friction = np.where(np.isfinite(of[:, 0]), of[:, 0], np.inf)
        downhill, side = (7, -1.0) if descending else (6, 1.0)
        below = rows[~over_the_top(run, way, descending, room)[rows]]
        of_turns = turns if name is Phase.TRAVERSE else ()
        energy, at = _least_energy(run, rows, side, of_turns, compiled)
        uphill, _ = _least_energy(run, below, -side, of_turns, compiled)
        slides = np.zeros(len(rows), dtype=np.bool_)
        if descending and name is Phase.LAND:  # the trailing contact presses on a steep face
            slides = np.abs(run.poses[rows, 10]) > run.poses[rows, 11]
        held = np.where(slides, 0.0, friction)
        hardest = int(np.flatnonzero(held >= held.max() - _TIE)[0])  # inf - _TIE is inf
        places = run.poses[:, 8]
        found.append(
            PhaseFound(
                phase=name,
                required_friction=float(held[hardest]),
                slides_below=float(friction[slides].max()) if slides.any() else None,
                required_friction_step=step_at(way, float(places[rows[hardest]]), descending),
                energy_margin_mm=1e3 * energy,
                energy_margin_step=step_at(way, at, descending),
                uphill_energy_margin_mm=1e3 * uphill,
                static_margin_mm=1e3 * float(np.nanmin(of[:, downhill])),
                traction_over_weight=float(np.nanmax(np.abs(of[:, 5]))) / STANDARD_GRAVITY,
                largest_swing_deg=math.degrees(
                    max((turn for at, turn in swung if phase[at] == name.value), default=0.0)
                ),
                belly_touches=bool((of[:, 15] > 0).any()),
            )
        )
    return tuple(found)


def _least_energy(
    run: contact.Traverse,
    rows: NDArray[np.int64],
    side: float,
    turns: Sequence[Turn],
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


def turns_about_stays(one: contact.GradeOne, body: Outline, along: float) -> tuple[Turn, ...]:
    """Turn about the contact that stays, of each loss and each gain."""
    C_N, table = body.stance.com_height, one.table
    table = table[table[:, 7] >= 2]
    side, theta, lever = table[:, 0], table[:, 4], table[:, 5]
    x = side * lever + C_N * (np.tan(theta) + along / (STANDARD_GRAVITY * np.cos(theta)))
    rise = edge_energy(x=x, slope=0.0, C_N=C_N, theta_s=theta, psi=0.0, a=along)
    rise = np.where(lever > 0, rise, 0.0)
    return tuple(
        Turn(*(float(value) for value in turn))
        for turn in zip(side, rise, table[:, 2], strict=True)
    )


def swings(run: contact.Traverse) -> list[tuple[int, float]]:
    """Row of the pose at which each caught release began, and how far it turned [rad]."""
    rows = []
    for release in run.releases:
        if release[15] == 0.0:
            rows.append((run.row_before(float(release[1])), float(release[9])))
    return rows
