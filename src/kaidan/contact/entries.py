"""What Python calls of the kernel: the mark of an entry, and the modules in their order."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

_F = TypeVar("_F", bound=Callable[..., Any])

#: Kernel modules in the order in which they import one another.
KERNEL_MODULES = (
    "trigonometry",
    "gaps",
    "nearest_feature",
    "settling",
    "continuation",
    "event_location",
    "advance",
    "rotation",
    "closing",
    "turning_closing",
    "first_closing",
    "toppling",
    "reserves",
    "recording",
    "renaming",
    "contact_changes",
    "driver",
    "forces",
    "cones",
    "passings",
    "heaps",
    "way_order",
    "peaks",
    "supports",
    "grousers",
    "grip",
    "slipping",
    "margins",
    "energy_margins",
    "peak_search",
    "phases",
    "sampling",
    "first_rock",
    "extremes",
    "standing",
    "impact",
    "holding",
    "rating",
    "batch",
)
KERNEL_PACKAGE = "kaidan.contact.kernel"


def entry(function: _F) -> _F:
    """Mark a kernel function that is called from outside the kernel; it is returned unchanged."""
    function.__dict__["_kaidan_entry"] = True
    return function
