"""All that a trial depends on: a question, and what a trial needs beside it.

A `TrialSpec` is a frozen sheet that can be pickled and written as JSON, so that any process on any
machine can run it and come to the same result.
"""

import math
from typing import ClassVar, Literal, Self

import numpy as np
from pydantic import Field, field_validator

from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.modes import PHYSICS
from kaidan.outline import Outline
from kaidan.physics.tracks import SmoothBelt, SprungNoses, TrackModel, YieldingBelt
from kaidan.question import Question
from kaidan.sheet import Sheet, model_validator, quantity
from kaidan.terrain.profile import Profile

UNPUBLISHED_MASS = 20.0
"""Mass of a robot whose sheet gives none [kg]: Kenaf's, guessed. It scales forces; with rigid
tracks the motion does not depend on it."""
SPEED = 0.1
"""Speed of the belt where none is stated [m/s]: the paper's."""
SPEEDS = (0.001, 5.0)
"""Speeds of the belt that a trial can have [m/s]."""
LARGEST_YAW = 0.8
"""Largest heading off the line of steepest ascent [rad]: beyond it the terrain is too narrow."""
SMOOTH_FRICTION = 3.0
"""Friction of belts where none is stated [1]: they do not slip below 71 degrees."""
RUBBER_FRICTION = 0.8
"""Friction of grousers where none is stated [1]: rubber on something dry, 0.6 to 1.0."""
SMALLEST_CHAIN_WHEEL = 0.010
"""Radius of an end that the shoes of a chain can go round [m]."""
_SMOOTH = ("smooth-belt", "yielding-belt", "sprung-noses", "shoe-chain")
_RIGID_STAIRS = ("smooth-belt", "driven-grousers", "shoe-chain")
FROM_THE_LANDING = 0.02
"""Contact time of a trial that drives against risers [s]: a rigid belt that never slows down and a
rigid riser throw each other about; rubber does not."""
_STEPS = {
    "smooth-belt": 1e-3,
    "yielding-belt": 1e-3,
    "sprung-noses": 1e-3,
    "driven-grousers": 1e-3,
    "shoe-chain": 2.5e-4,
}
_NO_PART = ("theta_d", "theta_M", "risk", "trials", "track", "uniform_across")
"""Fields of a question that play no part in a trial."""


