"""Calls of every entry of the kernel as kaidan makes them, and their arguments taken apart."""

import copy

import numpy as np

from contact_cases import LANDING, flight, random_robot, random_terrain, stadium, steps
from kaidan import contact
from kaidan.contact import switch
from kaidan.contact.extremes import Manner, Sampled

G = 9.80665
STEPS = (0.005, 0.01, 0.02, 0.04)
"""Arclength between poses [m]: larger ones cost less, and meet other brackets of the same roots."""
TILTS = (0.0, 0.05, -0.1)
"""Of gravity [rad]."""
ROBOT = [*stadium(0.47, 0.2, 0.08, 0.06), [0.2, -0.02, 0.06, 0.45, 0.1, 0.03]]
KINDS = [0, 1]


class Recorder:
    """A kernel that notes what its entries are given."""

    def __init__(self, kernel, most=3):
        self.kernel, self.most, self.calls = kernel, most, {}

    def __getattr__(self, name):
        function = getattr(self.kernel, name)

        def call(*given):
            noted = self.calls.setdefault(name, [])
            if len(noted) < self.most:
                noted.append(copy.deepcopy(given))
            return function(*given)

        return call


def recorded(monkeypatch, most=3):
    """Arguments of up to so many calls of each entry."""
    with contact.using_kernel("auto"):
        recorder = Recorder(switch.kernel(), most)
    monkeypatch.setattr(switch, "_native", lambda: (recorder, ""))
    ask_everything()
    monkeypatch.undo()
    return recorder.calls


def ask_everything():
    """Each thing that the package is asked."""
    stairs = steps(0.15, 0.3, 2)
    path = contact.traverse(stairs, ROBOT, -0.6, 0.5, kinds=KINDS, step=0.02)
    down, parts = contact.mirror(steps(0.15, 0.3, 1), ROBOT)
    contact.traverse(down, parts, -0.6, 0.7, kinds=KINDS, step=0.02, acceleration=-0.5)
    contact.arrives(stairs, ROBOT, -0.6, 0.0, kinds=KINDS, tilt=0.05)
    contact.settle(stairs, ROBOT, 0.1, 0.3, kinds=KINDS)
    contact.resting_height(stairs, ROBOT, 0.1, 0.3, kinds=KINDS)
    path.between(np.array([1, 3]), np.array([0.3, 0.6]))
    path.is_on_flat(int(path.poses.rear[3]), 3)
    path.energy([0])
    path.row_before(0.2)
    for record in path.rotations:
        contact.rotated(path, record, 0.5 * record.angle)
    contact.impact_speeds(path)
    touching = path.contacts_at(path.poses.placement(2))
    contact.pair_forces(*touching[:2], (0.0, 1.0), (0.0, G))
    contact.spring_loads(touching, (0.0, 1.0), 0.1, G)
    contact.nosings_passed(path, 1e-7)
    phase = contact.phases_by_zones(path, [[(-9.0, 0.0, -1.0, 0.1)]], [(0.2, 9.0, 0.2, 0.4)])
    seen = contact.samples_of(path, phase, 1e-7, acceleration=0.0)
    margins, count = seen.path.margins, len(path.poses)
    some = Sampled(
        seen.path, phase, np.zeros(count, bool), seen.rows, np.ones(len(seen.rows), bool),
        np.abs(margins.required_friction), np.abs(margins.traction),
        np.zeros(len(seen.rows), bool),
    )  # fmt: skip
    manner = Manner(
        False, True, (contact.EVERY_POSE,) * 3, [(0.4, 9.0, 0.0, 9.0)], [(0.0, 0.3)],
        np.array([0.0, 0.3]), 0.08, 0.2,
    )  # fmt: skip
    contact.extremes_of(some, np.full(count, -np.inf), np.zeros(count, bool), manner)
    stand_and_grip(path)
    many()


def stand_and_grip(path):
    up, down = np.array(ROBOT), np.array(ROBOT)
    up[1, 4], down[1, 4] = 0.2, -0.1
    stood = contact.stand_in_turn(steps(0.15, 0.3, 1), [up, down], KINDS, -0.3, 0.1)
    contact.belt_slides(stood)
    count = len(path.poses)
    grousers = contact.Grousers(0.01, 0.04, 0.005, 0.002, True)
    supports = contact.Supports(
        path, force=(np.zeros(count), np.full(count, G)), coulomb=np.full(count, 0.5),
        treads=np.zeros(len(path.ground)), climbs=True, steep=1.0, touch=1e-7,
    )  # fmt: skip
    phi = (0.5, 0.6, 0.4)
    standing, smooth = supports.standing_margins(phi, grousers), supports.belt_margins(phi, 0.01)
    contact.held_while_slipping(
        path.poses, supports.points, standing, smooth, way=0.05, over=0.04, ahead=True
    )


