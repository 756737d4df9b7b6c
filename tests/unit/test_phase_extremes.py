"""Extremes of each phase, by hand: Kenaf of the paper (L 470, C_L 196, C_N 71, R 65 mm)."""

import math

import pytest

from kaidan.outline import Outline
from kaidan.robot import Robot, Track
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import Phase, extremes, traverse
from kaidan.traversal.criterion import Criterion, Loss
from kaidan.traversal.extremes import Rise, rises_about_stays
from kaidan.traversal.samples import samples_of

G = 9.80665
KENAF = Outline.of(Robot.named("kenaf"))
L, C_L, C_N, R = 0.470, 0.196, 0.071, 0.065
SOLVED = 1e-8  # m: poses are settled to 1e-9 m
FLOOR = Profile.of_points([(0, 0), (2, 0)])


def driven(profile, outline=KENAF, **how):
    if isinstance(profile, Stairs):
        profile = Profile.of_stairs(profile)
    return traverse(profile, outline, step=0.02, **how)


def of_phases(*args, **how):
    return {each.phase: each for each in driven(*args, **how).phases}


def flight(angle, spacing=0.150, steps=8):
    return Stairs.inclined(angle=math.radians(angle), nosing_spacing=spacing, steps=steps)


def kerb(height):
    return Profile.of_points([(-3, 0), (0, 0), (0, height), (3, height)])


def rise(lever, theta):
    """Rise of the centroid over a contact so far behind it along the flat on a slope [m]."""
    return math.hypot(lever, C_N) - lever * math.sin(theta) - C_N * math.cos(theta)


@pytest.mark.parametrize("descending", [False, True])
@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
def test_on_the_flight(descending, facing):
    """The contacts that stay lie a spacing within the tips of the flat: docs/theory/margin.md."""
    theta, p = math.radians(20), 0.150
    nose_up = (facing == "nose-first") != descending
    downhill, uphill = (L - p - C_L, C_L - p) if nose_up else (C_L - p, L - p - C_L)
    found = of_phases(flight(20), descending=descending, facing=facing)[Phase.TRAVERSE]
    assert found.energy_margin == pytest.approx(rise(downhill, theta), abs=SOLVED)
    assert found.energy_margin_step == 1  # all steps are alike
    assert found.uphill_steadiness[0] == pytest.approx(rise(uphill, -theta), abs=SOLVED)
    static = downhill * math.cos(theta) - C_N * math.sin(theta)
    assert found.static_margin == pytest.approx(static, abs=SOLVED)
    assert found.required_friction == pytest.approx(math.tan(theta), abs=1e-6)
    assert found.traction_over_weight == pytest.approx(math.sin(theta), abs=1e-6)
    assert found.largest_rotation == 0.0


@pytest.mark.parametrize("a", [0.0, 1.0, -2.0])
@pytest.mark.parametrize("descending", [False, True])
def test_on_a_floor(a, descending):
    """Effective gravity leans by a/g: its foot lies C_N a/g behind the centroid's."""
    found = of_phases(FLOOR, descending=descending, acceleration=a)
    assert list(found) == [Phase.ENTER, Phase.LAND]  # the leading end first, then all of it
    for each in found.values():
        assert each.required_friction == pytest.approx(abs(a) / G, abs=1e-9)
        assert each.traction_over_weight == pytest.approx(abs(a) / G, abs=1e-9)
        # downhill is behind, going down ahead: a speeds it up the stairs either way
        lever = C_L if descending else L - C_L
        static = (lever - a / G * C_N) / math.hypot(1, a / G)
        assert each.static_margin == pytest.approx(static, abs=SOLVED)
        assert each.required_friction_step == each.energy_margin_step == 0
        assert each.largest_rotation == 0.0


