"""Which links of a robot are its tracks and which its flippers, and how that is known."""

import math
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from kaidan.readers.robots.mechanism import Array, Joint, Mechanism, Placed
from kaidan.readers.robots.silhouette import Piece, pieces_of

End = Literal["front", "rear"]

_TRACK = re.compile(
    r"(?:^|[_\W\d])(?:left|right|main|l|r)?_?(?:tracks?|belts?|crawlers?|caterpillars?|treads?)"
    r"(?:$|[_\W\d])",
    re.IGNORECASE,
)
_WHEEL = re.compile(r"wheel|sprocket|idler|roller|pulley|(?:^|[_\W\d])tire|bogie", re.IGNORECASE)
_FLIPPER = re.compile(r"flipper|sub_?track|arm_?track|paddle|swing_?arm", re.IGNORECASE)
_GROUSER = re.compile(r"grouser|cleat|(?:^|[_\W\d])lugs?(?:$|[_\W\d])", re.IGNORECASE)
_ACROSS = math.cos(math.radians(5.0))
_LEAST_RANGE = math.radians(20.0)
"""Range below which a joint is none that moves a flipper [rad]."""
_ELONGATED = 1.4
"""Reach over the root's radius from which a turning part is no wheel."""
_NOT_APART = 0.02
"""Pivots of a pair lie within this of each other, seen from the side [m]."""
_ALIKE_BOXES = 8
"""Boxes of one size on one link from which they are grousers."""
_LARGEST_GROUSER = 0.06
"""Largest edge along the belt of a box that may be a grouser [m]."""


@dataclass(frozen=True, eq=False)
class FlipperJoint:
    """The joint of one flipper, and what hangs on it."""

    joint: Joint
    pivot: Array
    """In the robot's frame, shape (3,) [m]."""
    sense: float
    """1 where a larger angle of the joint turns it from x towards z, else -1."""
    links: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Gear:
    """What a robot stands on."""

    main: tuple[Piece, ...]
    """Of the main tracks, and of flippers that have no travel."""
    called: tuple[Piece, ...]
    """Those of them that the file calls or declares tracks: belts run over them."""
    grousers: tuple[Piece, ...]
    flippers: dict[End, tuple[FlipperJoint, ...]]
    on_flippers: tuple[Piece, ...]
    """Of all flippers."""
    rest: tuple[Piece, ...]
    """Of the body."""
    how: str
    """How the tracks were found: "declared", "named", "turning", "shapes" or "everything"."""
    how_flippers: str
    """How the flippers were found: "named" or "shaped"; empty: there are none."""
    locked: tuple[str, ...]
    """Joints that are called flippers and have no travel."""
    meshes: tuple[str, ...]
    """Links of the tracks that have meshes alone, which are not opened."""
    body_meshes: tuple[str, ...]
    """Other links with meshes for contact."""
    seen_only: tuple[str, ...]
    """Links of the tracks that have shapes for the eye alone."""

    @property
    def wheels(self) -> tuple[Piece, ...]:
        """Wheels of the main tracks."""
        return tuple(piece for piece in self.main if piece.is_wheel)


