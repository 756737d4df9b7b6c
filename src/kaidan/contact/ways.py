"""Ways between two poses of a path on which a figure may be the largest."""

from __future__ import annotations

import numpy as np

from kaidan.contact.codes import PIECES
from kaidan.contact.columns import WAY_COLUMNS
from kaidan.contact.records import BoolArray
from kaidan.contact.switch import kernel
from kaidan.contact.tables import FloatArray, IntArray


class Ways:
    """Those of which the lines through their outer poses promise more than is found.

    Parameters
    ----------
    s
        Arclength of n poses [m].
    leads_on
        Whether the path leads on from each to the next (n - 1).
    values
        The figure at each pose.
    group
        Number of the group of each pose; negative: of none.
    tolerance
        Share of the largest figure of a group above which is not looked for [1].
    narrow
        Whether the way from each pose to the next may hide a peak that no line tells of (n - 1).
    """

    def __init__(
        self, s: FloatArray, leads_on: BoolArray, values: FloatArray, group: IntArray,
        tolerance: float, narrow: BoolArray | None,
    ) -> None:  # fmt: skip
        self._s, self._tolerance = np.ascontiguousarray(s), tolerance
        self._largest = np.empty(int(group.max(initial=-1)) + 1)
        self._ways = np.empty((len(s), WAY_COLUMNS))
        self._kept, self._chosen = self._ways, np.empty(0, dtype=np.int64)
        self._count = self._many = 0
        if len(self._largest):
            hides = np.zeros(len(leads_on)) if narrow is None else narrow
            self._count = kernel().open_ways(
                self._s, leads_on.astype(np.int64), np.ascontiguousarray(values),
                np.ascontiguousarray(group, dtype=np.int64), hides.astype(np.int64),
                self._largest, tolerance, self._ways,
            )  # fmt: skip

    def cut_first(self, at_once: int) -> tuple[IntArray, FloatArray]:
        """Places that cut the most promising ways of each group into pieces.

        Parameters
        ----------
        at_once
            Ways of a group, at most.

        Returns
        -------
        rows, shares
            The pose before each, and the share of the arclength to the next; none where no way
            promises more than is found.
        """
        count, entries = self._count, kernel()
        if count == 0:
            return np.empty(0, dtype=np.int64), np.empty(0)
        chosen = np.empty(min(at_once * len(self._largest), count), dtype=np.int64)
        self._kept = np.empty((count, WAY_COLUMNS))
        self._many, found = entries.chosen_ways(
            self._ways, count, self._largest, self._tolerance, at_once,
            np.empty(count, dtype=np.int64), self._kept, chosen,
        )  # fmt: skip
        self._chosen = chosen[:found]
        rows = np.empty((PIECES - 1) * found, dtype=np.int64)
        shares = np.empty(len(rows))
        if found:
            entries.places_on_ways(self._s, self._kept, self._chosen, found, rows, shares)
        return rows, shares

    def cut(self, inside: FloatArray) -> None:
        """Go on with the pieces of the ways that were cut.

        Parameters
        ----------
        inside
            The figure at the places.
        """
        found = len(self._chosen)
        self._ways = np.empty((self._many - found + PIECES * found, WAY_COLUMNS))
        self._count = kernel().cut_ways(
            self._kept, self._many, self._chosen, found, np.ascontiguousarray(inside),
            self._largest, self._ways,
        )  # fmt: skip
