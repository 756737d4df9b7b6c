"""What theta_d and the fall zone leave of a yielding track: a region, not a point."""

import math
from collections.abc import Mapping
from importlib import import_module
from importlib.util import find_spec
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.errors import MissingExtraError
from kaidan.lab.calibration.design import AXES, FIGURES
from kaidan.lab.calibration.emulator import Emulator, from_scale, to_scale
from kaidan.lab.calibration.evidence import TRIALS, Evidence

Array = NDArray[np.float64]

SCATTER = 0.5
"""Standard deviation of the slope from which single trials fall, beside the emulator's [deg]:
start offsets; assumed."""
WALKERS, STEPS = 40, 1500


class Draws(NamedTuple):
    """Posterior draws."""

    shares: Array
    """Of the ranges of `AXES`, shape (draws, axes)."""
    steps: NDArray[np.bool_]
    """Whether the ground has treads."""
    figures: dict[str, Array]
    """Predicted figures [deg], with the emulator's doubt, by name."""
    autocorrelation: float
    """Longest autocorrelation time of a parameter [steps]."""
    acceptance: float
    """Share of proposals that were taken [1]."""


def log_likelihood(evidence: Evidence, margin: Array, spread: Array, extra: Array, doubt: Array
                   ) -> Array:  # fmt: skip
    """Logarithm of the likelihood of the fall zone and of theta_d, and of nothing else.

    margin, spread: slope from which it falls at the zone's spacing, and its standard deviation
        [deg].

    Notes
    -----
    A trial falls at a slope with the probability that its own margin, normal about `margin`, is
    below it. None of five fall below the zone, one or more at its lower end, all at its upper end.
    """
    zone, measured = evidence.zone, evidence.theta_d
    width = np.hypot(SCATTER, spread)

    log_ndtr: Any = import_module("scipy.special").log_ndtr

    def falls(slope: float) -> Array:
        return np.asarray(log_ndtr((slope - margin) / width))

    def stands(slope: float) -> Array:
        return np.asarray(log_ndtr((margin - slope) / width))

    none = np.minimum(TRIALS * stands(zone.low), -1e-12)
    found = TRIALS * stands(zone.below) + np.log(-np.expm1(none)) + TRIALS * falls(zone.high)
    value = float(to_scale("theta_d", np.array(measured.extra)))
    narrow = measured.uncertainty / (measured.extra + 0.3)
    variance = narrow**2 + doubt**2
    found += -0.5 * ((extra - value) ** 2 / variance + np.log(variance))
    return np.asarray(found)


def posterior(
    emulators: Mapping[str, Emulator], evidence: Evidence, *, seed: int = 0, steps: int = STEPS
) -> Draws:
    """Draws from the posterior, uniform over the shares of the ranges and over both grounds.

    emulators: by ground, "steps" and "noses".
    evidence: of which only the zone and theta_d are used.
    steps: of each of the sampler's walkers; a third of them is thrown away.
    """
    if find_spec("emcee") is None:
        raise MissingExtraError("the posterior", "calibration")
    emcee: Any = import_module("emcee")
    axes = len(AXES)

    def predicted(places: Array, name: str) -> tuple[Array, Array]:
        on_steps = places[:, axes] < 0.5
        mean, spread = np.empty(len(places)), np.empty(len(places))
        for ground, where in (("steps", on_steps), ("noses", ~on_steps)):
            if where.any():
                found = emulators[ground].predict(places[where, :axes], name)
                mean[where], spread[where] = found
        return mean, spread

    def log_posterior(places: Array) -> Array:
        inside = ((places >= 0.0) & (places <= 1.0)).all(axis=1)
        found = np.full(len(places), -math.inf)
        if inside.any():
            found[inside] = log_likelihood(
                evidence,
                *predicted(places[inside], "margin_150"),
                *predicted(places[inside], "theta_d"),
            )
        return found

    state = np.random.default_rng(seed)
    start = state.random((WALKERS * 20, axes + 1))
    start = start[np.argsort(-log_posterior(start))[:WALKERS]]
    moves = [(emcee.moves.DEMove(), 0.8), (emcee.moves.DESnookerMove(), 0.2)]
    sampler = emcee.EnsembleSampler(WALKERS, axes + 1, log_posterior, vectorize=True, moves=moves)
    sampler._random = np.random.RandomState(seed)
    sampler.run_mcmc(start, steps, skip_initial_state_check=True)
    chain = sampler.get_chain(discard=steps // 3, flat=True)
    kept = chain[state.choice(len(chain), size=min(4000, len(chain)), replace=False)]
    figures = {}
    for name, _ in FIGURES:
        mean, spread = predicted(kept, name)
        figures[name] = from_scale(name, mean + spread * state.standard_normal(len(mean)))
    return Draws(
        shares=kept[:, :axes],
        steps=kept[:, axes] < 0.5,
        figures=figures,
        autocorrelation=float(np.max(sampler.get_autocorr_time(quiet=True, tol=0))),
        acceptance=float(np.mean(sampler.acceptance_fraction)),
    )
