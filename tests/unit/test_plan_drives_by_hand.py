"""What is known of a plan before it is judged, of parts driven by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import Question, Robot, Stairs, contact
from kaidan.assessment import plan_drives as module
from kaidan.assessment.plan_drives import Drives, Passed, friction_without_failure
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.models.findings import Findings
from kaidan.modes import Phase
from kaidan.robot import Posture

STAIRS = Stairs(rise=0.17, going=0.29, steps=6)
ABSOLEM = Robot.named("absolem")


def plan(**given):
    return Question.of(ABSOLEM, STAIRS, **given).changed(best_of=(), posture={"front": 0.1})


# of a whole plan


def change(margin, torque, friction=0.1):
    return SimpleNamespace(best=margin, spare_torque=torque, required=friction)


@pytest.fixture
def required(monkeypatch):
    """Friction that a plan requires, of what its parts and its changes do."""

    def of(*moves, parts=(0.3, 0.4), arrived=True, surface="stated", **given):
        question = SimpleNamespace(
            surface=surface and SimpleNamespace(differs=surface == "differs"),
            uncertain=given.get("uncertain", False), yaw=given.get("yaw", 0.0), reserve=0.14,
            robot=SimpleNamespace(track=SimpleNamespace(has_grousers=given.get("grousers", False))),
        )  # fmt: skip

        def drive(asked, *, over, moved):
            assert (asked, moved) == (question, "known moves")
            assert over.keywords["reserve"] == 0.14
            over.keywords["needed"].extend(parts)
            return SimpleNamespace(moves=moves, arrived=arrived)

        monkeypatch.setattr(module.planned, "drive", drive)
        monkeypatch.setattr(module, "standing", lambda question, one: one)
        return friction_without_failure(question, moved="known moves")

    return of


def test_what_arrives_with_friction_and_torque_to_spare_is_no_failure(required):
    """The most of any part and change, in the best case."""
    assert required() == 0.4
    assert required(surface=None) == 0.4
    assert required(change(0.1, 0.5), change(0.01, math.nan, 0.7)) == 0.7
    for fails in (change(0.0, 0.5), change(-0.1, 0.5), change(0.1, 0.0), change(0.1, -0.5),
                  change(-0.1, -0.5)):  # fmt: skip
        assert math.isnan(required(change(0.1, 0.5), fails))
    assert math.isnan(required(arrived=False))
    for judged in ({"surface": "differs"}, {"uncertain": True}, {"yaw": 0.1}, {"grousers": True}):
        assert math.isnan(required(**judged))


# of a part


@pytest.fixture
def passed(monkeypatch):
    """A part of a plan, and what was asked of it."""

    def of(*, direction="up", facing="nose-first", friction=(0.5, 0.8), frictions=(0.3, 0.2, 9.0),
           arrives=(True, True), spare=0.1, status=contact.Status.OK):  # fmt: skip
        asked = {"tilts": [], "needed": []}
        profile = SimpleNamespace(reflected=lambda: "reflected")
        outline = SimpleNamespace(
            turned_round=lambda: SimpleNamespace(
                name="turned", stance=SimpleNamespace(flat_length=0.5)
            ),
            name="as it is", stance=SimpleNamespace(flat_length=0.5),
        )  # fmt: skip
        question = SimpleNamespace(
            direction=direction, facing=facing, outline=outline, acceleration=0.3,
            friction=friction,
        )  # fmt: skip

        def way(driven, body, start, until):
            asked["way"] = driven is profile or driven, body.name, start, until
            return {"of": "the way"}

        def traverse(**how):
            asked["traverse"] = how
            return SimpleNamespace(status=status)

        def tilted(*, tilt, **how):
            assert how == {k: v for k, v in asked["traverse"].items() if k != "with_energy"}
            asked["tilts"].append(tilt)
            return arrives[len(asked["tilts"]) - 1]

        def samples_of(path, phase, along):
            asked["along"] = along
            return SimpleNamespace(
                friction=np.array(frictions), lasts=np.array([True, True, False]),
                traction=np.array([1.0, math.nan, 2.0]),
            )  # fmt: skip

        def drive_margin(question, over_weight):
            asked["traction"] = over_weight
            return spare

        for name, one in (("way", way), ("samples_of", samples_of), ("drive_margin", drive_margin),
                          ("phases_of", lambda *given: given[1:])):  # fmt: skip
            monkeypatch.setattr(module, name, one)
        monkeypatch.setattr(contact, "traverse", traverse)
        monkeypatch.setattr(contact, "arrives", tilted)
        found = module._passed(
            profile, question, reserve=0.14, needed=asked["needed"], start="there", until=0.7
        )
        return found, asked

    return of


def test_a_part_arrives_with_friction_traction_and_a_tilt_to_spare(passed):
    found, asked = passed()
    assert isinstance(found, Passed)
    assert found.arrived
    assert asked["way"] == (True, "as it is", "there", 0.7)
    assert asked["traverse"] == {
        "of": "the way", "acceleration": 0.3, "step": module.FINE, "with_energy": False
    }  # fmt: skip
    assert asked["tilts"] == [0.14, -0.14]
    assert asked["needed"] == [0.3]  # of the poses in which it lasts
    assert asked["along"] == 0.3
    assert asked["traction"] == pytest.approx(2.0 / STANDARD_GRAVITY)
    found, asked = passed(direction="down", facing="tail-first")
    assert found.arrived
    assert asked["way"][:2] == ("reflected", "turned")
    assert asked["along"] == asked["traverse"]["acceleration"] == -0.3


def test_a_part_that_fails_in_any_way_has_to_be_judged(passed):
    for fails in (
        {"status": contact.Status.STUCK}, {"frictions": (0.3, 0.8, 0.1)},
        {"frictions": (0.3, 0.9, 0.1)}, {"spare": 0.0}, {"spare": -0.1},
    ):  # fmt: skip
        found, asked = passed(**fails)
        assert not found.arrived
        assert (asked["needed"], asked["tilts"]) == ([], [])
    assert passed(frictions=(0.3, 0.79, 0.1))[0].arrived  # in the best case
    for arrives in ((False, True), (True, False)):
        assert not passed(arrives=arrives)[0].arrived


# of what was driven already


def test_the_friction_of_a_plan_is_found_once(monkeypatch):
    found = []

    def once(self, question):
        found.append(question)
        return Findings(model="", required_friction=0.1 * len(found))

    monkeypatch.setattr(Drives, "_found", once)
    drives, unknown, known = Drives(), plan(), plan(friction=0.5)
    for question, required in ((unknown, 0.1), (unknown, 0.1), (known, 0.2), (unknown, 0.1)):
        assert drives.required_friction(question) == pytest.approx(required)
    assert len(found) == 2


def test_a_change_of_posture_is_made_once():
    """Whatever the belts; not from another place, and not of another robot."""
    drives, floor = Drives(), np.array([[-5.0, 0.0], [5.0, 0.0]])
    two = Posture(front=0.2, rear=0.2), Posture(front=0.4, rear=0.2)
    where = {"before": Phase.LAND, "ground": floor, "payload": (), "facing": "nose-first"}
    robot, start = ABSOLEM, contact.Placement(0.0, 0.0, 0.0)
    known = drives.moved(robot, *two, start=start, **where)
    belts = robot.model_copy(update={"track": robot.track.model_copy(update={"belt": "grousers"})})
    assert drives.moved(belts, *two, start=start, **where) is known
    assert drives.moved(robot, *two, start=start._replace(x=0.1), **where) is not known
    assert drives.moved(robot, *two[::-1], start=start, **where) is not known
    heavier = robot.with_centroid(robot.com_from_front + 0.01, robot.com_height)
    assert drives.moved(heavier, *two, start=start, **where) is not known


def test_only_the_contact_model_knows_without_judging(monkeypatch):
    monkeypatch.setattr(module, "friction_without_failure", lambda question, moved: 0.3)
    assert Drives().is_no_failure(plan())
    assert not Drives().is_no_failure(plan().changed(model="physics"))
    monkeypatch.setattr(module, "friction_without_failure", lambda question, moved: math.nan)
    assert not Drives().is_no_failure(plan())


def test_falls_are_sought_at_the_reserve_and_at_both_ends_of_the_allowances(monkeypatch):
    monkeypatch.setattr(Drives, "_judge", lambda self, question, **how: how)
    d, M = ({"low": low, "high": high} for low, high in ((0.01, 0.02), (0.03, 0.05)))
    question = plan(fall_reserve=0.14).changed(theta_d=d, theta_M=M)
    assert Drives()._found(question) == {"sought": pytest.approx((0.14, 0.07, 0.04))}
    doubtful = ABSOLEM.model_copy(
        update={"uncertainty": ABSOLEM.uncertainty.model_copy(update={"com_height": 0.01})}
    )
    assert Drives()._found(question.changed(robot=doubtful)) == {}
