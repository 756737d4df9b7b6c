"""Experiments of known robots: what went in comes out within the intervals that are stated."""

import math
import tomllib

import numpy as np
import pytest

pytest.importorskip("scipy", reason="skipped: scipy not installed")

from kaidan.lab.rig.calibration import calibrate_rig
from kaidan.lab.rig.protocol import protocol_of
from kaidan.lab.rig.sheet import RigSheet
from kaidan.mechanics.margin import theta_s_sup
from kaidan.mechanics.yielding import theta_d_two_contacts
from kaidan.robot import Robot

MASS, GRAVITY = 20.0, 9.80665
ROBOT = Robot.named("kenaf").model_copy(update={"mass": MASS})
PROTOCOL = protocol_of("kenaf", ROBOT)


def truth(rng):
    """A robot's track and its margins: 3 to 15 mm, half to twice that in shear, theta_M 0 to 5."""
    w_n = rng.uniform(0.003, 0.015)
    return {
        "k": MASS * GRAVITY / w_n,
        "kt": MASS * GRAVITY / (w_n * rng.uniform(0.5, 2.0)),
        "theta_M": math.radians(rng.uniform(0.0, 5.0)),
        "scatter": math.radians(rng.uniform(0.3, 1.5)),
        "off": math.radians(rng.uniform(-3.0, 3.0)),
        "w_n": w_n,
    }


def margin(p, true):
    place = {"L": 0.470, "p": p, "C_L": 0.196, "C_N": 0.071}
    return float(theta_s_sup(**place, a=0.0)) + true["off"]


def tilt(p, angle, true):
    place = {"L": 0.470, "p": p, "C_L": 0.196, "C_N": 0.071}
    found = float(theta_d_two_contacts(**place, theta_s=angle, w_n=true["w_n"]))
    return 0.02 if math.isnan(found) else found


def experiment(true, rng):
    """The protocol's sheet, filled in by chance: coins for falls, normal measurements."""
    table = tomllib.loads(PROTOCOL.sheet)
    table["mass"] = MASS
    for name, stiffness in (("press", true["k"]), ("shear", true["kt"])):
        for row in table[name]:
            force = float(row["force"].removesuffix("N"))
            # the dial starts anywhere and reads to some hundredths
            row["travel"] = force / stiffness + 0.0004 + rng.normal(0.0, 5e-5)
    for row in table["trials"]:
        p = float(row["nosing_spacing"].removesuffix("mm")) / 1e3
        angle = math.radians(float(row["angle"].removesuffix("deg")))
        higher = true["theta_M"] if row["direction"] == "down" else 0.0
        holds = 1 / (1 + math.exp(-(margin(p, true) + higher - angle) / true["scatter"]))
        row["results"] = "".join("h" if each < holds else "f" for each in rng.random(5))
        if row["direction"] == "up":
            near = tilt(p, angle, true)
            held = row["results"].count("h")
            row["extra"] = (near + rng.normal(0.0, math.radians(0.3), held)).tolist()
    return RigSheet.model_validate(table)


def recovered(seed):
    """Whether each figure of a synthetic experiment lies within its interval."""
    rng = np.random.default_rng(seed)
    true = truth(rng)
    sheet = experiment(true, rng)
    found = calibrate_rig(sheet)

    def within(one, value):
        return one is not None and one.low <= value <= (math.inf if one.high is None else one.high)

    tilts = []
    for each in found.spacings:
        if each.theta_d_deg is not None:
            p = each.nosing_spacing_m
            rows = [r for r in sheet.trials if r.nosing_spacing == p and len(r.extra) >= 3]
            at = max(r.angle for r in rows if r.direction == "up")
            tilts.append(within(each.theta_d_deg, math.degrees(tilt(p, at, true))))
    return {
        "k": within(found.stiffness_N_m, true["k"]),
        "kt": within(found.shear_stiffness_N_m, true["kt"]),
        "theta_d": bool(tilts) and all(tilts),
        "theta_M": within(found.theta_M_deg, math.degrees(true["theta_M"])),
    }, found


