"""One flight as programs draw it, with its floors, gaps and what stands or hangs about it.

Ten risers of 170 by 290 mm: the last tread ends at s = 2.61 m and lies at 1.53 m, the floor at its
head at 1.70 m.
"""

import numpy as np

from ifc_cases import House, monolith

RISE, GOING, RISERS = 0.17, 0.29, 10
END, HEAD = (RISERS - 1) * GOING, RISERS * RISE
"""Where the last drawn tread ends, and the level of the floor at the head [m]."""


def box(house, x, y, z):
    """Solid between two places along each axis."""
    outline = [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])]
    return house.slab(outline, z[1], z[1] - z[0])


def flight(
    schema="IFC4", unit="mm", *, gap=0.0, foot=0.0, level=0.0, width=1.0, head=True, base=True,
    more=(), hole=None, at=(0, 0, 0), degrees=0.0, mirrored=False, storeys=True,
):  # fmt: skip
    """Model of the flight between two slabs.

    Parameters
    ----------
    gap, foot : float
        Length of a gap before the floor at the head, and before the first riser [m].
    level : float
        Level below the gap at the head [m].
    head, base : bool
        Whether the floors are drawn.
    more : sequence of (str, callable)
        Other elements: category, and what draws its solid in the model.
    hole : ((float, float), (float, float)), optional
        Hole in the floor at the head: between two distances behind the last nosing, and across [m].
    """
    names = ((0.0, "Ground"), (HEAD, "First"))
    house = House(schema, unit, storeys=names if storeys else names[:1])
    where = {"at": at, "degrees": degrees}
    steps = [monolith(house, [RISE] * RISERS, [GOING] * (RISERS - 1), width=width, last=False)]
    shape = {"shape": house.mapped(steps, mirrored=True)} if mirrored else {"items": steps}
    house.add("IfcStairFlight", "S", **shape, **where)
    wide = (-3, 3)
    if head:
        x = (END + gap, END + gap + 5)
        cut = None if hole is None else [(END + s, t) for s, t in corners(*hole)]
        slab = house.slab(corners(x, wide), HEAD, 0.2, cut)
        house.add(
            "IfcSlab", "first floor", [slab], storey=len(names) - 1 if storeys else 0, **where
        )
    if base:
        ground = [
            box(house, (-5, -foot), wide, (-0.2, 0.0)),
            box(house, (0, END), wide, (-0.2, 0.0)),
        ]
        ground += [box(house, (END, 8), wide, (level - 0.2, level))]
        ground += [box(house, (-5, END), wide, (-1.7, -1.5))] if foot else []
        for each in ground:
            house.add("IfcSlab", "ground floor", [each], **where)
    for category, drawn in more:
        house.add(category, "more", [drawn(house)], **where)
    return house


def corners(x, y):
    """Corners of a rectangle in the plan."""
    return [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])]


def along(t, z, *, s=(-0.29, END)):
    """What runs along the flight between two places across and two heights over its nosings."""

    def drawn(house):
        low, high = ([(each, RISE + each / GOING * RISE + over) for each in s] for over in z)
        return house.side([low[0], low[1], high[1], high[0]], t[1] - t[0], t=t[1])

    return drawn


def solid(x, y, z):
    """What stands or hangs between places along, across and above."""
    return lambda house: box(house, x, y, z)


def blocks(*, gap=0.0, foot=0.0, head=True):
    """The same flight as boxes, (low corner, high corner) of each, shape (n, 2, 3) [m]."""
    found = [
        ((k * GOING, -0.5, max((k + 1) * RISE - 0.32, 0)), ((k + 1) * GOING, 0.5, (k + 1) * RISE))
        for k in range(RISERS - 1)
    ]
    found += [((END + gap, -3, HEAD - 0.2), (END + gap + 5, 3, HEAD))] if head else []
    found += [((-4, -3, -0.2), (-foot, 3, 0))]
    found += [((0, -3, -0.2), (8, 3, 0)), ((-4, -3, -1.7), (8, 3, -1.5))] if foot else []
    found += [] if foot else [((0, -3, -0.2), (8, 3, 0))]
    return np.array(found, dtype=float)


FACES = np.array([
    (0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7), (0, 1, 5), (0, 5, 4),
    (1, 2, 6), (1, 6, 5), (2, 3, 7), (2, 7, 6), (3, 0, 4), (3, 4, 7),
])  # fmt: skip


def obj(found):
    """Boxes as a mesh, text of an OBJ file."""
    lines, faces = [], []
    for number, (low, high) in enumerate(found):
        plan = [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]
        lines += [f"v {x} {y} {z}" for z in (low[2], high[2]) for x, y in plan]
        faces += ["f " + " ".join(map(str, each)) for each in FACES + 8 * number + 1]
    return "\n".join([*lines, *faces]) + "\n"


def seen_from_above(found, *, noise=0.003, apart=0.02, seed=0):
    """Points of tops and of risers that face the foot, shape (n, 3) [m]."""
    rng = np.random.default_rng(seed)
    points = []
    for low, high in found:
        low, high = np.maximum(low, (-1.5, -0.5, -9)), np.minimum(high, (5, 0.5, 9))
        x, y = (np.arange(low[k], high[k], apart) for k in (0, 1))
        z = np.arange(low[2], high[2], apart)
        points += [np.stack([*np.meshgrid(x, y), np.full((len(y), len(x)), high[2])], axis=-1)]
        face = np.meshgrid(y, z)
        points += [np.stack([np.full(face[0].shape, low[0]), *face], axis=-1)]
    points = np.concatenate([each.reshape(-1, 3) for each in points])
    for low, high in found:
        inside = ((points > low + 1e-6) & (points < high - (1e-6, 1e-6, 0.0))).all(axis=1)
        below = (points[:, :2] > low[:2]).all(axis=1) & (points[:, :2] < high[:2]).all(axis=1)
        below &= points[:, 2] < low[2]
        points = points[~inside & ~below]
    return points + rng.normal(0.0, noise, points.shape)


def heights(found, cell=0.02, unknown=None):
    """Elevation map of boxes; NaN between two places along, if they are given, shape (n, m) [m]."""
    x, y = np.arange(-1.5, 5.0, cell), np.arange(-0.6, 0.6, cell)
    z = np.full((len(y), len(x)), np.nan)
    for low, high in found:
        rows, columns = (
            np.flatnonzero((at >= low[k]) & (at < high[k])) for k, at in ((1, y), (0, x))
        )
        part = np.ix_(rows, columns)
        z[part] = np.fmax(z[part], high[2])
    if unknown is not None:
        z[:, (x > unknown[0]) & (x < unknown[1])] = np.nan
    return z
