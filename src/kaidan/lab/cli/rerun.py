"""``kaidan lab rerun``: an answer as a recording for the viewer of Rerun."""

from pathlib import Path
from typing import Annotated

import typer

from kaidan.cli import output

AnswerFile = Annotated[
    Path,
    typer.Argument(metavar="ANSWER.json", help="What kaidan traverse or read printed with --json."),
]
Recording = Annotated[Path, typer.Argument(metavar="FILE.rrd", help="Recording to write.")]


def register(app: typer.Typer) -> None:
    """Add ``rerun`` to the commands of the laboratory."""
    app.command("rerun")(rerun)


def rerun(answer: AnswerFile, file: Recording) -> None:
    """Write a traverse, or what was found in a file, as a recording for the viewer of Rerun.

    Exit code: 0 done, 2 bad input.
    """
    from kaidan.lab.rerun.recording import answer_recording, recording_file

    recording_file(file)
    output.write({file: answer_recording(answer)})
