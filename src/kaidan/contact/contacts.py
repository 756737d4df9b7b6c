"""Contacts of one pose and the forces that they carry."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from kaidan.contact.codes import PartKind
from kaidan.contact.columns import (
    CONTACT_COLUMNS,
    CONTACT_FEATURE,
    CONTACT_GAP,
    CONTACT_KIND,
    CONTACT_N_X,
    CONTACT_N_Z,
    CONTACT_X,
    CONTACT_Z,
)
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


class PairForces(NamedTuple):
    """Forces of two contacts at the least friction [N/kg]; traction drives ahead positive."""

    required_friction: float
    first_load: float
    first_traction: float
    second_load: float
    second_traction: float


def contacts_of(
    ground: FloatArray, body: FloatArray, x: float, z: float, inclination: float, touch: float
) -> tuple[Contact, ...]:
    """Contacts of a pose: every feature whose gap is at most ``touch`` [m], each point once."""
    table = np.empty((MOST, CONTACT_COLUMNS))
    count, _ = kernel().contacts_at(ground, body, x, z, inclination, touch, table, 0)
    return tuple(
        Contact(
            point=(row[CONTACT_X], row[CONTACT_Z]),
            normal=(row[CONTACT_N_X], row[CONTACT_N_Z]),
            feature=int(row[CONTACT_FEATURE]),
            gap=row[CONTACT_GAP],
            kind=PartKind(int(row[CONTACT_KIND])),
        )
        for row in table[:count].tolist()
    )


def pair_forces(
    first: Contact, second: Contact, com: tuple[float, float], pull: tuple[float, float]
) -> PairForces:
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
    PairForces
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
    return PairForces(
        *kernel().two_contact_forces(
            *first.point, *first.normal, *second.point, *second.normal, *com, *pull
        )
    )


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
    table = np.zeros((len(contacts), CONTACT_COLUMNS))
    table[:, [CONTACT_X, CONTACT_Z]] = [each.point for each in contacts]
    loads = np.zeros(len(contacts))
    kernel().shared_loads(table, len(contacts), *com, tilt, gravity, loads)
    return loads
