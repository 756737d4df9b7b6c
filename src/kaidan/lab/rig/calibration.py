"""A filled rig sheet as an answer, and as figures of the robot's sheet."""

import math
from typing import Any, ClassVar

from kaidan.answer import Answer, Part
from kaidan.errors import InputError
from kaidan.lab.grouser_phase import limit_at_loss, limit_up
from kaidan.lab.rig.cause import Cause, Contrast, contrast_of
from kaidan.lab.rig.fitting import TOGETHER, Fitted, fit
from kaidan.lab.rig.sheet import RigSheet
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.margin import theta_s_sup, theta_s_sup_corrected
from kaidan.mechanics.yielding import theta_d_two_contacts
from kaidan.robot import Robot


class Figure(Part):
    """A figure with its interval."""

    value: float
    """Of the measurements."""
    low: float
    """Lower end."""
    high: float | None
    """Upper end; null: the measurements do not bound it."""

    @classmethod
    def of(cls, one: Fitted, scale: float = 1.0) -> "Figure":
        """In the unit of the answer."""
        return cls(value=scale * one.value, low=scale * one.low, high=scale * one.high)


class AtSpacing(Part):
    """What was found at one nosing spacing."""

    nosing_spacing_m: float
    """Nosing to nosing [m]."""
    margin_up_deg: Figure | None
    """Slope at which half of the trials fall going up [deg]; null: none was counted."""
    theta_d_deg: Figure | None
    """Extra inclination near the margin [deg]; null: fewer than three measurements."""
    w_n_mm: Figure | None
    """Indentation under the whole weight that the closed form needs for it [mm]."""
    equation_24_deg: float | None
    """Margin up by Eq. (24), theta_s_sup less theta_d and theta_M as measured [deg]; null: one of
    them was not."""
    phase_deg: float | None
    """Margin up by grouser phase at rest, of the height by tape, or else of that which theta_d
    gives [deg]; null: neither is known."""
    film_deg: float | None
    """Margin up at rest if the lowest nosing is lost as filmed [deg]; null: not filmed."""


class RigCalibration(Answer):
    """What a rig sheet says of a robot's track; the intervals hold together with 95 %."""

    text_module: ClassVar[str] = "kaidan.lab.rig.text"

    robot: str
    """Name or file of the robot."""
    mass_kg: float
    """Mass as tested [kg]."""
    trials: int
    """Trials on the stairs that held or fell."""
    stiffness_N_m: Figure | None
    """k, both tracks on one nosing [N/m]; null: fewer than three measurements."""
    shear_stiffness_N_m: Figure | None
    """kt, likewise along the track [N/m]."""
    theta_d_deg: Figure | None
    """theta_d over all spacings: the mean, and the ends of all intervals [deg]."""
    theta_M_deg: Figure | None
    """theta_M, margin going down less that going up [deg]; null: not tried both ways."""
    spacings: tuple[AtSpacing, ...]
    """Each nosing spacing."""
    cause: Cause | None
    """What gives theta_d, by the trials with the belt set: grousers, rubber, both, or undecided;
    null: not tried."""
    cause_mm: Figure | None
    """How much of theta_d times p the belt's phase makes [mm]: the grousers' height, or nothing."""
    rear_radius_m: float | None
    """Of the tail, by tape [m]."""
    grouser_height_m: float | None
    """By tape [m]."""
    grouser_spacing_m: float | None
    """By tape [m]."""
    agrees: bool | None
    """Whether the bench's k and the closed form's agree within their intervals at every spacing;
    null: one of them is not known."""
    together: float
    """Probability with which all intervals hold [1]."""

    def figures(self) -> dict[str, float]:
        """Figures of the robot's sheet by their dotted names, SI."""
        found: dict[str, float] = {"mass": self.mass_kg}
        for name, length in (
            ("track.rear_radius", self.rear_radius_m),
            ("track.grouser_height", self.grouser_height_m),
            ("track.grouser_spacing", self.grouser_spacing_m),
        ):
            if length is not None:
                found[name] = float(f"{length:.4g}")
        for name, one in (
            ("track.stiffness", self.stiffness_N_m),
            ("track.shear_stiffness", self.shear_stiffness_N_m),
        ):
            if one is not None:
                found[name] = float(f"{one.value:.4g}")
        for name, angle in (("theta_d", self.theta_d_deg), ("theta_M", self.theta_M_deg)):
            if angle is not None and angle.high is not None:
                low, high = (min(max(each, 0.0), 34.0) for each in (angle.low, angle.high))
                found[f"{name}.low"] = round(math.radians(low), 5)
                found[f"{name}.high"] = round(math.radians(high), 5)
        return found


