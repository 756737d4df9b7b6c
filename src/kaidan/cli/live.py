"""``kaidan live``: samples of a sensor, or of a recorded climb, sent to the page that watches."""

from collections.abc import Iterable, Iterator
from contextlib import suppress
from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options
from kaidan.cli.monitor import Follow, NoData, Places, Recorded, Resolution, limits_of

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
    recorded: Recorded = False,
    no_data: NoData = None,
    resolution: Resolution = None,
) -> None:
    """Send samples of ROBOT on STAIRS to the live page of a server, which judges and shows them.

    Samples come from where those of kaidan monitor come from. Ctrl-C ends with the summary.

    Exit code: 0 sent, 2 bad input, or a server that does not take them.
    """
    from kaidan.errors import InputError
    from kaidan.question import Question
    from kaidan.verbs.monitor import open_samples
    from kaidan.verbs.monitor.sending import Channel
    from kaidan.verbs.monitor.sources import is_live

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
    limits = limits_of(no_data_on=no_data, resolution=resolution)
    channel = Channel.at(to, requested, limits=limits, token=token or "")
    typer.echo(channel.page)
    live = pace is None and not recorded and is_live(places[1], follow=follow)
    with (
        suppress(KeyboardInterrupt),
        open_samples(places[1], follow=follow, nose_up=requested.nose_up) as samples,
    ):
        for bundle in _live(samples) if live else _recorded(samples, pace):
            channel.send(bundle, recorded=not live)
    typer.echo(channel.end())


def _live(samples: "Iterator[Sample]") -> "Iterator[list[Sample]]":
    """Samples as they come; those that came while others were sent, at once."""
    from kaidan.verbs.monitor.arrivals import Arrivals

    arrivals = Arrivals(samples)
    while (came := arrivals.take()) is not None:
        yield [each.sample for each in came]


def _recorded(samples: "Iterable[Sample]", pace: float | None) -> "Iterator[list[Sample]]":
    """Samples as they are due; without a pace many at once."""
    import math
    import time
    from itertools import islice

    if pace is None:
        left = iter(samples)
        while bundle := list(islice(left, _AT_ONCE)):
            yield bundle
        return
    begun: tuple[float, float] | None = None
    for each in samples:
        if math.isfinite(each.t):
            begun = begun or (each.t, time.monotonic())
            time.sleep(max(0.0, begun[1] + (each.t - begun[0]) / pace - time.monotonic()))
        yield [each]
