"""What stands in the model, before anything moves."""

import math

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

import mujoco

from kaidan.errors import InputError
from kaidan.outline import Outline
from kaidan.physics import (
    DrivenGrousers,
    ShoeChain,
    SmoothBelt,
    SprungNoses,
    TrialSpec,
    mjcf,
    model_of,
)
from kaidan.physics.belts import rounded, tangent
from kaidan.physics.grousers import Motion
from kaidan.physics.initial_pose import course_of
from kaidan.physics.simulation import Simulation
from kaidan.physics.terrain import blocks_of, with_round_nosings
from kaidan.question import Question
from kaidan.robot import Posture, Robot
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from physics_cases import robot, spec

STAIRS = Stairs(rise=0.18, going=0.28, steps=4)
TRACKS = [SmoothBelt(), SprungNoses(stiffness=3e4), DrivenGrousers(), ShoeChain()]


def inside(block, point):
    away = np.array(point) - (block.x, block.z)
    c, s = math.cos(block.angle), math.sin(block.angle)
    along, up = c * away[0] + s * away[1], -s * away[0] + c * away[1]
    return abs(along) <= block.half_length and abs(up) <= block.half_height


def height(profile, x):
    return float(np.interp(x, profile.points[:, 0], profile.points[:, 1]))


@pytest.mark.parametrize("down", [False, True])
@pytest.mark.parametrize(
    "profile",
    [
        Profile.of_stairs(STAIRS),
        Profile.of_points(
            [(-1, 0), (0, 0), (0.01, 0.17), (0.3, 0.18), (0.3, 0.36), (0.6, 0.35), (2, 0.4)]
        ),
    ],
    ids=["stairs", "points"],
)
def test_the_blocks_faces_are_the_profile(profile, down):
    profile = profile.reflected() if down else profile
    blocks = blocks_of(profile, down=down, noses_only=False)
    left, right = profile.points[[0, -1], 0]
    for x in np.linspace(left + 1e-3, right - 1e-3, 997):
        z = height(profile, x)
        near = np.abs(profile.points[:, 0] - x).min() < 2e-3
        if near:
            continue  # at a riser the height jumps
        assert any(inside(block, (x, z - 1e-4)) for block in blocks), "no hole under the surface"
        # the square ends of sloping plates stick out by 0.4 mm
        assert not any(inside(block, (x, z + 5e-4)) for block in blocks), "nothing above it"
    upright = profile.points[1:-1][np.diff(profile.points[:-1, 0]) == 0]
    for x, z in profile.nosings if len(upright) else ():
        ahead = -1e-3 if not down else 1e-3  # a sloping plate's end sticks out by 0.3 mm
        if abs(height(profile, x + ahead) - z) < 0.1:
            continue  # a riser that leans
        assert not any(inside(block, (x + ahead, z - 0.05)) for block in blocks), "riser's face"
        assert any(inside(block, (x - ahead, z - 0.05)) for block in blocks)
    assert {block.nosing for block in blocks} >= set(range(len(profile.nosings)))


def test_a_rig_has_nothing_but_its_nosings():
    profile = Profile.of_stairs(STAIRS)
    blocks = blocks_of(profile, down=False, noses_only=True)
    assert len(blocks) == 4
    for block, nosing in zip(blocks, profile.nosings, strict=True):
        corner = (block.x - block.half_length, block.z + block.half_height)
        assert corner == pytest.approx(tuple(nosing), abs=1e-12)


@pytest.mark.parametrize("down", [False, True])
def test_round_nosings_are_discs_within_the_sharp_ones(down):
    r, profile = 0.02, Profile.of_stairs(STAIRS)
    profile = profile.reflected() if down else profile
    sharp = blocks_of(profile, down=down, noses_only=False)
    blocks = with_round_nosings(sharp, r, down=down)
    side = -1.0 if down else 1.0
    for number, (x, z) in enumerate(profile.nosings):
        own = [block for block in blocks if block.nosing == number]
        (disc,) = [block for block in own if block.round]
        assert (disc.x, disc.z) == pytest.approx((x + side * r, z - r))
        assert disc.half_height == r
        boxes = [block for block in own if not block.round]
        assert not any(inside(block, (x + side * 0.5 * r, z - 0.5 * r)) for block in boxes)
        # tread and face begin where the round ends
        for at in ((x + side * 1.01 * r, z - 1e-4), (x + side * 1e-4, z - 1.01 * r)):
            assert any(inside(block, at) for block in boxes)
    assert [b for b in blocks if b.nosing < 0] == [b for b in sharp if b.nosing < 0]


def test_a_smooth_belt_rests_on_the_round_of_the_nosings():
    trial = spec(40.0, nosing_radius=0.01, radius=0.06)
    model = model_of(trial)
    discs = [k for k in range(model.compiled.ngeom) if model.number_of[k] >= 0]
    capsules = [k for k in discs if model.compiled.geom_type[k] == mujoco.mjtGeom.mjGEOM_CAPSULE]
    assert {model.number_of[k] for k in capsules} == {model.number_of[k] for k in discs}
    simulation = Simulation(model)
    assert simulation.settle() is None
    touched = {int(g) for pair in simulation.data.contact.geom for g in pair} & set(discs)
    assert touched
    assert touched <= set(capsules)


@pytest.mark.parametrize("fields", [{"track": SprungNoses(stiffness=3e4)}, {"ground": "noses"}])
def test_round_nosings_are_those_of_rigid_steps(fields):
    with pytest.raises(InputError, match="nosing_radius is for steps, with smooth-belt"):
        spec(40.0, nosing_radius=0.01, **fields)


