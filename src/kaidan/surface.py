"""The surface's data sheet: static friction between the tracks and the nosings."""

from typing import ClassVar, Self

from pydantic import Field

from kaidan import catalog
from kaidan.sheet import Sheet, model_validator, quantity


class Surface(Sheet):
    """Static friction of a track on a surface, as a range that the sources leave open."""

    label: ClassVar[str] = "surface"

    name: str = Field(default="surface", description="short name, used on the command line")
    title: str = Field(default="", description="full name")
    friction_low: float = quantity("1", 0.0, 5.0, "smallest static friction", symbol="mu_s")
    friction_high: float = quantity("1", 0.0, 5.0, "largest static friction", symbol="mu_s")
    friction_uncertainty: float = quantity(
        "1", 0.0, 2.0, "standard uncertainty (one sigma) on top of the range", default=0.0
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
    def of_friction(cls, friction: float, uncertainty: float = 0.0) -> Self:
        """Surface of a measured static friction [1]."""
        return cls(
            name=f"friction {friction:g}",
            friction_low=friction,
            friction_high=friction,
            friction_uncertainty=uncertainty,
        )
