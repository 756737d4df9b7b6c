"""Contacts of one pose and the forces that they carry."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from kaidan.contact.codes import PartKind
from kaidan.contact.door import Records, zeros
from kaidan.contact.layout import Forces, Touching
from kaidan.contact.switch import kernel
from kaidan.contact.tables import FloatArray

MOST = 32
"""Contacts of a pose at most."""


class Contact(NamedTuple):
    """One contact of a pose."""

    point: tuple[float, float]
    """[m]"""
    normal: tuple[float, float]
    """Unit vector into the robot."""
    feature: int
    """What touches what, read by `Feature.of`."""
    gap: float
    """[m]"""
    kind: PartKind
    """Of the part."""


def contacts_of(
    scene: tuple[Records, Records], x: float, z: float, inclination: float, touch: float
) -> tuple[Contact, ...]:
    """Contacts of a pose: every feature whose gap is at most ``touch`` [m], each point once."""
    table = zeros(Touching, MOST)
    count = kernel().contacts_at(scene, x, z, inclination, touch, table)
    return tuple(
        Contact((x, z), (n_x, n_z), feature, gap, PartKind(kind))
        for feature, x, z, n_x, n_z, gap, kind in table[:count].tolist()
    )


def pair_forces(
    first: Contact, second: Contact, com: tuple[float, float], pull: tuple[float, float]
) -> Forces:
    """Least friction with which two contacts hold the robot, and the forces that do it.

    Parameters
    ----------
    first, second
        Contacts.
    com
        Centroid [m].
    pull
        Sum of the contact forces, that is minus effective gravity [N/kg].

    Returns
    -------
    Forces
        The friction is infinite if none suffices; forces are NaN where it is only approached by
        an ever growing inner force.

    Examples
    --------
    >>> rear = Contact((0.0, 0.0), (0.0, 1.0), 0, 0.0, PartKind.TRACK)
    >>> front = Contact((1.0, 0.0), (0.0, 1.0), 0, 0.0, PartKind.TRACK)
    >>> found = pair_forces(rear, front, (0.25, 0.1), (0.0, 9.8))
    >>> found.first_load, found.second_load
    (7.35, 2.45)
    """
    one, two = ((*each.point, *each.normal) for each in (first, second))
    return Forces(*kernel().two_contact_forces(one, two, *com, *pull))


def spring_loads(
    contacts: Sequence[Contact], com: tuple[float, float], tilt: float, gravity: float
) -> FloatArray:
    """Share of each contact in the effective weight, as equal springs [N/kg].

    Parameters
    ----------
    contacts
        At most 32, which press on one plane.
    com
        Centroid [m].
    tilt
        Tilt of effective gravity.
    gravity
        Effective gravity [m/s^2].

    Returns
    -------
    ndarray (k,)
        Along effective gravity.
    """
    table = zeros(Touching, len(contacts))
    table["x"] = [each.point[0] for each in contacts]
    table["z"] = [each.point[1] for each in contacts]
    loads = np.zeros(len(contacts))
    kernel().shared_loads(table, *com, tilt, gravity, loads)
    return loads
