"""``kaidan.traverse``: a robot driven over its terrain, judged, and all of it as data."""

import math
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from kaidan.arguments import known_arguments
from kaidan.assessment import Assessment, found_plan, judged, off_plan
from kaidan.assessment.plan_search import Found
from kaidan.contact import Placement as Place
from kaidan.contact import RotationRecord, rotated
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.models import beside, planned
from kaidan.models.planned import Planned
from kaidan.models.quasi_static import Basis, findings_of, traverse_of
from kaidan.modes import SUPPLIES, Phase, Undecided
from kaidan.outline import Outline
from kaidan.question import Question
from kaidan.text import event_log as log_text
from kaidan.text import fall_stages as stage_text
from kaidan.traversal import Traverse
from kaidan.traversal.contact_forces import contact_forces
from kaidan.traversal.event_log import Place as Touched
from kaidan.traversal.event_log import event_log
from kaidan.traversal.fall_stages import fall_stages
from kaidan.verbs.traverse_report import (
    End,
    EventShown,
    ForceShown,
    LogEntryShown,
    PartShown,
    Placement,
    PlaceShown,
    Poses,
    ProfileShown,
    RotationShown,
    StageShown,
    TraverseReport,
)

_SUPPLIES = {*(mode.key for mode in SUPPLIES), Undecided.FRICTION_UNKNOWN.value}
MOST_ROWS = 500
"""Most poses in an answer."""
FALL = math.radians(60.0)
"""How far a fall is followed [rad]."""
PLACEMENTS = 13
"""Placements of a rotation that are listed."""


@known_arguments
def traverse(robot: Any, stairs: Any = None, **manner: Any) -> TraverseReport:
    """Follow a robot over stairs from landing to landing: phases, events, poses, forces.

    Parameters
    ----------
    robot, stairs, **manner
        A question, or what one is made of, see `kaidan.Question.of`.

    Returns
    -------
    TraverseReport

    Raises
    ------
    InputError
        An input without physical meaning; the text names it.

    Examples
    --------
    >>> from kaidan import Stairs
    >>> found = traverse("kenaf", Stairs(name="short", rise=0.178, going=0.279, steps=4))
    >>> found.assessment.verdict, found.event_log[-1].text
    ('no-go', 'falls over its tail, about the lower landing')
    """
    question, search = found_plan(Question.ask(robot, stairs, **manner))
    return traverse_report(question, driven(question), search=search)


def driven(question: Question) -> Traverse | Planned:
    """Traverse of a question with all margins, for a report and for a pose map."""
    if question.changes:
        return planned.drive(question, with_energy=True)
    return traverse_of(question, with_energy=True)


def traverse_report(
    question: Question,
    passage: Traverse | Planned,
    *,
    most: int = MOST_ROWS,
    search: Found | None = None,
) -> TraverseReport:
    """Report on a traverse, judged by the contact model.

    Parameters
    ----------
    question : Question
    passage : Traverse or Planned
        As `driven` gives it.
    most : int
        Most poses in the answer.
    search : Found, optional
        What found the plan of the question.

    Returns
    -------
    TraverseReport
    """
    if isinstance(passage, Planned):
        from kaidan.verbs.planned_report import planned_report

        return planned_report(question, passage, most=most, search=search)
    found = beside(question, findings_of(question, Basis(question, passage)))
    found = off_plan(question, found, search)
    assessment = judged(question, found, advice=False, search=search)
    return report_of(
        question, passage, assessment, governing=governing_row(passage, assessment), most=most
    )


def report_of(
    question: Question,
    passage: Traverse,
    assessment: Assessment,
    *,
    governing: int | None,
    most: int,
) -> TraverseReport:
    """Report on a traverse in one posture; `governing` is the row of the pose that decides."""
    leading: End = "nose" if question.facing == "nose-first" else "tail"
    rows = thinned(passage, governing or 0, most)
    return TraverseReport(
        assessment=assessment,
        status=passage.status.name.lower().replace("_", "-"),
        arrived=passage.arrived,
        energy_threshold_mm=1e3 * question.energy_threshold(),
        events=_events(passage),
        event_log=_event_log(passage, leading, rows),
        rotations=rotations_shown(passage, rows),
        fall_stages=_fall_stages(passage, leading),
        poses=_poses(question, passage, rows, governing or 0),
        profile=_profile(passage),
        outline=parts_shown(passage.outline),
        moves=(),
    )


