"""A trial in MuJoCo over the path of the belt: inclination, forces of the nosings, traction."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from kaidan.errors import InputError
from kaidan.figures import style as look
from kaidan.text.trial import ended
from kaidan.words import heading

if TYPE_CHECKING:
    from kaidan.physics import TrialLog

_HEIGHT = 5.6
_COLOURS = (look.BLUE, look.VERMILION, look.GREEN, look.PURPLE, look.ORANGE, look.SKY, look.BLACK)
_STYLES = ("-", "--", "-.", ":")


def trial_figure(log: "TrialLog") -> Figure:
    """Figure of a trial."""
    result = log.result
    if len(log) == 0:
        raise InputError(f"trial: it has no log to draw (outcome: {result.outcome.value})")
    spec, question = result.spec, result.spec.question
    belt = 1e3 * log.columns["belt_m"]
    with look.settings():
        figure = look.blank(_HEIGHT)
        extra, force, pull = (
            figure.add_axes((0.10, bottom, 0.72, 0.24)) for bottom in (0.64, 0.36, 0.08)
        )
        extra.plot(belt, log.columns["extra_deg"], color=look.BLACK)
        extra.axhline(0.0, color=look.GREY, linewidth=0.6)
        extra.set_ylabel("extra inclination [°]")
        _draw_forces(force, belt, log.forces[:, :, 1])
        force.set_ylabel("normal force [N]")
        pull.plot(belt, log.columns["traction_N"], color=look.BLACK)
        pull.set_ylabel("traction [N]")
        pull.set_xlabel("path of the belt [mm]")
        for axes in (extra, force, pull):
            axes.set_xlim(float(belt[0]), float(belt[-1]))
        for axes in (extra, force):
            axes.set_xticklabels([])
        look.title(
            figure,
            0.6,
            f"{look.named(question.robot.name)} on {look.named(question.terrain_name)}: "
            f"{ended(result)}",
            f"{spec.track.kind}, {heading(question)}, {spec.speed:g} m/s, "
            f"friction {spec.static_friction:g}, seed {spec.seed}",
        )
    return figure


def _draw_forces(axes: Axes, belt: look.Array, forces: look.Array) -> None:
    """One line a nosing that was touched; a fall's blows are cut off."""
    touched = np.flatnonzero(np.abs(forces).max(axis=0) > 0)
    top = 1.15 * float(np.quantile(forces.max(axis=1), 0.98)) if len(touched) else 1.0
    for place, k in enumerate(touched):
        colour, style = _COLOURS[place % len(_COLOURS)], _STYLES[place % len(_STYLES)]
        axes.plot(belt, forces[:, k], color=colour, linestyle=style, linewidth=1.0,
                  label=f"nosing {k + 1}")  # fmt: skip
    axes.set_ylim(0.0, max(top, 1.0))
    if len(touched):
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.05), frameon=False)
