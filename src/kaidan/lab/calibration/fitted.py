"""The yielding track as it was fitted to the paper's text, for robots whose sheet has no figures.

Medians of the posterior (docs/lab/calibration.md), whose intervals are wide: a track like the
paper's, not this robot's. A rig measures the robot's own (docs/lab/rig.md).
"""

from typing import Literal

from kaidan.lab.calibration.bench import with_ends
from kaidan.lab.campaign import Setting
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.physics import YieldingBelt
from kaidan.physics.spec import UNPUBLISHED_MASS
from kaidan.robot import Robot

INDENTATION = 0.0041
"""w_n, under the whole weight on one nosing [m]: 48 kN/m for 20 kg."""
SHEAR_RATIO = 1.1
DAMPING_RATIO = 0.05
ENDS = {"kenaf": 0.011}
"""Radius of the ends that was fitted along with it [m], by robot; Kenaf's sheet infers its own."""

From = Literal["stated", "sheet", "fit"]


def fitted(robot: Robot) -> tuple[Robot, YieldingBelt]:
    """Robot and track of a test in which no track is named.

    Returns
    -------
    (Robot, YieldingBelt)
        The sheet's track, where it says how it yields; else the one that was fitted to the paper's
        text, as soft for the robot's weight, with the ends that were fitted for this robot if any.
    """
    track = robot.track
    if track.stiffness is not None or track.indentation is not None:
        return robot, YieldingBelt()
    radius = ENDS.get(robot.name)
    belt = YieldingBelt(
        stiffness=(robot.mass or UNPUBLISHED_MASS) * STANDARD_GRAVITY / INDENTATION,
        shear_ratio=SHEAR_RATIO,
        damping_ratio=DAMPING_RATIO,
    )
    return robot if radius is None else with_ends(robot, radius), belt


def track_from(setting: Setting) -> From:
    """Where the figures of a setting's track come from."""
    track = setting.track
    if not isinstance(track, YieldingBelt):
        return "stated"
    if track.stiffness is None:
        return "sheet"
    same = (track.shear_ratio, track.damping_ratio) == (SHEAR_RATIO, DAMPING_RATIO)
    return "fit" if same else "stated"
