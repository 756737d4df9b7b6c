"""The report on the traverse of a plan: its parts one after the other, and the changes between."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from kaidan.assessment import judged, off_plan
from kaidan.assessment.answer import Assessment
from kaidan.assessment.plan_search import Found
from kaidan.models import beside, planned
from kaidan.models.planned import Part, Planned
from kaidan.modes import SUPPLIES, Undecided
from kaidan.question import Question
from kaidan.traversal.moves import Move, MovePose
from kaidan.verbs import one_posture_report as alone
from kaidan.verbs.sentences import event_log as log_text
from kaidan.verbs.traverse_report import (
    LogEntryShown,
    MovePoseShown,
    MoveShown,
    Placement,
    Poses,
    TraverseReport,
)

_SUPPLIES = {*(mode.key for mode in SUPPLIES), Undecided.FRICTION_UNKNOWN.value}


def planned_report(
    question: Question,
    driven: Planned,
    *,
    most: int,
    search: Found | None = None,
) -> TraverseReport:
    """Report on the traverse of a plan."""
    findings = off_plan(question, beside(question, planned.findings(question, driven)), search)
    answer = judged(question, findings, advice=False, search=search)
    governing = _governing(driven, answer)
    share = max(most // len(driven.parts), 2)
    reports = [
        alone.report_of(
            part.question,
            part.traverse,
            answer,
            governing=governing[1] if k == governing[0] else None,
            most=share,
        )
        for k, part in enumerate(driven.parts)
    ]
    return _joined(question, driven, reports, governing[0])


def _governing(driven: Planned, answer: Assessment) -> tuple[int, int]:
    """Part and row of the pose that decides."""
    each = [
        (_decides(part, row, answer), -k, row)
        for k, part in enumerate(driven.parts)
        if answer.phase in (None, *part.traverse.phase_of_pose)
        for row in [alone.governing_row(part.traverse, answer)]
    ]
    if not each:  # the change to the phase that decides
        last = len(driven.parts) - 1
        return last, len(driven.parts[last].traverse.path.poses) - 1
    _, part, row = max(each)
    return -part, row


def _decides(part: Part, row: int, answer: Assessment) -> float:
    """How far a pose decides: by its friction, by the end that it is, by its energy."""
    margins = part.traverse.path.margins
    assert margins is not None
    if answer.governs in _SUPPLIES:
        return float(np.nan_to_num(margins.required_friction[row], nan=math.inf))
    return math.inf if not part.traverse.arrived else -float(margins.energy[row])


def _joined(
    question: Question, driven: Planned, reports: Sequence[TraverseReport], governing: int
) -> TraverseReport:
    """Reports on the parts as one: arclengths, rows and legs count on."""
    first, last = reports[0], reports[-1]
    paths, rows, legs = [0.0], [0], [0]
    for each in reports:
        paths.append(paths[-1] + each.poses.path_m[-1])
        rows.append(rows[-1] + len(each.poses.path_m))
        legs.append(legs[-1] + each.poses.leg[-1] + 1)
    events: list[Any] = []
    log: list[Any] = []
    rotations: list[Any] = []
    for k, each in enumerate(reports):
        on, row, ends = paths[k], rows[k], each is not last
        events += [
            _on(one, path_m=on) for one in each.events if not (ends and one.what == "arrived")
        ]
        log += [
            _on(one, path_m=on, row=row)
            for one in each.event_log
            if not (ends and one.kind == "arrives")
        ]
        rotations += [_on(one, row=row) for one in each.rotations]
        if k < len(driven.moves):
            log.append(_log_entry(driven.moves[k], question, paths[k + 1], rows[k + 1] - 1))
    stages = next((k for k, each in enumerate(reports) if each.fall_stages), 0)
    return first.model_copy(
        update={
            "status": last.status,
            "arrived": driven.arrived,
            "events": tuple(events),
            "event_log": tuple(log),
            "rotations": tuple(rotations),
            "fall_stages": tuple(
                _on(each, path_m=paths[stages]) for each in reports[stages].fall_stages
            ),
            "poses": _poses([each.poses for each in reports], paths, rows, legs, governing),
            "moves": tuple(
                _move(each, driven.parts[k].question, row=rows[k + 1] - 1)
                for k, each in enumerate(driven.moves)
            ),
        }
    )


def _on(part: Any, **by: float) -> Any:
    """Same with some figures counted on."""
    return part.model_copy(update={name: getattr(part, name) + more for name, more in by.items()})


def _poses(
    each: Sequence[Poses],
    paths: Sequence[float],
    rows: Sequence[int],
    legs: Sequence[int],
    governing: int,
) -> Poses:
    counted = {"path_m": paths, "leg": legs}
    columns: dict[str, Any] = {}
    for name in Poses.model_fields:
        if name in ("governing_row", "of"):
            continue
        columns[name] = [
            value + counted[name][k] if name in counted else value
            for k, poses in enumerate(each)
            for value in getattr(poses, name)
        ]
    return Poses(
        **columns,
        governing_row=rows[governing] + each[governing].governing_row,
        of=sum(poses.of for poses in each),
    )


def _log_entry(move: Move, question: Question, path: float, row: int) -> LogEntryShown:
    posture = question.postures[move.before].spelled(question.robot)
    return LogEntryShown(
        kind="changes",
        phase=move.before.value,
        step=None,
        path_m=path,
        row=row,
        inclination_deg=math.degrees(move.poses[0].place.inclination) if move.poses else 0.0,
        rotation_deg=0.0,
        places=[],
        text=log_text.change(
            posture, math.degrees(move.turn), move.seconds, move.torque, stands=move.stands
        ),
    )


def _move(move: Move, before: Question, *, row: int) -> MoveShown:
    return MoveShown(
        before=move.before.value,
        row=row,
        turn_deg=math.degrees(move.turn),
        time_s=move.seconds,
        torque_Nm=move.torque,
        required_friction=move.required_friction,
        energy_margin_mm=1e3 * move.energy,
        rocks_deg=math.degrees(move.rocks),
        stands=move.stands,
        poses=tuple(_pose(each) for each in move.poses),
    )


def _pose(each: MovePose) -> MovePoseShown:
    return MovePoseShown(
        front_deg=None if each.front is None else math.degrees(each.front),
        rear_deg=None if each.rear is None else math.degrees(each.rear),
        placement=Placement(
            x_m=each.place.x,
            z_m=each.place.z,
            inclination_deg=math.degrees(each.place.inclination),
        ),
        required_friction=each.required_friction,
        torque_Nm=max(each.torque.values(), default=math.nan),
        outline=alone.parts_shown(each.outline),
    )
