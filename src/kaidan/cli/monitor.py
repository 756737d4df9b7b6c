"""``kaidan monitor``: margin, time to tip-over and alarm from samples of a file or a stream."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from json import dumps
from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options
from kaidan.cli.tables import echo

if TYPE_CHECKING:
    from kaidan.verbs.monitor import AlarmLimits, Monitor, Sample

Places = Annotated[
    list[str],
    typer.Argument(
        metavar="[STAIRS] SAMPLES",
        help="Stairs (catalogue name or TOML file) unless options give their shape; then a CSV "
        "file, or - for standard input, with columns t, inclination, inclination_rate, "
        "acceleration and, if known, position: s, rad, rad/s, m/s^2, m; serial:DEVICE with such "
        "lines; or a recording of ROS with an Imu topic: .bag, .mcap, .db3.",
    ),
]
AlarmMargin = Annotated[
    str | None, typer.Option(help="Margin below which the alarm is raised [5.2deg].")
]
ClearMargin = Annotated[
    str | None, typer.Option(help="Margin above which it may be cleared [7.2deg].")
]
AlarmTime = Annotated[
    str | None, typer.Option(help="Time to tip-over below which the alarm is raised [0.5s].")
]
ClearTime = Annotated[
    str | None, typer.Option(help="Time to tip-over above which it may be cleared [1s].")
]
Unjudged = Annotated[
    int | None,
    typer.Option(
        min=1, help="Samples in a row that cannot be judged at which the alarm is raised [10]."
    ),
]
Horizon = Annotated[str | None, typer.Option(help="How far ahead it predicts [2s].")]
Strict = Annotated[
    bool, typer.Option("--strict", help="End at the first sample that is not in order.")
]
Follow = Annotated[
    bool, typer.Option("--follow", help="Wait at the end of the file for what is written next.")
]
Changes = Annotated[
    bool, typer.Option("--changes", help="Only samples at which alarm or status change.")
]
AsJsonLines = Annotated[
    bool,
    typer.Option(
        "--json", help="Print one JSON object a sample, and one on all of them at the end."
    ),
]


def register(app: typer.Typer) -> None:
    """Add ``monitor`` to the command line."""
    app.command("monitor")(monitor)


def monitor(
    robot: options.RobotName,
    places: Places,
    rise: options.Rise = None,
    going: options.Going = None,
    angle: options.Angle = None,
    nosing_spacing: options.NosingSpacing = None,
    steps: options.Steps = None,
    direction: options.Direction = None,
    facing: options.Facing = None,
    flippers: options.Flippers = "stowed",
    payload: options.PayloadText = None,
    override: options.Override = None,
    alarm_margin: AlarmMargin = None,
    clear_margin: ClearMargin = None,
    alarm_time: AlarmTime = None,
    clear_time: ClearTime = None,
    unjudged: Unjudged = None,
    horizon: Horizon = None,
    strict: Strict = False,
    follow: Follow = False,
    changes: Changes = False,
    as_json: AsJsonLines = False,
) -> None:
    """Watch ROBOT on STAIRS through its inertial sensor: how far from tipping over, and how soon.

    Inclination and its rate count nose up, acceleration (without gravity) and position up the
    stairs; position is 0 where a nosing meets the uphill tip of the flat. What is not known counts
    as the worst case. Rows that cannot be read are counted and left out.

    Exit code: 0 no alarm, 1 the alarm was raised, 2 bad input or more than half of the samples not
    judged, 3 outside the model.
    """
    from kaidan.errors import InputError
    from kaidan.question import Question
    from kaidan.verbs.monitor import Monitor

    if len(places) > 2:
        raise InputError(f"too many arguments: {' '.join(places)}; write ROBOT [STAIRS] SAMPLES")
    flight = options.stairs_of(
        places[0] if len(places) == 2 else None,
        rise=rise,
        going=going,
        angle=angle,
        nosing_spacing=nosing_spacing,
        steps=steps,
    )
    requested = Question.in_one_posture(
        robot,
        flight,
        direction=direction,
        facing=facing,
        flippers=flippers,
        payload=payload,
        override=override,
    )
    limits = _limits(alarm_margin, clear_margin, alarm_time, clear_time, unjudged, horizon)
    watch = Monitor.of(requested, limits=limits, strict=strict)
    with (
        suppress(KeyboardInterrupt),
        opened(places[-1], follow=follow, nose_up=requested.nose_up) as samples,
    ):
        _follow(watch, samples, changes=changes, as_json=as_json)
    answer = watch.answer()
    echo(dumps(answer.to_dict()) if as_json else f"\n{answer}")
    raise typer.Exit(answer.exit_code)


def _follow(watch: "Monitor", samples: Iterable["Sample"], *, changes: bool, as_json: bool) -> None:
    """Print the state after each sample as it comes."""
    from kaidan.text.monitor import HEAD, row

    before = None
    for sample in samples:
        state = watch.feed(sample)
        if before is None and not as_json:
            echo(HEAD)
        if (state.alarm, state.status) != before or not changes:
            echo(dumps(state.model_dump(mode="json")) if as_json else row(state))
        before = (state.alarm, state.status)


def _limits(
    alarm_margin: str | None,
    clear_margin: str | None,
    alarm_time: str | None,
    clear_time: str | None,
    unjudged: int | None,
    horizon: str | None,
) -> "AlarmLimits":
    from kaidan.units import parse
    from kaidan.verbs.monitor import AlarmLimits

    texts = {
        "margin_on": (alarm_margin, "angle", "--alarm-margin"),
        "margin_off": (clear_margin, "angle", "--clear-margin"),
        "time_on": (alarm_time, "time", "--alarm-time"),
        "time_off": (clear_time, "time", "--clear-time"),
        "horizon": (horizon, "time", "--horizon"),
    }
    values = {
        name: parse(text, kind, option=option)
        for name, (text, kind, option) in texts.items()
        if text is not None
    }
    return AlarmLimits(**values, **({} if unjudged is None else {"unjudged_on": unjudged}))


@contextmanager
def opened(origin: str, *, follow: bool, nose_up: bool) -> Iterator[Iterator["Sample"]]:
    """Samples of a file or of standard input, as they come."""
    import io
    import sys

    from kaidan.verbs.monitor import open_samples
    from kaidan.verbs.monitor.samples import lines_of, samples_of

    if origin != "-":
        with open_samples(origin, follow=follow, nose_up=nose_up) as samples:
            yield samples
        return
    if isinstance(sys.stdin, io.TextIOWrapper):
        sys.stdin.reconfigure(encoding="utf-8", errors="replace")
    origin = "standard input"
    yield samples_of(lines_of(sys.stdin, origin=origin), origin=origin)
