"""Two margins in one unit against brute force: tilt to the first rock, and tilt to the fall.

The same small drives and small turns as in `test_contact_brute_force`, under tilted gravity. No
face is higher than an end's radius, so that letting the robot down from above jumps no wall.
"""

import math

import numba
import numpy as np
import pytest
from test_contact_brute_force import DRIVE, FINEST, NEAR, TURN, touch

from kaidan import Question, Robot, Stairs
from kaidan.models.quasi_static import traverse_of
from kaidan.modes import Phase
from kaidan.robot import FlipperPair, Posture, Track
from kaidan.traversal.tilting import LARGEST, largest_survived


@numba.njit(cache=True, error_model="numpy")
def leaning(t, u, length, parts, x, phi, x_end, kappa, finer):
    """Outcome (0 arrived, 1 back, -1 front, 9 stuck) and the largest turns in one place [rad].

    The first nose up, the second nose down; only those that no drive follows count as one.
    """
    up, down, factor = 0.0, 0.0, finer
    for _ in range(40_000_000):
        turn = TURN / factor
        x += DRIVE / factor * np.cos(phi)
        z, p_x, p_z = touch(t, u, length, parts, x, phi)
        lever = p_x - x + kappa * (z - p_z)
        sense = np.sign(lever)
        other = lever
        turned = 0.0
        for _ in range(40_000_000):
            new_phi = phi + sense * turn
            new_x = x - (z - p_z) * sense * turn
            new_z, q_x, q_z = touch(t, u, length, parts, new_x, new_phi)
            other = q_x - new_x + kappa * (new_z - q_z)
            if np.sign(other) != sense:
                break
            x, z, phi, p_x, p_z = new_x, new_z, new_phi, q_x, q_z
            lever = other
            turned += turn
            if abs(phi) > np.pi / 2:
                return sense, up, down
        if sense > 0:
            up = max(up, turned)
        else:
            down = max(down, turned)
        if abs(phi) > np.pi / 2 - 2 * turn:
            return np.sign(phi), up, down
        if x >= x_end:
            return 0.0, up, down
        near = min(abs(lever), abs(other))
        factor = finer * min(max(NEAR / max(near, 1e-9), 1.0), FINEST)
    return 9.0, up, down


def brute(found, tilt, finer=2.0):
    """A traverse again by brute force, gravity tilted back."""
    points = found.profile.points
    t = np.vstack([points[0] - [20.0, 0.0], points, points[-1] + [20.0, 0.0]])
    d = np.diff(t, axis=0)
    length = np.hypot(d[:, 0], d[:, 1])
    poses = found.path.poses
    x, x_end, phi = float(poses.x[0]), float(poses.x[-1]), float(poses.inclination[0])
    return leaning(
        t, d / length[:, None], length, found.outline.parts, x, phi, x_end, math.tan(tilt), finer
    )


def cases(seed, count, gap=False):
    rng = np.random.default_rng(seed)
    while count:
        L, R = rng.uniform(0.5, 0.9), rng.uniform(0.1, 0.14)
        rise = rng.uniform(0.06, 0.09)
        going = rise / math.tan(rng.uniform(0.45, 0.8))
        robot = Robot(
            name="any",
            com_from_front=L * rng.uniform(0.35, 0.6),
            com_height=rng.uniform(0.15, 0.35) * L,
            track=Track(
                flat_length=L,
                front_radius=R,
                rear_radius=R,
                gap=L * rng.uniform(0.2, 0.5) if gap else 0.0,
            ),
        )
        flight = Stairs(rise=rise, going=going, steps=8)
        found = traverse_of(Question.in_one_posture(robot, flight, friction=3.0))
        if found.arrived and found.downhill_margin > math.radians(1.0):
            count -= 1
            yield found


STEEPEST = math.radians(60.0)
"""Margin up to which gravity is tilted [rad]."""
BRACKET = math.radians(0.05)
"""To which the brute force finds the tilt to a fall [rad]."""


def check_falls(seed, count, gap=False):
    for found in cases(seed, count, gap):
        low, high = 0.0, LARGEST
        while high - low > BRACKET:
            middle = 0.5 * (low + high)
            low, high = (middle, high) if brute(found, middle)[0] == 0.0 else (low, middle)
        survived = found.falls_downhill.tilt
        # small turns' 0.1 deg
        assert min(survived, LARGEST) == pytest.approx(low, abs=BRACKET + math.radians(0.1))


