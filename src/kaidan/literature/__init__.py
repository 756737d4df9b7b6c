"""The neighbouring systems from the paper's references, re-derived, each "after" its authors.

Endo & Nagatani 2016 stand among others who put other questions to robots on stairs. Their texts
were not at hand (what of them could be seen, ``docs/literature.md`` says): the question is theirs,
the formulas are derived anew from the mechanics of this package, and no equation is quoted.

``entering`` (after Guo et al. 2010), ``climbing_ability`` (after Liu J. et al. 2005),
``tipover`` (after Liu & Liu 2009; `kaidan.monitor` stands on it), ``heading`` (after Martens &
Newman 1994), ``balance`` and ``equilibria`` (after Magid et al. 2010), ``rollover`` and
``guarded_drive`` (after Ohno et al. 2009), ``subtracks`` (after Okada et al. 2010, 2011).
"""

from typing import TYPE_CHECKING

from kaidan.lazy import when_used

if TYPE_CHECKING:
    from kaidan.literature.balance import balance_along
    from kaidan.literature.climbing_ability import climbing_conditions
    from kaidan.literature.entering import first_step
    from kaidan.literature.equilibria import stable_poses
    from kaidan.literature.guarded_drive import drive_guarded
    from kaidan.literature.heading_loop import HeadingLoop, heading_run, losing_start
    from kaidan.literature.rollover import avoid_rollover, stability_margin
    from kaidan.literature.subtracks import Scan, follow_terrain, touching_angle

_HOME = {
    "HeadingLoop": "heading_loop",
    "Scan": "subtracks",
    "avoid_rollover": "rollover",
    "balance_along": "balance",
    "climbing_conditions": "climbing_ability",
    "drive_guarded": "guarded_drive",
    "first_step": "entering",
    "follow_terrain": "subtracks",
    "heading_run": "heading_loop",
    "losing_start": "heading_loop",
    "stability_margin": "rollover",
    "stable_poses": "equilibria",
    "touching_angle": "subtracks",
}
"""Public names and the module of each, imported when first used."""

__all__ = [  # noqa: RUF022 - in the order of the systems
    "first_step",
    "climbing_conditions",
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

__getattr__ = when_used("kaidan.literature", _HOME)


def __dir__() -> list[str]:
    return sorted(__all__)
