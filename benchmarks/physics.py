"""Trials in MuJoCo: what a second of the robot's time costs on one core, by model of the track."""

import argparse
import statistics
from math import radians

from kaidan.physics import (
    DrivenGrousers,
    ShoeChain,
    SmoothBelt,
    SprungNoses,
    TrialSpec,
    YieldingBelt,
    run,
)
from kaidan.question import Question
from kaidan.terrain.stairs import Stairs
from record import finish, options

TARGETS = {
    "smooth-belt": 12.5,
    "yielding-belt": 25.0,
    "sprung-noses": 25.0,
    "driven-grousers": 170.0,
    "shoe-chain": 500.0,
}
"""Most milliseconds a second: 80 times real time for the smooth belt, 40 times for the yielding one
(the issues' figures); the others keep the paper's whole experiment, 240 trials of 4 s, within
minutes."""
SPRING = 3e4


def milliseconds_a_second(spec: TrialSpec, runs: int) -> float:
    costs = []
    for _ in range(runs):
        result = run(spec)
        costs.append(1e3 * result.wall_time_s / result.time_s)
    return statistics.median(costs)


def main() -> None:
    arguments = options(argparse.ArgumentParser(description=__doc__))
    arguments.add_argument("--runs", type=int, default=15)
    chosen = arguments.parse_args()
    stairs = Stairs.inclined(angle=radians(55), nosing_spacing=0.15)
    question = Question.in_one_posture("kenaf", stairs)
    figures, targets = {}, {}
    yielding = YieldingBelt(stiffness=4.8e4, shear_ratio=1.1, damping_ratio=0.05)
    tracks = (
        SmoothBelt(), yielding, SprungNoses(stiffness=SPRING), DrivenGrousers(), ShoeChain()
    )  # fmt: skip
    for track in tracks:
        spec = TrialSpec(question=question, track=track, start_offset=0.3)
        run(spec)  # what is imported and compiled once
        key = f"{track.kind} [ms a second]"
        light = track.kind not in ("driven-grousers", "shoe-chain")
        figures[key] = milliseconds_a_second(spec, chosen.runs if light else 3)
        targets[key] = TARGETS[track.kind]
    finish(figures, chosen, targets)


if __name__ == "__main__":
    main()
