"""Plans: what trials a campaign has, in a few lines, so that a store can be resumed by its name."""

from collections.abc import Iterator
from itertools import product
from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np
from pydantic import Field, TypeAdapter

from kaidan.errors import InputError
from kaidan.physics import SmoothBelt, TrackModel, TrialSpec
from kaidan.robot import Payload, Posture, Robot
from kaidan.sheet import Sheet, model_validator, quantity
from kaidan.stairs import Stairs


def seed_of(*parts: int) -> int:
    """Seed of one trial from that of the whole and what tells the trial from others."""
    return int(np.random.SeedSequence(parts).generate_state(1, np.uint64)[0] >> np.uint64(1))


class Condition(Sheet):
    """Stairs and direction, at which a robot makes several trials."""

    label: ClassVar[str] = "condition"

    nosing_spacing: float = quantity("m", 0.02, 2.5, "nosing to nosing along the slope")
    angle: float = quantity("rad", 0.01, 1.5533, "of the line of the nosings")
    direction: Literal["up", "down"] = "up"


class VerificationTest(Sheet):
    """The paper's verification test: spacings, inclinations, some trials a condition.

    The nose points up the stairs, whichever way it goes: it comes down tail first, so that the
    same centroid is lost over the same end.

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, "Verification test", Figs. 12-13.
    """

    label: ClassVar[str] = "verification test"

    kind: Literal["verification-test"] = "verification-test"
    robot: Robot
    posture: Posture = Posture()
    payload: tuple[Payload, ...] = ()
    conditions: tuple[Condition, ...] = Field(min_length=1, max_length=100_000)
    trials: int = Field(
        default=5,
        ge=1,
        le=1_000_000,
        description="a condition",
        json_schema_extra={"unit": "trials"},
    )
    track: TrackModel = SmoothBelt()
    friction: float = quantity("1", 0.0, 5.0, "track on nosings", default=3.0)
    speed: float = quantity("m/s", 0.001, 5.0, "of the belt", default=0.1)
    ground: Literal["steps", "noses"] = "steps"
    seed: int = Field(default=0, ge=0, le=2**63 - 1, description="of start offsets and phases")

    def __len__(self) -> int:
        return len(self.conditions) * self.trials

    def specs(self) -> Iterator[TrialSpec]:
        """Trials, one after the other; all of one condition together."""
        for condition in self.conditions:
            first = self.spec(condition, 0)  # validated once; the others differ by their seeds
            for trial in range(self.trials):
                yield first.model_copy(update={"seed": self._seed(condition, trial)})

    def spec(self, condition: Condition, trial: int) -> TrialSpec:
        """One trial; its seed depends on the condition, not on which others there are."""
        p, down = condition.nosing_spacing, condition.direction == "down"
        within = self.robot.stance(self.posture, self.payload).flat_length / p
        return TrialSpec(
            robot=self.robot,
            stairs=Stairs.inclined(
                angle=condition.angle, nosing_spacing=p, steps=max(12, 8 + int(within))
            ),
            posture=self.posture,
            payload=self.payload,
            friction=self.friction,
            speed=self.speed,
            direction=condition.direction,
            facing="tail-first" if down else "nose-first",
            track=self.track,
            ground=self.ground,
            seed=self._seed(condition, trial),
        )

    def _seed(self, condition: Condition, trial: int) -> int:
        p, angle = round(1e6 * condition.nosing_spacing), round(1e6 * condition.angle)
        return seed_of(self.seed, p, angle, int(condition.direction == "down"), trial)


class Grid(Sheet):
    """Every combination of values of some fields of a trial, several trials each.

    Examples
    --------
    >>> from kaidan.robot import Robot
    >>> base = TrialSpec(
    ...     robot=Robot.named("kenaf"), stairs=Stairs.inclined(angle=0.9, nosing_spacing=0.15)
    ... )
    >>> axes = (("friction", (0.8, 2.0)), ("robot.com_height", (0.07, 0.1)))
    >>> grid = Grid(base=base, axes=axes)
    >>> len(grid), [(each.friction, each.robot.com_height) for each in grid.specs()][1]
    (4, (0.8, 0.1))
    """

    label: ClassVar[str] = "grid"

    kind: Literal["grid"] = "grid"
    base: TrialSpec
    axes: tuple[tuple[str, tuple[Any, ...]], ...] = Field(
        description="dotted names of fields, each with its values"
    )
    trials: int = Field(
        default=1,
        ge=1,
        le=1_000_000,
        description="a combination, from start offsets of their own",
        json_schema_extra={"unit": "trials"},
    )

    @model_validator(mode="after")
    def _known_fields(self) -> Self:
        sheet = self.base.model_dump()
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
            sheet = self.base.model_dump()
            for (name, _), value in zip(self.axes, values, strict=True):
                _set(sheet, name, value)
            spec = TrialSpec.model_validate(sheet)
            for trial in range(self.trials):
                yield spec.model_copy(update={"seed": seed_of(spec.seed, trial)})


def _set(sheet: dict[str, Any], name: str, value: Any) -> None:
    """Set a field by its dotted name."""
    *way, last = name.split(".")
    place: Any = sheet
    for part in way:
        place = place.get(part) if isinstance(place, dict) else None
    if not isinstance(place, dict) or last not in place:
        known = f"; known there: {', '.join(place)}" if isinstance(place, dict) else ""
        raise InputError(f"grid: {name!r} is no field of a trial{known}")
    place[last] = value


Plan = Annotated[VerificationTest | Grid, Field(discriminator="kind")]
"""What trials a campaign has."""
_PLAN: TypeAdapter[VerificationTest | Grid] = TypeAdapter(Plan)


def plan_from(stored: Any) -> VerificationTest | Grid:
    """Plan as a store keeps it.

    Raises
    ------
    InputError
        It is none, or of another version.
    """
    try:
        return _PLAN.validate_python(stored)
    except InputError:
        raise
    except ValueError as error:
        first = str(error).partition("\n")[0]
        raise InputError(f"plan in the store: cannot be read: {first}") from None


def as_stored(plan: VerificationTest | Grid) -> dict[str, Any]:
    """Plan as a store keeps it."""
    return plan.model_dump(mode="json")
