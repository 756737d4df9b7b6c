"""Contacts of a pose with the forces that hold it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from kaidan.contact import Contact, pair_forces, spring_loads
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.traversal import Traverse

_ONE_PLANE = 1e-9
"""Difference of normals that is rounding [1]."""
_APART = 1e-5
"""Distance of points that are not one contact [m]."""


@dataclass(frozen=True)
class Force:
    """A contact of a pose with the force it carries, per mass of the robot."""

    point: tuple[float, float]
    """[m]"""
    normal: tuple[float, float]
    """Unit vector from the ground into the robot."""
    load: float
    """Normal force over mass [N/kg]; NaN where nothing can hold."""
    traction: float
    """Tangential force over mass, driving ahead positive [N/kg]."""


def contact_forces(traverse: Traverse, row: int, acceleration: float) -> tuple[Force, ...]:
    """Contacts of a pose and their forces.

    Those that press on one plane as equal springs: along it two may pull against each other with
    any force. Otherwise the pair that needs the least friction, in closed form, and the rest idle.

    acceleration: up the stairs [m/s^2].
    """
    path = traverse.path
    assert path.margins is not None
    place, psi = path.poses.placement(row), float(path.poses.path_direction[row])
    com, kappa = (place.x, place.z), float(path.margins.tilt[row])
    along = -acceleration if traverse.descending else acceleration
    gravity = math.sqrt(
        STANDARD_GRAVITY**2 + along**2 + 2 * STANDARD_GRAVITY * along * math.sin(psi)
    )
    touched = path.contacts_at(place)
    if len(touched) > 1 and np.ptp([each.normal[0] for each in touched]) < _ONE_PLANE:
        return _sprung(touched, com, kappa, gravity)
    pull = (gravity * kappa / math.hypot(1, kappa), gravity / math.hypot(1, kappa))
    pairs = [path.carrying(row)] + [
        tuple(sorted(pair))
        for pair in ((touched[i], touched[j]) for i in range(len(touched)) for j in range(i))
        if (pair[0].point[0] - place.x) * (pair[1].point[0] - place.x) <= 0
    ]
    solved = [pair_forces(one, two, com, pull) for one, two in pairs]
    needed = float(path.margins.required_friction[row])
    nearest = int(np.argmin([abs(found.required_friction - needed) for found in solved]))
    (_, n_1, t_1, n_2, t_2), (one, two) = solved[nearest], pairs[nearest]
    loaded = [
        Force(each.point, each.normal, float(n), float(t))
        for each, n, t in ((one, n_1, t_1), (two, n_2, t_2))
    ]
    idle = [
        Force(each.point, each.normal, 0.0, 0.0)
        for each in touched
        if all(math.dist(each.point, force.point) > _APART for force in loaded)
    ]
    return (*loaded, *idle)


def _sprung(
    contacts: Sequence[Contact], com: tuple[float, float], kappa: float, gravity: float
) -> tuple[Force, ...]:
    """Forces of contacts as equal springs, each along effective gravity."""
    loads = spring_loads(contacts, com, kappa, gravity)
    along, up = kappa / math.hypot(1, kappa), 1 / math.hypot(1, kappa)
    forces = []
    for each, load in zip(contacts, loads, strict=True):
        n_x, n_z = each.normal
        normal, traction = along * n_x + up * n_z, along * n_z - up * n_x
        forces.append(Force(each.point, each.normal, float(load * normal), float(load * traction)))
    return tuple(forces)
