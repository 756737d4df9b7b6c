"""A grouser that comes round the end of a track passes over an edge and stands behind it."""

import numpy as np

from kaidan.mechanics import Number
from kaidan.mechanics.validity import validity

ALIKE = 1e-3
"""Difference of two tilts below which nothing is pushed back [rad]."""
FLATTEST = 1e-6
"""Curvature below which an end is a flat [1/m]."""


def reach_over_edge(*, R: Number, h: Number, s: Number) -> Number:
    """Height above the axle at which a tip that comes round a track's end passes over an edge.

    ``(R + h) sin(g)``, g = min(s / (2 R), arccos(R / (R + h)))

    The end is pushed against a face, which the tip below touches, or the belt. Tips come round a
    spacing apart, s / R as angles. One at the angle g above the level of the axle stands farther
    ahead than the one below, and than the belt, up to that limit.

    Assumptions: rigid grousers on a round end; the face is upright, its edge sharp.

    Parameters
    ----------
    R : float or array
        Radius of the end, belt included, grousers not [m].
    h : float or array
        Height of the grousers under load [m].
    s : float or array
        Spacing of the grousers along the belt [m].

    Returns
    -------
    float or array
        Height [m]; about s / 2.

    Examples
    --------
    >>> print(round(reach_over_edge(R=0.1, h=0.012, s=0.040), 4))
    0.0223

    References
    ----------
    Derived: docs/theory/grousers.md.
    """
    angle = np.minimum(0.5 * s / R, np.arccos(R / (R + h)))
    return (R + h) * np.sin(angle)


def tip_overlap(*, R: Number, h: Number, s: Number, lift: Number) -> Number:
    """How far behind an upright face a tip stands that passes its edge.

    ``(R + h) cos(g) - max(R, (R + h) cos(g - s / R))``, sin(g) = lift / (R + h)

    Assumptions: those of `reach_over_edge`.

    Parameters
    ----------
    R : float or array
        Radius of the end, belt included, grousers not [m].
    h : float or array
        Height of the grousers under load [m].
    s : float or array
        Spacing of the grousers along the belt [m].
    lift : float or array
        Height of the edge above the axle [m].

    Returns
    -------
    float or array
        Overlap [m], negative where the tip does not pass; NaN where the edge is above the tips.

    Examples
    --------
    It vanishes at the reach over the edge.

    >>> lift = reach_over_edge(R=0.1, h=0.012, s=0.040)
    >>> print(round(tip_overlap(R=0.1, h=0.012, s=0.040, lift=lift), 12) + 0.0)
    0.0

    References
    ----------
    Derived: docs/theory/grousers.md.
    """
    sine = lift / (R + h)
    angle = np.arcsin(np.minimum(np.maximum(sine, -1.0), 1.0))
    face = np.maximum(R, (R + h) * np.cos(angle - s / R))
    return validity(holds=np.abs(sine) <= 1.0) * ((R + h) * np.cos(angle) - face)


def pushed_lean(
    *, lean: Number, other: Number, beyond: Number, h: Number, r: Number, curvature: Number
) -> Number:
    """Tilt of the normal of a track's end at a nosing, once grousers elsewhere push it back.

    ``lean' = arctan((r - x) / (r + z))``, with x, z the middle of the end from the sharp nosing, as
    both supports stand off by ``h - r (sin + cos - 1)`` of their tilts.

    Where another support leans more, at most a riser's face, grousers there keep the robot farther
    back: its end is then farther down on the round of its nosing, on a normal that is tilted more.

    Assumptions: rigid grousers at both supports; a level tread; the end stays on its round.

    Parameters
    ----------
    lean : float or array
        Tilt of the end's normal from the tread's without grousers, on a sharp nosing [rad].
    other : float or array
        That of the other support [rad]: pi/2 at a face; not less than *lean*.
    beyond : float or array
        How far beyond its nosing the end stands on the tread [m]; zero: on the nosing.
    h : float or array
        Height of the grousers under load [m].
    r : float or array
        Radius of the nosings [m].
    curvature : float or array
        Of the end [1/m]: one over its radius, belt included, grousers not.

    Returns
    -------
    float or array
        [rad], not less than *lean*.

    Examples
    --------
    An end of 80 mm on the tread 10 mm behind the nosing, its other end on a face:

    >>> found = pushed_lean(lean=0.0, other=np.pi / 2, beyond=0.01, h=0.02, r=0.0, curvature=12.5)
    >>> print(round(np.degrees(found), 2))  # 10 mm before the nosing, 100 mm above it
    5.71

    References
    ----------
    Derived: docs/theory/grousers.md.
    """
    between = np.maximum(other - lean, ALIKE)
    off = h - r * (np.sin(lean) + np.cos(lean) - 1.0)
    other_off = h - r * (np.sin(other) + np.cos(other) - 1.0)
    back = (other_off - off * np.cos(between)) / np.sin(between)
    x = beyond - (off + 1.0 / curvature) * np.sin(lean) - back * np.cos(lean)
    z = (off + 1.0 / curvature) * np.cos(lean) - back * np.sin(lean)
    return np.maximum(lean, np.arctan2(r - x, r + z))


