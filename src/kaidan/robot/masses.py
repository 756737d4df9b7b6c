"""Where the centroid is, how well that is known, and what moves it: payloads, arms, masts."""

from typing import Annotated, ClassVar, Self

from pydantic import Field

from kaidan.errors import InputError, shown
from kaidan.sheet import Sheet, model_validator, quantity
from kaidan.units import parse


class Uncertainty(Sheet):
    """Standard uncertainties (one sigma) of the sheet's figures; zero means taken as exact."""

    label: ClassVar[str] = "robot: uncertainty"

    com_from_front: float = quantity("m", 0.0, 0.5, "of com_from_front", default=0.0)
    com_height: float = quantity("m", 0.0, 0.5, "of com_height", default=0.0)
    flat_length: float = quantity("m", 0.0, 0.5, "of track.flat_length", default=0.0)


_Along = Annotated[float, Field(ge=-1.0, le=6.0)]
_Height = Annotated[float, Field(ge=0.005, le=3.0)]


class CentroidRange(Sheet):
    """Where the centroid of a robot that nobody weighed may be: from low to high, both certain."""

    label: ClassVar[str] = "robot: com_range"

    from_front: tuple[_Along, _Along] = Field(
        description="lowest and highest com_from_front",
        json_schema_extra={"unit": "m", "symbol": "C_L"},
    )
    height: tuple[_Height, _Height] = Field(
        description="lowest and highest com_height",
        json_schema_extra={"unit": "m", "symbol": "C_N"},
    )

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        for name in ("from_front", "height"):
            low, high = getattr(self, name)
            if low > high:
                raise self.refuse(f"{name}: its low end {low:g} m is above its high end {high:g} m")
        return self

    @property
    def middle(self) -> tuple[float, float]:
        """C_L and C_N in the middle of the range [m]."""
        return sum(self.from_front) / 2, sum(self.height) / 2


class Payload(Sheet):
    """A mass fixed to the robot."""

    label: ClassVar[str] = "payload"

    mass: float = quantity("kg", 0.0, 1000.0, "mass")
    from_front: float = quantity(
        "m", -3.0, 8.0, "behind the front end of the main track's flat underside"
    )
    height: float = quantity("m", -1.0, 5.0, "above the underside of the main track")

    @classmethod
    def parse(cls, text: str, *, option: str = "payload") -> Self:
        """Payload from a text such as "5kg@200mm,300mm": mass, behind the front end, height.

        Raises
        ------
        InputError
            A text of another form.
        """
        mass, at, place = text.partition("@")
        behind, comma, height = place.partition(",")
        if not at or not comma:
            raise InputError(
                f"{option} {shown(text)}: write MASS@BEHIND_FRONT,HEIGHT, for example "
                "5kg@200mm,300mm"
            )
        return cls(
            mass=parse(mass, "mass", option=option),
            from_front=parse(behind, "length", option=option),
            height=parse(height, "length", option=option),
        )


class State(Sheet):
    """A state of an arm, a mast or a payload beside the one in which the centroid was measured."""

    label: ClassVar[str] = "robot: states"

    mass: float | None = quantity(
        "kg", 0.0, 1000.0, "what moves; without it the centroid itself moves so far", default=None
    )
    forward: float = quantity("m", -3.0, 3.0, "how far it moves towards the nose", default=0.0)
    up: float = quantity("m", -3.0, 3.0, "how far it moves up", default=0.0)
