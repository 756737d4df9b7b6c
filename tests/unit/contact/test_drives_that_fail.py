"""What a drive does where a step fails or ends at once: in steps that are written by hand.

Hardly any drive comes there, so steps are put in the place of those of the plain kernel.
"""

import numpy as np
import pytest

from contact_cases import stadium
from kaidan.contact import Event, Feature, FeatureKind, Status, body_table, ground_table
from kaidan.contact.codes import Advance, RotationOutcome
from kaidan.contact.kernel import driver
from kaidan.contact.kernel.contact_changes import effective_gravity
from kaidan.contact.kernel.continuation import tilt
from kaidan.contact.layout import EventRow, Fallen, Held, Journey, Log, Pose, Pull, RotationRow
from kernel_memory import nothing, scene, table, written

LEVEL = ground_table([(-4, 0), (4, 0)])
C_N, R = 0.1, 0.08
BODY = body_table(stadium(0.6, 0.28, C_N, R))
REAR, FRONT = (Feature(0, 0, kind).code for kind in (FeatureKind.DISC_1, FeatureKind.DISC_2))
NUDGE = 1e-5  # m: the first by which a robot is let down farther on
FLOOR = scene(LEVEL, BODY)
STRAIGHT = Pull(0.0, 9.8)
STARTS = Held(0.3, C_N, 0.0, 1.0, 0.0, 0.0, REAR, FRONT)


def driven(x_end=0.4, rows=300, a=0.0):
    """A drive over a floor from 0.3 m on."""
    tables = [nothing(kind, rows) for kind in (Pose, EventRow, RotationRow)]
    log = Log(*map(table, (Pose, EventRow, RotationRow), tables), True)
    found = driver.drive(FLOOR, Journey(0.3, x_end, 0.0, 0.01, 0.2), Pull(a, 9.8), log)
    for each in (log.poses, log.events):
        each.flush()
    status, poses, events, rotations = found
    return status, tables[0][:poses], tables[1][:events], rotations


def full_log():
    """Tables of four rows of which none has been written yet, and a drive that has written some."""
    tables = [nothing(kind, 4) for kind in (Pose, EventRow, RotationRow)]
    log = Log(*map(table, (Pose, EventRow, RotationRow), tables), True, n_pose=1, s=1.0, leg=1)
    return log, tables


def is_unwritten(log, tables):
    for each in (log.poses, log.events):
        each.flush()
    return not any(written(rows).any() for rows in tables)


def put(monkeypatch, outcomes):
    """Steps of the given outcomes by number, and otherwise as they are."""
    step_on, calls = driver.step_on, []

    def step(scene, here, x_end, step, *rest):
        calls.append(here)
        found = step_on(scene, here, x_end, step, *rest)
        change = outcomes(len(calls), here)
        return found if change is None else change

    monkeypatch.setattr(driver, "step_on", step)
    return calls


def failed(here):
    return Advance.NOT_CONVERGED, here, 0.0, False


def test_after_a_failure_it_is_let_down_a_little_farther_on(monkeypatch):
    put(monkeypatch, lambda call, here: failed(here) if call in (3, 4) else None)
    status, poses, events, rotations = driven()
    assert (status, rotations) == (Status.OK, 0)
    assert events["kind"].tolist() == [Event.RESETTLED, Event.RESETTLED, Event.ARRIVED]
    # two steps of 10 mm, then on by two nudges
    assert events["x"][:2] == pytest.approx([0.32 + NUDGE, 0.32 + 2 * NUDGE], abs=1e-12)
    assert events["s"][:2] == pytest.approx([0.02 + NUDGE, 0.02 + 2 * NUDGE], abs=1e-12)
    assert events["pose"].tolist() == [2, 2, len(poses) - 1]
    assert poses["x"][-1] == pytest.approx(0.4, abs=1e-9)
    assert poses["s"][-1] == pytest.approx(0.1, abs=1e-9)


def test_fifty_failures_are_too_many(monkeypatch):
    calls = put(monkeypatch, lambda call, here: failed(here))
    status, poses, events, _ = driven()
    assert status == Status.NOT_CONVERGED
    assert (len(poses), len(events), len(calls)) == (1, driver.FAILURES, driver.FAILURES + 1)


