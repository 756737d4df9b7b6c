"""Features by name: what touches what, of which the kernel has one number."""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.contact.layout import (
    DISC_1,
    DISC_2,
    KIND_MASK,
    PART,
    PART_BITS,
    PART_MASK,
    POINT,
    POINT_BITS,
    VERTEX,
)


class FeatureKind(IntEnum):
    """Kinds of features: what touches what."""

    VERTEX = VERTEX
    """A point of the ground under a part."""
    DISC_1 = DISC_1
    """The first end disc of a part on a segment of the ground."""
    DISC_2 = DISC_2
    """The second end disc of a part on a segment of the ground."""


class Feature(NamedTuple):
    """What touches what: a point of the ground (the start of a segment) and a part of the robot."""

    point: int
    part: int
    kind: FeatureKind

    @classmethod
    def of(cls, code: float) -> Feature:
        """Read the kernel's code of a feature.

        Examples
        --------
        >>> Feature.of(64 * 7 + 4 * 1 + 2)
        Feature(point=7, part=1, kind=<FeatureKind.DISC_2: 2>)
        """
        number = int(code)
        return cls(
            number >> POINT_BITS,
            (number >> PART_BITS) & PART_MASK,
            FeatureKind(number & KIND_MASK),
        )

    @property
    def code(self) -> int:
        """The kernel's number for it."""
        return POINT * self.point + PART * self.part + self.kind


class FeatureTable(NamedTuple):
    """Several features, each part of the code as an array."""

    point: NDArray[np.int64]
    part: NDArray[np.int64]
    kind: NDArray[np.int64]

    @classmethod
    def of(cls, codes: NDArray[np.int64]) -> FeatureTable:
        """Read the kernel's codes of some features.

        Examples
        --------
        >>> [int(each[0]) for each in FeatureTable.of(np.array([64 * 7 + 4 * 1 + 2]))]
        [7, 1, 2]
        """
        return cls(codes >> POINT_BITS, (codes >> PART_BITS) & PART_MASK, codes & KIND_MASK)
