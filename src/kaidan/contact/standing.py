"""A robot that stands while its posture changes: its poses, one a posture; how belts slide."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from kaidan.contact.codes import Status
from kaidan.contact.columns import (
    BODY_COLUMNS,
    EVENT_COLUMNS,
    POINT_COLUMNS,
    POSE_COLUMNS,
    ROTATION_COLUMNS,
)
from kaidan.contact.margin_records import Margins
from kaidan.contact.path import TOUCH, Path
from kaidan.contact.records import Body, Events, Ground, Poses, Rotations
from kaidan.contact.remembered import body_of, ground_of
from kaidan.contact.switch import kernel
from kaidan.contact.tables import FloatArray, margin_tables
from kaidan.mechanics import STANDARD_GRAVITY


def stand_in_turn(
    terrain: ArrayLike,
    parts: Sequence[ArrayLike],
    kinds: ArrayLike,
    x: float,
    inclination: float,
) -> Path:
    """Stand in one posture after the other, the tracks where they are along the ground.

    Parameters
    ----------
    terrain
        Points (n, 2) [m].
    parts, kinds
        Underside (m, 6) of the robot in each posture [m], and what each part is.
    x, inclination
        Centroid [m] and inclination [rad] from which it settles in the first posture.

    Returns
    -------
    Path
        A pose for each posture with its margins, up to the last in which the robot stands; neither
        events nor rotations.

    Examples
    --------
    >>> flat = [[-0.274, -0.011, 0.06, 0.196, -0.011, 0.06]]
    >>> found = stand_in_turn([[0, 0], [4, 0]], [flat, flat], [0], 2.0, 0.0)
    >>> found.z.round(6).tolist()
    [0.071, 0.071]
    """
    ground, bodies = ground_of(terrain), [body_of(each, kinds) for each in parts]
    count = len(bodies)
    poses = np.empty((count, POSE_COLUMNS))
    margins, found = margin_tables(count)
    stands = kernel().stand_in_turn(
        ground, np.concatenate(bodies), np.cumsum([len(each) for each in bodies]), x,
        inclination, STANDARD_GRAVITY, TOUCH, poses, margins, found, np.zeros(1, dtype=np.int64),
    )  # fmt: skip
    return Path(
        Status.OK if stands == count else Status.NO_START,
        Poses(poses[:stands]),
        Events(np.empty((0, EVENT_COLUMNS))),
        Rotations(np.empty((0, ROTATION_COLUMNS))),
        Margins(margins[:stands]),
        Ground(ground),
        Body(bodies[0]),
        bodies=np.stack(bodies[:stands]) if stands else None,
    )


def belt_slides(path: Path) -> FloatArray:
    """Way along the ground by which the belts at both contacts move ahead, from pose to pose.

    Parameters
    ----------
    path
        Of `stand_in_turn`.

    Returns
    -------
    ndarray (poses - 1, 2)
        At the rear and at the front contact [m]; none where the contact is steeper than 45 degrees,
        which holds no robot in its place.
    """
    slides = np.empty((max(len(path.poses) - 1, 0), POINT_COLUMNS))
    if path.bodies is not None and len(slides):
        bodies = path.bodies.reshape(-1, BODY_COLUMNS)
        kernel().belt_slides(bodies, path.bodies.shape[1], path.poses.table, slides)
    return slides
