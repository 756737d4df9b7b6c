"""``kaidan serve``: the page and the API."""

import sys
from pathlib import Path
from typing import Annotated

import typer

Host = Annotated[
    str,
    typer.Option(help="Address to listen at; any but this machine's own demands a token."),
]
Port = Annotated[int, typer.Option(min=0, max=65535, help="Port to listen at.")]
Token = Annotated[
    str | None,
    typer.Option(
        envvar="KAIDAN_TOKEN",
        help="Token that clients must send, 16 characters at least [made up where one is needed].",
    ),
]
Processes = Annotated[
    int | None, typer.Option(min=1, max=256, help="Processes that answer [one a processor].")
]

StateFolder = Annotated[
    Path | None,
    typer.Option(
        "--state", metavar="DIR", help="Folder that keeps the jobs [the user's state folder]."
    ),
]


def register(app: typer.Typer) -> None:
    """Add ``serve`` to the command line."""
    app.command("serve")(serve)


def serve(
    host: Host = "127.0.0.1",
    port: Port = 8750,
    token: Token = None,
    workers: Processes = None,
    state: StateFolder = None,
) -> None:
    """Serve the page and the API to browsers and robots, without a network.

    Everything comes from this machine. Ctrl-C ends it.
    """
    from kaidan.campaign.local import processors
    from kaidan.errors import needed

    for module in ("fastapi", "uvicorn", "httptools", "python_multipart"):
        needed(module, "kaidan serve", "web")
    from kaidan.web.server import is_local, listening, server_of, token_for
    from kaidan.web.state import State, usual_folder

    token = token_for(host, token)
    if not is_local(host):
        typer.echo(
            f"kaidan: whoever reaches {host} and knows the token can ask; nothing is encrypted",
            err=True,
        )
    with listening(host, port) as opened, State(state or usual_folder()) as kept:
        shown = f"[{host}]" if ":" in host else host
        secret = f"?token={token}" if token else ""
        typer.echo(f"http://{shown}:{opened.getsockname()[1]}/{secret}")
        sys.stdout.flush()
        count = workers or processors()
        server = server_of(kept, host=host, token=token, workers=count)
        server.run(sockets=[opened])
