"""How a robot falls, stage by stage, in words."""

from typing import TYPE_CHECKING

from kaidan.verbs.sentences.event_log import where

if TYPE_CHECKING:
    from kaidan.traversal.event_log import Place


def sentence(
    name: str,
    place: "Place",
    downhill_end: str,
    *,
    rotation_deg: float | None = None,
    share: float | None = None,
) -> str:
    """What a stage says.

    name: as `kaidan.traversal.fall_stages.Stage` has it.
    rotation_deg: how far the body rotates [deg].
    share: share of the load on the lowest contact [1].
    """
    if name == "parallel motion":
        return f"along the nosings, the lowest contact {where(place)}"
    if name == "round end":
        return (
            f"{where(place)} is under the arc of the {downhill_end}; from here the body rotates "
            f"by {rotation_deg or 0.0:.1f} deg"
        )
    if name == "largest load":
        return f"{100 * (share or 0.0):.0f} % of the load on the lowest contact, {where(place)}"
    if name == "rotates back":
        return f"{where(place)} still carries: the body rotates back"
    what = "nothing arrests it"
    if rotation_deg is not None:
        what = f"arrested after {rotation_deg:.1f} deg"
    return f"the centroid has come over {where(place)} and goes on behind it: {what}"
