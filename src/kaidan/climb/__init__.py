"""The whole climb, or descent, of a robot on any profile: entering, traversing, landing.

The quasi-static contact model (`kaidan.contact`) in the words of robots and stairs. The kernel
drives towards +x; going down, the profile is reflected so that the way still leads there.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.climb.exchanges import exchanges_of
from kaidan.climb.happenings import Happening as Happening
from kaidan.climb.happenings import happenings_of
from kaidan.climb.phases import Phase as Phase
from kaidan.climb.phases import ends_of_way, phases_of
from kaidan.climb.worst import PhaseFound as PhaseFound
from kaidan.climb.worst import turns_about_stays, worst_of_phases
from kaidan.errors import InputError
from kaidan.outline import Outline
from kaidan.profile import Profile

SLACK = 2e-3
"""How far below the flat a nosing may lie and still count as on it [m], for the criterion of no
rotation: hand measurement step by step is good to 2.8 mm, rubber tracks yield more."""


PATIENCE = 5.0
"""Time for which the plain kernel is waited for where the compiled one is at hand [s]."""
LONG = 60.0
"""Time beyond which it is not waited for at all [s]."""
A_POSE, A_POINT = 8e-5, 3.5e-5
"""Time of the plain kernel for a pose, and for each point of the ground under the robot [s]."""
LONGEST = 400_000
"""Points and poses above which a traverse is refused: half a minute compiled."""


_CLEARANCE = 0.05


@dataclass(frozen=True)
class Climb:
    """What the contact model found; see `climb`."""

    status: contact.Status
    descending: bool
    profile: Profile
    """As driven: reflected when descending."""
    outline: Outline
    """As driven: x towards the leading end."""
    run: contact.Traverse
    criterion: contact.GradeOne
    """The paper's criterion of no rotation (grade one)."""
    phases: tuple[PhaseFound, ...]

    @cached_property
    def events(self) -> NDArray[np.float64]:
        """Events (k, 8) of the run, and nosings that the flat reaches and leaves in between."""
        both = np.vstack([self.run.events, exchanges_of(self.run)])
        return both[np.argsort(both[:, 1], kind="stable")]

    @cached_property
    def happenings(self) -> tuple[Happening, ...]:
        """The same in words, one for each row."""
        return happenings_of(
            self.run, self.events, self.profile, self.phase_of_pose, self.descending
        )

    @property
    def arrived(self) -> bool:
        """Grade two: the whole robot stands on the other landing."""
        return self.status is contact.Status.OK

    @property
    def held_with_momentum(self) -> bool:
        """Grade three: no release topples with the momentum gained."""
        return self.run.held_with_momentum

    @property
    def phase_of_pose(self) -> NDArray[np.str_]:
        """Phase of each pose of the run."""
        return phases_of(self.run, self.profile, self.descending, self.outline.stance.flat_length)

    @property
    def downhill_margin(self) -> float:
        """Margin of slope against turning about the lowest contact that stays [rad]; NaN: none."""
        one = self.criterion
        return one.front_margin_angle if self.descending else one.back_margin_angle

    @property
    def uphill_margin(self) -> float:
        """Margin of slope against turning about the highest contact that stays [rad]; NaN: none."""
        one = self.criterion
        return one.back_margin_angle if self.descending else one.front_margin_angle

    @property
    def centroid_margin(self) -> float:
        """How far the centroid may move along the flat before it turns [m]; NaN: no criterion."""
        return float(np.fmin(self.criterion.back_margin, self.criterion.front_margin))


def climb(
    profile: Profile,
    outline: Outline,
    *,
    descending: bool = False,
    facing: Literal["nose-first", "tail-first"] = "nose-first",
    acceleration: float = 0.0,
    with_margins: bool = True,
    with_energy: bool = False,
    step: float = contact.STEP,
    compiled: bool | None = None,
) -> Climb:
    """Drive a robot from landing to landing.

    Parameters
    ----------
    profile : Profile
        Terrain from the lower to the upper landing. The landings are taken as long enough.
    outline : Outline
        Robot, x towards its nose.
    descending : bool
        From the upper landing to the lower one.
    facing : {"nose-first", "tail-first"}
        Which end leads.
    acceleration : float
        Acceleration UP the stairs [m/s^2].
    with_margins : bool
        Work out forces and margins at every pose.
    with_energy : bool
        The energy margin along the flow too at every pose, not only the least of each phase.
    step : float
        Arclength between poses [m]; events are located whatever it is.
    compiled : bool, optional
        Whether to use the compiled kernel; None: if numba is loaded already, or if the profile is
        long and numba is there to be loaded.

    Returns
    -------
    Climb
        A robot that falls is an answer, not an error.

    Raises
    ------
    InputError
        A profile too long for the kernel at hand.
    """
    way = profile.reflected() if descending else profile
    body = outline if facing == "nose-first" else outline.turned_round()
    back, ahead = body.reach
    compiled = _kernel_for(way, back + ahead, step, compiled)
    first, last = ends_of_way(way)
    clear = back + ahead + 1.0
    ends = way.points[[0, -1]] + np.array([[-clear, 0.0], [clear, 0.0]])
    ground = np.vstack([ends[0], way.points, ends[1]])
    along = -acceleration if descending else acceleration
    run = contact.traverse(
        ground, body.parts, first - ahead - _CLEARANCE, last + back + _CLEARANCE,
        kinds=body.kinds, acceleration=along, gyration=body.gyration,
        step=step, with_margins=with_margins, with_energy=with_energy, compile_kernel=compiled,
    )  # fmt: skip
    criterion = contact.grade_one(
        ground, body.parts, kinds=body.kinds, acceleration=along, slack=SLACK,
        compile_kernel=compiled,
    )  # fmt: skip
    room = body.stance.flat_length
    phase = phases_of(run, way, descending, room)
    phases: tuple[PhaseFound, ...] = ()
    if run.margins is not None:
        turns = turns_about_stays(criterion, body, along)
        phases = worst_of_phases(run, way, phase, descending, turns, room, compiled)
    return Climb(
        status=run.status,
        descending=descending,
        profile=way,
        outline=body,
        run=run,
        criterion=criterion,
        phases=phases,
    )


def _kernel_for(profile: Profile, reach: float, step: float, compiled: bool | None) -> bool | None:
    """Whether to compile: a long or a dense profile is not driven by the plain kernel."""
    points, length = len(profile.points), float(np.abs(np.diff(profile.points, axis=0)).sum())
    span = float(profile.points[-1, 0] - profile.points[0, 0])
    poses = length / step
    if points + poses > LONGEST:
        raise InputError(
            f"profile: {points} points over {span:.0f} m are more than one traverse takes: "
            "cut or thin it (in millimetres?)"
        )
    if compiled is not None or contact.numba_is_loaded():
        return compiled
    takes = poses * (A_POSE + A_POINT * points * min(1.0, reach / span))
    if takes > PATIENCE and contact.numba_is_installed():
        return True
    if takes > LONG:
        raise InputError(
            f"profile: {points} points over {span:.0f} m are too many without the compiled "
            "kernel: pip install 'kaidan[fast]', or cut or thin the profile"
        )
    return None
