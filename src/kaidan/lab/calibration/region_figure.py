"""What the evidence leaves of a yielding track's parameters: draws, pair by pair."""

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from kaidan.figures import style as look

if TYPE_CHECKING:
    from kaidan.lab.calibration.yielding import YieldingCalibration

_HEIGHT = 3.4
_LABELS = {
    "stiffness_N_m": ("stiffness $k$ [kN/m]", 1e-3),
    "shear_ratio": ("$k_t/k$", 1.0),
    "end_radius_m": ("radius of the ends [mm]", 1e3),
    "friction": ("friction", 1.0),
    "damping_ratio": ("damping ratio", 1.0),
}
_PAIRS = (
    ("stiffness_N_m", "shear_ratio"),
    ("stiffness_N_m", "end_radius_m"),
    ("friction", "damping_ratio"),
)


def region_figure(found: "YieldingCalibration") -> Figure:
    """Posterior draws over the whole range of the design."""
    tried = {each.name: each.tried for each in found.parameters}
    with look.settings():
        figure = look.blank(_HEIGHT)
        for at, (first, second) in enumerate(_PAIRS):
            axes = figure.add_axes((0.085 + 0.335 * at, 0.17, 0.21, 0.60))
            for name, part in ((first, "x"), (second, "y")):
                label, scale = _LABELS[name]
                low, high = tried[name]
                getattr(axes, f"set_{part}scale")("log")
                getattr(axes, f"set_{part}lim")(scale * low, scale * high)
                getattr(axes, f"set_{part}label")(label)
            axes.plot(
                [_LABELS[first][1] * each for each in found.draws[first]],
                [_LABELS[second][1] * each for each in found.draws[second]],
                linestyle="none", marker=".", markersize=2.5, color=look.BLUE,
            )  # fmt: skip
        look.title(
            figure,
            0.6,
            f"{look.named(found.robot)}: what theta_d and the fall zone leave of a yielding track",
            "each point a draw from the posterior; axes span what was tried; "
            f"{found.points} points, {found.trials} trials a condition",
        )
    return figure
