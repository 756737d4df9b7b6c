"""Figures of a robot's sheet from its side view: track, idlers, belly, grousers, flippers."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from kaidan.readers.robots.belts import Belt
from kaidan.readers.robots.estimate import Figure
from kaidan.readers.robots.flippers import Flipper
from kaidan.readers.robots.gear import End, Gear
from kaidan.readers.robots.mechanism import Fault
from kaidan.readers.robots.side_view import SideView
from kaidan.readers.robots.silhouette import Piece, discs_of
from kaidan.text import robot_file as said

_UNEVEN = 0.002, 0.02
"""Difference of a left and a right flipper that is noted: length [m], share of the mass."""
_LEAST_RADIUS = 0.005
"""Least radius of a flipper's root that a sheet takes [m]."""


def figures_of_track(side: SideView, main: Sequence[Piece], gear: Gear) -> dict[str, Figure]:
    """Lengths of the tracks."""
    tracks = said.HOW_TRACKS[gear.how if gear.main else "flippers"]
    edge = said.LOWER_EDGE.format(how=tracks)
    found = {
        "track.flat_length": Figure(side.flat_length, edge),
        "com_from_front": Figure(side.com_from_front, f"{said.summed('')}, along that edge"),
        "com_height": Figure(side.com_height, f"{said.summed('')}, square to that edge"),
    }
    for end, radius in zip(("front", "rear"), side.radii, strict=True):
        how = said.END_WHEEL if radius else said.END_CORNER
        found[f"track.{end}_radius"] = Figure(radius, how.format(end=end))
    if not gear.main:
        found["track.gap"] = Figure(side.flat_length, said.PIVOTS.format(joint="the flippers"))
    if side.raised:
        wheels = [
            {"from_front": each.from_front, "height": each.height, "radius": each.radius}
            for each in side.raised
        ]
        found["track.wheels"] = Figure(wheels, said.IDLERS)
    return (
        found | _across(main) | _belly(side, gear) | _grousers(side, gear) | _over_all(side, gear)
    )


def figures_of_belt(belt: Belt) -> dict[str, Figure]:
    """What the file draws in place of a belt, and where its tracks have a gap."""
    found = {}
    if belt.assumed is not None:
        found["track.drawn_as"] = Figure(belt.assumed, said.DRAWN[belt.assumed])
    if belt.called and belt.gap:
        found["track.gap"] = Figure(belt.middle, said.BARE)
    return found


def _across(main: Sequence[Piece]) -> dict[str, Figure]:
    """Gauge and width of the tracks, from the longest shape of each side."""
    middle = (max(piece.left for piece in main) + min(piece.right for piece in main)) / 2
    left = [piece for piece in main if piece.right > middle]
    right = [piece for piece in main if piece.left < middle]
    if not left or not right:
        return {}
    one, other = (max(each, key=lambda piece: piece.length) for each in (left, right))
    gauge, width = one.middle - other.middle, one.left - one.right
    if gauge < 0.05 or width < 0.005:
        return {}
    return {"track.gauge": Figure(gauge, said.SIDES), "track.width": Figure(width, said.ONE_SIDE)}


def _over_all(side: SideView, gear: Gear) -> dict[str, Figure]:
    """Width over all shapes, and height where none of them is a mesh; flippers apart."""
    pieces = [*gear.main, *gear.grousers, *gear.rest, *gear.on_flippers]
    width = max(piece.left for piece in pieces) - min(piece.right for piece in pieces)
    found = {"width": Figure(width, said.OUTERMOST)}
    if not gear.body_meshes:
        still = [*gear.main, *gear.grousers, *gear.rest]
        _, height, radius = side.above(discs_of(still)).T
        if len(height):
            found["height"] = Figure(float((height + radius).max()), said.HIGHEST)
    return found


