"""The answer of `kaidan.assess`: verdict, margins, what governs, what would help."""

from dataclasses import asdict, dataclass
from typing import Any, Literal

Verdict = Literal["go", "caution", "no-go", "outside-model"]
Governs = Literal[
    "tip_downhill",
    "tip_uphill",
    "slip_up",
    "slip_down",
    "drive",
    "friction_unknown",
    "validity",
    "slip",
    "catch",
    "energy",
    "momentum",
    "stuck",
]
AreaName = Literal["A", "B", "C", "DOWNHILL_SLIP", "D", "E"]


@dataclass(frozen=True, kw_only=True)
class AllowanceShown:
    """An allowance as it was taken off."""

    low_deg: float
    """Kindest reading [deg]."""
    high_deg: float
    """Worst reading, taken off `margin_deg` [deg]."""
    source: Literal["measured", "default", "not applicable"]
    """"measured", "default" (nobody measured it) or "not applicable"."""


@dataclass(frozen=True, kw_only=True)
class Paper:
    """The paper's own quantities [m/s^2], nose or tail up as asked, without allowances."""

    a_S: float | None
    """Eq. (14) with the smallest friction; null where friction is unknown."""
    min_a_r0: float
    """Smallest value of Eq. (15) over the progress."""
    max_a_rn: float
    """Largest value of Eq. (16) over the progress."""
    a_max: float
    """Eq. (17)."""
    a_min: float
    """Eq. (18): without downhill slip, as printed."""


@dataclass(frozen=True, kw_only=True)
class Contact:
    """A contact at the governing pose, just after the lowest nosing has left."""

    behind_uphill_tip_m: float
    """Place along the track [m]."""
    load_share: float
    """Share of the normal load, contacts as equal springs [1]."""
    normal_N: float | None
    """Normal force [N]; null where the mass is unknown."""
    traction_N: float | None
    """Tractive force, up the stairs positive, if all contacts work alike [N]."""
    required_friction: float
    """Traction over normal force [1]."""


@dataclass(frozen=True, kw_only=True)
class Measures:
    """Published stability measures at the governing pose, without allowances."""

    static_margin_mm: float
    """Static stability margin: horizontal distance of the centroid from tipping [mm]."""
    zmp_margin_mm: float
    """Distance of the zero moment point from the nearer end contact, along the track [mm]."""
    energy_margin_mm: float
    """Normalised energy stability margin (Hirose) [mm]."""
    force_angle_Nm_rad: float | None
    """Force-angle measure (Papadopoulos & Rey 1996) [N m rad]; null without a mass."""
    speed_height_mm: float | None
    """v^2 / 2g [mm]: a body this fast could rise so far; null without a speed."""


@dataclass(frozen=True, kw_only=True)
class Change:
    """Something that would help, and what the verdict would then be."""

    change: str
    """What to do."""
    verdict: Verdict
    """Verdict with it."""
    margin_deg: float | None
    """`margin_deg` with it; null where only friction was missing."""


@dataclass(frozen=True, kw_only=True)
class Probability:
    """Probability of each failure mode on the worst reading of what is only known as a range."""

    tip_downhill: float
    tip_uphill: float
    slip_up: float | None
    """Null where friction is unknown."""
    slip_down: float | None
    drive: float | None
    """Null where the drive's traction is unknown."""
    outside_model: float
    """Probability that the model does not apply at all."""
    tip_sideways: float | None
    """Null without a yaw."""
    any: float
    """Probability of at least one of them."""


@dataclass(frozen=True, kw_only=True)
class PhaseShown:
    """Worst figures of a phase of the way, by the contact model."""

    phase: Literal["enter", "traverse", "land"]
    """Part of the way."""
    required_friction: float | None
    """Largest required friction of any pose [1]; null: no friction is enough."""
    required_friction_step: int
    """Nosing at which, counted from the bottom."""
    slides_below: float | None
    """Friction below which, landing at the foot, the trailing end slides down the last risers [1];
    no fall, so it does not count as slipping. Null: it rests on none, or always slides."""
    energy_margin_mm: float | None
    """Smallest rise of the centroid that a fall downhill needs [mm]; null: it falls nowhere."""
    energy_margin_step: int
    """Nosing at which."""
    static_margin_mm: float
    """Smallest static stability margin downhill [mm]."""
    traction_over_weight: float
    """Largest tractive force over the weight [1]."""
    largest_swing_deg: float
    """Largest turn that the next contact catches [deg]."""
    belly_touches: bool
    """Whether the belly carries the robot somewhere."""


