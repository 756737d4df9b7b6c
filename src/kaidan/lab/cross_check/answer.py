"""What `kaidan.lab.agree` finds: comparisons, differences, bands."""

from typing import ClassVar, Literal

from kaidan.answer import Answer, Part
from kaidan.lab.cross_check.bands import Band
from kaidan.lab.cross_check.common_question import Begin
from kaidan.question import Question

JudgeName = Literal["closed_form", "static_criterion", "contact", "physics"]
ComparisonName = Literal["steepest_flight", "stairs", "extra", "friction"]
"""Who is compared; `kaidan.lab.cross_check.text.MODELS` says it for people."""
Value = float | str | None


class Compared(Part):
    """Something that is compared, and what each model finds."""

    name: ComparisonName
    """What is compared."""
    text: str
    """The same for people."""
    unit: Literal["deg", "1", ""]
    """Unit of the answers; empty where they are words."""
    answers: dict[JudgeName, Value]
    """Number or word of each; null: it has none."""


class Difference(Part):
    """What one finds less what another finds."""

    comparison: ComparisonName
    """Of what."""
    of: JudgeName
    """Whose answer."""
    less: JudgeName
    """Less whose answer."""
    value_deg: float | None
    """Difference [deg]; null: not comparable, or two words that can only be the same or not."""
    band: Band | None
    """Within which it is expected; null: none is known."""
    within: bool | None
    """Whether it lies there; null: not comparable."""
    cause: str
    """Likely cause where it does not, or why it cannot be compared; else empty."""


class Agreement(Answer):
    """How far apart closed form, contact model and physics are on one robot and one flight."""

    text_module: ClassVar[str] = "kaidan.lab.cross_check.text"

    question: Question
    """Robot, stairs and how it is driven."""
    slope_deg: float
    """Slope of the stairs [deg]."""
    begin: Begin
    """Where the trial on the stairs begins."""
    speed_m_s: float
    """Of the trials [m/s]."""
    friction: float
    """Of the trials, but where it is what is looked for [1]."""
    resolution_deg: float
    """Of what is found by bisection over trials [deg]."""
    agrees: bool
    """Whether every difference that can be compared lies within its band."""
    comparisons: tuple[Compared, ...]
    """What is compared."""
    differences: tuple[Difference, ...]
    """How far apart they are, and may be."""
    trials: int
    """Trials run."""
    versions: dict[str, str]
    """Of kaidan and MuJoCo."""

    @property
    def exit_code(self) -> int:
        """0 if all agree, 1 if not."""
        return 0 if self.agrees else 1
