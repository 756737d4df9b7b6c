"""What trials in MuJoCo say beside their outcome, for people."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.models.dynamic_figures import TrialFigures
    from kaidan.physics import TrialResult


def no_evidence(trial: "TrialResult") -> str:
    """Why a trial says nothing about the robot."""
    if trial.outcome.value == "unstable":
        return "the simulation diverged, which says nothing about the robot"
    return "the trial falls before the track moves: the robot cannot stand where it is placed"


def notes(trials: Sequence["TrialResult"]) -> tuple[str, ...]:
    """What was simulated and what that leaves out."""
    first = trials[0]
    frictions = " and ".join(f"{trial.friction:g}" for trial in trials)
    each = [
        f"Simulated with a smooth rigid belt at {first.speed_m_s:g} m/s and a friction of "
        f"{frictions}. A trial shows whether the robot arrives, not by which margin."
    ]
    if first.mass_assumed:
        each.append(f"A mass of {first.mass_kg:g} kg is assumed: the sheet states none.")
    return tuple(each)


def sliding(trials: Sequence["TrialFigures"], where: str) -> str:
    """With which friction it slides, and with which it does not."""
    slides = [f"{each.friction:g}" for each in trials if each.outcome == "slid"]
    arrives = [f"{each.friction:g}" for each in trials if each.outcome == "climbed"]
    rest = f"; with {arrives[0]} it arrives" if arrives else ""
    return f"With a friction of {' and of '.join(slides)} it slides{where}{rest}."
