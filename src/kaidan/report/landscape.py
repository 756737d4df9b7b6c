"""The energy landscape: height of the touching centroid over its place and the inclination.

A stable pose is a valley along the inclination, the pose that a release must climb over a ridge.
Exact on the grid: every corner under every part, and both end discs on every segment.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.report.journey import Journey

Array = NDArray[np.float64]

COLUMNS, ROWS = 420, 181
"""Size of the grid: places of the centroid, inclinations."""
STEPS_SHOWN = 4
"""Regular steps that are shown of a long flight."""


class Landscape(NamedTuple):
    """Heights and levers on a grid; rows: inclination, columns: place of the centroid."""

    found: Journey
    x: Array
    """Centroid, along the way [m]."""
    phi: Array
    """Inclination, leading end up [rad]."""
    z: Array
    """Touching height of the centroid [m], shape (rows, columns)."""
    delta: Array
    """Lever: how far the contact lies ahead of the centroid [m]; positive turns the leading end
    up."""
    arm: Array
    """Height of the centroid above its contact [m]: turning by dphi moves it by -arm dphi."""

    @property
    def above(self) -> Array:
        """Height above the lowest pose at the same place [m]."""
        return np.asarray(self.z - self.z.min(axis=0))

    @property
    def stable(self) -> NDArray[np.bool_]:
        """Cells, between rows, where the lever turns from up to down: valleys."""
        return np.asarray((self.delta[:-1] > 0) & (self.delta[1:] <= 0))

    @property
    def ridges(self) -> NDArray[np.bool_]:
        """Cells, between rows, where the lever turns from down to up."""
        return np.asarray((self.delta[:-1] <= 0) & (self.delta[1:] > 0))


def landscape_of(found: Journey, *, columns: int = COLUMNS, rows: int = ROWS) -> Landscape:
    """Landscape along the way of a traverse, of a long flight its first steps.

    Acceleration tilts gravity by the direction of the path; here it is taken along the slope.
    """
    run, profile = found.found.run, found.found.profile
    left, right = float(run.x.min()), float(run.x.max())
    if len(profile.nosings) > STEPS_SHOWN + 2:
        going = float(np.median(np.diff(profile.nosings[:, 0])))
        reach = sum(found.found.outline.reach)
        right = min(right, left + 2 * reach + (STEPS_SHOWN + 1) * going)
    room = 0.03 * (right - left) + 0.02
    x = np.linspace(left - room, right + room, columns)
    low, high = float(run.inclination.min()), float(run.inclination.max())
    phi = np.linspace(max(low - math.radians(20), -1.55), min(high + math.radians(30), 1.55), rows)
    z, contact, level = _touching(run.ground, run.body, x, phi)
    margins = run.margins
    kappa = 0.0
    if margins is not None and len(margins):
        kappa = float(np.median(margins[:, 17]))
    return Landscape(found, x, phi, z, contact - x + kappa * (z - level), z - level)


def _touching(ground: Array, body: Array, x: Array, phi: Array) -> tuple[Array, Array, Array]:
    """Touching height and contact point for all pairs of a place and an inclination."""
    shape = (len(phi), len(x))
    best, at_x, at_z = np.full(shape, -np.inf), np.zeros(shape), np.zeros(shape)
    c, s = np.cos(phi)[:, None], np.sin(phi)[:, None]

    def offer(z: Array, p_x: Array | float, p_z: Array | float, valid: NDArray[np.bool_]) -> None:
        better = valid & (z > best)
        best[better] = z[better]
        at_x[better] = np.broadcast_to(p_x, shape)[better]
        at_z[better] = np.broadcast_to(p_z, shape)[better]

    for part in body:
        discs = [
            (c * part[j] - s * part[j + 1], s * part[j] + c * part[j + 1], float(part[j + 2]))
            for j in (0, 3)
        ]
        e_x, e_z = c * part[6] - s * part[7], s * part[6] + c * part[7]
        turn = np.where(e_x < 0, -1.0, 1.0)
        n_x = part[9] * e_x + part[10] * turn * e_z
        n_z = part[9] * e_z - part[10] * turn * e_x
        (t1_x, t1_z), (t2_x, t2_z) = [(d_x + r * n_x, d_z + r * n_z) for d_x, d_z, r in discs]
        wide = np.where(np.abs(t2_x - t1_x) < 1e-12, 1e-12, t2_x - t1_x)
        slope = (t2_z - t1_z) / wide
        reach = max(math.hypot(part[j], part[j + 1]) + part[j + 2] for j in (0, 3))
        for k in range(len(ground) - 1):
            g_x, g_z, u_x, u_z, length, convex = ground[k]
            if g_x > x[-1] + reach or g_x + length * u_x < x[0] - reach:
                continue
            if convex == 1.0:
                d = g_x - x
                flat = (d - t1_x) * (d - t2_x) <= 0
                offer(g_z - (t1_z + slope * (d - t1_x)), g_x, g_z, flat)
                for d_x, d_z, r in discs:
                    under = r * r - (d - d_x) ** 2
                    z = g_z - (d_z - np.sqrt(np.maximum(under, 0.0)))
                    offer(z, g_x, g_z, ~flat & (under >= 0))
            if u_x > 1e-9:
                for d_x, d_z, r in discs:
                    to_x = x + d_x - g_x
                    foot = to_x + r * u_z
                    valid = (foot >= 0) & (foot <= length * u_x)
                    z = g_z + (r + u_z * to_x) / u_x - d_z
                    offer(z, g_x + foot, g_z + foot * u_z / u_x, valid)
    return best, at_x, at_z
