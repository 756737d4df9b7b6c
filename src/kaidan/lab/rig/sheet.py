"""The sheet that is filled in at the rig: measurements at one nosing, and trials on the stairs."""

from pathlib import Path
from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field

from kaidan.errors import InputError, short
from kaidan.sheet import Sheet, model_validator, quantity

HELD, FELL, OTHER = "h", "f", "s"
"""Results of a trial: it held, it fell, or it did neither (slid, stalled)."""

_Extra = Annotated[float, Field(ge=-0.35, le=0.8)]


class Measurement(Sheet):
    """A force on one nosing, and how far the track went."""

    label: ClassVar[str] = "rig: measurement"

    force: float = quantity("N", 0.0, 1e5, "of the nosing on the track, or along it")
    travel: float = quantity("m", -0.05, 0.2, "of the dial gauge")


class Trials(Sheet):
    """Trials at one nosing spacing, slope and direction."""

    label: ClassVar[str] = "rig: trials"

    nosing_spacing: float = quantity("m", 0.02, 2.5, "nosing to nosing along the slope")
    angle: float = quantity("rad", 0.01, 1.5533, "of the line of the nosings, by the level")
    direction: Literal["up", "down"] = Field(
        default="up", description="up nose first, or down tail first: the nose points up both ways"
    )
    results: str = Field(
        default="", description="a letter a trial: h held, f fell, s slid or stalled; empty: none"
    )
    extra: tuple[_Extra, ...] = Field(
        default=(),
        max_length=1000,
        description="inclination beyond the line of the nosings just after one is lost, of trials "
        "that held",
        json_schema_extra={"unit": "rad"},
    )

    belt_set: bool = Field(
        default=False,
        description="whether the belt was set before each trial, a tip on the lowest nosing or "
        "turned by half a grouser spacing in turn",
    )

    @model_validator(mode="after")
    def _of_letters(self) -> Self:
        odd = set(self.results) - {HELD, FELL, OTHER}
        if odd:
            raise self.refuse(
                f"results = {self.results!r}: {sorted(odd)[0]!r} is none of h (held), f (fell), "
                "s (slid or stalled)"
            )
        if len(self.extra) > self.held:
            raise self.refuse(
                f"extra has {len(self.extra)} measurements of {self.held} trials that held"
            )
        return self

    @property
    def held(self) -> int:
        """Trials that held."""
        return self.results.count(HELD)

    @property
    def fell(self) -> int:
        """Trials that fell."""
        return self.results.count(FELL)


class Film(Sheet):
    """Where the tail left a nosing, on a film."""

    label: ClassVar[str] = "rig: film"

    nosing_spacing: float = quantity("m", 0.02, 2.5, "nosing to nosing along the slope")
    beyond: float = quantity(
        "m", -0.1, 0.5, "from the end of the flat to the nosing, along the track, as it is left"
    )
    below: float = quantity(
        "m", -0.05, 0.5, "how far the nosing then stands above the flat, prolonged"
    )


class RigSheet(Sheet):
    """What was measured of one robot."""

    label: ClassVar[str] = "rig"

    robot: str = Field(description="name in the catalogue, or TOML file")
    mass: float = quantity("kg", 0.1, 5000.0, "of the robot as it was tested")
    rear_radius: float | None = quantity("m", 0.0, 1.0, "of the tail, by tape", default=None)
    grouser_height: float | None = quantity("m", 0.0, 0.1, "above the belt, by tape", default=None)
    grouser_spacing: float | None = quantity(
        "m", 0.002, 0.5, "tip to tip along the belt, over ten of them", default=None
    )
    press: tuple[Measurement, ...] = Field(
        default=(), description="across the track: force of one nosing, and how far it presses in"
    )
    shear: tuple[Measurement, ...] = Field(
        default=(), description="along the track, loaded: pull over one nosing, and its travel"
    )
    trials: tuple[Trials, ...] = Field(default=(), description="on the stairs")
    film: tuple[Film, ...] = Field(default=(), description="of the tail, as it leaves a nosing")

    @classmethod
    def of_file(cls, path: str | Path) -> Self:
        """Sheet of a TOML file.

        Raises
        ------
        InputError
            It cannot be read, or a field is none; the text names it.
        """
        try:
            text = Path(path).read_text(encoding="utf-8")
        except (OSError, ValueError) as error:
            raise InputError(f"{short(Path(path))}: cannot be read: {error}") from None
        return cls.from_text(text, origin=short(Path(path)))
