"""The robot's data sheet: tracks, centroid, flippers, drive, and how well each is known.

::

                                   C  centroid
        rear                       |  com_height                    front
        .-----------------------------------------------------------.
       (   rear_radius             |             front_radius        )
        '--o-----------------------+--------------------------------o
           |<------------------ flat_length ----------------------->|
                                   |<------- com_from_front ------->|
"""

import math
from collections.abc import Iterable, Mapping
from typing import Annotated, Any, ClassVar, Literal, NamedTuple, Self

from pydantic import Field, ValidationInfo, field_validator

from kaidan import catalog
from kaidan.allowance import Allowance
from kaidan.errors import InputError, shown
from kaidan.sheet import Sheet, model_validator, quantity
from kaidan.units import parse, value_of


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

    @property
    def has_grousers(self) -> bool:
        """Whether the belts are known to have grousers."""
        return self.belt == "grousers" or bool(self.grouser_height)


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


class Drive(Sheet):
    """Limits of the drive; what is not known is left out and then not judged."""

    label: ClassVar[str] = "robot: drive"

    max_speed: float | None = quantity("m/s", 0.001, 30.0, "largest speed", default=None)
    max_acceleration: float | None = quantity(
        "m/s^2", 0.001, 9.8, "largest acceleration the controller asks for", default=None
    )
    max_deceleration: float | None = quantity(
        "m/s^2", 0.001, 9.8, "largest deceleration the controller asks for", default=None
    )
    max_traction: float | None = quantity(
        "N", 1.0, 1e6, "largest sum of the tractive forces of both tracks", default=None
    )
    max_power: float | None = quantity(
        "W", 1.0, 1e6, "largest power at both sprockets", default=None
    )
    sprocket_radius: float | None = quantity(
        "m", 0.005, 0.6, "radius of the sprocket at the belt", default=None
    )
    efficiency: float = quantity("1", 0.05, 1.0, "efficiency from motors to tracks", default=1.0)
    rolling_resistance: float = quantity(
        "1", 0.0, 0.5, "resistance of the tracks over the normal force", default=0.0
    )
    acceleration_control: bool = Field(
        default=False,
        description="whether the acceleration can follow the position on the stairs; without it "
        "the paper's semi-unstable area E counts as unstable",
    )


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
    def parse(cls, text: str, robot: "Robot", *, option: str = "flippers") -> Self:
        """Posture of a robot from a text.

        Parameters
        ----------
        text : str
            "stowed"; "flat" for every pair the robot has; or for front and rear each an angle,
            "flat" or "stowed": "20deg,-5deg". One alone will do where there is one pair. After
            it a state of the sheet: "stowed+arm-out".
        robot : Robot
            Whose flippers they are.
        option : str
            What errors call it, for example "--flippers".

        Returns
        -------
        Posture

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

    def spelled(self, robot: "Robot") -> str:
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


class Stance(NamedTuple):
    """What the closed form sees of a robot in a posture under its payload."""

    flat_length: float
    """Length of the flat underside, flippers in line with it included [m]."""
    com_from_front: float
    """Centroid behind the front end of that length [m]."""
    com_height: float
    """Centroid above the underside [m]."""
    mass: float | None
    """Mass with payload [kg]."""
    front_extension: float
    """Part of that length that the front flippers add [m]."""
    tips_below: bool
    """Whether a flipper reaches below the underside, which the closed form cannot judge."""


TOLERATED_IMPACT = 1.7
"""Speed at which an end may hit the ground where the sheet states none [m/s]: that of an end
dropped from 100 mm, the bench handling test of MIL-STD-810 (docs/decisions.md)."""


FALL_RESERVE = math.radians(8.0)
"""Tilt to the fall that a robot must keep where it rocks and the sheet states none [rad]: it parts
the climbs of the paper's rig from its falls (docs/decisions.md)."""


