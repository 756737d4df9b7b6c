"""``kaidan lab outcomes``: public outcomes beside kaidan's answers, and a laboratory's own."""

from pathlib import Path
from typing import Annotated

import typer

from kaidan.cli import options, output


def register(app: typer.Typer) -> None:
    """Add ``outcomes`` to the command line."""
    app.command("outcomes")(outcomes)


def outcomes(
    files: Annotated[
        list[Path] | None,
        typer.Argument(metavar="[FILE.toml]...", help="Own outcomes: filled forms."),
    ] = None,
    form: Annotated[bool, typer.Option("--form", help="Print the form to fill in.")] = False,
    as_json: options.AsJson = False,
) -> None:
    """Compare answers with public outcomes of robots on stairs, and count the errors.

    The sources and what they leave open are on the page Known outcomes of the documentation, and
    in the JSON. With --form, print the form with which a laboratory sends its own.
    """
    from kaidan.lab.outcomes.form import FORM, OutcomesForm
    from kaidan.lab.outcomes.known_outcomes import known_outcomes

    if form:
        typer.echo(FORM, nl=False)
        return
    found = known_outcomes(*(OutcomesForm.of_file(file) for file in files or ()))
    output.put_out(found, {}, as_json=as_json)
