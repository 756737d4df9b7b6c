"""Tilt to the fall of samples, on samples whose fall is known; no kernel runs."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import contact
from kaidan.models import drawn_falls as module
from kaidan.models.drawn_falls import (
    FAR,
    _changed,
    _features,
    _Sample,
    _samples,
    drawn_falls,
)
from kaidan.outline import Outline
from kaidan.robot import Posture, Robot
from kaidan.traversal.tilting import LARGEST

WITHIN = math.radians(0.03)
RESERVE = 0.05
ASKED = SimpleNamespace(reserve=RESERVE)


@pytest.mark.parametrize("back", [1.0, -1.0])
@pytest.mark.parametrize("limit", [0.0, 0.1, -0.2, 0.5])
@pytest.mark.parametrize("off", [0.0, 0.003, -0.03, 0.2, -0.3])
def test_a_sample_is_driven_until_it_falls(back, limit, off, monkeypatch):
    asked = []

    def arrives(*, tilt, step):
        asked.append(tilt)
        return step == 0.02 and back * tilt <= limit

    monkeypatch.setattr(contact, "arrives", arrives)
    found = _Sample({"step": 0.02}, back).falls_at(limit + off)
    assert found == pytest.approx(limit, abs=WITHIN / 2)
    assert len(asked) < 6 + 2 * math.log2(max(abs(off), 0.01) / WITHIN)


def test_beyond_what_is_looked_for(monkeypatch):
    for survives, found in ((True, LARGEST), (False, -LARGEST)):
        monkeypatch.setattr(contact, "arrives", lambda survives=survives, **_: survives)
        for guess in (0.0, 0.4, -0.4, LARGEST, -LARGEST):
            assert _Sample({}, 1.0).falls_at(guess) == found


@pytest.fixture
def falls(monkeypatch):
    """Tilts less the reserve of samples with these tilts to the fall, and which were driven."""

    def of(tilts, first_rock, which=True, nominal=0.1, downhill=True):
        driven = set()

        def sample(k):
            driven.add(k)
            return SimpleNamespace(
                falls_at=lambda guess: tilts[k], survives=lambda tilt: tilt <= tilts[k]
            )

        def features(question, rock):
            return np.column_stack([np.ones(len(rock)), rock])

        monkeypatch.setattr(module, "_samples", lambda *given: sample)
        monkeypatch.setattr(module, "_features", features)
        other = SimpleNamespace(tilt=9.0)
        fall = SimpleNamespace(tilt=nominal)
        run = SimpleNamespace(
            falls_downhill=fall if downhill else other, falls_uphill=other if downhill else fall
        )
        which = np.broadcast_to(which, np.shape(first_rock))
        found = drawn_falls(ASKED, run, np.asarray(first_rock), which, downhill=downhill)
        return found, driven

    return of


ROCK = np.random.default_rng(5).permutation(np.linspace(-0.2, 0.1, 301))


def test_what_need_not_be_driven(falls):
    tilts = 0.1 + ROCK
    for given in ({"which": False}, {"nominal": math.inf}, {"nominal": -math.pi / 2},
                  {"nominal": RESERVE + 0.2 + FAR + 1e-6}):  # fmt: skip
        found, driven = falls(tilts, ROCK, **given)
        assert not driven
        np.testing.assert_allclose(found, given.get("nominal", 0.1) - RESERVE + ROCK)
    assert falls(tilts[:1], [0.001])[0] == pytest.approx([0.051])
    assert falls(tilts, ROCK, nominal=RESERVE + 0.2 + FAR - 1e-6)[1]


@pytest.mark.parametrize("downhill", [True, False])
def test_a_line_foretells_samples_from_those_that_are_driven(downhill, falls, monkeypatch):
    """Those that rock the most and the least are, and of some alike many between."""
    monkeypatch.setattr(module, "DRIVEN", 8)
    tilts = 0.12 + 2 * ROCK
    rocks = ROCK < 0.05
    found, driven = falls(tilts, ROCK, rocks, downhill=downhill)
    np.testing.assert_allclose(found, tilts - RESERVE, atol=1e-12)
    near = {k for k in np.flatnonzero(rocks) if abs(tilts[k] - RESERVE) < WITHIN}
    assert len(driven - near) <= 8
    of_those = sorted(ROCK[k] for k in driven - near)
    assert (of_those[0], of_those[-1]) == (ROCK[rocks].min(), ROCK[rocks].max())
    assert np.diff(of_those).max() < 0.05
    assert near <= driven
    assert rocks[list(driven)].all()


def test_of_two_samples_each_is_driven(falls):
    found, driven = falls(np.array([0.02, 0.2]), [-0.01, 0.02])
    np.testing.assert_allclose(found, [0.02 - RESERVE, 0.2 - RESERVE])
    assert driven == {0, 1}


@pytest.mark.parametrize("most", [512, 40])
def test_near_the_reserve_it_is_driven_on_which_side_a_sample_lies(most, falls, monkeypatch):
    """Off the line by 20 mrad or not; of those that are not driven the nearer one's side counts."""
    monkeypatch.setattr(module, "MOST", most)
    off = 0.02 * np.sign(np.sin(np.arange(301)))
    tilts = 0.12 + 2 * ROCK + off
    found, driven = falls(tilts, ROCK)
    right = (found > 0) == (tilts >= RESERVE)
    assert right[sorted(driven)].all()
    near = np.abs(0.12 + 2 * ROCK - RESERVE) < 0.055
    assert right[~near].all()
    assert right.mean() >= (1.0 if most == 512 else 0.9)
    assert len(driven) <= 64 + most
    assert len(driven) > 70
    # those that are not driven scatter as those that are
    assert np.std(found - (0.12 + 2 * ROCK - RESERVE)) == pytest.approx(0.02, rel=0.2)


