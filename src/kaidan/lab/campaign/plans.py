"""Plans: what trials a campaign has, in a few lines, so that a store can be resumed by its name."""

import math
from collections.abc import Iterator
from itertools import product
from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np
from pydantic import BaseModel, Field, TypeAdapter, field_validator

from kaidan.errors import InputError, listed
from kaidan.physics import SmoothBelt, TrackModel, TrialSpec
from kaidan.question import Question
from kaidan.robot import Payload, Posture, Robot
from kaidan.sheet import Sheet, model_validator, quantity
from kaidan.spelling import payloads_of, posture_of, robot_of
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs
from kaidan.units import parse, range_of


def seed_of(*parts: int) -> int:
    """Seed of one trial from that of the whole and what tells the trial from others."""
    return int(np.random.SeedSequence(parts).generate_state(1, np.uint64)[0] >> np.uint64(1))


OFFSETS = (0.1, 0.5)
"""Start offsets of stratified trials, as `TrialSpec.drawn` draws them [1]."""


class Condition(Sheet):
    """Stairs and direction, at which a robot makes several trials."""

    label: ClassVar[str] = "condition"

    nosing_spacing: float = quantity("m", 0.02, 2.5, "nosing to nosing along the slope")
    angle: float = quantity("rad", 0.01, 1.5533, "of the line of the nosings")
    direction: Literal["up", "down"] = "up"


class Setting(Sheet):
    """What all trials of an experiment share, whatever their condition.

    The nose points up the stairs, whichever way the robot goes: it comes down tail first, so that
    the same centroid is lost over the same end.
    """

    label: ClassVar[str] = "setting"

    robot: Robot
    posture: Posture = Posture()
    payload: tuple[Payload, ...] = ()
    track: TrackModel = SmoothBelt()
    friction: float | None = quantity(
        "1", 0.0, 5.0, "track on nosings; as a trial takes it without", default=None
    )
    speed: float = quantity("m/s", 0.001, 5.0, "of the belt", default=0.1)
    ground: Literal["steps", "noses"] = "steps"

    @classmethod
    def of(
        cls,
        robot: Any,
        *,
        flippers: Any = "stowed",
        payload: Any = (),
        override: Any = (),
        friction: Any = None,
        speed: Any = 0.1,
        **others: Any,
    ) -> Self:
        """Setting of what people write.

        Parameters
        ----------
        robot, flippers, payload, override, friction, speed
            As `kaidan.Question.of` has them; of a range of friction the low end counts.
        **others
            Other fields.

        Raises
        ------
        InputError
            An input without physical meaning; the text names it.
        """
        sheet = robot_of(robot, override).weighed
        return cls(
            robot=sheet,
            posture=posture_of(flippers, sheet),
            payload=tuple(payloads_of(payload)),
            friction=None
            if friction is None
            else range_of(friction, "number", option="friction")[0],
            speed=parse(speed, "speed", option="speed") if isinstance(speed, str) else speed,
            **others,
        )

    @property
    def static_friction(self) -> float:
        """Friction of the track on the nosings [1], as its trials take it."""
        return self.trial(Condition(nosing_spacing=0.2, angle=0.5), 0).static_friction

    @property
    def steepest(self) -> float:
        """Steepest slope at which a fall says something [deg]: a belt slides a degree above it.

        What has grousers holds by its shape, so there it is 80 degrees.
        """
        if self.track.kind == "driven-grousers":
            return 80.0
        return min(80.0, math.degrees(math.atan(self.static_friction)) - 1.0)

    def trial(
        self, condition: Condition, seed: int, *, nosings: int = 2, **others: Any
    ) -> TrialSpec:
        """Trial at a condition on a flight that is long enough.

        Parameters
        ----------
        seed : int
            Of what is random.
        nosings : int
            To be passed.
        **others
            Other fields of the trial.
        """
        p, down = condition.nosing_spacing, condition.direction == "down"
        within = self.robot.stance(self.posture, self.payload).flat_length / p
        question = Question(
            robot=self.robot,
            terrain=Stairs.inclined(
                angle=condition.angle,
                nosing_spacing=p,
                steps=max(12, 8 + int(within)) + max(nosings - 2, 0),
            ),
            surface=None if self.friction is None else Surface.of_friction(self.friction),
            direction=condition.direction,
            facing="tail-first" if down else "nose-first",
            speed=self.speed,
            posture=self.posture,
            payload=self.payload,
        )
        own = {"track": self.track, "ground": self.ground, "seed": seed, "nosings": nosings}
        return TrialSpec(question=question, **own, **others)


