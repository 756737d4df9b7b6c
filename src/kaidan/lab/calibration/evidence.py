"""What the paper's text prints of its experiments: what is fitted to, and what is judged blind.

The points of Figs. 13, 16, 19 and 21 stand in its pictures only and are not used.
"""

import math

from kaidan.answer import Part
from kaidan.lab.campaign import Condition

SOURCE = "Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y"
TRIALS = 5
"""Trials a condition: "We performed five trials under the same conditions"."""


class Zone(Part):
    """Slopes at which the robot fell, at one nosing spacing [deg]."""

    nosing_spacing: float
    """[m]"""
    below: float
    """Slope at which none of five trials fell; assumed, the text names none."""
    low: float
    """Lowest slope at which any of five trials fell."""
    high: float
    """Slope at which all of five trials fell."""


class Extra(Part):
    """Extra inclination measured at a condition."""

    nosing_spacing: float
    """[m]"""
    angle: float
    """[deg]"""
    extra: float
    """[deg]"""
    uncertainty: float
    """Standard uncertainty [deg]; assumed, the text gives none."""


class Evidence(Part):
    """Figures of the text, each with where it stands or that it is assumed."""

    zone: Zone
    """Where the robot fell."""
    theta_d: Extra
    """Extra inclination of a robot that did not fall."""
    rotation: Extra
    """No fall here, but a rotation that can be seen: `extra` is what can be seen."""
    theta_M: tuple[float, float]
    """Descending less ascending margin at the zone's spacing [deg]."""
    agreement_at: tuple[float, ...]
    """Nosing spacings at which the text calls the agreement with the formula good [m]."""
    agreement: float
    """What is taken for good agreement [deg]; assumed, the text gives no figure."""


PAPER = Evidence(
    # "the robot fell down at 55.0-57.0 deg in the experiment" (Discussion); 54.0 is ours
    zone=Zone(nosing_spacing=0.150, below=54.0, low=55.0, high=57.0),
    # "in this case, the result was 2.6 deg greater" (Deformation of the track); 0.3 is ours
    theta_d=Extra(nosing_spacing=0.150, angle=56.8, extra=2.6, uncertainty=0.3),
    # "did not occur in this case; however, the robot's body started to exhibit a swinging motion"
    # (Discussion, Fig. 14); that 0.5 deg can be seen on a photograph is ours
    rotation=Extra(nosing_spacing=0.200, angle=44.0, extra=0.5, uncertainty=0.0),
    # "theta_M was between 1.2 and 2.6 deg" (LCM)
    theta_M=(1.2, 2.6),
    # "in good agreement with the predicted values in those areas where the inclination is
    # relatively small" (Discussion); which spacings, and 2 deg, are ours
    agreement_at=(0.200, 0.220),
    agreement=2.0,
)
"""The paper's text."""


def conditions_fitted(evidence: Evidence) -> tuple[Condition, ...]:
    """Conditions whose trials the fit looks at, and no others.

    Below the fall zone, at its lower end, at its upper end, where theta_d was measured.
    """
    zone, measured = evidence.zone, evidence.theta_d
    return (
        condition(zone.nosing_spacing, zone.below),
        condition(zone.nosing_spacing, zone.low),
        condition(zone.nosing_spacing, zone.high),
        condition(measured.nosing_spacing, measured.angle),
    )


def condition(nosing_spacing: float, angle: float, direction: str = "up") -> Condition:
    """Condition at a nosing spacing [m] and a slope [deg]."""
    return Condition.model_validate(
        {"nosing_spacing": nosing_spacing, "angle": math.radians(angle), "direction": direction}
    )
