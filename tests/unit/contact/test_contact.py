"""Small checks of the contact package, each computable by hand."""

import numpy as np
import pytest

from contact_cases import stadium, steps
from kaidan.contact import Event, Status, body_table, ground_table, settle, traverse
from kaidan.contact.kernel.gaps import gap, relabelled
from kaidan.contact.kernel.rotation import turned
from kaidan.contact.layout import At
from kernel_memory import scene


def test_flat_ground():
    pose = settle([[0, 0], [4, 0]], stadium(0.47, 0.196, 0.071, 0.06), 2.0, 0.3)
    assert pose.found
    assert pose.z == pytest.approx(0.071, abs=1e-12)  # m, rounding
    assert pose.inclination == pytest.approx(0, abs=1e-12)


def test_slope():
    pose = settle([[0, 0], [4, 2]], stadium(0.47, 0.196, 0.071, 0.06), 2.0, 0.0)
    assert pose.inclination == pytest.approx(np.arctan(0.5), abs=1e-11)
    assert pose.z == pytest.approx(1.0 + 0.071 * np.hypot(1, 0.5), abs=1e-11)


@pytest.mark.parametrize("feature", [64 * 2, 64 * 2 + 4, 64 * 2 + 1, 64 * 1 + 2, 64 * 3 + 6])
def test_gradient_of_gaps(feature):
    ground = ground_table(steps(0.2, 0.3, 3))
    body = body_table([[-0.3, 0, 0.08, 0.2, 0.01, 0.05], [0.2, 0.01, 0.05, 0.5, 0.1, 0.02]])
    x, z, phi = 0.05, 0.4, 0.3

    def value(q):
        return gap(scene(ground, body), feature, At(q[0], q[1], np.cos(q[2]), np.sin(q[2])))

    _, n_x, n_z, p_x, p_z = value((x, z, phi))
    gradient = [n_x, n_z, (p_x - x) * n_z - (p_z - z) * n_x]
    for k in range(3):
        d = np.zeros(3)
        d[k] = 1e-6
        numeric = (value(np.array([x, z, phi]) + d)[0] - value(np.array([x, z, phi]) - d)[0]) / 2e-6
        assert gradient[k] == pytest.approx(numeric, abs=1e-8)  # central difference, 1e-12 / 1e-6


def test_gap_of_a_disc_over_a_step_edge():
    ground = ground_table(steps(0.2, 0.3, 1))
    body = body_table(stadium(0.5, 0.2, 0.1, 0.06))
    # front disc's centre 0.1 left of the edge and 0.05 above it: hypot - R
    x, z = -0.1 - 0.2, 0.25 - (0.06 - 0.1)
    assert gap(scene(ground, body), 64 * 2, At(x, z, 1.0, 0.0))[0] == pytest.approx(
        np.hypot(0.1, 0.05) - 0.06
    )
    assert relabelled(scene(ground, body), 64 * 2 + 2, At(x, z, 1.0, 0.0)) == 64 * 2


def test_rolling_keeps_the_gap():
    ground = ground_table([[0, 0], [4, 1]])
    body = body_table(stadium(0.5, 0.2, 0.1, 0.06))
    phi = np.arctan(0.25)
    pose = settle([[0, 0], [4, 1]], stadium(0.5, 0.2, 0.1, 0.06), 2.0, phi)
    feature = 64 * 0 + 1
    x, z = turned(scene(ground, body), feature, 2.0, pose.z, pose.inclination, 0.4)
    angle = pose.inclination + 0.4
    assert gap(scene(ground, body), feature, At(x, z, np.cos(angle), np.sin(angle)))[
        0
    ] == pytest.approx(0)


def test_rates_of_a_rotation():
    """Over the edge of a step, nose down onto the landing: energy and plastic impact by hand."""
    k, g = 0.25, 9.80665
    run = traverse(
        steps(0.15, 0.3, 1), stadium(0.6, 0.28, 0.1, 0.08), -1.5, 1.2, gyration=k, gravity=g
    )
    rotation = run.rotations[0]
    assert rotation.arrested
    pivot = np.array(rotation.pivot_point)
    np.testing.assert_allclose(pivot, [0.0, 0.15], atol=1e-12)
    x, z, phi = rotation.end
    r = np.array(rotation.start[:2]) - pivot
    end = np.array([x, z]) - pivot
    assert np.hypot(*r) == pytest.approx(np.hypot(*end), abs=1e-12)  # it turns rigidly
    before = np.sqrt(2 * g * (r[1] - end[1]) / (k**2 + end @ end))
    assert rotation.rate_before == pytest.approx(before, rel=1e-9)
    # the front disc's contact on the landing, straight below its centre
    other = np.array([x + 0.28 * np.cos(phi) - (0.08 - 0.1) * np.sin(phi), 0.15])
    b = np.array([x, z]) - other
    after = max(before * (k**2 + end @ b) / (k**2 + b @ b), 0.0)
    assert rotation.rate_after == pytest.approx(after, rel=1e-6)


