"""What friction and grousers hold, on treads and poses made by hand."""

import math
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import contact
from kaidan.mechanics.grousers import slip_height
from kaidan.traversal.grip import Grip, treads_of

NAN = math.nan
X = np.array([-1.0, 0.0, 0.0, 0.06, 0.06, 1.0])


@pytest.mark.parametrize("rises", [-0.1, 0.0, 0.1])
def test_treads_uphill_of_a_point(rises):
    """A tread of 60 mm between risers of 180 mm: uphill of a riser's foot is none.

    The normal of what rises to the right leans to the left, and the mirror turns it round.
    """
    z = np.array([0.0, 0.0, 0.18, 0.18 + 0.06 * rises, 0.36, 0.36])
    tilt = -math.atan(rises)
    expected = [0.0, NAN, tilt, NAN, 0.0, 0.0]
    up = treads_of(SimpleNamespace(x=X, z=z), descending=False)
    assert up == pytest.approx(expected, abs=1e-9, nan_ok=True)
    seen_from_the_other_side = SimpleNamespace(x=-X[::-1], z=z[::-1])
    down = treads_of(seen_from_the_other_side, descending=True)
    mirrored = [-each for each in expected[::-1]]
    assert down == pytest.approx(mirrored, abs=1e-9, nan_ok=True)


@pytest.mark.parametrize("descending", [False, True])
def test_heights_gained_as_it_slips_back(descending):
    """By trapezia over poses 0.1 m apart, not farther than the path; down the slope is ahead."""
    slopes, required = np.array([0.4, 0.5, 0.6, 0.7]), 1.5
    path = SimpleNamespace(
        s=np.array([0.0, 0.1, 0.2, 0.3]), poses=SimpleNamespace(path_direction=-slopes)
    )
    coulomb = np.full(4, math.atan(required))
    grip = SimpleNamespace(path=path, coulomb=coulomb, descending=descending)
    each = [slip_height(psi=psi, s=1.0, mu_k=0.2, mu_required=required) for psi in slopes]
    between = [0.05 * (one + other) for one, other in pairwise(each)]
    expected = [*between, 0.0] if descending else [0.0, *between]
    assert min(between) > 0
    assert Grip.slip_heights(grip, 0.1, mu_k=0.2) == pytest.approx(expected, abs=1e-12)


def test_grousers_that_stand_already():
    """The best contact of each pose, or friction; -1 is no contact."""
    standing = np.array([[0.1, 0.3, 9.0], [0.2, 0.1, 9.0], [-0.5, 9.0, 9.0]])
    grip = SimpleNamespace(
        _points=np.array([[4, 5, -1], [1, 2, -1], [3, -1, -1]]),
        _standing=lambda phi, grousers: standing,
    )
    found = Grip.at_once(grip, (0.5, 0.5, 0.5), None, np.array([0.0, 0.25, -0.6]))
    assert found == pytest.approx([0.3, 0.25, -0.5])


@pytest.mark.parametrize(
    ("phi", "height", "smooth"),
    [
        ((0.5, 0.5, 0.5), 0.0, True),
        ((0.5, 0.5, 0.5), 0.01, False),
        ((0.5, 0.4, 0.5), 0.0, False),
        ((0.5, 0.5, 0.4), 0.0, False),
        ((0.4, 0.5, 0.5), 0.0, False),
    ],
)
def test_one_friction_everywhere_is_worked_out_once(phi, height, smooth):
    coulomb, asked = np.array([0.1, 0.2]), []
    supports = SimpleNamespace(
        belt_margins=lambda *given: asked.append(given) or "belts",
        standing_margins=lambda *given: asked.append(given) or np.array([-0.3]),
    )
    grip = SimpleNamespace(coulomb=coulomb, _supports=supports, _known={})
    found = Grip.by_friction(grip, phi, height)
    if smooth:
        assert found == pytest.approx([0.4, 0.3])
        assert not asked
    else:
        assert (found, asked) == ("belts", [(phi, height)])
    asked.clear()
    if phi[0] == phi[1] == phi[2]:
        for _ in range(2):
            assert Grip._standing(grip, phi, "teeth") == pytest.approx([phi[0] - 0.3])
        assert asked == [((0.0, 0.0, 0.0), "teeth")]
    else:
        assert Grip._standing(grip, phi, "teeth") == pytest.approx([-0.3])
        assert asked == [(phi, "teeth")]


@pytest.mark.parametrize("a", [-1.2, 0.0, 0.8])
def test_the_load_is_gravity_and_the_acceleration_along_the_path(a, monkeypatch):
    """In the frame of the ground: a cos(psi) along x, g + a sin(psi) up."""
    psi = np.array([0.0, 0.6, -0.6])
    along, up = a * np.cos(psi), 9.80665 + a * np.sin(psi)
    path = SimpleNamespace(
        poses=SimpleNamespace(path_direction=psi),
        margins=SimpleNamespace(tilt=along / up, required_friction=np.ones(3)),
        ground=SimpleNamespace(x=X, z=np.zeros(6)),
    )
    given = {}

    def supports(_path, **words):
        given.update(words)
        return SimpleNamespace(points=None)

    monkeypatch.setattr(contact, "Supports", supports)
    Grip(path, descending=False, acceleration=a)
    assert given["force"][0] == pytest.approx(along)
    assert given["force"][1] == pytest.approx(up)


@pytest.mark.parametrize("descending", [True, False])
def test_it_slips_by_a_spacing_of_the_grousers_and_a_step(monkeypatch, descending):
    grip = SimpleNamespace(
        path=SimpleNamespace(poses=None), _points=None, descending=descending,
        _standing=lambda *_: None,
    )  # fmt: skip
    monkeypatch.setattr(contact, "held_while_slipping", lambda *_, **words: words)
    asked = grip, (0.5, 0.5, 0.5), SimpleNamespace(spacing=0.04), None
    way = pytest.approx(0.04 + contact.STEP)
    assert Grip.with_grousers(*asked) == {"way": way, "over": 0.04, "ahead": descending}
    strict = Grip.with_grousers(*asked, passing=False)
    assert strict == {"way": way, "over": 0.0, "ahead": descending}