def test_a_failure_where_it_can_not_be_let_down_ends_the_drive(monkeypatch):
    put(monkeypatch, lambda call, here: failed(here) if call == 3 else None)
    monkeypatch.setattr(driver, "settled_again", lambda scene, here, kappa: (False, 0.0, here))
    status, poses, events, _ = driven()
    assert (status, len(poses), len(events)) == (Status.NOT_CONVERGED, 3, 0)


@pytest.mark.parametrize("before", [0, 2])
def test_twenty_steps_that_lead_nowhere_are_borne(monkeypatch, before):
    def outcome(call, here):
        return None if call <= before else (Advance.NOTHING, here, 0.0, False)

    calls = put(monkeypatch, outcome)
    status, poses, events, _ = driven()
    assert status == Status.STUCK
    assert len(calls) == before + 21
    assert events[["kind", "pose"]].tolist() == [(Event.STUCK, len(poses) - 1)]


def test_short_steps_are_joined(monkeypatch):
    """Steps of 4 mm: a pose is written once 7 mm lie behind it, so each 8 mm."""
    step_on = driver.step_on

    def step(scene, here, x_end, step, *rest):
        return step_on(scene, here, x_end, 0.004, *rest)

    monkeypatch.setattr(driver, "step_on", step)
    status, poses, _, _ = driven(x_end=0.4)
    assert status == Status.OK
    assert np.diff(poses["s"][:-1]) == pytest.approx([0.008] * 12, abs=1e-9)


def test_full_tables_and_steps_without_end_are_too_long(monkeypatch):
    calls = put(monkeypatch, lambda call, here: failed(here))
    status, poses, events, _ = driven(rows=10)
    assert (status, len(poses), len(events), len(calls)) == (Status.TOO_LONG, 1, 6, 6)
    monkeypatch.undo()
    # nothing is written of steps of a micrometre: thirty for each row
    calls = put(
        monkeypatch,
        lambda call, here: (Advance.NOTHING, here._replace(x=here.x + 1e-6), 1e-6, False),
    )
    status, poses, events, _ = driven(rows=10)
    assert (status, len(poses), len(events), len(calls)) == (Status.TOO_LONG, 1, 0, 300)


@pytest.mark.parametrize("up", [1.0, -1.0])
@pytest.mark.parametrize("t_x", [1.0, -1.0])
def test_driven_upright_it_falls_the_way_it_leans(monkeypatch, up, t_x):
    there = Held(0.31, C_N, up * (driver.UPRIGHT - 5e-5), t_x, 0.0, 0.0, REAR, FRONT)
    put(monkeypatch, lambda call, here: (Advance.NOTHING, there, 0.01, False))
    status, poses, events, _ = driven()
    fell = Event.FELL_BACKWARD if up > 0.0 else Event.FELL_FORWARD
    assert status == (Status.FELL_BACKWARD if up > 0.0 else Status.FELL_FORWARD)
    assert events[["kind", "pose"]].tolist() == [(fell, 1)]
    assert len(poses) == 2


def test_effective_gravity_follows_the_way_that_an_exchange_leads_to(monkeypatch):
    """Its tilt before the exchange by the way up to it, after it by the way on."""
    a, before, after = 2.0, (0.8, 0.6, 0.0), (0.6, 0.64, 0.48)
    there = Held(0.31, C_N, 0.0, *before, REAR, FRONT)
    put(monkeypatch, lambda call, here: (FRONT, there, 0.01, False))
    told = []

    def exchange(scene, made, here, kappa, log):
        told.append((made, kappa))
        return True, Held(*here[:3], *after, *here[6:])

    def onset(scene, here, kappa):
        told.append(kappa)
        return -1.0

    def rotate_on(scene, here, sense, kappa, gyration, gravity, log):
        told.append((sense, kappa, gyration, gravity, log.s, log.leg))
        log.n_rotation = 1
        return Status.STUCK, here

    for each in (exchange, onset, rotate_on):
        monkeypatch.setattr(driver, each.__name__, each)
    status, *_, rotations = driven(a=a)
    assert (status, rotations) == (Status.STUCK, 1)
    pull = Pull(a, 9.8)
    leans = tilt(pull, *after[:2])
    assert told[0] == (FRONT, tilt(pull, *before[:2]))
    assert told[1] == leans
    assert told[2][:2] == (-1.0, leans)
    assert told[2][3] == effective_gravity(pull, *after[:2])
    assert told[2][2::2] == (0.2, pytest.approx(0.01, abs=1e-6))
    assert told[2][5] == 1


