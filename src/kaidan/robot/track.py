"""Main tracks: underside, round ends, wheels above the flat, belts."""

from typing import ClassVar, Literal, Self

from pydantic import Field

from kaidan.sheet import Sheet, model_validator, quantity

USUAL_GROUSERS = {"grouser_height": 0.010, "grouser_spacing": 0.040}
"""Grousers that an answer compares with, where the belts have none [m]."""


class Wheel(Sheet):
    """A wheel above the flat that the belt runs over: a raised nose or tail."""

    label: ClassVar[str] = "robot: track: wheels"

    from_front: float = quantity(
        "m", -2.0, 7.0, "axle behind the front end of the flat underside; negative: ahead of it"
    )
    height: float = quantity("m", 0.005, 2.0, "axle above the underside of the track")
    radius: float = quantity("m", 0.005, 0.6, "radius, belt included")

    @model_validator(mode="after")
    def _above_the_flat(self) -> Self:
        if self.height < self.radius:
            raise self.refuse(
                f"height = {self.height:g} m is less than radius = {self.radius:g} m: the wheel "
                "reaches below the flat underside"
            )
        return self


class Track(Sheet):
    """Main tracks, both alike, seen from the side."""

    label: ClassVar[str] = "robot: track"
    requested: ClassVar[frozenset[str]] = frozenset({"front_radius", "rear_radius"})

    flat_length: float = quantity(
        "m", 0.05, 5.0, "length of the flat underside of the track", symbol="L"
    )
    front_radius: float = quantity(
        "m", 0.0, 0.6, "radius of the front end, belt included", default=0.0, symbol="R"
    )
    rear_radius: float = quantity(
        "m", 0.0, 0.6, "radius of the rear end, belt included", default=0.0, symbol="R"
    )
    gap: float = quantity(
        "m", 0.0, 4.0, "middle part of the flat underside that has no track", default=0.0
    )
    wheels: tuple[Wheel, ...] = Field(
        default=(),
        description="wheels beyond the flat, higher than it, that the belt runs over: a raised "
        "nose or tail",
    )
    gauge: float | None = quantity(
        "m", 0.05, 4.0, "distance between the middles of the two tracks", default=None
    )
    width: float | None = quantity("m", 0.005, 1.5, "width of one track", default=None)
    belly_clearance: float | None = quantity(
        "m", 0.0, 1.0, "height of the belly above the underside of the track", default=None
    )
    drawn_as: Literal["wheels", "box"] | None = Field(
        default=None,
        description="what a file draws in place of a belt, which is then assumed unless belt "
        "states it; none: a belt",
    )
    belt: Literal["smooth", "grousers"] | None = Field(
        default=None, description="surface of the belts; none: not known, and taken as smooth"
    )
    grouser_height: float | None = quantity(
        "m", 0.0, 0.1, "height of a grouser above the belt", default=None
    )
    grouser_spacing: float | None = quantity(
        "m", 0.002, 0.5, "distance between neighbouring grousers along the belt", default=None
    )
    grouser_tip_width: float | None = quantity(
        "m", 0.0005, 0.2, "width of a grouser along the belt, at its tip", default=None
    )
    grouser_hardness: float | None = quantity(
        "1", 10.0, 95.0, "Shore A hardness of a rubber grouser", default=None
    )
    grouser_strength: float | None = quantity(
        "N", 1.0, 1e6, "force along the belt that one grouser bears", default=None
    )
    stiffness: float | None = quantity(
        "N/m",
        1e2,
        1e8,
        "force per length by which a nosing presses into both tracks",
        default=None,
    )
    shear_stiffness: float | None = quantity(
        "N/m",
        1e2,
        1e8,
        "force per length by which a loaded nosing drags both tracks along themselves",
        default=None,
    )
    indentation: float | None = quantity(
        "m",
        1e-5,
        0.1,
        "how far one nosing presses in under the whole weight, instead of stiffness",
        default=None,
    )
    sag: float | None = quantity(
        "m",
        1e-5,
        0.1,
        "how far the whole weight along the track drags it over one nosing, instead of "
        "shear_stiffness",
        default=None,
    )

    @model_validator(mode="after")
    def _one_kind_of_belt(self) -> Self:
        stated = [
            name
            for name in type(self).model_fields
            if name.startswith("grouser_") and getattr(self, name)
        ]
        if self.belt == "smooth" and stated:
            raise self.refuse(f"belt is smooth, but {stated[0]} = {getattr(self, stated[0]):g}")
        width, spacing = self.grouser_tip_width, self.grouser_spacing
        if width is not None and spacing is not None and width >= spacing:
            raise self.refuse(
                f"grouser_tip_width = {width:g} m is not less than grouser_spacing = {spacing:g} m"
            )
        return self

    @model_validator(mode="after")
    def _wheels_beyond_the_flat(self) -> Self:
        for wheel in self.wheels:
            if 0.0 <= wheel.from_front <= self.flat_length:
                raise self.refuse(
                    f"wheels: from_front = {wheel.from_front:g} m lies over the flat, which "
                    f"reaches from 0 to {self.flat_length:g} m"
                )
        return self

    @model_validator(mode="after")
    def _one_way_to_yield(self) -> Self:
        for length, stiffness in (("indentation", "stiffness"), ("sag", "shear_stiffness")):
            if getattr(self, length) is not None and getattr(self, stiffness) is not None:
                raise self.refuse(f"give either {length} or {stiffness}, not both")
        return self

    @property
    def assumed_over(self) -> Literal["wheels", "box"] | None:
        """What a belt that nobody stated is assumed over; None: it is none of these."""
        return None if self.belt is not None else self.drawn_as

    @property
    def has_grousers(self) -> bool:
        """Whether the belts are known to have grousers."""
        return self.belt == "grousers" or bool(self.grouser_height)
