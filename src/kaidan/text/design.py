"""A design and what it gains, as text."""

from typing import TYPE_CHECKING

from kaidan.modes import FAILURE_MODES, Verdict
from kaidan.tables import human, table

if TYPE_CHECKING:
    from kaidan.verbs.design.answer import Design, FreeFigure


def text(found: "Design") -> str:
    """Verdict of the design, what to change, each of the stairs, and what was tried."""
    stairs = ", ".join(each for each in found.stairs if each) or "the stairs"
    lines = [f"{Verdict(found.verdict).label}  {found.robot} on {stairs}: {_degrees(found)}"]
    if found.goal == "go" and found.verdict != "go":
        lines.append("  No design within the ranges is a GO; this one comes nearest.")
    if found.cost == 0 and found.verdict_now is not None:
        lines.append("  It stays as it is.")
    lines += [f"  {each.name:<22}{_change(each)}" for each in found.free]
    plans = [f"{each.facing.replace('-', ' ')}; {each.flippers}" for each in found.on_stairs]
    if len(set(plans)) == 1 and found.on_stairs[0].flippers:
        lines.append(f"  {'posture':<22}{plans[0]}")
    if len(found.on_stairs) > 1:
        rows = [
            {
                "stairs": each.stairs,
                "verdict": each.verdict,
                "governs": each.governs.replace("_", " "),
                "margin": _number(each.margin_deg),
                "plan": plan,
            }
            for each, plan in zip(found.on_stairs, plans, strict=True)
        ]
        heads = {"stairs": "stairs", "verdict": "verdict", "governs": "decides"}
        own = {"plan": "posture"} if len(set(plans)) > 1 else {}
        lines += ["", table(rows, heads | {"margin": "margin [deg]"} | own)]
    if found.front:
        rows = [
            {
                "cost": f"{each.cost:.3f}",
                "verdict": each.verdict,
                "margin": _number(each.margin_deg),
            }
            | {
                free.name: human(value, unit=free.unit)
                for free, value in zip(found.free, each.values, strict=True)
            }
            for each in found.front
        ]
        names = {free.name: free.name for free in found.free}
        heads = {"cost": "cost", "verdict": "verdict", "margin": "margin [deg]"}
        lines += ["", table(rows, heads | names)]
        lines.append("Cost: sum of the changes, each a share of its range times its weight.")
    lines += ["", _tried(found)]
    return "\n".join(lines)


def _degrees(found: "Design") -> str:
    mode = FAILURE_MODES.get(found.governs)
    nearest = mode.label if mode else found.governs.replace("_", " ")
    said = f"{_number(found.margin_deg)} deg, {nearest}"
    if found.verdict_now is None:
        return said
    return f"{said}; as it is {Verdict(found.verdict_now).label}, {_number(found.margin_now_deg)}"


def _number(margin: float | None) -> str:
    return "-" if margin is None else f"{margin:+.1f}"


def _change(each: "FreeFigure") -> str:
    best = human(each.best, unit=each.unit)
    now = "" if each.now is None else f"{human(each.now, unit=each.unit)} to "
    within = f"{human(each.low, unit=each.unit)} to {human(each.high, unit=each.unit)}"
    same = each.now is not None and each.now == each.best
    at_end = each.best in (each.low, each.high) and not same
    note = ", at the end of its range" if at_end else ""
    return f"{f'stays {best}' if same else f'{now}{best}'}   (within {within}{note})"


def _tried(found: "Design") -> str:
    line = f"{found.tried} designs judged by the {found.model} model"
    if found.map is None:
        return f"{line}."
    share = 100 * found.map.share_go
    return f"{line}; of the {found.grid} on the map {share:.0f} % are a GO, and none is better."
