"""Slope limits over the nosing spacing, as text."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from kaidan.tables import table
from kaidan.words import heading

if TYPE_CHECKING:
    from kaidan.verbs.margin_curve import MarginCurve

MOST_ROWS = 16
"""Most lines of the table."""


def text(curve: "MarginCurve") -> str:
    """Limits at round spacings, the allowances, and the stairs beside them."""
    lines = [
        f"{curve.robot}, {heading(curve)}, a = {curve.acceleration:g} m/s2: "
        f"L {1e3 * curve.flat_length_m:.0f} mm, centroid "
        f"{1e3 * curve.com_from_uphill_end_m:.0f} mm behind the uphill end and "
        f"{1e3 * curve.com_height_m:.0f} mm high"
    ]
    if curve.outside:
        return "\n".join([*lines, f"OUTSIDE THE MODEL: {curve.outside}"])
    lines += ["", _limits(curve), "", _allowances(curve)]
    lines.append(
        f"The closed form ends at p = L/2 = {1e3 * curve.largest_nosing_spacing_m:.0f} mm: beyond "
        "it fewer than two nosings carry the track."
    )
    if curve.stairs:
        lines += ["", _stairs(curve)]
    return "\n".join(lines)


def _limits(curve: "MarginCurve") -> str:
    columns = curve.columns()
    return table(
        [
            {name: values[index] for name, values in columns.items()}
            for index in round_places(curve.nosing_spacing_m)
        ],
        {
            "nosing_spacing_m": "p [mm]",
            "contacts_n": "n",
            "margin_angle_deg": "tips downhill beyond [deg]",
            "margin_angle_corrected_low_deg": "less allowances [deg]",
            "lower_angle_deg": "tips uphill below [deg]",
            "lower_angle_corrected_high_deg": "with allowances [deg]",
        },
    )


def _allowances(curve: "MarginCurve") -> str:
    shown = ", ".join(
        f"{name} {value.low_deg:.1f} to {value.high_deg:.1f} deg ({value.source})"
        for name, value in curve.allowances.items()
    )
    return f"Allowances, each at its high end: {shown}."


def _stairs(curve: "MarginCurve") -> str:
    return table(
        [each.model_dump() for each in sorted(curve.stairs, key=lambda stairs: stairs.angle_deg)],
        {
            "name": "stairs",
            "angle_deg": "angle [deg]",
            "nosing_spacing_m": "p [mm]",
            "inside_model": "inside the closed form",
        },
    )


def round_places(p: Sequence[float]) -> list[int]:
    """Lines of a table that are shown, at round spacings if there are enough of them.

    Examples
    --------
    >>> round_places([0.150, 0.155, 0.160, 0.165, 0.170, 0.175, 0.180])
    [0, 2, 4, 6]
    """
    for step in (10, 20, 25, 50, 100):
        places = [i for i, x in enumerate(p) if abs(1e3 * x / step - round(1e3 * x / step)) < 1e-6]
        if MOST_ROWS / 4 <= len(places) <= MOST_ROWS:
            return places
    return list(range(0, len(p), math.ceil(len(p) / MOST_ROWS)))
