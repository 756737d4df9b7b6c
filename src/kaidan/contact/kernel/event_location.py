"""Where along a step an event lies: a gap closes, or the centroid comes over a contact."""

from __future__ import annotations

from kaidan.contact.codes import Advance
from kaidan.contact.kernel.continuation import stepped, tilt
from kaidan.contact.kernel.gaps import gap_anywhere
from kaidan.contact.kernel.settling import lever
from kaidan.contact.layout import At, Held, Pull, Scene

#: A gap below minus this [m] is a penetration.  An end's arc leaves a nosing like e^2/(2 R), so an
#: event is seen sqrt(2 R 2e-12) = 0.5 um late for R = 60 mm; still ten times the corrector's rest.
PENETRATED = 2e-12
#: A gap that is deeper than this [m] where it closes has not closed there: on one side of the place
#: an end stands on other points than on the other side, and no more on all that lies under it.
JUMP = 1e-8
#: Looks in a row that move the same end of the way, after which it is halved.
SAME_END = 3


def next_look(lo: float, hi: float, near: float, far: float, moved: int) -> float:
    """Where to look next for the zero between two ends: on the line through their values.

    near, far: values there, one above zero and one not; of an end that stays, with its weight.
    moved: how often in a row the near end moved, or with its sign turned the far one.
    """
    look = lo + (hi - lo) * near / (near - far)
    if abs(moved) >= SAME_END or not (lo < look and look < hi):
        return 0.5 * (lo + hi)
    return look


def moved_again(moved: int, near: bool) -> int:
    """How often in a row an end has moved, once it has moved again."""
    if near:
        return max(moved, 0) + 1
    return min(moved, 0) - 1


def quantity(scene: Scene, what: int, held: Held, at: At, kappa: float) -> float:
    """Return what is positive as long as nothing happens: a gap, or a contact's lever [m].

    ``at`` is where the body is in the pose.
    """
    if what == Advance.OVER_REAR:
        return -lever(scene, held.rear, at, kappa)
    if what == Advance.OVER_FRONT:
        return lever(scene, held.front, at, kappa)
    if what == held.rear or what == held.front:
        return 0.5 * PENETRATED
    return gap_anywhere(scene, what, at) + 0.5 * PENETRATED


def closing_time(
    scene: Scene, what: int, held: Held, ds: float, f0: float, f1: float, pull: Pull
) -> tuple[int, float]:
    """Arclength at which one quantity changes sign within a step.

    By regula falsi in the Illinois way: an end that stays twice in a row counts half.

    ``what`` is a feature (its gap), `Advance.OVER_REAR` or `Advance.OVER_FRONT` (a lever).
    ``f0`` > 0 >= ``f1`` are the values at the ends.

    On the far side of the event, within 1e-9 m or a gap of 1e-12 m.
    """
    lo = 0.0
    hi = ds
    near = f0
    far = f1
    at_hi = f1
    moved = 0
    for _ in range(90):
        if hi - lo < 1e-10 or at_hi > -0.5 * PENETRATED:
            break
        if f0 < PENETRATED:  # what rests there already goes in like e^2/(2 R): no line tells where
            mid = 0.5 * (lo + hi)
        else:  # aimed a hair beyond the zero, so that a straight course ends with the first look
            mid = next_look(lo, hi, near + 0.2 * PENETRATED, far + 0.2 * PENETRATED, moved)
        good, there, at = stepped(scene, held, mid)
        if not good:
            return 0, lo
        if there.rear == what or there.front == what:
            return 2, mid
        value = quantity(scene, what, there, at, tilt(pull, there.t_x, there.t_z))
        moved = moved_again(moved, value > 0.0)
        if value > 0.0:
            lo = mid
            near = value
            far *= 0.5 if moved > 1 else 1.0
        else:
            hi = mid
            far = value
            at_hi = value
            near *= 0.5 if moved < -1 else 1.0
    if what >= 0 and at_hi < -JUMP:
        return 0, lo
    return 1, hi
