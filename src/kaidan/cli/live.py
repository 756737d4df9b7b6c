"""``kaidan live``: samples of a sensor, or of a recorded climb, sent to the page that watches."""

from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options
from kaidan.cli.monitor import Follow, Places, opened

if TYPE_CHECKING:
    from kaidan.verbs.monitor import Sample

To = Annotated[
    str,
    typer.Option(
        "--to",
        metavar="URL",
        help="Address of the server (kaidan serve), or of a page that waits for a sensor.",
    ),
]
Token = Annotated[
    str | None, typer.Option(envvar="KAIDAN_TOKEN", help="Token of the server, if it has one.")
]
Pace = Annotated[
    float | None,
    typer.Option(
        "--pace",
        min=0.01,
        max=1000.0,
        help="Send a recording as fast as it was driven, times this [as fast as it comes].",
    ),
]

_AT_ONCE = 500
"""Samples of a whole file in one request."""


def register(app: typer.Typer) -> None:
    """Add ``live`` to the command line."""
    app.command("live")(live)


def live(
    robot: options.RobotName,
    places: Places,
    to: To = "http://127.0.0.1:8750/",
    token: Token = None,
    direction: options.Direction = None,
    facing: options.Facing = None,
    flippers: options.Flippers = "stowed",
    payload: options.PayloadText = None,
    pace: Pace = None,
    follow: Follow = False,
) -> None:
    """Send samples of ROBOT on STAIRS to the live page of a server, which judges and shows them.

    Samples come from where those of kaidan monitor come from. Ctrl-C ends with the summary.

    Exit code: 0 sent, 2 bad input, or a server that does not take them.
    """
    from kaidan.errors import InputError
    from kaidan.question import Question
    from kaidan.verbs.monitor.sending import Channel

    if len(places) != 2:
        raise InputError("write ROBOT STAIRS SAMPLES")
    requested = Question.in_one_posture(
        robot,
        places[0],
        direction=direction,
        facing=facing,
        flippers=flippers,
        payload=payload or (),
    )
    channel = Channel.at(to, requested, token=token or "")
    typer.echo(channel.page)
    whole = not follow and Path(places[1]).is_file()
    with (
        suppress(KeyboardInterrupt),
        opened(places[1], follow=follow, nose_up=requested.nose_up) as samples,
    ):
        for bundle in _bundles(samples, pace, whole=whole):
            channel.send(bundle)
    typer.echo(channel.end())


def _bundles(
    samples: "Iterable[Sample]", pace: float | None, *, whole: bool
) -> "Iterator[list[Sample]]":
    """Samples as they are due; without a pace each as it comes, or many of a whole file."""
    import math
    import time
    from itertools import islice

    if whole and pace is None:
        left = iter(samples)
        while bundle := list(islice(left, _AT_ONCE)):
            yield bundle
        return
    begun: tuple[float, float] | None = None
    for each in samples:
        if pace is not None and math.isfinite(each.t):
            begun = begun or (each.t, time.monotonic())
            time.sleep(max(0.0, begun[1] + (each.t - begun[0]) / pace - time.monotonic()))
        yield [each]