def gear_of(placed: Placed) -> Gear:
    """Tracks and flippers of a robot as the file has it."""
    mechanism = placed.mechanism
    flippers, how_flippers = _flippers(placed)
    moved = {name for pair in flippers.values() for each in pair for name in each.links}
    others = [name for name in mechanism.links if name not in moved]
    locked = _locked(placed, moved)
    fixed = {name for joint in locked for name in mechanism.subtree(joint.child)}
    declared = [name for name in mechanism.tracks if name in others]
    named = [name for name in others if name in fixed or _is_named_track(mechanism, name)]
    turning = [name for name in others if _turns(placed, name)]
    links = list(dict.fromkeys([*declared, *named, *turning]))
    how = "declared" if declared else "named" if named else "turning" if turning else "everything"
    rest = pieces_of(placed, [name for name in others if name not in links])
    pieces = pieces_of(placed, links)
    if not links and not flippers:
        called = [_is_called_gear(piece.shape.name) for piece in rest]
        how = "shapes" if any(called) else how
        chosen = [each or not any(called) for each in called]
        pieces = tuple(piece for piece, yes in zip(rest, chosen, strict=True) if yes)
        rest = tuple(piece for piece, yes in zip(rest, chosen, strict=True) if not yes)
        links = [] if pieces else others
    alike = Counter((piece.link, piece.shape.size) for piece in pieces)
    standing_out = [_is_grouser(piece, alike) for piece in pieces]
    main = tuple(piece for piece, out in zip(pieces, standing_out, strict=True) if not out)
    words = {*declared, *named}
    return Gear(
        main=main,
        called=tuple(
            each for each in main if each.link in words or _is_called_track(each.shape.name)
        ),
        grousers=tuple(piece for piece, out in zip(pieces, standing_out, strict=True) if out),
        flippers=flippers,
        on_flippers=pieces_of(placed, [name for name in mechanism.links if name in moved]),
        rest=rest,
        how=how,
        how_flippers=how_flippers,
        locked=tuple(joint.name for joint in locked),
        meshes=tuple(name for name in links if _has_only_meshes(mechanism, name)),
        body_meshes=tuple(
            name for name in others if name not in links and _has_mesh(mechanism, name)
        ),
        seen_only=tuple(
            name
            for name in links
            if not any(shape.collides for shape in mechanism.links[name].shapes)
            and any(shape.kind != "mesh" for shape in mechanism.links[name].shapes)
        ),
    )


def _is_named_track(mechanism: Mechanism, name: str) -> bool:
    return bool(_TRACK.search(name)) and bool(mechanism.links[name].shapes)


def _is_called_gear(name: str) -> bool:
    """Whether a shape is called a track, a wheel or a flipper."""
    return _is_called_track(name) or bool(_WHEEL.search(name))


def _is_called_track(name: str) -> bool:
    """Whether a shape is called something that a belt runs over."""
    return any(each.search(name) for each in (_TRACK, _FLIPPER))


def _turns(placed: Placed, name: str) -> bool:
    """Whether a link is a wheel: it turns about the lateral axis or is called one, and is round."""
    joint = placed.mechanism.held_by.get(name)
    if joint is None:
        return False
    round_ones = [piece for piece in pieces_of(placed, [name]) if piece.is_wheel]
    turning = joint.kind == "hinge" and abs(placed.lateral(joint)) > _ACROSS
    endless = joint.limits[1] - joint.limits[0] > 4 * math.pi
    return bool(round_ones) and ((turning and endless) or bool(_WHEEL.search(name)))


def _flippers(placed: Placed) -> tuple[dict[End, tuple[FlipperJoint, ...]], str]:
    """Flippers by the end that they are at, and how they were found."""
    swings = [
        joint
        for joint in placed.mechanism.moving.values()
        if joint.kind == "hinge" and abs(placed.lateral(joint)) > _ACROSS and _has_travel(joint)
    ]
    named = [each for each in swings if _is_called_flipper(each)]
    inner = {name for joint in named for name in placed.mechanism.subtree(joint.child)[1:]}
    chosen = [joint for joint in named if joint.child not in inner]
    how = "named"
    if not chosen:
        how = "shaped"
        long = [joint for joint in swings if _is_long(placed, joint)]
        chosen = [one for one in long if any(_mirrored(one, other, placed) for other in long)]
    made = [_flipper(placed, joint) for joint in chosen]
    made = [each for each in made if pieces_of(placed, each.links)]
    if not made:
        return {}, ""
    x = np.array([each.pivot[0] for each in made])
    middle = _middle(placed, {name for each in made for name in each.links})
    if middle is None:
        middle = float((x.max() + x.min()) / 2)
    ends: dict[End, tuple[FlipperJoint, ...]] = {
        "front": tuple(each for each in made if each.pivot[0] >= middle),
        "rear": tuple(each for each in made if each.pivot[0] < middle),
    }
    return {end: pair for end, pair in ends.items() if pair}, how


