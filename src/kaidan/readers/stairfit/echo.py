"""Where a cloud repeats itself as stairs do: the autocorrelation of its side view.

Seen from the side, in the plane of distance s and height z, a staircase shifted by one step lies
upon itself, and shifted by half a step it does not. A ramp lies upon itself at any shift along
its slope, a wall at any shift upwards, shelves at shifts straight up. So the autocorrelation at
(going, rise) less that at half of it finds stairs whether treads, risers or both are seen.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.kinds import Array
from kaidan.readers.stairfit.quantiles import median, quantile

CELL = 0.025
"""Side of a cell of the side view [m]."""
LARGEST = (11.0, 7.0)
"""Largest side view along s and z [m]; what is farther from the middle is left out."""
SPACINGS = (0.15, 0.5)
"""Shortest and longest nosing spacing that is stairs [m]."""
ANGLES = (math.radians(14.0), math.radians(60.0))
"""Gentlest and steepest slope that is stairs [rad]."""
RISES, GOINGS = (0.07, 0.32), (0.09, 0.48)
"""Lowest and highest rise, shortest and longest going [m]."""
BLUR = 1.5
"""Blur of the side view before it is compared with itself, twice its variance [cells^2]."""
DIM = 0.4
"""Least share of the clearest repetition's contrast from which one is looked at [1]: of 150 flights
that were cast the right one had 0.57 and more, of 147 of them 0.7."""
_REACH = 62
"""Cells by which it is shifted at most: three times the longest spacing."""
_ACROSS, _UP = np.arange(-20.0, 21.0), np.arange(2.0, 14.0)
"""Shifts along s and z at which it is compared with itself [cells]."""
_FINE = np.linspace(-1.0, 1.0, 17)
"""Shifts about the best one between which it is sharpened [cells]."""


@dataclass(frozen=True)
class Echo:
    """A shift by which the side view lies upon itself."""

    going: float
    """[m], negative: the stairs climb against s."""
    rise: float
    """[m]"""
    contrast: float
    """Share of the occupied cells that do so, less that at half the shift [1]."""


def echoes(s: Array, z: Array, most: int = 3) -> list[Echo]:
    """Best shifts of a side view, those with the largest contrast first."""
    bottom = quantile(z, 0.01)
    inside = (np.abs(s - median(s)) < LARGEST[0] / 2) & (np.abs(z - bottom) < LARGEST[1])
    s, z = s[inside], z[inside]
    if len(s) < 50:
        return []
    columns = ((s - s.min()) / CELL).astype(np.int64)
    rows = ((z - z.min()) / CELL).astype(np.int64)
    shape = tuple(
        _round(max(int(each.max()) + 1 + _REACH, 2 * _REACH + 1)) for each in (columns, rows)
    )
    view = np.bincount(columns * shape[1] + rows, minlength=shape[0] * shape[1])
    view = np.sqrt(np.minimum(view.reshape(shape), 12.0)).astype(np.float32)  # to 1e-6, faster
    # the root of the power: less weight for what repeats at large, such as blobs and floors
    power = np.abs(np.fft.rfft2(view))
    blur = np.exp(-((np.pi * np.fft.fftfreq(shape[0])) ** 2) * BLUR)[:, None] * np.exp(
        -((np.pi * np.fft.rfftfreq(shape[1])) ** 2) * BLUR
    )
    auto = np.fft.irfft2(power * blur.astype(np.float32), shape)
    auto = np.vstack([auto[-_REACH:], auto[: _REACH + 1]])[:, : _REACH + 1].astype(np.float64)
    auto /= max(float(auto[_REACH, 0]), 1e-12)
    half, more = (_on(auto, times * _ACROSS, times * _UP) for times in (0.5, 1.5))
    contrast = np.where(_allowed(), _on(auto, _ACROSS, _UP) - 0.5 * half - 0.5 * more, -1.0)
    found: list[Echo] = []
    for _ in range(most):
        at = np.unravel_index(int(np.argmax(contrast)), contrast.shape)
        if contrast[at] <= (DIM * found[0].contrast if found else 0.0):
            break
        i, k = float(_ACROSS[at[0]]), float(_UP[at[1]])
        found.append(_sharpened(auto, i, k, float(contrast[at])))
        contrast[np.abs(_ACROSS - i)[:, None] + np.abs(_UP - k) <= 3] = -1.0
    return found


@lru_cache(maxsize=1)
def _allowed() -> NDArray[np.bool_]:
    """Shifts that are stairs."""
    across, up = _ACROSS[:, None] * CELL, _UP * CELL
    spacing, angle = np.hypot(across, up), np.arctan2(up, np.abs(across))
    return np.asarray(
        (spacing >= SPACINGS[0] - CELL / 2) & (spacing <= SPACINGS[1] + CELL / 2)
        & (angle >= ANGLES[0] - 0.05) & (angle <= ANGLES[1] + 0.05)
        & (np.abs(across) >= GOINGS[0] - 0.01) & (up >= RISES[0] - 0.01)
    )  # fmt: skip


def _sharpened(auto: Array, i: float, k: float, contrast: float) -> Echo:
    """Shift between cells, from that of one, two and three steps at once."""
    across, up = i + _FINE, k + _FINE
    many = [steps for steps in (1, 2, 3) if steps * (max(abs(i), k) + 1) < _REACH - 1]
    total = sum(_on(auto, steps * across, steps * up) for steps in many)
    at = np.unravel_index(int(np.argmax(total)), (len(across), len(up)))
    return Echo(float(across[at[0]]) * CELL, float(up[at[1]]) * CELL, contrast)


def _on(auto: Array, i: Array, k: Array) -> Array:
    """Autocorrelation on a grid of shifts between cells, bilinear, shape (len(i), len(k))."""
    i = i + _REACH
    i0, k0 = np.floor(i).astype(np.int64), np.floor(k).astype(np.int64)
    i1, k1 = np.minimum(i0 + 1, 2 * _REACH), np.minimum(k0 + 1, _REACH)
    fi, fk = (i - i0)[:, None], k - k0
    along = auto.take(i0, axis=0) * (1 - fi) + auto.take(i1, axis=0) * fi
    return np.asarray(along.take(k0, axis=1) * (1 - fk) + along.take(k1, axis=1) * fk)


def _round(count: int) -> int:
    """Next number without prime factors above 5, which the transform likes."""
    while True:
        rest = count
        for prime in (2, 3, 5):
            while rest % prime == 0:
                rest //= prime
        if rest == 1:
            return count
        count += 1
