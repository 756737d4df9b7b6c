"""The protocol of an experiment on a real robot, and the sheet that goes with it."""

import json
import math
from collections.abc import Mapping, Sequence

Row = tuple[float, float, str, float]
"""Nosing spacing [mm], slope [deg], direction, expected information [bit]."""


def page(
    robot: str,
    com_from_front: float,
    com_height: float,
    rows: Sequence[Row],
    trials: int,
    expected: Mapping[str, tuple[float, float]],
    forces: Sequence[float | None],
    parting: Sequence[Row],
) -> str:
    """What to do, as Markdown."""
    listed = "\n".join(
        f"| {p:.0f} | {angle:.0f} | {direction} | {trials} | {gain:.1f} |"
        for p, angle, direction, gain in rows
    )
    k_before, k_after = (100 * (math.exp(each) - 1) for each in expected["w_n"])
    M_before, M_after = (math.degrees(each) for each in expected["theta_M"])
    known = [f"{force:.0f}" for force in forces if force is not None]
    loads = f"{', '.join(known)} N" if known else "20 to 100 % of the weight and back"
    return f"""# Protocol: the tipping experiment with {robot}

After Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, "Verification test". Write every
measurement into the sheet beside this page, then `kaidan lab calibrate SHEET.toml`.

## Before

1. **Safety.** Tether from above, slack while it drives, that holds twice the weight. Nobody
   below the robot. A fall ends on the tether at 20 deg more than the stairs.
2. **Robot.** Weigh it as it is tested. Flippers off or stowed as in its sheet, C_L
   {1e3 * com_from_front:.0f} mm, C_N {1e3 * com_height:.0f} mm: measure both (`kaidan measure
   robot`). Clean dry belts, usual tension; note it.
3. **Rig.** Bars or steps with sharp nosings (radius 2 mm or less) that give less than 0.2 mm
   under the weight: seven nosings or more. Set the spacing with a gauge block, the slope with a
   level to 0.1 deg.
4. **IMU** on the hull near the centroid, axes along and across the track, 100 Hz or more, no
   filter slower than 20 Hz. Zero it with the robot at rest on the flat, the belts on a straight
   edge along the nosings.
5. **Camera** level with the middle of the flight, square to it, 3 m or farther, 60 frames a
   second or more, a plumb line and a scale in the plane of the track. It settles what the IMU
   leaves open, and which nosing was left.

## Bench: how one nosing yields (the measurement that decides most)

Press one nosing bar, across both tracks under the middle of the flat, wheels and belts as
driven: forces {loads}; wait 10 s at each; read the travel of the bar against the hull to 0.05
mm (`press`). Then press with the weight and pull the bar along the tracks by the same forces,
the belts braked, up to where it slips; read its travel (`shear`).

## Tape and film

Measure the tail's radius, the height of a grouser above the belt and ten grouser spacings. On the
film read, where the tail leaves a nosing: how far the nosing then is beyond the end of the flat,
along the track, and how far it stands above the flat, prolonged (`film`).

## Grousers or rubber

Grousers lean the robot by their phase, rubber by its load. Two spacings part them: p a whole number
of grouser spacings, and half of one more, each 3 deg below its margin. Begin five trials with a tip
on the lowest nosing and five with the belt turned by half a grouser spacing; read `extra`, the
largest. Grousers: nothing at the first spacing, arcsin(h/p) at the second. Rubber: the same at
both. Write `belt_set = true` with these trials. {_parting(parting)}

## On the stairs

100 mm/s, belts on before the nosing is reached, five nosings a trial. **h** holds: it drives
on. **f** falls: it leans on the tether, or more than 15 deg beyond the stairs. **s** slides or
stalls: it tells of friction, not of tipping. Begin each trial elsewhere on its nosing: draw a
card of 1 to 10 tenths of the spacing. Mix the order of the conditions. `up` is nose first;
`down` is tail first, the nose up the stairs all the same. Where it holds going up, note the
largest inclination beyond the stairs in the half second after a nosing is lost (`extra`).

Chosen by expected information; where the first trials of a row all fall and so did the row
below it, leave it out.

| p [mm] | slope [deg] | direction | trials | expected [bit] |
|---|---|---|---|---|
{listed}

What that is expected to come to: theta_M to {M_after:.1f} deg (one standard deviation;
{M_before:.1f} before), the indentation by theta_d alone to {k_after:.0f} % ({k_before:.0f} %
before); the bench does better.

## After

`kaidan lab calibrate SHEET.toml --file ROBOT.toml` fits k, kt, theta_d and theta_M with intervals
that hold together with 95 %, and writes them into the robot's sheet. Keep the sheet, the films
and the logs.
"""


def _parting(parting: Sequence[Row]) -> str:
    if not parting:
        return "Add them to the sheet once the grouser spacing is measured."
    each = " and ".join(f"{p:.1f} mm at {angle:.0f} deg" for p, angle, _, _ in parting)
    return f"Here: {each}."


def sheet(
    robot: str,
    mass: float | None,
    rows: Sequence[Row],
    forces: Sequence[float | None],
    parting: Sequence[Row],
) -> str:
    """What to fill in, as TOML."""
    weight = f'"{mass:g}kg"' if mass is not None else '"FILL IN"'
    lines = [
        "# Filled in at the rig; lengths and forces with their units.",
        "# Take out what was not done; a row of trials without results does no harm.",
        f"robot = {json.dumps(robot, ensure_ascii=False)}",
        f"mass = {weight}  # as tested",
        '# rear_radius = "65mm"      # by tape; take out the # of what was measured',
        '# grouser_height = "7mm"',
        '# grouser_spacing = "33mm"',
    ]
    for name, how in (("press", "across"), ("shear", "along")):
        lines += ["", f"# Bench, {how} the track: force on one nosing, travel against the hull"]
        for force in forces:
            given = '"FILL IN"' if force is None else f'"{force:.0f}N"'
            lines += [f"[[{name}]]", f"force = {given}", 'travel = "FILL IN"  # such as "1.25mm"']
    lines += [
        "",
        "# Stairs: results a letter a trial (h held, f fell, s slid); extra a measurement each",
    ]
    for p, angle, direction, _ in rows:
        lines += [
            "[[trials]]",
            f'nosing_spacing = "{p:.0f}mm"',
            f'angle = "{angle:.0f}deg"',
            f'direction = "{direction}"',
            'results = ""  # such as "hhhfh"',
            'extra = []  # such as ["2.1deg", "2.4deg"]',
        ]
    for p, angle, direction, _ in parting:
        lines += [
            "[[trials]]  # grousers or rubber",
            f'nosing_spacing = "{p:.1f}mm"',
            f'angle = "{angle:.0f}deg"',
            f'direction = "{direction}"',
            "belt_set = true",
            'results = ""  # five with a tip on the lowest nosing, five turned by half',
            "extra = []",
        ]
    return "\n".join(lines) + "\n"
