"""The answer of a stock study: of each robot the share of flights by verdict and failure mode."""

from typing import Any, ClassVar

from kaidan.answer import Answer, Part


class RobotOnStock(Part):
    """One robot on all flights of a stock; each flight counts as often as there is one."""

    robot: str
    """Name of the robot."""
    go: float
    """Share of flights that are a GO."""
    rough: float
    """Share that is ROUGH."""
    unsure: float
    """Share that is UNSURE."""
    no_go: float
    """Share that is NO-GO."""
    outside_model: float
    """Share of which the model says nothing."""
    not_go: float
    """Share that the closed form alone excludes from a GO, where only GO was requested."""
    governs: dict[str, float]
    """Of the flights that are no GO: share of all flights by what decides, the largest first."""
    steepest_go_deg: float | None
    """Steepest flight that is a GO [deg]; null: none is."""
    margin_deg: tuple[float, float, float] | None
    """Margin that 5, 50 and 95 % of the flights with a known one stay below [deg]."""


class StockStudy(Answer):
    """Which share of a stock of stairs each robot of a fleet takes."""

    text_module: ClassVar[str] = "kaidan.text.stock"

    model: str
    """Which model judged."""
    stock: str
    """Name of the stock."""
    flights: float
    """Number of flights."""
    different: int
    """Flights that differ."""
    judged: int
    """Pairs of a robot and a flight that were judged: long flights alike but for their length are
    one."""
    rise_m: tuple[float, float]
    """Lowest and highest rise [m]."""
    going_m: tuple[float, float]
    """Shortest and longest going [m]."""
    angle_deg: tuple[float, float]
    """Gentlest and steepest flight [deg]."""
    go_only: bool
    """Whether only the GOs were requested, the rest left undivided where the closed form excludes a
    GO."""
    robots: tuple[RobotOnStock, ...]
    """The robot that takes the largest share first."""
    some_robot: float
    """Share of flights that at least one robot takes."""

    def columns(self) -> dict[str, list[Any]]:
        """Columns of a table with one line a robot."""
        names = ("robot", "go", "rough", "unsure", "no_go", "outside_model", "not_go",
                 "steepest_go_deg")  # fmt: skip
        found = {name: [getattr(each, name) for each in self.robots] for name in names}
        modes = dict.fromkeys(key for each in self.robots for key in each.governs)
        return found | {
            f"by_{mode}": [each.governs.get(mode, 0.0) for each in self.robots] for mode in modes
        }
