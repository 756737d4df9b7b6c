"""The d-a plane, as text."""

from typing import TYPE_CHECKING

from kaidan.words import heading

if TYPE_CHECKING:
    from kaidan.verbs.d_a_plane import Plane


def text(plane: "Plane") -> str:
    """States, limits, the stable band, and the areas through which the acceleration goes."""
    head = (
        f"{plane.robot} on {plane.stairs}, {heading(plane)}: {plane.angle_deg:.1f} deg, "
        f"{1e3 * plane.nosing_spacing_m:.0f} mm from nosing to nosing"
    )
    if plane.outside:
        return f"{head}\nOUTSIDE THE MODEL: {plane.outside}. There is no plane and no figure."
    lines = [head]
    for each in plane.states:
        start, end = 1e3 * each.from_m, 1e3 * each.to_m
        place = f"d = {start:.0f} mm" if start == end else f"to {end:.0f} mm"
        lines.append(f"  state {each.state}: {place}, {each.contacts} contacts")
    for value, name, meaning in (
        (plane.a_S, "a_S", "above it the robot slides down (A)"),
        (plane.min_a_r0, "min a_r0", "above a_r0(d) it tips downhill (B)"),
        (plane.max_a_rn, "max a_rn", "below a_rn(d) it tips uphill (C)"),
        (plane.a_slides_up, "slides up", "below it the robot slides up (ours)"),
    ):
        shown = "friction not stated" if value is None else f"{value:+.2f} m/s2"
        lines.append(f"  {name:<14}{shown:<20}{meaning}")
    band = "no constant acceleration"
    if plane.a_min is not None and plane.a_max is not None:
        band = f"{plane.a_min:+.2f} to {plane.a_max:+.2f} m/s2 throughout"
    lines.append(f"  stable (D): {band}")
    stays = ", ".join(
        f"{area_name(each.area)} for d = {1e3 * each.from_m:.0f} to {1e3 * each.to_m:.0f} mm"
        for each in plane.areas
    )
    lines.append(f"  a = {plane.acceleration:g} m/s2 (requested): {stays}")
    if plane.plan is not None:
        lines.append(f"  {plane.plan.reason}")
    return "\n".join(lines)


def area_name(area: str) -> str:
    """Area of the plane in words: its letter, or "sliding up"."""
    return area if len(area) == 1 else "sliding up"
