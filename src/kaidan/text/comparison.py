"""Many robots on many stairs, as text."""

from typing import TYPE_CHECKING, Any

from kaidan.modes import CONTACT, FAILURE_MODES, SUPPLIES, Undecided, Verdict
from kaidan.tables import screen_width, table
from kaidan.words import heading_of

if TYPE_CHECKING:
    from kaidan.verbs.comparison import Cell, Comparison

SIGNS = {
    Verdict.GO: "+",
    Verdict.ROUGH: "~",
    Verdict.UNSURE: "!",
    Verdict.NO_GO: "x",
    Verdict.OUTSIDE_MODEL: "?",
}
"""A sign for each verdict that needs no colour and no special type."""
_COLUMN = 17
"""Least width of a column with a verdict and a margin."""


def text(found: "Comparison") -> str:
    """Conditions, tables as wide as the screen, a key, and who cannot be judged."""
    lines = [conditions(found)]
    widest = max(map(len, found.stairs)) + 24
    at_once = max(1, (screen_width() - widest) // _COLUMN)
    for first in range(0, len(found.robots), at_once):
        lines += ["", _table(found, range(first, min(first + at_once, len(found.robots))))]
    key = ", ".join(f"{sign} {short(verdict)}" for verdict, sign in SIGNS.items())
    lines += ["", f"{key} the model. Number: smallest margin [deg], in the worst case."]
    lines += [*beside_the_slope(found), *belts(found)]
    if found.without_centroid:
        lines.append("No centroid is published of these, so no margin can be computed:")
    lines += [f"  {each.name}: {each.title}, {each.figures}" for each in found.without_centroid]
    return "\n".join(lines)


def conditions(found: "Comparison") -> str:
    """What holds for all cells: direction, speed, ground and model."""
    facing = found.facing or "with the better end first"
    goes = heading_of(found.direction or "up or down as the stairs say", facing)
    speed = "constant speed"
    if found.acceleration:
        speed = f"{found.acceleration:g} m/s2 up the stairs"
    if found.planned:
        what = (
            "plan of its flippers" if found.model == CONTACT.name else "of stowed and flat flippers"
        )
        speed += f", each with the best {what}"
    ground = found.surface or "friction not stated"
    model = "contact model, from landing to landing"
    if found.model == "closed-form":
        model = "closed form, the regular flight alone"
    return f"{goes[0].upper()}{goes[1:]}, {speed}, {ground}; {model}"


def beside_the_slope(found: "Comparison") -> list[str]:
    """What decides where the margin of slope is positive and it is no GO all the same."""
    decides = {
        cell.governs
        for cell in found.cells
        if cell.verdict is not Verdict.GO and cell.margin_deg is not None and cell.margin_deg > 0
    }
    if not decides:
        return []
    labels = [mode.label for key, mode in FAILURE_MODES.items() if key in decides]
    labels += ["friction not stated"] if Undecided.FRICTION_UNKNOWN in decides else []
    return [f"Where the margin is positive and it is no GO, this decides: {'; '.join(labels)}."]


def belts(found: "Comparison") -> list[str]:
    """What grousers that no sheet mentions would change, where friction decides."""
    supplies = {mode.key for mode in SUPPLIES} | {Undecided.FRICTION_UNKNOWN.value}
    lacks = {
        cell.robot
        for cell in found.cells
        if cell.verdict is not Verdict.GO and cell.governs in supplies
    }
    open_ = [name for name in found.robots if name in lacks and name in found.belts_open]
    if not open_:
        return []
    return [
        f"Where a sheet does not say what belts there are, they count as smooth, and friction "
        f"decides for {', '.join(open_)}: if they have grousers, --override track.belt=grousers."
    ]


def short(verdict: Verdict) -> str:
    """Word that fits into a cell."""
    return "OUTSIDE" if verdict is Verdict.OUTSIDE_MODEL else verdict.label


def _table(found: "Comparison", shown: range) -> str:
    rows = []
    for row in found.rows:
        line: dict[str, Any] = {
            "stairs": row[0].stairs,
            "angle_deg": row[0].angle_deg,
            "p_m": row[0].nosing_spacing_m,
        }
        rows.append(line | {str(column): _verdict(row[column]) for column in shown})
    heads = {"stairs": "stairs", "angle_deg": "[deg]", "p_m": "p [mm]"}
    for column in shown:
        flippers = found.posture(column)
        heads[str(column)] = found.robots[column] + (f" ({flippers})" if flippers else "")
    return table(rows, heads)


def _verdict(cell: "Cell") -> str:
    number = "" if cell.margin_deg is None else f" {cell.margin_deg:+.1f}"
    return f"{SIGNS[cell.verdict]} {short(cell.verdict)}{number}"
