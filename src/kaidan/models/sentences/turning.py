"""How a robot turns on a landing, or why it does not."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from kaidan.models.landing_figures import LandingTurn, TurnFigures


def turning(turn: "TurnFigures", landing: str = "") -> str:
    """Why a robot does not get round on a landing, or only just.

    landing: which landing, where the reader does not know.
    """
    by = f"{_by(turn)}{f' on the {landing}' if landing else ''}"
    if turn.way == "unknown":
        if turn.turn_deg is None:
            return f"Whether it can {by} is not known: its angle or sizes are not stated."
        what = "the landing is not drawn" if turn.room_m is None else "its width is not stated"
        if turn.circle_m is None:
            what = "the width of the robot is not stated"
        return f"Whether it can {by} is not known: {what}."
    posture = f"with flippers {turn.flippers} " if turn.flippers else ""
    if turn.way == "none":
        assert turn.circle_m is not None
        circles = f"{posture}it sweeps {_m(turn.circle_m)}, the landing has {_m(turn.room_m)}"
        if turn.circle_m <= (turn.room_m or 0.0):
            circles += ", but not on the line by which it arrives or goes on"
        return f"It cannot {by}: {circles}, and no manoeuvre was found."
    if turn.tight:
        return f"It can {by} only where it is less than 30 mm off: {posture}{_how(turn)}."
    most = f"more than {turn.most_moves} (turning_moves of its sheet)"
    return f"It can {by} only {posture}{_how(turn)}, {most}: try it, or turn elsewhere."


def turned(turn: "TurnFigures", landing: str) -> str:
    """How a robot turns on a landing."""
    raised = f"change the flippers to {turn.flippers} and " if turn.changed else ""
    return f"On the {landing} {raised}{_by(turn)}: {_how(turn)}."


def reason(turns: "Sequence[LandingTurn]") -> str:
    """Why the worst of some turns fails: it fails, is not known, has no room, takes long."""
    ways = {"none": 0, "unknown": 1}
    worst = min(turns, key=lambda one: ways.get(one.way, 2 if one.tight else 3 if one.long else 4))
    return turning(worst, worst.landing)


def every(turns: "Sequence[LandingTurn]") -> list[str]:
    """How the robot turns on each landing, or that it does not."""
    return [
        turned(each, each.landing) if each.holds else turning(each, each.landing) for each in turns
    ]


def lines(turns: "Sequence[LandingTurn]") -> list[str]:
    """What to do on landings where the robot turns otherwise than on the spot as it climbs."""
    return [
        turned(each, each.landing)
        for each in turns
        if each.way in ("corner", "manoeuvre") or (each.way == "spin" and each.changed)
    ]


IN_LINE = (
    "Flights are driven as if they lay in line, each from the landing before it; a turn on a "
    "landing is judged by lengths in the plan."
)
"""What a traverse does where the way turns."""


def _by(turn: "TurnFigures") -> str:
    return "turn" if turn.turn_deg is None else f"turn by {abs(turn.turn_deg):.0f} deg"


def _how(turn: "TurnFigures") -> str:
    if turn.way == "spin":
        return f"it sweeps {_m(turn.circle_m)} of {_m(turn.room_m)}"
    if turn.way == "corner":
        return "round the corner in one go"
    way = "back and forth" if turn.reversals else "bit by bit"
    return f"{way} in {turn.moves} drives and turns on the spot"


def _m(value: float | None) -> str:
    return "an unknown circle" if value is None else f"{value:.2f} m"
