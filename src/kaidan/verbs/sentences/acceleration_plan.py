"""Why there is a plan of the acceleration through area E, or why there is none."""

import math
from collections.abc import Sequence

FASTER_CHANGES = "a drive that changes its speed faster"
MORE_TRACTION = "a drive that pulls harder"
MORE_FRICTION = "more friction"


def outside(why: str) -> str:
    """No plan, because the closed form says nothing."""
    return f"No plan: outside the closed form, {why}."


def not_needed() -> str:
    """No plan is needed."""
    return "No plan is needed: a constant speed keeps to all limits, allowances subtracted."


def follows(
    *,
    a: tuple[float, float],
    v: tuple[float, float],
    reserve: float,
    needless: bool,
    repeats: bool,
    ends: tuple[float, float],
) -> str:
    """There is one.

    a, v: smallest and largest acceleration and speed of the plan [m/s^2, m/s].
    reserve: distance from its limits everywhere [m/s^2].
    ends: speed at its start and end [m/s].
    """
    more = ""
    if needless:
        more = " A constant speed would do as well."
    elif not repeats:
        change = "lose" if ends[1] < ends[0] else "gain"
        more = f" It must {change} speed over the whole flight and enter it at {ends[0]:.2f} m/s."
    return (
        f"An acceleration that follows the position holds it: {a[0]:+.2f} to {a[1]:+.2f} m/s2 "
        f"along the path, {v[0]:.2f} to {v[1]:.2f} m/s, {reserve:.2f} m/s2 from its limits "
        f"everywhere.{more}"
    )


def no_control(robot: str, needed: float, fastest: float | None) -> str:
    """The sheet states no control of the acceleration."""
    return (
        f"No plan: the sheet of {robot} states no acceleration control "
        "(drive.acceleration_control), so area E counts as unstable." + _with_it(needed, fastest)
    )


def no_largest_speed(robot: str, needed: float) -> str:
    """The sheet states no largest speed."""
    return f"No plan: the sheet of {robot} states no largest speed (drive.max_speed)." + _with_it(
        needed, None
    )


def too_steep(slope: float, limit: float) -> str:
    """No acceleration that repeats holds it [rad]."""
    return (
        f"No plan: {math.degrees(slope):.1f} deg (theta_d and theta_M included) is beyond "
        f"{math.degrees(limit):.1f} deg, where the mean of a_r0 over a nosing spacing is negative: "
        "no acceleration that repeats from nosing to nosing holds it."
    )


def nothing_allowed(helps: Sequence[str]) -> str:
    """At some place the band of accelerations is empty."""
    return f"No plan: at some place no acceleration is allowed at all.{_helpful(helps)}"


def too_slow(needed: float, fastest: float, helps: Sequence[str]) -> str:
    """The drive is too slow [m/s]."""
    return (
        f"No plan: it takes up to {needed:.2f} m/s, and the drive's largest speed is "
        f"{fastest:g} m/s.{_helpful(helps)}"
    )


def not_from(speed: float) -> str:
    """The speed at the start leaves none [m/s]."""
    return f"No plan from a speed of {speed:g} m/s at the start."


def _with_it(needed: float, fastest: float | None) -> str:
    if math.isnan(needed):
        return " Even with it there is no plan: at some place no acceleration is allowed."
    limit = ""
    if fastest is not None and fastest <= needed:
        limit = f" (the drive's largest is {fastest:g} m/s)"
    return f" With it, and speeds up to {needed:.2f} m/s{limit}, there is one."


def _helpful(helps: Sequence[str]) -> str:
    return f" It would do with {' or '.join(helps)}." if helps else ""
