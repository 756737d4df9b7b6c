"""Nosings that a flat reaches and leaves between the poses of a path."""

from kaidan.contact.door import Records, zeros
from kaidan.contact.layout import Margin, Passed
from kaidan.contact.path import Path
from kaidan.contact.switch import kernel


def nosings_passed(path: Path, touch: float) -> Records:
    """Nosings that a flat reaches or leaves on straight pieces of a path.

    Those of which an event tells are left out, and those that pass from one part to the next in
    line with it.

    Parameters
    ----------
    path
        As driven; with margins only pieces beside a change of contacts are looked at.
    touch
        Gap up to which a nosing lies on a flat [m].

    Returns
    -------
    ndarray (k,)
        Rows of `kaidan.contact.layout.Passed`, by arclength.
    """
    margins = zeros(Margin, 0) if path.margins is None else path.margins.table
    size, count = 0, len(path.poses) + 8
    while count > size:
        size = count
        table = zeros(Passed, size)
        count = kernel().find_passings(
            path.scene, path.poses.table, margins, path.events.table, touch, path.reach, table
        )
    return table[:count]
