"""``kaidan traverse``: a robot followed over stairs, in words, pictures and films."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options, output
from kaidan.cli.question import question
from kaidan.modes import EXIT_CODES

if TYPE_CHECKING:
    from kaidan.question import Question

Poses = Annotated[
    int | None,
    typer.Option("--poses", min=1, max=40, help="Number of poses in the figure [as many as fit]."),
]
SideFiles = Annotated[
    list[Path] | None,
    typer.Option(
        "--side",
        metavar="FILE",
        help="Write the side view alone, with the verdict and what to do: .png, .svg or .pdf.",
    ),
]
PoseMapFiles = Annotated[
    list[Path] | None,
    typer.Option(
        "--pose-map",
        metavar="FILE",
        help="Write a picture of all poses, stable and not: .png, .svg or .pdf. May be given "
        "again.",
    ),
]
AnimationFile = Annotated[
    Path | None,
    typer.Option("--animation", metavar="FILE", help="Write a film: .mp4 or .gif."),
]


def register(app: typer.Typer) -> None:
    """Add ``traverse`` to the command line."""
    app.command("traverse", epilog=f"Exit code: {EXIT_CODES}.")(traverse)


@question(without=("uncertainty", "yaw", "risk", "model"))
def traverse(
    requested: "Question",
    figure: output.FigureFiles = None,
    poses: Poses = None,
    side: SideFiles = None,
    pose_map: PoseMapFiles = None,
    animation: AnimationFile = None,
    as_json: options.AsJson = False,
) -> None:
    """Follow ROBOT over STAIRS from landing to landing: phases, events, pictures."""
    from kaidan.assessment import found_plan
    from kaidan.errors import InputError
    from kaidan.films import film_format
    from kaidan.verbs.traverse import driven, traverse_report

    pictures = output.checked(figure, *(side or ()), *(pose_map or ()), animation)
    sides = output.checked(side)
    maps = output.checked(pose_map)
    if poses is not None and not pictures:
        raise InputError("--poses needs --figure")
    film = None if animation is None else film_format(animation, "animation")
    asked, search = found_plan(requested)
    passage = driven(asked)
    found = traverse_report(asked, passage, search=search)

    def draw() -> "output.Figure":
        from kaidan.figures.traverse_figure import traverse_figure

        return traverse_figure(found, poses)

    def draw_side() -> "output.Figure":
        from kaidan.assessment import judged, off_plan
        from kaidan.figures.traverse_figure import side_figure
        from kaidan.models import judge
        from kaidan.text.assessment import advice

        findings = off_plan(asked, judge(asked), search)
        return side_figure(found, advice(judged(asked, findings, search=search)))

    def draw_map() -> "output.Figure":
        from kaidan.figures.pose_map_figure import pose_map_figure
        from kaidan.verbs import pose_map

        return pose_map_figure(pose_map.pose_map(asked, passage))

    contents = output.drawn(pictures, draw) | output.drawn(sides, draw_side)
    contents |= output.drawn(maps, draw_map)
    if animation is not None and film is not None:
        from kaidan.figures.animation import film_of

        contents[animation] = film_of(found, film)
    output.put_out(found, contents, as_json=as_json)
    raise typer.Exit(found.exit_code)
