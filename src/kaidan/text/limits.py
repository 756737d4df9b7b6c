"""What limits a robot on stairs, in words."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.assessment.limits import Limit


def text(limits: "Sequence[Limit]") -> str:
    """Limits in one line."""
    return "; ".join(_one(each) for each in limits)


def _one(each: "Limit") -> str:
    has, takes = 1e3 * each.has_m, 1e3 * each.takes_m
    if each.figure == "nosing_spacing":
        said = f"L carries a nosing spacing up to {takes:.0f} mm, not {has:.0f} mm"
        return said if each.needs_m is None else f"{said} (L {1e3 * each.needs_m:.0f} mm would)"
    said = f"unaided it climbs a riser up to {takes:.0f} mm, not {has:.0f} mm"
    if each.needs_m is None:
        return said
    return f"{said} (its centroid {1e3 * each.needs_m:.0f} mm behind the leading tip would)"
