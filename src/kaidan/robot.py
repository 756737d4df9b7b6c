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
from collections.abc import Iterable
from typing import Any, ClassVar, NamedTuple, Self

from pydantic import Field

from kaidan import catalog
from kaidan.errors import InputError
from kaidan.sheet import Sheet, model_validator, quantity


class Track(Sheet):
    """Main tracks, both alike, seen from the side."""

    label: ClassVar[str] = "robot: track"

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
    gauge: float | None = quantity(
        "m", 0.05, 4.0, "distance between the middles of the two tracks", default=None
    )
    width: float | None = quantity("m", 0.005, 1.5, "width of one track", default=None)
    belly_clearance: float | None = quantity(
        "m", 0.0, 1.0, "height of the belly above the underside of the track", default=None
    )
    grouser_height: float | None = quantity(
        "m", 0.0, 0.1, "height of a grouser above the belt", default=None
    )
    grouser_spacing: float | None = quantity(
        "m", 0.002, 0.5, "distance between neighbouring grousers along the belt", default=None
    )
    stiffness: float | None = quantity(
        "N/m",
        1e2,
        1e8,
        "force per length by which a nosing presses into both tracks",
        default=None,
    )


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


class Payload(Sheet):
    """A mass fixed to the robot."""

    label: ClassVar[str] = "payload"

    mass: float = quantity("kg", 0.0, 1000.0, "mass")
    from_front: float = quantity(
        "m", -3.0, 8.0, "behind the front end of the main track's flat underside"
    )
    height: float = quantity("m", -1.0, 5.0, "above the underside of the main track")


class Posture(Sheet):
    """Angles of the flippers; None leaves a pair stowed, "flat" lays it in line with the track."""

    label: ClassVar[str] = "posture"

    front: float | str | None = None
    rear: float | str | None = None

    @model_validator(mode="after")
    def _known_words(self) -> Self:
        for name in ("front", "rear"):
            value = getattr(self, name)
            if isinstance(value, str) and value != "flat":
                raise self.refuse(f"{name} = {value!r}; allowed: an angle in rad, 'flat' or none")
            if isinstance(value, float) and not -math.pi <= value <= math.pi:
                raise self.refuse(f"{name} = {value:g} rad is not within -3.14159 to 3.14159 rad")
        return self


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
    inertia: float | None = quantity(
        "kg m^2",
        1e-4,
        1e5,
        "moment of inertia about the lateral axis through the centroid",
        default=None,
    )
    track: Track = Field(description="main tracks")
    front_flippers: FlipperPair | None = Field(default=None, description="front flippers")
    rear_flippers: FlipperPair | None = Field(default=None, description="rear flippers")
    drive: Drive = Field(default=Drive(), description="limits of the drive")
    uncertainty: Uncertainty = Field(default=Uncertainty(), description="standard uncertainties")
    sources: dict[str, str] = Field(
        default={}, description="where each figure comes from, with its status letter"
    )
    notes: str = Field(default="", description="what the user should know")

    @model_validator(mode="after")
    def _centroid_inside(self) -> Self:
        front, rear = 0.0 - self.track.front_radius, self.track.flat_length + self.track.rear_radius
        if not front <= self.com_from_front <= rear:
            raise self.refuse(
                f"com_from_front = {self.com_from_front:g} m puts the centroid outside the robot: "
                f"allowed {front:g} to {rear:g} m"
            )
        flipper_mass = sum(pair.mass for pair in self._flippers().values())
        if self.mass is None and flipper_mass > 0:
            raise self.refuse("mass is missing: the flippers' mass moves the centroid")
        if self.mass is not None and flipper_mass >= self.mass:
            raise self.refuse(
                f"mass = {self.mass:g} kg is not more than its flippers' {flipper_mass:g} kg"
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
        mass, moment_x, moment_z = self.mass, 0.0, 0.0
        extension = {"front": 0.0, "rear": 0.0}
        tips_below = False
        for end in ("front", "rear"):
            wanted, pair = getattr(posture, end), self._flippers().get(end)
            if wanted is None:
                continue
            if pair is None:
                raise InputError(f"robot {self.name!r} has no {end} flippers")
            angle = pair.flat_angle if wanted == "flat" else float(wanted)
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
        if mass is None:
            com_from_front, com_height = self.com_from_front, self.com_height
        else:
            moment_x += self.com_from_front * mass + sum(p.mass * p.from_front for p in payload)
            moment_z += self.com_height * mass + sum(p.mass * p.height for p in payload)
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

    def _flippers(self) -> dict[str, FlipperPair]:
        pairs: dict[str, Any] = {"front": self.front_flippers, "rear": self.rear_flippers}
        return {end: pair for end, pair in pairs.items() if pair is not None}
