"""One `kaidan.assess(...)` from Python, sheets in hand, in milliseconds: the least of many.

By the closed form and by the contact model, with the posture stated and with the best one found.
Names of the catalogue are read and validated at each call, so their time is shown apart. Time is
the processor's, which says about the same on a machine that does other things too. Ratings, stances
and outlines that are remembered are forgotten before each run, so that every run is a first answer.
"""

import argparse
import time
from collections.abc import Callable
from functools import partial
from math import radians

import kaidan
from kaidan import Robot, Stairs, Surface
from kaidan.assessment.plan_scores import rated_on
from kaidan.outline import outline_of
from kaidan.robot.robot import stance_of
from record import finish, options

ONE = 1.0
"""Target of every certain question to the closed form [ms]."""
STATED, FOUND, POSTURE, COMPARED = 3.0, 25.0, 50.0, 1500.0
"""Targets of the contact model [ms]: posture stated; found, with advice; the verbs."""
assess = partial(kaidan.assess, model="closed-form", flippers="stowed")


def milliseconds(action: Callable[[], object], runs: int) -> float:
    times = []
    for _ in range(runs):
        for remembered in (rated_on, outline_of, stance_of):
            remembered.cache_clear()
        start = time.process_time()
        action()
        times.append(time.process_time() - start)
    return 1e3 * min(times)


def questions() -> dict[str, Callable[[], object]]:
    """Questions by the verdict that they get, which `main` checks."""
    kenaf, absolem = Robot.named("kenaf"), Robot.named("absolem")
    doubted = kenaf.model_copy(
        update={"uncertainty": type(kenaf.uncertainty)(com_from_front=0.005, com_height=0.003)}
    )
    ibc, grippy = Stairs.named("ibc"), Surface.of_friction(2.0)
    slippery = Surface.of_friction(0.5)

    def flight(angle: float, spacing: float = 0.15) -> Stairs:
        return Stairs.inclined(angle=radians(angle), nosing_spacing=spacing)

    easy, doubtful, steep, long = flight(50), flight(55.5), flight(62), flight(50, 0.2)
    return {
        "go": lambda: assess(kenaf, easy, surface=grippy),
        "go, payload and flippers flat": lambda: assess(
            absolem, ibc, surface=grippy, flippers="flat", speed=0.1
        ),
        "unsure, with advice": lambda: assess(kenaf, doubtful, surface=grippy),
        "no-go, with advice": lambda: assess(kenaf, steep, surface=grippy),
        "no-go, with more advice": lambda: assess(kenaf, long, surface=slippery, acceleration=0.2),
        "outside-model": lambda: assess(kenaf, ibc, surface=grippy),
        "go, uncertain": lambda: assess(doubted, easy, surface=grippy),
        "no-go, uncertain, with advice": lambda: assess(doubted, steep, surface=grippy),
        "unsure, names of the catalogue": lambda: assess(
            "absolem", "ibc", surface="concrete-dry", flippers="flat"
        ),
    }


def contact_questions() -> dict[str, tuple[Callable[[], object], float]]:
    """Questions to the contact model by the verdict that they get, and their targets [ms]."""
    absolem, hull, ibc = Robot.named("absolem"), Robot.named("absolem-flat"), Stairs.named("ibc")
    concrete = Surface.named("concrete-dry")
    ask = partial(kaidan.assess, stairs=ibc)
    return {
        "go, posture stated": (lambda: ask(hull, friction=2.0, flippers="stowed"), STATED),
        "unsure, posture stated, with advice": (
            lambda: ask(absolem, surface=concrete, flippers="flat"),
            FOUND,
        ),
        "go, best posture": (lambda: ask(absolem, friction=1.2), FOUND),
        "unsure, best posture, with advice": (lambda: ask(absolem, surface=concrete), FOUND),
    }


def verbs() -> dict[str, tuple[Callable[[], object], float]]:
    """Verbs that find the best posture, and their targets [ms]."""
    return {
        "posture, absolem on ibc": (lambda: kaidan.posture("absolem", "ibc"), POSTURE),
        "compare, robots of the catalogue on its stairs, best postures": (
            lambda: kaidan.compare(surface="concrete-dry"),
            COMPARED,
        ),
    }


def main() -> None:
    arguments = options(argparse.ArgumentParser(description=__doc__))
    arguments.add_argument("--runs", type=int, default=200)
    chosen = arguments.parse_args()
    figures, targets = {}, {}
    for name, question in questions().items():
        verdict = question().verdict  # type: ignore[attr-defined]
        assert name.split(",")[0] == verdict, (name, verdict)
        key = f"{name} [ms]"
        figures[key] = milliseconds(question, chosen.runs)
        if "uncertain" not in name and "names" not in name:
            targets[key] = ONE
    for name, (question, target) in contact_questions().items():
        verdict = question().verdict  # type: ignore[attr-defined]
        assert name.split(",")[0] == verdict, (name, verdict)
        key = f"contact model: {name} [ms]"
        figures[key], targets[key] = milliseconds(question, max(1, chosen.runs // 20)), target
    for name, (verb, target) in verbs().items():
        figures[f"{name} [ms]"], targets[f"{name} [ms]"] = milliseconds(verb, 2), target
    finish(figures, chosen, targets)


if __name__ == "__main__":
    main()
