"""One step by hand: what shortens it, what happens at its end, and what is done where a look fails.

Hardly any drive comes to the later ones, so what they ask is put in the place of the plain kernel.
"""

import itertools
import math

import pytest

from contact_cases import stadium
from kaidan.contact import Feature, FeatureKind, body_table, ground_table
from kaidan.contact.codes import Advance
from kaidan.contact.kernel import advance, continuation
from kaidan.contact.kernel.continuation import ARM, tilt
from kaidan.contact.layout import NO_FEATURE, At, Held, Pull
from kernel_memory import posed, scene

L, C_L, C_N, R = 0.6, 0.28, 0.1, 0.08
TRACK = stadium(L, C_L, C_N, R)
BODY = body_table(TRACK)
LEVEL = ground_table([(-4, 0), (4, 0)])
G = 9.8
STRAIGHT = Pull(0.0, G)


def code(point, kind, part=0):
    return Feature(point, part, kind).code


REAR, FRONT = code(0, FeatureKind.DISC_1), code(0, FeatureKind.DISC_2)


def level_at(x):
    return Held(x, C_N, 0.0, 1.0, 0.0, 0.0, REAR, FRONT)


# --- what shortens a step -----------------------------------------------------------------------


def test_a_long_step_is_cut_to_a_share_of_the_radius():
    what, there, ds = advance.advance(scene(LEVEL, BODY), level_at(0.3), 0.05, R, STRAIGHT)
    assert what == Advance.NOTHING
    assert (ds, there[0]) == pytest.approx((0.25 * R, 0.3 + 0.25 * R), abs=1e-12)


TURNS_UP = ground_table([(-4, 0), (1, 0), (4, 3e-6)])
"""A floor so flat a corner of which no end has sunk into the other side where it passes it."""


@pytest.mark.parametrize("end", [C_L, C_L - L])
def test_a_step_that_leads_past_a_corner_is_short(end):
    """20 um up to the corner: a step of 200 um is cut to 80 um, one of 50 um is not."""
    here = level_at(1 - end - 2e-5)
    if end < 0.0:
        here = here._replace(front=code(1, FeatureKind.DISC_2))
    for ds, taken in ((5e-5, 5e-5), (2e-4, 8e-5)):
        found = advance.clear_step(scene(TURNS_UP, BODY), here, ds, STRAIGHT)
        assert found[0]
        assert found[-1] == pytest.approx(taken)


def test_a_disc_has_run_past_where_its_foot_is_beyond_its_segment():
    for past, does in ((2e-9, True), (0.5e-9, False), (-1e-3, False)):
        place, there = At(1 - C_L + past, C_N, 1.0, 0.0), scene(TURNS_UP, BODY)
        assert advance.runs_past(there, FRONT, place) == does
        assert not advance.runs_past(there, code(1, FeatureKind.VERTEX), place)


def test_a_step_that_leads_deep_into_what_is_thin_is_shortened():
    """Deeper than half of its radius, 1 mm: then a face that it never met may be the nearer one."""
    thin = body_table([*TRACK, [0.28, -0.02, 0.05, 0.6, 0.02, 0.001]])
    wall = ground_table([(-4, 0), (1, 0), (1, 1), (4, 1)])
    here = level_at(1 - 0.6 - 0.001 - 0.005)  # its end 5 mm before the wall
    for ds, taken in ((0.0053, 0.0053), (0.008, 0.0032)):
        found = advance.clear_step(scene(wall, thin), here, ds, STRAIGHT)
        assert found[0]
        assert found[-1] == pytest.approx(taken)


BEGIN, END = (0.2, 0.5, 0.05, 1.0, 0.0, 0.2), (0.21, 0.52, 0.1, 0.0, 1.0, -0.2)
REAR_1, FRONT_1 = code(2, FeatureKind.DISC_1), code(3, FeatureKind.DISC_2)
A = 0.1 * G
THERE = Held(*END, REAR_1, FRONT_1)
LEANS, LEANS_1 = tilt(Pull(A, G), 1.0, 0.0), tilt(Pull(A, G), 0.0, 1.0)
"""Tilt of gravity at both ends of a step that turns from level to upright."""


