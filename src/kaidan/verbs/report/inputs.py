"""Every input of a question as a row, with its source and its doubt."""

from collections.abc import Iterator
from typing import Literal

from kaidan.assessment.answer import Assessment
from kaidan.question import Question
from kaidan.sheet import Sheet
from kaidan.tables import human
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.verbs.report.answer import InputRow
from kaidan.verbs.sheet_rows import field_rows


def inputs_of(question: Question, assessment: Assessment) -> Iterator[InputRow]:
    """Rows of robot, terrain, surface and manner."""
    yield from _of("robot", question.robot)
    for terrain in _flights(question):
        if isinstance(terrain, Profile):
            yield _row("stairs", "points", str(len(terrain.points)), source=terrain.name)
            yield _row("stairs", "nosings", str(len(terrain.nosings)), source=terrain.name)
        else:
            yield from _of("stairs", terrain)
    if question.surface is None:
        yield _row("surface", "friction", "not stated")
    else:
        yield from _of("surface", question.surface)
    yield from _manner(question, assessment)


def _flights(question: Question) -> tuple[Stairs | Profile, ...]:
    return question.terrain if isinstance(question.terrain, tuple) else (question.terrain,)


def _of(owner: Literal["robot", "stairs", "surface"], sheet: Sheet) -> Iterator[InputRow]:
    yield _row(owner, "name", str(getattr(sheet, "name", "")), source=getattr(sheet, "title", ""))
    for row in field_rows(sheet):
        if row.value not in ("", "{}") and not row.field.startswith("uncertainty."):
            yield InputRow(of=owner, **row._asdict())


def _manner(question: Question, assessment: Assessment) -> Iterator[InputRow]:
    best = question.best_of
    stated = question.model_fields_set
    flippers = "best, to be found" if "flippers" in best else question.flippers
    yield _row("manner", "direction", question.direction)
    yield _row("manner", "facing", "best, to be found" if "facing" in best else question.facing)
    if question.robot.flippers():
        yield _row("manner", "flippers", flippers)
        yield _row("manner", "off their angles by", human(question.tolerance, unit="rad"))
    yield _row(
        "manner", "acceleration", f"{question.acceleration:g} m/s2 up the stairs", symbol="a"
    )
    speed = "not stated" if question.speed is None else f"{question.speed:g} m/s"
    yield _row("manner", "speed", speed)
    for number, load in enumerate(question.payload, start=1):
        yield _row(
            "manner",
            f"payload {number}",
            f"{load.mass:g} kg, {human(load.from_front, unit='m')} behind the front tip, "
            f"{human(load.height, unit='m')} up",
        )
    for name, each in assessment.allowances.items():
        low, high = each.low_deg, each.high_deg
        value = f"{high:.3g} deg" if low == high else f"{low:.3g} to {high:.3g} deg"
        yield _row("manner", name, value, source=each.source)
    if question.uniform_across:
        yield _row("manner", "both tracks meet the same profile", "yes")
    if question.yaw:
        yield _row("manner", "yaw", human(question.yaw, unit="rad"))
    if "fall_reserve" in stated and question.fall_reserve is not None:
        yield _row("manner", "fall reserve", human(question.fall_reserve, unit="rad"))
    yield _row("manner", "accepted risk", f"{question.risk:g}")
    yield _row("manner", "model", question.model)


def _row(
    owner: Literal["robot", "stairs", "surface", "manner"],
    field: str,
    value: str,
    *,
    source: str = "",
    symbol: str = "",
) -> InputRow:
    return InputRow(of=owner, field=field, symbol=symbol, value=value, source=source, doubt="")
