"""The answer of `kaidan.report`: of each mission the answers of other verbs, and a field card."""

from typing import Literal

from kaidan.answer import Answer, Part
from kaidan.assessment.answer import Assessment
from kaidan.modes import PhaseName, Verdict
from kaidan.verbs.traverse_report import TraverseReport


class InputRow(Part):
    """An input of the question, with its source and its doubt."""

    of: Literal["robot", "stairs", "surface", "manner"]
    """What it belongs to."""
    field: str
    """Name in the sheet or in the question."""
    symbol: str
    """Symbol of the paper; empty without one."""
    value: str
    """With its unit, as people write it."""
    source: str
    """Where it comes from, with its status letter; "default" where it is that of the sheet;
    empty: not said."""
    doubt: str
    """Standard uncertainty or range; empty where none is stated."""


class PhasePosture(Part):
    """Posture of a phase."""

    phase: PhaseName
    """From which phase on."""
    flippers: str
    """As the option is written."""
    front_deg: float | None
    """Angle of the front flippers [deg]; null without a pair."""
    rear_deg: float | None
    """Angle of the rear flippers [deg]; null without a pair."""
    before_step: int | None
    """Nosing before which the robot stands while it changes to it, from the bottom; null at the
    start."""


class FieldCard(Part):
    """What the operator has in hand, read off the answers."""

    postures: tuple[PhasePosture, ...]
    """Postures in their order; one where none changes."""
    speed: float | None
    """Speed of the question [m/s]; null: none was stated."""
    judged_speed: float
    """Speed whose energy the robot is taken to have [m/s]."""
    lowest_deg: float | None
    """Least inclination of the traverse, uphill end up positive [deg]; null: it was not driven."""
    steepest_deg: float | None
    """Largest inclination of the traverse, rotations that are arrested included [deg]; null
    likewise."""
    stop_above_deg: float | None
    """Inclination that the judged traverse does not come to, the deformation of the tracks
    (theta_d) included [deg]; null likewise, or where it does not arrive."""
    largest_rotation_deg: float | None
    """Largest rotation that is arrested [deg]; null likewise."""
    flippers_within_deg: float | None
    """Error of the angles within which the verdict of a found plan holds [deg]; null: not known."""
    path_m: float | None
    """Path of the centroid [m]; null where it does not arrive."""
    time_s: float | None
    """Time for the path at the speed of the question, and for the changes of posture [s]; null
    where one of them is not known."""


class Mission(Part):
    """One robot on one terrain."""

    code: str
    """The question as it was put, as a text that `kaidan report --again` takes."""
    assessment: Assessment
    """What `kaidan assess` answers."""
    traverse: TraverseReport | None
    """What `kaidan traverse` answers; null where another model answered, at a yaw, or outside the
    model."""
    way_back: Assessment | None
    """What `kaidan assess` answers on the way back, the same end uphill: null outside the model."""
    card: FieldCard
    """For the operator."""
    inputs: tuple[InputRow, ...]
    """Every input, with source and doubt."""


class Report(Answer):
    """A document on one or more missions, as data."""

    text_module = "kaidan.text.report"

    kaidan: str
    """Version of kaidan."""
    kernel: Literal["native", "plain"]
    """Contact kernel that answered."""
    missions: tuple[Mission, ...]
    """Robot by robot, and of each robot stairs by stairs."""

    @property
    def exit_code(self) -> int:
        """That of the worst verdict, by `kaidan.modes.EXIT_CODES`."""
        worst = max((Verdict(each.assessment.verdict) for each in self.missions), key=_rank)
        return worst.exit_code


def _rank(verdict: Verdict) -> int:
    return verdict.rank
