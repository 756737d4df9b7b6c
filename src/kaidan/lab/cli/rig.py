"""``kaidan lab calibrate FILE``: the filled sheet of an experiment on a real robot."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperGroup

from kaidan.cli import options, output

if TYPE_CHECKING:
    from kaidan.lab.rig.calibration import RigCalibration
    from kaidan.robot import Robot


class FileOrStudy(TyperGroup):
    """Group of which a first word that is a TOML file stands for ``rig FILE``."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Command of the words."""
        if args and args[0] not in self.commands and args[0].lower().endswith(".toml"):
            args = ["rig", *args]
        return super().resolve_command(ctx, args)


def rig(
    file: Annotated[
        Path, typer.Argument(metavar="FILE.toml", help="Sheet of kaidan lab experiment --protocol.")
    ],
    into: Annotated[
        Path | None,
        typer.Option(
            "--file",
            metavar="ROBOT.toml",
            help="Robot's sheet to write the figures into [its own file; a robot of the catalogue "
            "needs one].",
        ),
    ] = None,
    as_json: options.AsJson = False,
) -> None:
    """Fit k, kt, theta_d and theta_M of a real robot, and write them into its sheet.

    Exit code: 0 done, 2 bad input.
    """
    from kaidan.lab.rig.calibration import calibrate_rig
    from kaidan.lab.rig.sheet import RigSheet
    from kaidan.robot import Robot

    sheet = RigSheet.of_file(file)
    named = sheet.robot
    if named.lower().endswith(".toml") and not Path(named).exists():
        sheet = sheet.model_copy(update={"robot": str(file.parent / named)})
    found = calibrate_rig(sheet)
    own = Path(sheet.robot) if sheet.robot.lower().endswith(".toml") else None
    files: output.Contents = {}
    place = into or own
    if place is not None:
        files = {place: _with_figures(Robot.named(sheet.robot), place, found, str(file))}
    output.put_out(found, files, as_json=as_json)


def _with_figures(robot: "Robot", place: Path, found: "RigCalibration", origin: str) -> str:
    """Text of the robot's sheet with what was found, validated."""
    from kaidan.catalog import text_of
    from kaidan.catalog.completing import completed
    from kaidan.errors import short
    from kaidan.robot import Robot

    figures: dict[str, Any] = {}
    for name, value in found.figures().items():
        figures[name] = value
        figures[f"sources.{name}"] = f"M: kaidan lab calibrate {origin}"
    text = text_of(place) if place.exists() else robot.to_toml()
    for name in ("theta_d", "theta_M"):
        if f"{name}.low" in figures and f"[{name}]" not in text:
            ends = {end: figures.pop(f"{name}.{end}") for end in ("low", "high")}
            figures = {name: ends, **figures}
    text = completed(text, figures, origin=short(place))
    Robot.from_text(text, origin=short(place))
    return text
