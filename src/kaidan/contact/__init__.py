"""Quasi-static contact of a tracked robot with any two-dimensional profile, numbers only."""

from kaidan.contact.between import Between, samples_of
from kaidan.contact.codes import (
    BELLY,
    BESIDE_NOSINGS,
    EVERY_POSE,
    FLIPPER,
    NO_POSE,
    ROCKING,
    TRACK,
    Event,
    PartKind,
    RotationOutcome,
    Status,
)
from kaidan.contact.contacts import Contact, pair_forces, spring_loads
from kaidan.contact.extremes import Manner, Sampled, extremes_of
from kaidan.contact.features import Feature, FeatureKind, FeatureTable
from kaidan.contact.heights import TouchingHeights, touching_heights
from kaidan.contact.layout import Belts, Extreme, Grousers, Job
from kaidan.contact.layout import Forces as PairForces
from kaidan.contact.nosings import nosings_passed
from kaidan.contact.path import Path, joined
from kaidan.contact.phases import Zone, phases_by_zones
from kaidan.contact.rating import belts_on, rate_many
from kaidan.contact.records import (
    ONE_PLACE,
    Body,
    EventRecord,
    Events,
    Ground,
    Margins,
    Placement,
    Poses,
    Ratings,
    RotationRecord,
    Rotations,
    Summaries,
)
from kaidan.contact.remembered import ground_of
from kaidan.contact.rest import Settled, resting_height, settle
from kaidan.contact.rotations import impact_speeds, rotated
from kaidan.contact.slipping import held_while_slipping
from kaidan.contact.standing import belt_slides, stand_in_turn
from kaidan.contact.steepest import steepest_flight
from kaidan.contact.supports import Supports
from kaidan.contact.switch import (
    kernel_in_use,
    use_kernel,
    using_kernel,
    without_native,
)
from kaidan.contact.tables import body_table, ground_table, mirror, without_folds
from kaidan.contact.traversing import STEP, arrives, plain_seconds, traverse, traverse_many

__all__ = [
    "BELLY",
    "BESIDE_NOSINGS",
    "EVERY_POSE",
    "FLIPPER",
    "NO_POSE",
    "ONE_PLACE",
    "ROCKING",
    "STEP",
    "TRACK",
    "Belts",
    "Between",
    "Body",
    "Contact",
    "Event",
    "EventRecord",
    "Events",
    "Extreme",
    "Feature",
    "FeatureKind",
    "FeatureTable",
    "Ground",
    "Grousers",
    "Job",
    "Manner",
    "Margins",
    "PairForces",
    "PartKind",
    "Path",
    "Placement",
    "Poses",
    "Ratings",
    "RotationOutcome",
    "RotationRecord",
    "Rotations",
    "Sampled",
    "Settled",
    "Status",
    "Summaries",
    "Supports",
    "TouchingHeights",
    "Zone",
    "arrives",
    "belt_slides",
    "belts_on",
    "body_table",
    "extremes_of",
    "ground_of",
    "ground_table",
    "held_while_slipping",
    "impact_speeds",
    "joined",
    "kernel_in_use",
    "mirror",
    "nosings_passed",
    "pair_forces",
    "phases_by_zones",
    "plain_seconds",
    "rate_many",
    "resting_height",
    "rotated",
    "samples_of",
    "settle",
    "spring_loads",
    "stand_in_turn",
    "steepest_flight",
    "touching_heights",
    "traverse",
    "traverse_many",
    "use_kernel",
    "using_kernel",
    "without_folds",
    "without_native",
]
