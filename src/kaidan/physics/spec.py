"""All that a trial depends on: robot, stairs, friction, way of going, model of the track, seed.

A `TrialSpec` is a frozen sheet that can be pickled and written as JSON, so that any process on any
machine can run it and come to the same result.
"""

import math
from typing import Annotated, ClassVar, Literal, Self

import numpy as np
from pydantic import Field

from kaidan.errors import InputError
from kaidan.outline import Outline
from kaidan.profile import Profile
from kaidan.robot import Payload, Posture, Robot
from kaidan.sheet import Sheet, model_validator, quantity
from kaidan.stairs import Stairs

UNPUBLISHED_MASS = 20.0
"""Mass of a robot whose sheet gives none [kg]: Kenaf's, guessed. It scales forces; with rigid
tracks the motion does not depend on it."""


class SmoothBelt(Sheet):
    """Rigid track with a smooth surface that runs round it."""

    label: ClassVar[str] = "track model: smooth belt"
    kind: Literal["smooth-belt"] = "smooth-belt"


class SprungNoses(Sheet):
    """Smooth belt on nosings that yield: the compliance of the track, moved into the stairs.

    Each step rests on two springs, along and across the line of the nosings.
    """

    label: ClassVar[str] = "track model: sprung noses"
    kind: Literal["sprung-noses"] = "sprung-noses"
    stiffness: float | None = quantity(
        "N/m",
        1e2,
        1e8,
        "force per length by which a nosing presses into both tracks; the robot sheet's without",
        default=None,
    )
    nose_mass: float = quantity("kg", 0.05, 100.0, "mass of a step on its springs", default=1.0)
    damping_ratio: float = quantity("1", 0.0, 5.0, "of a step on its springs", default=0.5)


class DrivenGrousers(Sheet):
    """Smooth belt with grousers that run round it, driven, each on a radial spring."""

    label: ClassVar[str] = "track model: driven grousers"
    kind: Literal["driven-grousers"] = "driven-grousers"
    height: float | None = quantity(
        "m", 0.002, 0.1, "above the belt; the robot sheet's, else 10 mm", default=None
    )
    spacing: float | None = quantity(
        "m",
        0.01,
        0.5,
        "along the belt, rounded to fit; the robot sheet's, else a 40th of the belt",
        default=None,
    )
    stiffness: float = quantity("N/m", 1e3, 1e8, "of a grouser, radially", default=2e5)


class ShoeChain(Sheet):
    """Chain of hinged rigid shoes round the track, tensioned, pulled by a sprocket: a check."""

    label: ClassVar[str] = "track model: shoe chain"
    kind: Literal["shoe-chain"] = "shoe-chain"
    shoes: int = Field(
        default=40,
        ge=12,
        le=120,
        description="number of shoes",
        json_schema_extra={"unit": "shoes"},
    )
    thickness: float = quantity("m", 0.002, 0.05, "of a shoe", default=0.008)
    tension: float = quantity(
        "N",
        1.0,
        1e5,
        "of both runs together; less than thrice the traction of a 20 kg robot lets shoes jam",
        default=600.0,
    )


TrackModel = Annotated[
    SmoothBelt | SprungNoses | DrivenGrousers | ShoeChain, Field(discriminator="kind")
]
KINDS: dict[str, type[SmoothBelt | SprungNoses | DrivenGrousers | ShoeChain]] = {
    "smooth-belt": SmoothBelt,
    "sprung-noses": SprungNoses,
    "driven-grousers": DrivenGrousers,
    "shoe-chain": ShoeChain,
}
SMOOTH_FRICTION = 3.0
"""Friction of belts where none is stated [1]: they do not slip below 71 degrees."""
RUBBER_FRICTION = 0.8
"""Friction of grousers where none is stated [1]: rubber on something dry, 0.6 to 1.0."""
_SMOOTH = ("smooth-belt", "sprung-noses", "shoe-chain")
FROM_THE_LANDING = 0.02
"""Contact time of a trial that drives against risers [s]: a rigid belt that never slows down and a
rigid riser throw each other about; rubber does not."""
_STEPS = {"smooth-belt": 1e-3, "sprung-noses": 1e-3, "driven-grousers": 1e-3, "shoe-chain": 2.5e-4}


