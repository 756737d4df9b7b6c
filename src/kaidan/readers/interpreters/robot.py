"""What a robot description means: the figures of a data sheet, or why there are none."""

import math
from collections.abc import Mapping
from pathlib import PurePath

import numpy as np

from kaidan.errors import InputError
from kaidan.readers.estimate import Found, Refusal
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import Axis
from kaidan.readers.robots.belts import Belt, belt_of
from kaidan.readers.robots.estimate import Figure, RobotEstimate
from kaidan.readers.robots.figures import (
    figures_of_belt,
    figures_of_flippers,
    figures_of_track,
)
from kaidan.readers.robots.flippers import Flipper, flippers_of, posed, root_pieces
from kaidan.readers.robots.gear import End, Gear, gear_of
from kaidan.readers.robots.mechanism import Array, Fault, MassProperties, Mechanism, Placed
from kaidan.readers.robots.side_view import SideView, side_view
from kaidan.readers.robots.silhouette import Piece
from kaidan.readers.sentences import robot_file as said

UPRIGHT = math.pi / 2
"""Angle to which flippers are raised for the centroid [rad]."""
NEEDED = ("track.flat_length", "com_from_front", "com_height")
"""Figures without which no sheet can be."""
_OFF_MIDDLE = 0.010, 0.04
"""Distance of the centroid from the middle, in metres and as a share of the gauge, from which it is
doubtful."""
_INCLINED = math.radians(5.0), math.radians(80.0)
"""Inclination of the base that is a pose, and neither an error of drawing nor another up axis."""
_SLOPING = math.radians(0.3)


def found(contents: Mechanism, hints: Hints) -> Found:
    """Robot of a mechanism, or why it is none."""
    stated = contents.checked_angles(hints.joints)
    turned = _turned(hints.up or "+z", hints.forward or "+x")
    as_is = Placed(contents, turned, stated)
    faults = [*contents.faults, *_of_links(contents)]
    if hints.up is None and (level := _level(as_is)) is not None:
        as_is, fault = level
        faults.append(fault)
    gear = gear_of(as_is)
    flippers = flippers_of(as_is, gear)
    angles, poses = _raised(flippers, stated, faults)
    placed = Placed(contents, as_is.turned, stated | poses)
    whole = placed.mass_properties()
    main = gear.main or root_pieces(placed, flippers)
    centroid = (float(whole.centroid[0]), float(whole.centroid[2]))
    side = side_view(main, centroid)
    figures = _of_masses(whole, said.posture(stated, _degrees(angles)))
    belt = belt_of(side, gear) if side is not None and gear.main else None
    if side is not None:
        figures |= figures_of_track(side, main, gear)
        figures |= figures_of_flippers(side, flippers, faults)
    if belt is not None:
        figures |= figures_of_belt(belt)
    figures |= {key: Figure(value, said.STATED) for key, value in hints.figures.items()}
    if contents.max_speed is not None and "drive.max_speed" not in figures:
        figures["drive.max_speed"] = Figure(contents.max_speed, said.DECLARED)
    faults += _of_gear(gear, flippers, side, hints.forward or "+x")
    faults += [] if belt is None or "track.belt" in figures else _of_belt(belt)
    faults += _of_centroid(whole, figures, main)
    provenance = contents.provenance
    why, numbers = _refused(contents, whole, gear, side, belt, hints.figures)
    if why:
        return Found(provenance, refusals=(Refusal(why, numbers, provenance),), contents=contents)
    estimate = RobotEstimate(
        name=PurePath(provenance.path).stem[:60] or "robot",
        provenance=provenance,
        figures=figures,
        placed=placed,
        whole=whole,
        gear=gear,
        side=side,
        as_in_file=_as_in_file(as_is, gear),
        faults=tuple(faults),
        angles={end: angle for end, angle in angles.items() if f"{end}_flippers.length" in figures},
    )
    return Found(provenance, robots=(estimate,), contents=contents)


def _turned(up: Axis, forward: Axis) -> Array:
    """Rotation from the file's frame to x forward, y left, z up, shape (3, 3)."""
    z, x = (_unit(axis) for axis in (up, forward))
    if abs(z @ x) > 0.5:
        raise InputError(f"hints: forward = {forward} and up = {up} are along one axis")
    return np.array([x, np.cross(z, x), z])


def _level(as_is: Placed) -> tuple[Placed, Fault] | None:
    """Robot in the frame of its base, where the file has that inclined; None: it has it level."""
    mechanism = as_is.mechanism
    base = next(name for name in mechanism.links if name not in mechanism.held_by)
    turned = mechanism.frames(as_is.angles)[base][:3, :3]
    slope = math.acos(min(1.0, max(-1.0, float(turned[2, 2]))))
    if not _INCLINED[0] < slope < _INCLINED[1]:
        return None
    fault = Fault("own-frame", base, {"slope_deg": math.degrees(slope)})
    return Placed(mechanism, as_is.turned @ turned.T, as_is.angles), fault


def _unit(axis: Axis) -> Array:
    return np.asarray(np.eye(3)["xyz".index(axis[1])] * (1.0 if axis[0] == "+" else -1.0))


def _raised(
    flippers: Mapping[End, tuple[Flipper, ...]], stated: Mapping[str, float], faults: list[Fault]
) -> tuple[dict[End, float], dict[str, float]]:
    """Angle of the flippers of each end, and of their joints: upright, unless one is stated."""
    angles: dict[End, float] = {}
    poses: dict[str, float] = {}
    for end, pair in flippers.items():
        own = posed(pair, UPRIGHT)
        if any(each.joints.joint.name in stated for each in pair):
            angles[end] = pair[0].angle
        elif len(own) < len(pair):
            angles[end] = pair[0].angle
            numbers: dict[str, float | str] = {"end": end, "angle_deg": math.degrees(pair[0].angle)}
            faults.append(Fault("limits", numbers=numbers))
        else:
            angles[end] = UPRIGHT
            poses |= own
    return angles, poses


