"""The options with which a command asks about one robot on one terrain, in one place."""

from collections.abc import Callable, Collection, Sequence
from inspect import Parameter, Signature, signature
from typing import TYPE_CHECKING, Any

from kaidan.cli import options

if TYPE_CHECKING:
    from kaidan.question import Question

Command = Callable[..., None]
_SHAPE = ("rise", "going", "angle", "nosing_spacing", "steps")


def question_options(
    robot: options.RobotName,
    stairs: options.TerrainName = None,
    points: options.PointsFile = None,
    uniform_across: options.UniformAcross = False,
    rise: options.Rise = None,
    going: options.Going = None,
    angle: options.Angle = None,
    nosing_spacing: options.NosingSpacing = None,
    steps: options.Steps = None,
    surface: options.SurfaceName = None,
    friction: options.Friction = None,
    acceleration: options.Acceleration = "0m/s2",
    speed: options.Speed = None,
    direction: options.Direction = None,
    facing: options.Facing = None,
    flippers: options.Flippers = None,
    flipper_tolerance: options.FlipperTolerance = None,
    payload: options.PayloadText = None,
    theta_d: options.ThetaD = None,
    theta_m: options.ThetaM = None,
    fall_reserve: options.FallReserve = None,
    override: options.Override = None,
    uncertainty: options.UncertaintyText = None,
    yaw: options.Yaw = "0deg",
    risk: options.Risk = 0.01,
    model: options.Model = "contact",
) -> None:
    """Only its signature counts: the options of a question."""


def question(*, without: Collection[str] = (), **defaults: str) -> Callable[[Command], Command]:
    """Give a command the options of a question; its first argument becomes their `Question`.

    without: options that the command does not have.
    """
    return shared((question_options,), question_of, without=without, **defaults)


def shared(
    declared: Sequence[Callable[..., None]],
    made: Callable[..., Any],
    *,
    without: Collection[str] = (),
    **defaults: Any,
) -> Callable[[Command], Command]:
    """Give a command options that others have too; its first argument becomes what they make.

    without, **defaults: as `question` has them.
    """
    given = {
        name: each.replace(default=defaults.get(name, each.default))
        for function in declared
        for name, each in signature(function).parameters.items()
        if name not in without
    }

    def decorate(command: Command) -> Command:
        own = list(signature(command).parameters.values())[1:]

        def run(**values: Any) -> None:
            command(made(**{name: values.pop(name) for name in given}), **values)

        # by name alone, so that one without a default may follow those with one
        both = [each.replace(kind=Parameter.KEYWORD_ONLY) for each in (*given.values(), *own)]
        run.__signature__ = Signature(both)  # type: ignore[attr-defined]
        run.__annotations__ = {each.name: each.annotation for each in both}
        run.__name__, run.__doc__ = command.__name__, command.__doc__
        return run

    return decorate


def question_of(robot: str, stairs: str | None, **values: Any) -> "Question":
    """Question of the options' values."""
    from kaidan.question import Question

    shape = {name: values.pop(name) for name in _SHAPE}
    terrain = options.terrain_of(stairs, values.pop("points", None), **shape)
    texts = {_NAMES.get(name, name): value for name, value in values.items() if value is not None}
    return Question.of(robot, terrain, **texts)


_NAMES = {"theta_m": "theta_M"}
"""Options whose name is another in a question."""
