"""Where a trial begins: on the landing as the robot leans there, on the flight on its nosings."""

import math

import numpy as np
import pytest

from kaidan import Question, Stairs
from kaidan.physics import SmoothBelt, TrialSpec, YieldingBelt, model_of
from kaidan.physics.initial_pose import course_of
from kaidan.physics.planar import RubberBody
from kaidan.physics.simulation import Simulation
from physics_cases import spec

DOWN = "-75deg,60deg"
"""Front flippers that reach below the flat and lift the nose, rear ones out of the way."""
SOFT = YieldingBelt(stiffness=2e5, shear_ratio=1.0)


def leaning(*, track=None, friction=1.0, **manner):
    question = Question.in_one_posture(
        "absolem", Stairs.named("ibc"), flippers=DOWN, friction=friction, **manner
    )
    return TrialSpec(question=question, begin="landing", track=track or SmoothBelt())


def on_two_discs(one, other):
    """Inclination and height of the origin of what rests on two discs on a level floor at 0.

    Both lowest points are on the floor: x sin(phi) + z cos(phi) of their centres, in the frame of
    the robot, differ by as much as their radii do.
    """
    one, other = sorted((one, other), key=lambda disc: disc[0])
    d_x, d_z = other[:2] - one[:2]
    phi = math.asin((other[2] - one[2]) / math.hypot(d_x, d_z)) - math.atan2(d_z, d_x)
    return phi, one[2] - one[0] * math.sin(phi) - one[1] * math.cos(phi)


@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
def test_on_the_landing_it_leans_on_its_flippers(direction, facing):
    trial = leaning(direction=direction, facing=facing)
    course = course_of(trial)
    discs = course.outline.parts.reshape(-1, 3)
    # by hand: it rests on the end of the track opposite to the flippers and on their tips
    track, flipper = discs[:2], discs[2:][discs[2:, 1].argmin()]
    tail = track[0] if facing == "nose-first" else track[1]
    phi, height = on_two_discs(tail, flipper)
    assert abs(phi) > math.radians(20.0)
    assert (phi > 0) == (facing == "nose-first")
    floor = course.profile.points[0, 1]
    assert course.phi == pytest.approx(phi, abs=1e-9)
    assert course.z == pytest.approx(floor + height, abs=1e-9)
    # its foremost point, in that pose, is 50 mm before the first nosing
    foremost = (discs[:, 0] * math.cos(phi) - discs[:, 1] * math.sin(phi) + discs[:, 2]).max()
    assert course.profile.nosings[0, 0] - course.x - foremost == pytest.approx(0.05, abs=1e-9)


def test_on_the_landing_a_share_of_a_spacing_is_added():
    near = course_of(leaning())
    far = course_of(leaning().model_copy(update={"start_offset": 0.25}))
    assert near.x - far.x == pytest.approx(0.25 * Stairs.named("ibc").nosing_spacing)
    assert (near.z, near.phi) == pytest.approx((far.z, far.phi), abs=1e-12)


def test_a_flat_that_does_not_stand_on_the_flight_begins_on_its_nosings():
    # by hand: at 80 deg the centroid, C_N from the line of the nosings, is C_N / cos(80 deg) above
    course = course_of(spec(80.0))
    nosing = course.profile.nosings[0]
    line = nosing[1] + (course.x - nosing[0]) * math.tan(math.radians(80.0))
    assert course.phi == pytest.approx(math.radians(80.0))
    assert course.z - line == pytest.approx(0.071 / math.cos(math.radians(80.0)), abs=1e-9)


def body_of(trial):
    return RubberBody(trial) if trial.track is SOFT else Simulation(model_of(trial))


@pytest.mark.parametrize("track", [SmoothBelt(), SOFT], ids=lambda track: track.kind)
@pytest.mark.parametrize("direction", ["up", "down"])
def test_on_a_landing_nothing_pulls_at_it(track, direction):
    # a tether for the slope of the stairs would draw it over the floor at a friction of 0.4
    pytest.importorskip("mujoco")
    pytest.importorskip("numba")
    body = body_of(leaning(track=track, friction=0.4, direction=direction))
    before = np.array(body.pose())
    assert body.settle() is None
    moved = np.array(body.pose()) - before
    # 2 mm and 1 deg: rubber yields by 17 kg g / 200 kN/m = 0.8 mm at a contact
    assert np.abs(moved[:2]).max() < 2e-3
    assert abs(moved[2]) < math.radians(1.0)


@pytest.mark.parametrize("track", [SmoothBelt(), SOFT], ids=lambda track: track.kind)
def test_it_sets_out_along_the_floor_and_not_along_its_track(track):
    pytest.importorskip("mujoco")
    pytest.importorskip("numba")
    body = body_of(leaning(track=track, speed=0.3))
    before = np.array(body.rates())
    body.set_going()
    assert np.array(body.rates()) - before == pytest.approx([0.3, 0.0], abs=1e-12)
