"""The paper's open questions by grouser phase: what one number explains, and what it refutes."""

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from kaidan.answer import Part
from kaidan.lab.grouser_phase import (
    lead_of_driving,
    limit_at_loss,
    limit_down,
    limit_of_round_end,
    limit_up,
    winding_angle,
)
from kaidan.lab.reproduction import sentences as said
from kaidan.lab.reproduction.printed import MEASURED
from kaidan.mechanics.margin import theta_s_sup
from kaidan.mechanics.yielding import theta_s_sup_yielding

Array = npt.NDArray[np.float64]

AGREES = 2.0
"""What "good agreement" with 46.2 and 37.3 degrees at 200 and 220 mm is taken as: ours [deg]."""
GYRATION = (0.10, 0.18)
"""Radii of gyration between which Kenaf's is taken: ours. A body of 0.6 by 0.18 m whose mass is
spread evenly has 0.18 m [m]."""
ROUND = 0.065
"""Radius of Kenaf's ends, as the catalogue infers it [m]."""
_SPACINGS = np.array([0.150, 0.180, 0.200, 0.220])


class PhaseAt(Part):
    """What grousers of the height that theta_d gives do at one nosing spacing."""

    p_mm: float
    """Nosing spacing [mm]."""
    rigid_deg: float
    """theta_s_sup, Eqs. (19)-(23) [deg]."""
    theta_d_deg: float
    """Largest extra inclination [deg]."""
    up_deg: float
    """Steepest slope up, at rest, at the worst phase [deg]."""
    driven_deg: tuple[float, float]
    """The same at the speed of the tests, for the least and the largest radius of gyration
    [deg]."""
    down_deg: float
    """Steepest slope down, tail first, at rest, at the worst phase [deg]."""
    theta_M_deg: float
    """Down less up, at rest [deg]."""


class Explanation(Part):
    """One way in which the rig's falls might be explained, beside what the text says of them."""

    name: str
    """What the track is taken to be."""
    up_deg: tuple[float, float, float]
    """Steepest slopes up at 150, 200 and 220 mm [deg]."""
    miss_deg: float
    """By how much it misses what the text says of a slope, at most [deg]."""


class GrouserPhase(Part):
    """The closed form of grouser phase beside the text."""

    h_mm: float
    """Height of the grousers that theta_d gives [mm]: the one number that is taken."""
    spacings: tuple[PhaseAt, ...]
    """What follows."""
    explanations: tuple[Explanation, ...]
    """This one and others."""
    lost_beyond_mm: tuple[float, float]
    """Where the lowest nosing is lost, beyond the end of the flat, at rest: bounds without a model
    of the track [mm]."""
    lost_beyond_driven_mm: tuple[float, float]
    """The same at the speed of the tests [mm]."""


def grouser_phase(L: float, C_L: float, C_N: float) -> GrouserPhase:
    """What theta_d alone says of the falls and of theta_M, and how other explanations fare."""
    h = MEASURED.theta_d_at[0] / 1e3 * math.sin(math.radians(MEASURED.theta_d_deg))
    place = _Place(L, C_L, C_N, _SPACINGS)
    return GrouserPhase(
        h_mm=1e3 * h,
        spacings=tuple(_spacings(place, h)),
        explanations=tuple(
            Explanation(name=name, up_deg=_three(up), miss_deg=float(misses(up)))
            for name, up in _explanations(place, h)
        ),
        lost_beyond_mm=_lost_beyond(place, driven=False),
        lost_beyond_driven_mm=_lost_beyond(place, driven=True),
    )


def misses(up: Array) -> Array:
    """By how much slopes at `_SPACINGS`, shape (4, ...) [rad], miss the text, shape (...) [deg]."""
    at_150, _, at_200, at_220 = np.degrees(up)
    low, high = MEASURED.fell_deg
    each = (
        low - at_150,
        at_150 - high,
        MEASURED.rotated_at[1] - at_200,
        at_200 - _FORMULA[0] - AGREES,
        np.abs(at_220 - _FORMULA[1]) - AGREES,
        np.zeros_like(at_150),
    )
    return np.asarray(np.max(each, axis=0))


