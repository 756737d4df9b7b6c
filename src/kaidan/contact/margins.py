r"""Every margin at every pose of a traverse.

::

              C
             /|\         back: to the rear contact       front: to the front contact
        rear  |  front    static stability: distance of the gravity line from each contact
      ----o---+---o----   energy: rise of C before it stands over that contact
"""

from __future__ import annotations

import math

import numpy as np

from kaidan.contact.compiling import entry, kernel
from kaidan.contact.forces import contacts_at, two_contact_forces
from kaidan.contact.release import barrier
from kaidan.contact.tables import FloatArray, IntArray

MARGIN_COLUMNS = 21


@kernel
def pivot_rise(p_x: float, p_z: float, x: float, z: float, kappa: float) -> float:
    """Rise of the centroid until it stands over a fixed point (Hirose's energy margin) [m].

    alpha [1 - sin(angle)], angle of the line point to centroid above the effective horizontal.
    """
    return math.hypot(x - p_x, z - p_z) - (z - p_z + kappa * (x - p_x)) / math.sqrt(
        1.0 + kappa * kappa
    )


@entry
def pose_margins(
    ground: FloatArray,
    body: FloatArray,
    poses: FloatArray,
    count: int,
    a: float,
    g: float,
    touch: float,
    margins: FloatArray,
    found: FloatArray,
) -> None:
    """Work out forces and margins at each pose of a table of poses.

    All but the energy margin along the flow, which takes as long as the rest and of which often the
    least value alone is wanted: that is :func:`flow_energy`'s.

    Parameters
    ----------
    ground, body
        Tables.
    poses, count
        Table of :func:`kaidan.contact.course.drive` and the number of its rows in use.
    a, g
        Acceleration along the path, gravity [m/s^2].
    touch
        Gap up to which a feature counts as a contact [m].
    margins
        Table to be filled (n, 21):

        0 required friction (the active pair where a contact is just being exchanged, else the
        least over all pairs of contacts: at the least coefficient the load lies on the surface of
        the cone of all contact forces, on a facet between two edges, so two contacts carry it);
        1, 2 N and T of the rear contact, 3, 4 of the front one [N/kg];
        5 traction along the path g sin psi + a [N/kg]; 6, 7 static stability margin to the back
        and to the front [m]; 8, 9 energy margin about the fixed rear and front contact (Hirose)
        [m]; 10 energy margin along the flow, the smaller of both sides [m], NaN until worked out;
        11 side of column 10 (+1 back, -1 front); 12 force-angle measure (Papadopoulos & Rey)
        [rad m N/kg]; 13 ZMP: where the gravity line meets the line of the contacts, 0 rear to 1
        front; 14 number of contacts; 15 belly touches (0, 1); 16 steepest face touched: largest
        angle of a contact normal from the vertical [rad]; 17 tilt kappa of effective gravity; 18
        whether column 10 is bounded (1), or only a lower bound: wedged, or not over the contact
        within 90 degrees (0); 19, 20 features of the outermost contacts, rear and front.
    found
        Scratch (k, 7).
    """
    scan_hint = 0
    for row in range(count):
        x = poses[row, 1]
        z = poses[row, 2]
        phi = poses[row, 3]
        psi = poses[row, 14]
        kappa = 0.0
        gravity = g
        if a != 0.0:
            kappa = a * math.cos(psi) / (g + a * math.sin(psi))
            gravity = math.sqrt(g * g + a * a + 2.0 * g * a * math.sin(psi))
        down = math.sqrt(1.0 + kappa * kappa)
        p_x = poses[row, 6]
        p_z = poses[row, 7]
        o_x = poses[row, 8]
        o_z = poses[row, 9]
        mu, n1, t1, n2, t2 = two_contact_forces(
            p_x, p_z, poses[row, 10], poses[row, 11],
            o_x, o_z, poses[row, 12], poses[row, 13],
            x, z, gravity * kappa / down, gravity / down,
        )  # fmt: skip
        # the second record of one place: the contact that is about to open carries no more
        leaving = row > 0 and poses[row, 0] == poses[row - 1, 0]
        many, scan_hint = contacts_at(ground, body, x, z, phi, touch, found, scan_hint)
        back = -(p_x - x + kappa * (z - p_z)) / down
        front = (o_x - x + kappa * (z - o_z)) / down
        belly = 0.0
        steepest = max(
            abs(math.atan2(poses[row, 10], poses[row, 11])),
            abs(math.atan2(poses[row, 12], poses[row, 13])),
        )
        r_x, r_z, f_x, f_z = p_x, p_z, o_x, o_z
        # all contacts press one way: the active pair's friction, the slope, is the least already
        one_plane = abs(poses[row, 10] - poses[row, 12]) < 1e-12
        for k in range(many):
            if abs(found[k, 3] - poses[row, 10]) > 1e-12:
                one_plane = False
            if found[k, 6] == 2.0:
                belly = 1.0
            if many > 2:
                steepest = max(steepest, abs(math.atan2(found[k, 3], found[k, 4])))
                ahead = (found[k, 1] - x + kappa * (z - found[k, 2])) / down
                # more than two: the outermost contacts bound the margins
                if ahead > front:
                    front = ahead
                    f_x = found[k, 1]
                    f_z = found[k, 2]
                elif -ahead > back:
                    back = -ahead
                    r_x = found[k, 1]
                    r_z = found[k, 2]
                for j in range(0 if leaving or one_plane else k):
                    other = (found[j, 1] - x + kappa * (z - found[j, 2])) / down
                    mu2, m1, u1, m2, u2 = two_contact_forces(
                        found[j, 1], found[j, 2], found[j, 3], found[j, 4],
                        found[k, 1], found[k, 2], found[k, 3], found[k, 4],
                        x, z, gravity * kappa / down, gravity / down,
                    )  # fmt: skip
                    if mu2 < mu - 1e-12:
                        mu, n1, t1, n2, t2 = mu2, m1, u1, m2, u2
                        if ahead < other:
                            n1, t1, n2, t2 = m2, u2, m1, u1
        margins[row, 0] = mu
        margins[row, 1] = n1
        margins[row, 2] = t1
        margins[row, 3] = n2
        margins[row, 4] = t2
        margins[row, 5] = g * math.sin(psi) + a
        margins[row, 6] = back
        margins[row, 7] = front
        rise_back = pivot_rise(r_x, r_z, x, z, kappa)
        rise_front = pivot_rise(f_x, f_z, x, z, kappa)
        margins[row, 8] = rise_back if back >= 0.0 else -rise_back
        margins[row, 9] = rise_front if front >= 0.0 else -rise_front
        angle_back = math.atan2(back, (z - r_z + kappa * (x - r_x)) / down)
        angle_front = math.atan2(front, (z - f_z + kappa * (x - f_x)) / down)
        margins[row, 12] = min(angle_back * abs(back) * gravity, angle_front * abs(front) * gravity)
        margins[row, 13] = back / (back + front) if back + front > 0.0 else math.nan
        margins[row, 14] = max(many, 2)
        margins[row, 15] = belly
        margins[row, 16] = steepest
        margins[row, 17] = kappa
        margins[row, 19] = poses[row, 4]
        margins[row, 20] = poses[row, 5]
        for k in range(many if many > 2 else 0):
            if found[k, 1] == r_x and found[k, 2] == r_z:
                margins[row, 19] = found[k, 0]
            if found[k, 1] == f_x and found[k, 2] == f_z:
                margins[row, 20] = found[k, 0]
        margins[row, 10] = math.nan
        margins[row, 11] = math.nan
        margins[row, 18] = 0.0