def governing_row(passage: Traverse, answer: Assessment) -> int:
    """Row of the pose that decides."""
    margins, phases = passage.path.margins, passage.phase_of_pose
    assert margins is not None
    rows = np.arange(len(phases))
    within = rows[phases == answer.phase] if answer.phase else rows
    within = within if len(within) else rows
    if answer.governs in _SUPPLIES:
        friction = np.nan_to_num(margins.required_friction, nan=np.inf)
        return int(within[np.argmax(np.where(passage.comes_off, 0.0, friction)[within])])
    if not passage.arrived:
        return int(rows[-1])
    rotations = [(each.angle, each.s) for each in passage.path.rotations if each.arrested]
    for _, begins in sorted(rotations, reverse=True):
        row = passage.path.row_before(begins)
        if phases[row] == Phase.TRAVERSE.value:
            return row
    return int(within[np.argmin(margins.energy[within])])


def thinned(passage: Traverse, governing: int, most: int = MOST_ROWS) -> NDArray[np.int64]:
    """Rows of at most so many poses.

    First the extremes, the ends of the lines between rotations and the poses of events, then the
    rest evenly.
    """
    path, count = passage.path, len(passage.path.poses)
    if count <= most:
        return np.arange(count)
    assert path.margins is not None
    legs = np.flatnonzero(np.diff(path.poses.leg))
    kept = {0, count - 1, governing}
    for column in (path.margins.required_friction, -path.margins.energy, np.abs(path.inclination)):
        kept.add(int(np.argmax(np.nan_to_num(column, nan=-np.inf))))
    for row in [*legs.tolist(), *(legs + 1).tolist(), *path.events.pose.tolist()]:
        if len(kept) >= most // 2:
            break
        kept.add(min(max(row, 0), count - 1))
    even = np.linspace(0, count - 1, most - len(kept)).round().astype(int)
    return np.array(sorted(kept | set(even.tolist())), dtype=np.int64)


def _poses(question: Question, passage: Traverse, rows: NDArray[np.int64], governing: int) -> Poses:
    path = passage.path
    assert path.margins is not None
    poses, margins = path.poses[rows], path.margins[rows]
    downhill = -1.0 if passage.descending else 1.0
    return Poses(
        path_m=poses.s,
        x_m=poses.x,
        z_m=poses.z,
        inclination_deg=np.degrees(poses.inclination),
        phase=passage.phase_of_pose[rows],
        leg=poses.leg,
        rear_contact_x_m=poses.rear_point[:, 0],
        rear_contact_z_m=poses.rear_point[:, 1],
        front_contact_x_m=poses.front_point[:, 0],
        front_contact_z_m=poses.front_point[:, 1],
        required_friction=margins.required_friction,
        traction_over_weight=margins.traction / STANDARD_GRAVITY,
        static_margin_back_m=margins.back,
        static_margin_front_m=margins.front,
        energy_margin_mm=1e3 * margins.energy,
        energy_margin_downhill=margins.energy_side == downhill,
        zmp_rear_to_front=margins.zmp,
        force_angle_Nm_rad_kg=margins.force_angle,
        gravity_tilt=margins.tilt,
        forces=[_forces(question, passage, int(row)) for row in rows],
        governing_row=int(np.searchsorted(rows, governing)),
        of=len(path.poses),
    )


def _forces(question: Question, passage: Traverse, row: int) -> list[ForceShown]:
    return [
        ForceShown(
            x_m=each.point[0],
            z_m=each.point[1],
            normal_x=each.normal[0],
            normal_z=each.normal[1],
            load_over_weight=each.load / STANDARD_GRAVITY,
            traction_over_weight=each.traction / STANDARD_GRAVITY,
        )
        for each in contact_forces(passage, row, question.acceleration)
    ]


