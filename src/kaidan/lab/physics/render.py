"""Pictures of a trial, drawn by MuJoCo without a display."""

import os
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.errors import KaidanError
from kaidan.films import FRAMES_PER_SECOND
from kaidan.physics.engine import engine, quiet
from kaidan.physics.model import Model, model_of
from kaidan.physics.outcome import TrialLog

Image = NDArray[np.uint8]

SIZE = (960, 544)
"""Width and height of a picture [pixels], multiples of 16 for films."""
NO_DRAWING = (
    "pictures need OpenGL without a display (EGL or OSMesa), which does not work here "
    "({reason}): apt-get install libegl1 libgl1-mesa-dri, or libosmesa6; where mujoco is "
    "imported before kaidan.physics, set MUJOCO_GL=egl or osmesa"
)


class Stage:
    """A model with a camera beside it that keeps up with the robot; use it in a ``with``."""

    def __init__(self, model: Model, size: tuple[int, int] = SIZE) -> None:
        mujoco = engine()
        self.mujoco, self.model = mujoco, model
        self.data = mujoco.MjData(model.compiled)
        try:
            self.renderer = mujoco.Renderer(model.compiled, height=size[1], width=size[0])
        except Exception as error:  # whatever OpenGL has to complain about
            reason = f"MUJOCO_GL={os.environ.get('MUJOCO_GL', 'not set')}: {error}"
            raise KaidanError(NO_DRAWING.format(reason=reason)) from None
        self.camera: Any = mujoco.MjvCamera()
        back, ahead = model.course.outline.reach
        self.camera.distance = 2.6 * (back + ahead)
        self.camera.azimuth, self.camera.elevation = 105.0, -12.0

    def __enter__(self) -> "Stage":
        return self

    def __exit__(self, *_: object) -> None:
        self.renderer.close()

    def draw(self, pose: NDArray[np.float64]) -> Image:
        """Picture of a state of the model, shape (height, width, 3)."""
        self.data.qpos[:] = pose
        self.mujoco.mj_forward(self.model.compiled, self.data)
        self.camera.lookat[:] = self.data.body("robot").xipos
        self.renderer.update_scene(self.data, self.camera)
        return np.asarray(self.renderer.render()).copy()


def frames(log: TrialLog) -> Iterator[Image]:
    """Pictures of a trial in its own time, `kaidan.films.FRAMES_PER_SECOND`."""
    if len(log) == 0:
        return
    time = log.columns["time_s"]
    moments = np.arange(time[0], time[-1] + 1e-9, 1.0 / FRAMES_PER_SECOND)
    rows = np.searchsorted(time, moments - 1e-9)
    with quiet(), Stage(model_of(log.result.spec)) as stage:
        for row in rows:
            yield stage.draw(log.poses[min(int(row), len(log) - 1)])


def picture(log: TrialLog) -> Image:
    """Picture of a trial at its largest inclination, or of its start if it never began."""
    with quiet(), Stage(model_of(log.result.spec)) as stage:
        if len(log) == 0:
            return stage.draw(stage.model.compiled.qpos0)
        extra = log.columns["extra_deg"]
        standing = np.where(extra < 45.0, extra, -np.inf)
        return stage.draw(log.poses[int(np.argmax(standing))])