def check_rocks(seed, count, gap=True):
    """Short of the margin nothing turns back by more than rocking, and beyond it most do."""
    gone = 0
    for found in cases(seed, count, gap):
        margin = found.downhill_margin
        outcome, back, _ = brute(found, margin - math.radians(0.1))
        assert outcome == 0.0
        assert back <= math.radians(2.6 + 0.15), math.degrees(back)
        gone += found.falls_downhill.tilt < margin + math.radians(15.0)
    assert gone > 0


def with_odd_last_steps(seed, count):
    """Flights whose last rises and goings are off by up to 15 mm."""
    rng = np.random.default_rng(seed)
    while count:
        L, R = rng.uniform(0.5, 0.9), rng.uniform(0.1, 0.14)
        rise = rng.uniform(0.06, 0.08)
        going = rise / math.tan(rng.uniform(0.45, 0.8))
        rises, goings = np.full(9, rise), np.full(8, going)
        rises[-3:] += rng.uniform(-0.015, 0.015, 3)
        goings[-3:] += rng.uniform(-0.015, 0.015, 3)
        robot = Robot(
            name="any",
            com_from_front=L * rng.uniform(0.35, 0.6),
            com_height=rng.uniform(0.15, 0.35) * L,
            track=Track(flat_length=L, front_radius=R, rear_radius=R),
        )
        flight = Stairs(rises=tuple(rises.tolist()), goings=tuple(goings.tolist()))
        found = traverse_of(Question.in_one_posture(robot, flight, friction=3.0))
        if found.arrived and math.radians(1.0) < found.downhill_margin < LARGEST:
            count -= 1
            yield found


def check_odd_last_steps(seed, count):
    """Short of the margin it rocks from chord to chord alone; with the flight's alone it falls."""
    gained = 0.0
    for found in with_odd_last_steps(seed, count):
        margin = found.downhill_margin
        outcome, back, _ = brute(found, margin - math.radians(0.1))
        assert outcome == 0.0
        assert back <= found.criterion.turn + math.radians(0.15), math.degrees(back)
        flight = found.criterion.smallest(downhill=True)
        if flight is not None and flight.margin > found.falls_downhill.tilt + math.radians(0.2):
            outcome, back, _ = brute(found, flight.margin - math.radians(0.1))
            gained += outcome != 0.0
    assert gained > 0


def test_nosings_lost_over_the_landing_count():
    check_odd_last_steps(seed=8, count=4)


@pytest.mark.slow
def test_nosings_lost_over_the_landing_of_many_count():
    check_odd_last_steps(seed=9, count=200)


def with_odd_first_riser(seed, count, higher):
    """Flights whose first riser is higher than the others, or lower, and no others differ."""
    rng = np.random.default_rng(seed)
    while count:
        L, R = rng.uniform(0.5, 0.9), rng.uniform(0.1, 0.14)
        rise = rng.uniform(0.06, 0.08)
        flight = Stairs(
            rise=rise,
            going=rise / math.tan(rng.uniform(0.45, 0.8)),
            first_rise=rise + (rng.uniform(0.008, 0.02) if higher else -rng.uniform(0.0, 0.03)),
            steps=8,
        )
        robot = Robot(
            name="any",
            com_from_front=L * rng.uniform(0.4, 0.6),
            com_height=rng.uniform(0.2, 0.35) * L,
            track=Track(flat_length=L, front_radius=R, rear_radius=R),
        )
        found = traverse_of(Question.in_one_posture(robot, flight, friction=3.0))
        if found.arrived and math.radians(1.0) < found.downhill_margin < LARGEST:
            count -= 1
            yield found


def check_odd_first_riser(seed, count, *, higher):
    """Short of the margin it does not fall; at a higher riser some do short of the flight's."""
    gained = 0
    for found in with_odd_first_riser(seed, count, higher):
        assert brute(found, found.downhill_margin - math.radians(0.1))[0] == 0.0
        flight = found.criterion.smallest(downhill=True)
        if flight is not None and flight.margin > found.falls_downhill.tilt + BRACKET:
            gained += brute(found, flight.margin - math.radians(0.02))[0] != 0.0
    return gained


def test_a_higher_first_riser_counts():
    assert check_odd_first_riser(seed=10, count=10, higher=True) > 0


@pytest.mark.slow
def test_odd_first_risers_of_many_count():
    assert check_odd_first_riser(seed=11, count=150, higher=True) > 0
    assert check_odd_first_riser(seed=12, count=100, higher=False) == 0


