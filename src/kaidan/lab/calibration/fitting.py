"""The fit: a grid of candidates, the likelihood of each, profile intervals."""

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import product
from typing import NamedTuple

from kaidan.lab.calibration.bench import Bench, Count, with_ends
from kaidan.lab.calibration.evidence import Evidence, conditions_fitted
from kaidan.lab.calibration.likelihood import log_likelihood
from kaidan.lab.campaign import Setting
from kaidan.physics import SprungNoses
from kaidan.robot import Robot

WITHIN = 1.92
"""Half the 95 % point of chi squared with one degree of freedom: how far below its maximum the
profile likelihood is at the ends of an interval."""
STIFFNESS = (8e3, 1.1e4, 1.6e4, 2.2e4, 3.2e4, 4.5e4, 6.4e4, 9e4, 1.28e5)
"""Of a nosing [N/m], for a robot of 20 kg."""
RADIUS = (0.005, 0.01, 0.02, 0.03, 0.045, 0.065)
"""Of the ends [m]: a nuisance; the paper gives none."""
GROUND = ("steps", "noses")
"""Steps with treads on which the tail can rest, or nothing but nosings: a nuisance; the text does
not say which the rig had."""

Value = float | str


class Candidate(NamedTuple):
    """One point of the grid, its trials and its likelihood."""

    values: Mapping[str, Value]
    setting: Setting
    counts: tuple[Count, ...]
    """At `conditions_fitted`: below the zone, at both of its ends, where theta_d was measured."""
    log_zone: float
    log_extra: float

    @property
    def log_likelihood(self) -> float:
        """Logarithm of the likelihood of all that is fitted to."""
        return self.log_zone + self.log_extra

    @property
    def extras(self) -> tuple[float, ...]:
        """Extra inclinations of which theta_d is the mean [deg]; empty: every trial fell."""
        below, low, _, at_theta_d = self.counts
        return at_theta_d.extras or low.extras or below.extras


class Interval(NamedTuple):
    """Parameter with its interval."""

    name: str
    best: Value
    low: Value
    """Ends of the 95 % profile interval, as values of the grid."""
    high: Value
    kept: tuple[Value, ...]
    """Values within it."""
    at_edge: bool
    """Whether it reaches an end of the grid and may go on beyond."""


class Fit(NamedTuple):
    """All candidates and what they come to."""

    kind: str
    candidates: tuple[Candidate, ...]

    @property
    def best(self) -> Candidate:
        """The likeliest candidate."""
        return max(self.candidates, key=lambda each: each.log_likelihood)

    @property
    def kept(self) -> tuple[Candidate, ...]:
        """Candidates as likely as the ends of an interval, the likeliest first."""
        floor = self.best.log_likelihood - WITHIN
        kept = [each for each in self.candidates if each.log_likelihood >= floor]
        return tuple(sorted(kept, key=lambda each: -each.log_likelihood))


def compliance_grid(
    robot: Robot,
    stiffness: Sequence[float] = STIFFNESS,
    radius: Sequence[float] = RADIUS,
    ground: Sequence[str] = GROUND,
) -> list[tuple[dict[str, Value], Setting]]:
    """Candidates of the smooth belt on sprung nosings."""
    return [
        (
            {"stiffness_N_m": k, "end_radius_m": r, "ground": on},
            Setting.of(with_ends(robot, r), track=SprungNoses(stiffness=k), ground=on),
        )
        for on, r, k in product(ground, radius, stiffness)
    ]


def fit(
    bench: Bench,
    evidence: Evidence,
    kind: str,
    grid: Sequence[tuple[dict[str, Value], Setting]],
) -> Fit:
    """Fit to the zone and to theta_d, and to nothing else.

    Parameters
    ----------
    bench : Bench
        What runs the trials.
    evidence : Evidence
        Of which only the zone and theta_d are used.
    kind : str
        What is fitted, for the report.
    grid : sequence of (values, setting)
        Candidates.
    """
    conditions = conditions_fitted(evidence)
    counts = bench.counts((setting, each) for _, setting in grid for each in conditions)
    size = len(conditions)
    candidates = []
    for at, (values, setting) in enumerate(grid):
        own = tuple(counts[at * size : (at + 1) * size])
        judged = log_likelihood(evidence, bench.trials, *own)
        candidates.append(Candidate(values, setting, own, *judged))
    return Fit(kind, tuple(candidates))


def intervals(
    candidates: Sequence[Candidate],
    judge: Callable[[Candidate], float] = lambda each: each.log_likelihood,
) -> tuple[Interval, ...]:
    """Profile interval of each parameter, from all that is fitted to or a part of it.

    It has the values whose profile likelihood, the largest over all other parameters, is within
    1.92 (``WITHIN``) of the largest of all.
    """
    best = max(candidates, key=judge)
    found = []
    for name, value in best.values.items():
        profile: dict[Value, float] = {}
        for each in candidates:
            at = each.values[name]
            profile[at] = max(profile.get(at, -math.inf), judge(each))
        places = sorted(profile, key=lambda at: (str(at) if isinstance(at, str) else "", at))
        kept = tuple(at for at in places if profile[at] >= judge(best) - WITHIN)
        numbers = not isinstance(value, str)
        edge = numbers and len(places) > 1 and (kept[0] == places[0] or kept[-1] == places[-1])
        found.append(Interval(name, value, kept[0], kept[-1], kept, edge))
    return tuple(found)
