"""Control of the acceleration over the position, a(d), through area E.

Inside area E no single acceleration holds the robot over a whole nosing spacing, but one that
follows the position may: brake where the lowest contact has just left, accelerate where it is
about to leave. What the drive can do decides. Kinetic energy per mass E = v^2 / 2 obeys
dE/dd = a, so the question is whether E can stay between two bounds while a stays within a band.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.plane import contact_count, two_contacts_remain
from kaidan.mechanics.tipping import a_r0, a_rn
from kaidan.mechanics.validity import validity

Array = NDArray[np.float64]


class Band(NamedTuple):
    """Band of acceleration that tipping allows, cell by cell over one nosing spacing."""

    edges: Array
    """Progress at the edges of the cells [m], shape (cells + 1,)."""
    lower: Array
    """Largest a_rn within each cell [m/s^2], shape (cells,)."""
    upper: Array
    """Smallest a_r0 within each cell [m/s^2], shape (cells,)."""


class Plan(NamedTuple):
    """An acceleration over the path and the speed it gives."""

    a: Array
    """Acceleration along the path in each cell [m/s^2], shape (cells,); NaN without a plan."""
    v: Array
    """Speed at the edges of the cells [m/s], shape (cells + 1,); NaN without a plan."""
    reserve: float
    """Distance of the acceleration from its band everywhere [m/s^2]; NaN without a plan."""


def tip_band(
    *,
    L: float,
    p: float,
    C_L: float,
    C_N: float,
    theta_s: float,
    cells: int = 200,
    g: float = STANDARD_GRAVITY,
) -> Band:
    """Band of acceleration between tipping downhill and uphill over one nosing spacing.

    ``a_rn(d) <= a <= a_r0(d)``, both increasing in d but for the drop of a_r0 where the lowest
    contact leaves (an edge of the cells), so that each cell's tightest values stand at its ends.

    Parameters
    ----------
    cells : int
        Number of cells.

    Returns
    -------
    Band
        NaN where p > L / 2.

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eqs. (15), (16) and Fig. 7.
    """
    n = float(contact_count(L=L, p=p))
    d_C = min(max(L - n * p, 0.0), p)
    before = max(1, min(cells - 1, round(cells * d_C / p))) if d_C > 0 else 0
    edges = np.concatenate(
        [np.linspace(0.0, d_C, before + 1)[:before], np.linspace(d_C, p, cells - before + 1)]
    )
    k = np.where(np.arange(cells) < before, n, n - 1)
    inside = float(validity(holds=two_contacts_remain(L=L, p=p)))
    upper = inside * a_r0(s=edges[:-1] + k * p, theta_s=theta_s, C_L=C_L, C_N=C_N, g=g)
    lower = inside * a_rn(d=edges[1:], theta_s=theta_s, C_L=C_L, C_N=C_N, g=g)
    return Band(edges, lower, upper)


def acceleration_plan(
    *,
    lower: Array,
    upper: Array,
    width: Array,
    v_max: float,
    v_min: float = 0.0,
    v_start: float | None = None,
) -> Plan:
    """Acceleration over a whole path that keeps to its band and to the speed limits.

    The set of energies from which the rest of the path can be driven is an interval; it is
    carried back cell by cell, ``[E_lo - upper w, E_hi - lower w]`` cut to the speed limits. If it
    is empty at the start there is no plan: the answer is exact for accelerations constant within
    a cell. Of all plans the one with the largest reserve to its band is taken (bisection), then
    the gentlest acceleration in each cell.

    Parameters
    ----------
    lower, upper : array
        Band of the acceleration along the path in each cell [m/s^2], shape (cells,).
    width : array
        Length of each cell [m], shape (cells,).
    v_max, v_min : float
        Speed limits [m/s].
    v_start : float, optional
        Speed at the start [m/s]; the middle of what works without one.

    Returns
    -------
    Plan
        NaN throughout where no plan exists.

    Examples
    --------
    >>> one = np.ones(2)
    >>> up, down = np.array([2.0, -1.0]), np.array([1.0, -2.0])
    >>> plan = acceleration_plan(lower=down, upper=up, width=0.1 * one, v_max=1.0)
    >>> print(plan.a, round(plan.reserve, 6))
    [ 1.5 -1.5] 0.5

    References
    ----------
    Derived; area E is of Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y.
    """
    limits = (v_min**2 / 2, v_max**2 / 2)
    low, high = lower.tolist(), upper.tolist()
    cell = width.tolist()
    reserve = min((h - b for b, h in zip(low, high, strict=True)), default=0.0) / 2
    nothing = Plan(np.full(len(cell), np.nan), np.full(len(cell) + 1, np.nan), float("nan"))
    if reserve < 0 or _viable(low, high, cell, limits, 0.0, v_start) is None:
        return nothing
    if _viable(low, high, cell, limits, reserve, v_start) is None:
        failing, reserve = reserve, 0.0
        for _ in range(40):
            middle = (reserve + failing) / 2
            if _viable(low, high, cell, limits, middle, v_start) is None:
                failing = middle
            else:
                reserve = middle
    viable = _viable(low, high, cell, limits, reserve, v_start)
    assert viable is not None
    energy = (sum(viable[0]) / 2) if v_start is None else v_start**2 / 2
    energies, plan = [energy], []
    for b, h, w, (floor, ceiling) in zip(low, high, cell, viable[1:], strict=True):
        least = max(b + reserve, (floor - energy) / w)
        most = min(h - reserve, (ceiling - energy) / w)
        plan.append(min(max(0.0, least), max(least, most)))
        energy = min(max(energy + plan[-1] * w, floor), ceiling)
        energies.append(energy)
    return Plan(np.array(plan), np.sqrt(2 * np.array(energies)), reserve)


def _viable(
    lower: list[float],
    upper: list[float],
    width: list[float],
    limits: tuple[float, float],
    reserve: float,
    v_start: float | None,
) -> list[tuple[float, float]] | None:
    """Energies at each edge from which the rest can be driven; None where there are none."""
    floor, ceiling = limits
    intervals = [limits]
    for b, h, w in zip(reversed(lower), reversed(upper), reversed(width), strict=True):
        floor = max(limits[0], floor - (h - reserve) * w)
        ceiling = min(limits[1], ceiling - (b + reserve) * w)
        if floor > ceiling:
            return None
        intervals.append((floor, ceiling))
    if v_start is not None and not floor <= v_start**2 / 2 <= ceiling:
        return None
    return intervals[::-1]
