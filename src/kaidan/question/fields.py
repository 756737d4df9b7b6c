"""What a question states: its fields, each with its bounds, unit and meaning; its terrain."""

import math
from collections.abc import Mapping
from functools import cached_property
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import Discriminator, Field, Tag, field_validator

from kaidan.allowance import Allowance
from kaidan.errors import InputError
from kaidan.modes import CONTACT, Direction, Facing, Phase
from kaidan.question.room import lane_of
from kaidan.robot import Payload, Posture, PostureChange, Robot, Stance
from kaidan.sheet import Sheet, quantity
from kaidan.spelling import JOINT, Terrain
from kaidan.surface import Surface
from kaidan.terrain.gap import Gap
from kaidan.terrain.landings import Landing, landings_of
from kaidan.terrain.profile import Profile
from kaidan.terrain.room import Room
from kaidan.terrain.stairs import Stairs

FASTEST = 30.0
"""Fastest speed of a question [m/s]."""
LARGEST_TOLERANCE = 0.2617993877991494
"""Largest tolerance of the flippers' angles, 15 degrees [rad]."""
FACINGS = ("nose-first", "tail-first")
"""Ends that may lead."""
TRACKS = ("smooth-belt", "yielding-belt", "driven-grousers")
"""Tracks of the physics that a question may name."""
MOST_TRIALS = 100_000
"""Most trials of a question to the physics."""
LARGEST_YAW = 1.3962634015954636
"""Largest yaw judged, 80 degrees [rad]: beyond it the robot drives along the steps."""


def _kind_of_terrain(given: Any) -> str:
    if isinstance(given, Profile) or (isinstance(given, Mapping) and "points" in given):
        return "profile"
    return "flights" if isinstance(given, list | tuple) else "stairs"


