"""What trials in MuJoCo say beside their outcome, for people."""

from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.models.dynamic_figures import PhysicsFigures, TrialFigures
    from kaidan.physics import TrialResult


def no_evidence(trial: "TrialResult") -> str:
    """Why a trial says nothing about the robot."""
    if trial.outcome.value == "unstable":
        return "the simulation diverged, which says nothing about the robot"
    return "the trial falls before the track moves: the robot cannot stand where it is placed"


_TRACKS = {
    "smooth-belt": "a smooth rigid belt",
    "yielding-belt": "a smooth belt that yields",
    "driven-grousers": "a belt with grousers",
}


def simulated(figures: "PhysicsFigures") -> str:
    """What was simulated, in one line."""
    number = len(figures.trials)
    return (
        f"{number} {'trial' if number == 1 else 'trials'} with {_TRACKS[figures.track]} "
        f"at {figures.speed_m_s:g} m/s"
    )


def notes(trials: Sequence["TrialResult"], figures: "PhysicsFigures") -> tuple[str, ...]:
    """What was simulated and what that leaves out."""
    first = trials[0]
    frictions = sorted({trial.friction for trial in trials})
    used = " and ".join(f"{each:g}" for each in frictions)
    if len(frictions) > 2:
        used = f"{frictions[0]:.2f} to {frictions[-1]:.2f}"
    each = [
        f"Simulated with {_TRACKS[figures.track]} at {first.speed_m_s:g} m/s and a friction of "
        f"{used}. A trial shows whether the robot arrives, not by which margin."
    ]
    if figures.draws > 1:
        each.append(f"{count(figures)}, if the model of the track is right.")
    if first.mass_assumed:
        each.append(f"A mass of {first.mass_kg:g} kg is assumed: the sheet states none.")
    return tuple(each)


def count(figures: "PhysicsFigures") -> str:
    """How many trials fail, and how sure that is."""
    low, high = figures.failure_interval
    sure = f"{percent(low)} to {percent(high)}" if low else f"{percent(high)} or less"
    return (
        f"{figures.failed or 'None'} of {figures.draws} trials "
        f"{'fails' if figures.failed <= 1 else 'fail'}: {sure} would, with 95 % confidence"
    )


def percent(share: float) -> str:
    """Share as people read it."""
    return f"{100 * share:.2g} %" if share < 0.995 else "100 %"


def of_many(figures: "PhysicsFigures", happens: str | None) -> str:
    """Verdict of many trials in one sentence; what happens where they fail."""
    if happens is None:
        return f"{count(figures)}; trials know no margin."
    return f"{count(figures)}; most of them by {happens}."


def sliding(trials: Sequence["TrialFigures"], where: str) -> str:
    """With which friction it slides, and with which it does not."""
    slides = [f"{each.friction:g}" for each in trials if each.outcome == "slid"]
    arrives = [f"{each.friction:g}" for each in trials if each.outcome == "climbed"]
    rest = f"; with {arrives[0]} it arrives" if arrives else ""
    return f"With a friction of {' and of '.join(slides)} it slides{where}{rest}."


def trials(figures: "PhysicsFigures") -> list[str]:
    """Trials one by one, or of many how many ended in which way."""
    if figures.draws == 1:
        return [
            f"friction {each.friction:.2f}: {each.outcome.replace('_', ' ')}"
            for each in figures.trials
        ]
    ends = Counter(each.outcome.replace("_", " ") for each in figures.trials)
    return [count(figures), *(f"{number} {name}" for name, number in ends.most_common())]
