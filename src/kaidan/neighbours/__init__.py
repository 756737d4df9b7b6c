"""The neighbouring systems from the paper's references, re-derived, each "after" its authors.

Endo & Nagatani 2016 stand among others who asked other questions of robots on stairs. Their texts
were not at hand (what of them could be seen, ``docs/neighbours.md`` says): the question is theirs,
the formulas are derived anew from the mechanics of this package, and no equation is quoted.

``entering`` (after Guo et al. 2010), ``climbing_ability`` (after Liu J. et al. 2005),
``tipover_monitor`` (after Liu & Liu 2009), ``heading`` (after Martens & Newman 1994), ``balance``
and ``equilibria`` (after Magid et al. 2010), ``rollover`` and ``guarded_drive`` (after Ohno et al.
2009), ``subtracks`` (after Okada et al. 2010, 2011).
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from kaidan.neighbours.balance import balance_along
    from kaidan.neighbours.climbing_ability import climbing_conditions
    from kaidan.neighbours.entering import first_step
    from kaidan.neighbours.equilibria import stable_poses
    from kaidan.neighbours.guarded_drive import drive_guarded
    from kaidan.neighbours.heading_loop import HeadingLoop, heading_run, losing_start
    from kaidan.neighbours.rollover import avoid_rollover, stability_margin
    from kaidan.neighbours.samples import Sample, samples_of
    from kaidan.neighbours.subtracks import Scan, follow_terrain, touching_angle
    from kaidan.neighbours.tipover_monitor import AlarmLimits, Monitor, readings

_HOME = {
    "AlarmLimits": "tipover_monitor",
    "HeadingLoop": "heading_loop",
    "Monitor": "tipover_monitor",
    "Sample": "samples",
    "Scan": "subtracks",
    "avoid_rollover": "rollover",
    "balance_along": "balance",
    "climbing_conditions": "climbing_ability",
    "drive_guarded": "guarded_drive",
    "first_step": "entering",
    "follow_terrain": "subtracks",
    "heading_run": "heading_loop",
    "losing_start": "heading_loop",
    "readings": "tipover_monitor",
    "samples_of": "samples",
    "stability_margin": "rollover",
    "stable_poses": "equilibria",
    "touching_angle": "subtracks",
}
"""Public names and the module of each, imported when first used."""

__all__ = [  # noqa: RUF022 - in the order of the systems
    "first_step",
    "climbing_conditions",
    "Sample",
    "samples_of",
    "AlarmLimits",
    "Monitor",
    "readings",
    "HeadingLoop",
    "heading_run",
    "losing_start",
    "balance_along",
    "stable_poses",
    "stability_margin",
    "avoid_rollover",
    "drive_guarded",
    "Scan",
    "touching_angle",
    "follow_terrain",
]


def __getattr__(name: str) -> Any:
    """Public names, imported when first used."""
    if name not in _HOME:
        raise AttributeError(f"module 'kaidan.neighbours' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"kaidan.neighbours.{_HOME[name]}"), name)


def __dir__() -> list[str]:
    return sorted(__all__)
