"""``kaidan doctor``: what is installed, and which contact kernel answers."""

import typer

from kaidan.cli import options, output


def register(app: typer.Typer) -> None:
    """Add ``doctor`` to the command line."""
    app.command("doctor")(doctor)


def doctor(as_json: options.AsJson = False) -> None:
    """Say which contact kernel answers and why, and which optional parts are installed."""
    from kaidan.verbs.doctor import doctor as examine

    output.put_out(examine(), {}, as_json=as_json)
