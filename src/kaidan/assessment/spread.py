"""How far the inputs' uncertainties carry the contact model's margins.

On a flight of known steps the criterion of no rotation is the closed form, so its samples are the
closed form's own (the same Latin hypercube), less its figure for the sheets. On any other profile
the criterion is cheap: its slopes are finite differences on the profile at hand, and the margins
follow the samples along them, to first order.
"""

import math
from typing import NamedTuple

import numpy as np

from kaidan import contact
from kaidan.assessment.case import Array, Case, Draws, draws, nominal, sample_count, unit_draws
from kaidan.climb import SLACK, Climb
from kaidan.mechanics.margins import margins
from kaidan.outline import Outline
from kaidan.profile import Profile
from kaidan.stairs import Stairs

LARGEST_STEP = 1e-4
"""Largest step of a finite difference [m or rad]: the margins bend over some 0.1, so a tenth of a
millimetre errs by 1e-6 of the slope, and no nosing changes its place in the order of contacts."""


class Spread(NamedTuple):
    """Differences of the margins from their nominal values, one for each sample [rad]."""

    tip_downhill: Array
    tip_uphill: Array
    angle: Array
    """Of the slope itself: it goes off the margins of slip and drive in full."""
    friction: Array
    """Of the static friction [1]."""


def spread(case: Case, found: Climb) -> Spread | None:
    """Spread of the margins of a case.

    Parameters
    ----------
    case : Case
        The question.
    found : Climb
        Its traverse.

    Returns
    -------
    Spread or None
        None where every input is taken as exact.
    """
    sigma = np.array(case.spread)
    if not sigma.any():
        return None
    drawn = unit_draws(sample_count(case)) * sigma[:, None]
    along = case.profile is not None or found.criterion.outside
    down, up = _to_first_order(case, found, drawn) if along else _by_closed_form(case)
    return Spread(down, up, drawn[3], drawn[5])


def _by_closed_form(case: Case) -> tuple[Array, Array]:
    """Tip margins of the samples, less those of the sheets' figures [rad]; minus infinity: none."""
    at = nominal(case, case.stance)
    known = _tips(case, at)
    each = [_tips(case, block) for block in draws(case, at)]
    down, up = (np.minimum.reduce([block[side] for block in each]) - known[side] for side in (0, 1))
    return np.where(np.isnan(down), -np.inf, down), np.where(np.isnan(up), -np.inf, up)


def _tips(case: Case, at: Draws) -> tuple[Array, Array]:
    """Margins downhill and uphill of each sample, over the steps [rad]."""
    found = margins(
        L=at.L, C_L=at.C_L, C_N=at.C_N, p=at.p, theta_s=at.theta_s, mu_s=np.nan, a=case.acceleration
    )
    return np.asarray(found.tip_downhill.min(axis=-1)), np.asarray(found.tip_uphill.min(axis=-1))


def _to_first_order(case: Case, found: Climb, drawn: Array) -> tuple[Array, Array]:
    """Tip margins of the samples along the slopes of the criterion, less the known ones [rad]."""
    sigma = np.array(case.spread)
    slopes = np.zeros((2, 5))
    for k in np.flatnonzero(sigma[:5]):
        h = min(float(sigma[k]), LARGEST_STEP)
        ahead, behind = (_margins(case, found, int(k), side * h) for side in (1, -1))
        slopes[:, k] = (ahead - behind) / (2 * h)
    down, up = np.nan_to_num(slopes) @ drawn[:5]
    return down, up


def share_out_of_reach(case: Case, found: Climb) -> float:
    """Probability that fewer than two nosings stay on the track somewhere."""
    if found.criterion.outside and not case.yaw:
        return 1.0
    sigma, drawn = np.array(case.spread), unit_draws(sample_count(case))
    if case.yaw or case.profile is not None or not sigma[[0, 4]].any():
        return 0.0
    length = found.outline.stance.flat_length + sigma[0] * drawn[0]
    spacing = max(math.hypot(*step) for step in case.stairs.regular_steps) + sigma[4] * drawn[4]
    return float(np.mean(2 * spacing > length))


def _margins(case: Case, found: Climb, which: int, by: float) -> Array:
    """Margins downhill and uphill with one input changed, in the order of `unit_draws`."""
    outline, way = found.outline, found.profile
    if which == 0:
        outline = _longer(case, by)
    elif which in (1, 2):
        outline = _moved(found, case, which, by)
    elif case.profile is None:
        angle, spacing = (by, 0.0) if which == 3 else (0.0, by)
        way = Profile.of_stairs(changed_stairs(case.stairs, angle=angle, spacing=spacing))
        way = way.reflected() if found.descending else way
    room = sum(outline.reach) + 1.0
    ends = way.points[[0, -1]] + np.array([[-room, 0.0], [room, 0.0]])
    one = contact.grade_one(
        np.vstack([ends[0], way.points, ends[1]]),
        outline.parts,
        kinds=outline.kinds,
        acceleration=-case.acceleration if found.descending else case.acceleration,
        slack=SLACK,
    )
    back, front = one.back_margin_angle, one.front_margin_angle
    return np.array([front, back] if found.descending else [back, front])


def _longer(case: Case, by: float) -> Outline:
    """Outline with the rear tip moved back."""
    track = case.robot.track
    robot = case.robot.model_copy(
        update={"track": track.model_copy(update={"flat_length": track.flat_length + by})}
    )
    outline = Outline.of(robot, case.posture, case.payload)
    return outline if case.facing == "nose-first" else outline.turned_round()


def _moved(found: Climb, case: Case, which: int, by: float) -> Outline:
    """Outline with the centroid moved back (1) or up (2)."""
    parts = found.outline.parts.copy()
    if which == 2:
        parts[:, [1, 4]] -= by
    else:
        parts[:, [0, 3]] += by if case.facing == "nose-first" else -by
    return found.outline._replace(parts=parts)


def changed_stairs(stairs: Stairs, *, angle: float = 0.0, spacing: float = 0.0) -> Stairs:
    """Flight whose every step from nosing to nosing is steeper and longer by so much."""
    steps = [
        (math.atan2(rise, going) + angle, math.hypot(rise, going) + spacing)
        for rise, going in zip(stairs.step_rises[1:], stairs.step_goings, strict=True)
    ]
    return stairs.model_copy(
        update={
            "rise": None,
            "going": None,
            "first_rise": None,
            "last_rise": None,
            "rises": (stairs.step_rises[0], *(p * math.sin(theta) for theta, p in steps)),
            "goings": tuple(p * math.cos(theta) for theta, p in steps),
        }
    )