def end_run(*, theta: Number, h: Number, r: Number, curvature: Number) -> Number:
    """Length of the tread over which a grouser of a round end stands behind a nosing.

    ``l = [(R + h) sin(g) - (R + r) sin(theta)]+``, ``(R + h) cos(g) = (R + r) cos(theta) - r``

    The end lies on the round of the nosing, its axle (R + r) cos(theta) - r above the tread and
    (R + r) sin(theta) before the place where the tread begins. A tip at the angle g ahead of
    straight below the axle is at the tread's level. On a flat l is along the tread what
    `kaidan.mechanics.grousers.standing_run` is along the belt, but for a factor cos(theta).

    Assumptions: rigid grousers, the tread level; the end stays where it is.

    Parameters
    ----------
    theta : float or array
        Tilt of the end's normal where it touches the nosing, from the tread's [rad].
    h : float or array
        Height of the grousers under load [m].
    r : float or array
        Radius of the nosing [m].
    curvature : float or array
        Of the end [1/m]: one over its radius, belt included, grousers not.

    Returns
    -------
    float or array
        l [m].

    Examples
    --------
    An end of 40 mm on a sharp nosing straight below its axle, grousers of 10 mm: 3, 4, 5.

    >>> print(round(float(end_run(theta=0.0, h=0.010, r=0.0, curvature=25.0)), 9))
    0.03

    References
    ----------
    Derived: docs/theory/grousers.md.
    """
    R = 1.0 / curvature
    cosine = ((R + r) * np.cos(theta) - r) / (R + h)
    sine = np.sqrt(np.maximum(1.0 - cosine**2, 0.0))
    return np.maximum((R + h) * sine - (R + r) * np.sin(theta), 0.0)


def face_push(*, h: Number, s: Number, curvature: Number) -> Number:
    """How far grousers that come round an end push it off a face, one after the other.

    ``(R + h)(1 - cos(g))``, g = min(s / (2 R), arccos(R / (R + h)))

    A tip at the level of the axle keeps the end R + h off the face. Half a spacing on the tips
    above and below lie against it, or the belt does.

    Assumptions: rigid grousers on a round end; the face is upright and higher than a spacing.

    Parameters
    ----------
    h : float or array
        Height of the grousers under load [m].
    s : float or array
        Spacing of the grousers along the belt [m].
    curvature : float or array
        Of the end [1/m]: one over its radius, belt included, grousers not; zero: a flat.

    Returns
    -------
    float or array
        [m]: h where they are far apart, zero on a flat.

    Examples
    --------
    >>> print(round(float(face_push(h=0.01, s=0.06, curvature=1 / 0.029)), 9))
    0.01

    References
    ----------
    Derived: docs/theory/grousers.md.
    """
    R = 1.0 / np.maximum(curvature, FLATTEST)
    angle = np.minimum(0.5 * s / R, np.arccos(R / (R + h)))
    return np.where(curvature > 0.0, (R + h) * (1.0 - np.cos(angle)), 0.0)


def edge_tilt(*, overlap: Number, r: Number) -> Number:
    """Tilt of the normal on which a tip stands that overlaps a rounded edge.

    ``beta = arcsin(1 - overlap / r)``; zero from overlap = r on, where the tread begins.

    Parameters
    ----------
    overlap : float or array
        How far behind the face the tip stands [m], see `tip_overlap`.
    r : float or array
        Radius of the nosing [m].

    Returns
    -------
    float or array
        beta [rad]; pi/2 without an overlap.

    Examples
    --------
    >>> print(round(np.degrees(edge_tilt(overlap=0.005, r=0.010)), 9))
    30.0

    References
    ----------
    Derived: the round stands r (1 - sin(beta)) behind the face where its normal is so tilted.
    """
    inside = np.minimum(np.maximum(overlap, 0.0), r)
    return np.arctan2(r - inside, np.sqrt(inside * (2.0 * r - inside)))