class VerificationTest(Sheet):
    """The paper's verification test: spacings, inclinations, some trials a condition.

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, "Verification test", Figs. 12-13.
    """

    label: ClassVar[str] = "verification test"

    kind: Literal["verification-test"] = "verification-test"
    setting: Setting = Field(description="robot, track, friction and speed of all trials")
    conditions: tuple[Condition, ...] = Field(
        min_length=1, max_length=100_000, description="spacings and slopes, one after the other"
    )
    trials: int = Field(
        default=5,
        ge=1,
        le=1_000_000,
        description="a condition",
        json_schema_extra={"unit": "trials"},
    )
    seed: int = Field(default=0, ge=0, le=2**63 - 1, description="of start offsets and phases")
    nosings: int = Field(
        default=2,
        ge=1,
        le=1000,
        description="to be passed in a trial; on the paper's rig about ten",
        json_schema_extra={"unit": "nosings"},
    )
    stratified: bool = Field(
        default=False,
        description="whether the k-th trials of all conditions share start offset and grouser "
        "phase, which are spread evenly over the trials of a condition",
    )

    def __len__(self) -> int:
        return len(self.conditions) * self.trials

    def specs(self) -> Iterator[TrialSpec]:
        """Trials, one after the other; all of one condition together."""
        for condition in self.conditions:
            first = self.spec(condition, 0)  # validated once; the others differ by their seeds
            for trial in range(self.trials):
                own = {"seed": self._seed(condition, trial), **self._start(trial)}
                yield first.model_copy(update=own)

    def spec(self, condition: Condition, trial: int) -> TrialSpec:
        """One trial; its seed depends on the condition, not on which others there are."""
        seed, start = self._seed(condition, trial), self._start(trial)
        return self.setting.trial(condition, seed, nosings=self.nosings, **start)

    def _start(self, trial: int) -> dict[str, float]:
        """Start offset and grouser phases of the k-th trials: one in each stratum of all."""
        if not self.stratified:
            return {}
        draw = np.random.default_rng(self.seed)
        within, order = draw.random(2), draw.permutation(self.trials)
        offset, phase = (np.array([order[trial], trial]) + within) / self.trials
        other = (draw.permutation(self.trials)[trial] + draw.random()) / self.trials
        least, most = OFFSETS
        return {
            "start_offset": float(least + (most - least) * offset),
            "grouser_phase": float(phase),
            "other_phase": float(other),
        }

    def _seed(self, condition: Condition, trial: int) -> int:
        p, angle = round(1e6 * condition.nosing_spacing), round(1e6 * condition.angle)
        return seed_of(self.seed, p, angle, int(condition.direction == "down"), trial)


class Grid(Sheet):
    """Every combination of values of some fields of a trial, several trials each.

    Examples
    --------
    >>> question = Question.in_one_posture("kenaf", Stairs.inclined(angle=0.9, nosing_spacing=0.15))
    >>> surfaces = tuple(Surface.of_friction(mu) for mu in (0.8, 2.0))
    >>> axes = (("question.surface", surfaces), ("question.robot.com_height", (0.07, 0.1)))
    >>> grid = Grid(base=TrialSpec(question=question), axes=axes)
    >>> trials = list(grid.specs())
    >>> len(grid), trials[1].static_friction, trials[1].question.robot.com_height
    (4, 0.8, 0.1)
    """

    label: ClassVar[str] = "grid"

    kind: Literal["grid"] = "grid"
    base: TrialSpec = Field(description="trial of which fields are changed")
    axes: tuple[tuple[str, tuple[Any, ...]], ...] = Field(
        description="dotted names of fields, each with its values: numbers, texts or whole sheets"
    )
    trials: int = Field(
        default=1,
        ge=1,
        le=1_000_000,
        description="a combination, from start offsets of their own",
        json_schema_extra={"unit": "trials"},
    )

    @field_validator("axes")
    @classmethod
    def _plain(cls, axes: tuple[tuple[str, tuple[Any, ...]], ...]) -> Any:
        """Axes with sheets as tables, as a store keeps them."""
        return tuple((name, tuple(map(_table, values))) for name, values in axes)

    @model_validator(mode="after")
    def _known_fields(self) -> Self:
        sheet = self.base.model_dump(mode="json")
        for name, values in self.axes:
            _set(sheet, name, None)
            if not values:
                raise self.refuse(f"{name} has no value")
        return self

    def __len__(self) -> int:
        count = self.trials
        for _, values in self.axes:
            count *= len(values)
        return count

    def specs(self) -> Iterator[TrialSpec]:
        """Trials, one after the other."""
        for values in product(*(values for _, values in self.axes)):
            sheet = self.base.model_dump(mode="json")
            for (name, _), value in zip(self.axes, values, strict=True):
                _set(sheet, name, value)
            spec = TrialSpec.model_validate(sheet)
            for trial in range(self.trials):
                yield spec.model_copy(update={"seed": seed_of(spec.seed, trial)})


def _table(value: Any) -> Any:
    return value.model_dump(mode="json") if isinstance(value, BaseModel) else value


def _set(sheet: dict[str, Any], name: str, value: Any) -> None:
    """Set a field by its dotted name."""
    *path, last = name.split(".")
    place: Any = sheet
    for part in path:
        place = place.get(part) if isinstance(place, dict) else None
    if not isinstance(place, dict) or last not in place:
        known = f"; known there: {listed(place)}" if isinstance(place, dict) else ""
        raise InputError(f"grid: {name!r} is no field of a trial{known}")
    place[last] = value


Plan = Annotated[VerificationTest | Grid, Field(discriminator="kind")]
"""What trials a campaign has."""
_PLAN: TypeAdapter[VerificationTest | Grid] = TypeAdapter(Plan)


def plan_from(stored: Any) -> VerificationTest | Grid:
    """Plan as a store keeps it."""
    try:
        return _PLAN.validate_python(stored)
    except InputError as error:
        raise InputError(f"plan in the store: {error}") from None
    except ValueError as error:
        first = str(error).partition("\n")[0]
        raise InputError(f"plan in the store: cannot be read: {first}") from None


def as_stored(plan: VerificationTest | Grid) -> dict[str, Any]:
    """Plan as a store keeps it."""
    return plan.model_dump(mode="json")
