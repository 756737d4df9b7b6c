"""The staircase's data sheet: rises, goings, first and last riser, nosings, landings.

::

                                 ______ upper landing
                        ______ _|  last_rise
               going   |
             |<------>_|  rise
         ____|       |
             |_______|   . . .  nosing spacing = hypot(rise, going), nosing to nosing
    _________| first_rise
    lower landing

``n`` risers have ``n`` nosings, the last one being the edge of the upper landing, and ``n - 1``
goings between them.
"""

import math
from collections.abc import Mapping, Sequence
from itertools import accumulate, pairwise
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field

from kaidan import catalog
from kaidan.arguments import known_arguments
from kaidan.errors import InputError
from kaidan.sheet import Sheet, model_validator, quantity
from kaidan.terrain.gap import DEEPEST_TREAD, Gap
from kaidan.terrain.room import Opening
from kaidan.terrain.stairs_uncertainty import StairsUncertainty
from kaidan.units import value_of

NOSING_RADII = (0.002, 0.025)
"""Smallest and largest radius of nosings where the sheet states none [m]: sharp steel to worn
concrete."""

Length = tuple[float, ...]

_RISE = (0.02, 0.6)
_ODD_RISE = (0.005, 0.6)
_GOING = (0.02, 2.5)
_MOST_RISERS = 10_000
_MOST_OPENINGS = 1_000
_MOST_GAPS = 2 * _MOST_RISERS
_STEEPEST = 1.5533
"""Past 89 degrees no goings are left [rad]."""

UNSTATED_LANDING = 2.0
"""Length of a landing where the sheet states none [m]."""
BESIDE = 0.1
"""By how much a landing may be measured narrower than what lies side by side on it [m]."""

MOST_TWISTED = 400
"""Most risers of a flight whose nosings have slopes across or skews."""

Turn = Literal["none", "quarter", "half", "unknown"]
"""Turn on a landing, by a quarter or a half; unknown: by another angle, or on a landing that nobody
measured."""

_CrossSlope = Annotated[float, Field(ge=-0.35, le=0.35)]
_Skew = Annotated[float, Field(ge=-0.8, le=0.8)]
_Rise = Annotated[float, Field(ge=_ODD_RISE[0], le=_ODD_RISE[1])]
_Going = Annotated[float, Field(ge=_GOING[0], le=_GOING[1])]