@dataclass(frozen=True, kw_only=True)
class Grades:
    """The three grades of "it holds", side by side, never mixed."""

    no_rotation: bool | None
    """Grade one, the paper's criterion, without allowances; null where it says nothing."""
    caught: bool
    """Grade two: whatever turns comes to rest on a static pose, and the robot arrives."""
    caught_with_momentum: bool
    """Grade three: also with the momentum gained (plastic impacts)."""
    largest_swing_deg: float
    """Largest turn while traversing; 90 for a fall [deg]."""
    energy_threshold_mm: float
    """Energy margin below which a swing is expected: v^2/2g of the stated speed, else of the
    paper's 0.1 m/s [mm]."""
    speed_stated: bool
    """Whether that is the speed asked about."""
    accepted: Literal["no-rotation", "caught"]
    """What the operator accepts as holding."""


@dataclass(frozen=True, kw_only=True)
class Assessment:
    """Can this robot take these stairs? One object with everything that was found.

    Angles in degrees, lengths in millimetres or metres and accelerations in m/s^2, up the stairs
    positive, as the names say. Null means: no such number, or not known.
    """

    verdict: Verdict
    """go: stable with the allowances off, friction known, at the chosen risk. caution: go only if
    something unstated is kind, or by controlling the acceleration (area E). no-go: areas A to C.
    outside-model: the model says nothing."""
    model: str
    """Which model answered."""
    governs: Governs
    """What decides: tip_downhill, tip_uphill, slip_up, slip_down, drive, friction_unknown or
    validity."""
    reason: str
    """The verdict in one sentence."""
    robot: str
    stairs: str
    surface: str | None
    direction: Literal["up", "down"]
    facing: Literal["nose-first", "tail-first"]
    area: AreaName | None
    """Area of the paper's d-a plane the asked acceleration reaches on the worst reading: A to E,
    or DOWNHILL_SLIP. E where only an acceleration that follows the position holds it."""
    angle_deg: float | None
    """Slope of the stairs, of the governing step [deg]; null for a terrain that is no flight."""
    nosing_spacing_m: float | None
    """Nosing to nosing, of the governing step [m]; null likewise."""
    contacts_n: int
    """n = floor(L / p): nosings that carry the robot after one has left."""
    flat_length_m: float
    """L, flippers in line included [m]."""
    com_from_front_m: float
    """C_L, payload and flippers included [m]."""
    com_height_m: float
    """C_N, payload and flippers included [m]."""
    mass_kg: float | None
    """Mass with payload [kg]."""
    margin_angle_deg: float | None
    """theta_s_sup for this robot, spacing, facing and acceleration, without allowances [deg]."""
    lower_angle_deg: float | None
    """theta_s_inf, or null where no slope is too gentle [deg]."""
    margin_backward_deg: float | None
    """theta_s_sup minus the angle, without allowances [deg]."""
    margin_deg: float | None
    """Smallest margin of all failure modes, allowances off, at the chosen risk [deg]: positive
    for go, negative or zero for no-go. Unknown friction is left out."""
    margin_at_best_deg: float | None
    """The same on the kindest reading of what is only known as a range [deg]."""
    margins_deg: dict[str, float | None]
    """Margin of each failure mode, as `margin_deg` [deg]."""
    margin_force_N: float | None
    """Force along the slope through the centroid that uses up `margin_deg` [N]; null without a
    mass, or by the closed form."""
    margin_interval_deg: tuple[float, float] | None
    """95 % interval of the smallest margin on the worst reading [deg]; null if all is certain."""
    margin_centroid_mm: float | None
    """How far the centroid may move along the track before a tip limit is crossed, allowances
    off, at the chosen risk [mm]; negative: how far it is beyond."""
    allowances: dict[str, AllowanceShown]
    """theta_d and theta_M."""
    acceleration: float
    """Acceleration asked about [m/s^2]."""
    a_slip_up: float | None
    """Above it the tracks slip down, smallest friction [m/s^2]."""
    a_slip_down: float | None
    """Below it the tracks slip up, smallest friction [m/s^2]."""
    a_tip_downhill: float | None
    """Above it the robot turns over its downhill end [m/s^2]."""
    a_tip_uphill: float | None
    """Below it the robot turns over its uphill end [m/s^2]."""
    falls_over: Literal["nose", "tail"] | None
    """The end over which the robot falls, where a tip limit is crossed."""
    a_max: float | None
    """Upper end of the band, slip included, allowances not; null if the band is empty [m/s^2]."""
    a_min: float | None
    """Lower end of the band [m/s^2]."""
    a_max_safe: float | None
    """Upper end with the allowances taken off, at the chosen risk; null if the band is empty
    [m/s^2]."""
    a_min_safe: float | None
    """Lower end with the allowances taken off, at the chosen risk [m/s^2]."""
    hardest_start: float | None
    """Hardest safe start in the direction of travel, a positive number [m/s^2]."""
    hardest_stop: float | None
    """Hardest safe stop from travel in that direction, a positive number [m/s^2]."""
    paper: Paper | None
    """The paper's own quantities."""
    required_friction: float | None
    """Static friction below which the robot slips at the asked acceleration [1]; null if no
    friction holds it somewhere, or nothing is known."""
    friction: tuple[float, float] | None
    """Static friction of the surface, from the worst to the kindest reading [1]."""
    contacts: tuple[Contact, ...]
    """Contacts at the governing pose."""
    traction_N: float | None
    """Sum of the tractive forces, rolling resistance included [N]."""
    power_W: float | None
    """Power at the motors at the asked speed [W]."""
    measures: Measures | None
    """Published stability measures at the governing pose."""
    probability: Probability | None
    """Null if no input is uncertain."""
    risk: float
    """Risk level the verdict was asked for."""
    what_would_help: tuple[Change, ...]
    """Changes that raise the margin, the best first."""
    notes: tuple[str, ...]
    """What the reader must know about this answer."""
    phase: Literal["enter", "traverse", "land"] | None
    """Phase in which the governing failure shows, by the contact model."""
    step: int | None
    """Nosing at which, counted from the bottom."""
    phases: tuple[PhaseShown, ...]
    """Worst figures of each phase, by the contact model."""
    grades: Grades | None
    """Three grades of "it holds", by the contact model."""
    yaw_deg: float
    """Heading off the line of steepest ascent, to the left positive [deg]."""
    yaw_limit_deg: float | None
    """Yaw from which on the verdict changes, because the robot tips on the flight [deg]; null if it
    tips without any, holds up to 80 deg, or the distance of its tracks is not known."""

    @property
    def exit_code(self) -> int:
        """0 go or caution, 1 no-go, 3 outside the model."""
        return {"go": 0, "caution": 0, "no-go": 1, "outside-model": 3}[self.verdict]

    def to_json(self) -> str:
        """One JSON object, indented, in ASCII."""
        import json

        return json.dumps(asdict(self), indent=2, allow_nan=False)

    @classmethod
    def json_schema(cls) -> dict[str, Any]:
        """JSON schema of that object; exact: it names every property and forbids others."""
        from pydantic import ConfigDict, TypeAdapter

        documented = ConfigDict(use_attribute_docstrings=True, extra="forbid")
        for part in (*_PARTS, cls):
            setattr(part, "__pydantic_config__", documented)  # noqa: B010
        return TypeAdapter(cls).json_schema(mode="serialization")


_PARTS = (AllowanceShown, Paper, Contact, Measures, Change, Probability, PhaseShown, Grades)
