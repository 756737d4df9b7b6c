"""``kaidan monitor``: margin, time to tip-over and alarm from samples of a file or a stream."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options
from kaidan.cli.tables import echo

if TYPE_CHECKING:
    from kaidan.neighbours.tipover_monitor import AlarmLimits, Monitor, Reading

Places = Annotated[
    list[str],
    typer.Argument(
        metavar="[STAIRS] SAMPLES",
        help="Stairs (catalogue name or TOML file) unless options give their shape; then a CSV "
        "file, or - for standard input, with columns t, inclination, inclination_rate, "
        "acceleration and perhaps position: s, rad, rad/s, m/s^2, m.",
    ),
]
AlarmMargin = Annotated[
    str | None, typer.Option(help="Margin below which the alarm is raised [5.2deg].")
]
ClearMargin = Annotated[
    str | None, typer.Option(help="Margin above which it may be taken back [7.2deg].")
]
AlarmTime = Annotated[
    str | None, typer.Option(help="Time to tip-over below which the alarm is raised [0.5s].")
]
ClearTime = Annotated[
    str | None, typer.Option(help="Time to tip-over above which it may be taken back [1s].")
]
Horizon = Annotated[str | None, typer.Option(help="How far ahead is predicted [2s].")]
Strict = Annotated[
    bool, typer.Option("--strict", help="Refuse a bad sample instead of passing over it.")
]
Changes = Annotated[
    bool, typer.Option("--changes", help="Only samples at which alarm or status change.")
]
AsJsonLines = Annotated[bool, typer.Option("--json", help="Print one JSON object a sample.")]

_HEAD = f"{'t [s]':>10}  {'margin [deg]':>12}  {'over its':<8}  {'tips in [s]':>11}  alarm"


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
    facing: options.Facing = "nose-first",
    flippers: options.Flippers = "stowed",
    payload: options.PayloadText = None,
    override: options.Override = None,
    alarm_margin: AlarmMargin = None,
    clear_margin: ClearMargin = None,
    alarm_time: AlarmTime = None,
    clear_time: ClearTime = None,
    horizon: Horizon = None,
    strict: Strict = False,
    changes: Changes = False,
    as_json: AsJsonLines = False,
) -> None:
    """Watch ROBOT on STAIRS through its inertial sensor: how far from tipping over, and how soon.

    After Liu & Liu 2009. Inclination and its rate count nose up, acceleration (gravity taken off)
    and position up the stairs; position is 0 where a nosing meets the uphill tip of the flat.

    Exit code: 0 no alarm, 1 the alarm was raised, 2 bad input or no sample that could be judged,
    3 outside the model.
    """
    from kaidan.errors import InputError
    from kaidan.neighbours.samples import samples_of
    from kaidan.neighbours.tipover_monitor import Monitor

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
    case = options.case_from(
        robot,
        flight,
        direction=direction,
        facing=facing,
        flippers=flippers,
        payload=payload,
        override=override,
    )
    watch = Monitor(
        case.robot,
        case.stairs,
        posture=case.posture,
        payload=case.payload,
        nose="up" if case.nose_up else "down",
        limits=_limits(alarm_margin, clear_margin, alarm_time, clear_time, horizon),
        strict=strict,
    )
    before: tuple[bool, str] | None = None
    totals = _Totals()
    origin = places[-1]
    with _lines(origin) as lines:
        for sample in samples_of(lines, origin="standard input" if origin == "-" else origin):
            reading = watch.feed(sample)
            if totals.count == 0 and not as_json:
                echo(_HEAD)
            now = (reading.alarm, str(reading.status))
            if now != before or not changes:
                echo(_json(reading) if as_json else _row(reading))
            before = now
            totals.add(reading)
    if totals.count == 0:
        raise InputError(f"{origin}: holds no samples")
    if totals.judged == 0 and watch.inside_model:
        first = next(iter(totals.messages.values()))
        raise InputError(f"{origin}: no sample could be judged; the first: {first}")
    if not as_json:
        echo(totals.text(watch))
    raise typer.Exit(1 if totals.raised else 0 if watch.inside_model else 3)


def _limits(
    alarm_margin: str | None,
    clear_margin: str | None,
    alarm_time: str | None,
    clear_time: str | None,
    horizon: str | None,
) -> "AlarmLimits":
    from kaidan.neighbours.tipover_monitor import AlarmLimits
    from kaidan.units import parse

    texts = {
        "margin_on": (alarm_margin, "angle", "--alarm-margin"),
        "margin_off": (clear_margin, "angle", "--clear-margin"),
        "time_on": (alarm_time, "time", "--alarm-time"),
        "time_off": (clear_time, "time", "--clear-time"),
        "horizon": (horizon, "time", "--horizon"),
    }
    return AlarmLimits(
        **{
            name: parse(text, kind, option=option)
            for name, (text, kind, option) in texts.items()
            if text is not None
        }
    )


@contextmanager
def _lines(origin: str) -> Iterator[Iterator[str]]:
    """Lines of a file or of standard input, as they come."""
    import sys

    from kaidan.errors import InputError

    try:
        if origin == "-":
            yield iter(sys.stdin)
        else:
            with open(origin, encoding="utf-8") as file:
                yield iter(file)
    except UnicodeDecodeError:
        raise InputError(f"{origin}: cannot be read: not a text file") from None
    except (FileNotFoundError, IsADirectoryError, PermissionError) as error:
        raise InputError(f"{origin}: cannot be read: {error.strerror}") from None


class _Totals:
    """What is told at the end."""

    def __init__(self) -> None:
        self.count = self.judged = self.raised = 0
        self.first_alarm = math.nan
        self.messages: dict[str, str] = {}
        """First message of each status of samples that were not judged."""
        self.least: Reading | None = None
        self._alarm = False

    def add(self, reading: "Reading") -> None:
        self.count += 1
        if math.isnan(reading.margin):
            self.messages.setdefault(reading.status, reading.message)
            return
        self.judged += 1
        if reading.alarm and not self._alarm:
            self.raised += 1
            if self.raised == 1:
                self.first_alarm = reading.t
        self._alarm = reading.alarm
        if self.least is None or reading.margin < self.least.margin:
            self.least = reading

    def text(self, watch: "Monitor") -> str:
        head = f"\n{self.count} samples, {self.count - self.judged} not judged"
        if not watch.inside_model:
            return f"{head}\nOUTSIDE THE MODEL  {self.messages.get('outside-model', '')}".rstrip()
        assert self.least is not None
        least = f"{math.degrees(self.least.margin):+.1f} deg at t = {self.least.t:.3f} s"
        times = {0: "never raised", 1: "raised once"}.get(
            self.raised, f"raised {self.raised} times"
        )
        first = f", first at t = {self.first_alarm:.3f} s" if self.raised else ""
        return f"{head}; least margin {least}; alarm {times}{first}"


def _row(reading: "Reading") -> str:
    t = f"{reading.t:.3f}" if math.isfinite(reading.t) else "-"
    alarm = "ALARM" if reading.alarm else "no"
    if math.isnan(reading.margin):
        why = f"{reading.status}: {reading.message}"
        return f"{t:>10}  {'-':>12}  {'-':<8}  {'-':>11}  {alarm:<5}  {why}"
    end = "downhill" if reading.margin_downhill <= reading.margin_uphill else "uphill"
    time = f"{reading.time_to_tip:.2f}" if math.isfinite(reading.time_to_tip) else "-"
    return f"{t:>10}  {math.degrees(reading.margin):>+12.1f}  {end:<8}  {time:>11}  {alarm}"


def _json(reading: "Reading") -> str:
    import json

    figures = {
        "t_s": reading.t,
        "margin_deg": math.degrees(reading.margin),
        "margin_downhill_deg": math.degrees(reading.margin_downhill),
        "margin_uphill_deg": math.degrees(reading.margin_uphill),
        "centroid_margin_mm": 1e3 * reading.centroid_margin,
        "time_to_tip_s": reading.time_to_tip,
    }
    plain = {name: x if math.isfinite(x) else None for name, x in figures.items()}
    words = {"row": reading.row, "status": reading.status, "message": reading.message}
    return json.dumps({**words, **plain, "alarm": reading.alarm}, allow_nan=False)
