"""What to measure next, in words."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.assessment.measuring import Measurement

_DO = {
    "centroid": "Weigh the robot (kaidan measure robot); if its centroid is as stated",
    "length": "Measure the flat length; if it is as stated",
    "stairs": "Measure the stairs (kaidan measure stairs); if they are as stated",
    "friction": "Measure the friction; if it is as stated, at its best end",
    "theta_d": "Measure theta_d; at best",
    "theta_M": "Measure theta_M; at best",
}
_WHAT = {
    "centroid": "weigh the robot",
    "length": "its flat length",
    "stairs": "the stairs",
    "friction": "the friction",
}
_LITTLE = 0.02
"""Share that is not worth a word."""
_SEEN = 0.05
"""Deviation of the margin that its tenth of a degree shows [deg]."""


def measure(what: str) -> str:
    """What to do."""
    return _DO[what]


def name(what: str) -> str:
    """What is measured, in a few words."""
    return _WHAT.get(what, what)


def matters(each: "Sequence[Measurement]") -> bool:
    """Whether the largest doubt is one that the margin shows."""
    return bool(each) and each[0].deviation_deg >= _SEEN


def first(each: "Sequence[Measurement]") -> str:
    """What to measure first and then, with its share of the doubt in the margin."""
    shown = [one for one in each if one.share >= _LITTLE] or list(each[:1])
    leading, *others = shown
    rest = ", ".join(f"{name(one.what)} {100 * one.share:.0f} %" for one in others)
    return (
        f"{name(leading.what)}: {100 * leading.share:.0f} % of the doubt in the margin "
        f"({leading.deviation_deg:.1f} deg, one sigma){f'; then {rest}' if rest else ''}"
    )
