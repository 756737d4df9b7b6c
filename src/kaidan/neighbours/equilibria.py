r"""All poses at one place: where losing balance on purpose could lead (after Magid et al. 2010).

::

    height |  .    ridge: unstable    .
    of the |   \     .-.            /
    centroid    \___/   \____.____/      two stable poses, one unstable between them
           +---------------------------- inclination

References
----------
Magid, Tsubouchi, Koyanagi & Yoshida 2010, see `kaidan.neighbours.balance`.
"""

import math
from dataclasses import dataclass

import numpy as np

from kaidan import contact
from kaidan.contact.settling import touching
from kaidan.errors import InputError
from kaidan.neighbours.balance import Balance
from kaidan.outline import Outline
from kaidan.profile import Profile

_SETTLED = 1e-6
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


def stable_poses(
    profile: Profile, outline: Outline, x: float, *, compiled: bool | None = None
) -> tuple[Equilibrium, ...]:
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
    compiled : bool, optional
        See `kaidan.climb.climb`.

    Returns
    -------
    tuple of Equilibrium
        Stable and unstable ones in turn. Two stable poses closer than 2 degrees may be taken for
        one; poses beyond 85 degrees are not looked for.

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

    def settled(phi: float) -> contact.Settled:
        return contact.settle(
            profile.points, outline.parts, x, phi, kinds=outline.kinds, compile_kernel=compiled
        )

    starts = np.arange(math.radians(-85.0), math.radians(85.0) + 1e-9, _STARTS)
    found: list[Equilibrium] = []
    before: tuple[float, contact.Settled] | None = None
    for start in starts:
        here = settled(float(start))
        if not here.found:
            before = None
            continue
        if before is not None and here.inclination > before[1].inclination + _SETTLED:
            low, high = before[0], float(start)
            rest = before[1]
            while high - low > 1e-9:
                middle = 0.5 * (low + high)
                there = settled(middle)
                if there.found and there.inclination > rest.inclination + _SETTLED:
                    high = middle
                else:
                    low = middle
            found.append(
                Equilibrium(
                    x=x, z=_height(profile, outline, x, low), inclination=low,
                    balance=Balance.UNSTABLE,
                )
            )  # fmt: skip
        if not found or here.inclination > found[-1].inclination + _SETTLED:
            found.append(
                Equilibrium(
                    x=x,
                    z=float(here.z),
                    inclination=float(here.inclination),
                    balance=Balance.STABLE,
                )
            )
        before = (float(start), here)
    return tuple(found)


def _height(profile: Profile, outline: Outline, x: float, phi: float) -> float:
    z, _ = touching(
        contact.ground_table(profile.points),
        contact.body_table(outline.parts, outline.kinds),
        x, math.cos(phi), math.sin(phi),
    )  # fmt: skip
    return float(z)