def test_tangents_of_a_tapered_flipper_touch_both_discs():
    part = np.array([0.0, 0.0, 0.089, 0.30, -0.05, 0.029])
    for side in (-1.0, 1.0):
        start, end, normal = tangent(part, side)
        assert np.hypot(*(start - part[:2])) == pytest.approx(part[2])
        assert np.hypot(*(end - part[3:5])) == pytest.approx(part[5])
        assert abs((end - start) @ normal) < 1e-12
        assert normal[1] * side > 0


def test_a_sharp_end_is_rounded_with_its_underside_in_place():
    part = rounded(np.array([-0.2, -0.05, 0.0, 0.2, -0.05, 0.01]))
    assert part[2] == 1e-3
    assert part[1] - part[2] == pytest.approx(-0.05)
    assert part[4] == -0.05


@pytest.mark.parametrize("track", TRACKS, ids=lambda track: track.kind)
def test_mjcf_opens_in_mujoco_and_stands_where_the_trial_begins(track):
    trial = spec(40.0, track=track)
    model = model_of(trial)
    again = mujoco.MjModel.from_xml_string(mjcf(trial))
    assert again.ngeom == model.compiled.ngeom
    assert again.nv == model.compiled.nv
    # XML holds six digits
    assert np.allclose(again.qpos0, model.compiled.qpos0, atol=1e-5)
    data = mujoco.MjData(again)
    mujoco.mj_forward(again, data)
    deep = min((contact.dist for contact in data.contact), default=0.0)
    # the shoes are chords of the round hull, until the idler has given way
    assert deep > (-3e-3 if track.kind == "shoe-chain" else -2e-4), "nothing sunk into anything"


def test_the_exported_belt_runs():
    trial = spec(40.0)
    model = mujoco.MjModel.from_xml_string(mjcf(trial))
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 1000)
    way = math.hypot(*(data.qpos[:2] - model.qpos0[:2]))
    # from rest it loses a few milliseconds
    assert way == pytest.approx(0.1, rel=0.05)


def test_mass_and_inertia_are_the_sheets():
    model = model_of(spec(40.0)).compiled
    body = model.body("robot")
    assert body.mass[0] == 20.0
    assert body.inertia[1] == pytest.approx(0.45)
    estimated = model_of(spec(40.0, robot=Robot.named("kenaf")))
    gyration = Outline.of(Robot.named("kenaf")).gyration
    assert estimated.compiled.body("robot").inertia[1] == pytest.approx(20.0 * gyration**2)


@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
def test_flippers_are_hulls_of_two_discs_at_their_angle(facing):
    sheet = Robot.named("absolem")
    posture = Posture(front=0.5, rear="flat")
    model = model_of(spec(30.0, 0.3, robot=sheet, flippers=posture, facing=facing)).compiled
    outline = Outline.of(sheet, posture)
    outline = outline if facing == "nose-first" else outline.turned_round()
    discs = {(round(x, 9), round(z, 9), r) for x, z, r in outline.parts.reshape(-1, 3)}
    found = {
        (round(float(model.geom_pos[k][0]), 9), round(float(model.geom_pos[k][2]), 9),
         float(model.geom_size[k][0]))
        for k in range(model.ngeom)
        if model.geom_type[k] == mujoco.mjtGeom.mjGEOM_CAPSULE
    }  # fmt: skip
    assert found == discs


def test_grousers_go_round_at_the_belts_speed():
    motion = Motion(("a", "b"), np.array([0.0, 0.3]), -0.274, 0.196, 0.06)
    length = motion.length
    assert length == pytest.approx(2 * 0.47 + 2 * math.pi * 0.06)
    before = motion.targets(0.1)
    after = motion.targets(0.1 + length)
    assert after[0::2] == pytest.approx(before[0::2])
    assert after[1::2] == pytest.approx(before[1::2] + 2 * math.pi)

    def place(run):
        slide, angle = motion.targets(run)[:2]
        return np.array([slide - 0.06 * math.sin(angle), -0.06 * math.cos(angle)])

    for run in np.linspace(0.01, length, 23):
        step = place(run + 5e-7) - place(run - 5e-7)
        # where flat and arc meet, a step across the seam has the same length
        assert np.hypot(*step) == pytest.approx(1e-6, rel=1e-4)
    assert place(0.05)[0] < place(0.0)[0], "backward along the underside"


def test_two_tracks_in_space_stand_apart_by_the_gauge():
    sheet = robot(gauge=0.3, width=0.08)
    model = model_of(spec(40.0, robot=sheet, dimensions=3, lateral_offset=0.02)).compiled
    assert model.geom("left_track_under").pos[1] == pytest.approx(0.15 - 0.02)
    assert model.geom("right_track_under").pos[1] == pytest.approx(-0.15 - 0.02)
    assert model.nv == 6


@pytest.mark.parametrize("direction", ["up", "down"])
def test_the_line_of_the_nosings_is_that_of_the_steepest_flight(direction):
    gentle, steep = (
        Stairs(rise=rise, going=0.3, steps=4, upper_landing=1.5) for rise in (0.1, 0.2)
    )
    question = Question.in_one_posture(robot(), (gentle, steep), direction=direction)
    course = course_of(TrialSpec(question=question, begin="landing"))
    assert abs(course.slope) == pytest.approx(steep.angle)
    assert course.down == (direction == "down")
