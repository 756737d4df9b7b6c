"""A fleet on a stock of stairs, as text."""

from typing import TYPE_CHECKING

from kaidan.tables import table

if TYPE_CHECKING:
    from kaidan.verbs.stock.answer import RobotOnStock, StockStudy

_MOST = 40
"""Robots that are shown."""
_MODES = 2
"""What decides, so many at most for each robot."""


def text(found: "StockStudy") -> str:
    """Stock, shares of each robot, and what decides where it is no GO."""
    (rise, rises), (going, goings) = found.rise_m, found.going_m
    low, high = found.angle_deg
    lines = [
        f"{found.stock}: {found.flights:g} flights, {found.different} different; rise "
        f"{1e3 * rise:.0f} to {1e3 * rises:.0f} mm, going {1e3 * going:.0f} to {1e3 * goings:.0f} "
        f"mm, {low:.1f} to {high:.1f} deg",
        f"{found.judged} pairs judged, {found.model} model; some robot takes "
        f"{100 * found.some_robot:.1f} %",
        "",
    ]
    heads = {"robot": "robot", "go": "GO [%]"}
    heads |= {"not_go": "no GO [%]"} if found.go_only else {}
    heads |= {"rough": "ROUGH [%]", "unsure": "UNSURE [%]", "no_go": "NO-GO [%]"}
    if any(each.outside_model for each in found.robots):
        heads["outside"] = "OUTSIDE [%]"
    heads |= {"steepest": "steepest GO [deg]", "governs": "decides where it is no GO [%]"}
    lines.append(table([_row(each) for each in found.robots[:_MOST]], heads))
    if len(found.robots) > _MOST:
        lines.append(f"... and {len(found.robots) - _MOST} more robots; --csv has all.")
    return "\n".join(lines)


def _row(each: "RobotOnStock") -> dict[str, str]:
    def share(value: float) -> str:
        return f"{100 * value:.1f}"

    decides = [f"{label(key)} {share(value)}" for key, value in list(each.governs.items())[:_MODES]]
    steepest = "-" if each.steepest_go_deg is None else f"{each.steepest_go_deg:.1f}"
    return {
        "robot": each.robot,
        "go": share(each.go),
        "not_go": share(each.not_go),
        "rough": share(each.rough),
        "unsure": share(each.unsure),
        "no_go": share(each.no_go),
        "outside": share(each.outside_model),
        "steepest": steepest,
        "governs": ", ".join(decides),
    }


def label(key: str) -> str:
    """What decides, in a few words."""
    known = {"tip_downhill": "tips downhill", "tip_uphill": "tips uphill"}
    known |= {"fall_downhill": "falls downhill", "fall_uphill": "falls uphill"}
    return known.get(key, key.replace("_", " "))
