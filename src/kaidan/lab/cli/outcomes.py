"""``kaidan lab outcomes``: public outcomes beside kaidan's answers."""

import typer

from kaidan.cli import options, output


def register(app: typer.Typer) -> None:
    """Add ``outcomes`` to the command line."""
    app.command("outcomes")(outcomes)


def outcomes(as_json: options.AsJson = False) -> None:
    """Compare answers with public outcomes of robots on stairs, and count the errors.

    The sources and what they leave open are on the page Known outcomes of the documentation, and
    in the JSON.
    """
    from kaidan.lab.outcomes.known_outcomes import known_outcomes

    output.put_out(known_outcomes(), {}, as_json=as_json)
