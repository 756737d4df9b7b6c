"""A centroid that nobody measured, in words."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.robot import CentroidRange

OF_THE_MIDDLE = "Its figures are those of the middle of the range of its centroid."
OUTSIDE_SOMEWHERE = "Somewhere in the range of its centroid the model has no answer."


def weigh(com_from_front: float, com_height: float) -> str:
    """What to do, and the place at which the verdict beside it holds [m]."""
    return (
        f"Weigh it (kaidan measure robot); at best, with C_L {_mm(com_from_front)} mm and C_N "
        f"{_mm(com_height)} mm"
    )


def reason(span: "CentroidRange") -> str:
    """Why there is no GO before the robot is weighed."""
    return f"Until weighed: nobody measured its centroid, {_box(span.from_front, span.height)}."


def _box(along: tuple[float, float], height: tuple[float, float]) -> str:
    return f"C_L {_span(along)} mm and C_N {_span(height)} mm assumed"


def _span(low_high: tuple[float, float]) -> str:
    low, high = map(_mm, low_high)
    return low if low == high else f"{low} to {high}"


def _mm(length: float) -> str:
    return f"{1e3 * length:.0f}"
