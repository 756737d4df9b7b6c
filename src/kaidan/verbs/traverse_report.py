"""The answer of `kaidan.traverse`: verdict, phases, events, poses, what to draw."""

from typing import Literal

from kaidan.answer import Answer, Part
from kaidan.assessment.answer import Assessment
from kaidan.modes import PhaseName
from kaidan.question import Question

Column = tuple[float | None, ...]
Point = tuple[float, float]
End = Literal["nose", "tail"]


class Placement(Part):
    """Where the robot is."""

    x_m: float
    """Centroid, along the path [m]."""
    z_m: float
    """Centroid, up [m]."""
    inclination_deg: float
    """Leading end up [deg]."""


class EventShown(Part):
    """An event along the path."""

    phase: PhaseName
    step: int
    """Nosing from the bottom, 1 the first; 0 before it."""
    what: str
    """made, lost, nose-drops, tips-back, arrested, tail-rests, fell-forward, and so on."""
    path_m: float
    """Arclength of the centroid's path [m]."""
    x_m: float
    """Centroid, along the path [m]."""
    z_m: float
    """Centroid, up [m]."""
    inclination_deg: float
    """Leading end up [deg]."""
    rotation_deg: float | None
    """Rotation that the next contact arrests [deg]."""
    topples_with_momentum: bool | None
    """Whether the momentum of that rotation carries the robot over."""


class PlaceShown(Part):
    """Something the robot touches."""

    what: str
    """nosing, corner of step, tread, riser, the lower landing, ground, and so on."""
    number: int | None
    """Of the step, from the bottom."""
    part: str
    """Part of the robot: track, front flipper, rear flipper, belly."""


class LogEntryShown(Part):
    """Events that belong together."""

    kind: str
    """passes, rests, reached, left, drops, rises, falls, stuck, arrives, resettled, changes."""
    phase: PhaseName
    step: int | None
    """Of the place it leads to."""
    path_m: float
    """Arclength of the centroid's path [m]."""
    row: int
    """Row of the pose at which it begins, in `poses`."""
    inclination_deg: float
    """Leading end up, at its start [deg]."""
    rotation_deg: float
    """Angle of a rotation [deg]."""
    places: tuple[PlaceShown, ...]
    """What it leads to, then what it comes from."""
    text: str
    """In words."""


class StageShown(Part):
    """A stage of a fall."""

    name: str
    """parallel motion, round end, largest load, onset of rotation, rotates back."""
    path_m: float
    """Arclength of the centroid's path [m]."""
    inclination_deg: float
    """Leading end up [deg]."""
    text: str
    """In words."""


class RotationShown(Part):
    """A rotation about contacts, from where the centroid passed over one."""

    row: int
    """Row of the last pose before it, in `poses`."""
    leading_end: Literal["up", "down"]
    """Which way the leading end goes."""
    angle_deg: float
    """How far it goes [deg]; of a fall, until it is not followed any more."""
    arrested: bool
    """Whether the next contact arrests it."""
    topples_with_momentum: bool
    """Whether the momentum carries the robot over all the same."""
    placements: tuple[Placement, ...]
    """Where the robot is at even angles, from start to end; of a fall, its first part."""


class ForceShown(Part):
    """A contact of a pose and the force that it carries."""

    x_m: float
    """Along the path [m]."""
    z_m: float
    """Up [m]."""
    normal_x: float
    """Of the unit vector from the ground into the robot."""
    normal_z: float
    """Of the unit vector from the ground into the robot."""
    load_over_weight: float | None
    """Normal force over the weight [1]; null where nothing holds."""
    traction_over_weight: float | None
    """Tangential force over the weight, driving ahead positive [1]."""


class Poses(Part):
    """Poses in their order, one value a pose in each column."""

    path_m: tuple[float, ...]
    """Arclength of the centroid's path [m]."""
    x_m: tuple[float, ...]
    """Centroid, along the path [m]."""
    z_m: tuple[float, ...]
    """Centroid, up [m]."""
    inclination_deg: tuple[float, ...]
    """Leading end up [deg]."""
    phase: tuple[PhaseName, ...]
    """Part of the traverse."""
    leg: tuple[int, ...]
    """Grows by one with every rotation."""
    rear_contact_x_m: tuple[float, ...]
    """Contact behind the centroid, along the path [m]."""
    rear_contact_z_m: tuple[float, ...]
    """Contact behind the centroid, up [m]."""
    front_contact_x_m: tuple[float, ...]
    """Contact ahead of the centroid, along the path [m]."""
    front_contact_z_m: tuple[float, ...]
    """Contact ahead of the centroid, up [m]."""
    required_friction: Column
    """[1]; null where no friction holds the robot."""
    traction_over_weight: Column
    """Tractive force over the weight [1]."""
    static_margin_back_m: Column
    """Static stability margin to the contact behind [m]."""
    static_margin_front_m: Column
    """Static stability margin to the contact ahead [m]."""
    energy_margin_mm: Column
    """Rise of the centroid that a fall needs, to the side that needs less [mm]."""
    energy_margin_downhill: tuple[bool, ...]
    """Whether that side is the downhill one."""
    zmp_rear_to_front: Column
    """Where the gravity line meets the line of the contacts, 0 rear to 1 front [1]."""
    force_angle_Nm_rad_kg: Column
    """Force-angle measure (Papadopoulos & Rey 1996) over the mass [N m rad/kg]."""
    gravity_tilt: Column
    """Horizontal over vertical part of effective gravity, backward positive [1]."""
    forces: tuple[tuple[ForceShown, ...], ...]
    """Contacts and forces of each pose."""
    governing_row: int
    """Row of the pose that decides."""
    of: int
    """Number of poses that were computed: more than are listed on a long path."""


