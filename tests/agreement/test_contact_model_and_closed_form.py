"""`assess` by both models on regular flights, where both answer."""

import math

import numpy as np
import pytest

from amounts import fast_and_slow
from kaidan.assessment import answer_to
from kaidan.modes import Verdict
from kaidan.question import Question
from kaidan.robot import Robot, Track
from kaidan.terrain.stairs import Stairs

TOLERANCE = 6e-5  # deg: the 1e-6 rad


def questions(number, seed):
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
        yield Question.in_one_posture(
            robot,
            stairs,
            friction=None if rng.random() < 0.1 else float(rng.uniform(0.4, 3.0)),
            direction=str(rng.choice(["up", "down"])),
            facing=str(rng.choice(["nose-first", "tail-first"])),
            acceleration=float(rng.choice([0.0, rng.uniform(-1.5, 1.5)])),
        )


@pytest.mark.parametrize("count", fast_and_slow(50, 200))
def test_grade_one_is_the_closed_form_and_verdicts_are_never_more_lenient(count):
    seen = dict.fromkeys(Verdict, 0)
    for question in questions(count, seed=1):
        contact, closed = (
            answer_to(question.changed(model=model)) for model in ("contact", "closed-form")
        )
        seen[Verdict(contact.verdict)] += 1
        if contact.verdict == "outside-model":  # it rocks under an acceleration
            assert question.acceleration != 0
            continue
        grades = contact.contact.grades
        for mode in ("tip_downhill", "tip_uphill"):
            mine, theirs = contact.findings.get(mode), closed.findings[mode]
            if mine is None:  # it fell before the flight, over the other end
                assert not grades.arrested
            elif mine.phase == "traverse":
                assert mine.margin == pytest.approx(theirs.margin, abs=TOLERANCE)
            else:  # entering and landing, where the closed form says nothing, decide
                assert mine.margin <= theirs.margin + TOLERANCE
        if contact.verdict == "go":
            assert closed.verdict == "go"
            assert grades.no_rotation
            assert grades.arrested_with_momentum
            assert question.surface is not None
            assert contact.margin_deg > 0
            # going down, the edge of the upper landing has to be rotated over
            phases = [
                each
                for each in contact.contact.phases
                if question.direction == "up" or each.phase != "enter"
            ]
            energies = [e.energy_margin_mm for e in phases if e.energy_margin_mm is not None]
            assert min(energies) > contact.contact.energy_threshold_mm
        if Verdict(contact.verdict).rank < Verdict(closed.verdict).rank:
            # the one way to be kinder: an arrested rotation, and then the answer says so
            assert contact.verdict in ("rough", "unsure")
            assert (
                not grades.no_rotation
                or contact.findings["tip_downhill"].margin <= 0
                or contact.findings["tip_uphill"].margin <= 0
            )
            assert grades.arrested
    arrested = seen[Verdict.ROUGH] + seen[Verdict.UNSURE]
    assert min(seen[Verdict.GO], arrested, seen[Verdict.NO_GO]) > 10
