"""Identities already in a store: millions of them in 16 bytes each."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

_RECENT = 65_536


class Known:
    """Set of identities (32 hex digits) that only grows.

    Examples
    --------
    >>> known = Known()
    >>> known.add("0" * 31 + "1"), known.add("0" * 31 + "1"), len(known)
    (True, False, 1)
    """

    def __init__(self) -> None:
        self._sorted: NDArray[np.uint64] = np.empty((0, 2), dtype=np.uint64)
        self._recent: set[int] = set()

    def __len__(self) -> int:
        return len(self._sorted) + len(self._recent)

    def __contains__(self, identity: str) -> bool:
        whole = int(identity, 16)
        if whole in self._recent:
            return True
        high, low = np.uint64(whole >> 64), np.uint64(whole & (2**64 - 1))
        first = int(np.searchsorted(self._sorted[:, 0], high, "left"))
        last = int(np.searchsorted(self._sorted[:, 0], high, "right"))
        return bool((self._sorted[first:last, 1] == low).any())

    def add(self, identity: str) -> bool:
        """Add an identity; say whether it is new."""
        if identity in self:
            return False
        self._recent.add(int(identity, 16))
        if len(self._recent) >= _RECENT:
            self._settle()
        return True

    def update(self, identities: Iterable[str]) -> None:
        """Add many."""
        for identity in identities:
            self.add(identity)

    def _settle(self) -> None:
        """Sort what came since last time into the array."""
        recent = np.array(
            [(whole >> 64, whole & (2**64 - 1)) for whole in self._recent], dtype=np.uint64
        )
        joined = np.concatenate((self._sorted, recent))
        self._sorted = np.asfortranarray(joined[np.lexsort((joined[:, 1], joined[:, 0]))])
        self._recent = set()
