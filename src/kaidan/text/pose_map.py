"""A pose map, as text."""

from typing import TYPE_CHECKING

from kaidan.text.words import subject

if TYPE_CHECKING:
    from kaidan.verbs.pose_map import PoseMap


def text(found: "PoseMap") -> str:
    """What it covers, and how many lines of stable poses and ridges there are."""
    part = "" if found.whole else ", the first steps"
    return (
        f"Pose map of {subject(found.question)}{part}: "
        f"{len(found.x_m)} places from {found.x_m[0]:.2f} to {found.x_m[-1]:.2f} m, "
        f"{len(found.inclination_deg)} inclinations from {found.inclination_deg[0]:.0f} to "
        f"{found.inclination_deg[-1]:.0f} deg; {len(found.stable)} lines of stable poses, "
        f"{len(found.ridges)} ridges, {len(found.rotations)} rotations on the path"
    )
