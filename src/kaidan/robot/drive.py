"""Drive: what the motors and their controller can do."""

from typing import ClassVar

from pydantic import Field

from kaidan.sheet import Sheet, quantity


class Drive(Sheet):
    """Limits of the drive; what is not known is left out and then not judged."""

    label: ClassVar[str] = "robot: drive"

    max_speed: float | None = quantity("m/s", 0.001, 30.0, "largest speed", default=None)
    max_acceleration: float | None = quantity(
        "m/s^2", 0.001, 9.8, "largest acceleration the controller asks for", default=None
    )
    max_deceleration: float | None = quantity(
        "m/s^2", 0.001, 9.8, "largest deceleration the controller asks for", default=None
    )
    max_traction: float | None = quantity(
        "N", 1.0, 1e6, "largest sum of the tractive forces of both tracks", default=None
    )
    max_power: float | None = quantity(
        "W", 1.0, 1e6, "largest power at both sprockets", default=None
    )
    sprocket_radius: float | None = quantity(
        "m", 0.005, 0.6, "radius of the sprocket at the belt", default=None
    )
    efficiency: float = quantity("1", 0.05, 1.0, "efficiency from motors to tracks", default=1.0)
    rolling_resistance: float = quantity(
        "1", 0.0, 0.5, "resistance of the tracks over the normal force", default=0.0
    )
    acceleration_control: bool = Field(
        default=False,
        description="whether the acceleration can follow the position on the stairs; without it "
        "the paper's semi-unstable area E counts as unstable",
    )