class TrialSpec(Sheet):
    """A trial: everything that its result depends on."""

    label: ClassVar[str] = "trial"

    robot: Robot
    stairs: Stairs
    points: tuple[tuple[float, float], ...] | None = Field(
        default=None, description="own profile x, z [m] instead of the stairs, which lend the name"
    )
    posture: Posture = Posture()
    payload: tuple[Payload, ...] = ()
    friction: float | None = quantity(
        "1",
        0.0,
        5.0,
        "track on nosings; 3 without, which isolates tipping, 0.8 for grousers",
        default=None,
    )
    speed: float = quantity("m/s", 0.001, 5.0, "of the belt; the lowest, if it changes",
                            default=0.1)  # fmt: skip
    acceleration: float = quantity("m/s^2", -9.8, 9.8, "up the stairs", default=0.0)
    direction: Literal["up", "down"] = "up"
    facing: Literal["nose-first", "tail-first"] = "nose-first"
    track: TrackModel = SmoothBelt()
    ground: Literal["steps", "noses"] = Field(
        default="steps",
        description="steps with treads and risers, or a rig that has nothing but its nosings",
    )
    begin: Literal["flight", "landing"] = Field(
        default="flight", description="on the flight as in the paper, or on the landing before it"
    )
    releases: int = Field(
        default=2,
        ge=1,
        le=1000,
        description="nosings to be passed by the downhill end, beginning on the flight",
        json_schema_extra={"unit": "nosings"},
    )
    dimensions: Literal[2, 3] = Field(default=2, description="in the plane, or in space")
    yaw: float = quantity("rad", -0.8, 0.8, "heading, to the left positive (3-D)", default=0.0)
    lateral_offset: float = quantity(
        "m", -5.0, 5.0, "of the centroid from the robot's middle, to the left (3-D)", default=0.0
    )
    start_offset: float | None = quantity(
        "1",
        0.0,
        1.0,
        "share of a spacing by which the downhill end of the flat hangs over its nosing at the "
        "start; random without",
        default=None,
    )
    grouser_phase: float | None = quantity(
        "1", 0.0, 1.0, "share of a grouser spacing; random without", default=None
    )
    seed: int = Field(default=0, ge=0, le=2**63 - 1, description="of what is random")
    timestep: float | None = quantity(
        "s", 1e-5, 5e-3, "of the simulation; 1 ms, 0.25 ms for the chain, without", default=None
    )
    contact_time: float | None = quantity(
        "s",
        2e-5,
        0.1,
        "time in which a contact pushes back what has sunk in; the stiffest that the time step "
        "resolves on the flight, 20 ms where it enters or lands, without",
        default=None,
    )
    log_interval: float = quantity("s", 1e-3, 1.0, "between rows of the log", default=0.02)

    @model_validator(mode="after")
    def _known_combination(self) -> Self:
        if self.dimensions == 3 and self.track.kind != "smooth-belt":
            raise self.refuse(f"{self.track.kind} is modelled in the plane; give dimensions = 2")
        if self.dimensions == 3 and (
            self.robot.track.gauge is None or self.robot.track.width is None
        ):
            raise self.refuse(
                "dimensions = 3 needs gauge and width of the tracks; "
                f"{self.robot.name!r} states none"
            )
        if self.dimensions == 2 and (self.yaw or self.lateral_offset):
            raise self.refuse("yaw and lateral_offset need dimensions = 3")
        if self.track.kind in ("driven-grousers", "shoe-chain"):
            track = self.robot.track
            if track.front_radius != track.rear_radius or track.front_radius < 0.01:
                raise self.refuse(
                    f"{self.track.kind} needs ends of one radius, of at least 10 mm; "
                    f"{self.robot.name!r} has {track.front_radius:g} and {track.rear_radius:g} m"
                )
            if track.gap:
                raise self.refuse(f"{self.track.kind} needs a track without a gap")
        if self.track.kind == "sprung-noses" and self.stiffness is None:
            raise self.refuse(
                f"sprung-noses need a stiffness; the track of {self.robot.name!r} states none"
            )
        if self.track.kind == "shoe-chain" and self.outline().kinds.max() > 0:
            raise self.refuse("shoe-chain is modelled without flippers and belly")
        if self.ground == "noses" and self.begin == "landing":
            raise self.refuse("a rig of nosings alone has no landing to begin on")
        if len(self.profile().nosings) < 2:
            raise self.refuse("the profile has fewer than two nosings")
        return self

    @property
    def stiffness(self) -> float | None:
        """Stiffness of a nosing under both tracks [N/m]; None where it is rigid or unknown."""
        if isinstance(self.track, SprungNoses):
            return self.track.stiffness or self.robot.track.stiffness
        return None

    @property
    def step(self) -> float:
        """Time step [s]."""
        return self.timestep or _STEPS[self.track.kind]

    @property
    def first_nosing(self) -> int:
        """Nosing under the downhill end at the start on the flight, along the way from 0."""
        profile = self.profile()
        last = len(profile.nosings) - 1
        if not self.downhill:
            return 1 if last > 1 else 0
        # the uphill end, which trails, is on the flight too
        return min(math.ceil(self.outline().stance.flat_length / profile.nosing_spacing), last)

    @property
    def runs_out(self) -> bool:
        """Whether the flight ends before the releases asked for, so that the robot lands."""
        wanted = self.first_nosing + self.releases - (0 if self.downhill else 1)
        return wanted > len(self.profile().nosings) - 1

    @property
    def static_friction(self) -> float:
        """Friction of the track on the nosings [1].

        A smooth belt needs more than tan(slope), so without a figure it has what isolates tipping.
        What stands out of a belt holds by its shape: much friction would let it hang on treads.
        """
        usual = SMOOTH_FRICTION if self.track.kind in _SMOOTH else RUBBER_FRICTION
        return usual if self.friction is None else self.friction

    @property
    def softness(self) -> float:
        """Contact time [s], never less than two time steps."""
        usual = FROM_THE_LANDING if self.begin == "landing" or self.runs_out else 0.0
        return max(2 * self.step, usual if self.contact_time is None else self.contact_time)

    @property
    def downhill(self) -> bool:
        """Whether it goes down."""
        return self.direction == "down"

    def profile(self) -> Profile:
        """Terrain along the way: going down it is reflected, so that the way leads to +x."""
        whole = (
            Profile.of_stairs(self.stairs)
            if self.points is None
            else Profile.of_points(np.array(self.points))
        )
        return whole.reflected() if self.downhill else whole

    def outline(self) -> Outline:
        """Robot from the side, x towards the end that leads."""
        try:
            body = Outline.of(self.robot, self.posture, self.payload)
        except InputError as error:
            raise InputError(f"trial: {error}") from None
        return body if self.facing == "nose-first" else body.turned_round()

    def mass(self) -> tuple[float, bool]:
        """Mass [kg], and whether it is assumed because the sheet gives none."""
        stated = self.outline().stance.mass
        return (UNPUBLISHED_MASS, True) if stated is None else (stated, False)

    def drawn(self) -> tuple[float, float]:
        """Start offset and grouser phase [1]: as stated, or drawn from the seed.

        The offset is drawn from 0.1 to 0.5, so that the robot has a third of a second or more at
        the paper's speed before the first nosing is lost, and none has just been lost.
        """
        draw = np.random.default_rng(self.seed)
        offset, phase = 0.1 + 0.4 * draw.random(), draw.random()
        return (
            float(offset) if self.start_offset is None else self.start_offset,
            float(phase) if self.grouser_phase is None else self.grouser_phase,
        )
