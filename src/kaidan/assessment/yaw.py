"""Oblique approach: the support polygon of both tracks on a regular flight.

::

        left track     o-------o-------o------     nosings stand gauge tan(psi) farther ahead
                      /                 .
                     / edge downhill     .  edge uphill
                    /                     .
        right track o-------o-------o------

The robot holds without rotation while the zero moment point stays inside the polygon of all
contacts, at every progress. The edge downhill is worst just after a contact is lost, the edge
uphill just before one is made, each on either track: four cases, all in closed form. Over its side
the robot tips about the lower track.
"""

import math
from typing import NamedTuple

import numpy as np

from kaidan.assessment.case import Array, Case, Draws, draws, nominal
from kaidan.errors import InputError
from kaidan.mechanics.measures import kinetic_energy_height
from kaidan.mechanics.oblique import (
    edge_energy,
    edge_limit,
    edge_slack,
    other_offset,
    sideways_limit,
)
from kaidan.stairs import Stairs

LARGEST_YAW = math.radians(80.0)
"""Largest yaw judged [rad]: beyond it the robot drives along the steps, not over them."""
SWING_SPEED = 0.1
"""Speed whose energy the robot is taken to have where none is stated [m/s]: the paper's test
speed, at which the rig swung visibly with 0.07 mm of energy margin against 0.51 mm of v^2/2g."""
SCAN = math.radians(0.25)
"""Step of the search for the yaw at which the verdict changes [rad]."""


def polygon_margins(case: Case, *, yaw: float | None = None, certain: bool = False) -> Array:
    """Margins against tipping over the polygon's edges, worst over the flight's steps.

    Parameters
    ----------
    case : Case
        The question; its robot must have a gauge.
    yaw : float, optional
        Yaw [rad] instead of the case's.
    certain : bool
        The sheets' figures only.

    Returns
    -------
    array, shape (3, samples)
        Downhill, uphill, sideways [rad], without allowances; minus a right angle where a track is
        without any contact at times.
    """
    psi = abs(case.yaw if yaw is None else yaw)
    gauge = gauge_of(case)
    at = nominal(case, case.stance)
    if not certain:
        at = next(draws(case, at))  # one flight has few steps: one block
    each = [(edge.end, _margin(at, case, gauge, psi, edge)) for edge in _edges(at, gauge, psi)]
    down, up = ([margin for end, margin in each if end == which] for which in (1.0, -1.0))
    side = sideways_limit(gauge=gauge, C_N=at.C_N, psi=psi) - at.theta_s
    rows = np.stack([np.minimum(*down), np.minimum(*up), np.broadcast_to(side, at.p.shape)])
    rows = np.where(at.p / math.cos(psi) > at.L, -math.pi / 2, rows)
    return np.asarray(rows.min(axis=-1))


def polygon_energy(case: Case, *, yaw: float | None = None) -> float:
    """Smallest rise of the centroid on its way over any edge, the sheets' figures [m]."""
    psi = abs(case.yaw if yaw is None else yaw)
    gauge, at = gauge_of(case), nominal(case, case.stance)
    rises = [
        edge_energy(
            x=edge.x,
            slope=(edge.left - edge.right) / gauge * edge.end,
            C_N=at.C_N,
            theta_s=at.theta_s,
            psi=psi,
            a=case.acceleration,
        )
        for edge in _edges(at, gauge, psi)
    ]
    # over the lower track: its line lies along the heading
    lean = np.sin(at.theta_s) * math.sin(psi)
    rises.append(
        np.hypot(gauge / 2, at.C_N) * np.hypot(lean, np.cos(at.theta_s))
        - (at.C_N * np.cos(at.theta_s) + gauge / 2 * lean)
    )
    return float(np.min(np.stack(rises)))


class _Edge(NamedTuple):
    """Edge at its worst: places of its ends on the right and the left track."""

    end: float
    """1 downhill, -1 uphill."""
    right: Array
    """From the rear tip downhill, from the front tip uphill [m]."""
    left: Array
    x: Array
    """Its middle downhill of the centroid [m]."""