class Stairs(Sheet):
    """A straight flight of stairs, uniform (rise, going) or measured (rises, goings)."""

    label: ClassVar[str] = "stairs"
    requested: ClassVar[frozenset[str]] = frozenset({"rise", "going"})

    name: str = Field(default="stairs", description="short name, used on the command line")
    title: str = Field(default="", description="full name")
    rise: float | None = quantity(
        "m", *_RISE, "vertical distance between adjacent nosings of a uniform flight", default=None
    )
    going: float | None = quantity(
        "m",
        *_GOING,
        "horizontal distance between adjacent nosings of a uniform flight",
        default=None,
    )
    steps: int = Field(
        default=12,
        ge=2,
        le=_MOST_RISERS,
        description="number of risers of a uniform flight",
        json_schema_extra={"unit": "risers"},
    )
    first_rise: float | None = quantity(
        "m", *_ODD_RISE, "first riser of a uniform flight, where it differs", default=None
    )
    last_rise: float | None = quantity(
        "m", *_ODD_RISE, "last riser of a uniform flight, where it differs", default=None
    )
    first_rise_drawn: float | None = quantity(
        "m",
        *_ODD_RISE,
        "first riser as drawn, where figures of the same file make it the one stated here",
        default=None,
    )
    last_rise_drawn: float | None = quantity(
        "m", *_ODD_RISE, "last riser as drawn, likewise", default=None
    )
    rises: tuple[_Rise, ...] | None = Field(
        default=None,
        min_length=2,
        max_length=_MOST_RISERS,
        description="measured risers from bottom to top, instead of rise",
        json_schema_extra={"unit": "m"},
    )
    goings: tuple[_Going, ...] | None = Field(
        default=None,
        min_length=1,
        max_length=_MOST_RISERS,
        description="measured goings from bottom to top, one fewer than the risers",
        json_schema_extra={"unit": "m"},
    )
    cross_slopes: tuple[_CrossSlope, ...] = Field(
        default=(),
        max_length=MOST_TWISTED,
        description="slope of the nosings across the flight, left side up positive: one for each "
        "riser from bottom to top, or one for all",
        json_schema_extra={"unit": "rad"},
    )
    skews: tuple[_Skew, ...] = Field(
        default=(),
        max_length=MOST_TWISTED,
        description="angle of the nosings in plan off square, left end farther ahead positive: one "
        "for each riser from bottom to top, or one for all",
        json_schema_extra={"unit": "rad"},
    )
    nosing_overhang: float = quantity(
        "m", 0.0, 0.1, "overhang of the nosing over the tread below", default=0.0
    )
    nosing_radius_low: float | None = quantity(
        "m", 0.0, 0.05, "smallest radius of the nosings; none: 2 mm", default=None
    )
    nosing_radius_high: float | None = quantity(
        "m", 0.0, 0.05, "largest radius of the nosings; none: 25 mm", default=None
    )
    open_risers: bool = Field(default=False, description="whether there is no riser board")
    width: float | None = quantity(
        "m", 0.1, 100.0, "clear width between walls or railings", default=None
    )
    headroom: float | None = quantity(
        "m", 0.2, 100.0, "least plumb height above the line of the nosings", default=None
    )
    clear: tuple[Opening, ...] = Field(
        default=(),
        max_length=_MOST_OPENINGS,
        description="clear widths up to heights above the line of the nosings, where handrails or "
        "a sloping ceiling make them differ: judged instead of width and headroom",
    )
    gaps: tuple[Gap, ...] = Field(
        default=(),
        max_length=_MOST_GAPS,
        description="gaps in the flight or its landings, where nothing carries",
    )
    lower_landing: float | None = quantity(
        "m", 0.0, 100.0, "length of the lower landing, along the flight; none: 2 m", default=None
    )
    upper_landing: float | None = quantity(
        "m", 0.0, 100.0, "length of the upper landing, along the flight; none: 2 m", default=None
    )
    lower_leaf: float = quantity(
        "m", 0.0, 5.0, "leaf of a door opposite that opens onto the lower landing", default=0.0
    )
    upper_leaf: float = quantity(
        "m", 0.0, 5.0, "leaf of a door opposite that opens onto the upper landing", default=0.0
    )
    lower_landing_width: float | None = quantity(
        "m", 0.0, 100.0, "clear width of the lower landing, across the flight", default=None
    )
    upper_landing_width: float | None = quantity(
        "m", 0.0, 100.0, "clear width of the upper landing, across the flight", default=None
    )
    lower_turn: Turn = Field(
        default="none",
        description="turn on the lower landing, 90 or 180 degrees: it takes width, "
        "lower_landing and lower_landing_width; unknown: another angle, or not measured",
    )
    upper_turn: Turn = Field(
        default="none",
        description="turn on the upper landing, 90 or 180 degrees: it takes width, "
        "upper_landing and upper_landing_width; unknown: another angle, or not measured",
    )
    lower_passage: float | None = quantity(
        "m",
        0.1,
        100.0,
        "clear width of the level passage by which the way comes to that turn; none: by stairs",
        default=None,
    )
    upper_passage: float | None = quantity(
        "m",
        0.1,
        100.0,
        "clear width of the level passage by which the way goes on from that turn; none: by stairs",
        default=None,
    )
    foot_seen: bool = Field(
        default=True, description="whether the level before the first riser is known, so its height"
    )
    head_seen: bool = Field(
        default=True, description="whether a landing behind the last nosing is known to follow"
    )
    direction: Literal["up", "down"] = Field(default="up", description="which way the robot goes")
    uncertainty: StairsUncertainty = Field(
        default=StairsUncertainty(), description="standard uncertainties"
    )
    sources: dict[str, str] = Field(
        default={}, description="where each figure comes from, with its status letter"
    )
    notes: str = Field(default="", description="what the user should know")

    @model_validator(mode="before")
    @classmethod
    def _counted(cls, data: Any) -> Any:
        """A measured flight has as many risers as its list."""
        rises = data.get("rises") if isinstance(data, Mapping) else None
        counted = isinstance(rises, list | tuple) and 2 <= len(rises) <= _MOST_RISERS
        return {"steps": len(rises), **data} if rises is not None and counted else data

    @model_validator(mode="after")
    def _uniform_or_measured(self) -> Self:
        uniform = (self.rise, self.going)
        measured = (self.rises, self.goings)
        if None in uniform and None in measured:
            raise self.refuse("give rise and going, or the measured lists rises and goings")
        if uniform != (None, None) and measured != (None, None):
            raise self.refuse("give either rise and going or rises and goings, not both")
        if self.rises is not None and self.goings is not None:
            if len(self.goings) != len(self.rises) - 1:
                raise self.refuse(
                    f"{len(self.rises)} rises need {len(self.rises) - 1} goings, "
                    f"not {len(self.goings)}"
                )
            if self.first_rise is not None or self.last_rise is not None:
                raise self.refuse("first_rise and last_rise stand in the list rises already")
            if self.steps != len(self.rises):
                raise self.refuse(
                    f"steps = {self.steps} contradicts the {len(self.rises)} rises; leave it out"
                )
        for name in ("cross_slopes", "skews"):
            if len(getattr(self, name)) not in (0, 1, self.steps):
                raise self.refuse(
                    f"{name} has {len(getattr(self, name))} values; allowed are one for all "
                    f"nosings or one for each of the {self.steps}"
                )
        low, high = self.nosing_radii
        if low > high:
            raise self.refuse(
                f"nosing_radius_low = {low:g} is more than nosing_radius_high = {high:g}"
            )
        for one, other in pairwise(self.clear):
            if not (other.height > one.height and other.width < one.width):
                raise self.refuse("clear has heights that ascend and widths that descend")
        for end in ("lower", "upper"):
            self._refuse_landing(end)
        if self.nosing_overhang >= min(self.step_goings):
            raise self.refuse(
                f"nosing_overhang = {self.nosing_overhang:g} m is not less than the going "
                f"{min(self.step_goings):g} m"
            )
        return self

    def _refuse_landing(self, end: str) -> None:
        """Refuse a turn on a landing that does not hold what lies side by side on it."""
        turn, passage, depth, across = (
            getattr(self, f"{end}_{of}") for of in ("turn", "passage", "landing", "landing_width")
        )
        if turn in ("none", "unknown"):
            if passage is not None:
                raise self.refuse(f"{end}_passage goes with {end}_turn = quarter or half")
            return
        needed = {"width": self.width, f"{end}_landing": depth, f"{end}_landing_width": across}
        missing = [name for name, value in needed.items() if value is None]
        if missing:
            raise self.refuse(f"{end}_turn = {turn} needs {' and '.join(missing)} too")
        assert self.width is not None
        beyond = self.width if passage is None else passage
        beside = self.width + (beyond if turn == "half" else 0.0)
        if across < beside - BESIDE:
            what = "the flight and what lies beside it are" if turn == "half" else "the flight is"
            raise self.refuse(f"{end}_landing_width = {across:g} m, but {what} {beside:g} m wide")
        if turn == "quarter" and passage is not None and depth < passage - BESIDE:
            raise self.refuse(
                f"{end}_landing = {depth:g} m, but {end}_passage is {passage:g} m wide"
            )

    @classmethod
    def named(cls, name: str) -> Self:
        """Stairs of the catalogue, or of a TOML file.

        Raises
        ------
        UnknownNameError, InputError
            Neither, or a bad file.
        """
        return catalog.load("stairs", name, cls.from_text)

    @classmethod
    @known_arguments
    def inclined(cls, *, angle: float | str, nosing_spacing: float | str, steps: int = 12) -> Self:
        """Uniform flight from its angle and its nosing spacing.

        Parameters
        ----------
        angle : float or str
            Of the line of the nosings: a number [rad], or a text such as "35deg".
        nosing_spacing : float or str
            From nosing to nosing along it: a number [m], or a text such as "290mm".
        steps : int
            Number of risers.

        Returns
        -------
        Stairs

        Raises
        ------
        InputError
            An angle not within 0 to 89 degrees, or a rise or going that no stairs have.
        """
        angle = value_of(angle, "angle", option="angle")
        nosing_spacing = value_of(nosing_spacing, "length", option="nosing_spacing")
        if not 0.0 < angle < _STEEPEST:
            degrees = math.degrees(angle)
            raise InputError(f"angle = {angle:g} rad ({degrees:.4g} deg) is not within 0 to 89 deg")
        name = f"{math.degrees(angle):g} deg at {nosing_spacing * 1e3:g} mm"
        try:
            return cls(
                name=name,
                rise=nosing_spacing * math.sin(angle),
                going=nosing_spacing * math.cos(angle),
                steps=steps,
            )
        except InputError as error:
            raise InputError(f"{name}: {error}") from None

    @property
    def step_rises(self) -> Length:
        """All risers from bottom to top [m]."""
        if self.rises is not None:
            return self.rises
        assert self.rise is not None
        first = self.rise if self.first_rise is None else self.first_rise
        last = self.rise if self.last_rise is None else self.last_rise
        return (first, *(self.rise,) * (self.steps - 2), last)

    @property
    def step_goings(self) -> Length:
        """All goings from bottom to top [m]."""
        if self.goings is not None:
            return self.goings
        assert self.going is not None
        return (self.going,) * (self.steps - 1)

    @property
    def nosing_places(self) -> Length:
        """Nosings along the flight, from the first one [m]."""
        return tuple(accumulate(self.step_goings, initial=0.0))

    @property
    def landings(self) -> tuple[float, float]:
        """Lengths of the lower and the upper landing, as stated or by default [m]."""
        lower, upper = self.lower_landing, self.upper_landing
        return (
            UNSTATED_LANDING if lower is None else lower,
            UNSTATED_LANDING if upper is None else upper,
        )

    def up_to_gaps(self, gaps: Sequence[Gap]) -> Self:
        """Flight with some gaps alone, whose landings end at those that lie on them.

        What begins less than a tread is deep from the flight must be crossed; before another one
        the robot may come to stand.
        """
        last = self.nosing_places[-1] if gaps else 0.0
        before = [-gap.end for gap in gaps if gap.end is not None]
        behind = [gap.start - last for gap in gaps if gap.start is not None]
        lower, upper = (
            min((each for each in lengths if each >= DEEPEST_TREAD), default=math.inf)
            for lengths in (before, behind)
        )
        crossed = tuple(
            gap for gap in gaps
            if not (gap.end is not None and gap.end <= -lower)
            and not (gap.start is not None and gap.start >= last + upper)
        )  # fmt: skip
        ends = zip(("lower_landing", "upper_landing"), (lower, upper), self.landings, strict=True)
        shorter = {name: length for name, length, now in ends if length < now}
        if crossed == self.gaps and not shorter:
            return self
        return self.model_copy(update={"gaps": crossed, **shorter})

    @property
    def regular_steps(self) -> tuple[tuple[float, float], ...]:
        """Pairs (rise, going) [m] from nosing to nosing while the robot traverses.

        The first riser belongs to entering and the last one to landing, so neither is among them.
        The last one is in a measured flight of three risers or fewer, and in one whose landing was
        not seen: it leads to a step like the others.
        """
        if self.rise is not None and self.going is not None:
            return ((self.rise, self.going),) * max(1, self.steps - 2)
        pairs = tuple(zip(self.step_rises[1:], self.step_goings, strict=True))
        return pairs[:-1] if self.head_seen and len(pairs) > 2 else pairs

    @property
    def mean_step(self) -> tuple[float, float]:
        """Mean rise and going of the regular steps [m]."""
        rises, goings = zip(*self.regular_steps, strict=True)
        return sum(rises) / len(rises), sum(goings) / len(goings)

    @property
    def twisted(self) -> bool:
        """Whether its nosings differ from left to right."""
        return any(self.cross_slopes) or any(self.skews)

    @property
    def nosing_radii(self) -> tuple[float, float]:
        """Smallest and largest radius of the nosings, as stated or by default [m]."""
        low, high = self.nosing_radius_low, self.nosing_radius_high
        default_low, default_high = NOSING_RADII
        return (
            min(default_low, default_high if high is None else high) if low is None else low,
            max(default_high, default_low if low is None else low) if high is None else high,
        )

    @property
    def angle(self) -> float:
        """Slope of the line through the nosings of the regular steps [rad]."""
        return math.atan2(*map(sum, zip(*self.regular_steps, strict=True)))

    @property
    def nosing_spacing(self) -> float:
        """Mean distance from nosing to nosing along that line [m]."""
        return math.hypot(*map(sum, zip(*self.regular_steps, strict=True))) / len(
            self.regular_steps
        )

    @property
    def irregularity(self) -> float:
        """Largest minus smallest rise or going of the regular steps, the larger of the two [m]."""
        rises, goings = zip(*self.regular_steps, strict=True)
        return float(max(max(rises) - min(rises), max(goings) - min(goings)))
