"""The form with which a laboratory sends what its robot did on stairs, and kaidan reads it."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, ClassVar, Literal, Self

from pydantic import Field

from kaidan.errors import InputError, short
from kaidan.sheet import Sheet, model_validator, quantity

FORM = """\
# What a robot did on stairs. One [[pair]] for each condition; take out what does not apply.
# Fill in every condition that was tried, those that went well too, before asking kaidan.
# Look at it with: kaidan lab outcomes THIS_FILE.toml
who = "FILL IN"        # laboratory and person to ask
when = "FILL IN"       # of the trials, such as "May 2026"
published = "FILL IN"  # address of a paper or film, or "not published"
centroid = "FILL IN"   # how C_L and C_N were measured, and to how many millimetres

[[pair]]
robot = "FILL IN"  # of the catalogue (kaidan robots), or a sheet beside this file (kaidan new)
rise = "FILL IN"   # of the steps, such as "178mm"; or angle and nosing_spacing instead of
going = "FILL IN"  # rise and going
steps = 12         # risers
friction = "FILL IN"    # of tracks on nosings, such as "0.6..0.8"; say in the note how measured
direction = "up"        # or down
facing = "nose-first"   # or tail-first
flippers = "stowed"     # angles of front and rear, such as "20deg,-5deg"; leave out without any
outcome = "climbs"      # climbs (or comes down), rocks (and goes on), falls, slides, sticks
trials = 5              # tried
failed = 0              # of them fell, slid or stuck
evidence = "test"       # of a real robot; or simulation
note = "FILL IN"        # tether, entering and landing or the flight alone, tread, end radius, h, s
"""

_MANNER = ("friction", "direction", "facing", "flippers")
_FLIGHT = ("angle", "nosing_spacing", "rise", "going", "steps")


class PairForm(Sheet):
    """One condition: robot, stairs, manner, and what happened."""

    label: ClassVar[str] = "outcome"

    robot: str = Field(description="name in the catalogue, or TOML file")
    angle: float | None = quantity("rad", 0.01, 1.5533, "of the line of the nosings", default=None)
    nosing_spacing: float | None = quantity(
        "m", 0.02, 2.5, "nosing to nosing along the slope", default=None
    )
    rise: float | None = quantity("m", 0.01, 0.6, "of a step", default=None)
    going: float | None = quantity("m", 0.01, 2.0, "of a step", default=None)
    steps: int = Field(default=12, ge=2, le=500, description="risers")
    friction: str = Field(description="of tracks on nosings, a number or a range")
    direction: Literal["up", "down"] = Field(default="up", description="which way")
    facing: Literal["nose-first", "tail-first"] = Field(
        default="nose-first", description="which end led"
    )
    flippers: str | None = Field(default=None, description="their angles; none: no flippers")
    outcome: Literal["climbs", "rocks", "falls", "slides", "sticks"] = Field(
        description="what happened; in any of the trials, if they differ: the worst"
    )
    trials: int = Field(ge=1, le=100000, description="how often it was tried")
    failed: int = Field(ge=0, description="how often it fell, slid or stuck")
    evidence: Literal["test", "simulation"] = Field(description="a real robot, or a simulation")
    note: str = Field(description="what else somebody must know")

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        by_angle = self.angle is not None and self.nosing_spacing is not None
        if by_angle == (self.rise is not None and self.going is not None):
            raise self.refuse("takes angle and nosing_spacing, or rise and going")
        if self.failed > self.trials:
            raise self.refuse(f"failed = {self.failed} is more than trials = {self.trials}")
        if (self.failed > 0) != (self.outcome in ("falls", "slides", "sticks")):
            raise self.refuse(f"outcome = {self.outcome!r} does not go with failed = {self.failed}")
        return self

    def entry(self, source: str, folder: Path) -> dict[str, Any]:
        """The same as an entry of the catalogue's list."""
        robot = self.robot
        if robot.lower().endswith(".toml"):
            robot = str(folder / robot)
        manner = {name: getattr(self, name) for name in _MANNER}
        flight = {name: getattr(self, name) for name in _FLIGHT}
        return {
            "robot": robot,
            "stairs": {name: value for name, value in flight.items() if value is not None},
            "manner": {name: value for name, value in manner.items() if value is not None},
            "outcome": self.outcome,
            "evidence": self.evidence,
            "status": "printed",
            "note": f"{self.failed} of {self.trials} failed. {self.note}",
            "source": source,
        }


class OutcomesForm(Sheet):
    """What one laboratory tried."""

    label: ClassVar[str] = "outcomes"

    who: str = Field(description="laboratory and person to ask")
    when: str = Field(description="when it was tried")
    published: str = Field(description="where, or that it is not")
    centroid: str = Field(description="how it was measured, and how well")
    pair: tuple[PairForm, ...] = Field(min_length=1, description="one for each condition")
    place: str = Field(default="", description="the file; not to be filled in")

    @classmethod
    def of_file(cls, path: Path) -> Self:
        """Form of a TOML file.

        Raises
        ------
        InputError
            It cannot be read, or a field is none or not filled in; the text names it.
        """
        try:
            text = path.read_text(encoding="utf-8")
        except (OSError, ValueError) as error:
            raise InputError(f"{short(path)}: cannot be read: {error}") from None
        form = cls.from_text(text, origin=short(path))
        return form.model_copy(update={"place": str(path)})

    def entries(self) -> Iterator[dict[str, Any]]:
        """Its pairs as entries of the catalogue's list."""
        for pair in self.pair:
            yield pair.entry(self.who, Path(self.place).parent)