def test_events_of_a_step():
    run = traverse(steps(0.15, 0.3, 1), stadium(0.6, 0.28, 0.1, 0.08), -1.5, 1.2, with_margins=True)
    assert run.status is Status.OK
    codes = [each.kind for each in run.events]
    assert codes[-1] is Event.ARRIVED
    assert Event.NOSE_DROPS in codes
    assert codes.index(Event.NOSE_DROPS) < codes.index(Event.ARRESTED)
    assert run.margins is not None
    assert len(run.margins) == len(run.poses)


def test_wall_too_high():
    run = traverse(steps(1.5, 1.0, 1), stadium(0.6, 0.28, 0.1, 0.08), -1.5, 1.2)
    assert run.status is Status.FELL_BACKWARD


@pytest.mark.parametrize(
    ("terrain", "text"),
    [
        ([[0, 0]], "at least two"),
        ([[0, 0], [1, np.nan]], "finite"),
        ([[0, 0], [1, 0], [0.5, 1]], "backwards after point 1"),
        ([0, 1], "shape"),
    ],
)
def test_bad_terrain(terrain, text):
    with pytest.raises(ValueError, match=text):
        ground_table(terrain)


FOLDS = [(-3, 0), (0, 0), (0, 0.04), (0, 0.02), (0, 0.09), (0, 0.03), (0, 0.1), (3, 0.1)]
"""A face of 0.1 m that goes up and down within itself, as the noise of a scan has it."""


def test_a_face_that_goes_up_and_down_within_itself_is_the_same_face():
    """Of its points the ends count; a tip over the tread and a slit into the floor stay."""
    ends = [FOLDS[1], FOLDS[-2]]
    assert ground_table(FOLDS)[["x", "z"]][1:-1].tolist() == ends
    tip, slit = (0, 0.13), (0, -0.02)
    for more in ([tip], [slit], [slit, tip], [tip, slit]):
        points = [*FOLDS[:3], *more, *FOLDS[3:]]
        expected = [ends[0], *more, ends[1]]
        assert ground_table(points)[["x", "z"]][1:-1].tolist() == expected
    # as high as the tread, twice: still its end alone
    twice = [*FOLDS[:3], (0, 0.1), *FOLDS[3:]]
    assert (ground_table(twice) == ground_table(FOLDS)).all()


def test_a_folded_face_is_climbed_like_a_smooth_one():
    """By hand: no pose depends on what a face does within itself."""
    smooth = [*FOLDS[:2], *FOLDS[-2:]]
    found, expected = (
        traverse(each, stadium(0.47, 0.196, 0.071, 0.06), -1.0, 0.5) for each in (FOLDS, smooth)
    )
    assert found.status is Status.OK
    assert (found.poses.table == expected.poses.table).all()


@pytest.mark.parametrize(
    ("points", "z", "highest"),
    [
        ([(-3, 0), (0, 0), (0, 0.1001), (0, 0.1), (3, 0.1)], 0.171, 0.402),
        ([(-3, 0.1), (0, 0.1), (0, 0.1001), (0, 0), (3, 0)], 0.071, 1e-9),
    ],
)
def test_a_tip_of_a_face_is_no_wall(points, z, highest):
    """By hand: beyond a tip of 0.1 mm the robot comes over the edge of a kerb of 0.1 m, up and
    down, and stands on the floor as high as its centroid above the flat; smooth it rises by 0.401.
    """
    run = traverse(points, stadium(0.47, 0.196, 0.071, 0.06), -1.0, 0.5)
    assert run.status is Status.OK
    assert run.z[-1] == pytest.approx(z, abs=1e-9)
    assert run.inclination.max() == pytest.approx(highest, abs=1e-3)


def test_bad_robot():
    with pytest.raises(ValueError, match="negative"):
        body_table([[0, 0, -0.1, 1, 0, 0.1]])
    with pytest.raises(ValueError, match="kinds"):
        body_table([[0, 0, 0.1, 1, 0, 0.1]], [7])


def test_bounded_on_rubbish():
    """A robot longer than the landings and needles of zero width: an answer, whatever it is."""
    rng = np.random.default_rng(0)
    x = np.sort(np.round(rng.uniform(0, 1, 200), 2))
    terrain = np.stack([x, rng.uniform(0, 0.5, 200)], 1)
    run = traverse(terrain, stadium(3.0, 1.4, 0.3, 0.1), -0.5, 2.0)
    assert isinstance(run.status, Status)
