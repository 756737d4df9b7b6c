"""The paper again, as text: table, statements, captions."""

from typing import TYPE_CHECKING

from kaidan.lab.reproduction.sentences import phase_notes
from kaidan.tables import fixed, table

if TYPE_CHECKING:
    from kaidan.lab.reproduction.phase import GrouserPhase
    from kaidan.lab.reproduction.reproduction import Reproduction


FIG_11_NOTE = "After Fig. 11. The lower limit and the end of the model are ours."


def text(found: "Reproduction") -> str:
    """Printed numbers beside computed ones, and what the text states without a number."""
    rows = [
        {
            "quantity": row.quantity,
            "unit": row.unit,
            "printed": (row.printed or "-").rjust(7),
            "computed": fixed(row.computed, 0 if row.unit == "mm" else 3).rjust(7),
            "difference": fixed(row.difference, 0 if row.unit == "mm" else 3, "+").rjust(7),
        }
        for row in found.table
    ]
    measured = [f"{row.quantity}: {row.note}." for row in found.table if row.role == "measurement"]
    return "\n".join(
        [
            found.paper,
            "",
            table(rows, {name: name for name in rows[0]}),
            "",
            *measured,
            "",
            *found.statements,
            found.missing,
            "",
            *phase_table(found.phase),
        ]
    )


def phase_table(found: "GrouserPhase") -> list[str]:
    """Closed form of grouser phase beside Eqs. (19)-(23), and how explanations fare."""
    rows = [
        {
            "p [mm]": fixed(each.p_mm, 0),
            "(19)-(23) [deg]": fixed(each.rigid_deg, 1),
            "theta_d": fixed(each.theta_d_deg, 1),
            "up": fixed(each.up_deg, 1),
            "driven": " to ".join(fixed(end, 1) for end in each.driven_deg),
            "down": fixed(each.down_deg, 1),
            "theta_M": fixed(each.theta_M_deg, 1),
        }
        for each in found.spacings
    ]
    explained = [
        {
            "the track is": each.name,
            "150, 200, 220 mm [deg]": ", ".join(fixed(up, 1) for up in each.up_deg),
            "misses the text by": fixed(each.miss_deg, 1),
        }
        for each in found.explanations
    ]
    return [
        *phase_notes(found.h_mm, found.lost_beyond_mm, found.lost_beyond_driven_mm),
        "",
        table(rows, {name: name for name in rows[0]}),
        "",
        table(explained, {name: name for name in explained[0]}),
    ]


def fig_7_note(friction: float) -> str:
    """Line at the foot of Fig. 7."""
    return (
        f"After Fig. 7, a schematic without numbers. $\\mu_s$ = {friction:g} and the area of "
        "sliding uphill are ours, not the paper's."
    )