class QuestionFields(Sheet):
    """One robot, one terrain, one manner of going, one risk."""

    label: ClassVar[str] = "question"

    robot: Robot = Field(description="data sheet of the robot")
    terrain: Annotated[
        Annotated[Stairs, Tag("stairs")]
        | Annotated[tuple[Stairs, ...], Tag("flights")]
        | Annotated[Profile, Tag("profile")],
        Discriminator(_kind_of_terrain),
    ] = Field(description="one flight, several from bottom to top, or a profile of any shape")
    uniform_across: bool = Field(
        default=False,
        description="whether both tracks meet the same profile, stated of one that is no flight, "
        "step, ramp or threshold",
    )
    surface: Surface | None = Field(
        default=None, description="friction of the tracks; without it no GO can be given"
    )
    direction: Direction = Field(default="up", description="which way the robot goes")
    facing: Facing = Field(default="nose-first", description="which end leads")
    acceleration: float = quantity(
        "m/s^2", -9.8, 9.8, "up the stairs, whichever way the robot goes", default=0.0, symbol="a"
    )
    speed: float | None = quantity("m/s", 0.0, FASTEST, "speed of the robot", default=None)
    posture: Posture = Field(
        default=Posture(), description="angles of the flippers, at the start of a plan"
    )
    changes: tuple[PostureChange, ...] = Field(
        default=(), description="plan: other postures later on, in their order"
    )
    best_of: tuple[Literal["flippers", "facing"], ...] = Field(
        default=(),
        description="what is to be found: the flippers' plan, the end that leads; a stated posture "
        "then does not count, the stated end is tried first",
    )
    flipper_tolerance: float | None = quantity(
        "rad",
        0.0,
        LARGEST_TOLERANCE,
        "how far off their angles the flippers may lie without a worse verdict; none: 2 degrees "
        "where a plan is to be found, else 0",
        default=None,
    )
    payload: tuple[Payload, ...] = Field(default=(), description="masses fixed to the robot")
    theta_d: Allowance | None = Field(
        default=None, description="measured inclination from track deformation; none: the sheet's"
    )
    theta_M: Allowance | None = Field(
        default=None, description="measured loss of margin from grousers; none: the sheet's"
    )
    fall_reserve: float | None = quantity(
        "rad",
        0.0,
        0.8,
        "tilt to the fall that a robot that rocks must keep; none: the sheet's, else 8 degrees",
        default=None,
    )
    yaw: float = quantity(
        "rad",
        -LARGEST_YAW,
        LARGEST_YAW,
        "heading off the line of steepest ascent, to the left positive",
        default=0.0,
    )
    risk: float = quantity("1", 1e-4, 0.5, "probability of failure that is accepted", default=0.01)
    model: str = Field(default=CONTACT.name, description="which model answers")
    trials: int = Field(
        default=1,
        ge=1,
        le=MOST_TRIALS,
        description="of the physics, each with inputs of its own where they are uncertain",
        json_schema_extra={"unit": "trials"},
    )
    track: Literal["smooth-belt", "yielding-belt", "driven-grousers"] | None = Field(
        default=None,
        description="track of the physics; none: yielding-belt where the sheet says how it "
        "yields, else smooth-belt",
    )

    @field_validator("terrain")
    @classmethod
    def _one_flight_is_a_flight(cls, terrain: Terrain) -> Terrain:
        if terrain == ():
            raise InputError("question: terrain: no flight was given")
        return terrain[0] if isinstance(terrain, tuple) and len(terrain) == 1 else terrain

    @cached_property
    def profile(self) -> Profile:
        """Terrain as a line, from the lower landing to the upper one.

        Of a profile that falls from left to right, for a robot that goes down: seen from the other
        side.
        """
        if isinstance(self.terrain, Profile):
            return self.terrain.upward(descending=self.direction == "down")
        return Profile.of_flights(self._driven)

    @cached_property
    def flight(self) -> Stairs | None:
        """Steps of the terrain as one flight, measured where it is no sheet; None: it has none."""
        if isinstance(self.terrain, Stairs):
            return self.terrain
        return self.profile.as_stairs(self.terrain_name)

    @cached_property
    def flights(self) -> tuple[Stairs, ...]:
        """Sheets of its flights from bottom to top; none of a profile."""
        flights = self.terrain if isinstance(self.terrain, tuple) else (self.terrain,)
        return tuple(each for each in flights if isinstance(each, Stairs))

    @property
    def steepest_flight(self) -> Stairs | None:
        """Steepest of its flights, landings left out; of a profile: `flight`."""
        return max(self.flights, key=lambda each: each.angle, default=self.flight)

    @property
    def room(self) -> Room | None:
        """What is free along its flights; None: nothing is stated."""
        each = (Room.of(one.width, one.headroom, one.clear) for one in self.flights)
        stated = [room for room in each if room is not None]
        return Room.of_all(stated) if stated else None

    @property
    def widest_gap(self) -> tuple[Stairs, Gap] | None:
        """Longest gap that the robot must cross, and its flight; one without an end is endless."""
        met = [(flight, gap) for flight in self._driven for gap in flight.gaps]
        return max(met, key=lambda each: each[1].length or math.inf, default=None)

    @cached_property
    def _driven(self) -> tuple[Stairs, ...]:
        """Flights with the gaps that the robot cannot pass beside; a landing ends at one on it."""
        width = lane_of(self.robot) if any(each.gaps for each in self.flights) else math.nan
        return tuple(
            each.up_to_gaps([gap for gap in each.gaps if not gap.beside >= width])
            for each in self.flights
        )

    @property
    def leaves(self) -> tuple[float, float]:
        """Leaves of doors that open onto the lower and onto the upper landing [m]; zero: none."""
        flights = self.flights
        return (flights[0].lower_leaf, flights[-1].upper_leaf) if flights else (0.0, 0.0)

    @property
    def landings(self) -> tuple[Landing, ...]:
        """Landings on which the way turns, from bottom to top; none of a profile."""
        return landings_of(self.flights)

    @property
    def meets_the_same(self) -> bool:
        """Whether both tracks meet the same ground, as far as the question states it.

        A flight is built so across the way, as are a step, a ramp and a threshold.
        """
        profile = self.terrain if isinstance(self.terrain, Profile) else None
        return profile is None or self.uniform_across or self.profile.shape != "irregular"

    @property
    def uneven_across(self) -> bool:
        """Whether the two tracks meet other steps, so that the flight is judged under both."""
        return any(
            each.twisted or (self.yaw != 0.0 and each.rises is not None) for each in self.flights
        )

    @property
    def terrain_name(self) -> str:
        """What people call the terrain."""
        if isinstance(self.terrain, tuple):
            return f" {JOINT} ".join(flight.name for flight in self.terrain)
        return self.terrain.name

    @cached_property
    def postures(self) -> Mapping[Phase, Posture]:
        """Posture of each phase."""
        at, found = self.posture, {}
        changes = {Phase(each.before): each.posture for each in self.changes}
        for phase in Phase:
            at = found[phase] = changes.get(phase, at)
        return found

    @cached_property
    def stance(self) -> Stance:
        """Robot in its posture on the flight, under its payload."""
        return self.robot.stance(self._on_flight, self.payload)

    @property
    def _on_flight(self) -> Posture:
        if "flippers" in self.best_of:
            raise InputError(
                "flippers = best has to be found first; state stowed, flat, angles or a plan"
            )
        return self.postures[Phase.TRAVERSE]

    @property
    def plannable(self) -> bool:
        """Whether angles by phase can be found: by the contact model, straight on."""
        return self.model == CONTACT.name and not self.yaw

    @property
    def nose_up(self) -> bool:
        """Whether the nose points up the stairs."""
        return (self.direction == "up") == (self.facing == "nose-first")

    @cached_property
    def friction(self) -> tuple[float, float]:
        """Static friction of nosings in the worst and in the best case [1]; NaN: not stated."""
        if self.surface is None:
            return np.nan, np.nan
        return self.surface.of_parts()[0], self.surface.of_parts(best=True)[0]
