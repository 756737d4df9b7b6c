"""Touching heights over a whole map of places and inclinations, in array operations."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from kaidan.contact.kernel.trigonometry import cos, sin
from kaidan.contact.records import Body, BoolArray, Ground
from kaidan.contact.tables import FloatArray


class TouchingHeights(NamedTuple):
    """Arrays of shape (inclinations, places)."""

    z: FloatArray
    """Lowest height of the centroid at which nothing is penetrated [m]."""
    contact_x: FloatArray
    """Contact point, along [m]."""
    contact_z: FloatArray
    """Contact point, up [m]."""


def touching_heights(
    ground: Ground, body: Body, x: FloatArray, inclination: FloatArray
) -> TouchingHeights:
    """Touching height and contact point for all pairs of a place and an inclination.

    Parameters
    ----------
    ground, body
        Of a path.
    x
        Places of the centroid (n,) [m], increasing.
    inclination
        Inclinations (m,) [rad], within 90 degrees.

    Returns
    -------
    TouchingHeights
        As the kernel's `touching` gives them one by one.
    """
    shape = (len(inclination), len(x))
    best, at_x, at_z = np.full(shape, -np.inf), np.zeros(shape), np.zeros(shape)
    c, s = (np.array([of(each) for each in inclination.tolist()])[:, None] for of in (cos, sin))

    def offer(
        z: FloatArray, p_x: FloatArray | float, p_z: FloatArray | float, valid: BoolArray
    ) -> None:
        better = valid & (z > best)
        best[better] = z[better]
        at_x[better] = np.broadcast_to(p_x, shape)[better]
        at_z[better] = np.broadcast_to(p_z, shape)[better]

    for part in body.table:
        ends = [part["one"], part["two"]]
        discs = [
            (c * end["x"] - s * end["z"], s * end["x"] + c * end["z"], float(end["r"]))
            for end in ends
        ]
        e_x = c * part["e_x"] - s * part["e_z"]
        e_z = s * part["e_x"] + c * part["e_z"]
        turn = np.where(e_x < 0, -1.0, 1.0)
        n_x = part["sine"] * e_x + part["cosine"] * turn * e_z
        n_z = part["sine"] * e_z - part["cosine"] * turn * e_x
        (t1_x, t1_z), (t2_x, t2_z) = [(d_x + r * n_x, d_z + r * n_z) for d_x, d_z, r in discs]
        wide = np.where(np.abs(t2_x - t1_x) < 1e-12, 1e-12, t2_x - t1_x)
        slope = (t2_z - t1_z) / wide
        reach = max(math.hypot(end["x"], end["z"]) + end["r"] for end in ends)
        for g_x, g_z, u_x, u_z, length, convex in ground.table[:-1].tolist():
            if g_x > x[-1] + reach or g_x + length * u_x < x[0] - reach:
                continue
            if convex:
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
    return TouchingHeights(best, at_x, at_z)
