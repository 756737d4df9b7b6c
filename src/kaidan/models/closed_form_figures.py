"""The closed form's own figures: limits, bounds of acceleration, loads, published measures."""

import math
from functools import reduce
from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np

from kaidan.answer import Part
from kaidan.mechanics import STANDARD_GRAVITY, band, drive, loads, measures
from kaidan.mechanics.margin import (
    centroid_margin_downhill,
    centroid_margin_uphill,
    theta_s_inf,
    theta_s_sup,
)
from kaidan.mechanics.margins import AccelerationBounds
from kaidan.mechanics.plane import Area, area, contact_count
from kaidan.mechanics.slipping import equivalent_slope
from kaidan.mechanics.triangle import alpha, beta, theta_alpha, theta_beta
from kaidan.models import acceleration
from kaidan.models.findings import Array, at_risk
from kaidan.models.samples import Draws, draws
from kaidan.question import Question
from kaidan.terrain.stairs import Stairs

AreaName = Literal["A", "B", "C", "DOWNHILL_SLIP", "D", "E"]


class Basis(NamedTuple):
    """On what the closed form's figures stand."""

    at: Draws
    """One row: the sheets' figures."""
    step: int
    """Index of the governing step among the flight's different regular steps."""
    semi_stable: bool
    """Whether an acceleration that follows the position goes through area E."""


class Paper(Part):
    """The paper's own quantities [m/s^2], nose or tail up as requested, without allowances."""

    a_S: float | None
    """Eq. (14) with the smallest friction; null where friction is unknown."""
    min_a_r0: float
    """Smallest value of Eq. (15) over the progress."""
    max_a_rn: float
    """Largest value of Eq. (16) over the progress."""
    a_max: float
    """Eq. (17)."""
    a_min: float
    """Eq. (18): without downhill slip, as printed."""


class Contact(Part):
    """A contact at the governing pose, just after the lowest nosing has left."""

    behind_uphill_tip_m: float
    """Place along the track [m]."""
    load_share: float
    """Share of the normal load, contacts as equal springs [1]."""
    normal_N: float | None
    """Normal force [N]; null where the mass is unknown."""
    traction_N: float | None
    """Tractive force, up the stairs positive, if all contacts work alike [N]."""
    required_friction: float
    """Traction over normal force [1]."""


class Measures(Part):
    """Published stability measures at the governing pose, without allowances."""

    static_margin_mm: float
    """Static stability margin: horizontal distance of the centroid from tipping [mm]."""
    zmp_margin_mm: float
    """Distance of the zero moment point from the nearer end contact, along the track [mm]."""
    energy_margin_mm: float
    """Normalised energy stability margin (Hirose) [mm]."""
    force_angle_Nm_rad: float | None
    """Force-angle measure (Papadopoulos & Rey 1996) [N m rad]; null without a mass."""
    speed_height_mm: float | None
    """Kinetic-energy height v^2 / 2g [mm]; null without a speed."""


class ClosedFormFigures(Part):
    """What the closed form knows of a regular flight beside the margins."""

    shown_as: ClassVar[str] = "closed_form"

    angle_deg: float
    """Slope of the governing step [deg]."""
    nosing_spacing_m: float
    """Nosing to nosing, of the governing step [m]."""
    contacts_n: int
    """n = floor(L / p): nosings that carry the robot after one has left."""
    area: AreaName
    """Area of the paper's d-a plane that the requested acceleration reaches in the worst case: A to
    E, or DOWNHILL_SLIP. E where only an acceleration that follows the position holds it."""
    margin_angle_deg: float
    """theta_s_sup for this robot, spacing, facing and acceleration, without allowances [deg]."""
    lower_angle_deg: float | None
    """theta_s_inf, or null where no slope is too gentle [deg]."""
    margin_backward_deg: float
    """theta_s_sup minus the angle, without allowances [deg]."""
    margin_centroid_mm: float | None
    """How far the centroid may move along the track before a tip limit is crossed, less the
    allowances, at the chosen risk [mm]; negative: how far it is beyond."""
    a_slides_down: float | None
    """Above it the tracks slide down, smallest friction [m/s^2]."""
    a_slides_up: float | None
    """Below it the tracks slide on uphill, smallest friction [m/s^2]."""
    a_tip_downhill: float | None
    """Above it the robot tips over its downhill end [m/s^2]."""
    a_tip_uphill: float | None
    """Below it the robot tips over its uphill end [m/s^2]."""
    a_max: float | None
    """Upper end of the band, slip included, allowances not; null if the band is empty [m/s^2]."""
    a_min: float | None
    """Lower end of the band [m/s^2]."""
    a_max_safe: float | None
    """Upper end less the allowances, at the chosen risk; null if the band is empty [m/s^2]."""
    a_min_safe: float | None
    """Lower end less the allowances, at the chosen risk [m/s^2]."""
    max_start: float | None
    """Max. start acceleration in the direction of travel, a positive number [m/s^2]."""
    max_braking: float | None
    """Max. braking from travel in that direction, a positive number [m/s^2]."""
    paper: Paper
    """The paper's own quantities."""
    contacts: tuple[Contact, ...]
    """Contacts at the governing pose."""
    measures: Measures
    """Published stability measures at the governing pose."""
    traction_N: float | None
    """Sum of the tractive forces, rolling resistance included [N]."""
    power_W: float | None
    """Power at the motors at the requested speed [W]."""


