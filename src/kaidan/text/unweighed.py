"""A centroid that nobody measured, in words."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.assessment.unweighed import CentroidShown, Stretch
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


def thresholds(shown: "CentroidShown") -> str:
    """At which centroid the verdict would be GO or NO-GO, in one line."""
    parts = []
    for verdict, label in (("go", "GO"), ("no-go", "NO-GO")):
        each = [one for one in shown.stretches if one.verdict == verdict]
        if not each:
            parts.append(f"no {label} in this range")
        elif len(each) == len(shown.stretches):
            parts.append(f"{label} all over it")
        else:
            where = "; ".join(_where(one, shown) for one in each)
            parts.append(f"{label} with {where}")
    return ", ".join(parts)


def rows(shown: "CentroidShown") -> list[str]:
    """Every stretch in a line, for the whole answer."""
    return [
        f"C_N {_mm(one.height_m)} mm, C_L {_mm(one.from_m)} to {_mm(one.to_m)} mm: "
        f"{one.verdict.upper()} ({one.governs})"
        for one in shown.stretches
    ]


def _where(one: "Stretch", shown: "CentroidShown") -> str:
    low, high = shown.from_front_m
    if one.from_m == low and one.to_m == high:
        along = "any C_L"
    elif one.from_m == low:
        along = f"C_L up to {_mm(one.to_m)} mm"
    elif one.to_m == high:
        along = f"C_L from {_mm(one.from_m)} mm"
    else:
        along = f"C_L {_mm(one.from_m)} to {_mm(one.to_m)} mm"
    return f"{along} at C_N {_mm(one.height_m)} mm"


def _box(along: tuple[float, float], height: tuple[float, float]) -> str:
    return f"C_L {_span(along)} mm and C_N {_span(height)} mm assumed"


def _span(low_high: tuple[float, float]) -> str:
    low, high = map(_mm, low_high)
    return low if low == high else f"{low} to {high}"


def _mm(length: float) -> str:
    return f"{1e3 * length:.0f}"
