"""Flippers, the angles that an operator gives them, and plans of such angles."""

import math
from collections.abc import Mapping
from typing import Any, ClassVar, Literal, Protocol, Self

from pydantic import Field, ValidationInfo, field_validator

from kaidan.errors import InputError, did_you_mean, shown
from kaidan.sheet import Sheet, model_validator, quantity
from kaidan.units import value_of


class FlipperPair(Sheet):
    """A left and a right flipper that move together.

    Angles count from the direction in which the flipper points away from the robot, along the
    track; raising the tip is positive.
    """

    label: ClassVar[str] = "robot: flippers"

    length: float = quantity("m", 0.02, 3.0, "distance from the pivot to the axle of the tip")
    root_radius: float = quantity("m", 0.005, 0.6, "radius about the pivot, belt included")
    tip_radius: float = quantity("m", 0.002, 0.6, "radius about the tip's axle, belt included")
    pivot_inset: float = quantity(
        "m",
        -1.0,
        2.0,
        "pivot inward of the end of the flat underside, along the track",
        default=0.0,
    )
    pivot_height: float = quantity("m", 0.0, 1.0, "pivot above the underside of the main track")
    mass: float = quantity("kg", 0.0, 300.0, "mass of both flippers together", default=0.0)
    com_from_pivot: float = quantity(
        "m", 0.0, 3.0, "centroid of a flipper from its pivot towards the tip", default=0.0
    )
    stowed_angle: float = quantity(
        "rad",
        -math.pi,
        math.pi,
        "angle at which the robot's centroid was measured",
        default=math.pi / 2,
    )
    max_speed: float | None = quantity("rad/s", 0.001, 50.0, "largest turning speed", default=None)
    max_torque: float | None = quantity(
        "N m", 0.01, 1e4, "largest torque of the pair", default=None
    )

    @model_validator(mode="after")
    def _reaches_the_ground(self) -> Self:
        if abs(self.tip_radius - self.pivot_height) >= self.length:
            raise self.refuse(
                f"length = {self.length:g} m is too short to lay the tip in line with the track "
                f"from a pivot {self.pivot_height:g} m above it"
            )
        return self

    @property
    def flat_angle(self) -> float:
        """Angle at which the underside of the tip lies in line with the track [rad]."""
        return math.asin((self.tip_radius - self.pivot_height) / self.length)

    @property
    def flat_extension(self) -> float:
        """Length by which the flipper laid in line lengthens the flat underside [m]."""
        return max(0.0, self.length * math.cos(self.flat_angle) - self.pivot_inset)


class WithFlippers(Protocol):
    """What a posture is spelled for: a robot."""

    @property
    def name(self) -> str: ...  # noqa: D102
    def flippers(self) -> Mapping[str, FlipperPair]: ...  # noqa: D102


class Posture(Sheet):
    """Angles of the flippers; None leaves a pair stowed, "flat" lays it in line with the track."""

    label: ClassVar[str] = "posture"

    front: float | str | None = Field(
        default=None, description="angle of the front flippers [rad], or flat; none: stowed"
    )
    rear: float | str | None = Field(
        default=None, description="angle of the rear flippers [rad], or flat; none: stowed"
    )
    state: str | None = Field(
        default=None, description="state of arm or payload, named in the sheet; none: as measured"
    )

    @classmethod
    def parse(cls, text: str, robot: "WithFlippers", *, option: str = "flippers") -> Self:
        """Posture of a robot from a text.

        Parameters
        ----------
        text : str
            "stowed"; "flat" for every pair the robot has; or for front and rear each an angle,
            "flat" or "stowed": "20deg,-5deg". One alone will do where there is one pair. After
            it a state of the sheet: "stowed+arm-out".
        robot : WithFlippers
            Whose flippers they are.
        option : str
            What errors call it, for example "--flippers".

        Raises
        ------
        InputError
            None of these, an angle that is none, or a pair that the robot does not have.
        """
        pairs = robot.flippers()
        angles, plus, name = text.partition("+")
        state = name.strip() if plus else None
        words = [word.strip() for word in angles.split(",")]
        if words == ["stowed"]:
            return cls(state=state)
        if not pairs:
            raise InputError(f"robot {robot.name!r} has no flippers")
        if words == ["flat"]:
            return cls(**dict.fromkeys(pairs, "flat"), state=state)
        if len(words) == 1 and not any(map(str.isdigit, text)):
            raise InputError(
                f"{option} {shown(text)} is no posture; write stowed, flat or angles such as "
                f"{','.join(('20deg', '-5deg')[: len(pairs)])}"
                + did_you_mean(text, ("stowed", "flat"))
            )
        if len(words) == 1 and len(pairs) == 2:
            raise InputError(
                f"{option} {shown(text)} is one angle for two pairs; write FRONT,REAR, for example "
                "20deg,-5deg"
            )
        if len(words) > 2:
            raise InputError(f"{option} {shown(text)}: write FRONT,REAR, for example 20deg,-5deg")
        ends = dict(zip(pairs if len(words) == 1 else ("front", "rear"), words, strict=True))
        return cls(
            **{
                end: word if word in ("flat", "stowed") else value_of(word, "angle", option=option)
                for end, word in ends.items()
            },
            state=state,
        )

    def spelled(self, robot: "WithFlippers") -> str:
        """Text that `parse` reads back, for example "20deg,-5deg+arm-out"."""
        ends = [
            "stowed" if at is None else at if isinstance(at, str) else f"{math.degrees(at):.6g}deg"
            for end, at in (("front", self.front), ("rear", self.rear))
            if end in robot.flippers()
        ]
        text = ends[0] if len(set(ends)) == 1 and not ends[0].endswith("deg") else ",".join(ends)
        return (text or "stowed") + ("" if self.state is None else f"+{self.state}")

    @field_validator("front", "rear", mode="before")
    @classmethod
    def _angle(cls, value: Any, info: ValidationInfo) -> Any:
        """Angle of a text such as "20deg"; bounds are those of a whole turn."""
        if value is None or value == "flat":
            return value
        if value == "stowed":
            return None
        angle = value_of(value, "angle", option=f"posture: {info.field_name} =")
        if not -math.pi <= angle <= math.pi:
            raise InputError(
                f"posture: {info.field_name} = {angle:g} rad is not within -3.14159 to 3.14159 rad"
            )
        return angle


class PostureChange(Sheet):
    """Another posture from a phase of the traverse on, taken up while the robot stands."""

    label: ClassVar[str] = "change of posture"

    before: Literal["traverse", "land"] = Field(
        description="what it prepares: traverse, just before the centroid passes the first nosing; "
        "land, just before it passes the last"
    )
    posture: Posture = Field(description="posture from there on")
