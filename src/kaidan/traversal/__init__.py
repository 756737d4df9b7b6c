"""A robot's traverse of any profile, up or down: entering, traversing, landing.

The quasi-static contact model (`kaidan.contact`) in the words of robots and stairs. The kernel
drives towards +x; going down, the profile is reflected so that the path still leads there.
"""

from typing import Literal

from kaidan import contact
from kaidan.outline import Outline
from kaidan.terrain.profile import Profile
from kaidan.traversal.driving import criterion_of as criterion_of
from kaidan.traversal.driving import refuse_too_long, way, whole_of
from kaidan.traversal.events import TraverseEvent as TraverseEvent
from kaidan.traversal.extremes import PhaseExtremes as PhaseExtremes
from kaidan.traversal.passage import FirstRock as FirstRock
from kaidan.traversal.passage import Traverse as Traverse
from kaidan.traversal.phases import Phase as Phase
from kaidan.traversal.phases import phases_of
from kaidan.traversal.rotations import Chain as Chain
from kaidan.traversal.rotations import Rotation as Rotation
from kaidan.traversal.tilting import Fall as Fall


def traverse(
    profile: Profile,
    outline: Outline,
    *,
    descending: bool = False,
    facing: Literal["nose-first", "tail-first"] = "nose-first",
    acceleration: float = 0.0,
    with_margins: bool = True,
    with_energy: bool = False,
    step: float = contact.STEP,
    start: contact.Placement | None = None,
    until: float | None = None,
    sought: tuple[float, ...] | None = None,
) -> Traverse:
    """Drive a robot from landing to landing, or over a part of it.

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
    start : contact.Placement, optional
        Where it begins: a pose from which the robot settles, in the terrain as driven (reflected
        when descending), the leading end up; before the flight without one.
    until : float, optional
        Where the centroid ends, likewise [m]; beyond the flight without one.
    sought : tuple of float, optional
        Tilts to the fall of which alone it counts whether it is beyond them, and not where it falls
        [rad]; the tilt is found without them.

    Returns
    -------
    Traverse
        A robot that falls is an answer, not an error.

    Raises
    ------
    InputError
        A profile too long for the kernel at hand.
    """
    driven = profile.reflected() if descending else profile
    body = outline if facing == "nose-first" else outline.turned_round()
    along = -acceleration if descending else acceleration
    tread, criterion = criterion_of(driven, body, along)
    whole = whole_of(tread, criterion, body)
    there = way(driven, body, start, until)
    x_start, x_end = there["x_start"], there["x_end"]
    if whole and (start is not None or until is not None):
        criterion = criterion.within(*((-x_end, -x_start) if driven.falls else (x_start, x_end)))
    refuse_too_long(driven, body, (x_start, x_end), step)
    path = contact.traverse(
        **there, acceleration=along, step=step, with_margins=with_margins,
        with_energy=with_energy,
    )  # fmt: skip
    return Traverse(
        status=path.status,
        descending=descending,
        profile=driven,
        outline=body,
        acceleration=along,
        path=path,
        tread=tread,
        criterion=criterion,
        whole=whole,
        phase_of_pose=phases_of(path, driven, descending, body.stance.flat_length),
        start=start,
        until=until,
        step=step,
        sought=sought,
    )
