"""The protocol of an experiment: a page to work by, and the sheet to fill in."""

import math
from typing import NamedTuple

from kaidan.lab.rig import protocol_text as text
from kaidan.lab.rig.design import BELOW, Design, design, margin_of, spacings_of
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.robot import Robot

LOADS = (0.2, 0.4, 0.6, 0.8, 1.0, 0.9, 0.7, 0.5, 0.3)
"""Forces of the bench as shares of the weight: up and back, so that creep shows."""


class Protocol(NamedTuple):
    """Two files."""

    page: str
    """What to do, as Markdown."""
    sheet: str
    """What to fill in, as TOML that `RigSheet` reads."""
    design: Design


def protocol_of(
    named: str, robot: Robot, *, spacings: list[float] | None = None, trials: int = 5
) -> Protocol:
    """Protocol for a robot.

    Parameters
    ----------
    named : str
        Name in the catalogue or file, as the sheet has it.
    robot : Robot
        Of known centroid.
    spacings : list of float, optional
        Nosing spacings that the rig has [m]; the paper's shares of L without.
    trials : int
        A condition.

    Raises
    ------
    InputError
        A robot that nobody weighed, or no slope to be tried.
    """
    robot = robot.weighed
    chosen = design(robot, spacings or spacings_of(robot), trials)
    mass = robot.mass
    forces = [None if mass is None else round(share * mass * STANDARD_GRAVITY) for share in LOADS]
    conditions = [
        (1e3 * each.condition.nosing_spacing, math.degrees(each.condition.angle),
         each.condition.direction, each.gain)
        for each in chosen.planned
    ]  # fmt: skip
    parting = _parting(robot, chosen.planned[0].condition.nosing_spacing)
    stance = robot.stance()
    return Protocol(
        page=text.page(
            robot.name, stance.com_from_front, stance.com_height, conditions, trials,
            chosen.expected, forces, parting,
        ),
        sheet=text.sheet(named, mass, conditions, forces, parting),
        design=chosen,
    )  # fmt: skip


def _parting(robot: Robot, near: float) -> list[text.Row]:
    """Spacings in step with the grousers and half off, near one [m]; none: they are not known."""
    s = robot.track.grouser_spacing
    if s is None:
        return []
    n = max(round(near / s), 1)
    return [
        (1e3 * p, math.degrees(margin_of(robot, p) - BELOW), "up", 0.0)
        for p in (n * s, (n + 0.5) * s)
    ]
