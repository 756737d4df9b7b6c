"""What the person knows of a file and the file does not say."""

from typing import ClassVar, Self

from pydantic import Field

from kaidan.readers.kinds import Axis, Unit
from kaidan.sheet import Sheet, model_validator, quantity


class Hints(Sheet):
    """What the person states of a file; each overrides what the file says."""

    label: ClassVar[str] = "hints"

    unit: Unit | None = Field(default=None, description="unit of the file's lengths")
    up: Axis | None = Field(default=None, description="axis of the file that points up")
    crop: tuple[float, float, float, float, float, float] | None = Field(
        default=None,
        description="only what is within: smallest x, y, z, then largest, in the file's frame and "
        "unit",
    )
    range_error: float | None = quantity(
        "1", 0.0, 0.1, "standard error of measured distances, as a share of them", default=None
    )
    gravity: float | None = quantity(
        "rad", 0.0, 0.35, "standard error of the file's up axis against gravity", default=None
    )
    viewpoint: tuple[float, float, float] | None = Field(
        default=None, description="where the sensor stood, in the file's frame and unit"
    )
    resolution: float | None = quantity(
        "m", 1e-4, 10.0, "side of a cell of an elevation map that does not say it", default=None
    )
    forward: Axis | None = Field(
        default=None, description="axis of the file that points to the robot's front; +x without"
    )
    joints: dict[str, float] = Field(
        default={}, description="angles of a robot's joints [rad], or ways [m], by their names"
    )
    figures: dict[str, float | str] = Field(
        default={},
        description="figures of a robot's sheet that replace those of the file, such as "
        "track.flat_length, in SI",
    )
    element: str = Field(
        default="", description="part of the file: a GlobalId, a topic, a scan, a link"
    )

    @model_validator(mode="after")
    def _a_box(self) -> Self:
        if self.crop is not None:
            for axis, low, high in zip("xyz", self.crop[:3], self.crop[3:], strict=True):
                if not low < high:
                    raise self.refuse(f"crop: {axis} from {low:g} to {high:g} is empty")
        return self
