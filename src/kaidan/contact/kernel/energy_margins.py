"""What it takes to turn the robot off its poses: energy, or a tilt of gravity."""

from __future__ import annotations

import math

from kaidan.contact.codes import ROCKING
from kaidan.contact.entries import entry
from kaidan.contact.kernel.heaps import heap_of, taken
from kaidan.contact.kernel.reserves import barrier, carrying_tilt
from kaidan.contact.layout import Margin, Pose, Release, Scene
from kaidan.contact.memory import Row, Table, empty


@entry
def flow_energy(scene: Scene, poses: Table[Pose], margins: Table[Margin], rows: Row[int]) -> None:
    """Work out the energy margin along the flow, its side and whether it is bounded, at some poses.

    margins: as :func:`kaidan.contact.kernel.margins.pose_margins` has filled them.
    """
    for k in range(len(rows)):
        work_out_energy(scene, poses[rows[k]], margins[rows[k]])


def work_out_energy(scene: Scene, pose: Pose, margin: Margin) -> None:
    """Work out the energy margin along the flow at one pose."""
    x = pose.x
    z = pose.z
    phi = pose.inclination
    kappa = margin.tilt
    rise_back = abs(margin.back_rise)
    rise_front = abs(margin.front_rise)
    # the side with the smaller bound first, the other only if it can be less
    side = 1.0
    pivot = margin.outer_rear
    bound = rise_front
    if rise_front < rise_back:
        side = -1.0
        pivot = margin.outer_front
        bound = rise_back
    bounded, rise, _ = barrier(scene, pivot, Release(x, z, phi, side, kappa), ROCKING)
    if rise > bound:
        pivot = margin.outer_front if side > 0.0 else margin.outer_rear
        other_bounded, other_rise, _ = barrier(
            scene, pivot, Release(x, z, phi, -side, kappa), ROCKING
        )
        if other_rise < rise:
            rise = other_rise
            bounded = other_bounded
            side = -side
    margin.energy = rise
    margin.energy_side = side
    margin.bounded = bounded


def rise_to(margin: Margin, side: float) -> float:
    """Rise until the centroid stands over the contact on one side [m]."""
    return margin.back_rise if side > 0.0 else margin.front_rise


def least_flow_energy(
    scene: Scene, poses: Table[Pose], margins: Table[Margin], rows: Row[int], side: float,
    weights: Row[float], tie: float,
) -> tuple[float, int]:  # fmt: skip
    """Smallest weighted rise of the centroid that a fall to one side needs, of some poses.

    A fall to either side needs the smaller barrier of both along the flow, and a fall to this side
    the rise about its pivot, whichever is more. So only poses whose pivot's rise is below the least
    found are worked out.

    side: +1 back, -1 front.
    weights: of the rise at each pose of the table [1].
    tie: difference of rises that is none [m].

    rise [m], the first row that needs no more (-1: no pose needs a finite one).
    """
    left = len(rows)
    order = empty(int, left)
    pivots = empty(float, left)
    least = math.inf
    for k in range(left):
        order[k] = k
        pivots[k] = weights[rows[k]] * rise_to(margins[rows[k]], side)
    heap_of(order, pivots, left)
    while left > 0 and pivots[order[0]] < least + tie:
        row = rows[taken(order, pivots, left)]
        left -= 1
        if math.isnan(margins[row].energy):
            work_out_energy(scene, poses[row], margins[row])
        rise = max(margins[row].energy, rise_to(margins[row], side))
        least = min(least, weights[row] * rise)
    first = -1
    for k in range(left, len(rows)):
        row = rows[order[k]]
        rise = max(margins[row].energy, rise_to(margins[row], side))
        if weights[row] * rise <= least + tie and least < math.inf:
            first = row if first < 0 else min(first, row)
    return least, first


def pose_tilt(
    scene: Scene, pose: Pose, margin: Margin, side: float, tolerance: float
) -> tuple[float, float]:
    """Tilt of gravity beyond which a pose rotates to one side by more than rocking.

    As :func:`kaidan.contact.kernel.reserves.carrying_tilt`.
    """
    pivot = margin.outer_rear if side > 0.0 else margin.outer_front
    release = Release(pose.x, pose.z, pose.inclination, side, margin.tilt)
    return carrying_tilt(scene, pivot, release, tolerance, margin.without)
