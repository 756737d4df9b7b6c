r"""Clearance: whether a robot has room beside, above and around it, in plain lengths.

::

            l                        |<- a ->|                  ceiling
     .-------------.                 |       |             ----------------
     |      o      | w               |   .   |                    | headroom, plumb
     '-------------'                 |  / \  |              .--'  v
       |<-f->| turning centre        | /   \ '------    .--' o nosing line
                                     |/ psi \      b  o'
                                     '--------------
"""

import numpy as np

from kaidan.mechanics import Number

YAW = float(np.radians(3.0))
"""Yaw off the line of the flight that a driver corrects [rad]."""
OFF_LINE = 0.03
"""Distance off the middle of its way that a driver corrects [m]."""
_HEADINGS = 721
"""Headings of a robot in a corner that are looked at: 1/8 degree apart."""


def lane_width(*, w: Number, length: Number, psi: Number = 0.0, error: Number = 0.0) -> Number:
    """Width that a robot needs between two walls.

    ``w cos(psi) + l |sin(psi)| + 2 error``

    Parameters
    ----------
    w : float or array
        Width of the robot over all [m].
    length : float or array
        Length of the robot over all [m].
    psi : float or array
        Yaw that it may have, within (-pi/2, pi/2) [rad].
    error : float or array
        Distance by which it may be off the middle, to either side [m].

    Returns
    -------
    float or array
        Width [m].

    Examples
    --------
    Three, four, five:

    >>> print(round(float(lane_width(w=0.5, length=1.0, psi=np.arcsin(0.6), error=0.05)), 12))
    1.1

    References
    ----------
    Derived: docs/theory/clearance.md.
    """
    return w * np.cos(psi) + length * np.abs(np.sin(psi)) + 2.0 * error


def headroom_needed(*, height: Number, length: Number, theta_s: Number, phi: Number) -> Number:
    """Plumb distance above the line of the nosings that a robot needs.

    ``(l sin(phi - theta_s) + H cos(phi - theta_s)) / cos(theta_s)``

    Assumptions: a box whose tail stands on the line of the nosings; phi - theta_s up to the angle
    of its diagonal, atan(l/H).

    Parameters
    ----------
    height : float or array
        Highest point of the robot above the underside of its tracks [m].
    length : float or array
        Length of the robot over all [m].
    phi : float or array
        Inclination of the robot, at least that slope where it rears [rad].

    Returns
    -------
    float or array
        Headroom [m].

    Examples
    --------
    On level ground, level: its height; lying on a slope of 60 degrees: twice that.

    >>> print(headroom_needed(height=0.6, length=1.0, theta_s=0.0, phi=0.0))
    0.6
    >>> print(round(float(headroom_needed(height=0.6, length=1, theta_s=np.pi/3, phi=np.pi/3)), 12))
    1.2

    References
    ----------
    Derived: docs/theory/clearance.md.
    """
    rearing = phi - theta_s
    return (length * np.sin(rearing) + height * np.cos(rearing)) / np.cos(theta_s)


def spin_circle(*, front: Number, rear: Number, w: Number) -> Number:
    """Diameter of the circle that a robot sweeps when it turns on the spot.

    ``2 sqrt(max(front, rear)^2 + (w/2)^2)``

    Assumptions: a rectangle; the tracks run at opposite speeds, so that it turns about one point
    on its middle line.

    Parameters
    ----------
    front, rear : float or array
        From the turning centre to the ends of the robot [m].
    w : float or array
        Width over all [m].

    Returns
    -------
    float or array
        Diameter [m].

    Examples
    --------
    >>> print(spin_circle(front=0.4, rear=0.3, w=0.6))
    1.0

    References
    ----------
    Derived: docs/theory/clearance.md.
    """
    return 2.0 * np.hypot(np.maximum(front, rear), w / 2.0)


def corner_margin(*, w: Number, length: Number, a: Number, b: Number) -> Number:
    """How much wider a robot could be that drives round a right-angled corner in one go.

    ``min over psi of a cos(psi) + b sin(psi) - l sin(psi) cos(psi) - w``, psi in [0, pi/2]

    Assumptions: a rectangle that slides along both outer walls; it may turn as it drives.

    Parameters
    ----------
    w, length : float or array
        Width and length of the robot over all [m].
    a, b : float or array
        Clear widths of both passages [m].

    Returns
    -------
    float or array
        Margin [m]; negative: it has to manoeuvre, or does not get round.

    Examples
    --------
    A thin rod of sqrt(8) passes a corner of two passages one wide: the ladder problem.

    >>> print(abs(round(float(corner_margin(w=0.0, length=8**0.5, a=1.0, b=1.0)), 4)))
    0.0

    References
    ----------
    Derived: docs/theory/clearance.md.
    """
    psi = np.linspace(0.0, np.pi / 2.0, _HEADINGS)
    w, length, a, b = (np.asarray(each, dtype=float)[..., None] for each in (w, length, a, b))
    room = a * np.cos(psi) + b * np.sin(psi) - length * np.sin(psi) * np.cos(psi) - w
    return np.min(room, axis=-1)


def run_up_margin(*, depth: Number, length: Number, leaf: Number = 0.0) -> Number:
    """Length of a landing that a robot in front of a flight leaves free.

    ``depth - leaf - l``

    Parameters
    ----------
    depth : float or array
        Clear depth of the landing in the direction of the flight [m].
    length : float or array
        Length of the robot over all [m].
    leaf : float or array
        Width of the leaf of a door opposite the flight that opens onto the landing [m]; 0: none.

    Returns
    -------
    float or array
        Margin [m].

    Examples
    --------
    >>> print(round(run_up_margin(depth=2.0, length=1.2, leaf=0.9), 12))
    -0.1

    References
    ----------
    Derived: docs/theory/clearance.md.
    """
    return depth - leaf - length


def door_clear_width(*, opening: Number, leaf: Number = 0.0, stop: Number = 0.0) -> Number:
    """Width of a doorway that is left beside its open leaf.

    ``opening - leaf - 2 stop``

    Parameters
    ----------
    opening : float or array
        Width of the opening [m].
    leaf : float or array
        Thickness of the leaf, which stands in the opening when it is open at a right angle [m].
    stop : float or array
        What frame and stop take on each side [m].

    Returns
    -------
    float or array
        Clear width [m].

    Examples
    --------
    >>> print(round(door_clear_width(opening=0.9, leaf=0.04, stop=0.02), 12))
    0.82

    References
    ----------
    Derived: docs/theory/clearance.md.
    """
    return opening - leaf - 2.0 * stop


def tip_hook_margin(*, R: Number, clear: Number) -> Number:
    """By how much an end of the robot is too large to get under a nosing.

    ``R - clear``

    The foremost point of a round end that rolls on a tread is R above it. Where the space below
    the next nosing is higher than that, the end drives in beneath the nosing and hooks under it.

    Parameters
    ----------
    R : float or array
        Radius of the end, belt included [m].
    clear : float or array
        Height of the open space below the nosing, above the tread [m]; 0: a closed riser.

    Returns
    -------
    float or array
        Margin [m]; negative: it may hook.

    Examples
    --------
    >>> print(round(tip_hook_margin(R=0.029, clear=0.14), 12))
    -0.111

    References
    ----------
    Derived: docs/theory/clearance.md.
    """
    return R - clear
