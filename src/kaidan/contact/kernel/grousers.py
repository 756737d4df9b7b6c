"""Tips of grousers as they come to stand at a contact: `kaidan.mechanics.grousers`, one by one."""

from __future__ import annotations

import math

from kaidan.contact.kernel.trigonometry import acos, asin, atan2, cos, sin, tan

#: Difference of two tilts below which they are one [rad].
PARALLEL = 1e-3
#: Looks at the height of a grouser at most, and to what it is found [m].
MOST_LOOKS = 50
CLOSE = 1e-13


def tip_tilt(theta: float, h: float, r: float, curvature: float) -> float:
    """Tilt of the normal where the tip of a grouser stands deepest behind a nosing [rad]."""
    a = h * (1.0 + 0.5 * h * curvature)
    b = r * (1.0 + r * curvature)
    reach = 2.0 * atan2(math.sqrt(a), math.sqrt(max(2.0 * b - a, 0.0)))
    return max(theta - reach, 0.0)


def reach_beside(b: float, r: float, lean: float, curvature: float) -> float:
    """Length along the belt between its contact and a tip so far below it that touches beside [m].

    ``b`` is how deep the tip lies below the belt, ``lean`` the angle through which the round turns
    on that side before the tread, or the face, goes on straight.
    """
    near = r * (1.0 - cos(lean))
    if curvature <= 0.0:
        if b <= near:
            return math.sqrt(max(b * (2.0 * r - b), 0.0))
        return r * sin(lean) + (b - near) / tan(lean)
    radius = 1.0 / curvature
    tip = radius + b
    off = radius + r
    straight = acos(max((off * cos(lean) - r) / tip, -1.0))
    if tip * sin(straight) >= off * sin(lean):
        return radius * (straight - lean)
    turn = acos(min((off * off + tip * tip - r * r) / (2.0 * off * tip), 1.0))
    return radius * turn


def height_behind(theta: float, h: float, s: float, r: float, w: float, curvature: float) -> float:
    """Height of a grouser over a nosing as it comes to stand, one before it not yet clear [m].

    Between a height that has room and one that has none by a chord, of which an end that stays
    counts half.
    """
    steep = 0.5 * math.pi - theta
    room = s - w
    if room <= 0.0:
        return 0.0
    least = 0.0
    lacking = -room
    most = h
    over = reach_beside(h, r, theta, curvature) + reach_beside(h, r, steep, curvature) - room
    if over <= 0.0:
        return h
    before = 0
    for _ in range(MOST_LOOKS):
        if most - least < CLOSE or lacking > -CLOSE:
            break
        height = least - lacking * (most - least) / (over - lacking)
        beyond = reach_beside(height, r, theta, curvature) - room
        beyond += reach_beside(height, r, steep, curvature)
        if beyond <= 0.0:
            least = height
            lacking = beyond
            if before < 0:
                over *= 0.5
            before = -1
        else:
            most = height
            over = beyond
            if before > 0:
                lacking *= 0.5
            before = 1
    return least


def roll_off_length(theta: float, h: float, r: float) -> float:
    """Length along the belt over which a grouser that has passed a nosing rolls off it [m]."""
    if h > r * (1.0 - sin(theta)):
        return r * cos(theta)
    return math.sqrt(max(h * (2.0 * r - h), 0.0))


def standing_run(theta: float, h: float, r: float) -> float:
    """Length along the belt over which a grouser stands on the tread behind a nosing [m]."""
    return max(h - r * (1.0 - cos(theta)), 0.0) / tan(theta)


def roll_off_sine(run: float, off: float, r: float) -> float:
    """Sine of the tilt that a grouser loses while another one rolls off its nosing [1]."""
    return max(off - run, 0.0) / (2.0 * r)


def standing_friction(theta: float, beta: float, share: float) -> float:
    """Least friction with which a robot holds, a grouser under a share of its load [1]."""
    lean = tan(theta - beta)
    slope = tan(theta)
    q = 1.0 + slope * lean
    missing = slope - share * lean
    root = math.sqrt(max(q * q - 4.0 * (1.0 - share) * lean * missing, 0.0))
    return max(2.0 * missing / (q + root), 0.0)


def phases_friction(theta: float, q: float) -> float:
    """Friction with which a robot holds in the mean over the phases of its grousers [1]."""
    if q >= 1.0:  # a tip stands at every phase
        return 0.0
    bounded = tan(theta) * (1.0 - 2.0 * q) / (1.0 - q)
    return max(standing_friction(theta, 0.0, q), bounded)


def face_friction(mu: float, h: float, curvature: float) -> float:
    """Friction that grousers on a round end have left at a riser's face [1]."""
    return mu / ((1.0 + h * curvature) * (1.0 + h * curvature))


def stand_off(lean: float, h: float, r: float) -> float:
    """How far grousers and the round of a nosing keep a belt off its sharp nosing [m]."""
    return h - r * (sin(lean) + cos(lean) - 1.0)


def pushed_lean(
    lean: float, other: float, beyond: float, h: float, r: float, curvature: float
) -> float:
    """Tilt of an end's normal at a nosing, grousers at another support pushing it back [rad]."""
    between = other - lean
    if curvature <= 0.0 or between < PARALLEL:
        return lean
    off = stand_off(lean, h, r)
    back = (stand_off(other, h, r) - off * cos(between)) / sin(between)
    x = beyond - off * sin(lean) - back * cos(lean) - sin(lean) / curvature
    z = off * cos(lean) - back * sin(lean) + cos(lean) / curvature
    return max(lean, atan2(r - x, r + z))


def end_run(theta: float, h: float, r: float, curvature: float) -> float:
    """Length of the tread over which a grouser of a round end stands behind a nosing [m]."""
    radius = 1.0 / curvature
    cosine = ((radius + r) * cos(theta) - r) / (radius + h)
    sine = math.sqrt(max(1.0 - cosine * cosine, 0.0))
    return max((radius + h) * sine - (radius + r) * sin(theta), 0.0)


def face_push(h: float, s: float, curvature: float) -> float:
    """How far grousers that come round an end push it off a face, one after the other [m]."""
    if curvature <= 0.0:
        return 0.0
    radius = 1.0 / curvature
    angle = min(0.5 * s / radius, acos(radius / (radius + h)))
    return (radius + h) * (1.0 - cos(angle))


def reach_over_edge(radius: float, h: float, s: float) -> float:
    """Height above the axle at which a tip that comes round a track's end passes over an edge."""
    angle = min(0.5 * s / radius, acos(radius / (radius + h)))
    return (radius + h) * sin(angle)


def tip_overlap(radius: float, h: float, s: float, lift: float) -> float:
    """How far behind an upright face a tip stands that passes its edge [m]."""
    angle = asin(min(max(lift / (radius + h), -1.0), 1.0))
    face = max(radius, (radius + h) * cos(angle - s / radius))
    return (radius + h) * cos(angle) - face


def edge_tilt(overlap: float, r: float) -> float:
    """Tilt of the normal on which a tip stands that overlaps a rounded edge [rad]."""
    inside = min(max(overlap, 0.0), r)
    return atan2(r - inside, math.sqrt(inside * (2.0 * r - inside)))
