"""Both slope limits over the nosing spacing, theta_s_sup(p) and theta_s_inf(p), and allowances."""

import math
from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from kaidan import catalog
from kaidan.allowance import AllowanceShown
from kaidan.answer import Answer, Part
from kaidan.arguments import known_arguments, several, whole
from kaidan.errors import InputError, shown
from kaidan.mechanics.margin import theta_s_inf, theta_s_sup, theta_s_sup_corrected
from kaidan.mechanics.plane import contact_count, two_contacts_remain
from kaidan.models.closed_form import judge
from kaidan.modes import Direction, Facing
from kaidan.question import Question
from kaidan.robot import Robot
from kaidan.spelling import sheet_of
from kaidan.terrain.stairs import Stairs
from kaidan.units import range_of

Array = NDArray[np.float64]
Column = tuple[float | None, ...]

STEP = 0.005
"""Between the spacings where nobody states their number [m]."""
SPACINGS = (0.01, 5.0)
"""Nosing spacings of a curve [m]."""
MOST_POINTS = 100_000
"""Most spacings of a curve."""
FINE = 600
"""Spacings of a curve that is drawn."""


class StairsShown(Part):
    """A staircase beside the limits."""

    name: str
    angle_deg: float
    """Slope [deg]."""
    nosing_spacing_m: float
    """Nosing to nosing [m]."""
    inside_model: bool
    """Whether the closed form says anything about the robot on it."""


class MarginCurve(Answer):
    """Slope limits of a robot over the nosing spacing, by the closed form; null outside of it."""

    text_module = "kaidan.text.margin"

    model: Literal["closed-form"] = "closed-form"
    robot: str
    direction: Direction
    facing: Facing
    downhill_end: Literal["tail", "nose"]
    """End of the robot that points down the stairs."""
    acceleration: float
    """Up the stairs [m/s^2]."""
    flat_length_m: float
    """L, flippers in line included [m]."""
    com_from_uphill_end_m: float
    """C_L, from the UPHILL end of the flat [m]."""
    com_height_m: float
    """C_N [m]."""
    largest_nosing_spacing_m: float
    """L/2, where the closed form ends [m]."""
    outside: str | None
    """Why the closed form does not apply at any spacing; null if it does."""
    allowances: dict[Literal["theta_d", "theta_M"], AllowanceShown]
    """Allowances of Eq. (24)."""
    nosing_spacing_m: tuple[float, ...]
    """Spacings at which the columns below hold [m]."""
    contacts_n: tuple[int, ...]
    """n = floor(L / p)."""
    margin_angle_deg: Column
    """theta_s_sup: on steeper stairs the robot tips downhill [deg]."""
    margin_angle_corrected_low_deg: Column
    """The same less both allowances at their high end [deg]."""
    margin_angle_corrected_high_deg: Column
    """The same less both allowances at their low end [deg]."""
    lower_angle_deg: Column
    """theta_s_inf: on gentler stairs the robot tips uphill [deg]; null where none is too gentle."""
    lower_angle_corrected_high_deg: Column
    """The same with theta_d at its high end on top [deg]."""
    lower_angle_corrected_low_deg: Column
    """The same with theta_d at its low end on top [deg]."""
    stairs: tuple[StairsShown, ...]
    """Stairs to be shown beside the limits."""

    @property
    def corrected(self) -> bool:
        """Whether there is any allowance."""
        return any(each.high_deg > 0 for each in self.allowances.values())

    def columns(self) -> dict[str, tuple[Any, ...]]:
        """Columns of a table, one line a spacing."""
        return {name: getattr(self, name) for name in _COLUMNS}


_COLUMNS = (
    "nosing_spacing_m",
    "contacts_n",
    "margin_angle_deg",
    "margin_angle_corrected_low_deg",
    "margin_angle_corrected_high_deg",
    "lower_angle_deg",
    "lower_angle_corrected_high_deg",
    "lower_angle_corrected_low_deg",
)


@known_arguments
def margin(
    robot: Any,
    *,
    start: float | str | None = None,
    to: float | str | None = None,
    points: int | None = None,
    stairs: Sequence[Any] = (),
    **manner: Any,
) -> MarginCurve:
    """How steep stairs may be, and how gentle, for every nosing spacing.

    Parameters
    ----------
    robot : Robot, str or path
        Robot, or its name in the catalogue, or a TOML file.
    start, to : float or str, optional
        Smallest and largest nosing spacing [m], or as text such as "150mm".
    points : int, optional
        Number of spacings; every 5 mm without it.
    stairs : sequence of Stairs, str or path
        Stairs to be shown beside the limits.
    **manner
        acceleration, direction, facing, flippers, payload, theta_d, theta_M, override, as
        `kaidan.Question.of` has them.

    Raises
    ------
    InputError
        An input without physical meaning; the text names it.

    Examples
    --------
    >>> curve = margin("kenaf", start=0.15, to="200mm", points=2)
    >>> [round(angle, 1) for angle in curve.margin_angle_deg]
    [60.2, 46.2]

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eqs. (19)-(24), Fig. 11.
    """
    question = question_of(robot, **manner)
    beside = [sheet_of(each, Stairs) for each in several("stairs", stairs)]
    return margin_curve(question, spacings(question, start, to, points, beside), beside)


