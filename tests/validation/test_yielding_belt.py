"""Acceptance of the yielding track, before any claim is made with it (docs/lab/physics.md).

Kenaf-like, R = 20 mm, 17 kN/m, 150 mm, unless stated. The margins required are those of another
planar simulation by others, which states neither its friction nor its damping: they are met with a
friction of 2 and a damping ratio of 0.0825, and with neither changed much (docs/lab/physics.md).
"""

import math

import numpy as np
import pytest

pytest.importorskip("numba", reason="skipped: numba not installed")

from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.physics import Outcome, YieldingBelt, run
from kaidan.physics.planar import RubberBody
from physics_cases import ENDS_IN_EVERY_RUN, climbs_up_to, margin, outcome, spec

SOFT = 1.7e4
REQUIRED = {10.0: (61.6, 0.7), 3.0: (58.3, 1.0), 1.0: (54.6, 1.0), 0.35: (53.8, 1.0)}
"""kt/k: margin and tolerance [deg], of another simulation."""


@pytest.mark.parametrize("ratio", REQUIRED)
def test_margins_of_another_simulation(ratio):
    # the gentlest slope that it does not climb, however that ends: it need not be monotonic
    required, tolerance = REQUIRED[ratio]
    track = YieldingBelt(stiffness=SOFT, shear_ratio=ratio, damping_ratio=0.0825)
    slopes = np.arange(required - 4.0, required + 2.0, 0.2)
    fields = {"radius": 0.02, "friction": 2.0, "track": track}
    lost = next(slope for slope in slopes if outcome(slope, **fields) is not Outcome.CLIMBED)
    # half a step of the slopes on top of what is tolerated
    assert lost - 0.1 == pytest.approx(required, abs=tolerance + 0.1)


@pytest.mark.parametrize("spacing", ENDS_IN_EVERY_RUN)
def test_rigid_limit_is_the_smooth_belt(spacing):
    pytest.importorskip("mujoco")
    # damped as MuJoCo's contacts are, so that neither bounces; 0.2 deg: the acceptance's
    smooth = margin(spacing, low=48.0, high=66.0)
    track = YieldingBelt(stiffness=1e7, damping_ratio=1.0)
    assert climbs_up_to(smooth - 0.2, smooth + 0.2, spacing, track=track)


@pytest.mark.parametrize("ratio", REQUIRED)
def test_halving_the_time_step_moves_the_margin_little(ratio):
    # a friction with which it falls and does not slide; 0.5 deg: the acceptance's
    track = YieldingBelt(stiffness=SOFT, shear_ratio=ratio)
    fields = {"low": 46.0, "high": 66.0, "radius": 0.02, "track": track}
    usual, halved = margin(0.150, **fields), margin(0.150, timestep=5e-4, **fields)
    assert usual == pytest.approx(halved, abs=0.5)


@pytest.mark.parametrize(("stiffness", "ratio"), [(SOFT, 1.0), (1e5, 0.3)])
def test_static_stiffness(stiffness, ratio):
    # on one level: all contacts are met at once on a tether, which is let go by and by
    body = RubberBody(spec(30.0, track=YieldingBelt(stiffness=stiffness, shear_ratio=ratio)))
    x, z = body.course.x, body.course.z
    assert body.settle() is None
    body.drive(0.0, 3000, on=False)
    forces, _, contacts = body.contact_forces()
    along = body.course.along
    across = np.array([-along[1], along[0]])
    assert contacts == np.count_nonzero(forces[:, 1] > 1.0) >= 3
    weight = 20.0 * STANDARD_GRAVITY
    assert forces.sum(axis=0) == pytest.approx(
        [weight * math.sin(math.radians(30.0)), weight * math.cos(math.radians(30.0))], rel=1e-3
    )
    # the body turns a little: so the underside's sink at each nosing, from its own place
    phi = body.pose()[2]
    assert phi == pytest.approx(body.course.slope, abs=math.radians(1.5))
    low = -body.course.outline.stance.com_height
    for k in np.flatnonzero(forces[:, 1] > 1.0):
        nosing = body.course.profile.nosings[k]
        foot = np.array(body.point(0.0, low))
        track_normal = np.array([-math.sin(phi), math.cos(phi)])
        # 5 %: the acceptance's; the forces are read across the line, the depth across the track
        assert forces[k, 1] == pytest.approx(stiffness * ((nosing - foot) @ track_normal), rel=0.05)
    sag = np.array([x, z]) - np.array(body.pose()[:2])
    sheared = ratio * stiffness * contacts
    turned = (phi - body.course.slope) * -low  # of the centroid about the underside
    assert forces[:, 0].sum() == pytest.approx(sheared * (sag @ along - turned), rel=0.05)
    assert sag @ across > 0


@pytest.mark.parametrize("tilt", [0.0, 0.3, -0.3])
@pytest.mark.parametrize("stiffness", [SOFT, 1e6])
def test_energy_does_not_grow_in_a_passive_drop(stiffness, tilt):
    track = YieldingBelt(stiffness=stiffness, damping_ratio=0.0)
    body = RubberBody(spec(30.0, track=track, friction=3.0))
    body.state[1] += 0.12
    body.state[2] += tilt
    mass, inertia = body.constants[:2]

    def energy():
        _, z, _, v_x, v_z, w = body.state
        kinetic = mass * (v_x**2 + v_z**2) / 2 + inertia * w**2 / 2
        return kinetic + mass * STANDARD_GRAVITY * z

    first, whole = energy(), mass * STANDARD_GRAVITY * 0.12
    for _ in range(300):
        body.drive(0.0, 5, on=False)
        # what the rubber holds is on top of it; 1 %: of the integrator, nothing damps here
        assert energy() < first + 0.01 * whole


def test_shear_is_bounded_by_friction():
    # atan(0.6) = 30.96 deg; 0.2 deg: the acceptance's for the slip limit
    track = YieldingBelt(stiffness=1e5, shear_ratio=0.5)
    assert run(spec(30.8, friction=0.6, track=track)).outcome is Outcome.CLIMBED
    assert run(spec(31.2, friction=0.6, track=track)).outcome is Outcome.SLID


@pytest.mark.slow
def test_it_is_forty_times_as_fast_as_the_robot():
    trial = spec(54.0, radius=0.02, track=YieldingBelt(stiffness=4.5e4, shear_ratio=0.5))
    run(trial)  # compiles
    results = [run(trial) for _ in range(5)]
    # settling takes 1.1 s of the robot's time
    assert max((each.time_s + 1.1) / each.wall_time_s for each in results) > 40.0


@pytest.mark.slow
def test_the_same_seed_gives_the_same_table_on_one_and_on_two_workers(tmp_path):
    pytest.importorskip("pyarrow")
    from kaidan.lab.verification.experiment import experiment

    options = {
        "spacings": "150mm",
        "angles": "54deg..58deg/3",
        "trials": 2,
        "track": YieldingBelt(stiffness=4.8e4),
        "seed": 7,
    }
    one, two = (
        experiment("kenaf", store=tmp_path / str(workers), workers=workers, **options)
        for workers in (1, 2)
    )
    assert one.columns() == two.columns()
    assert one == two
