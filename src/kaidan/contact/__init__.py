"""Quasi-static contact of a tracked robot with any two-dimensional profile, numbers only."""

from kaidan.contact.compiling import numba_is_installed, numba_is_loaded
from kaidan.contact.driving import (
    STEP,
    Demand,
    Event,
    GradeOne,
    Settled,
    Status,
    Traverse,
    grade_one,
    settle,
    steepest_flight,
    traverse,
    traverse_many,
)
from kaidan.contact.tables import BELLY, FLIPPER, TRACK, body_table, ground_table, mirror

__all__ = [
    "BELLY",
    "FLIPPER",
    "STEP",
    "TRACK",
    "Demand",
    "Event",
    "GradeOne",
    "Settled",
    "Status",
    "Traverse",
    "body_table",
    "grade_one",
    "ground_table",
    "mirror",
    "numba_is_installed",
    "numba_is_loaded",
    "settle",
    "steepest_flight",
    "traverse",
    "traverse_many",
]