class TrialSpec(Sheet):
    """A trial: everything that its result depends on."""

    label: ClassVar[str] = "trial"

    question: Question = Field(
        description="robot, terrain, surface and how it is driven; allowances, risk, acceptance "
        "and model play no part and are kept at their defaults"
    )
    track: TrackModel = SmoothBelt()
    ground: Literal["steps", "noses"] = Field(
        default="steps",
        description="steps with treads and risers, or a rig that has nothing but its nosings",
    )
    nosing_radius: float = quantity(
        "m", 0.0, 0.05, "of the nosings: their edges are round; sharp without", default=0.0
    )
    begin: Literal["flight", "landing"] = Field(
        default="flight", description="on the flight as in the paper, or on the landing before it"
    )
    nosings: int = Field(
        default=2,
        ge=1,
        le=1000,
        description="nosings to be passed by the downhill end, beginning on the flight",
        json_schema_extra={"unit": "nosings"},
    )
    dimensions: Literal[2, 3] = Field(default=2, description="in the plane, or in space")
    lateral_offset: float = quantity(
        "m", -5.0, 5.0, "of the centroid from the robot's middle, to the left (3-D)", default=0.0
    )
    start_offset: float | None = quantity(
        "1",
        0.0,
        1.0,
        "share of a spacing by which the downhill end of the flat hangs over its nosing at the "
        "start, random without; from a landing that much farther off, none without",
        default=None,
    )
    grouser_phase: float | None = quantity(
        "1", 0.0, 1.0, "share of a grouser spacing; random without", default=None
    )
    other_phase: float | None = quantity(
        "1",
        0.0,
        1.0,
        "likewise of the other belt; without, as stated of the first, else random",
        default=None,
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

    @field_validator("question")
    @classmethod
    def _as_a_trial_takes_it(cls, question: Question) -> Question:
        """Question without what plays no part, so that trials that are alike are equal."""
        usual = {name: Question.model_fields[name].default for name in _NO_PART}
        usual["model"] = PHYSICS.name
        same = all(getattr(question, name) == value for name, value in usual.items())
        return question if same else question.changed(**usual)

    @model_validator(mode="after")
    def _possible(self) -> Self:
        self._refuse_manner()
        self._refuse_track()
        if len(self.profile().nosings) < 2:
            raise self.refuse("the terrain has fewer than two nosings")
        if self.begin == "landing" and self.ground == "noses":
            raise self.refuse("a rig of nosings alone has no landing to begin on")
        if self.begin == "flight" and isinstance(self.question.terrain, tuple):
            raise self.refuse("several flights are driven from the landing; give begin = landing")
        return self

    def _refuse_manner(self) -> None:
        slowest, fastest = SPEEDS
        if not slowest <= self.speed <= fastest:
            raise self.refuse(
                f"speed = {self.speed:g} m/s is not within {slowest:g} to {fastest:g} m/s"
            )
        if abs(self.question.yaw) > LARGEST_YAW:
            raise self.refuse(
                f"yaw = {self.question.yaw:g} rad is not within -{LARGEST_YAW:g} to "
                f"{LARGEST_YAW:g} rad"
            )
        if self.dimensions == 2 and (self.question.yaw or self.lateral_offset):
            raise self.refuse("yaw and lateral_offset need dimensions = 3")

    def _refuse_track(self) -> None:
        kind, robot = self.track.kind, self.question.robot.weighed
        track = robot.track
        if self.dimensions == 3:
            if kind != "smooth-belt":
                raise self.refuse(f"{kind} is modelled in the plane; give dimensions = 2")
            if track.gauge is None or track.width is None:
                raise self.refuse(
                    "dimensions = 3 needs gauge and width of the tracks; "
                    f"{robot.name!r} does not state both"
                )
        if kind in ("driven-grousers", "shoe-chain"):
            ends = f"{robot.name!r} has {track.front_radius:g} and {track.rear_radius:g} m"
            if track.front_radius != track.rear_radius:
                raise self.refuse(f"{kind} needs ends of one radius; {ends}")
            if kind == "shoe-chain" and track.front_radius < SMALLEST_CHAIN_WHEEL:
                raise self.refuse(f"{kind} needs ends of at least 10 mm; {ends}")
            if track.gap:
                raise self.refuse(f"{kind} needs a track without a gap")
        if self.nosing_radius and (kind not in _RIGID_STAIRS or self.ground == "noses"):
            raise self.refuse(
                f"nosing_radius is for steps, with {', '.join(_RIGID_STAIRS)}; 0 elsewhere"
            )
        if kind in ("sprung-noses", "yielding-belt") and self.stiffness is None:
            raise self.refuse(f"{kind} needs a stiffness; the track of {robot.name!r} states none")
        if kind == "shoe-chain" and self.outline().kinds.max() > 0:
            raise self.refuse("shoe-chain is modelled without flippers and belly")

    @property
    def speed(self) -> float:
        """Speed of the belt [m/s]; the lowest, if it changes."""
        return SPEED if self.question.speed is None else self.question.speed

    @property
    def stiffness(self) -> float | None:
        """Stiffness of a nosing under both tracks [N/m]; None where it is rigid or unknown."""
        if isinstance(self.track, SprungNoses | YieldingBelt):
            sheet = self.question.robot.track
            return self.track.stiffness or sheet.stiffness or self._of_length(sheet.indentation)
        return None

    @property
    def shear_stiffness(self) -> float | None:
        """Stiffness along the track likewise [N/m]; None where it does not shear."""
        if not isinstance(self.track, YieldingBelt) or self.stiffness is None:
            return None
        sheet = self.question.robot.track
        if self.track.shear_ratio is None and self.track.stiffness is None:
            own = sheet.shear_stiffness or self._of_length(sheet.sag)
            if own is not None:
                return own
        return (self.track.shear_ratio or 1.0) * self.stiffness

    def _of_length(self, length: float | None) -> float | None:
        """Stiffness that yields so far under the robot's whole weight [N/m]."""
        own = self.question.robot.mass or UNPUBLISHED_MASS
        return None if length is None else own * STANDARD_GRAVITY / length

    @property
    def step(self) -> float:
        """Time step [s]."""
        return self.timestep or _STEPS[self.track.kind]

    @property
    def first_nosing(self) -> int:
        """Nosing under the downhill end at the start on the flight, along the path from 0."""
        profile = self.profile()
        last = len(profile.nosings) - 1
        if not self.downhill:
            return 1 if last > 1 else 0
        # the uphill end, which trails, is on the flight too
        return min(math.ceil(self.outline().stance.flat_length / profile.nosing_spacing), last)

    @property
    def runs_out(self) -> bool:
        """Whether the flight ends before the nosings to be passed, so that the robot lands."""
        required = self.first_nosing + self.nosings - (0 if self.downhill else 1)
        return required > len(self.profile().nosings) - 1

    @property
    def static_friction(self) -> float:
        """Friction of the track on the nosings [1]: the lowest of the surface.

        A smooth belt needs more than tan(slope), so without a figure it has what isolates tipping.
        What stands out of a belt holds by its shape: much friction would let it hang on treads.
        """
        if self.question.surface is not None:
            return self.question.surface.friction_low
        stands_out = isinstance(self.track, YieldingBelt) and self.track.height
        smooth = self.track.kind in _SMOOTH and not stands_out
        return SMOOTH_FRICTION if smooth else RUBBER_FRICTION

    @property
    def softness(self) -> float:
        """Contact time [s], never less than two time steps."""
        usual = FROM_THE_LANDING if self.begin == "landing" or self.runs_out else 0.0
        return max(2 * self.step, usual if self.contact_time is None else self.contact_time)

    @property
    def downhill(self) -> bool:
        """Whether it goes down."""
        return self.question.direction == "down"

    def profile(self) -> Profile:
        """Terrain as driven: going down it is reflected, so that the path leads to +x."""
        return self.question.profile.reflected() if self.downhill else self.question.profile

    def outline(self) -> Outline:
        """Robot from the side, x towards the end that leads."""
        body = self.question.outline
        return body if self.question.facing == "nose-first" else body.turned_round()

    def mass(self) -> tuple[float, bool]:
        """Mass [kg], and whether it is assumed because the sheet gives none."""
        stated = self.question.stance.mass
        return (UNPUBLISHED_MASS, True) if stated is None else (stated, False)

    def drawn(self) -> tuple[float, float, float]:
        """Start offset and both belts' grouser phases [1]: as stated, or drawn from the seed.

        The offset is drawn from 0.1 to 0.5, so that the robot has a third of a second or more at
        the paper's speed before the first nosing is lost, and none has just been lost.
        """
        draw = np.random.default_rng(self.seed)
        offset, phase, other = 0.1 + 0.4 * draw.random(), draw.random(), draw.random()
        if self.grouser_phase is not None:
            phase = other = self.grouser_phase
        return (
            float(offset) if self.start_offset is None else self.start_offset,
            float(phase),
            float(other) if self.other_phase is None else self.other_phase,
        )