def many():
    jobs = [contact.Job(0, 0, -0.6, 0.2), contact.Job(0, 1, -0.6, 0.2)]
    stairs = flight(0.5, 0.2, 2)
    contact.traverse_many(
        [stairs], [ROBOT, ROBOT], jobs, kinds=[KINDS] * 2, step=0.05, with_margins=True, size=400
    )
    belts = contact.belts_on(
        [(0.01, 0.05, 0.008, 0.003, True, 0.5, 0.6, 0.7, False)],
        np.zeros(len(contact.ground_of(stairs))), climbs=True, steep=1.0, touch=1e-7, slip=0.005,
    )  # fmt: skip
    contact.rate_many(
        stairs, [ROBOT, ROBOT], KINDS, [0.47, 0.47], [[(0.0, 0.3, 0.5)], []], jobs, step=0.05,
        zones=[(0.3, 9.0, 0.2, 9.0)], edges=[(0.3, 0.2)], rough=0.01, belts=belts,
    )  # fmt: skip


def leaves(given, path=()):
    """Places of all that is no tuple within what is given."""
    if isinstance(given, tuple):
        for k, part in enumerate(given):
            yield from leaves(part, (*path, k))
    else:
        yield path, given


def changed(given, path, value):
    """What is given, with another value at one place."""
    if not path:
        return value
    k, *rest = path
    return (*given[:k], changed(given[k], tuple(rest), value), *given[k + 1 :])


def random_way(seed):
    """A random robot from just before the first riser on: the landing is alike for all of them.

    In plain Python a pose among a thousand points of a scan takes a hundred times as long as one on
    a landing, so that a scan is of what the robot can come near.
    """
    rng = np.random.default_rng(seed)
    parts, kinds = random_robot(rng)
    terrain = random_terrain(rng)
    start = terrain[0, 0] + LANDING - np.abs(parts[:, [0, 3]]).max() - 0.25
    end = min(start + rng.uniform(0.3, 1.0), terrain[-1, 0] - 2)
    if seed % 5 == 0:
        x = np.arange(start - 1.5, end + 1.5, 0.02)
        z = np.interp(x, terrain[:, 0] + 1e-9 * np.arange(len(terrain)), terrain[:, 1])
        terrain = np.stack([x, z + rng.normal(0, 0.003, len(x))], 1)
    how = {"kinds": kinds, "acceleration": (0.0, 0.3, -0.5)[seed % 3], "step": STEPS[seed % 4]}
    return (terrain, parts, start, end), how


def asked_of(way, how, seed):
    """What a drive leaves behind, what lies between its poses, and whether it arrives tilted."""
    path = contact.traverse(*way, **how)
    rng = np.random.default_rng(seed)
    count = len(path.poses)
    phase = np.sort(rng.integers(0, 3, count))
    whence = np.where(rng.random(count) < 0.3, path.inclination + 0.1, -np.inf)
    back, corner = rng.random((2, count)) < 0.2
    middle = float(np.median(path.poses.front_point[:, 0]))
    manner = Manner(
        descending=seed % 2 == 1, whole=seed % 3 == 0, counts=tuple(rng.permutation(3)),
        tops=[(middle + 0.1, np.inf, -np.inf, np.inf)], flights=[(middle - 0.5, middle)],
        nosings=np.array([middle]), height=0.1, gyration=0.2, acceleration=how["acceleration"],
    )  # fmt: skip
    seen = contact.samples_of(path, phase, 1e-7, acceleration=how["acceleration"])
    margins, lasts = seen.path.margins, np.arange(len(seen.rows)) % 5 > 0
    samples = Sampled(
        seen.path, phase, corner, seen.rows, lasts, np.abs(margins.required_friction),
        np.abs(margins.traction), np.arange(len(seen.rows)) % 7 == 0,
    )  # fmt: skip
    extremes = contact.extremes_of(samples, whence, back, manner)
    tables = (path.poses, path.events, path.rotations, path.margins, seen.path.poses, margins)
    return (
        path.status, *(each.table.tolist() for each in tables), seen.rows.tolist(), extremes,
        [contact.arrives(*way, tilt=tilt, **how) for tilt in TILTS],
    )  # fmt: skip
