r"""All poses at one place: where losing balance on purpose could lead (after Magid et al. 2010).

::

    height |  .    ridge: unstable    .
    of the |   \     .-.            /
    centroid    \___/   \____.____/      two stable poses, one unstable between them
           +---------------------------- inclination

Source: Magid, Tsubouchi, Koyanagi & Yoshida 2010, see `kaidan.literature.balance`.
"""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from kaidan import contact
from kaidan.errors import InputError
from kaidan.literature.balance import Balance
from kaidan.outline import Outline
from kaidan.terrain.profile import Profile

FARTHEST = math.radians(85.0)
"""Inclination up to which poses are looked for [rad]: the kernel settles within 90 degrees."""
APART = math.radians(0.5)
"""Inclinations closer than this are one pose [rad]: the kernel, letting down, may step over wells
as small."""
_STARTS = math.radians(2.0)


@dataclass(frozen=True, kw_only=True)
class Equilibrium:
    """A pose at a given place that gravity does not turn."""

    x: float
    z: float
    """Centroid [m]."""
    inclination: float
    """[rad]"""
    balance: Balance
    """Stable, or unstable: then a push to either side turns it to the next stable pose."""


def stable_poses(profile: Profile, outline: Outline, x: float) -> tuple[Equilibrium, ...]:
    """All poses at a place of the centroid that gravity does not turn, nose down to nose up.

    Stable poses and the unstable ones between them, on which the robot would have to be balanced:
    the choice that losing balance on purpose has, if somebody pushes.

    Parameters
    ----------
    profile : Profile
        Terrain.
    outline : Outline
        Robot in its posture.
    x : float
        Centroid [m].

    Returns
    -------
    tuple of Equilibrium
        Stable and unstable ones in turn; beyond an unstable one at the end it falls. Contacts do
        not slide: a pose is stable where the contact's lever turns it back. Poses that lean against
        the face of a riser are not among them, nor are poses beyond 85 degrees; two stable ones
        closer than 2 degrees may be taken for one.

    Raises
    ------
    InputError
        A place that is not a finite number.

    Examples
    --------
    >>> from kaidan.robot import Robot
    >>> level = Profile.of_points([(-2, 0), (2, 0)])
    >>> [pose.balance.value for pose in stable_poses(level, Outline.of(Robot.named("kenaf")), 0.0)]
    ['stable']
    """
    if not math.isfinite(x):
        raise InputError(f"x = {x:g} m is not a finite place")

    def settled(phi: float) -> tuple[float, float]:
        """Where it comes to rest [rad], infinite past 90 degrees, and at which height [m]."""
        pose = contact.settle(profile.points, outline.parts, x, phi, kinds=outline.kinds)
        rest = pose.inclination if pose.found else math.copysign(math.inf, pose.inclination)
        return float(rest), float(pose.z)

    starts = np.arange(-FARTHEST, FARTHEST + 1e-9, _STARTS).tolist()
    rests = [settled(start) for start in starts]
    ends = [k for k, (one, two) in enumerate(pairwise(rests)) if two[0] > one[0] + APART]
    found: list[Equilibrium] = []
    for first, last in pairwise([0, *(k + 1 for k in ends), len(rests)]):
        if first > 0:
            low, high, below = starts[first - 1], starts[first], rests[first - 1][0]
            while high - low > 1e-9:
                middle = 0.5 * (low + high)
                if settled(middle)[0] > below + APART:
                    high = middle
                else:
                    low = middle
            ridge = _height(profile, outline, x, low)
            found.append(Equilibrium(x=x, z=ridge, inclination=low, balance=Balance.UNSTABLE))
        # of starts that end within half a degree, the one that had the least way to go
        rest, z = min(
            zip(starts[first:last], rests[first:last], strict=True),
            key=lambda each: abs(each[0] - each[1][0]),
        )[1]
        if math.isfinite(rest):
            found.append(Equilibrium(x=x, z=z, inclination=rest, balance=Balance.STABLE))
    return tuple(found)


def _height(profile: Profile, outline: Outline, x: float, phi: float) -> float:
    return contact.resting_height(profile.points, outline.parts, x, phi, kinds=outline.kinds)
