"""A robot read from a file in words: where each figure is from, and what is wrong with the file."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Protocol

MOST_NAMES = 4
"""Names of links that one sentence lists."""

BELT_ASSUMED: Mapping[str, str] = {
    "wheels": "The file draws wheels alone. A belt over them is assumed: check that there is one.",
    "box": "The file draws a box for each track. A belt round it is assumed, with square ends.",
}
"""What is assumed of a belt, by what a file draws in its place."""

FAULTS: Mapping[str, str] = {
    "no-mass": "No mass is stated for {who}: counted as 0 kg.",
    "zero-mass": "A mass of 0 kg is stated for {who}.",
    "no-inertia": "No moments of inertia are stated for {who}: counted as points.",
    "impossible-inertia": "The moments of inertia of {who} are those of no body.",
    "kept-joint": "Of a kind that is not read, and kept where the file has them: {who}.",
    "closed-chain": "These joints close a chain and are left out: {who}.",
    "held-in-world": "Left out, because it fixes the robot in the world: {who}.",
    "mesh-mass": "Geoms that are meshes have no mass in this file, counted as 0 kg: {who}.",
    "shell": "Shells are counted as solid, of the same mass: {who}.",
    "apart": "On no joint with the rest, and taken where the file has them: {who}.",
    "off-middle": "The centroid lies {aside_mm:.0f} mm to the {side} of the middle of the tracks: "
    "axes may be swapped, or a mass misplaced.",
    "outside": "The centroid lies beyond the flat run: front may be another axis than {forward}.",
    "wheels-for-belt": BELT_ASSUMED["wheels"],
    "box-for-belt": BELT_ASSUMED["box"],
    "locked": "Locked flippers, whose joints have no travel: {who}. They are judged at the angle "
    "of the file.",
    "everything": "Nothing is called or declared a track: all shapes are taken.",
    "seen-only": "Without shapes for contact, those for the eye are taken: {who}.",
    "mesh-tracks": "Tracks that are meshes are not opened: {who}.",
    "belly-unknown": "Meshes under the body are not opened, so its belly is not known: {who}.",
    "uneven": "Left and right {end} flipper differ by {differ_mm:.0f} mm in length and "
    "{differ_kg:.2f} kg.",
    "single": "There is one {end} flipper; a pair was expected.",
    "boxes": "The {end} flippers have no wheels: their radii are read off boxes.",
    "limits": "The {end} flippers cannot be raised to 90 deg within the limits of their joints: "
    "taken at {angle_deg:.0f} deg.",
    "flippers-only": "It has no main track: the flippers carry it, and between their pivots the "
    "underside is body.",
    "corners": "The {end} end of the track is a corner without a wheel: R = 0.",
    "range": "Its masses are doubtful, so its centroid is taken as a range, C_L +- {along_mm:.0f} "
    "and C_N +- {height_mm:.0f} mm, and there is no GO before it is weighed.",
    "own-frame": "Its base is inclined by {slope_deg:.0f} deg in the file: it is read in its own "
    "frame, that of {who}.",
    "sloping": "The flat run slopes by {slope_deg:.1f} deg in the file; heights are measured "
    "square to it.",
}
"""Sentence of each fault, with the names of its numbers; who are links or joints."""

HOW_TRACKS: Mapping[str, str] = {
    "declared": "links that a plugin declares to be tracks",
    "named": "links called tracks",
    "turning": "wheels that turn about the lateral axis",
    "shapes": "shapes called tracks or wheels",
    "everything": "all shapes",
    "flippers": "roots of the flippers",
}
"""How the tracks were found."""

HOW_FLIPPERS: Mapping[str, str] = {
    "named": "joints called flippers",
    "shaped": "long parts in pairs on lateral joints",
}


class _Fault(Protocol):
    @property
    def kind(self) -> str: ...
    @property
    def who(self) -> str: ...
    @property
    def numbers(self) -> Mapping[str, float | str]: ...


def faults(found: Iterable[_Fault]) -> tuple[str, ...]:
    """One sentence for each kind of fault and its numbers, with all links that it is about."""
    grouped: dict[tuple[str, tuple[tuple[str, float | str], ...]], list[str]] = {}
    for each in found:
        names = grouped.setdefault((each.kind, tuple(each.numbers.items())), [])
        if each.who and each.who not in names:
            names.append(each.who)
    return tuple(
        FAULTS[kind].format(who=listed(names), **dict(numbers))
        for (kind, numbers), names in grouped.items()
    )


def listed(names: Sequence[str]) -> str:
    """Names as a list in a sentence, not endless."""
    shown = ", ".join(name if len(name) <= 40 else f"{name[:39]}…" for name in names[:MOST_NAMES])
    return shown if len(names) <= MOST_NAMES else f"{shown} and {len(names) - MOST_NAMES} more"


def summed(posture: str) -> str:
    """Source of what the masses give."""
    return f"link inertials summed{posture}"


def posture(angles: Mapping[str, float], flippers: Mapping[str, float]) -> str:
    """What a robot's joints are at, for the end of a sentence [deg]."""
    parts = [f"{end} flippers at {angle:.0f} deg" for end, angle in flippers.items()]
    parts += [f"{name} at {angle:.4g}" for name, angle in angles.items()]
    return f", {', '.join(parts)}" if parts else ""


KEPT = ("wheels-for-belt", "box-for-belt")
"""Faults that a sheet keeps as figures."""
DRAWN: Mapping[str, str] = {
    "wheels": "wheels that overlap",
    "box": "shape of the tracks",
}
"""What tells what a file draws in place of a belt."""
STATED = "stated by the user"
LOWER_EDGE = "longest lower edge of the hull of {how}"
END_WHEEL = "wheel at the {end} end of the flat run"
END_CORNER = "no wheel at the {end} end of the flat run"
IDLERS = "wheels of the hull beyond the flat run"
SIDES = "middles of the longest left and right shape of the tracks"
ONE_SIDE = "width of the longest shape of the tracks"
BELLY = "lowest shape of the body over the flat run"
OUTERMOST = "outermost shapes on both sides"
HIGHEST = "highest shape, flippers apart"
GROUSERS = "boxes that stand out of the track"
DECLARED = "declared by a plugin"
BARE = "middle part of the flat run that no track carries"
PIVOTS = "pivot of {joint}"
TIP = "farthest wheel of {joint}"
ROOT = "wheel about the pivot of {joint}"
HALVES = "half the width of the boxes of {joint}"
OF_BOTH = "both flippers, links summed"
LIMIT = "limit of {joint}"
"""Where figures of a robot's sheet are from."""


def sheet_notes(file: str, digest: str, faults: Sequence[str]) -> str:
    """What the user of a sheet made from a robot's file should know."""
    lines = [
        f"Read from {file} (SHA-256 {digest[:12]}). Mass and centroid are a model's: weigh and "
        "tilt the real robot (kaidan measure robot), then put your own figures in.",
        *faults,
    ]
    return "\n".join(lines)