class Robot(Sheet):
    """A tracked robot."""

    label: ClassVar[str] = "robot"

    name: str = Field(description="short name, used on the command line")
    title: str = Field(default="", description="full name")
    mass: float | None = quantity("kg", 0.1, 5000.0, "mass", default=None, symbol="M")
    com_from_front: float = quantity(
        "m", -1.0, 6.0, "centroid behind the front end of the flat underside", symbol="C_L"
    )
    com_height: float = quantity(
        "m", 0.005, 3.0, "centroid above the underside of the track", symbol="C_N"
    )
    com_range: CentroidRange | None = Field(
        default=None,
        description="where the centroid may be, if nobody weighed the robot; com_from_front and "
        "com_height are then its middle where they are left out",
    )
    inertia: float | None = quantity(
        "kg m^2",
        1e-4,
        1e5,
        "moment of inertia about the lateral axis through the centroid",
        default=None,
    )
    max_impact_speed: float | None = quantity(
        "m/s", 0.05, 20.0, "largest speed at which an end may hit the ground", default=None
    )
    fall_reserve: float | None = quantity(
        "rad",
        0.0,
        0.8,
        "tilt to the fall that the robot must keep where it rocks",
        default=None,
    )
    width: float | None = quantity(
        "m", 0.05, 5.0, "width over all, where it is wider than its tracks", default=None
    )
    height: float | None = quantity(
        "m", 0.02, 5.0, "highest point above the underside of the track", default=None
    )
    turning_centre: float | None = quantity(
        "m",
        -1.0,
        6.0,
        "point about which it turns on the spot, behind the front end of the flat underside; none: "
        "the middle of what carries it",
        default=None,
    )
    track: Track = Field(description="main tracks")
    front_flippers: FlipperPair | None = Field(default=None, description="front flippers")
    rear_flippers: FlipperPair | None = Field(default=None, description="rear flippers")
    states: dict[str, State] = Field(
        default={}, description="states of arm or payload that a posture may name"
    )
    theta_d: Allowance | None = Field(
        default=None, description="measured inclination from track deformation; none: unmeasured"
    )
    theta_M: Allowance | None = Field(
        default=None,
        description="measured loss of margin from grousers going up; none: unmeasured",
    )
    drive: Drive = Field(default=Drive(), description="limits of the drive")
    uncertainty: Uncertainty = Field(default=Uncertainty(), description="standard uncertainties")
    sources: dict[str, str] = Field(
        default={}, description="where each figure comes from, with its status letter"
    )
    notes: str = Field(default="", description="what the user should know")

    @model_validator(mode="before")
    @classmethod
    def _middle(cls, data: Any) -> Any:
        """Centroid of a robot that nobody weighed: the middle of its range."""
        stated = data.get("com_range") if isinstance(data, Mapping) else None
        if not isinstance(stated, Mapping):
            return data
        along, height = CentroidRange.model_validate(stated).middle
        return {"com_from_front": along, "com_height": height, **data}

    @model_validator(mode="after")
    def _centroid_inside(self) -> Self:
        front, rear = 0.0 - self.track.front_radius, self.track.flat_length + self.track.rear_radius
        places = [("com_from_front", self.com_from_front)]
        if self.com_range is not None:
            places += [("com_range.from_front", each) for each in self.com_range.from_front]
            low, high = self.com_range.height
            along = self.com_range.from_front
            if not (along[0] <= self.com_from_front <= along[1] and low <= self.com_height <= high):
                raise self.refuse("com_from_front and com_height are not within com_range")
        for name, place in places:
            if not front <= place <= rear:
                raise self.refuse(
                    f"{name} = {place:g} m puts the centroid outside the robot: "
                    f"allowed {front:g} to {rear:g} m"
                )
        flipper_mass = sum(pair.mass for pair in self.flippers().values())
        if self.mass is None and flipper_mass > 0:
            raise self.refuse("mass is missing: the flippers' mass moves the centroid")
        if self.mass is not None and flipper_mass >= self.mass:
            raise self.refuse(
                f"mass = {self.mass:g} kg is not more than its flippers' {flipper_mass:g} kg"
            )
        for name, state in self.states.items():
            if state.mass is not None and (self.mass is None or state.mass > self.mass):
                raise self.refuse(
                    f"states.{name}.mass = {state.mass:g} kg needs a robot of known, larger mass"
                )
        return self

    @classmethod
    def named(cls, name: str) -> Self:
        """Robot of the catalogue, or of a TOML file.

        Raises
        ------
        UnknownNameError
            Neither; the text lists the catalogue.
        InputError
            A catalogue entry of which no centroid is published, or a bad file.
        """
        return catalog.load("robots", name, cls.from_text)

    @property
    def weighed(self) -> Self:
        """Robot itself, for what needs one centroid.

        Raises
        ------
        InputError
            Nobody weighed it: its sheet has a range.
        """
        if self.com_range is not None:
            raise InputError(
                f"robot {self.name!r}: its centroid is not measured (com_range); assess, posture "
                "and compare judge the range, anything else needs one centroid: weigh it (kaidan "
                "measure robot), or state --override com_from_front=...,com_height=..."
            )
        return self

    def with_centroid(self, com_from_front: float, com_height: float) -> Self:
        """Same robot with another centroid, taken as measured [m]."""
        changes = {"com_from_front": com_from_front, "com_height": com_height, "com_range": None}
        return type(self)(**dict(self) | changes)

    @property
    def tolerated_impact(self) -> float:
        """Speed at which an end may hit the ground, as stated or by default [m/s]."""
        return TOLERATED_IMPACT if self.max_impact_speed is None else self.max_impact_speed

    @property
    def kept_reserve(self) -> float:
        """Tilt to the fall that it must keep where it rocks, as stated or by default [rad]."""
        return FALL_RESERVE if self.fall_reserve is None else self.fall_reserve

    def stance(self, posture: Posture | None = None, payload: Iterable[Payload] = ()) -> Stance:
        """Flat length and centroid of the robot in a posture under its payload.

        Parameters
        ----------
        posture : Posture, optional
            Angles of the flippers; all stowed without one.
        payload : iterable of Payload
            Masses fixed to the robot.

        Returns
        -------
        Stance

        Raises
        ------
        InputError
            A posture for flippers the robot does not have, a payload on a robot of unknown
            mass, or a centroid that ends up outside the robot.
        """
        posture = posture or Posture()
        forward, up = self._shift(posture.state)
        mass, moment_x, moment_z = self.mass, 0.0, 0.0
        extension = {"front": 0.0, "rear": 0.0}
        tips_below = False
        for end in ("front", "rear"):
            requested, pair = getattr(posture, end), self.flippers().get(end)
            if requested is None:
                continue
            if pair is None:
                raise InputError(f"robot {self.name!r} has no {end} flippers")
            angle = pair.flat_angle if requested == "flat" else float(requested)
            if math.isclose(angle, pair.flat_angle, abs_tol=1e-6):
                extension[end] = pair.flat_extension
            tips_below |= angle < pair.flat_angle - 1e-6
            arm = pair.mass * pair.com_from_pivot
            outward = arm * (math.cos(angle) - math.cos(pair.stowed_angle))
            moment_x += outward if end == "rear" else -outward
            moment_z += arm * (math.sin(angle) - math.sin(pair.stowed_angle))
        payload = tuple(payload)
        if payload and mass is None:
            raise InputError(
                f"robot {self.name!r}: mass is not published, so a payload cannot be placed; "
                "give the robot's mass"
            )
        com_from_front, com_height = self.com_from_front - forward, self.com_height + up
        if mass is not None:
            moment_x += com_from_front * mass + sum(p.mass * p.from_front for p in payload)
            moment_z += com_height * mass + sum(p.mass * p.height for p in payload)
            mass += sum(p.mass for p in payload)
            com_from_front, com_height = moment_x / mass, moment_z / mass
        flat_length = self.track.flat_length + extension["front"] + extension["rear"]
        com_from_front += extension["front"]
        if not (
            -self.track.front_radius <= com_from_front <= flat_length + self.track.rear_radius
            and com_height > 0
        ):
            raise InputError(
                f"robot {self.name!r}: the payload puts the centroid outside the robot "
                f"({com_from_front:g} m behind the front end, {com_height:g} m high)"
            )
        return Stance(
            flat_length=flat_length,
            com_from_front=com_from_front,
            com_height=com_height,
            mass=mass,
            front_extension=extension["front"],
            tips_below=tips_below,
        )

    def _shift(self, name: str | None) -> tuple[float, float]:
        """How far a state moves the centroid, towards the nose and up [m]."""
        if name is None:
            return 0.0, 0.0
        if name not in self.states:
            known = ", ".join(self.states) or "none"
            raise InputError(f"robot {self.name!r} has no state {shown(name)}; known: {known}")
        state = self.states[name]
        share = 1.0 if state.mass is None or self.mass is None else state.mass / self.mass
        return share * state.forward, share * state.up

    @property
    def overall_width(self) -> float:
        """Width over all, or over the tracks [m]; NaN: the sheet states neither."""
        gauge, track = self.track.gauge, self.track.width
        if gauge is None or track is None:
            return math.nan if self.width is None else self.width
        return max(gauge + track, self.width or 0.0)

    def flippers(self) -> dict[str, FlipperPair]:
        """Pairs of flippers that the robot has, by end: "front", "rear"."""
        pairs: dict[str, Any] = {"front": self.front_flippers, "rear": self.rear_flippers}
        return {end: pair for end, pair in pairs.items() if pair is not None}
