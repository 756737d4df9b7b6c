"""A trial in MuJoCo over the way: inclination, forces of the nosings, traction."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from kaidan.errors import InputError
from kaidan.physics import TrialResult
from kaidan.report import look

_HEIGHT = 5.6
_MARKS = ((look.BLUE, "-"), (look.VERMILION, "--"), (look.GREEN, "-."), (look.PURPLE, ":"))


def trial_figure(result: TrialResult) -> Figure:
    """Figure of a logged trial.

    Raises
    ------
    InputError
        A trial that was not logged, or ended before the track moved.
    """
    log = result.log
    if log is None or len(log) == 0:
        raise InputError(f"trial: it has no log to draw (outcome: {result.outcome.value})")
    spec = result.spec
    way = 1e3 * log.columns["belt_m"]
    with look.settings():
        figure = look.blank(_HEIGHT)
        turn, force, pull = (
            figure.add_axes((0.10, bottom, 0.72, 0.24)) for bottom in (0.64, 0.36, 0.08)
        )
        turn.plot(way, log.columns["extra_deg"], color=look.BLACK)
        turn.axhline(0.0, color=look.GREY, linewidth=0.6)
        turn.set_ylabel("extra inclination [°]")
        _draw_forces(force, way, log.forces[:, :, 1])
        force.set_ylabel("normal force [N]")
        pull.plot(way, log.columns["traction_N"], color=look.BLACK)
        pull.set_ylabel("traction [N]")
        pull.set_xlabel("way of the belt [mm]")
        for axes in (turn, force, pull):
            axes.set_xlim(float(way[0]), float(way[-1]))
        for axes in (turn, force):
            axes.set_xticklabels([])
        told = result.outcome.value.replace("_", " ")
        look.title(
            figure,
            0.6,
            f"{look.named(spec.robot.name)} on {look.named(spec.stairs.name)}: {told}",
            f"{spec.track.kind}, {spec.direction} {spec.facing}, {spec.speed:g} m/s, "
            f"friction {spec.static_friction:g}, seed {spec.seed}",
        )
    return figure


def _draw_forces(axes: Axes, way: look.Array, forces: look.Array) -> None:
    """One line a nosing that was touched; a fall's blows are cut off."""
    touched = np.flatnonzero(np.abs(forces).max(axis=0) > 0)
    top = 1.15 * float(np.quantile(forces.max(axis=1), 0.98)) if len(touched) else 1.0
    for place, k in enumerate(touched):
        colour, style = _MARKS[place % len(_MARKS)]
        axes.plot(way, forces[:, k], color=colour, linestyle=style, linewidth=1.0,
                  label=f"nosing {k + 1}")  # fmt: skip
    axes.set_ylim(0.0, max(top, 1.0))
    if len(touched):
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.05), frameon=False)