def put_step(monkeypatch, levers, grazes=lambda sign, ds: False):
    """A step between two poses, how far ahead contacts lie at its end, and what may be grazed."""
    asked = []

    def stepped(scene, held, ds):
        assert held == (*BEGIN, REAR, FRONT)
        return True, THERE, posed(*END[:3])

    def lever(scene, feature, at, kappa):
        assert at == posed(*END[:3])
        return levers[feature, kappa]

    def may_graze(scene, held, there, ahead, *given):
        sign = 1.0 if ahead else -1.0
        one, other = (held.front, there.front) if ahead else (held.rear, there.rear)
        asked.append((one, other, sign, *given[:2], *held[:6], *there[:6], given[2]))
        return grazes(sign, given[2])

    monkeypatch.setattr(advance, "stepped", stepped)
    monkeypatch.setattr(advance, "lever", lever)
    monkeypatch.setattr(advance, "may_graze", may_graze)
    monkeypatch.setattr(advance, "nearest", lambda *given: (NO_FEATURE, 9.0))
    monkeypatch.setattr(advance, "runs_past", lambda *given: False)
    return asked


def clear(ds=0.01):
    return advance.clear_step(scene(LEVEL, BODY), Held(*BEGIN, REAR, FRONT), ds, Pull(A, G))


@pytest.mark.parametrize("side", ["front", "rear"])
@pytest.mark.parametrize(
    ("then", "before", "near"),
    [(0.029, 9.0, True), (9.0, 0.029, True), (0.031, 0.031, False), (-0.01, 9.0, True),
     (9.0, -0.01, True)],
)  # fmt: skip
def test_a_step_that_may_graze_a_contact_is_shortened(monkeypatch, side, then, before, near):
    """Looked at where one is within three steps, by the tilt of gravity at either end."""
    levers = {(FRONT_1, LEANS_1): 9.0, (FRONT_1, LEANS): 9.0}
    levers |= {(REAR_1, LEANS_1): -9.0, (REAR_1, LEANS): -9.0}
    sign, one, other = (1.0, FRONT, FRONT_1) if side == "front" else (-1.0, REAR, REAR_1)
    levers |= {(other, LEANS_1): sign * then, (other, LEANS): sign * before}
    asked = put_step(monkeypatch, levers, lambda sign, ds: ds > 0.005)
    good, there, third, distance, behind, ahead, ds = clear()
    assert (good, there, third) == (True, THERE, NO_FEATURE)
    assert distance == 9.0
    assert (behind, ahead) == (-levers[REAR_1, LEANS_1], levers[FRONT_1, LEANS_1])
    # twice as near for a step of four tenths
    still = near and min(then, before) <= 3.0 * 0.004
    lengths = [0.01, 0.004][: near + still]
    assert [each[:3] for each in asked] == [(one, other, sign)] * len(lengths)
    assert [each[-1] for each in asked] == pytest.approx(lengths)
    assert all(each[3:-1] == (LEANS, LEANS_1, *BEGIN, *END) for each in asked)
    assert ds == pytest.approx(0.004 if near else 0.01)


def test_what_is_not_grazed_shortens_nothing(monkeypatch):
    levers = {(each, kappa): sign * 0.01 for each, sign in ((FRONT_1, 1), (REAR_1, -1))
              for kappa in (LEANS, LEANS_1)}  # fmt: skip
    asked = put_step(monkeypatch, levers)
    assert clear()[-1] == 0.01
    assert [each[2] for each in asked] == [1.0, -1.0]


def test_a_step_of_twenty_micrometres_is_not_shortened_for_what_is_grazed(monkeypatch):
    levers = {(each, kappa): 0.0 for each in (FRONT_1, REAR_1) for kappa in (LEANS, LEANS_1)}
    put_step(monkeypatch, levers, lambda sign, ds: True)
    assert clear()[-1] == pytest.approx(0.01 * 0.4**7)  # 16 um


def test_no_step_where_the_corrector_finds_none(monkeypatch):
    """Four tenths of it each time, down to a nanometre."""
    tried = []

    def stepped(*given):
        tried.append(given[-1])
        return False, THERE, posed(*END[:3])

    monkeypatch.setattr(advance, "stepped", stepped)
    *found, ds = clear()
    assert tried == pytest.approx([0.01 * 0.4**k for k in range(18)])
    assert tried[-1] > 1e-9 > ds == pytest.approx(0.01 * 0.4**18)
    assert found == [False, (*BEGIN, REAR, FRONT), NO_FEATURE, 0.0, 0.0, 0.0]