def _edges(at: Draws, gauge: float, psi: float) -> list[_Edge]:
    q = at.p / math.cos(psi)
    near, far = (other_offset(p=at.p, psi=side * psi, gauge=gauge) for side in (1, -1))
    # downhill just after a loss on the right, on the left; uphill just before a gain on either
    ends = ((1.0, q, near), (1.0, far, q), (-1.0, q, far), (-1.0, near, q))
    return [
        _Edge(
            end,
            right,
            left,
            at.L - at.C_L - (left + right) / 2 if end > 0 else (left + right) / 2 - at.C_L,
        )
        for end, right, left in ends
    ]


def _margin(at: Draws, case: Case, gauge: float, psi: float, edge: _Edge) -> Array:
    """Margin of slope of one edge."""
    kappa = math.cos(psi) + edge.end * (edge.left - edge.right) * math.sin(psi) / gauge
    slack = edge.end * edge_slack(
        x=edge.x, kappa=kappa, C_N=at.C_N, theta_s=at.theta_s, a=case.acceleration
    )
    limit = edge_limit(x=edge.x, kappa=kappa, C_N=at.C_N, a=case.acceleration)
    margin = edge.end * (limit - at.theta_s)
    return np.asarray(np.where(np.isnan(margin), np.copysign(math.pi / 2, slack), margin))


def yaw_limit(case: Case) -> float | None:
    """Yaw from which the robot tips on the flight, allowances off, at the chosen risk.

    Parameters
    ----------
    case : Case
        The question; its own yaw plays no part.

    Returns
    -------
    float or None
        Yaw [rad]; None if it tips without any, if it holds up to the largest yaw judged, or if the
        robot's gauge or the flight is not known. Only the flight is judged, not its ends; the
        friction asked for there does not depend on the yaw.
    """
    if case.robot.track.gauge is None or case.profile is not None or not _holds(case, 0.0):
        return None
    yaws = np.arange(1, math.floor(LARGEST_YAW / SCAN) + 1) * SCAN
    beyond = next((float(psi) for psi in yaws if not _holds(case, float(psi))), None)
    if beyond is None:
        return None
    low, high = beyond - SCAN, beyond
    while high - low > 1e-9:
        middle = (low + high) / 2
        low, high = (middle, high) if _holds(case, middle) else (low, middle)
    return low


def _holds(case: Case, psi: float) -> bool:
    from kaidan.assessment.closed_form import at_risk

    if polygon_energy(case, yaw=psi) <= float(kinetic_energy_height(v=case.speed or SWING_SPEED)):
        return False
    down, up, side = polygon_margins(case, yaw=psi)
    off = case.theta_d.high
    worst = np.minimum(np.minimum(down - off - case.theta_M.high, up - off), side - off)
    return at_risk(worst, case.risk) > 0


def gauge_of(case: Case) -> float:
    """Distance between the tracks, which a yaw asks for."""
    gauge = case.robot.track.gauge
    if gauge is None:
        raise InputError(
            f"robot {case.robot.name!r}: track.gauge is not known, and a yaw needs the distance "
            "between the middles of the tracks"
        )
    return gauge


def along_heading(stairs: Stairs, psi: float) -> Stairs:
    """Flight that loads one track, driven straight up, as these stairs do at a yaw.

    Nosings p / cos(psi) apart on a slope of tan(theta) = tan(theta_s) cos(psi). Its risers are
    cos(theta) / cos(theta_s) times as high as the real ones: entering is judged a little too hard.
    """

    def turned(rise: float, going: float) -> tuple[float, float]:
        slope = math.atan2(rise * math.cos(psi), going)
        spacing = math.hypot(rise, going) / math.cos(psi)
        return spacing * math.sin(slope), spacing * math.cos(slope)

    if stairs.rise is not None and stairs.going is not None:
        rise, going = turned(stairs.rise, stairs.going)
        ends = {
            name: None if value is None else value * rise / stairs.rise
            for name, value in (("first_rise", stairs.first_rise), ("last_rise", stairs.last_rise))
        }
        return stairs.model_copy(update={"rise": rise, "going": going, **ends})
    steps = [turned(*step) for step in zip(stairs.step_rises[1:], stairs.step_goings, strict=True)]
    first = stairs.step_rises[0] * steps[0][0] / stairs.step_rises[1]
    return stairs.model_copy(
        update={
            "rises": (first, *(rise for rise, _ in steps)),
            "goings": tuple(going for _, going in steps),
        }
    )
