"""A fast stand-in for the trials: Gaussian processes through the figures of a designed study."""

import warnings
from collections.abc import Sequence
from importlib import import_module
from importlib.util import find_spec
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.errors import InputError, MissingExtraError
from kaidan.lab.calibration.design import FIGURES, Point

Array = NDArray[np.float64]

FEWEST = 30
"""Points of one ground below which no emulator is built."""
SMALL = 0.3
"""Extra inclinations are emulated as log(SMALL + angle): they range over two decades [deg]."""
_ROTATIONS = ("theta_d", "rotation_200")


def to_scale(name: str, figure: Array) -> Array:
    """Figure as it is emulated."""
    return np.log(SMALL + figure) if name in _ROTATIONS else figure


def from_scale(name: str, value: Array) -> Array:
    """Figure [deg] of what is emulated."""
    return np.exp(value) - SMALL if name in _ROTATIONS else value


class Emulator(NamedTuple):
    """Gaussian processes of one ground, one a figure."""

    models: tuple[Any, ...]
    """`sklearn.gaussian_process.GaussianProcessRegressor`, in the order of `FIGURES`."""
    coverage: tuple[float, ...]
    """Share of the design's points within the 95 % interval predicted from all others [1]."""
    deviation: tuple[float, ...]
    """Root mean square of what those predictions are off, as emulated."""

    def predict(self, shares: Array, name: str) -> tuple[Array, Array]:
        """Mean and standard deviation of a figure as emulated, of one more experiment.

        Parameters
        ----------
        shares : array, shape (n, axes)
        name : str
            One of `FIGURES`.
        """
        at = [each for each, _ in FIGURES].index(name)
        mean, deviation = self.models[at].predict(shares, return_std=True)
        return mean, deviation


def emulator_of(points: Sequence[Point], seed: int = 0) -> Emulator:
    """Emulator through points of one ground."""
    if find_spec("sklearn") is None:
        raise MissingExtraError("the emulator", "calibration")
    if len(points) < FEWEST:
        raise InputError(
            f"--points: {len(points)} of one ground are too few for an emulator; at least {FEWEST}"
        )
    process: Any = import_module("sklearn.gaussian_process")
    kernels: Any = import_module("sklearn.gaussian_process.kernels")
    shares = np.array([point.shares for point in points])
    models, coverage, deviation = [], [], []
    for at, (name, _) in enumerate(FIGURES):
        figures = to_scale(name, np.array([point.figures[at] for point in points]))
        smooth = kernels.Matern(np.full(shares.shape[1], 0.7), (0.1, 20.0), nu=2.5)
        kernel = kernels.ConstantKernel(1.0, (0.05, 50.0)) * smooth
        kernel += kernels.WhiteKernel(0.1, (1e-3, 2.0))
        model = process.GaussianProcessRegressor(kernel, normalize_y=True, random_state=seed)
        with warnings.catch_warnings():
            # a length at its bound of 20 ranges: the figure does not depend on that parameter
            warnings.filterwarnings("ignore", message="The optimal value found for dimension")
            model.fit(shares, figures)
        off, spread = left_out(model, shares, figures)
        models.append(model)
        coverage.append(float(np.mean(np.abs(off) < 1.96 * spread)))
        deviation.append(float(np.sqrt(np.mean(off**2))))
    return Emulator(tuple(models), tuple(coverage), tuple(deviation))


def left_out(model: Any, shares: Array, figures: Array) -> tuple[Array, Array]:
    """How far each point is from what all others predict, and the deviation they state.

    From the inverse of the covariance: off = [K^-1 y]_i / [K^-1]_ii, variance = 1/[K^-1]_ii.

    References
    ----------
    Rasmussen & Williams 2006, Gaussian Processes for Machine Learning, Eqs. (5.10)-(5.12).
    """
    scale = float(model._y_train_std)
    centred = (figures - float(model._y_train_mean)) / scale
    inverse = np.linalg.inv(model.kernel_(shares))
    own = np.diag(inverse)
    return scale * (inverse @ centred) / own, scale / np.sqrt(own)
