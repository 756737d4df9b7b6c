"""The allowances theta_d and theta_M of Eq. (24): measured, or a default that is shown."""

import math
from functools import cache
from numbers import Real
from typing import Any, ClassVar, Literal, Self

from pydantic import Field

from kaidan.answer import Part
from kaidan.errors import InputError
from kaidan.sheet import Sheet, model_validator, quantity

UNMEASURED = math.radians(2.6)
"""Largest value of either allowance that the paper measured (150 mm, 56.8 degrees) [rad]."""


LARGEST_ALLOWANCE = 0.6
"""Largest allowance [rad]."""
Source = Literal["measured", "indentation and sag as measured", "default", "not applicable"]
"""Where an allowance comes from."""


class Allowance(Sheet):
    """An angle that lowers the tipping margin: a range, from the best to the worst case."""

    label: ClassVar[str] = "allowance"

    low: float = quantity("rad", 0.0, LARGEST_ALLOWANCE, "smallest value")
    high: float = quantity("rad", 0.0, LARGEST_ALLOWANCE, "largest value")
    source: Source = Field(default="measured", description="where the range comes from")

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if self.low > self.high:
            raise self.refuse(f"low = {self.low:g} rad is more than high = {self.high:g} rad")
        return self

    @classmethod
    def of(cls, stated: Any, *, name: str, descending: bool = False) -> Self:
        """Allowance from what the user stated.

        Parameters
        ----------
        stated : None, float, pair of float or Allowance
            Angle or range [rad]; None for the default: 0 to 2.6 degrees, as nobody measured it.
        name : {"theta_d", "theta_M"}
            Which allowance.
        descending : bool
            theta_M is zero when descending, where no grouser locks.

        Raises
        ------
        InputError
            Neither an angle nor a pair of them, or not within 0 to 0.6 rad.
        """
        if isinstance(stated, cls):
            return stated
        if stated is None:
            return cls._unstated(zero=name == "theta_M" and descending)
        ends = tuple(stated) if isinstance(stated, tuple | list) else (stated, stated)
        if len(ends) != 2 or not all(isinstance(end, Real) for end in ends):
            raise InputError(f"{name} is not an angle or a pair (low, high) [rad]")
        try:
            if ends[0] is ends[1]:
                cls(low=0.0, high=ends[1])  # one refusal, not two alike
            return cls(low=ends[0], high=ends[1])
        except InputError as error:
            raise InputError(f"{name}: {error}") from None

    @classmethod
    @cache
    def _unstated(cls, *, zero: bool) -> Self:
        if zero:
            return cls(low=0.0, high=0.0, source="not applicable")
        return cls(low=0.0, high=UNMEASURED, source="default")


class AllowanceShown(Part):
    """An allowance as it was counted."""

    low_deg: float
    """Best case [deg]."""
    high_deg: float
    """Worst case, subtracted from `margin_deg` [deg]."""
    source: Source
    """"measured", "indentation and sag as measured" (what a yielding track costs by mechanics),
    "default" (nobody measured it) or "not applicable"."""

    @classmethod
    def of(cls, allowance: Allowance) -> "AllowanceShown":
        """As people read it."""
        return cls(
            low_deg=math.degrees(allowance.low),
            high_deg=math.degrees(allowance.high),
            source=allowance.source,
        )
