"""How a robot falls on the flight, in the stages of the paper's Fig. 20.

::

    1 parallel motion    the lowest contact lies under the flat, the body along the nosings
    2 round end          the lowest contact goes on to the arc of the end: the body turns
    3 largest load       as it turns, the load moves to the lowest contact
    4 release            the centroid stands over a contact, or what is left behind it lets go

The grousers' moment on the arc (LCM), which the paper counts among the stages, is not in a smooth
track: the allowance theta_M stands for it.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kaidan.climb import Climb, Phase
from kaidan.contact import TRACK
from kaidan.contact.gaps import on_flat
from kaidan.report.moves import Place, place_of

LEAST_TURN = math.radians(0.05)
"""Turn on the flight below which there is nothing to explain [rad]: half of what is printed."""


@dataclass(frozen=True)
class Stage:
    """One stage of a fall."""

    name: str
    """parallel motion, round end, largest load, release or held."""
    way_m: float
    """Arclength of the centroid's path [m]."""
    inclination_deg: float
    """Of the body, leading end up [deg]."""
    text: str
    """In words."""


def fall_of(found: Climb, leading: str) -> tuple[Stage, ...]:
    """Stages of the largest turn over the downhill end while traversing.

    Parameters
    ----------
    found : Climb
        The way.
    leading : str
        nose or tail.

    Returns
    -------
    tuple of Stage
        None where it does not turn by more than `LEAST_TURN`.
    """
    run = found.run
    rows = np.flatnonzero(found.phase_of_pose == Phase.TRAVERSE.value)
    if run.margins is None or len(rows) == 0:
        return ()
    sign = -1.0 if found.descending else 1.0
    contact, share = (5, _share(found, 3)) if found.descending else (4, _share(found, 1))
    trailing = "tail" if leading == "nose" else "nose"
    end = leading if found.descending else trailing
    tilt = sign * run.inclination
    last = int(rows[np.argmax(tilt[rows])])
    falls = _fall_to(found, sign)
    if falls is not None:
        last = run.row_before(float(run.releases[falls, 1]))
    flat = _under_flat(found, contact)
    first = last
    while first > rows[0] and not flat[first]:
        first -= 1
    if tilt[last] - tilt[first] < LEAST_TURN and falls is None:
        return ()
    loaded = first + int(np.argmax(share[first : last + 1]))

    def place(row: int) -> Place:
        return place_of(found, int(run.poses[row, contact]), leading)

    def stage(name: str, row: int, text: str) -> Stage:
        return Stage(name, float(run.s[row]), math.degrees(run.inclination[row]), text)

    on_arc = place(min(first + 1, last))
    stages = [
        stage(
            "parallel motion", first, f"along the nosings, the lowest contact {place(first).where}"
        )
    ]
    if last > first:
        turned = math.degrees(tilt[last] - tilt[first])
        stages += [
            stage(
                "round end",
                first + 1,
                f"{on_arc.where} is under the arc of the {end}; from here it turns by "
                f"{turned:.1f} deg",
            ),
            stage(
                "largest load",
                loaded,
                f"{100 * share[loaded]:.0f} % of the load on the lowest contact, "
                f"{place(loaded).where}",
            ),
        ]
    if falls is None:
        return (*stages, stage("held", last, f"{place(last).where} still holds: it turns back"))
    pivot = place_of(found, int(run.releases[falls, 2]), leading)
    text = f"the centroid has come over {pivot.where} and goes on behind it: "
    if run.releases[falls, 15] == 0.0:
        text += f"caught after {math.degrees(run.releases[falls, 9]):.1f} deg"
    else:
        text += "nothing catches it"
    return (*stages, stage("release", last, text))


def _share(found: Climb, column: int) -> NDArray[np.float64]:
    """Share of the normal forces that one of the two contacts carries [1]."""
    margins = found.run.margins
    assert margins is not None
    with np.errstate(invalid="ignore", divide="ignore"):
        share = margins[:, column] / (margins[:, 1] + margins[:, 3])
    return np.nan_to_num(share)


def _under_flat(found: Climb, contact: int) -> NDArray[np.bool_]:
    """Poses whose contact of a column lies under the flat of the main track."""
    run, kinds = found.run, found.outline.kinds
    under = np.zeros(len(run.poses), dtype=np.bool_)
    for row, pose in enumerate(run.poses):
        feature, x, z, phi = int(pose[contact]), float(pose[1]), float(pose[2]), float(pose[3])
        if feature & 3 == 0 and kinds[(feature >> 2) & 15] == TRACK:
            c, s = math.cos(phi), math.sin(phi)
            under[row] = on_flat(run.ground, run.body, feature, x, z, c, s)
    return under


def _fall_to(found: Climb, sign: float) -> int | None:
    """Row of the release over the downhill end, while traversing, that turned the farthest."""
    run, phases = found.run, found.phase_of_pose
    best = None
    for row, release in enumerate(run.releases):
        at = run.row_before(float(release[1]))
        if release[0] != sign or phases[at] != Phase.TRAVERSE.value:
            continue
        farther = best is None or release[9] > run.releases[best, 9]
        if release[15] != 0.0 or farther:
            best = row
            if release[15] != 0.0:
                break
    return best