@entry
def flow_energy(
    ground: FloatArray, body: FloatArray, poses: FloatArray, margins: FloatArray, rows: IntArray
) -> None:
    """Work out the energy margin along the flow, columns 10, 11 and 18, at some poses.

    Parameters
    ----------
    ground, body, poses
        As for :func:`pose_margins`.
    margins
        Table that it has filled.
    rows
        Which poses.
    """
    hint = 0
    for row in rows:
        x = poses[row, 1]
        z = poses[row, 2]
        phi = poses[row, 3]
        kappa = margins[row, 17]
        rise_back = abs(margins[row, 8])
        rise_front = abs(margins[row, 9])
        rear = int(margins[row, 19])
        ahead = int(margins[row, 20])
        # the side with the smaller bound first, the other only if it can be less
        side = 1.0
        pivot = rear
        bound = rise_front
        if rise_front < rise_back:
            side = -1.0
            pivot = ahead
            bound = rise_back
        bounded, rise, hint = barrier(ground, body, pivot, x, z, phi, side, kappa, hint)
        if rise > bound:
            pivot = ahead if side > 0.0 else rear
            other_bounded, other_rise, hint = barrier(
                ground, body, pivot, x, z, phi, -side, kappa, hint
            )
            if other_rise < rise:
                rise = other_rise
                bounded = other_bounded
                side = -side
        margins[row, 10] = rise
        margins[row, 11] = side
        margins[row, 18] = 1.0 if bounded else 0.0


@entry
def new_margins(size: int) -> tuple[FloatArray, FloatArray]:
    """Empty tables for :func:`pose_margins`."""
    return np.empty((size, MARGIN_COLUMNS)), np.empty((32, 7))
