"""Friction and grousers in words."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.models.traction_figures import TractionFigures
    from kaidan.question import Question


WORTH_TELLING = 0.02
"""Friction by which the usual grousers need less than smooth belts, from which on it is said
[1]."""
SPARE = 1.2
"""Times the friction required within which rigid teeth got stuck, of robots that go up on their
grousers and turn their flippers on the way (docs/theory/grousers.md, a second judge) [1]."""


def usual() -> str:
    """Grousers that an answer compares with."""
    return "grousers of 10 mm every 40 mm"


def required(found: "TractionFigures", smooth: str) -> str:
    """Friction that is required, of smooth belts as said, and what grousers make of it."""
    if found.belt == "grousers" and found.required_friction is not None:
        without = found.smooth_required_friction
        if without is not None and abs(without - found.required_friction) < 0.005:
            return f"{smooth}, with its grousers or without"
        alone = "no friction is enough" if without is None else f"{without:.2f}"
        return f"{smooth} with its grousers, {alone} without"
    held, own = found.usual_required_friction, found.smooth_required_friction
    if held is not None and (own is None or held < own - WORTH_TELLING):
        return f"{smooth} ({held:.2f} with {usual()})"
    return smooth


def slip(question: "Question", found: "TractionFigures") -> str | None:
    """How far it may slip before grousers hold it; None: it does not rely on them."""
    if found.slip_mm is None:
        return None
    way = "on" if question.direction == "down" else "back"
    return f"holds on its grousers, may slip {way} up to {found.slip_mm:.0f} mm"


def _more_to_be_sure(question: "Question", found: "TractionFigures") -> float | None:
    """Friction with which none got stuck that turned its flippers going up; None: it is there."""
    if question.direction == "down" or question.surface is None or found.required_friction is None:
        return None
    if not question.changes:
        return None
    least, sure = min(question.surface.of_parts()), SPARE * found.required_friction
    return sure if found.required_friction <= least < sure else None


def notes(question: "Question", found: "TractionFigures") -> tuple[str, ...]:
    """What the reader must know of friction and grousers."""
    each = []
    track = question.robot.track
    slips = slip(question, found)
    if slips is not None:
        each.append(
            f"Where friction alone does not hold it, it {slips}: a tip stands on the tread behind "
            "a nosing. Left and right may hold one after the other, and the robot yaw meanwhile."
        )
    if track.has_grousers:
        needed = _more_to_be_sure(question, found)
        if needed is not None:
            each.append(
                f"Little friction is to spare: below {needed:.2f} grousers of several belts may "
                "work against one another, or the robot slide back while its flippers turn, and "
                "get stuck."
            )
        unknown = [
            name
            for name, value in (
                ("height", track.grouser_height),
                ("spacing", track.grouser_spacing),
                ("tip width", track.grouser_tip_width),
                ("strength", track.grouser_strength),
            )
            if value is None
        ]
        if unknown:
            each.append(
                f"Of the grousers {', '.join(unknown)} are not stated: ranges are assumed"
                + (", and the strength is not judged." if "strength" in unknown else ".")
            )
        if found.strength_margin_N is not None and found.strength_margin_N <= 0:
            each.append(
                "A grouser does not bear half of the tractive force: friction alone counts."
            )
        if question.yaw:
            each.append("At a yaw grousers do not count: friction alone is judged.")
    elif track.belt is None:
        each.append("The sheet does not say whether the belts have grousers: smooth is assumed.")
    return tuple(each)
