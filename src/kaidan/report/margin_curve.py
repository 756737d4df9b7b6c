"""Both slope limits over the nosing spacing: theta_s_sup(p), theta_s_inf(p), allowances off."""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.assessment.allowance import Allowance
from kaidan.assessment.case import Case
from kaidan.assessment.closed_form import judge
from kaidan.mechanics.margin import theta_s_inf, theta_s_sup, theta_s_sup_corrected
from kaidan.mechanics.plane import contact_count, two_contacts_remain
from kaidan.stairs import Stairs

Array = NDArray[np.float64]


class Mark(NamedTuple):
    """Staircase shown beside the limits."""

    name: str
    theta_s: float
    """Slope [rad]."""
    p: float
    """Nosing spacing [m]."""


class MarginCurve(NamedTuple):
    """Slope limits of a robot over the nosing spacing; angles in rad, NaN outside the model."""

    robot: str
    direction: str
    facing: str
    nose_up: bool
    acceleration: float
    L: float
    C_L: float
    """Centroid behind the UPHILL end of the flat [m]."""
    C_N: float
    theta_d: Allowance
    theta_M: Allowance
    outside: str
    """Why the model does not apply at any spacing; empty if it does."""
    p: Array
    n: Array
    theta_s_sup: Array
    theta_s_inf: Array
    """Negative where no slope is too gentle."""
    sup_corrected: tuple[Array, Array]
    """theta_s_sup less the allowances, from the worst reading to the kindest."""
    inf_corrected: tuple[Array, Array]
    """theta_s_inf with theta_d on top, from the worst reading to the kindest."""
    marks: tuple[Mark, ...]

    @property
    def corrected(self) -> bool:
        """Whether there is any allowance."""
        return self.theta_d.high > 0 or self.theta_M.high > 0

    def columns(self) -> dict[str, Any]:
        """Columns of a table, in metres and degrees; NaN where there is no such number."""

        def degrees(angle: Array) -> Array:
            return np.degrees(angle)

        def lower(angle: Array) -> Array:
            return np.degrees(np.where(angle > 0, angle, np.nan))

        return {
            "nosing_spacing_m": self.p,
            "contacts_n": self.n.astype(int),
            "margin_angle_deg": degrees(self.theta_s_sup),
            "margin_angle_corrected_low_deg": degrees(self.sup_corrected[0]),
            "margin_angle_corrected_high_deg": degrees(self.sup_corrected[1]),
            "lower_angle_deg": lower(self.theta_s_inf),
            "lower_angle_corrected_high_deg": lower(self.inf_corrected[0]),
            "lower_angle_corrected_low_deg": lower(self.inf_corrected[1]),
        }

    def as_dict(self) -> dict[str, Any]:
        """Everything, in metres and degrees, for JSON."""
        return {
            "model": "closed-form",
            "robot": self.robot,
            "direction": self.direction,
            "facing": self.facing,
            "acceleration": self.acceleration,
            "flat_length_m": self.L,
            "com_from_uphill_end_m": self.C_L,
            "com_height_m": self.C_N,
            "largest_nosing_spacing_m": self.L / 2,
            "outside": self.outside or None,
            "allowances": {
                name: {
                    "low_deg": math.degrees(value.low),
                    "high_deg": math.degrees(value.high),
                    "source": value.source,
                }
                for name, value in (("theta_d", self.theta_d), ("theta_M", self.theta_M))
            },
            **self.columns(),
            "stairs": [
                {
                    "name": mark.name,
                    "angle_deg": math.degrees(mark.theta_s),
                    "nosing_spacing_m": mark.p,
                    "inside_model": not self.outside
                    and bool(two_contacts_remain(L=self.L, p=mark.p)),
                }
                for mark in self.marks
            ],
        }


def margin_curve(case: Case, p: Array, marks: tuple[Mark, ...] = ()) -> MarginCurve:
    """Slope limits of a case's robot at given nosing spacings.

    Parameters
    ----------
    case : Case
        Robot, posture, payload, acceleration, direction, facing and allowances; its stairs,
        surface and uncertainties play no part.
    p : array
        Nosing spacings [m].
    marks : tuple of Mark
        Stairs to be shown beside them.

    Returns
    -------
    MarginCurve
        NaN where p > L / 2, where the model says nothing.

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eqs. (19)-(24), Fig. 11.
    """
    stance = case.stance
    L, C_N = stance.flat_length, stance.com_height
    C_L = stance.com_from_front if case.nose_up else L - stance.com_from_front
    outside = _outside(case, L)
    inside = np.where(two_contacts_remain(L=L, p=p) & (not outside), 1.0, np.nan)
    with np.errstate(invalid="ignore"):
        sup = inside * theta_s_sup(L=L, p=p, C_L=C_L, C_N=C_N, a=case.acceleration)
        inf = inside * theta_s_inf(p=p, C_L=C_L, C_N=C_N, a=case.acceleration)
    d, M = case.theta_d, case.theta_M
    return MarginCurve(
        robot=case.robot.name,
        direction=case.direction,
        facing=case.facing,
        nose_up=case.nose_up,
        acceleration=case.acceleration,
        L=L,
        C_L=C_L,
        C_N=C_N,
        theta_d=d,
        theta_M=M,
        outside=outside,
        p=p,
        n=contact_count(L=L, p=p),
        theta_s_sup=sup,
        theta_s_inf=inf,
        sup_corrected=(
            theta_s_sup_corrected(theta_s_sup=sup, theta_d=d.high, theta_M=M.high),
            theta_s_sup_corrected(theta_s_sup=sup, theta_d=d.low, theta_M=M.low),
        ),
        inf_corrected=(inf + d.high, inf + d.low),
        marks=marks,
    )


def _outside(case: Case, L: float) -> str:
    """Why the closed form does not apply to the robot whatever the spacing; empty if it does.

    Asked of the judge itself on a long regular flight whose spacing is well inside the model.
    """
    probe = Stairs.inclined(angle=math.pi / 4, nosing_spacing=max(0.03, L / 4), steps=1000)
    return judge(case.changed(stairs=probe)).outside


def mark(stairs: Stairs) -> Mark:
    """Mark of a staircase."""
    return Mark(stairs.name, stairs.angle, stairs.nosing_spacing)