class ProfileShown(Part):
    """Terrain as it was driven over, the leading end ahead."""

    points_m: tuple[Point, ...]
    """x along the path, z up [m]."""
    nosings_m: tuple[Point, ...]
    """Nosings [m]."""
    inclination_deg: float | None
    """Slope of the stairs in the direction of travel, of the middle one of all steps [deg]; null
    without two nosings."""
    overhangs: bool
    """Whether the terrain hung over itself and was replaced by its envelope."""
    open_risers: bool
    """Whether risers are open."""


class PartShown(Part):
    """Convex part of the robot's underside: the hull of two discs, in the body frame."""

    kind: Literal["track", "flipper", "belly"]
    x_1_m: float
    """Centre of the first disc, ahead of the centroid [m]."""
    z_1_m: float
    """Centre of the first disc, above the centroid [m]."""
    radius_1_m: float
    """Of the first disc [m]."""
    x_2_m: float
    """Centre of the second disc, ahead of the centroid [m]."""
    z_2_m: float
    """Centre of the second disc, above the centroid [m]."""
    radius_2_m: float
    """Of the second disc [m]."""


class MovePoseShown(Part):
    """A pose on the way from one posture to the next."""

    front_deg: float | None
    """Angle of the front flippers [deg]; null without a pair."""
    rear_deg: float | None
    """Angle of the rear flippers [deg]; null without a pair."""
    placement: Placement
    """Where the robot is."""
    required_friction: float | None
    """[1]; null: no friction holds the robot."""
    torque_Nm: float | None
    """Largest torque of a pair about its pivot [N m]; null without a mass."""
    outline: tuple[PartShown, ...]
    """Underside of the robot."""


class MoveShown(Part):
    """A change of posture while the robot stands."""

    before: PhaseName
    """Phase that it prepares."""
    row: int
    """Row of the last pose before it, in `poses`."""
    turn_deg: float
    """Largest angle by which a flipper turns [deg]."""
    time_s: float | None
    """Time by the flippers' largest speed [s]; null where that is not known."""
    torque_Nm: float | None
    """Largest torque of a pair [N m]; null without a mass."""
    required_friction: float | None
    """Largest of its poses [1]; null: no friction holds the robot."""
    energy_margin_mm: float | None
    """Smallest rise of the centroid that a rotation needs [mm]."""
    rocks_deg: float
    """Rotation of the robot beyond what follows from the turn of the flippers [deg]."""
    stands: bool
    """Whether the robot stands in every pose."""
    poses: tuple[MovePoseShown, ...]
    """From the posture before to the posture after."""


class TraverseReport(Answer):
    """A traverse from landing to landing; x leads ahead, whether up or down the stairs."""

    text_module = "kaidan.text.traverse"

    assessment: Assessment
    """Answer of the contact model, with the question."""
    status: str
    """How the traverse ended: ok, fell-backward, fell-forward, stuck, and so on."""
    arrived: bool
    """Whether the whole robot stands on the other landing."""
    energy_threshold_mm: float
    """Energy margin on the flat below which a sudden stop or start may rock the robot [mm]."""
    events: tuple[EventShown, ...]
    event_log: tuple[LogEntryShown, ...]
    """The same events, those that belong together as one."""
    rotations: tuple[RotationShown, ...]
    fall_stages: tuple[StageShown, ...]
    """Stages of the largest rotation over the downhill end, on the flight."""
    poses: Poses
    profile: ProfileShown
    outline: tuple[PartShown, ...]
    """Underside of the robot, in its posture at the start."""
    moves: tuple[MoveShown, ...]
    """Changes of posture, in their order."""

    def outline_at(self, row: int) -> tuple[PartShown, ...]:
        """Underside of the robot at a pose of `poses`."""
        row = row % len(self.poses.x_m)
        outlines = [each.poses[-1].outline for each in self.moves if each.row < row and each.poses]
        return outlines[-1] if outlines else self.outline

    @property
    def question(self) -> Question:
        """The question that it answers."""
        return self.assessment.question

    @property
    def exit_code(self) -> int:
        """By `kaidan.modes.EXIT_CODES`."""
        return self.assessment.exit_code

    @property
    def leading(self) -> End:
        """End of the robot that leads."""
        return "nose" if self.question.facing == "nose-first" else "tail"

    @property
    def trailing(self) -> End:
        """The other end."""
        return "tail" if self.question.facing == "nose-first" else "nose"
