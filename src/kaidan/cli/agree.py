"""``kaidan agree``: closed form, contact model and physics asked the same questions."""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options
from kaidan.cli.tables import echo, echo_table

if TYPE_CHECKING:
    from kaidan.agreement import Agreement, Difference, Question

FigureFile = Annotated[
    Path | None,
    typer.Option("--figure", metavar="FILE", help="Limits and differences: .png, .svg or .pdf."),
]
Begin = Annotated[
    str,
    typer.Option(help="Where the trial on the stairs begins: flight, or landing (the whole way)."),
]
Resolution = Annotated[
    str, typer.Option(help="Of what trials find by bisection, for example 0.1deg.")
]


def register(app: typer.Typer) -> None:
    """Add ``agree`` to the command line."""
    app.command("agree")(agree)


def agree(
    robot: options.RobotName,
    stairs: options.StairsName = None,
    rise: options.Rise = None,
    going: options.Going = None,
    angle: options.Angle = None,
    nosing_spacing: options.NosingSpacing = None,
    steps: options.Steps = None,
    surface: options.SurfaceName = None,
    friction: options.Friction = None,
    acceleration: options.Acceleration = "0m/s2",
    speed: options.Speed = None,
    direction: options.Direction = None,
    facing: options.Facing = "nose-first",
    flippers: options.Flippers = "stowed",
    payload: options.PayloadText = None,
    override: options.Override = None,
    begin: Begin = "flight",
    resolution: Resolution = "0.1deg",
    figure: FigureFile = None,
    as_json: options.AsJson = False,
) -> None:
    """Ask closed form, contact model and MuJoCo the same about ROBOT on STAIRS, and compare.

    Each difference has a band within which it is expected, with the reason; beyond it the likely
    cause is named. Without a speed trials run at 0.1 m/s, without a surface with a friction of 3.

    Exit code: 0 all within their bands, 1 not, 2 bad input.
    """
    from kaidan import agreement
    from kaidan.errors import InputError
    from kaidan.report import files
    from kaidan.units import parse

    form = None if figure is None else files.figure_format(figure)
    if begin not in ("flight", "landing"):
        raise InputError(f"--begin {begin!r} is not known; known: flight, landing")
    width = math.degrees(parse(resolution, "angle", option="--resolution"))
    if not 0.01 <= width <= 5.0:
        raise InputError(f"--resolution {resolution!r} is not within 0.01 to 5 deg")
    case = options.case_from(
        robot,
        options.stairs_of(
            stairs, rise=rise, going=going, angle=angle, nosing_spacing=nosing_spacing, steps=steps
        ),
        surface=surface,
        friction=friction,
        acceleration=acceleration,
        speed=speed,
        direction=direction,
        facing=facing,
        flippers=flippers,
        payload=payload,
        override=override,
    )
    found = agreement.agree(case, begin=begin, resolution=width)  # type: ignore[arg-type]
    if figure is not None and form is not None:
        from kaidan.report.agreement_figure import agreement_figure

        files.write_all({figure: files.figure_bytes(agreement_figure(found), form)})
    if as_json:
        typer.echo(files.json_text(found.as_dict()), nl=False)
    else:
        _show(found)
    if figure is not None:
        typer.echo(f"wrote {figure}", err=as_json)
    raise typer.Exit(0 if found.agrees else 1)


def _show(found: "Agreement") -> None:
    from kaidan.agreement.answer import MODELS

    case = found.case
    echo(
        f"{'AGREE' if found.agrees else 'DIFFER'}  {case.robot.name} on {case.stairs.name}, "
        f"{case.direction} {case.facing.replace('-', ' ')}"
    )
    echo(
        f"  Trials: smooth belt, {found.speed:g} m/s, friction {found.friction:g}, from the "
        f"{found.begin}; {found.trials} of them, to {found.resolution:g} deg; MuJoCo "
        f"{found.versions['mujoco']}."
    )
    echo("")
    echo_table(
        [
            {"question": _asked(each), **{model: _answer(each, model) for model in MODELS}}
            for each in found.questions
        ],
        {"question": "question", **MODELS},
    )
    echo("")
    echo_table(
        [_row(each, str(number)) for number, each in enumerate(found.differences, start=1)],
        {
            "number": "",
            "what": "difference",
            "value": "[deg]",
            "band": "expected",
            "within": "within",
        },
    )
    echo("")
    reasons: dict[str, list[int]] = {}
    for number, each in enumerate(found.differences, start=1):
        text = each.cause or (each.band.reason if each.band is not None else "")
        if text:
            reasons.setdefault(text, []).append(number)
    for text, numbers in reasons.items():
        echo(f"  {', '.join(map(str, numbers))}: {text}.")


def _asked(each: "Question") -> str:
    unit = {"deg": " [deg]", "1": "", "": ""}[each.unit]
    return f"{each.text}{unit}"


def _answer(each: "Question", model: str) -> str:
    value = each.answers[model]
    if value is None:
        return "-"
    if isinstance(value, str):
        return value
    return f"{round(value, 2) + 0.0:.2f}"


def _row(each: "Difference", number: str) -> dict[str, str]:
    from kaidan.agreement.answer import MODELS

    names = {"steepest_flight": "flight", "extra": "inclination"}
    name = names.get(each.question, each.question)
    within = {None: "-", True: "yes", False: "NO"}[each.within]
    return {
        "number": number,
        "what": f"{name}: {MODELS[each.of]} less {MODELS[each.less]}",
        "value": "-" if each.value is None else f"{round(each.value, 2) + 0.0:+.2f}",
        "band": _band(each),
        "within": within,
    }


def _band(each: "Difference") -> str:
    if each.band is None:
        return "the same" if each.question == "stairs" else "-"
    low, high = each.band.low, each.band.high
    if max(abs(low), abs(high)) < 1e-3:
        return f"+-{high:.0e}"
    if math.isinf(low):
        return "anything"
    return f"{low:+.2f} or more" if math.isinf(high) else f"{low:+.2f} to {high:+.2f}"
