"""`assess` by both models on regular flights, where both answer."""

import math

import numpy as np
import pytest

from kaidan.assessment import answer_to, case_of
from kaidan.robot import Robot, Track
from kaidan.stairs import Stairs

pytestmark = pytest.mark.usefixtures("compiled_kernel")

pytest.importorskip("numba")  # a hundred whole flights take minutes without the compiled kernel

RANK = {"go": 0, "caution": 1, "no-go": 2, "outside-model": 3}
TOLERANCE = 6e-5  # deg: the 1e-6 rad


def cases(number, seed):
    rng = np.random.default_rng(seed)
    found = 0
    while found < number:
        L = rng.uniform(0.3, 1.2)
        p, angle = L / rng.uniform(2.1, 5.0), rng.uniform(0.2, 0.9)
        if p * math.sin(angle) < 0.02:
            continue
        robot = Robot(
            name="r",
            com_from_front=L * rng.uniform(0.25, 0.75),
            com_height=L * rng.uniform(0.08, 0.3),
            track=Track(
                flat_length=L,
                front_radius=rng.uniform(0.01, 0.12),
                rear_radius=rng.uniform(0.01, 0.12),
            ),
        )
        stairs = Stairs.inclined(angle=angle, nosing_spacing=p, steps=math.ceil(L / p) + 5)
        found += 1
        yield case_of(
            robot,
            stairs,
            friction=None if rng.random() < 0.1 else float(rng.uniform(0.4, 3.0)),
            direction=rng.choice(["up", "down"]),
            facing=rng.choice(["nose-first", "tail-first"]),
            acceleration=float(rng.choice([0.0, rng.uniform(-1.5, 1.5)])),
        )


def test_grade_one_is_the_closed_form_and_verdicts_are_never_more_lenient():
    import numba  # noqa: F401 - whatever is loaded is used

    seen = dict.fromkeys(RANK, 0)
    for case in cases(200, seed=1):
        contact, closed = (answer_to(case, model=model) for model in ("contact", "closed-form"))
        grades = contact.grades
        for mode in ("tip_downhill", "tip_uphill"):
            mine, theirs = contact.margins_deg[mode], closed.margins_deg[mode]
            if grades.caught:  # what does not arrive counts as a fall where no margin says so
                assert mine == pytest.approx(theirs, abs=TOLERANCE)
        seen[contact.verdict] += 1
        if contact.verdict == "go":
            assert closed.verdict == "go"
            assert grades.no_rotation
            assert grades.caught_with_momentum
            assert case.surface is not None
            assert contact.margin_deg > 0
            # going down, the edge of the upper landing has to be turned over
            phases = [e for e in contact.phases if case.direction == "up" or e.phase != "enter"]
            energies = [e.energy_margin_mm for e in phases if e.energy_margin_mm is not None]
            assert min(energies) > grades.energy_threshold_mm
        if RANK[contact.verdict] < RANK[closed.verdict]:
            # the one way to be kinder: a catch, and then a caution that says so
            assert contact.verdict == "caution"
            assert (
                not grades.no_rotation
                or contact.margins_deg["tip_downhill"] <= 0
                or (contact.margins_deg["tip_uphill"] <= 0)
            )
            assert grades.caught
    assert min(seen["go"], seen["caution"], seen["no-go"]) > 10