def test_scatter_about_a_line_by_hand(falls, monkeypatch):
    """Three of five are driven, off their line by e, -2 e and e; with two figures of the line that
    tells of sqrt(3) as much. The second and the fourth are as far off as the second and the first.
    """
    monkeypatch.setattr(module, "DRIVEN", 3)
    rock, e = 0.02 * np.arange(-2.0, 3.0), 1e-3
    line = RESERVE + 0.03 + rock
    found, driven = falls(line + e * np.array([1.0, 0, -2, 0, 1]), rock)
    assert driven == {0, 2, 4}
    off = e * np.array([1.0, -2 * math.sqrt(3), -2, math.sqrt(3), 1.0])
    np.testing.assert_allclose(found, line + off - RESERVE, atol=1e-12)


@pytest.mark.parametrize("descending", [False, True])
@pytest.mark.parametrize("downhill", [False, True])
def test_a_sample_has_its_own_robot_and_terrain(descending, downhill, monkeypatch):
    """Its nosings as drawn, as they are driven, and its robot with the end ahead that leads."""
    outline = Outline.of(Robot.named("kenaf"))
    drawn = np.array([[0.01, 0.02], [0.03, 0.01], [0.0, 0.004]])

    def driven(terrain, body, start, until):
        return {"terrain": terrain, "parts": body.parts.tolist(), "part": (start, until)}

    class Terrain(str):
        def reflected(self):
            return Terrain("reflected " + self)

    monkeypatch.setattr(module, "drawn_of_all", lambda question: drawn)
    monkeypatch.setattr(module, "nosings_of", lambda profile, drawn: ["none", "its own"])
    monkeypatch.setattr(module, "moved_profile", lambda profile, nosings: Terrain(nosings))
    monkeypatch.setattr(module, "way", driven)
    run = SimpleNamespace(descending=descending, acceleration=0.3, step=0.02, start=1, until=2)
    for facing in ("nose-first", "tail-first"):
        question = SimpleNamespace(profile=None, outline=outline, facing=facing)
        found = _samples(question, run, downhill)(1)
        body = _changed(outline, 0.02, 0.01, 0.004)
        body = body if facing == "nose-first" else body.turned_round()
        assert found.way == {
            "terrain": "reflected its own" if descending else "its own",
            "parts": body.parts.tolist(), "part": (1, 2), "acceleration": 0.3, "step": 0.02,
        }  # fmt: skip
        assert found.back == (1.0 if downhill is not descending else -1.0)


def test_what_the_tilt_is_taken_as_linear_in(monkeypatch):
    drawn = np.array([[1.0, 3.0], [2, 2], [0, 4], [1, 1], [5, 9], [0, 7]])
    monkeypatch.setattr(module, "drawn_of_all", lambda question: drawn)
    found = _features(ASKED, np.array([0.0, 0.2]))
    # each over its standard deviation; what does not differ is left out, and the sixth row too
    np.testing.assert_allclose(found, [[1, 1, 0, 2.5, 0], [1, 3, 2, 4.5, 2]])
    assert _features(ASKED, np.zeros(2)).shape == (2, 4)


def test_a_changed_robot_by_hand():
    """Its discs ahead by the change of C_L, the rear ones less that of L, all down by C_N's."""

    outline = Outline.of(Robot.named("absolem"), Posture(front="flat", rear="flat"))
    found = _changed(outline, 0.02, 0.005, 0.01).parts.reshape(-1, 3)
    discs = outline.parts.reshape(-1, 3)
    ahead = np.where(discs[:, 0] < 0, 0.005 - 0.02, 0.005)
    np.testing.assert_allclose(found, discs + np.c_[ahead, np.full_like(ahead, -0.01), 0 * ahead])
    low = _changed(outline, 0.0, 0.0, -1.0).parts.reshape(-1, 3)
    np.testing.assert_allclose(low[:, 1] - discs[:, 1], outline.stance.com_height - 1e-4)