def calibrate_rig(sheet: RigSheet) -> RigCalibration:
    """Fit what a rig sheet has.

    Raises
    ------
    InputError
        Nothing is filled in, or measurements that no line goes through.
    MissingExtraError
        scipy is not installed.
    """
    robot = Robot.named(sheet.robot).weighed
    k, kt, tilts, margins = fit(sheet)
    if k is None and kt is None and not tilts and not margins.up:
        raise InputError(
            "rig: nothing is filled in: three measurements or a counted trial at least"
        )
    weight = sheet.mass * STANDARD_GRAVITY
    contrast = contrast_of(sheet)
    rows, agrees = [], None if k is None else True
    for p in sorted({*tilts, *margins.up}):
        tilt = tilts.get(p)
        needed = None if tilt is None else _indentation(robot, sheet, p, tilt)
        if needed is not None and k is not None and agrees is not None:
            agrees = agrees and needed.low <= weight / k.low and weight / k.high <= needed.high
        rows.append(
            AtSpacing(
                nosing_spacing_m=p,
                margin_up_deg=_degrees(margins.up.get(p)),
                theta_d_deg=_degrees(tilt),
                w_n_mm=None if needed is None else Figure.of(needed, 1e3),
                **_closed_forms(robot, sheet, p, tilt, margins.theta_M),
            )
        )
    if not any(row.w_n_mm for row in rows):
        agrees = None
    return RigCalibration(
        robot=sheet.robot,
        mass_kg=sheet.mass,
        trials=sum(each.held + each.fell for each in sheet.trials),
        stiffness_N_m=None if k is None else Figure.of(k),
        shear_stiffness_N_m=None if kt is None else Figure.of(kt),
        theta_d_deg=_hull(list(tilts.values())),
        theta_M_deg=_degrees(margins.theta_M),
        spacings=tuple(rows),
        **_causes(contrast),
        rear_radius_m=sheet.rear_radius,
        grouser_height_m=sheet.grouser_height,
        grouser_spacing_m=sheet.grouser_spacing,
        agrees=agrees,
        together=TOGETHER,
    )


def _causes(contrast: Contrast | None) -> dict[str, Any]:
    if contrast is None:
        return {"cause": None, "cause_mm": None}
    return {"cause": contrast.cause, "cause_mm": Figure.of(contrast.rise, 1e3)}


def _closed_forms(
    robot: Robot, sheet: RigSheet, p: float, tilt: Fitted | None, theta_M: Fitted | None
) -> dict[str, float | None]:
    """Margins up at a spacing by closed forms [deg]."""
    stance, lost = robot.stance(), [each for each in sheet.film if each.nosing_spacing == p]
    place = {
        "L": stance.flat_length,
        "p": p,
        "C_L": stance.com_from_front,
        "C_N": stance.com_height,
    }
    h = sheet.grouser_height
    if h is None and tilt is not None:
        h = p * math.sin(tilt.value)
    found: dict[str, float | None] = dict.fromkeys(("equation_24_deg", "phase_deg", "film_deg"))
    if tilt is not None and theta_M is not None:
        corrected = theta_s_sup_corrected(
            theta_s_sup=theta_s_sup(**place), theta_d=tilt.value, theta_M=theta_M.value
        )
        found["equation_24_deg"] = math.degrees(corrected)
    if h is not None:
        found["phase_deg"] = math.degrees(limit_up(h=h, **place))
    if lost:
        w = sum(each.below for each in lost) / len(lost)
        e = sum(each.beyond for each in lost) / len(lost)
        found["film_deg"] = math.degrees(limit_at_loss(c=h or 0.0, w=w, e=e, **place))
    return found


def _degrees(one: Fitted | None) -> Figure | None:
    return None if one is None else Figure.of(one, math.degrees(1.0))


def _hull(each: list[Fitted]) -> Figure | None:
    if not each:
        return None
    return Figure(
        value=math.degrees(sum(one.value for one in each) / len(each)),
        low=math.degrees(min(one.low for one in each)),
        high=math.degrees(max(one.high for one in each)),
    )


def _indentation(robot: Robot, sheet: RigSheet, p: float, tilt: Fitted) -> Fitted | None:
    """w_n that gives theta_d by the closed form [m]; None: none does."""
    at = [each for each in sheet.trials if each.nosing_spacing == p and len(each.extra) > 2]
    angle = max(each.angle for each in at if each.direction == "up")
    stance = robot.stance()

    def of(w_n: float) -> float:
        return float(
            theta_d_two_contacts(
                L=stance.flat_length,
                p=p,
                C_L=stance.com_from_front,
                C_N=stance.com_height,
                theta_s=angle,
                w_n=w_n,
            )
        )

    ends = []
    for target in (tilt.value, tilt.low, tilt.high):
        low, high = 0.0, 0.08
        for _ in range(60):
            middle = 0.5 * (low + high)
            found = of(middle)
            low, high = (middle, high) if found < target else (low, middle)
        ends.append(0.5 * (low + high))
    known = abs(of(ends[0]) - tilt.value) < 1e-3
    return Fitted(*ends) if known else None