def _events(passage: Traverse) -> list[EventShown]:
    return [
        EventShown(
            phase=each.phase.value,
            step=each.step,
            what=each.name,
            path_m=each.path,
            x_m=each.x,
            z_m=each.z,
            inclination_deg=math.degrees(each.inclination),
            rotation_deg=None if each.rotation is None else math.degrees(each.rotation),
            topples_with_momentum=each.topples_with_momentum,
        )
        for each in passage.events
    ]


def _event_log(passage: Traverse, leading: End, rows: NDArray[np.int64]) -> list[LogEntryShown]:
    return [
        LogEntryShown(
            kind=each.kind,
            phase=each.phase,
            step=each.step,
            path_m=each.path,
            row=_row_before(passage, each.path, rows),
            inclination_deg=math.degrees(each.inclination),
            rotation_deg=math.degrees(each.rotation),
            places=[_place(place) for place in each.places],
            text=log_text.sentence(
                each.kind,
                each.places,
                each.end,
                math.degrees(each.rotation),
                each.topples_with_momentum,
            ),
        )
        for each in event_log(passage, leading)
    ]


def _place(place: Touched) -> PlaceShown:
    return PlaceShown(what=place.what, number=place.number, part=place.part)


def _fall_stages(passage: Traverse, leading: End) -> list[StageShown]:
    downhill = leading if passage.descending else ("tail" if leading == "nose" else "nose")
    return [
        StageShown(
            name=each.name,
            path_m=each.path,
            inclination_deg=math.degrees(each.inclination),
            text=stage_text.sentence(
                each.name,
                each.place,
                downhill,
                rotation_deg=None if each.rotation is None else math.degrees(each.rotation),
                share=each.share,
            ),
        )
        for each in fall_stages(passage, leading)
    ]


def rotations_shown(passage: Traverse, rows: NDArray[np.int64]) -> list[RotationShown]:
    """Rotations of a traverse, each with placements to draw it by."""
    return [
        RotationShown(
            row=_row_before(passage, each.s, rows),
            leading_end="up" if each.sense > 0 else "down",
            angle_deg=math.degrees(each.angle if each.arrested else FALL),
            arrested=each.arrested,
            topples_with_momentum=each.topples_with_momentum,
            placements=[_placement(place) for place in _followed(passage, each)],
        )
        for each in passage.path.rotations
    ]


def _row_before(passage: Traverse, s: float, rows: NDArray[np.int64]) -> int:
    """Place among the listed rows of the last pose before an arclength [m]."""
    return int(np.searchsorted(rows, passage.path.row_before(s), side="right")) - 1


def _followed(passage: Traverse, rotation: RotationRecord) -> list[Place]:
    """Where the robot is during a rotation, at even angles.

    A rotation that ends on another contact may change its pivot on the way, so it is interpolated;
    a fall is followed about its first pivot.
    """
    shares = np.linspace(0.0, 1.0, PLACEMENTS).tolist()
    if not rotation.arrested:
        return [rotated(passage.path, rotation, share * FALL) for share in shares]
    start, end = np.array(rotation.start), np.array(rotation.end)
    return [Place(*((1 - share) * start + share * end).tolist()) for share in shares]


def _placement(place: Place) -> Placement:
    return Placement(x_m=place.x, z_m=place.z, inclination_deg=math.degrees(place.inclination))


def _profile(passage: Traverse) -> ProfileShown:
    profile = passage.profile
    apart = np.diff(profile.nosings, axis=0)
    inclination = None
    if len(apart):  # the middle one: a landing between flights does not count
        inclination = math.degrees(float(np.median(np.arctan2(apart[:, 1], apart[:, 0]))))
    return ProfileShown(
        points_m=profile.points,
        nosings_m=profile.nosings,
        inclination_deg=inclination,
        overhangs=profile.overhangs,
        open_risers=profile.open_risers,
    )


def parts_shown(outline: Outline) -> tuple[PartShown, ...]:
    """Parts of an outline."""
    names = ("x_1_m", "z_1_m", "radius_1_m", "x_2_m", "z_2_m", "radius_2_m")
    kinds: tuple[Literal["track", "flipper", "belly"], ...] = ("track", "flipper", "belly")
    return tuple(
        PartShown(kind=kinds[kind], **dict(zip(names, part, strict=True)))
        for kind, part in zip(outline.kinds.tolist(), outline.parts.tolist(), strict=True)
    )