_FORMULA = (46.2, 37.3)
"""Eqs. (19)-(23) at 200 and 220 mm, with which the text says that falls agree [deg]."""


class _Place(NamedTuple):
    """Robot and nosings in the symbols of the paper."""

    L: float
    C_L: float
    C_N: float
    p: Array

    def __call__(self) -> dict[str, Any]:
        return self._asdict()

    def driven(self, rho: float, *, c: Any = 0.0, w: Any = 0.0, e: Any = 0.0) -> Array:
        """Limit at the loss, with what driving on adds [rad]."""
        rest = limit_at_loss(c=c, w=w, e=e, **self())
        x = np.tan(rest + np.arcsin((c + w) / self.p)) * (self.C_N + c)
        v = MEASURED.speed_mm_s / 1e3
        return np.asarray(rest + lead_of_driving(x=x, C_N=self.C_N + c, v=v, rho=rho))


def _spacings(place: _Place, h: float) -> Iterator[PhaseAt]:
    rigid, up, down = theta_s_sup(**place()), limit_up(h=h, **place()), limit_down(h=h, **place())
    driven = [place.driven(rho, c=h) for rho in GYRATION]
    for at, p in enumerate(place.p):
        yield PhaseAt(
            p_mm=float(1e3 * p),
            rigid_deg=math.degrees(rigid[at]),
            theta_d_deg=math.degrees(math.asin(h / p)),
            up_deg=math.degrees(up[at]),
            driven_deg=(math.degrees(driven[0][at]), math.degrees(driven[1][at])),
            down_deg=math.degrees(down[at]),
            theta_M_deg=math.degrees(down[at] - up[at]),
        )


def _explanations(place: _Place, h: float) -> Iterator[tuple[str, Array]]:
    """Names, and slopes at all spacings [rad]."""
    at_150 = theta_s_sup(**place._replace(p=place.p[0])())
    w_n = h / math.cos(at_150)
    yield said.RIGID, theta_s_sup(**place())
    yield said.PRESSED_IN, theta_s_sup_yielding(w_n=w_n, **place())
    yield said.ROUND_END, limit_of_round_end(R=ROUND, **place())
    yield said.GROUSERS, limit_up(h=h, **place())
    yield said.GROUSERS_DRIVEN, place.driven(sum(GYRATION) / 2, c=h)
    for radius in (0.010, 0.020, ROUND):
        name = said.grousers_and_round_end(1e3 * radius)
        yield name, limit_of_round_end(R=radius, c=h, **place())
    yield said.WOUND, min((_wound(place, h, s) for s in np.arange(0.012, 0.080, 5e-4)), key=misses)


def _wound(place: _Place, h: float, s: float) -> Array:
    """Slopes where each bar leaves the end as the next grouser, s apart, comes to it [rad].

    One nosing has a grouser against it, which bears the pull: the lost one is k spacings below.
    """
    below = np.arange(1, 4)[:, None]
    free = np.where(below <= place.L / place.p, (-below * place.p) % s, np.inf).min(axis=0)
    phi = winding_angle(R=ROUND, delta=free)
    return np.asarray(limit_of_round_end(R=ROUND, c=h, phi=phi, **place()))


def _lost_beyond(place: _Place, *, driven: bool) -> tuple[float, float]:
    """Least and largest e with which some fall w and height c go with all that the text says [mm].

    A track of any kind is meant: the three are the same at all spacings, as they are its own.
    """
    e = 1e-3 * np.arange(-30.0, 40.5, 0.5)[:, None, None]
    c = 1e-3 * np.arange(0.0, 10.5, 1.0)[:, None]
    w = 1e-3 * np.arange(0.0, 30.5, 0.5) - c
    wide = place._replace(p=place.p[:, None, None, None])
    if driven:
        goes = [misses(wide.driven(rho, c=c, w=w, e=e)) == 0.0 for rho in GYRATION]
    else:
        goes = [misses(limit_at_loss(c=c, w=w, e=e, **wide())) == 0.0]
    found = 1e3 * e[np.any(goes, axis=(0, 2, 3))]
    return float(found.min()), float(found.max())


def _three(up: Array) -> tuple[float, float, float]:
    at_150, _, at_200, at_220 = (float(each) for each in np.degrees(up))
    return at_150, at_200, at_220
