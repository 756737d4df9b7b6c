"""``kaidan traverse``: the whole way told, drawn and moving."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options
from kaidan.cli.question import question
from kaidan.cli.tables import echo, echo_table

if TYPE_CHECKING:
    from kaidan.assessment.answer import PhaseShown
    from kaidan.assessment.case import Case
    from kaidan.report.journey import Journey

Accept = Annotated[
    str,
    typer.Option(help="What counts as holding: no-rotation, or caught (by the next contact)."),
]
FigureFile = Annotated[
    Path | None,
    typer.Option("--figure", metavar="FILE", help="Side view and margins: .png, .svg or .pdf."),
]
Poses = Annotated[
    int | None,
    typer.Option("--poses", min=1, max=40, help="Number of poses in the figure [as fit]."),
]
LandscapeFile = Annotated[
    Path | None,
    typer.Option("--landscape", metavar="FILE", help="Energy landscape: .png, .svg or .pdf."),
]
AnimationFile = Annotated[
    Path | None,
    typer.Option("--animation", metavar="FILE", help="The way as a film: .mp4 or .gif."),
]


def register(app: typer.Typer) -> None:
    """Add ``traverse`` to the command line."""
    app.command("traverse")(traverse)


@question(without=("uncertainty", "yaw", "risk"))
def traverse(
    case: "Case",
    accept: Accept = "no-rotation",
    figure: FigureFile = None,
    poses: Poses = None,
    landscape: LandscapeFile = None,
    animation: AnimationFile = None,
    as_json: options.AsJson = False,
) -> None:
    """Follow ROBOT over STAIRS from landing to landing: phases, events, pictures.

    Exit code: 0 go or caution, 1 no-go, 2 bad input, 3 outside the model.
    """
    from kaidan.errors import InputError
    from kaidan.report import files
    from kaidan.report.journey import journey

    forms = [None if path is None else files.figure_format(path) for path in (figure, landscape)]
    if poses is not None and figure is None:
        raise InputError("--poses needs --figure")
    film = None
    if animation is not None:
        from kaidan.report import animation as films

        film = films.writer_for(animation)
    found = journey(case, accept=accept)
    contents: dict[Path, bytes | str] = {}
    if figure is not None and forms[0] is not None:
        from kaidan.report.traverse_figure import traverse_figure

        contents[figure] = files.figure_bytes(traverse_figure(found, poses), forms[0])
    if landscape is not None and forms[1] is not None:
        from kaidan.report.landscape import landscape_of
        from kaidan.report.landscape_figure import landscape_figure

        drawn = landscape_figure(landscape_of(found))
        contents[landscape] = files.figure_bytes(drawn, forms[1])
    if animation is not None and film is not None:
        contents[animation] = film(found)
    files.write_all(contents)
    if as_json:
        typer.echo(files.json_text(found.as_dict()), nl=False)
    else:
        _show(found)
    for path in contents:
        typer.echo(f"wrote {path}", err=as_json)
    raise typer.Exit(found.exit_code)


_VERDICT = {
    "go": "GO",
    "caution": "CAUTION",
    "no-go": "NO-GO",
    "outside-model": "OUTSIDE THE MODEL",
}


def _show(found: "Journey") -> None:
    from kaidan.report.moves import lines_of

    case, told = found.case, found.ruling
    echo(
        f"{_VERDICT[told.verdict]}  {case.robot.name} on {case.stairs.name}, {case.direction} "
        f"{case.facing.replace('-', ' ')}"
    )
    echo(f"  {told.reason}")
    for doubt in told.doubts:
        if doubt not in told.reason:
            echo(f"  {doubt[0].upper()}{doubt[1:]}.")
    echo("")
    for line in grade_lines(told.grades):
        echo(f"  {line}")
    if told.phases:
        echo("")
        _show_phases(found)
    echo("")
    for line in lines_of(found.moves):
        echo(f"  {line}")
    if found.fall:
        echo("")
        echo("  How it turns over its downhill end (stages of the paper's Fig. 20, no grousers)")
    for stage in found.fall:
        echo(
            f"    {stage.name:<16}{stage.way_m:6.2f} m {stage.inclination_deg:6.1f} deg  "
            f"{stage.text}"
        )


def grade_lines(grades: object) -> list[str]:
    """Three grades side by side, and what the words mean."""
    from kaidan.assessment.answer import Grades

    assert isinstance(grades, Grades)
    one = {None: "says nothing", True: "yes", False: "no"}[grades.no_rotation]
    held = (grades.caught, grades.caught_with_momentum)
    caught, momentum = ("yes" if each else "no" for each in held)
    return [
        f"holds           without rotation: {one}   caught: {caught}   "
        f"caught with momentum: {momentum}   (accepted: {grades.accepted.replace('-', ' ')})",
        f"largest swing   {grades.largest_swing_deg:.1f} deg while traversing",
    ]


def _friction_of(each: "PhaseShown") -> str:
    needed = "none is enough" if each.required_friction is None else f"{each.required_friction:.2f}"
    return f"{needed} at step {each.required_friction_step}"


def _show_phases(found: "Journey") -> None:
    def at(value: float | None, step: int, form: str) -> str:
        return "-" if value is None else f"{value:{form}} at step {step}"

    echo_table(
        [
            {
                "phase": each.phase,
                "friction": _friction_of(each),
                "energy": at(each.energy_margin_mm, each.energy_margin_step, ".1f"),
                "static": f"{round(each.static_margin_mm) + 0:.0f}",
                "traction": f"{each.traction_over_weight:.2f}",
                "swing": f"{each.largest_swing_deg:.1f}",
                "belly": "touches" if each.belly_touches else "free",
            }
            for each in found.ruling.phases
        ],
        {
            "phase": "phase",
            "friction": "required friction",
            "energy": "energy margin [mm]",
            "static": "static margin [mm]",
            "traction": "traction / weight",
            "swing": "swing [deg]",
            "belly": "belly",
        },
    )
