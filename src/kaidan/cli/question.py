"""The options with which a command asks about one robot on one terrain, in one place."""

from collections.abc import Callable, Collection
from inspect import Signature, signature
from typing import TYPE_CHECKING, Any

from kaidan.cli import options

if TYPE_CHECKING:
    from kaidan.assessment.case import Case

Command = Callable[..., None]
_SHAPE = ("rise", "going", "angle", "nosing_spacing", "steps")


def _options(
    robot: options.RobotName,
    stairs: options.TerrainName = None,
    points: options.PointsFile = None,
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
    facing: options.Facing = "nose-first",
    flippers: options.Flippers = "stowed",
    payload: options.PayloadText = None,
    theta_d: options.ThetaD = None,
    theta_m: options.ThetaM = None,
    override: options.Override = None,
    uncertainty: options.UncertaintyText = None,
    yaw: options.Yaw = "0deg",
    risk: options.Risk = 0.01,
) -> None:
    """Only its signature counts: the options of a question."""


def question(*, without: Collection[str] = ()) -> Callable[[Command], Command]:
    """Give a command the options of a question; its first argument becomes their `Case`.

    Parameters
    ----------
    without : collection of str
        Options that the command does not have.

    Returns
    -------
    callable
        Decorator.
    """

    def decorate(command: Command) -> Command:
        asked = {
            name: each for name, each in signature(_options).parameters.items()
            if name not in without
        }  # fmt: skip
        own = list(signature(command).parameters.values())[1:]

        def run(**values: Any) -> None:
            case = _case(**{name: values.pop(name) for name in asked})
            command(case, **values)

        both = [*asked.values(), *own]
        run.__signature__ = Signature(both)  # type: ignore[attr-defined]
        run.__annotations__ = {each.name: each.annotation for each in both}
        run.__name__, run.__doc__ = command.__name__, command.__doc__
        return run

    return decorate


def _case(robot: str, stairs: str | None, **values: Any) -> "Case":
    shape = {name: values.pop(name) for name in _SHAPE}
    terrain = options.terrain_of(stairs, values.get("points"), **shape)
    return options.case_from(robot, terrain, **values)
