"""Tilt to the fall of each sample of what is in doubt.

A fall is a traverse of its own under tilted gravity, and not one of the criterion's poses. Robot
and terrain of some samples are driven until they fall; a line through these foretells the others;
where it does not tell on which side of the reserve a sample lies that one is driven, too.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.models.findings import Array
from kaidan.models.spread import drawn_of_all, moved_profile, nosings_of
from kaidan.outline import Outline
from kaidan.question import Question
from kaidan.traversal import Traverse
from kaidan.traversal.driving import way
from kaidan.traversal.tilting import LARGEST

DRIVEN = 64
"""Samples that are driven until they fall."""
MOST = 512
"""Samples of which it is driven at most on which side of the reserve they are."""
NEAR = 3.0
"""Standard deviations within which the line does not tell on which side a sample is."""
FAR = math.radians(4.0)
"""Distance from the reserve beyond which samples fall with the first rock [rad]: they are driven
where some rock that are nearer."""
_WITHIN = math.radians(0.03)
_FIRST = math.radians(0.5)


class _Sample(NamedTuple):
    """One sample as it is driven."""

    way: dict[str, Any]
    back: float
    """Sense of the tilt."""

    def survives(self, tilt: float) -> bool:
        return contact.arrives(**self.way, tilt=self.back * tilt)

    def falls_at(self, guess: float) -> float:
        """Tilt to its fall [rad], within `LARGEST`."""
        width = _FIRST
        low = high = guess
        if self.survives(guess):
            while self.survives(high := min(low + width, LARGEST)):
                if high >= LARGEST:
                    return LARGEST
                low, width = high, 2.0 * width
        else:
            while not self.survives(low := max(high - width, -LARGEST)):
                if low <= -LARGEST:
                    return -LARGEST
                high, width = low, 2.0 * width
        while high - low > _WITHIN:
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.survives(middle) else (low, middle)
        return 0.5 * (low + high)


def drawn_falls(
    question: Question,
    found: Traverse,
    first_rock: Array,
    which: NDArray[np.bool_],
    *,
    downhill: bool,
) -> Array:
    """Tilt to the fall of each sample less the reserve [rad].

    first_rock: by how much the tilt to the first rock differs in each sample [rad]; one alone where
        nothing is in doubt.
    """
    nominal = (found.falls_downhill if downhill else found.falls_uphill).tilt
    spare = np.asarray(nominal - question.reserve + first_rock)
    rows = np.flatnonzero(np.broadcast_to(which, spare.shape))
    known = abs(nominal) <= LARGEST
    if len(spare) == 1 or not known or not len(rows) or np.abs(spare[rows]).min() > FAR:
        return spare
    sample = _samples(question, found, downhill)
    # those that rock the most and the least, and as many between
    order = rows[np.argsort(first_rock[rows], kind="stable")]
    places = np.linspace(0, len(order) - 1, DRIVEN).round().astype(int)
    some = order[list(dict.fromkeys(places.tolist()))]
    tilts = np.array([sample(k).falls_at(spare[k] + question.reserve) for k in some.tolist()])
    of_each = _features(question, first_rock)
    line, *_ = np.linalg.lstsq(of_each[some], tilts, rcond=None)
    off = tilts - of_each[some] @ line
    off *= math.sqrt(len(some) / max(len(some) - of_each.shape[1], 1))
    near = NEAR * float(off.std()) + _WITHIN
    of_line = np.asarray(of_each @ line - question.reserve)
    # samples that are not driven are as far off the line as those that are
    foretold = of_line + off[np.arange(len(spare)) % len(off)]
    foretold[some] = tilts - question.reserve
    open_ = np.setdiff1d(rows[np.abs(of_line[rows]) < near], some)
    open_ = open_[np.argsort(of_line[open_], kind="stable")]
    count = min(len(open_), MOST)
    places = np.linspace(0, len(open_) - 1, count).round().astype(int)
    driven = [1.0 if sample(int(k)).survives(question.reserve) else -1.0 for k in open_[places]]
    if driven:  # of those between two that are driven each is on the side of the nearer
        nearest = np.arange(len(open_)) * (count - 1) / max(len(open_) - 1, 1)
        side = np.array(driven)[nearest.round().astype(int)]
        foretold[open_] = np.copysign(foretold[open_], side)
    return np.asarray(foretold)


def _features(question: Question, first_rock: Array) -> Array:
    """What the tilt to the fall is taken as linear in, shape (samples, n)."""
    drawn = drawn_of_all(question)
    each = [row / row.std() for row in (*drawn[:5], first_rock) if row.std() > 0.0]
    return np.column_stack([np.ones(drawn.shape[1]), *each])


def _samples(question: Question, found: Traverse, downhill: bool) -> Callable[[int], _Sample]:
    """Function that makes one sample."""
    drawn = drawn_of_all(question)
    profile, outline = question.profile, question.outline
    nosings = nosings_of(profile, drawn)
    back = 1.0 if downhill is not found.descending else -1.0

    def sample(k: int) -> _Sample:
        terrain = moved_profile(profile, nosings[k])
        body = _changed(outline, *drawn[:3, k].tolist())
        terrain = terrain.reflected() if found.descending else terrain
        body = body if question.facing == "nose-first" else body.turned_round()
        manner = {"acceleration": found.acceleration, "step": found.step}
        return _Sample(way(terrain, body, found.start, found.until) | manner, back)

    return sample


def _changed(outline: Outline, L: float, C_L: float, C_N: float) -> Outline:
    """Outline of a robot whose L, C_L (from the front) and C_N are so much larger [m]."""
    discs = outline.parts.reshape(-1, 3).copy()
    stance = outline.stance
    behind = discs[:, 0] < stance.com_from_front - stance.flat_length / 2
    discs[:, 0] += C_L - L * behind
    discs[:, 1] -= max(C_N, 1e-4 - stance.com_height)
    return replace(outline, parts=discs.reshape(-1, 6))
