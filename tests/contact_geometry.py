"""Robots and ground by geometry alone, no kernel code: how near the parts lie to the ground."""

import math

import numpy as np


def outline_distance(part, p):
    """Distance of points from the hull of two discs, negative within."""
    a, b = complex(part[0], part[1]), complex(part[3], part[4])
    along = (b - a) / abs(b - a)
    q = (p - a) * along.conjugate()
    u, v = q.real, abs(q.imag)
    sine = (part[2] - part[5]) / abs(b - a)
    cosine = math.sqrt(1.0 - sine * sine)
    w = u * cosine - v * sine
    flat = np.where(
        w < abs(b - a) * cosine,
        u * sine + v * cosine,
        np.hypot(u - abs(b - a), v) + part[2] - part[5],
    )
    return np.where(w > 0.0, flat, np.hypot(u, v)) - part[2]


def room(ground, parts, c, phi):
    """Least distance between parts and ground at each pose; `parts` with ends apart."""
    turn = np.exp(-1j * phi)[:, None]
    points = ground["x"] + 1j * ground["z"]
    starts, u = points[:-1], (ground["u_x"] + 1j * ground["u_z"])[:-1]
    length = ground["length"][:-1]
    least = np.full(len(c), np.inf)
    for part in parts:
        least = np.minimum(least, outline_distance(part, (points - c[:, None]) * turn).min(1))
        for x, z, r in (part[:3], part[3:]):
            centre = c + complex(x, z) / turn[:, 0]
            off = (centre[:, None] - starts) * u.conj()
            away = np.abs(off - np.clip(off.real, 0.0, length)).min(1)
            least = np.minimum(least, away - r)
        # no part runs through the ground, between two of its points
        a, b = (c + complex(*part[i : i + 2]) / turn[:, 0] for i in (0, 3))
        axis = a + (b - a) * np.linspace(0.0, 1.0, 30)[:, None]
        above = axis.imag - np.interp(axis.real, points.real, points.imag)
        least = np.minimum(least, above.min(0))
    return least
