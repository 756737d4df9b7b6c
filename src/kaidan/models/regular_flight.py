"""Whether nosings alike are carried all along the underside, as the formulas of a flight assume."""

from kaidan.mechanics.plane import contact_count
from kaidan.question import Question
from kaidan.terrain.stairs import Stairs

LARGEST_IRREGULARITY = 0.0095
"""Difference within a flight up to which it counts as regular [m]: IBC 1011.5.4 allows 9.5 mm."""


def no_regular_flight(question: Question, flight: Stairs) -> str:
    """Why no regular nosings are carried all along the underside; empty if they are."""
    gap = gap_below(question)
    if gap:
        return gap
    if flight.irregularity > LARGEST_IRREGULARITY + 1e-12:
        return (
            f"the steps differ by {flight.irregularity * 1e3:.1f} mm, more than the "
            f"{LARGEST_IRREGULARITY * 1e3:.1f} mm up to which a flight counts as regular"
        )
    nosings = len(flight.step_rises)
    if nosings < contact_count(L=question.stance.flat_length, p=flight.nosing_spacing) + 1:
        return f"the flight's {nosings} nosings are fewer than the track holds at once"
    return ""


def gap_below(question: Question) -> str:
    """Why nosings are not carried all along the underside; empty if they are."""
    gap = question.robot.track.gap
    if gap > 0:
        return f"{gap * 1e3:.0f} mm in the middle of the underside have no track to carry a nosing"
    if question.stance.tips_below:
        return "a flipper reaches below the underside of the track"
    return ""
