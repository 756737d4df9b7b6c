"""The surface's data sheet: static friction of the tracks on nosings, treads and risers."""

from typing import ClassVar, Self

from pydantic import Field

from kaidan import catalog
from kaidan.errors import InputError
from kaidan.sheet import Sheet, model_validator, quantity
from kaidan.units import range_of

_LOW, _HIGH = 0.0, 5.0
"""Plausible static friction [1]."""


class Friction(Sheet):
    """Static friction of a track on one part of the stairs, as a range."""

    label: ClassVar[str] = "surface: friction"

    low: float = quantity("1", _LOW, _HIGH, "smallest static friction", symbol="mu_s")
    high: float = quantity("1", _LOW, _HIGH, "largest static friction", symbol="mu_s")

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if self.low > self.high:
            raise self.refuse(f"low = {self.low:g} is more than high = {self.high:g}")
        return self


class Surface(Sheet):
    """Static friction of a track on a surface, as a range that the sources leave open."""

    label: ClassVar[str] = "surface"

    name: str = Field(default="surface", description="short name, used on the command line")
    title: str = Field(default="", description="full name")
    friction_low: float = quantity("1", _LOW, _HIGH, "smallest static friction", symbol="mu_s")
    friction_high: float = quantity("1", _LOW, _HIGH, "largest static friction", symbol="mu_s")
    friction_uncertainty: float = quantity(
        "1", 0.0, 2.0, "standard uncertainty (one sigma) on top of the range", default=0.0
    )
    nosings: Friction | None = Field(
        default=None, description="friction of the nosings, where it differs from the rest"
    )
    treads: Friction | None = Field(
        default=None, description="friction of treads and landings, where it differs"
    )
    risers: Friction | None = Field(
        default=None, description="friction of the riser faces, where it differs"
    )
    sources: dict[str, str] = Field(
        default={}, description="where each figure comes from, with its status letter"
    )
    notes: str = Field(default="", description="what the user should know")

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if self.friction_low > self.friction_high:
            raise self.refuse(
                f"friction_low = {self.friction_low:g} is more than "
                f"friction_high = {self.friction_high:g}"
            )
        return self

    @property
    def differs(self) -> bool:
        """Whether nosings, treads or riser faces have a friction of their own."""
        return any((self.nosings, self.treads, self.risers))

    def of_parts(self, *, best: bool = False) -> tuple[float, float, float]:
        """Static friction of nosings, treads and riser faces [1], in the worst or best case."""
        general = self.friction_high if best else self.friction_low
        nosings, treads, risers = (
            general if part is None else part.high if best else part.low
            for part in (self.nosings, self.treads, self.risers)
        )
        return nosings, treads, risers

    @classmethod
    def named(cls, name: str) -> Self:
        """Surface of the catalogue, or of a TOML file.

        Raises
        ------
        UnknownNameError, InputError
            Neither, or a bad file.
        """
        return catalog.load("surfaces", name, cls.from_text)

    @classmethod
    def of_friction(
        cls, friction: float | tuple[float, float] | str, uncertainty: float = 0.0
    ) -> Self:
        """Surface of a measured static friction.

        Parameters
        ----------
        friction : float, pair of float or str
            Value or range (low, high) [1]; as text "0.8", "0.6..1.0", "0.6 to 1.0".
        uncertainty : float
            Standard uncertainty (one sigma) on top of it [1].

        Raises
        ------
        InputError
            None of these, or not within 0 to 5.

        Examples
        --------
        >>> Surface.of_friction("0.6..1.0").friction_high
        1.0
        """
        low, high = range_of(friction, "number", option="friction")
        for end in (low, high):
            if not _LOW <= end <= _HIGH:
                raise InputError(f"friction = {end:g} is not within {_LOW:g} to {_HIGH:g}")
        return cls(
            name=f"friction {low:g}" if low == high else f"friction {low:g}..{high:g}",
            friction_low=low,
            friction_high=high,
            friction_uncertainty=uncertainty,
        )
