"""``kaidan robots|stairs|surfaces|new``: the catalogues and sheets to fill in."""

import typer


def register(app: typer.Typer) -> None:
    """Add the commands of this module to the command line."""