def question_of(robot: Any, **manner: Any) -> Question:
    """Question of a robot on a long regular flight whose spacing is well inside the model.

    Whether the closed form applies to the robot, whatever the spacing, is judged on that flight.
    """
    sheet = sheet_of(robot, Robot)
    spacing = max(0.03, sheet.track.flat_length / 4)
    flight = Stairs.inclined(angle=math.pi / 4, nosing_spacing=spacing, steps=1000)
    return Question.in_one_posture(sheet, flight, **manner)


def spacings(
    question: Question,
    start: float | str | None = None,
    to: float | str | None = None,
    points: int | None = None,
    stairs: Sequence[Stairs] = (),
    *,
    ends: tuple[str, str] = ("start", "to"),
) -> Array:
    """Nosing spacings of a curve; without ends from small ones to past L/2 and all stairs [m].

    `ends` is what errors call the first and the last spacing.
    """
    half = question.stance.flat_length / 2
    farthest = max([1.1 * half, *(1.05 * each.nosing_spacing for each in stairs)])
    low = min(0.05, half / 2) if start is None else _spacing(start, ends[0])
    high = math.ceil(farthest / 0.01) * 0.01 if to is None else _spacing(to, ends[1])
    if not low < high:
        raise InputError(f"{ends[0]} {1e3 * low:g} mm is not less than {ends[1]} {1e3 * high:g} mm")
    count = (
        whole("points", points, 2, MOST_POINTS)
        if points is not None
        else max(2, math.floor((high - low) / STEP + 1e-6) + 1)
    )
    if points is None and start is None and to is None:
        return np.round(low + STEP * np.arange(count), 6)
    return np.linspace(low, high, count)


def _spacing(stated: float | str, option: str) -> float:
    value, other = range_of(stated, "length", option=option)
    if value != other or not SPACINGS[0] <= value <= SPACINGS[1]:
        raise InputError(f"{option} {shown(stated)} is not within 10mm to 5m")
    return value


def fine_curve(
    question: Question, curve: MarginCurve, stairs: Sequence[Stairs] = ()
) -> MarginCurve:
    """The same curve with so many spacings that it can be drawn as a line."""
    first, last = curve.nosing_spacing_m[0], curve.nosing_spacing_m[-1]
    half = curve.largest_nosing_spacing_m
    inside = [half] if first <= half <= last else []
    return margin_curve(question, np.union1d(np.linspace(first, last, FINE), inside), stairs)


def margin_curve(question: Question, p: Array, stairs: Sequence[Stairs] = ()) -> MarginCurve:
    """Slope limits of a question's robot at given nosing spacings.

    Parameters
    ----------
    question : Question
        Robot, posture, payload, acceleration, direction, facing and allowances, on a flight well
        inside the model (see ``question_of``).
    p : array
        Nosing spacings [m].
    stairs : sequence of Stairs
        Stairs to be shown beside them.

    Returns
    -------
    MarginCurve
        Null where p > L / 2, where the closed form says nothing.

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eqs. (19)-(24), Fig. 11.
    """
    stance = question.stance
    L, C_N = stance.flat_length, stance.com_height
    C_L = stance.com_from_front if question.nose_up else L - stance.com_from_front
    outside = judge(question).outside
    inside = np.where(two_contacts_remain(L=L, p=p) & (not outside), 1.0, np.nan)
    with np.errstate(invalid="ignore"):
        sup = inside * theta_s_sup(L=L, p=p, C_L=C_L, C_N=C_N, a=question.acceleration)
        inf = inside * theta_s_inf(p=p, C_L=C_L, C_N=C_N, a=question.acceleration)
    d, M = question.allowance_d, question.allowance_M
    high = question.theta_d_at(L=L, p=p, C_L=C_L, C_N=C_N)
    return MarginCurve(
        robot=question.robot.name,
        direction=question.direction,
        facing=question.facing,
        downhill_end="tail" if question.nose_up else "nose",
        acceleration=question.acceleration,
        flat_length_m=L,
        com_from_uphill_end_m=C_L,
        com_height_m=C_N,
        largest_nosing_spacing_m=L / 2,
        outside=outside or None,
        allowances={"theta_d": AllowanceShown.of(d), "theta_M": AllowanceShown.of(M)},
        nosing_spacing_m=p.tolist(),
        contacts_n=contact_count(L=L, p=p).astype(int).tolist(),
        margin_angle_deg=np.degrees(sup),
        margin_angle_corrected_low_deg=np.degrees(
            theta_s_sup_corrected(theta_s_sup=sup, theta_d=high, theta_M=M.high)
        ),
        margin_angle_corrected_high_deg=np.degrees(
            theta_s_sup_corrected(theta_s_sup=sup, theta_d=d.low, theta_M=M.low)
        ),
        lower_angle_deg=_positive(inf),
        lower_angle_corrected_high_deg=_positive(inf + high),
        lower_angle_corrected_low_deg=_positive(inf + d.low),
        stairs=[
            StairsShown(
                name=each.name,
                angle_deg=math.degrees(each.angle),
                nosing_spacing_m=each.nosing_spacing,
                inside_model=not outside and bool(two_contacts_remain(L=L, p=each.nosing_spacing)),
            )
            for each in stairs
        ],
    )


def _positive(angle: Array) -> Array:
    """Angle in degrees, NaN where it is not positive."""
    return np.degrees(np.where(angle > 0, angle, np.nan))


def catalogue_stairs() -> list[Stairs]:
    """All stairs of the catalogue, each at its steepest."""
    return [Stairs.named(name) for name in catalog.names("stairs")]
