"""What levels, faces and the floor have in common in their errors: the range, and which way is up.

A level is the mean height of the points of a tread, a face the mean place of those of a riser. Each
errs as the range does in the directions in which its points were seen, so what lies in nearly the
same directions errs alike: the first tread and the floor before it, two treads far up. And each is
taken to be level or plumb along the axes of the levelled cloud: where these are off from what was
built, a mean is off by how far its points lie from the nosing.
"""

import math

import numpy as np

from kaidan.readers.kinds import Array, Indices

LOCAL, ALIKE_WITHIN = 0.25, 0.16
"""Share of the doubt of the range that differs from one direction to the next [1], and the angle
over which its correlation falls to 1/e [rad]: what calibrating a sensor leaves is smooth."""
SMALLEST = 1e-4
"""Standard uncertainty of a face or a level at best [m]: what was built is not flatter."""
PLACED = 300
"""Points from which it is taken where an element lies."""


def place_of(s: Array, t: Array, z: Array, rows: Indices) -> Array:
    """Mean place of some points, and their standard deviations along s, t, z, shape (2, 3) [m]."""
    some = rows[:: max(1, len(rows) // PLACED)]
    points = np.array([s[some], t[some], z[some]])
    return np.array([points.mean(axis=1), points.std(axis=1)])


def correlation(middle: Array, spread: Array) -> Array:
    """Correlations of the means of a field over elements, the field having variance 1.

    The field is a function of the direction that is correlated by exp(-(angle / a)^2). With the
    weights of a normal distribution of the directions d in which an element is seen, of mean m and
    covariance S, the integral is

        rho_ij = exp(-(m_i - m_j)^T (a^2 + 2 S_i + 2 S_j)^-1 (m_i - m_j))
                 / sqrt(det(1 + 2 (S_i + S_j) / a^2)).

    middle, spread, shape (p, 3): of the points of each element, from the sensor, and their standard
        deviations [m].

    Shape (p, p): below 1 on the diagonal, because a mean averages the field out.
    """
    away = np.maximum(np.linalg.norm(middle, axis=1), 1e-6)
    ray = middle / away[:, None]
    across = np.eye(3) - ray[:, :, None] * ray[:, None, :]
    seen = (across * (spread / away[:, None])[:, None, :] ** 2) @ across
    i, j = np.triu_indices(len(middle))
    wide = np.eye(3) + 2.0 / ALIKE_WITHIN**2 * (seen[i] + seen[j])
    apart = (ray[i] - ray[j]) / ALIKE_WITHIN
    near = np.einsum("ni,ni->n", apart, np.linalg.solve(wide, apart[:, :, None])[:, :, 0])
    found = np.empty((len(middle), len(middle)))
    found[i, j] = found[j, i] = np.exp(-near) / np.sqrt(np.linalg.det(wide))
    return found


def common(nosings: Array, places: Array, *, eye: Array, range_error: float, level: float) -> Array:
    """Covariance that faces, levels and the floor have because of the range and of up.

    nosings, shape (m, 2): (s, z) [m].
    places, shape (2 m + 1, 2, 3): `place_of` the face and the level of each nosing in turn, and of
        the floor.
    eye, shape (3,): the sensor [m].
    range_error: doubt of measured distances as a share of them [1].
    level: standard uncertainty of up against what was built [rad].

    Shape (2 m + 1, 2 m + 1): [m^2]
    """
    count = len(nosings)
    middle = places[:, 0] - eye
    axis = np.r_[np.tile([0, 2], count), 2]
    errs = LOCAL * range_error * middle[np.arange(2 * count + 1), axis]
    # the face of a riser is leant by its height below the nosing, a level by its distance ahead
    faces = nosings[:, 1] - places[:-1:2, 0, 2]
    levels = places[1::2, 0, 0] - nosings[:, 0]
    lever = np.r_[np.column_stack([faces, levels]).ravel(), places[-1, 0, 0] - nosings[0, 0]]
    found = correlation(middle, places[:, 1]) * np.outer(errs, errs)
    return np.asarray(found + level**2 * np.outer(lever, lever))


def across(width: float) -> float:
    """Standard deviation of points that lie evenly over a width [m]."""
    return width / math.sqrt(12.0)
