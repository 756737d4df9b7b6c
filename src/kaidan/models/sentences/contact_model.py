"""What the reader must know of an answer by the contact model."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.question import Question
    from kaidan.traversal import Traverse


def notes(question: "Question", found: "Traverse", *, driven_risers: int | None) -> tuple[str, ...]:
    """Notes on an answer."""
    each = []
    if driven_risers is not None:
        each.append(
            f"The risers are alike, so the traverse repeats itself: {driven_risers} of them are "
            "driven, and steps are counted on those."
        )
    if question.yaw:
        each.append(
            "At a yaw both tracks' contacts on the flight judge tipping; entering, landing and "
            "energy are those of one track along the heading, on the safe side."
        )
        if question.steps_uncertain:
            each.append("The doubt of single steps is taken there as one of the whole flight.")
    elif question.robot.track.gauge is None:
        each.append("The tracks' distance (track.gauge) is not known, so no yaw can be judged.")
    if found.whole and found.criterion.alone and not question.yaw:
        each.append(
            "Somewhere fewer than two nosings are under the track (p > L/2): it rocks from nosing "
            "to nosing."
        )
    slides = max((extremes.slides_below or 0.0 for extremes in found.phases), default=0.0)
    low = question.friction[0]
    if slides > 0 and not slides <= low:
        each.append(
            f"Landing with a friction below {slides:.2f}, its trailing end slides down the last "
            "risers: a bump of a riser at most, no fall."
        )
    if found.outline.gyration_estimated:
        each.append("The moment of inertia is estimated as that of an even box.")
    if found.profile.open_risers:
        each.append("Open risers: the model gives them faces that are not there.")
    if found.profile.overhangs:
        each.append("Nosings overhang: the model stands on their upper envelope.")
    return tuple(each)
