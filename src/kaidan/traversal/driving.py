"""What a robot drives over from where to where, and its underside on a flight."""

import math
from collections.abc import Sequence
from functools import lru_cache
from itertools import compress
from operator import itemgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.errors import InputError
from kaidan.outline import Disc, Outline
from kaidan.robot.robot import IN_LINE
from kaidan.terrain.profile import Profile
from kaidan.traversal.criterion import Criterion, Tread
from kaidan.traversal.phases import REMEMBERED, uneven_span
from kaidan.traversal.static_criterion import static_criterion

Array = NDArray[np.float64]

LONG = 60.0
"""Time beyond which the plain kernel is not waited for [s]."""
LONGEST = 400_000
"""Points and poses above which a traverse is refused: half a minute compiled."""
CLEARANCE = 0.05
"""Way on level ground before the first and behind the last contact with the flight [m]."""
MANY = 100
"""Nosings above which what the criterion says is not remembered."""
ROBOTS = 512
"""Robots of which it is."""
ROUNDING = 1e-12
"""Height above the flat that is none [m]."""


def span(
    driven: Profile, body: Outline, start: contact.Placement | None, until: float | None
) -> tuple[float, float]:
    """Where the centroid starts and ends [m]."""
    first, last = uneven_span(driven)
    return (
        first - body.lead - CLEARANCE if start is None else start.x,
        last + body.trail + CLEARANCE if until is None else until,
    )


def ground_for(driven: Profile, bodies: Sequence[Outline]) -> Array:
    """Points of a profile whose landings are as long as these bodies take [m]."""
    # whole metres: one ground for most bodies
    return _lengthened(driven, max(math.ceil(sum(body.reach) + 1.0) for body in bodies))


@lru_cache(maxsize=REMEMBERED)
def _lengthened(driven: Profile, clear: int) -> Array:
    ends = driven.points[[0, -1]] + np.array([[-clear, 0.0], [clear, 0.0]])
    return np.vstack([ends[0], driven.points, ends[1]])


def way(
    driven: Profile, body: Outline, start: contact.Placement | None, until: float | None
) -> dict[str, Any]:
    """Arguments of `kaidan.contact.traverse` for a robot's way over a profile."""
    x_start, x_end = span(driven, body, start, until)
    return {
        "terrain": ground_for(driven, [body]),
        "parts": body.parts,
        "kinds": body.kinds,
        "x_start": x_start,
        "x_end": x_end,
        "inclination": 0.0 if start is None else start.inclination,
        "gyration": body.gyration,
    }


def criterion_of(driven: Profile, body: Outline, along: float) -> tuple[Tread, Criterion]:
    """Underside on the flight and what the criterion says, uphill being where nosings rise.

    along: acceleration along the path [m/s^2].
    """
    tread, nosings = tread_of(body), driven.nosings
    if driven.falls:
        tread, nosings, along = tread.mirrored(), driven.reflected().nosings, -along
    if len(nosings) > MANY:
        return tread, static_criterion(nosings, tread, acceleration=along)
    return tread, _criterion(nosings.tobytes(), tread, along)


@lru_cache(maxsize=ROBOTS)
def _criterion(nosings: bytes, tread: Tread, along: float) -> Criterion:
    """The same, remembered: each part of a flight has the same."""
    return static_criterion(np.frombuffer(nosings).reshape(-1, 2), tread, acceleration=along)


@lru_cache(maxsize=ROBOTS)
def tread_of(body: Outline) -> Tread:
    """Underside of a robot on a flight that rises towards +x."""
    stance = body.stance
    (_, _, last), (first, _, radius) = _flat_ends(body)
    level, tracks = _level(body), (body.kinds == contact.TRACK).tolist()
    flats = zip(level[::2], level[1::2], tracks, strict=True)
    return Tread(
        L=stance.flat_length,
        C_L=first,
        C_N=stance.com_height,
        R=radius,
        R_downhill=last,
        gyration=body.gyration,
        whole=sum(map(all, flats)) == 1,
    )


def _level(body: Outline) -> list[bool]:
    """Of each disc of the parts whether its lower edge lies in the line of the flat."""
    level = []
    for one, two in zip(body.discs[::2], body.discs[1::2], strict=True):
        most = IN_LINE * abs(complex(one[0] - two[0], one[1] - two[1])) + ROUNDING
        level += [abs(z - r + body.stance.com_height) <= most for _, z, r in (one, two)]
    return level


def _flat_ends(body: Outline) -> tuple[Disc, Disc]:
    """Rear and front disc of the flat, of those in its line."""
    discs, level = body.discs, _level(body)
    on = list(compress(discs[::2] + discs[1::2], level[::2] + level[1::2]))
    return min(on, key=itemgetter(0)), max(on, key=itemgetter(0))


def whole_of(tread: Tread, criterion: Criterion, body: Outline) -> bool:
    """Whether one flat carries all along on the flight, so that the criterion judges there."""
    return criterion.holds is not None and is_whole(tread, body)


def is_whole(tread: Tread, body: Outline) -> bool:
    """Whether one flat carries all along on a flight, however long that is."""
    return tread.whole and not body.stance.tips_below and not _rocks_onto_flippers(body)


@lru_cache(maxsize=ROBOTS)
def _rocks_onto_flippers(body: Outline) -> bool:
    """Whether by rocking about an end of the flat the robot may come to stand on a flipper.

    The flat ends at a kink there, and what lies beyond it carries as on a low nosing.
    """
    flippers = [
        each
        for part, kind in enumerate(body.kinds.tolist())
        if kind == contact.FLIPPER
        for each in body.discs[2 * part : 2 * part + 2]
    ]
    if not flippers:
        return False
    (last, *_), (first, *_) = _flat_ends(body)
    c, s = math.cos(contact.ROCKING), math.sin(contact.ROCKING)
    for x, z, radius in flippers:
        beyond = max(x - first, last - x)
        if beyond > 0.0 and (z + body.stance.com_height) * c - beyond * s - radius <= 0.0:
            return True
    return False


@lru_cache(maxsize=REMEMBERED)
def _extent(profile: Profile) -> tuple[float, float]:
    """Length of a profile, and its height up and down in all [m]."""
    x, z = profile.points.T
    return float(np.ptp(x)), float(np.abs(np.diff(z)).sum())


def refuse_too_long(
    profile: Profile, body: Outline, span: tuple[float, float], step: float
) -> None:
    """Refuse a profile that the kernel in use cannot be waited for."""
    points, (wide, climbed) = len(profile.points), _extent(profile)
    if points + (span[1] - span[0] + climbed) / step > LONGEST:
        raise InputError(
            f"profile: {points} points over {wide:.0f} m are more than one traverse takes: "
            "cut or thin it (in millimetres?)"
        )
    if contact.kernel_in_use() == "native":
        return
    if contact.plain_seconds(profile.points, body.parts, *span, step) > LONG:
        raise InputError(
            f"profile: {points} points over {wide:.0f} m are too many without the native "
            "kernel (`kaidan doctor` says why it is not there): cut or thin the profile"
        )
