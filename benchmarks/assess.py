"""One `kaidan.assess(...)` from Python, sheets in hand, in milliseconds: the median of many.

By the closed form, which has a target, and by the contact model as it stands without numba. Names
of the catalogue are read and validated at each call, so their time is shown apart.
"""

import argparse
import statistics
import time
from collections.abc import Callable
from functools import partial
from math import radians

import kaidan
from kaidan import Robot, Stairs, Surface
from record import finish, options

ONE = 1.0
"""Target of every certain question to the closed form [ms]."""
assess = partial(kaidan.assess, model="closed-form")


def milliseconds(action: Callable[[], object], runs: int) -> float:
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        action()
        times.append(time.perf_counter() - start)
    return 1e3 * statistics.median(times)


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

    easy, doubtful, steep, long = flight(50), flight(57), flight(62), flight(50, 0.2)
    return {
        "go": lambda: assess(kenaf, easy, surface=grippy),
        "go, payload and flippers flat": lambda: assess(
            absolem, ibc, surface=grippy, flippers="flat", speed=0.1
        ),
        "caution, with advice": lambda: assess(kenaf, doubtful, surface=grippy),
        "no-go, with advice": lambda: assess(kenaf, steep, surface=grippy),
        "no-go, with more advice": lambda: assess(kenaf, long, surface=slippery, acceleration=0.2),
        "outside-model": lambda: assess(kenaf, ibc, surface=grippy),
        "go, uncertain": lambda: assess(doubted, easy, surface=grippy),
        "no-go, uncertain, with advice": lambda: assess(doubted, steep, surface=grippy),
        "caution, names of the catalogue": lambda: assess(
            "absolem", "ibc", surface="concrete-dry", flippers="flat"
        ),
        "go, contact model": lambda: kaidan.assess(absolem, ibc, surface=grippy, flippers="flat"),
        "caution, contact model, with advice": lambda: kaidan.assess(
            absolem, ibc, surface=Surface.named("concrete-dry"), flippers="flat"
        ),
        "go, contact model, its plan found": lambda: kaidan.assess(
            absolem, ibc, friction=1.2, flippers="best"
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
        contact = "contact" in name
        figures[key] = milliseconds(question, chosen.runs // 20 if contact else chosen.runs)
        if not contact and "uncertain" not in name and "names" not in name:
            targets[key] = ONE
    finish(figures, chosen, targets)


if __name__ == "__main__":
    main()