def test_on_a_floor_the_rise_over_the_nose_is_that_over_its_axle():
    """The nose rolls: R more than to stand C_L behind the axle, C_N - R above it."""
    down = of_phases(FLOOR, descending=True)[Phase.ENTER]
    over = R + math.hypot(C_L, C_N - R) - C_N
    assert down.energy_margin == pytest.approx(over, abs=SOLVED)


def test_of_a_kerb_there_is_no_flight():
    found = of_phases(kerb(0.1))
    assert list(found) == [Phase.ENTER, Phase.LAND]
    assert found[Phase.ENTER].largest_rotation == 0.0
    # the edge under the centroid, the nose R above the kerb: by hand as in test_rotations
    assert found[Phase.LAND].largest_rotation > 0.3
    down = of_phases(kerb(0.1), descending=True)
    assert list(down) == [Phase.ENTER, Phase.LAND]
    assert down[Phase.ENTER].largest_rotation > 0.3
    assert down[Phase.LAND].largest_rotation == 0.0
    assert down[Phase.ENTER].energy_margin == math.inf  # over the edge it has to rotate


@pytest.mark.parametrize("descending", [False, True])
def test_on_a_ramp_it_tilts_uphill_about_the_tip_of_the_flat(descending):
    """Gravity has to lean as far uphill as the tip lies from under the centroid."""
    slope, way = 0.3, 2.0
    top = (way * math.cos(slope), way * math.sin(slope))
    ramp = Profile.of_points([(-3, 0), (0, 0), top, (top[0] + 3, top[1])])
    found = of_phases(ramp, descending=descending)[Phase.TRAVERSE]
    uphill, downhill = (L - C_L, C_L) if descending else (C_L, L - C_L)
    by_hand = math.atan2(uphill, C_N) + slope
    assert found.tilt_uphill == (pytest.approx(by_hand, abs=math.radians(0.01)), 0)
    by_hand = math.atan2(downhill, C_N) - slope
    assert found.tilt_downhill == (pytest.approx(by_hand, abs=math.radians(0.01)), 0)


def test_where_nothing_holds_the_friction_is_infinite_there(monkeypatch):
    def nothing_holds(*args):
        samples = samples_of(*args)
        friction = samples.friction.copy()
        friction[samples.row == len(args[0].poses) - 1] = math.inf
        return samples._replace(friction=friction)

    monkeypatch.setattr(extremes, "samples_of", nothing_holds)
    land = of_phases(kerb(0.1))[Phase.LAND]
    assert (land.required_friction, land.required_friction_step) == (math.inf, 1)


def test_of_two_rotations_of_a_phase_the_larger_counts():
    line = [(-3, 0), (0, 0), (0, 0.05), (0.8, 0.05), (0.8, 0.15), (3.5, 0.15)]
    run = driven(Profile.of_points(line))
    low, high = (float(each.angle) for each in run.path.rotations)  # onto either kerb, landing
    assert 0.1 < low < high - 0.1
    assert run.phases[-1].phase is Phase.LAND
    assert run.phases[-1].largest_rotation == high


def test_a_nose_pulled_up_a_riser_takes_the_whole_weight():
    """The sole on the ground, the nose at the face: see test_a_riser_higher_than_the_nose."""
    enter = of_phases(kerb(0.1))[Phase.ENTER]
    x, b = L - C_L, C_L + R
    by_hand = (-R + math.sqrt(R * R + 4 * b * x)) / (2 * b)
    assert enter.required_friction == pytest.approx(by_hand, abs=1e-9)
    assert enter.required_friction_step == 1
    assert enter.traction_over_weight == pytest.approx(1.0, abs=1e-9)


def test_where_the_belly_touches():
    """It hangs 20 mm over the flat between a front and a rear track: only the edge reaches it."""
    sheet = Robot(
        name="r",
        com_from_front=0.25,
        com_height=0.1,
        track=Track(
            flat_length=0.5, front_radius=0.06, rear_radius=0.06, gap=0.2, belly_clearance=0.02
        ),
    )
    found = of_phases(kerb(0.1), Outline.of(sheet))
    assert [each.belly_touches for each in found.values()] == [False, True]