def kinked(seed, count):
    """Robots up flights, flippers so little above the flat that they rock onto them."""
    rng = np.random.default_rng(seed)
    while count:
        L, R = rng.uniform(0.35, 0.6), rng.uniform(0.1, 0.13)
        rise = rng.uniform(0.05, 0.085)
        flight = Stairs(rise=rise, going=rise / math.tan(rng.uniform(0.35, 0.7)), steps=7)
        pair = FlipperPair(
            length=rng.uniform(0.2, 0.35),
            root_radius=R,
            tip_radius=rng.uniform(0.06, 0.1),
            pivot_height=R,
        )
        robot = Robot(
            name="any",
            mass=30.0,
            com_from_front=L * rng.uniform(0.35, 0.75),
            com_height=rng.uniform(0.4, 0.9) * L,
            track=Track(flat_length=L, front_radius=R, rear_radius=R),
            front_flippers=pair,
            rear_flippers=pair,
        )
        off = math.radians(rng.choice([0.05, 0.3, 0.6, 1.2, 2.0]))
        posture = Posture(
            front=pair.flat_angle + rng.choice([0.0, off]), rear=pair.flat_angle + off
        )
        found = traverse_of(Question.in_one_posture(robot, flight, friction=3.0, flippers=posture))
        if found.arrived and math.radians(1.0) < found.downhill_margin < STEEPEST:
            count -= 1
            yield found


def check_kinked(seed, count):
    """Short of the margin nothing turns back by more than rocking; some do past the short flat."""
    gained = 0.0
    for found in kinked(seed, count):
        margin = found.downhill_margin
        outcome, back, _ = brute(found, margin - math.radians(0.1))
        assert (found.whole, outcome) == (False, 0.0)
        assert back <= math.radians(2.6 + 0.15), math.degrees(back)
        short = found.criterion.smallest(downhill=True)
        gained = max(gained, margin - short.margin if short else 0.0)
    assert gained > math.radians(10.0)


def test_short_of_the_margin_a_robot_does_not_rock_past_flippers_off_the_flat():
    check_kinked(seed=6, count=5)


@pytest.mark.slow
def test_short_of_the_margin_many_do_not_rock_past_flippers_off_the_flat():
    check_kinked(seed=7, count=200)


ABSOLEM, ADA = Robot.named("absolem"), Stairs.named("ada")


@pytest.mark.parametrize("off", [0.01, 0.1, 0.5, 1.0, 2.0, 2.5])
def test_flippers_a_little_off_the_flat_by_hand(off):
    """As the tip leaves a nosing, less what the robot has rocked onto it (docs/theory/rocking.md).

    A pivot e ahead of the kink and the tip's nosing, behind it, lie a spacing apart.
    """
    delta, rear, front = math.radians(off), ABSOLEM.rear_flippers, ABSOLEM.front_flippers
    posture = Posture(front=front.flat_angle, rear=rear.flat_angle + delta)
    found = traverse_of(Question.in_one_posture(ABSOLEM, ADA, friction=2.0, flippers=posture))
    stance = found.outline.stance
    d = math.sqrt(rear.length**2 - (rear.root_radius - rear.tip_radius) ** 2)
    arc = rear.root_radius * math.tan(delta / 2)
    x, z = (d + arc) * math.cos(delta), (d + arc) * math.sin(delta)
    e = math.sqrt(ADA.nosing_spacing**2 - z**2) - x
    lever = stance.flat_length + arc - e - stance.com_from_front
    by_hand = math.atan(lever / stance.com_height) - ADA.angle - math.atan2(z, x + e)
    assert found.downhill_margin == pytest.approx(by_hand, abs=math.radians(1e-3))


def test_flippers_at_the_flat_and_a_hair_off_it():
    """Above it as at it; below it the arc of the tip carries sqrt(2 R d delta) beyond the flat."""
    rear, front = ABSOLEM.rear_flippers, ABSOLEM.front_flippers
    margins = [
        traverse_of(
            Question.in_one_posture(
                ABSOLEM, ADA, friction=2.0,
                flippers=Posture(
                    front=front.flat_angle, rear=rear.flat_angle + math.radians(off)
                ),
            )
        ).downhill_margin
        for off in (-1e-4, 0.0, 1e-4)
    ]  # fmt: skip
    assert margins == pytest.approx([margins[1]] * 3, abs=math.radians(0.03))


