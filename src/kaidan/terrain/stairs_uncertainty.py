"""How well the figures of a flight are known."""

from typing import ClassVar

from kaidan.sheet import Sheet, quantity

LARGEST_DOUBT = 0.05
"""Largest standard uncertainty of a single rise or going [m]."""


class StairsUncertainty(Sheet):
    """Standard uncertainties (one sigma) of the flight's figures; zero means taken as exact."""

    label: ClassVar[str] = "stairs: uncertainty"

    angle: float = quantity("rad", 0.0, 0.35, "of the angle", default=0.0)
    nosing_spacing: float = quantity("m", 0.0, 0.2, "of the nosing spacing", default=0.0)
    rise: float = quantity(
        "m", 0.0, LARGEST_DOUBT, "of each single rise, apart from the others", default=0.0
    )
    going: float = quantity(
        "m", 0.0, LARGEST_DOUBT, "of each single going, apart from the others", default=0.0
    )
    first_rise: float = quantity(
        "m", 0.0, LARGEST_DOUBT, "of the first rise, where it is more than that of each",
        default=0.0,
    )  # fmt: skip
    last_rise: float = quantity(
        "m", 0.0, LARGEST_DOUBT, "of the last rise, where it is more than that of each",
        default=0.0,
    )  # fmt: skip