class Pose(NamedTuple):
    """Robot on the governing step, its lowest nosing just lost (state C of the paper)."""

    L: float
    C_L: float
    """Centroid behind the UPHILL end [m]."""
    C_N: float
    theta_s: float
    p: float
    n: int

    @classmethod
    def of(cls, basis: Basis) -> "Pose":
        """Pose of a basis, with the sheets' figures."""
        at = basis.at
        L, p = float(at.L[0, 0]), float(at.p[0, basis.step])
        return cls(
            L=L,
            C_L=float(at.C_L[0, 0]),
            C_N=float(at.C_N[0, 0]),
            theta_s=float(at.theta_s[0, basis.step]),
            p=p,
            n=int(contact_count(L=L, p=p)),
        )

    @property
    def places(self) -> Array:
        """Contacts behind the uphill end of the flat, from the highest down [m]."""
        lowest = self.L - self.p
        return lowest - self.p * np.arange(max(1, self.n) - 1, -1, -1, dtype=np.float64)


def figures_of(question: Question, flight: Stairs, basis: Basis) -> ClosedFormFigures:
    """Figures of a question within the closed form's validity."""
    pose = Pose.of(basis)
    angle, p, a, mass = pose.theta_s, pose.p, question.acceleration, question.stance.mass
    bare, safe = acceleration.bounds(question, basis.at)
    low, high = _band(bare)
    safe_low, safe_high = _band(safe)
    brake = None if safe_low is None else -safe_low
    start, stop = (safe_high, brake) if question.direction == "up" else (brake, safe_high)
    sup = float(theta_s_sup(L=pose.L, p=p, C_L=pose.C_L, C_N=pose.C_N, a=a))
    inf = float(theta_s_inf(p=p, C_L=pose.C_L, C_N=pose.C_N, a=a))
    traction, power = _traction_and_power(question, angle, mass)
    return ClosedFormFigures(
        angle_deg=math.degrees(angle),
        nosing_spacing_m=p,
        contacts_n=pose.n,
        area=_area(question, basis, safe),
        margin_angle_deg=math.degrees(sup),
        lower_angle_deg=math.degrees(inf) if inf > 0 else None,
        margin_backward_deg=math.degrees(sup - angle),
        margin_centroid_mm=1e3 * at_risk(_centroid_margin(question, basis.at), question.risk),
        a_slides_down=bare.slides_down,
        a_slides_up=bare.slides_up,
        a_tip_downhill=bare.tip_downhill,
        a_tip_uphill=bare.tip_uphill,
        a_max=high,
        a_min=low,
        a_max_safe=safe_high,
        a_min_safe=safe_low,
        max_start=start if start is not None and start > 0 else None,
        max_braking=stop if stop is not None and stop > 0 else None,
        paper=Paper(
            a_S=bare.slides_down,
            min_a_r0=bare.tip_downhill,
            max_a_rn=bare.tip_uphill,
            a_max=bare.a_max,
            a_min=band.a_min(max_a_rn=bare.tip_uphill),
        ),
        contacts=contacts_at(pose, a, mass),
        measures=measures_at(pose, a, mass, question.speed),
        traction_N=traction,
        power_W=power,
    )


def _centroid_margin(question: Question, at: Draws) -> Array:
    """How far the centroid may move in the worst case on any step, (samples,) [m]."""
    sunk = question.allowance_d.high
    tilt = sunk + question.allowance_M.high

    def least(block: Draws) -> Array:
        centroid: dict[str, Any] = {
            "p": block.p, "C_L": block.C_L, "C_N": block.C_N, "a": question.acceleration
        }  # fmt: skip
        tilted = block.theta_s + tilt
        downhill = centroid_margin_downhill(L=block.L, theta_s=tilted, **centroid)
        uphill = centroid_margin_uphill(theta_s=block.theta_s - sunk, **centroid)
        upright = np.where(tilted < math.pi / 2, downhill, -np.inf)
        return np.asarray(np.minimum(upright, uphill).min(axis=-1))

    return np.asarray(reduce(np.minimum, map(least, draws(question, at))))


def _band(limits: AccelerationBounds) -> tuple[float | None, float | None]:
    low, high = float(limits.a_min), float(limits.a_max)
    return (low, high) if low < high else (None, None)


def _traction_and_power(
    question: Question, angle: float, mass: float | None
) -> tuple[float | None, float | None]:
    if mass is None:
        return None, None
    force = drive.drive_force(
        M=mass, a=question.acceleration, theta_s=angle, c_rr=question.rolling_resistance
    )
    if question.speed is None:
        return float(force), None
    v = question.speed if question.direction == "up" else -question.speed
    eta = question.robot.drive.efficiency
    return float(force), float(drive.drive_power(F=force, v=v, eta=eta))


def _area(question: Question, basis: Basis, safe: AccelerationBounds) -> Any:
    """Worst area that the requested acceleration reaches over the progress, less allowances."""
    if basis.semi_stable:
        return Area.E.name
    known = question.surface is not None
    limits = {
        "a_S": safe.slides_down if known else np.inf,
        "a_slides_up": safe.slides_up if known else -np.inf,
        "a_r0": safe.tip_downhill,
        "a_rn": safe.tip_uphill,
        "min_a_r0": safe.tip_downhill,
        "max_a_rn": safe.tip_uphill,
    }
    return Area(int(area(a=question.acceleration, **limits))).name


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