@pytest.mark.parametrize("off", [0.0, 1e-4, 0.1, 2.0])
def test_flippers_tail_first_as_those_of_the_robot_turned_round(off):
    """Absolem tail first, and its other half nose first with the flippers exchanged."""
    rear, front = ABSOLEM.rear_flippers, ABSOLEM.front_flippers
    L = ABSOLEM.track.flat_length
    turned = ABSOLEM.model_copy(
        update={"com_from_front": L - ABSOLEM.com_from_front,
                "front_flippers": rear, "rear_flippers": front}
    )  # fmt: skip
    flat, raised = rear.flat_angle, rear.flat_angle + math.radians(off)
    one, other = (
        traverse_of(
            Question.in_one_posture(robot, ADA, friction=2.0, facing=facing, flippers=posture)
        )
        for robot, facing, posture in (
            (ABSOLEM, "tail-first", Posture(front=raised, rear=flat)),
            (turned, "nose-first", Posture(front=flat, rear=raised)),
        )
    )
    assert one.whole is other.whole is (off == 0.0)
    assert one.downhill_margin == pytest.approx(other.downhill_margin, abs=1e-6)
    assert one.downhill_margin > math.radians(5.0)


def test_the_tilt_to_the_fall():
    check_falls(seed=1, count=1)


def test_the_tilt_to_the_fall_with_a_gap():
    check_falls(seed=2, count=1, gap=True)


def test_short_of_the_margin_a_robot_with_a_gap_does_not_rock():
    check_rocks(seed=3, count=2)


@pytest.mark.slow
@pytest.mark.parametrize("gap", [False, True])
def test_the_tilt_to_the_fall_of_many(gap):
    check_falls(seed=4, count=60, gap=gap)


@pytest.mark.slow
def test_short_of_the_margin_many_do_not_rock():
    check_rocks(seed=5, count=150)


KENAF = Robot.named("kenaf")


@pytest.mark.parametrize(
    ("p", "angle", "to_rock", "to_fall"),
    [
        # closed form: 60.205 deg at 150 mm, 46.185 at 200 mm, less the slope
        (0.150, 54.0, 6.205, 8.6),
        (0.150, 57.0, 3.205, 5.6),
        (0.200, 44.0, 2.185, 10.2),
        (0.200, 38.0, 8.185, 16.2),
    ],
)
def test_the_papers_rig(p, angle, to_rock, to_fall):
    """It climbed at 54 deg and fell at 55-57; at (200 mm, 44 deg) it swung and climbed."""
    flight = Stairs.inclined(angle=math.radians(angle), nosing_spacing=p)
    found = traverse_of(Question.in_one_posture(KENAF, flight, friction=2.0))
    assert math.degrees(found.downhill_margin) == pytest.approx(to_rock, abs=1e-3)
    # an independent bisection of the whole traverse, another end radius: 0.1 deg, found within 0.1
    assert math.degrees(found.falls_downhill.tilt) == pytest.approx(to_fall, abs=0.2)


@pytest.mark.parametrize("falls_at", [-40.0, -7.3, -0.5, 0.01, 2.0, 4.0, 6.5, 29.0, 31.0])
@pytest.mark.parametrize("sought", [(0.0,), (3.0, 8.0), (6.499, 6.5), (-7.3,), (15.0,)])
def test_of_the_tilt_to_the_fall_only_on_which_side_it_is(falls_at, sought):
    """What is sought lies on the same side of it, with fewer drives."""
    tried = []

    def survives(tilt):
        tried.append(tilt)
        return math.degrees(tilt) < falls_at

    whole, count = largest_survived(survives), len(tried)
    tried.clear()
    found = largest_survived(survives, sought=[math.radians(each) for each in sought])
    assert len(tried) <= count
    for each in map(math.radians, sought):
        assert (found > each) == (whole > each)


def test_after_a_drop_that_the_terrain_obliges_to_it_only_comes_back():
    """On the landing the edge of the last nosing lies behind the centroid: tilted, it returns."""
    flight = Stairs.inclined(angle=math.radians(40.0), nosing_spacing=0.150)
    found = traverse_of(Question.in_one_posture(KENAF, flight, friction=2.0))
    land = next(each for each in found.phases if each.phase is Phase.LAND)
    assert math.degrees(land.tilt_downhill[0]) >= 60.205 - 40.0 - 1e-3
