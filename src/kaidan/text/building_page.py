"""A building as a page of HTML, complete in itself: no script, nothing fetched."""

from html import escape
from typing import TYPE_CHECKING

from kaidan.text.building import (
    account,
    cell_text,
    heading,
    key,
    not_judged,
    notes,
    plans,
    steps_of,
)

if TYPE_CHECKING:
    from kaidan.verbs.building.answer import BuildingAnswer

_STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; max-width: 70em; margin: 2em auto; padding: 0 1em }
table { border-collapse: collapse; margin: 1em 0 }
th, td { border: 1px solid #999; padding: .3em .6em; text-align: left; vertical-align: top }
.go { background: #c5e8dc } .rough { background: #fbf1cc } .unsure { background: #d5dcf5 }
.no-go { background: #f2c6af }
svg { max-width: 100%; height: auto }
"""


def page(found: "BuildingAnswer", plan: str) -> str:
    """Page with the table of flights, the ways, the plan and what is not judged.

    plan: picture of the plan as SVG, empty for none.
    """
    parts = [
        "<!DOCTYPE html>",
        '<html lang="en"><head><meta charset="utf-8"><title>kaidan building</title>',
        f"<style>{_STYLE}</style></head><body>",
        f"<h1>{escape(found.path.rpartition('/')[2])}</h1><p>{escape(heading(found))}</p>",
        f"<p>{escape(account(found))}</p>",
        "<h2>Flights</h2>",
        _flights(found),
        f"<p>{escape(key())}</p>",
        _list("Postures", plans(found)),
        f"<h2>Ways from {escape(found.start)}</h2>" if found.ways else "",
        _ways(found),
        "<h2>Plan</h2>" + plan[plan.find("<svg") :] if plan else "",
        _list("Not judged", not_judged(found)),
        _list("Notes", [*notes(found), *_of_flights(found)]),
        "</body></html>",
    ]
    return "\n".join(part for part in parts if part) + "\n"


def _flights(found: "BuildingAnswer") -> str:
    wide = len(found.robots)
    heads = "".join(f"<th>{escape(name)}</th>" for name in ("flight", "steps", *found.robots))
    rows = [f"<tr>{heads}</tr>"]
    for number, flight in enumerate(found.flights):
        cells = "".join(
            f'<td class="{cell.verdict.value}">{escape(cell_text(cell))}<br>'
            f"<small>{escape(cell.reason)}</small></td>"
            for cell in found.cells[number * wide : (number + 1) * wide]
        )
        rows.append(
            f"<tr><td>{escape(flight.name)}<br><small>{escape(flight.storey)}, "
            f"{escape(flight.identity)}</small></td><td>{escape(steps_of(flight))}</td>{cells}</tr>"
        )
    return "<table>" + "\n".join(rows) + "</table>"


def _ways(found: "BuildingAnswer") -> str:
    names = {each.identity: each.name for each in found.flights}
    rows = []
    for way in found.ways:
        verdict = way.verdict.label if way.verdict else "no way"
        by = ", ".join(names[each] for each in way.flights)
        postures = "".join(f"<li>{escape(each)}</li>" for each in way.postures)
        rows.append(
            f"<tr><td>{escape(way.robot)}</td><td>{escape(way.storey)}</td>"
            f'<td class="{way.verdict.value if way.verdict else ""}">{escape(verdict)}</td>'
            f"<td>{escape(by)}</td><td>{escape(way.binds)}: {escape(way.reason)}"
            f"<ul>{postures}</ul></td></tr>"
        )
    heads = "".join(f"<th>{each}</th>" for each in ("robot", "storey", "verdict", "by", "decides"))
    return f"<table><tr>{heads}</tr>" + "\n".join(rows) + "</table>" if rows else ""


def _of_flights(found: "BuildingAnswer") -> list[str]:
    return [f"{each.name}: {note}" for each in found.flights for note in each.notes]


def _list(title: str, lines: "tuple[str, ...] | list[str]") -> str:
    items = "".join(f"<li>{escape(each)}</li>" for each in lines)
    return f"<h2>{title}</h2><ul>{items}</ul>" if lines else ""