COARSE = {
    # L, C_L/L, C_N/L, front and rear radius; rise, going, steps; descending, facing, acceleration
    "peak of friction, up": (0.61, 0.38, 0.18, 0.08, 0.094, 0.12, 0.32, 3, False, "nose", 0.0),
    "peak of friction, down": (0.37, 0.33, 0.33, 0.104, 0.043, 0.13, 0.21, 4, True, "tail", 0.0),
    "peak as it lands": (0.77, 0.68, 0.12, 0.119, 0.074, 0.13, 0.37, 4, True, "nose", 0.0),
    "low steps": (0.36, 0.67, 0.14, 0.043, 0.09, 0.08, 0.39, 4, False, "nose", 0.0),
    "upright, down": (0.62, 0.62, 0.22, 0.078, 0.039, 0.05, 0.38, 2, True, "nose", 0.0),
    "upright, tail first": (1.11, 0.35, 0.28, 0.012, 0.049, 0.07, 0.31, 4, False, "tail", 0.0),
    "upright, steep": (1.11, 0.36, 0.31, 0.037, 0.083, 0.18, 0.18, 2, False, "nose", 0.0),
    "upright, speeding up": (0.46, 0.67, 0.3, 0.042, 0.054, 0.06, 0.18, 4, False, "tail", 0.8),
    "upright, slowing down": (0.62, 0.62, 0.22, 0.078, 0.039, 0.05, 0.38, 2, True, "nose", -0.8),
}


@pytest.mark.parametrize("name", COARSE)
def test_extremes_between_poses(name):
    """Poses 20 mm apart against poses 1 mm apart: without a search they differ by up to 14 %."""
    length, com, height, front, rear, up, going, steps, descending, end, a = COARSE[name]
    sheet = Robot(
        name="r",
        com_from_front=com * length,
        com_height=height * length,
        track=Track(flat_length=length, front_radius=front, rear_radius=rear),
    )
    profile = Profile.of_stairs(Stairs(rise=up, going=going, steps=steps))
    coarse, fine = (
        traverse(
            profile, Outline.of(sheet), step=step,
            descending=descending, facing=f"{end}-first", acceleration=a,
        ).phases
        for step in (0.02, 1e-3)
    )  # fmt: skip
    for one, other in zip(coarse, fine, strict=True):
        # 0.1 %: ten times what a peak promises where the search ends
        assert one.required_friction == pytest.approx(other.required_friction, rel=1e-3)
        below = [each.slides_below or 0.0 for each in (one, other)]
        assert below[0] == pytest.approx(below[1], rel=1e-3)
        assert one.traction_over_weight == pytest.approx(other.traction_over_weight, rel=1e-3)


def loss(**given):
    figures = {
        "downhill": True, "nosing": 3, "slope": 0.5, "lever": 0.1, "margin": 0.2, "centroid": 0.05,
        "rocking": 0.01, "rise": 0.004, "freed": 0.001, "contacts": 2, "landing": False,
    }  # fmt: skip
    return Loss(*[0.0] * len(Loss._fields))._replace(**(figures | given))


def test_rises_about_the_contact_that_stays_by_hand():
    """Less what rocking frees, never below zero; steps are counted from 1."""
    each = (loss(), loss(downhill=False, nosing=0, landing=True), loss(freed=0.005))
    assert rises_about_stays(Criterion(each), False) == (
        Rise(True, pytest.approx(0.003), 4, Phase.TRAVERSE),
        Rise(False, pytest.approx(0.003), 1, Phase.LAND),
        Rise(True, 0.0, 4, Phase.TRAVERSE),
    )
    down = rises_about_stays(Criterion(each), True)  # the upper landing is where it enters
    assert [one.phase for one in down] == [Phase.TRAVERSE, Phase.ENTER, Phase.TRAVERSE]