@pytest.mark.parametrize("seed", [1, 2])
def test_a_known_robot_is_recovered(seed):
    assert all(recovered(seed)[0].values())


@pytest.mark.slow
def test_50_known_robots_are_recovered_in_nine_of_ten():
    """All four figures at once; 95 % is stated, so that 45 or fewer of 50 come by chance in 4 %."""
    each = [recovered(1000 + seed)[0] for seed in range(50)]
    together = sum(all(one.values()) for one in each)
    print({name: sum(one[name] for one in each) for name in each[0]}, together)
    assert together >= 45


@pytest.mark.slow
def test_intervals_are_no_wider_than_they_need_be():
    """k and kt to a few per cent, theta_M to a degree or two: what the protocol's page promises."""
    found = [recovered(2000 + seed)[1] for seed in range(20)]
    wide = [each.theta_M_deg.high - each.theta_M_deg.low for each in found]
    # 2.5 deviations either way of 0.6 deg are 3.0; a posterior has longer tails than a normal
    assert np.median(wide) < 5.0
    for each in found:
        assert each.stiffness_N_m.high / each.stiffness_N_m.low < 1.2


def trial_of_the_physics(row, k, seed):
    """A letter of the sheet and the tilt [rad], of Kenaf on the yielding belt with small ends."""
    from kaidan import Question, Stairs
    from kaidan.physics import Outcome, TrialSpec, YieldingBelt, run

    ends = {"front_radius": 0.011, "rear_radius": 0.011}
    robot = ROBOT.model_copy(update={"track": ROBOT.track.model_copy(update=ends)})
    p = float(row["nosing_spacing"].removesuffix("mm")) / 1e3
    angle = math.radians(float(row["angle"].removesuffix("deg")))
    up = row["direction"] == "up"
    question = Question.in_one_posture(
        robot,
        Stairs.inclined(angle=angle, nosing_spacing=p),
        friction=3.0,
        speed=0.1,
        direction=row["direction"],
        facing="nose-first" if up else "tail-first",
    )
    belt = YieldingBelt(stiffness=k, shear_ratio=1.1)
    found = run(TrialSpec(question=question, track=belt, seed=seed, nosings=5))
    tilt = math.radians(found.largest_extra_deg)
    if found.outcome is Outcome.CLIMBED:
        return ("h", tilt) if tilt < math.radians(15.0) else ("f", tilt)
    return ("f" if found.fell else "s"), tilt


@pytest.mark.slow
def test_a_belt_of_the_physics_is_recovered_which_the_fit_does_not_suppose():
    """Margins as 680 trials every 2 deg have them (docs/lab/rig.md): from there on it is lost."""
    pytest.importorskip("numba", reason="skipped: numba not installed")
    k, rng = 4.0e4, np.random.default_rng(5)
    table = tomllib.loads(PROTOCOL.sheet)
    table["mass"] = MASS
    for name, stiffness in (("press", k), ("shear", 1.1 * k)):
        for row in table[name]:
            force = float(row["force"].removesuffix("N"))
            row["travel"] = force / stiffness + 0.0004 + rng.normal(0.0, 5e-5)
    for row in table["trials"]:
        each = [trial_of_the_physics(row, k, int(rng.integers(1e6))) for _ in range(5)]
        row["results"] = "".join(letter for letter, _ in each)
        if row["direction"] == "up":
            row["extra"] = [tilt for letter, tilt in each if letter == "h"]
    found = calibrate_rig(RigSheet.model_validate(table))
    assert found.stiffness_N_m.low < k < found.stiffness_N_m.high
    assert found.shear_stiffness_N_m.low < 1.1 * k < found.shear_stiffness_N_m.high
    lost = {0.150: (54.0, 56.0), 0.180: (52.0, 54.0), 0.200: (46.0, 48.0), 0.220: (44.0, 48.0)}
    for one in found.spacings:
        low, high = lost[round(one.nosing_spacing_m, 3)]
        assert one.margin_up_deg.low < high
        assert one.margin_up_deg.high > low
    assert found.theta_M_deg.low < 9.5  # the largest of its four spacings
    assert found.theta_M_deg.high > 5.6  # the smallest