def _locked(placed: Placed, moved: set[str]) -> list[Joint]:
    """Joints that are called flippers, hold a long part and have no travel, the outermost ones."""
    mechanism = placed.mechanism
    found: dict[str, Joint] = {}
    for joint in mechanism.joints:
        within = mechanism.subtree(joint.child) if _is_called_flipper(joint) else ()
        still = joint.kind != "slide" and joint.follows is None and not _has_travel(joint)
        if within and still and moved.isdisjoint(within) and _is_long(placed, joint):
            found[joint.child] = joint
    inner = {name for child in found for name in mechanism.subtree(child)[1:]}
    return [joint for child, joint in found.items() if child not in inner]


def _is_called_flipper(joint: Joint) -> bool:
    return bool(_FLIPPER.search(joint.name) or _FLIPPER.search(joint.child))


def _has_travel(joint: Joint) -> bool:
    return joint.kind == "hinge" and joint.limits[1] - joint.limits[0] > _LEAST_RANGE


def _flipper(placed: Placed, joint: Joint) -> FlipperJoint:
    pivot = placed.pivot(joint)
    sense = -1.0 if placed.lateral(joint) > 0 else 1.0  # about y turns z towards x
    return FlipperJoint(joint, pivot, sense, placed.mechanism.subtree(joint.child))


def _is_long(placed: Placed, joint: Joint) -> bool:
    """Whether what turns reaches much farther to one side of its axis than to the other."""
    pieces = pieces_of(placed, placed.mechanism.subtree(joint.child))
    if not pieces:
        return False
    x, _, z = placed.pivot(joint)
    discs = np.concatenate([piece.discs for piece in pieces])
    away = discs[:, :2] - [x, z]
    reach = np.hypot(away[:, 0], away[:, 1]) + discs[:, 2]
    farthest = away[int(np.argmax(reach))]
    way = farthest / max(float(np.hypot(*farthest)), 1e-9)
    behind = float((discs[:, 2] - away @ way).max())
    return float(reach.max()) > _ELONGATED * max(behind, 1e-3)


def _mirrored(one: Joint, other: Joint, placed: Placed) -> bool:
    """Whether two joints are a left and a right one."""
    a = placed.pivot(one)
    b = placed.pivot(other)
    apart = abs(a[1] + b[1]) <= _NOT_APART and abs(a[1] - b[1]) > 4 * _NOT_APART
    return bool(apart and math.hypot(a[0] - b[0], a[2] - b[2]) <= _NOT_APART)


def _middle(placed: Placed, moved: set[str]) -> float | None:
    """Middle of the tracks along x, flippers apart [m]; None: there are none."""
    mechanism = placed.mechanism
    links = [
        name
        for name in mechanism.links
        if name not in moved and (name in mechanism.tracks or _is_named_track(mechanism, name))
    ]
    pieces: Sequence[Piece] = pieces_of(placed, links)
    if not pieces:
        return None
    x = np.concatenate([piece.discs[:, 0] for piece in pieces])
    return float((x.max() + x.min()) / 2)


def _is_grouser(piece: Piece, alike: Counter[tuple[str, tuple[float, ...]]]) -> bool:
    """Whether a piece is called a grouser, or is one of many small boxes of one size."""
    if _GROUSER.search(piece.shape.name) or _GROUSER.search(piece.link):
        return True
    small = piece.shape.kind == "box" and min(piece.shape.size) <= _LARGEST_GROUSER
    return small and alike[piece.link, piece.shape.size] >= _ALIKE_BOXES


def _has_mesh(mechanism: Mechanism, name: str) -> bool:
    return any(shape.kind == "mesh" and shape.collides for shape in mechanism.links[name].shapes)


def _has_only_meshes(mechanism: Mechanism, name: str) -> bool:
    shapes = mechanism.links[name].shapes
    return bool(shapes) and all(shape.kind == "mesh" for shape in shapes)
