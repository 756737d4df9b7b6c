"""A robot that stands while its posture changes: its poses, one a posture; how belts slide."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from kaidan.contact.codes import Status
from kaidan.contact.door import stacked, zeros
from kaidan.contact.layout import Margin, Pose, Pull, Slide
from kaidan.contact.path import Path
from kaidan.contact.records import Body, Events, Ground, Margins, Poses, Rotations
from kaidan.contact.remembered import body_of, ground_of
from kaidan.contact.switch import kernel
from kaidan.contact.tables import FloatArray
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
    count, ground = len(parts), ground_of(terrain)
    bodies = stacked([body_of(each, kinds) for each in parts]).reshape(count, -1)
    poses, margins = zeros(Pose, count), zeros(Margin, count)
    stands = kernel().stand_in_turn(
        (ground, bodies.ravel()), bodies.shape[1], x, inclination, Pull(0.0, STANDARD_GRAVITY),
        poses, margins,
    )  # fmt: skip
    return Path(
        Status.OK if stands == count else Status.NO_START,
        Poses(poses[:stands]),
        Events.none(),
        Rotations.none(),
        Margins(margins[:stands]),
        Ground(ground),
        Body(bodies[0]),
        bodies=bodies[:stands] if stands else None,
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
    slides = zeros(Slide, max(len(path.poses) - 1, 0))
    if path.bodies is not None and len(slides):
        parts = path.bodies.shape[1]
        kernel().belt_slides(path.bodies.ravel(), parts, path.poses.table, slides)
    return np.stack([slides["rear"], slides["front"]], axis=-1)
