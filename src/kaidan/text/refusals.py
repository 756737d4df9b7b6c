"""Why a file holds no stairs that can be judged, one sentence for each reason."""

from collections.abc import Mapping

REFUSALS: Mapping[str, str] = {
    "ramp": "It is a ramp of {angle_deg:.0f} deg: no risers stand out of its {residual_mm:.0f} mm "
    "of scatter.",
    "rubble": "Its heights do not repeat as steps do: {residual_mm:.0f} mm are left over.",
    "curved": "It is a curved flight: it turns by {turn_deg:.0f} deg.",
    "winders": "It has winders: its nosings turn by {turn_deg:.0f} deg.",
    "ramp-element": "It is a ramp of {angle_deg:.1f} deg, {height_m:.2f} m high: there are no "
    "steps to judge.",
    "lift": "It is a lift: robots are not judged on lifts.",
    "escalator": "It is an escalator: its steps move, so they are not judged as stairs.",
    "moving-walk": "It is a moving walk: it moves, so it is not judged.",
    "transport": "It is a transport element of no stated type: it is not judged.",
    "single-step": "It is a single step of {rise_mm:.0f} mm: only flights of two risers or more "
    "are judged.",
    "no-sheet": "Its steps are none that stairs have: {reason}.",
    "no-flight": "Not understood: its {count} level surfaces, from {low_m:.2f} to {high_m:.2f} m, "
    "make no straight flight.",
    "left-over": "Not understood: its level surfaces from {low_m:.2f} to {high_m:.2f} m belong to "
    "none of its flights.",
    "no-treads": "Not understood: nothing of it is level and free above.",
    "no-slope": "Not understood: it is called a ramp, and nothing of it slopes.",
    "undrawn": "Not understood: nothing of it is drawn.",
    "damaged": "Not understood: no shape can be made of what is drawn.",
    "unclear": "It shows {steps} steps whose risers point up to {turn_deg:.0f} deg apart: "
    "something stands before them, or the flight turns. Scan again with nothing in the way.",
    "ladder": "It is a ladder of {angle_deg:.0f} deg; tracks take up to 60 deg.",
    "flat": "It is level: its heights differ by {height_mm:.0f} mm.",
    "none": "No stairs are in it.",
    "too-few": "Only {steps} steps are seen; at least {needed} are needed: scan from where more of "
    "them are in view.",
    "irregular": "Its steps are too irregular for stairs: they differ by {spread_mm:.0f} mm.",
    "ramp-after-steps": "The steps go over into a plane at {range_m:.1f} m: scan closer.",
    "noisy": "Its scatter of {residual_mm:.0f} mm hides the steps: scan closer or slower.",
    "coarse": "Its cells of {cell_mm:.0f} mm are too coarse for steps; 20 mm are needed.",
    "ambiguous": "It is plausible in more than one way, {ways}: state the unit and the up axis.",
    "massless": "Its {links} links have no mass in this file: state mass, com_from_front and "
    "com_height, or weigh the robot (kaidan measure robot --help).",
    "mesh-tracks": "Its tracks are meshes, which are not opened ({names}): state flat_length, "
    "com_from_front and com_height, or measure them. Its masses add up to {mass_kg:.1f} kg.",
    "no-track": "It has no track: the file names and declares none, and draws no wheels that "
    "overlap. If the robot has belts, state them: --override track.belt=smooth.",
    "wheels": "It has wheels and no track: a nosing drops between wheels of {radius_mm:.0f} mm "
    "radius that stand {gap_mm:.0f} mm apart. If a belt runs over them, state it: "
    "--override track.belt=smooth.",
    "no-flat-run": "Nothing on which it stands is level within 3 deg: this is no tracked robot, or "
    "its axes are others than x forward and z up.",
    "splats": "These are Gaussian splats, whose centres are no surface: export a mesh or a point "
    "cloud.",
    "usdz": "This is USD (USDZ), which is not read: export glTF, OBJ or PLY.",
    "revit": "This is a Revit project (an OLE compound file), which is not read: export IFC.",
    "citygml": "This is CityGML or CityJSON, which is not read: convert it to IFC or to a mesh.",
    "ifc5": "This is IFC5 (ifcx), which is not read yet: export IFC4.",
    "xacro": "This is xacro: expand it to URDF first (xacro FILE > robot.urdf).",
    "archive": "This is a compressed file or an archive: unpack it and name the one to read.",
}
"""Sentence of each reason, with the names of its numbers."""


def sentence(why: str, numbers: Mapping[str, float | str]) -> str:
    """One sentence that says why, with its numbers."""
    return REFUSALS[why].format(**numbers)
