"""Nosings that pass an end of the flat, and forces of a pose, by hand on records made for it."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from contact_cases import vector
from kaidan import contact
from kaidan.contact import Contact, Event, EventRecord, Feature, FeatureKind, PartKind
from kaidan.contact.door import table_of
from kaidan.contact.kernel.passings import along_flat
from kaidan.contact.layout import Part, Passed, Point
from kaidan.traversal.contact_forces import contact_forces
from kaidan.traversal.nosing_events import TOUCH, nosing_events
from kernel_memory import made, posed, table

G = 9.80665


@pytest.fixture(autouse=True)
def passed(monkeypatch):
    """A path made for it reports the passings that were made with it."""

    def told(path, touch):
        assert touch == TOUCH
        return table_of(Passed, path.passings)

    monkeypatch.setattr(contact, "nosings_passed", told)


def path_of(passings):
    """A path of ten poses with some passings."""
    n = np.arange(10.0)
    return SimpleNamespace(
        poses=SimpleNamespace(placements=np.c_[n, n**2, -n]), passings=passings
    )  # fmt: skip


def test_an_event_lies_between_two_poses():
    """A quarter of the way from (3, 9, -3) to (4, 16, -4)."""
    left, reached = (2.2, False, 7, 1, 3, 0.25), (4.0, True, 8, 0, 5, 0.0)
    found = list(nosing_events(path_of([left, reached])))
    one, other = (Feature(*each, FeatureKind.VERTEX).code for each in ((7, 1), (8, 0)))
    assert found == [
        EventRecord(Event.LEFT, 2.2, 3.25, 10.75, -3.25, one, -1, 3),
        EventRecord(Event.REACHED, 4.0, 5.0, 25.0, -5.0, other, -1, 5),
    ]


def test_place_along_a_flat_by_hand():
    """Discs of 50 and 20 mm, 500 mm apart: their lower tangent touches both at their radii.

    Turned, the tips of the flat and what lies below it keep their places along it.
    """
    turned, leans, r_1, r_2, apart = 0.4, 0.3, 0.05, 0.02, 0.5
    axis = np.array([math.cos(leans), math.sin(leans)])
    one = np.array([-0.2, 0.01])
    two = one + apart * axis
    parts = np.array([[*one, r_1, *two, r_2]])
    run = contact.traverse(np.array([(-3.0, 0.0), (3.0, 0.0)]), parts, -0.5, 0.0, step=0.5)
    # the normal that leads out of the robot, downwards: n . (two - one) = r_1 - r_2
    off = (r_1 - r_2) / apart
    n = off * axis + math.sqrt(1 - off**2) * np.array([axis[1], -axis[0]])
    tips = one + r_1 * n, two + r_2 * n
    length = math.dist(*tips)
    points = np.array([*tips, tips[0] + 0.03 * n, tips[1] - 0.01 * n])
    c, s = math.cos(turned), math.sin(turned)
    centroid = np.array([1.5, 0.7])
    x, z = (centroid + points @ np.array([[c, s], [-s, c]])).T
    ground = table(Point, made(Point, *({"x": x[k], "z": z[k]} for k in range(4))))
    part, place = table(Part, run.body.table)[0], posed(*centroid, turned)
    each = [along_flat(part, point, place) for point in ground]
    along, gap = zip(*each, strict=True)
    np.testing.assert_allclose(along, [0.0, length, 0.0, length], atol=1e-12)
    np.testing.assert_allclose(gap, [0.0, 0.0, 0.03, -0.01], atol=1e-12)


COM = (5.0, 1.3)


def touching(x, z, leans=0.0):
    """Contact beside the centroid, on a plane that rises ahead."""
    place = (COM[0] + x, COM[1] + z)
    return Contact(place, (-math.sin(leans), math.cos(leans)), 0, 0.0, PartKind.TRACK)


def forces(touched, carrying, *, needed=0.0, a=0.0, path=0.0, descending=False):
    """Forces of a pose, effective gravity along and up the level [N/kg]."""
    along = -a if descending else a
    pull = along * math.cos(path), G + along * math.sin(path)
    traverse = SimpleNamespace(
        descending=descending,
        path=SimpleNamespace(
            margins=SimpleNamespace(
                tilt=np.array([0.0, pull[0] / pull[1]]), required_friction=np.array([0.0, needed])
            ),
            poses=SimpleNamespace(
                placement=lambda row: contact.Placement(*COM, 0.1 * row),
                path_direction=np.array([0.0, path]),
            ),
            contacts_at=lambda place: tuple(touched),
            carrying=lambda row: tuple(carrying),
        ),
    )
    return contact_forces(traverse, 1, a), pull


@pytest.mark.parametrize("path", [0.0, 0.6, -0.4])
@pytest.mark.parametrize("a", [0.0, 2.0, -3.0])
@pytest.mark.parametrize("descending", [False, True])
def test_forces_of_two_contacts_add_up_to_effective_gravity(a, path, descending):
    pair = touching(-0.3, -0.2), touching(0.2, -0.2)
    found, pull = forces(pair, pair, a=a, path=path, descending=descending)
    assert [each.point for each in found] == [each.point for each in pair]
    assert np.sum([vector(each) for each in found], axis=0) == pytest.approx(pull)
    # about the centroid, 0.2 m above: the loads differ by what the tractions turn
    (rear, front), traction = (each.load for each in found), sum(each.traction for each in found)
    assert 0.3 * rear - 0.2 * front == pytest.approx(0.2 * traction)


@pytest.mark.parametrize("a", [2.0, -3.0])
def test_forces_on_two_planes_add_up_to_effective_gravity(a):
    pair = touching(-0.3, -0.2), touching(0.2, -0.2, 0.4)
    found, pull = forces(pair, pair, a=a)
    assert np.sum([vector(each) for each in found], axis=0) == pytest.approx(pull)


def test_the_pair_is_the_one_whose_friction_the_margins_tell():
    """On the floor before and behind no friction is needed, on the floor and at a face some."""
    rear, front, face = touching(-0.3, -0.2), touching(0.2, -0.2), touching(0.2, -0.1, math.pi / 2)
    beside = touching(0.2 + 5e-6, -0.2)
    floor, _ = forces((rear, front, beside, face), (rear, face))
    loads = {each.point: each.load for each in floor}
    assert loads == pytest.approx({rear.point: 0.4 * G, front.point: 0.6 * G, face.point: 0.0})
    # a ladder: both forces meet over the centroid, 0.3 / mu above the floor, 0.1 + 0.2 mu too
    wall, _ = forces((rear, front, beside, face), (rear, front), needed=0.9)
    loads = {each.point: each.load for each in wall}
    assert {point for point, load in loads.items() if load == 0.0} == {front.point, beside.point}
    assert max(each.traction / each.load for each in wall if each.load) == pytest.approx(1.0)


def test_a_contact_below_the_centroid_carries_all_of_it():
    rear, below, face = touching(-0.3, -0.2), touching(0.0, -0.2), touching(0.2, -0.1, math.pi / 2)
    for touched in ((rear, below), (below, rear)):
        found, _ = forces(touched, (rear, face))
        loads = {each.point: each.load for each in found}
        assert loads == pytest.approx({rear.point: 0.0, below.point: G})


@pytest.mark.parametrize("side", [1, -1])
def test_contacts_on_one_side_of_the_centroid_are_no_pair(side):
    """A floor and a face that holds it from behind, both ahead: 0.2 / mu = 0.5 + 0.2 mu above.

    Or the other way round.
    """
    rear, front = touching(-0.3 * side, -0.2), touching(0.2 * side, -0.2)
    hook = touching(0.2 * side, 0.3, -math.pi / 2 * side)
    mu = (-0.5 + math.sqrt(0.5**2 + 4 * 0.2 * 0.2)) / (2 * 0.2)
    assert contact.pair_forces(front, hook, COM, (0.0, G)).required_friction == pytest.approx(mu)
    found, _ = forces((rear, front, hook), (rear, front), needed=mu)
    loads = {each.point: each.load for each in found}
    assert loads == pytest.approx({rear.point: 0.4 * G, front.point: 0.6 * G, hook.point: 0.0})
    assert found[-1].traction == 0.0


def test_three_contacts_on_two_planes_are_no_springs():
    """In a trough of sides alike steep."""
    trough = [
        touching(*each) for each in ((-0.3, -0.2, -0.3), (0.2, -0.2, 0.3), (0.25, -0.19, 0.3))
    ]
    found, _ = forces(trough, trough[:2])
    assert [each.load > 0 for each in found] == [True, True, False]


@pytest.mark.parametrize("a", [0.0, 2.0])
def test_three_contacts_on_one_plane_are_springs_along_effective_gravity(a):
    """Evenly beside the centroid, which lies between them: a third of it each."""
    slope = 0.3
    plane = [touching(w * math.cos(slope), w * math.sin(slope), slope) for w in (-0.2, 0.0, 0.2)]
    found, pull = forces(plane, plane[::2], a=a)
    assert np.sum([vector(each) for each in found], axis=0) == pytest.approx(pull)
    n, t = (-math.sin(slope), math.cos(slope)), (math.cos(slope), math.sin(slope))
    for each, touched in zip(found, plane, strict=True):
        assert each.point == touched.point
        assert each.load == pytest.approx(np.dot(pull, n) / 3)
        assert each.traction == pytest.approx(np.dot(pull, t) / 3)