def test_no_drive_goes_on_from_a_pair_without_a_line(monkeypatch):
    """What arrests it is one contact by two names."""
    arrested = Fallen(RotationOutcome.ARRESTED, REAR, REAR, 0.3, C_N, 0.0, 0.0, 0.0, 0.1)
    monkeypatch.setattr(driver, "rotate", lambda *given: arrested)
    log, tables = full_log()
    found = driver.rotate_on(FLOOR, STARTS, -1.0, 0.0, 0.2, 9.8, log)
    assert found == (Status.NOT_CONVERGED, STARTS._replace(front=REAR))
    assert (log.n_pose, log.n_event, log.n_rotation) == (1, 0, 0)
    assert is_unwritten(log, tables)


@pytest.mark.parametrize("short", [-1e-12, 5e-10, 3e-9])
def test_what_happens_where_it_arrives_counts_no_more(monkeypatch, short):
    """Within 1e-9 m of the end; farther before it the robot falls, as the step says."""

    def outcome(call, here):
        if call != 2:
            return None
        return Advance.OVER_FRONT, here._replace(x=0.35 - short), 0.04, True

    put(monkeypatch, outcome)
    status, poses, events, _ = driven(x_end=0.35)
    if short > 1e-9:
        assert status == Status.FELL_FORWARD
        return
    assert status == Status.OK
    assert events["kind"].tolist() == [Event.ARRIVED]
    assert poses["x"][-1] == 0.35 - short


@pytest.mark.parametrize(
    ("x_end", "cut", "ends"),
    [(0.9, 0.305, False), (0.305, 0.3, False), (0.304, 0.3045, True), (0.3, 0.305, False)],
)
@pytest.mark.parametrize("beyond", [Advance.NOTHING, Advance.OVER_REAR, FRONT])
def test_a_step_that_leads_beyond_upright_is_cut_there(monkeypatch, beyond, x_end, cut, ends):
    """It ends where the robot stands upright, whatever comes after that; whether it arrives is told
    of where it ends then.
    """
    calls = []

    def advance(scene, here, ds, *rest):
        calls.append(ds)
        phi = here[2] + 10.0 * ds
        x = here[0] + ds if phi > driver.UPRIGHT + 1e-9 else cut
        what = beyond if phi > driver.UPRIGHT + 1e-9 else Advance.NOTHING
        return what, Held(x, 5.0, phi, *here[3:]), ds

    monkeypatch.setattr(driver, "advance", advance)
    here = Held(0.3, -5.0, 1.55, *STARTS[3:])
    what, there, ds, over = driver.step_on(FLOOR, here, x_end, 0.01, R, STRAIGHT)
    assert what == Advance.NOTHING
    assert over == ends
    assert there[2] == pytest.approx(driver.UPRIGHT, abs=1e-9)
    assert there[0] == cut
    assert ds == calls[-1] == pytest.approx((driver.UPRIGHT - 1.55) / 10.0)


@pytest.mark.parametrize(("phi", "way", "looks"), [(1.58, 10.0, 1), (1.6, -1.0, 1),
                                                  (1.55, -10.0, 1), (1.55, 10.0, 2),
                                                  (-1.55, -10.0, 2)])  # fmt: skip
def test_a_step_from_beyond_upright_is_not_cut(monkeypatch, phi, way, looks):
    calls = []

    def advance(scene, here, ds, *rest):
        calls.append(ds)
        there = Held(here[0] + ds, here[1], here[2] + way * ds, 0.0, 0.0, 0.0, *here[6:])
        return Advance.OVER_REAR, there, ds

    monkeypatch.setattr(driver, "advance", advance)
    here = Held(0.3, -5.0, phi, *STARTS[3:])
    driver.step_on(FLOOR, here, 0.9, 0.01, R, STRAIGHT)
    assert len(calls) == looks
    assert all(ds > 0.0 for ds in calls)


def test_no_exchange_where_the_new_pair_has_no_line():
    """The rear foot for itself, where gravity leans so far that it is ahead."""
    log, tables = full_log()
    assert driver.exchange(FLOOR, REAR, STARTS, 5.0, log) == (False, STARTS)
    assert (log.n_pose, log.n_event) == (1, 0)
    assert is_unwritten(log, tables)
