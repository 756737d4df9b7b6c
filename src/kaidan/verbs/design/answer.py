"""The answer of `kaidan.design`: the design found, the map around it, what change costs."""

from typing import ClassVar, Literal

from kaidan.answer import Answer, Part

VerdictName = Literal["go", "rough", "unsure", "no-go", "outside-model"]


class FreeFigure(Part):
    """A figure that could be chosen."""

    name: str
    """As kaidan sweep has it."""
    unit: str
    """SI unit of the other fields."""
    low: float
    """Least value allowed, in that unit."""
    high: float
    """Largest value allowed, in that unit."""
    now: float | None
    """As it stands, in that unit; null where the sheet has none."""
    best: float
    """In the design found, in that unit."""


class OnStairs(Part):
    """What a design comes to on one of the stairs."""

    stairs: str
    """Name of the stairs."""
    verdict: VerdictName
    """As `kaidan assess` would say."""
    governs: str
    """What decides."""
    margin_deg: float | None
    """Smallest margin of slope in the worst case, at the accepted risk [deg]."""
    facing: str
    """Which end leads."""
    flippers: str
    """Postures of its plan, as the option is written."""


class DesignMap(Part):
    """Worst stairs of every place of two free figures, the others as in the design found."""

    x: str
    """Free figure along the rows."""
    y: str
    """Free figure from row to row."""
    x_values: tuple[float, ...]
    """Values of x, in its SI unit."""
    y_values: tuple[float, ...]
    """Values of y, in its SI unit."""
    verdicts: tuple[tuple[int, ...], ...]
    """Worst verdict of each place, row by row, by rank: 0 GO, 1 ROUGH, 2 UNSURE, 3 NO-GO, 4
    outside the model."""
    margins_deg: tuple[tuple[float | None, ...], ...]
    """Smallest margin on any of the stairs [deg]; null where one is not known."""
    share_go: float
    """Share of the places that are a GO on all stairs: the feasible region."""


class FrontPoint(Part):
    """The best design of a budget."""

    cost: float
    """Sum of the changes, each as a share of its range times its weight."""
    verdict: VerdictName
    """On the worst stairs."""
    margin_deg: float | None
    """On the worst stairs [deg]."""
    values: tuple[float, ...]
    """Of the free figures, in their order and SI units."""


class Design(Answer):
    """Which figures of a robot take the stairs best, or with the least change."""

    text_module: ClassVar[str] = "kaidan.text.design"

    robot: str
    """Name of the robot."""
    stairs: tuple[str, ...]
    """Stairs to be taken."""
    model: str
    """Which model judged."""
    goal: Literal["margin", "go"]
    """margin: the largest margin on the worst stairs; go: the cheapest GO on all."""
    free: tuple[FreeFigure, ...]
    """What could be chosen."""
    verdict: VerdictName
    """Of the design found, on the worst stairs."""
    governs: str
    """What decides there."""
    margin_deg: float | None
    """Margin there [deg]."""
    verdict_now: VerdictName | None
    """Of the robot as it stands, on its worst stairs; null where it lacks a free figure."""
    margin_now_deg: float | None
    """Margin there [deg]."""
    cost: float
    """Sum of the changes, each as a share of its range times its weight; 0: as it stands."""
    on_stairs: tuple[OnStairs, ...]
    """The design found on each of the stairs."""
    tried: int
    """Designs judged, those of the map included."""
    grid: int
    """Places of the map, none of which is better; 0 without one."""
    map: DesignMap | None
    """Map over the first two free figures; null where it was not drawn up."""
    front: tuple[FrontPoint, ...]
    """What more change gains, the cheapest first; empty where it was not requested."""