def at_angle(v, phi, kappa):
    """Height of the centroid at which the front disc's foot on a floor is ahead by v."""
    ahead = C_L * math.cos(phi) - (R - C_N) * math.sin(phi)
    return (v - ahead) / kappa


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_an_end_that_rolls_may_be_grazed(sign):
    """As a vertex is: tangents of 1 down and 1 up again meet half of a step further and lower."""
    phi0, phi1, kappa = 0.5, 0.9, -0.5

    def grazes(v0, v1, rate0, rate1, ds, kappa1=kappa):
        poses = []
        for v, phi, rate in ((v0, phi0, rate0), (v1, phi1, rate1)):
            up = C_L * math.sin(phi) + (R - C_N) * math.cos(phi)  # of the disc from the centroid
            turn = -sign * rate / up  # its foot moves with it, less the centroid
            z = at_angle(sign * v, phi, kappa)
            poses.append(Held(0.7, z, phi, 0.3, 0.2, ARM * turn, FRONT, FRONT))
        return advance.may_graze(scene(LEVEL, BODY), *poses, sign > 0.0, kappa, kappa1, ds)

    assert grazes(0.01, 0.01, -1.0, 1.0, 0.021)
    assert not grazes(0.01, 0.01, -1.0, 1.0, 0.019)
    assert not grazes(0.001, 0.029, 0.5, 2.0, 0.01), "it moves away"
    assert not grazes(0.02, 0.01, -2.0, -0.5, 0.01), "it still comes nearer"
    # passed by the tilt at the start, and by 1 mm not so at the end, as z tells
    z = at_angle(-sign * 1e-3, phi1, kappa)
    for hidden in (1e-3, -1e-3):
        kappa1 = kappa + sign * (hidden + 1e-3) / z
        assert grazes(0.02, -1e-3, 1.0, -1.0, 0.01, kappa1) == (hidden > 0.0)


# --- what happens at a pose ---------------------------------------------------------------------


def test_what_has_happened():
    for third, distance, behind, ahead, what in (
        (5, -2e-9, 1.0, 1.0, 5), (5, -0.5e-9, 1.0, 1.0, Advance.NOTHING),
        (5, 0.5e-9, 1.0, 1.0, Advance.NOTHING), (NO_FEATURE, -1.0, 1.0, 1.0, Advance.NOTHING),
        (5, -2e-9, -1.0, -1.0, 5), (5, 1.0, -1.0, 1.0, Advance.OVER_REAR),
        (5, 1.0, 1.0, -1.0, Advance.OVER_FRONT), (5, 1.0, -1.0, -1.0, Advance.OVER_REAR),
        (5, 1.0, 0.0, 1.0, Advance.OVER_REAR), (5, 1.0, 1.0, 0.0, Advance.OVER_FRONT),
    ):  # fmt: skip
        assert advance.happened(third, distance, 1e-9, behind, ahead) == what


@pytest.mark.parametrize("past", [1e-6, -1e-6])
def test_a_feature_is_named_as_at_the_pose(past):
    """A disc's foot on a slope of 1 in 2 that ends at its top."""
    ground, phi = ground_table([(-4, -2), (0, 0), (4, -2)]), 0.3
    u = complex(2.0, 1.0) / math.sqrt(5.0)
    centre = (past + 0.09j) * u
    com = centre - complex(C_L, R - C_N) * complex(math.cos(phi), math.sin(phi))
    here, there = Held(com.real, com.imag, phi, 0.6, 0.8, 0.0, REAR, FRONT), scene(ground, BODY)
    expected = code(1, FeatureKind.VERTEX) if past > 0.0 else FRONT
    assert advance.named(there, FRONT, here) == expected
    for what in (Advance.NOTHING, Advance.OVER_REAR, Advance.OVER_FRONT):
        assert advance.named(there, what, here) == what


@pytest.mark.parametrize(
    ("kappa_g", "what"), [(5.0, Advance.OVER_REAR), (-5.0, Advance.OVER_FRONT)]
)
def test_what_has_happened_at_the_begin_takes_no_step(kappa_g, what):
    """So far leans gravity that it passes both contacts on one side."""
    here = level_at(0.3)
    found = advance.cut_at_event(scene(LEVEL, BODY), here, 0.01, Pull(0.0, G, kappa_g))
    assert found[:2] == (what, here)
    assert found[2] == 0.0


