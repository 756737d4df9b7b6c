"""The paper again, as text: table, statements, captions."""

from typing import TYPE_CHECKING

from kaidan.tables import fixed, table

if TYPE_CHECKING:
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
        ]
    )


def fig_7_note(friction: float) -> str:
    """Line at the foot of Fig. 7."""
    return (
        f"After Fig. 7, a schematic without numbers. $\\mu_s$ = {friction:g} and the area of "
        "sliding uphill are ours, not the paper's."
    )
