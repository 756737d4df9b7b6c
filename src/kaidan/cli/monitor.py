"""``kaidan monitor``: margin, time to tip-over and alarm from samples of a file or a stream."""

from collections.abc import Callable, Iterator
from contextlib import suppress
from json import dumps
from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options
from kaidan.cli.tables import echo

if TYPE_CHECKING:
    from kaidan.verbs.monitor import AlarmLimits, Monitor, MonitorState, Sample

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
NoData = Annotated[
    str | None,
    typer.Option(
        help="Time without data at which the alarm is raised [0.2s or 3 periods, whichever is "
        "longer]; a source below 5 Hz needs it."
    ),
]
Resolution = Annotated[
    str | None,
    typer.Option(
        help="Resolution of the inclination, for a coarse sensor: same values at rest are not "
        "frozen [0deg]."
    ),
]
Horizon = Annotated[str | None, typer.Option(help="How far ahead it predicts [2s].")]
Strict = Annotated[
    bool, typer.Option("--strict", help="End at the first sample that is not in order.")
]
Follow = Annotated[
    bool, typer.Option("--follow", help="Wait at the end of the file for what is written next.")
]
Recorded = Annotated[
    bool,
    typer.Option(
        "--recorded", help="A pipe holds a recording: its stamps alone tell the time, no clock."
    ),
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
    no_data: NoData = None,
    resolution: Resolution = None,
    horizon: Horizon = None,
    strict: Strict = False,
    follow: Follow = False,
    recorded: Recorded = False,
    changes: Changes = False,
    as_json: AsJsonLines = False,
) -> None:
    """Watch ROBOT on STAIRS through its inertial sensor: how far from tipping over, and how soon.

    Inclination and its rate count nose up, acceleration (without gravity) and position up the
    stairs; position is 0 where a nosing meets the uphill tip of the flat. What is not known counts
    as the worst case. Rows that cannot be read are counted and left out. A sensor that is silent,
    frozen, half blind or without a clock is an alarm.

    Exit code: 0 no alarm, 1 the alarm was raised, 2 bad input or more than half of the samples not
    judged, 3 outside the model.
    """
    from kaidan.errors import InputError
    from kaidan.question import Question
    from kaidan.verbs.monitor import Monitor, open_samples
    from kaidan.verbs.monitor.sources import is_live

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
    limits = limits_of(
        margin_on=alarm_margin,
        margin_off=clear_margin,
        time_on=alarm_time,
        time_off=clear_time,
        no_data_on=no_data,
        resolution=resolution,
        horizon=horizon,
    )
    watch = Monitor.of(requested, limits=limits, strict=strict)
    say = _said(changes=changes, as_json=as_json)
    live = is_live(places[-1], follow=follow) and not recorded
    with (
        suppress(KeyboardInterrupt),
        open_samples(places[-1], follow=follow, nose_up=requested.nose_up) as samples,
    ):
        for state in _as_they_come(watch, samples) if live else map(watch.feed, samples):
            say(state)
    answer = watch.answer()
    echo(dumps(answer.to_dict()) if as_json else f"\n{answer}")
    raise typer.Exit(answer.exit_code)


def _as_they_come(watch: "Monitor", samples: "Iterator[Sample]") -> "Iterator[MonitorState]":
    """States of samples as they come, and of one that does not."""
    from kaidan.verbs.monitor.arrivals import Arrivals

    arrivals, due = Arrivals(samples), None
    while (came := arrivals.take(due)) is not None:
        for sample, at in came:
            state = watch.feed(sample, at)
            yield state
            due = state.due_s
        if not came and (missing := watch.overdue(arrivals.now())):
            yield missing
            due = None


def _said(*, changes: bool, as_json: bool) -> "Callable[[MonitorState], None]":
    """What prints a state."""
    from kaidan.text.monitor import HEAD, row

    before: tuple[object, ...] = ()

    def say(state: "MonitorState") -> None:
        nonlocal before
        if not before and not as_json:
            echo(HEAD)
        if (state.causes, state.status) != before or not changes:
            echo(dumps(state.model_dump(mode="json")) if as_json else row(state))
        before = (state.causes, state.status)

    return say


_LIMITS = {
    "margin_on": ("angle", "--alarm-margin"),
    "margin_off": ("angle", "--clear-margin"),
    "time_on": ("time", "--alarm-time"),
    "time_off": ("time", "--clear-time"),
    "no_data_on": ("time", "--no-data"),
    "resolution": ("angle", "--resolution"),
    "horizon": ("time", "--horizon"),
}
"""Kind of each limit, and the option that states it."""


def limits_of(**texts: str | None) -> "AlarmLimits":
    """Limits of the options that are given."""
    from kaidan.units import parse
    from kaidan.verbs.monitor import AlarmLimits

    given = {name: text for name, text in texts.items() if text is not None}
    return AlarmLimits(
        **{
            name: parse(text, _LIMITS[name][0], option=_LIMITS[name][1])
            for name, text in given.items()
        }
    )
