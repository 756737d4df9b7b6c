"""A centroid that nobody measured: where in its range the verdict changes."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.assessment.unweighed import CentroidShown, Stretch


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


def _mm(length: float) -> str:
    return f"{1e3 * length:.0f}"
