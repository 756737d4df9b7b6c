"""The allowances theta_d and theta_M of Eq. (24): measured, or a default that is shown."""

import math
from typing import Any, ClassVar, Literal, Self

from pydantic import Field

from kaidan.sheet import Sheet, model_validator, quantity

UNMEASURED = math.radians(2.6)
"""Largest value of either allowance that the paper measured (150 mm, 56.8 degrees) [rad]."""


class Allowance(Sheet):
    """An angle taken off the tipping margin: a range, from the kindest to the worst reading."""

    label: ClassVar[str] = "allowance"

    low: float = quantity("rad", 0.0, 0.6, "smallest value")
    high: float = quantity("rad", 0.0, 0.6, "largest value")
    source: Literal["measured", "default", "not applicable"] = Field(
        default="measured", description="where the range comes from"
    )

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

        Returns
        -------
        Allowance
        """
        if isinstance(stated, cls):
            return stated
        if stated is None:
            if name == "theta_M" and descending:
                return cls(low=0.0, high=0.0, source="not applicable")
            return cls(low=0.0, high=UNMEASURED, source="default")
        low, high = stated if isinstance(stated, tuple | list) else (stated, stated)
        return cls(low=low, high=high)
