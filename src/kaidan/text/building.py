"""A building and its flights, as text."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.readers.solids.stated import Stated


def disagreement(one: "Stated") -> str:
    """A stated figure that no unit makes the measured one, with both numbers."""
    if one.quantity in ("risers", "treads"):
        return f"{one.name} states {one.value:.0f} {one.quantity}, {one.measured:.0f} are drawn"
    return (
        f"{one.name} states {one.value:g}, which is {one.in_model_unit * 1e3:.1f} mm in the unit "
        f"of the model; {one.measured * 1e3:.1f} mm are drawn"
    )
