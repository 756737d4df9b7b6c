"""The governing pose, just after the lowest nosing has left: its contacts and measures."""

import math
from typing import NamedTuple

import numpy as np

from kaidan.assessment.answer import Contact, Measures
from kaidan.assessment.case import Array, Case
from kaidan.assessment.closed_form import Judgement
from kaidan.mechanics import STANDARD_GRAVITY, loads, measures
from kaidan.mechanics.plane import contact_count
from kaidan.mechanics.slipping import equivalent_slope
from kaidan.mechanics.triangle import alpha, beta, theta_alpha, theta_beta


class Pose(NamedTuple):
    """Robot on the governing step, its lowest nosing just lost (state C of the paper)."""

    L: float
    C_L: float
    """Centroid behind the UPHILL end [m]."""
    C_N: float
    theta_s: float
    p: float
    n: int

    @property
    def places(self) -> Array:
        """Contacts behind the uphill end of the flat, from the highest down [m]."""
        lowest = self.L - self.p
        return lowest - self.p * np.arange(max(1, self.n) - 1, -1, -1, dtype=np.float64)


def governing_pose(case: Case, found: Judgement) -> Pose:
    """Pose of a judgement, with the sheets' figures."""
    at = found.nominal
    L, p = float(at.L[0, 0]), float(at.p[0, found.step])
    return Pose(
        L=L,
        C_L=float(at.C_L[0, 0]),
        C_N=float(at.C_N[0, 0]),
        theta_s=float(at.theta_s[0, found.step]),
        p=p,
        n=int(contact_count(L=L, p=p)),
    )


def contacts_at(pose: Pose, a: float, mass: float | None) -> tuple[Contact, ...]:
    """Contacts of a pose with their loads, all working alike; empty where nothing holds it."""
    x_z = loads.zero_moment_point(C_L=pose.C_L, C_N=pose.C_N, theta_s=pose.theta_s, a=a)
    shares = loads.load_shares(x=pose.places, x_z=x_z)
    if np.isnan(shares).any():
        return ()
    slope = float(equivalent_slope(theta_s=pose.theta_s, a=a))
    weight = None if mass is None else mass * STANDARD_GRAVITY * math.cos(pose.theta_s)
    return tuple(
        Contact(
            behind_uphill_tip_m=place,
            load_share=share,
            normal_N=None if weight is None else share * weight,
            traction_N=None if weight is None else share * weight * slope,
            required_friction=abs(slope),
        )
        for place, share in zip(pose.places.tolist(), shares.tolist(), strict=True)
    )


def measures_at(pose: Pose, a: float, mass: float | None, speed: float | None) -> Measures:
    """Published stability measures of a pose, without allowances."""
    highest, lowest = float(pose.places[0]), float(pose.places[-1])
    com = {"C_L": pose.C_L, "C_N": pose.C_N}
    angle = pose.theta_s
    k = pose.n - 1
    static = min(
        float(measures.static_margin_downhill(x_0=lowest, theta_s=angle, **com)),
        float(measures.static_margin_uphill(x_n=highest, theta_s=angle, **com)),
    )
    x_z = loads.zero_moment_point(theta_s=angle, a=a, **com)
    backward = measures.energy_margin_backward(
        alpha=alpha(d=highest, k=k, p=pose.p, **com),
        theta_alpha=theta_alpha(d=highest, k=k, p=pose.p, **com),
        theta_s=angle,
    )
    forward = measures.energy_margin_forward(
        beta=beta(d=highest, **com), theta_beta=theta_beta(d=highest, **com), theta_s=angle
    )
    force_angle = None
    if mass is not None:
        force_angle = float(
            measures.force_angle_measure(x_0=lowest, x_n=highest, theta_s=angle, a=a, M=mass, **com)
        )
    height = None if speed is None else 1e3 * float(measures.kinetic_energy_height(v=speed))
    return Measures(
        static_margin_mm=1e3 * static,
        zmp_margin_mm=1e3 * float(measures.zero_moment_margin(x_z=x_z, x_0=lowest, x_n=highest)),
        energy_margin_mm=1e3 * float(measures.energy_margin(backward=backward, forward=forward)),
        force_angle_Nm_rad=force_angle,
        speed_height_mm=height,
    )
