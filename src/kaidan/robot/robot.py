"""The sheet itself, and what the closed form sees of it in a posture."""

import math
from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import Any, ClassVar, NamedTuple, Self

from pydantic import Field

from kaidan import catalog
from kaidan.allowance import Allowance
from kaidan.errors import InputError, listed, shown
from kaidan.robot.drive import Drive
from kaidan.robot.flippers import FlipperPair, Posture
from kaidan.robot.masses import CentroidRange, Payload, State, Uncertainty
from kaidan.robot.track import Track
from kaidan.sheet import Itself, Sheet, model_validator, quantity


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


IN_LINE = 1e-6
"""Angle off the flat up to which a flipper lies in line with it [rad]."""


TURNING_MOVES = 9
"""Moves of a manoeuvre on a landing up to which it is GO where the sheet states none: each stop is
10 mm off (a judgement), n of them sqrt(n) times that, and there are 30 mm all round."""
FALL_RESERVE = math.radians(8.0)
"""Tilt to the fall that a robot must keep where it rocks and the sheet states none [rad]: it parts
the climbs of the paper's rig from its falls (docs/decisions.md)."""
REMEMBERED = 1024
"""So many stances are remembered."""


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
    turning_moves: int = Field(
        default=TURNING_MOVES,
        ge=1,
        le=1000,
        description="most drives and turns on the spot of a manoeuvre on a landing that is GO",
        json_schema_extra={"unit": "moves"},
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
    def middle(self) -> Self:
        """Same robot with its centroid in the middle of its range."""
        if self.com_range is None:
            return self
        return self.with_centroid(self.com_from_front, self.com_height)

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

        Raises
        ------
        InputError
            A posture for flippers the robot does not have, a payload on a robot of unknown
            mass, or a centroid that ends up outside the robot.
        """
        return stance_of(Itself(self), posture or Posture(), *payload)

    def _stance(self, posture: Posture, payload: tuple[Payload, ...]) -> Stance:
        forward, up = self._shift(posture.state)
        mass, moment_x, moment_z = self.mass, 0.0, 0.0
        extension = {"front": 0.0, "rear": 0.0}
        tips_below = False
        pairs: tuple[tuple[str, Any, FlipperPair | None], ...] = (
            ("front", posture.front, self.front_flippers),
            ("rear", posture.rear, self.rear_flippers),
        )
        for end, requested, pair in pairs:
            if requested is None:
                continue
            if pair is None:
                raise InputError(f"robot {self.name!r} has no {end} flippers")
            flat = pair.flat_angle
            angle = flat if requested == "flat" else float(requested)
            if math.isclose(angle, flat, abs_tol=IN_LINE):
                extension[end] = pair.flat_extension
            tips_below |= angle < flat - IN_LINE
            arm = pair.mass * pair.com_from_pivot
            outward = arm * (math.cos(angle) - math.cos(pair.stowed_angle))
            moment_x += outward if end == "rear" else -outward
            moment_z += arm * (math.sin(angle) - math.sin(pair.stowed_angle))
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
            known = listed(self.states) or "none"
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


@lru_cache(maxsize=REMEMBERED)
def stance_of(itself: Itself[Robot], posture: Posture, *payload: Payload) -> Stance:
    """Stance of a robot, remembered: a search meets the same postures again and again."""
    return itself.sheet._stance(posture, payload)
