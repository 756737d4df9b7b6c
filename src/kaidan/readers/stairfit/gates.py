"""What is no staircase, and why: the gates that an estimate has to pass."""

import math

import numpy as np

from kaidan.readers.estimate import Refusal
from kaidan.readers.kinds import Provenance
from kaidan.readers.stairfit.corridor import Lane
from kaidan.readers.stairfit.echo import RISES, SPACINGS
from kaidan.readers.stairfit.patches import Patches
from kaidan.readers.stairfit.steps import Steps
from kaidan.readers.stairfit.turning_steps import turn_of

ANGLES = (math.radians(15.0), math.radians(60.0))
"""Slopes between which stairs lie [rad]."""
LEAST_GOING = 0.12
"""Shortest going of stairs [m]: the least for dwellings in Japan is 150 mm; stacks have less."""
FEWEST_NOSINGS, STEEP, LOW = 3, math.radians(45.0), 0.1
"""Nosings that a flight has at least; one more where it is steeper than this [rad], or its risers
are lower than this [m], the least that IBC 1011.5.2 has, as stacks of things are."""
RESIDUAL = 0.010
"""Median distance of points from the steps that is always allowed [m]; two sigma of the noise
otherwise."""
EXPLAINED = 0.45
"""Least share of the points about a flight that lie on its steps, chance subtracted [1]; 45
flights that were cast had 0.53 and more, look-alikes up to 0.43 that pass the other gates."""
EXPLAINED_OF_FEW = 0.56
"""The same of a flight of three nosings [1]: 20 that were cast had 0.63 and more, ends of ramps up
to 0.50."""
DEPTHS = (0.8, 1.25)
"""Scatter about the line of the nosings over that of steps [1]: flights had 1.00 to 1.18, heaps and
shelves up to 1.7."""
EVEN = 0.3
"""Points of every second step over those of the others [1]: 90 flights had 0.61 and more, seats of
a grandstand of twice the height, each with an empty step between them, up to 0.1."""
LEVEL = 0.7
"""Least share of the points on treads whose plane is level [1]."""
SLANTED = 0.5
"""Slope of treads, or lean of risers, over that of the flight from which they are nearer to a ramp
than to steps [1]: 500 flights had up to 0.2, ramps with battens and without 0.4 to 1.1."""
MEASURED = 0.8
"""Least share of nosings whose front or level was seen [1]."""
IRREGULAR = 0.045
"""Largest root mean square of nosings off a regular flight [m]."""
HIDDEN = 0.4
"""Scatter as a share of the rise that hides steps [1]."""


def refused(
    steps: Steps | None, lane: Lane, noise: float, provenance: Provenance
) -> Refusal | None:
    """Reason why a lane is no flight of stairs; None: it is one."""
    line = lane.line
    angle = math.atan2(line.rise, line.going)
    spacing = math.hypot(line.rise, line.going)
    if steps is None or len(steps.at) < FEWEST_NOSINGS:
        most = FEWEST_NOSINGS - 1  # of those that the line has, fewer than these could be measured
        seen = min(line.last - line.first, most) if steps is None else len(steps.at)
        return Refusal("too-few", {"steps": seen, "needed": FEWEST_NOSINGS}, provenance)
    if angle > ANGLES[1]:
        return Refusal("ladder", {"angle_deg": math.degrees(angle)}, provenance)
    if (
        line.rise < RISES[0]
        or line.going < LEAST_GOING
        or angle < ANGLES[0]
        or not SPACINGS[0] <= spacing <= SPACINGS[1]
    ):
        return Refusal("none", {}, provenance)
    if len(steps.at) == FEWEST_NOSINGS and (angle > STEEP or line.rise < LOW):
        return Refusal(
            "too-few", {"steps": FEWEST_NOSINGS, "needed": FEWEST_NOSINGS + 1}, provenance
        )
    if noise > HIDDEN * line.rise or steps.residual > max(RESIDUAL, 2 * noise):
        return Refusal("noisy", {"residual_mm": 1e3 * max(noise, steps.residual)}, provenance)
    if steps.depth < DEPTHS[0] or abs(steps.slant) > SLANTED:
        numbers = {"angle_deg": math.degrees(angle), "residual_mm": 1e3 * steps.residual}
        return Refusal("ramp", numbers, provenance)
    if steps.depth > DEPTHS[1] or steps.evenness < EVEN:
        return Refusal("none", {}, provenance)
    if steps.measured.mean(axis=0).max() < MEASURED:
        return Refusal("none", {}, provenance)
    few = len(steps.at) == FEWEST_NOSINGS
    if steps.explained < (EXPLAINED_OF_FEW if few else EXPLAINED) or steps.level < LEVEL:
        return Refusal("rubble", {"residual_mm": 1e3 * steps.residual}, provenance)
    word, turn = turn_of(steps.angles)
    if word:
        numbers = {"turn_deg": math.degrees(turn), "steps": len(steps.at)}
        return Refusal(word, numbers, provenance)
    number = np.arange(len(steps.at))
    off = steps.at - np.column_stack(
        [np.polyval(np.polyfit(number, steps.at[:, axis], 1), number) for axis in (0, 1)]
    )
    spread = float(np.sqrt(np.mean(off**2)))
    if spread > IRREGULAR:
        return Refusal("irregular", {"spread_mm": 1e3 * spread}, provenance)
    return None


def surface_refusal(patches: Patches, provenance: Provenance) -> list[Refusal]:
    """What the cloud is instead of stairs, if it is one inclined or level plane for the most."""
    normal, weight = patches.normal, patches.weight
    if weight.sum() <= 0:
        return []
    slope = np.arccos(np.minimum(np.abs(normal[:, 2]), 1.0))
    inclined = (slope > math.radians(4)) & (slope < math.radians(60))
    if inclined.sum() >= 10:
        some = normal[inclined] * np.sign(normal[inclined, 2:3])
        near = some @ some.T > math.cos(math.radians(6))
        best = int(np.argmax(near @ weight[inclined]))
        share = float(weight[inclined][near[best]].sum() / weight[slope < math.radians(60)].sum())
        if share > 0.25:
            mean = some[near[best]].mean(axis=0)
            angle = math.degrees(math.acos(min(1.0, mean[2] / float(np.linalg.norm(mean)))))
            scatter = 1e3 * float(np.median(patches.thickness[inclined][near[best]]))
            return [Refusal("ramp", {"angle_deg": angle, "residual_mm": scatter}, provenance)]
    level = slope < math.radians(4)
    if weight[level].sum() > 0.9 * weight.sum():
        height = 1e3 * float(np.ptp(np.percentile(patches.middle[level, 2], [2, 98])))
        if height < 100:
            return [Refusal("flat", {"height_mm": height}, provenance)]
    return []