def _belly(side: SideView, gear: Gear) -> dict[str, Figure]:
    """Clearance below the body, where all of the body's shapes are known."""
    if gear.body_meshes or not gear.rest:
        return {}
    behind, height, radius = side.above(discs_of(gear.rest)).T
    over = (behind > 0.0) & (behind < side.flat_length)
    if not over.any():
        return {}
    clearance = float((height - radius)[over].min())
    return (
        {"track.belly_clearance": Figure(clearance, said.BELLY)} if 0.0 <= clearance <= 1.0 else {}
    )


def _grousers(side: SideView, gear: Gear) -> dict[str, Figure]:
    """Height and spacing of grousers that are modelled below the flat run."""
    low = []
    for piece in gear.grousers:
        behind, height, radius = side.above(piece.discs).T
        least = float((height - radius).min())
        if least < 0.0 and 0.0 <= behind.mean() <= side.flat_length and piece.middle > 0.0:
            low.append((float(behind.mean()), -least, float(np.ptp(behind))))
    if len(low) < 2:
        return {}
    places, heights, widths = np.array(sorted(low)).T
    found = {"belt": "grousers", "grouser_height": float(np.median(heights))}
    gaps = np.diff(places)
    spacing = float(np.median(gaps[gaps > 1e-4])) if (gaps > 1e-4).any() else 0.0
    if spacing > 0.0:
        found["grouser_spacing"] = spacing
        if 0.0005 <= (width := float(np.median(widths))) < spacing:
            found["grouser_tip_width"] = width
    return {f"track.{key}": Figure(value, said.GROUSERS) for key, value in found.items()}


def figures_of_flippers(
    side: SideView, flippers: Mapping[End, tuple[Flipper, ...]], faults: list[Fault]
) -> dict[str, Figure]:
    """Figures of each pair of flippers; what is doubtful is added to the faults."""
    found: dict[str, Figure] = {}
    for end, pair in flippers.items():
        found |= {f"{end}_flippers.{key}": each for key, each in _pair(side, end, pair).items()}
        if len(pair) == 1:
            faults.append(Fault("single", numbers={"end": end}))
        lengths, masses = [each.length for each in pair], [each.mass for each in pair]
        apart = max(lengths) - min(lengths), max(masses) - min(masses)
        if apart[0] > _UNEVEN[0] or apart[1] > _UNEVEN[1] * max(masses):
            numbers: dict[str, float | str] = {
                "end": end,
                "differ_mm": 1e3 * apart[0],
                "differ_kg": apart[1],
            }
            faults.append(Fault("uneven", numbers=numbers))
        if not all(each.round_ends for each in pair):
            faults.append(Fault("boxes", numbers={"end": end}))
    return found


def _pair(side: SideView, end: End, pair: Sequence[Flipper]) -> dict[str, Figure]:
    def mean(value: Any) -> float:
        return math.fsum(value(each) for each in pair) / len(pair)

    joint = pair[0].joints.joint.name
    pivots = side.above(np.array([[*each.joints.pivot[[0, 2]], 0.0] for each in pair]))
    behind, height, _ = pivots.mean(axis=0).tolist()
    inset = behind if end == "front" else side.flat_length - behind
    mass = math.fsum(each.mass for each in pair)
    pivot, tip = said.PIVOTS.format(joint=joint), said.TIP.format(joint=joint)
    root = (said.ROOT if pair[0].round_ends else said.HALVES).format(joint=joint)
    found = {
        "length": Figure(mean(lambda each: each.length), tip),
        "root_radius": Figure(max(mean(lambda each: each.root_radius), _LEAST_RADIUS), root),
        "tip_radius": Figure(mean(lambda each: each.tip_radius), tip),
        "pivot_inset": Figure(inset, pivot),
        "pivot_height": Figure(height, pivot),
        "mass": Figure(mass, said.OF_BOTH),
        "com_from_pivot": Figure(max(mean(lambda each: each.com_from_pivot), 0.0), said.OF_BOTH),
    }
    speed = pair[0].joints.joint.speed
    if speed is not None and 0.001 <= speed <= 50.0:
        found["max_speed"] = Figure(speed, said.LIMIT.format(joint=joint))
    return found
