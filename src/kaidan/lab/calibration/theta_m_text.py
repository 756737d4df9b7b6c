"""What theta_M depends on, as text."""

from typing import TYPE_CHECKING

from kaidan.tables import fixed, table

if TYPE_CHECKING:
    from kaidan.lab.calibration.theta_m import Run, ThetaMStudy


def text(found: "ThetaMStudy") -> str:
    """Effects, the largest first, then the runs that come nearest to the paper's figure."""
    low, high = found.printed_deg
    each = [
        {
            "factor": one.factor.replace("_", " "),
            "from": f"{one.low:g} to {one.high:g}",
            "theta_M": fixed(one.theta_M_deg, sign="+"),
            "up": fixed(one.up_deg, sign="+"),
        }
        for one in found.effects
    ]
    known = [run for run in found.runs if run.theta_M_deg is not None]
    inside = [run for run in known if low <= (run.theta_M_deg or 0.0) <= high]
    both = [run for run in inside if 54.0 <= (run.up_deg or 0.0) <= 58.0]
    runs = [f"  {_run(run)}" for run in both] or ["  No run has its fall zone, 54 to 58 deg, too."]
    return "\n".join(
        [
            f"{found.robot}: theta_M {fixed(found.mean_deg)} deg over {len(known)} of "
            f"{len(found.runs)} runs, {found.trials} trials a condition; the text has "
            f"{low:g} to {high:g}",
            "",
            table(each, {"factor": "factor", "from": "from low to high",
                         "theta_M": "theta_M by [deg]", "up": "margin up by [deg]"}),
            "",
            f"  A factor that changes nothing: {fixed(found.scatter_deg)} deg. "
            f"{len(inside)} of {len(known)} runs lie within the text's range.",
            *runs,
        ]
    )  # fmt: skip


def _run(run: "Run") -> str:
    """A run that has theta_M and the fall zone, with its levels."""
    levels = ", ".join(
        f"{name.replace('_', ' ')} {value:g}"
        for name, value in run.levels.items()
        if name != "idle"
    )
    return (
        f"It and the fall zone too: theta_M {fixed(run.theta_M_deg)} deg, falls from "
        f"{fixed(run.up_deg)} deg; {levels}"
    )
