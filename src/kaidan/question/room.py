"""Room that the robot of a question needs on its way, whatever lies in it."""

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

from kaidan.mechanics.clearance import OFF_LINE, YAW, headroom_needed, lane_width

if TYPE_CHECKING:
    from kaidan.robot import Payload, Posture, Robot

REARING = math.radians(15.0)
"""Inclination beyond that of the flight, of a robot that meets a riser [rad]."""


class Needs(NamedTuple):
    """Room that a robot needs in the postures of its plan [m]; NaN: its sheet does not say."""

    straight: float
    """Width, going straight."""
    off_line: float
    """Width, off line by what a driver corrects."""
    flat: float
    """Height plumb above the line of the nosings, lying flat on them."""
    rearing: float
    """The same, rearing as it does when it meets a riser."""


def needs_of(
    robot: "Robot", postures: Iterable["Posture"], payload: Iterable["Payload"], slope: float
) -> Needs:
    """Room that a robot needs on a slope in its postures, with a payload."""
    from kaidan.outline import Outline, footprint_of, height_of

    outlines = [Outline.of(robot, posture, payload) for posture in dict.fromkeys(postures)]
    length = max(sum(outline.reach) for outline in outlines)
    w = max(footprint_of(robot, outline).width for outline in outlines)
    H = max(height_of(robot, outline) for outline in outlines)
    flat, rearing = (
        float(headroom_needed(height=H, length=length, theta_s=slope, phi=slope + more))
        for more in (0.0, REARING)
    )
    return Needs(w, float(lane_width(w=w, length=length, psi=YAW, error=OFF_LINE)), flat, rearing)


def lane_of(robot: "Robot") -> float:
    """Width that a robot needs off line, in any posture [m]; NaN: of unknown width."""
    from kaidan.outline import Outline
    from kaidan.robot import Posture

    flat: dict[str, float | str] = dict.fromkeys(robot.flippers(), "flat")
    length = max(sum(Outline.of(robot, each).reach) for each in (Posture(), Posture(**flat)))
    return float(lane_width(w=robot.overall_width, length=length, psi=YAW, error=OFF_LINE))
