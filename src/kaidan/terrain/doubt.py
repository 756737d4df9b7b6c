"""Doubt of the places of nosings: a covariance, as stated or from the doubts of steps."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.errors import InputError
from kaidan.terrain.polyline import frozen
from kaidan.terrain.stairs import Stairs

Array = NDArray[np.float64]

MOST_DOUBTED = 500
"""Nosings up to which each may have a doubt of its own: their covariance has 1000 rows."""
LARGEST_SIGMA = 0.2
"""Largest standard uncertainty of a nosing's place taken for metres [m]."""
_SYMMETRIC = 1e-9
"""Share of the largest entry of a covariance that is rounding [1]."""


def common_doubts(flight: Stairs, before: int) -> list[Array]:
    """Steps from nosing to nosing that are off with the angle and the spacing of a flight [m].

    The flight's first nosing is number `before`, counted from 0; shape (k, 2) of each.
    """
    steps = np.column_stack([flight.step_goings, flight.step_rises[1:]])
    along = steps / np.hypot(*steps.T)[:, None]
    off = [
        flight.uncertainty.angle * np.column_stack([-steps[:, 1], steps[:, 0]]),
        flight.uncertainty.nosing_spacing * along,
    ]
    still = np.zeros((before + 1, 2))
    return [np.vstack([still, each]) for each in off if each.any()]


def covariance_of_steps(sigma: Array, common: Sequence[Array] = ()) -> Array | None:
    """Covariance of nosings whose steps, one from the other, are in doubt; None: all are exact.

    sigma, shape (m, 2): standard uncertainty of the going and of the rise to each nosing from the
        one before; of the first one from the lower landing [m].
    common, shape (k, 2): standard uncertainties that the first k steps have in common [m].
    """
    if not sigma.any() and not common:
        return None
    _refuse_too_many(len(sigma))
    sums = np.tril(np.ones((len(sigma), len(sigma))))
    factor = np.kron(sums, np.eye(2)) * sigma.ravel()
    found = factor @ factor.T
    for each in common:
        off = np.zeros_like(sigma)
        off[: len(each)] = each
        moved = np.cumsum(off, axis=0).ravel()
        found += np.outer(moved, moved)
    return frozen(found)


def _refuse_too_many(nosings: int) -> None:
    if nosings > MOST_DOUBTED:
        raise InputError(
            f"{nosings} nosings with a doubt of their own are more than {MOST_DOUBTED}: state the "
            "doubt of angle and nosing spacing, or fewer steps"
        )


def covariance_as_stated(nosings: int, sigma: Any, covariance: Any) -> Array | None:
    """Covariance of so many nosings, as stated; None: exact."""
    if sigma is None and covariance is None:
        return None
    if sigma is not None and covariance is not None:
        raise InputError("profile: give either sigma or covariance, not both")
    name, given = ("sigma", sigma) if covariance is None else ("covariance", covariance)
    try:
        found = np.array(given, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"profile: {name} must be numbers") from None
    _refuse_too_many(nosings)
    if name == "sigma" and found.shape == (2,):
        found = np.tile(found, (nosings, 1))
    shape = (nosings, 2) if name == "sigma" else (2 * nosings, 2 * nosings)
    if found.shape != shape:
        raise InputError(
            f"profile: {name} has shape {found.shape}, not {shape}: {nosings} nosings were found"
        )
    sigmas = found if name == "sigma" else np.sqrt(np.abs(np.diag(found)))
    if not (np.isfinite(found).all() and (sigmas >= 0).all() and (sigmas <= LARGEST_SIGMA).all()):
        raise InputError(
            f"profile: {name} has standard uncertainties not within 0 to {LARGEST_SIGMA:g} m"
        )
    if name == "sigma":
        found = np.diag(found.ravel() ** 2)
    elif len(found):
        scale = float(np.abs(found).max())
        if np.abs(found - found.T).max() > _SYMMETRIC * scale:
            raise InputError("profile: covariance is not symmetric")
        if np.linalg.eigvalsh(found).min() < -_SYMMETRIC * scale:
            raise InputError("profile: covariance is not positive semidefinite")
    return frozen(found) if found.any() else None


def doubt_of_a_step(covariance: Array | None) -> tuple[float, float]:
    """Standard uncertainty of a going and of a rise in the root mean square [m]."""
    if covariance is None or len(covariance) < 4:
        return 0.0, 0.0
    of_step = covariance[2:, 2:] + covariance[:-2, :-2] - 2 * covariance[2:, :-2]
    variance = np.diag(of_step).reshape(-1, 2).mean(axis=0)
    going, rise = np.sqrt(np.maximum(variance, 0.0)).tolist()
    return going, rise


def factor(covariance: Array) -> Array:
    """Lower triangular factor of a covariance that may be singular (Cholesky)."""
    factor = np.zeros_like(covariance)
    least = _SYMMETRIC * float(np.diag(covariance).max())
    for j in range(len(covariance)):
        rest = covariance[j:, j] - factor[j:, :j] @ factor[j, :j]
        if rest[0] > least:
            factor[j:, j] = rest / math.sqrt(rest[0])
    return factor
