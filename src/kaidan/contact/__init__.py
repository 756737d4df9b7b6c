"""Quasi-static contact of a tracked robot with any two-dimensional profile, numbers only."""

from kaidan.contact.driving import (
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
    "settle",
    "steepest_flight",
    "traverse",
    "traverse_many",
]