RISER = ground_table([(-4, 0), (1, 0), (1, 0.1), (4, 0.1)])
MEETS = 1 - C_L - R
"""Where the front disc meets the riser's face."""


def cut(ds=0.01):
    return advance.cut_at_event(scene(RISER, BODY), level_at(MEETS - 0.004), ds, STRAIGHT)


def test_a_step_is_cut_at_the_first_event():
    what, there, ds = cut()
    assert what == code(1, FeatureKind.DISC_2)
    assert (ds, there[0]) == pytest.approx((0.004, MEETS), abs=1e-9)


@pytest.mark.parametrize("found", [(0, 0.003), (1, 0.0)])
def test_no_event_that_is_not_found(monkeypatch, found):
    monkeypatch.setattr(advance, "closing_time", lambda *given: found)
    what, there, ds = cut()
    assert (what, there, ds) == (Advance.NOT_CONVERGED, level_at(MEETS - 0.004), found[1])


def test_no_event_at_a_pose_that_is_not_found(monkeypatch):
    stepped = advance.stepped

    def fails(*given):
        good, *rest = stepped(*given)
        return good and given[-1] != 0.003, *rest

    monkeypatch.setattr(advance, "stepped", fails)
    monkeypatch.setattr(advance, "closing_time", lambda *given: (1, 0.003))
    what, there, ds = cut()
    assert (what, there, ds) == (Advance.NOT_CONVERGED, level_at(MEETS - 0.004), 0.003)


def test_a_name_taken_on_the_way_is_no_event(monkeypatch):
    """The step ends where that was found, and nothing has happened there."""
    monkeypatch.setattr(advance, "closing_time", lambda *given: (2, 0.003))
    what, there, ds = cut()
    assert (what, ds) == (Advance.NOTHING, 0.003)
    assert there[0] == pytest.approx(MEETS - 0.001, abs=1e-12)


@pytest.mark.parametrize("fails", [0, 3, 8])
def test_a_step_that_fails_is_shortened_eight_times(monkeypatch, fails):
    tried = []

    def cut_at_event(scene, here, ds, *given):
        tried.append(ds)
        what = Advance.NOT_CONVERGED if len(tried) <= fails else Advance.NOTHING
        return what, here, 0.9 * ds

    monkeypatch.setattr(advance, "cut_at_event", cut_at_event)
    here = level_at(0.3)
    found = advance.advance(scene(LEVEL, BODY), here, 0.01, R, STRAIGHT)
    assert tried == pytest.approx([0.01 * 0.4**k for k in range(min(fails + 1, 8))])
    if fails == 8:
        assert found == (Advance.NOT_CONVERGED, here, pytest.approx(0.01 * 0.4**8))
    else:
        assert found == (Advance.NOTHING, here, 0.9 * tried[-1])


# --- the corrector's answer ---------------------------------------------------------------------


@pytest.mark.parametrize(
    ("share", "good"), [(0.79, False), (0.81, True), (1.0, True), (1.19, True), (1.21, False)]
)
@pytest.mark.parametrize("ds", [0.02, 1e-4])
def test_a_step_that_went_elsewhere_is_none(monkeypatch, ds, share, good):
    """A fifth nearer or farther than it was to go, however alike the ways on are."""
    here = level_at(0.3)

    def found(x, good=True):
        return good, here._replace(x=x), posed(x, C_N, 0.0)

    monkeypatch.setattr(continuation, "corrected", lambda *given: found(0.3 + share * ds))
    assert continuation.stepped(scene(LEVEL, BODY), here, ds)[0] == good
    # of steps that are rounding it does not tell
    monkeypatch.setattr(continuation, "corrected", lambda *given: found(0.3 + 1.9e-10))
    assert continuation.stepped(scene(LEVEL, BODY), here, 1e-10)[0]


def test_no_step_where_the_corrector_fails_by_the_next_name(monkeypatch):
    """It is asked for no further name then."""
    there = level_at(0.31), posed(0.31, C_N, 0.0)
    answers = iter([(True, *there), (False, *there), (True, *there)])
    fresh = itertools.count(40)
    monkeypatch.setattr(continuation, "corrected", lambda *given: next(answers))
    monkeypatch.setattr(continuation, "relabelled", lambda *given: next(fresh))
    assert not continuation.stepped(scene(LEVEL, BODY), level_at(0.3), 0.01)[0]
    assert len(list(answers)) == 1