def _of_masses(whole: MassProperties, at: str) -> dict[str, Figure]:
    """Figures that the masses alone give."""
    if whole.mass <= 0.0:
        return {}
    found = {"mass": Figure(whole.mass, said.summed(at))}
    if whole.inertia[1, 1] > 0.0:
        found["inertia"] = Figure(float(whole.inertia[1, 1]), said.summed(at))
    return found


def _as_in_file(placed: Placed, gear: Gear) -> dict[str, float]:
    """Lengths of tracks and flippers together, joints as in the file."""
    if not gear.on_flippers:
        return {}
    centroid = placed.mass_properties().centroid
    view = side_view([*gear.main, *gear.on_flippers], (float(centroid[0]), float(centroid[2])))
    if view is None:
        return {}
    return {
        "flat_length": view.flat_length,
        "com_from_front": view.com_from_front,
        "com_height": view.com_height,
        "front_radius": view.radii[0],
        "rear_radius": view.radii[1],
    }


def _of_links(mechanism: Mechanism) -> list[Fault]:
    """Faults of single links."""
    faults = []
    for link in mechanism.links.values():
        stated = Fault("no-mass", link.name) not in mechanism.faults
        if link.mass == 0.0 and any(shape.collides for shape in link.shapes) and stated:
            faults.append(Fault("zero-mass", link.name))
        if link.mass > 0.0 and link.inertia.any():
            low, middle, high = np.linalg.eigvalsh(link.inertia)
            if low < -1e-9 * high or high > (low + middle) * (1 + 1e-3):
                faults.append(Fault("impossible-inertia", link.name))
    roots = [name for name in mechanism.links if name not in mechanism.held_by]
    heavy = [name for name in roots if any(mechanism.links[one].mass for one in
             mechanism.subtree(name))]  # fmt: skip
    return faults + [Fault("apart", name) for name in heavy[1:]]


def _of_gear(
    gear: Gear, flippers: Mapping[End, tuple[Flipper, ...]], side: SideView | None, forward: str
) -> list[Fault]:
    """Faults of the tracks."""
    faults = [Fault("mesh-tracks", name) for name in gear.meshes]
    faults += [Fault("belly-unknown", name) for name in gear.body_meshes]
    faults += [Fault("seen-only", name) for name in gear.seen_only]
    if not gear.main and flippers:
        faults.append(Fault("flippers-only"))
    elif gear.how == "everything":
        faults.append(Fault("everything"))
    faults += [Fault("locked", name) for name in gear.locked]
    if side is None:
        return faults
    for end, radius in zip(("front", "rear"), side.radii, strict=True):
        if radius == 0.0:
            faults.append(Fault("corners", numbers={"end": end}))
    if abs(side.slope) > _SLOPING:
        faults.append(Fault("sloping", numbers={"slope_deg": math.degrees(side.slope)}))
    if not 0.0 <= side.com_from_front <= side.flat_length:
        faults.append(Fault("outside", numbers={"forward": forward}))
    return faults


def _of_belt(belt: Belt) -> list[Fault]:
    """What is assumed of the belt of the tracks."""
    return [] if belt.assumed is None else [Fault(f"{belt.assumed}-for-belt")]


def _of_centroid(
    whole: MassProperties, figures: Mapping[str, Figure], main: tuple[Piece, ...]
) -> list[Fault]:
    """Whether the centroid lies off the middle of the tracks."""
    if whole.mass <= 0.0 or not main:
        return []
    middle = (max(piece.left for piece in main) + min(piece.right for piece in main)) / 2
    aside = float(whole.centroid[1]) - middle
    gauge = figures["track.gauge"].value if "track.gauge" in figures else 0.0
    if abs(aside) <= max(_OFF_MIDDLE[0], _OFF_MIDDLE[1] * gauge):
        return []
    side = "left" if aside > 0 else "right"
    return [Fault("off-middle", numbers={"aside_mm": 1e3 * abs(aside), "side": side})]


def _refused(
    mechanism: Mechanism,
    whole: MassProperties,
    gear: Gear,
    side: SideView | None,
    belt: Belt | None,
    stated: Mapping[str, float | str],
) -> tuple[str, dict[str, float | str]]:
    """Why there is no sheet, and what was found; nothing where there is one."""
    numbers: dict[str, float | str] = {
        "links": len(mechanism.links), "mass_kg": whole.mass, "names": said.listed(gear.meshes),
    }  # fmt: skip
    if "track.belt" not in stated:
        if gear.how == "everything" and gear.how_flippers != "named":
            return "no-track", {}
        if belt is not None and belt.gap and not belt.called:
            return "wheels", {"radius_mm": 1e3 * belt.radius, "gap_mm": 1e3 * belt.gap}
    if all(key in stated for key in NEEDED):
        return "", {}
    if whole.mass <= 0.0 and not {"com_from_front", "com_height"} <= stated.keys():
        return "massless", numbers
    if side is None and not gear.main and gear.meshes:
        return "mesh-tracks", numbers
    if side is None:
        return "no-flat-run", numbers
    return "", {}


def _degrees(angles: Mapping[End, float]) -> dict[str, float]:
    return {end: math.degrees(angle) for end, angle in angles.items()}
