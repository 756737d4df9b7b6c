"""A building put together from its solids: which are flights, and what they join."""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from kaidan.errors import InputError
from kaidan.readers.accounting import MOVING, RAMPS, Drawn, Refused, accounted
from kaidan.readers.building import Building, Flight, Floor, Storey
from kaidan.readers.doorways import doorways_of
from kaidan.readers.estimate import Refusal
from kaidan.readers.flight import LAST_SPREAD, FlightEstimate
from kaidan.readers.kinds import Array, Bodies, Body, Provenance
from kaidan.readers.naming import named_apart
from kaidan.readers.solids.ground import FLUSH, floor_before, floor_behind
from kaidan.readers.solids.levels import Plate, plates_of
from kaidan.readers.solids.path import Path
from kaidan.readers.solids.rays import Triangles
from kaidan.readers.solids.room import FARTHEST, free_outline, walls_around
from kaidan.readers.solids.runs import RISES, Run, runs_of
from kaidan.readers.solids.section import Section, section_of
from kaidan.readers.solids.stated import stated_rise
from kaidan.readers.solids.surroundings import surroundings_of
from kaidan.terrain.gap import DEEPEST_TREAD

LANDS = 0.05
"""Distance behind the edge of a floor at which one stands on it [m]."""
OF_STOREY = 0.3
"""Difference up to which a floor is that of a storey [m]."""
STAIRS = ("stair", "flight")
LIKE_STAIRS = 0.05
"""Spread of rises up to which solids that nobody called stairs are some [m]."""
UNLIKE = 0.015
"""Difference from the other depths by which the last tread is no tread [m]."""
OVERHEAD_OR_BESIDE = (
    "IfcRailing", "IfcDoor", "IfcWall", "IfcColumn", "IfcBeam", "IfcRoof", "IfcCurtainWall",
)  # fmt: skip
"""What nobody stands on, by the beginning of its category."""
_FEWEST_UNNAMED = 3


def building_of(model: Bodies) -> Building:
    """Flights, floors and doors of a building model.

    Parameters
    ----------
    model : Bodies
        Elements with their triangles, in metres, z up.

    Returns
    -------
    Building
    """
    return _Assembly(model).building()


class _Assembly:
    """What is worked out once of a model."""

    def __init__(self, model: Bodies) -> None:
        self.model = model
        self.bodies = model.bodies
        self.by_id = {each.identity: each for each in self.bodies}
        storeys = [Storey(each["id"], each["name"], each["level"]) for each in self._storeys()]
        self.storeys = tuple(sorted(storeys, key=lambda one: one.level))
        self.unit: float = model.facts.get("unit", 1.0)
        meshes = [(each.vertices, each.faces) for each in self.bodies]
        everything = Triangles.of(meshes)
        self.origin = (
            everything.corners.reshape(-1, 3).min(axis=0)
            if len(everything.corners)
            else np.zeros(3)
        )
        self.origin[2] = 0.0  # levels stay those of the model
        self.all = Triangles(everything.corners - self.origin, everything.owner)
        self.is_stair = [self._stair(each) for each in self.bodies]
        standing = {k for k, each in enumerate(self.bodies) if self._carries(each)}
        doors = {k for k, each in enumerate(self.bodies) if each.category == "IfcDoor"}
        self.solids = self.all.of_owners(standing)
        self.obstacles = self.all.of_owners(set(range(len(self.bodies))) - doors)
        rails = {k for k, each in enumerate(self.bodies) if each.category == "IfcRailing"}
        self.ground = self.all.of_owners(set(range(len(self.bodies))) - doors - rails)
        self.finishes = frozenset(
            k for k, each in enumerate(self.bodies) if each.category == "IfcCovering"
        )
        self.plates = plates_of(self.solids)
        self.runs = runs_of(self.plates)
        self.floors: dict[str, Floor] = {}
        self.used: set[int] = set()
        self.refused: list[Refused] = []
        self._cleared: dict[int, tuple[Array, Array]] = {}

    def _storeys(self) -> Sequence[Mapping[str, Any]]:
        found: Sequence[Mapping[str, Any]] = self.model.facts.get("storeys", ())
        return found

    def _stair(self, body: Body) -> bool:
        """Whether an element is a stair or part of one."""
        return any(each.facts.get("kind") in STAIRS for each in self._family(body))

    def _carries(self, body: Body) -> bool:
        """Whether an element may be stood on: no ramp, lift or escalator, and none of its parts."""
        other = (*MOVING, *(() if body.category == "IfcSlab" else RAMPS))
        if any(each.facts.get("kind") in other for each in self._family(body)):
            return False
        if body.category == "IfcCovering":
            return body.facts.get("type") == "FLOORING"
        return not body.category.startswith(OVERHEAD_OR_BESIDE)

    def building(self) -> Building:
        flights = []
        for run in self.runs:
            owner = self._owner(run)
            flight = self._judged(run, owner)
            if isinstance(flight, Flight):
                flights.append(flight)
                self.used.update(run.steps, () if run.below is None else (run.below,))
            elif flight is not None and self.is_stair[owner]:
                self.refused.append(Refused(owner, frozenset(run.steps), flight))
                self.used.update(run.steps)
        named = named_apart(flights)
        drawn = Drawn(
            bodies=self.bodies,
            plates=self.plates,
            used=frozenset(self.used),
            flights=named,
            refused=self.refused,
            storeys={each.identity: each.name for each in self.storeys},
            unit=self.unit,
            provenance=self.model.provenance,
        )
        return Building(
            storeys=self.storeys,
            floors=self.floors,
            flights=named,
            doors=tuple(doorways_of(self.bodies, self.unit)),
            elements=accounted(drawn),
            provenance=self.model.provenance,
        )

    def _judged(self, run: Run, owner: int) -> Flight | Refusal | None:
        """Flight of a run, or why there is none; None: nobody called it stairs."""
        if math.isnan(run.heading):
            turn = math.degrees(run.turned)
            why = "winders" if len(run.steps) <= 5 and turn < 100 else "curved"
            return Refusal(why, {"turn_deg": turn}, self._of(self.bodies[owner]))
        flight = self._flight(run, owner)
        try:
            if flight is not None:
                flight.estimate.stairs()
        except InputError as error:
            return Refusal("no-sheet", {"reason": str(error)}, self._of(self.bodies[owner]))
        return flight

    def _of(self, body: Body) -> Provenance:
        return replace(self.model.provenance, element=body.identity)

    def _owner(self, run: Run) -> int:
        """Number of the element that most treads of a run belong to."""
        counts = Counter(self.plates[k].owners[0] for k in self._treads(run))
        return counts.most_common(1)[0][0]

    def _flight(self, run: Run, owner: int) -> Flight | None:
        plates = [self.plates[k] for k in run.steps]
        owners = {k for plate in plates for k in plate.owners}
        stair = any(self.is_stair[k] for plate in plates for k in plate.owners)
        if not stair and len(plates) < _FEWEST_UNNAMED:
            return None
        rises = np.diff([each.level for each in plates])
        if not stair and float(np.ptp(rises)) > LIKE_STAIRS:
            return None
        complete, below = run.complete, run.below
        if below is None and len(plates) > 2 and self._storey_at(plates[0].level, FLUSH):
            below, plates = run.steps[0], plates[1:]  # a foot that is flush with the floor
        section = section_of(plates, run.heading, self.solids.of_owners(owners), complete=complete)
        if section is None or np.isnan(section.left).any() or np.isnan(section.right).any():
            return None
        notes: list[str] = []
        path = self._path(section, plates, below, complete, notes)
        around = surroundings_of(path, self.ground, self.obstacles, self.finishes)
        body = self.bodies[owner]
        family = self._family(body)
        stated, drawn = self._as_stated(path, family)
        estimate = FlightEstimate(
            left=self._placed(stated, path.left, path.lane[1]),
            right=self._placed(stated, path.right, path.lane[0]),
            heading=run.heading,
            covariance=np.zeros((len(path.levels), 2) * 2),
            gravity=0.0,
            scale=0.0,
            floor=stated.base,
            drawn_first=drawn[0],
            drawn_last=drawn[1],
            width=around.strip.width,
            headroom=around.headroom,
            clear=around.clear,
            gaps=around.gaps,
            overhang=min(section.overhang, 0.1),
            open_risers=section.open_risers,
            notes=(*notes, *around.notes),
        )
        s0 = float(min(path.left[0], path.right[0]))
        s1 = float(max(path.left[-1], path.right[-1]))
        _, low, high = around.strip
        lane = [(s0, low), (s1, low), (s1, high), (s0, high)]
        foot, head = (path.frame.back(each, (low + high) / 2) for each in (s0, s1))
        return Flight(
            identity=body.identity,
            name=body.name or body.category,
            category=body.category,
            parents=tuple(name for each in family[1:] for name in (each.identity, each.name)),
            elements=self._elements(run, owner),
            storey=self._storey_of(family, float(path.levels[0])),
            estimate=estimate,
            lane=np.array([path.frame.back(*each) for each in lane]) + self.origin[:2],
            lower=self._floor(
                self._plate_at(path, head=False) if below is None else below, path.base, foot
            ),
            upper=self._floor(
                run.steps[-1] if complete else self._plate_at(path, head=True),
                float(path.levels[-1]),
                head,
            ),
        )

    def _path(
        self,
        section: Section,
        plates: Sequence[Plate],
        below: int | None,
        complete: bool,
        notes: list[str],
    ) -> Path:
        """Way from the floor before a flight to that behind it, and what was taken for granted."""
        level = math.nan if below is None else self.plates[below].level
        path = Path(section.frame, section.lane, section.left, section.right, section.levels, level)
        foot_notes: list[str] = []
        path = path.over(self._base(path, foot_notes))
        if not complete:
            path = self._to_the_floor(path, plates, notes)
        notes += foot_notes
        return path

    def _as_stated(self, path: Path, family: Sequence[Body]) -> tuple[Path, tuple[float, float]]:
        """Path whose end risers are as stated, and those that are drawn otherwise [m].

        Where an element states the rise of its steps, and an end riser alone is another, a floor is
        drawn without its finish, or steps without theirs: no drawing says which.
        """
        rises = np.diff(path.levels)
        first, last = math.nan, math.nan
        if len(rises) < 2:
            return path, (first, last)
        real = (float(np.median(rises[:-1])),)
        found = (stated_rise(each.facts.get("stated", {}), real, self.unit) for each in family)
        rise = next((each for each in found if math.isfinite(each)), math.nan)
        base, levels = path.base, path.levels
        if abs(levels[0] - base - rise) > LAST_SPREAD:
            first, base = float(levels[0] - base), float(levels[0]) - rise
        if abs(rises[-1] - rise) > LAST_SPREAD:
            last, levels = float(rises[-1]), np.append(levels[:-1], levels[-2] + rise)
        return replace(path, base=base, levels=levels), (first, last)

    def _elements(self, run: Run, owner: int) -> tuple[str, ...]:
        """GlobalIds of what the treads of a run are drawn as, and of what these are part of."""
        owners = [owner, *(k for number in self._treads(run) for k in self.plates[number].owners)]
        family = (each.identity for k in owners for each in self._family(self.bodies[k]))
        return tuple(dict.fromkeys(family))

    def _treads(self, run: Run) -> tuple[int, ...]:
        """Surfaces of a run without what it leads to."""
        return run.steps[:-1] if run.complete and len(run.steps) > 1 else run.steps

    def _placed(self, path: Path, s: Array, t: float) -> Array:
        plan = np.array([path.frame.back(float(each), t) for each in s])
        return np.column_stack([plan + self.origin[:2], path.levels])

    def _family(self, body: Body) -> list[Body]:
        """An element, what it is part of, and so on up."""
        found = [body]
        while (parent := self.by_id.get(found[-1].parent)) is not None and parent not in found:
            found.append(parent)
        return found

    def _storey_of(self, family: Sequence[Body], level: float) -> str:
        names = {each.identity: each.name for each in self.storeys}
        for each in family:
            if each.facts.get("storey") in names:
                return names[each.facts["storey"]]
        below = [each for each in self.storeys if each.level <= level]
        return below[-1].name if below else ""

    def _storey_at(self, level: float, within: float) -> Storey | None:
        near = [each for each in self.storeys if abs(each.level - level) <= within]
        return min(near, key=lambda one: abs(one.level - level), default=None)

    def _to_the_floor(self, path: Path, plates: Sequence[Plate], notes: list[str]) -> Path:
        """Path up to the floor at its head, which nothing joins to its last tread."""
        last = float(path.levels[-1])
        drawn = floor_behind(path, self.ground)
        if drawn is not None:
            level, (left, right) = drawn
            return path if level == last else path.longer(level, left, right)
        level = self._next_floor(last, [each.depth for each in plates], notes)
        if math.isnan(level):
            return path
        if level == math.inf:
            level = last + float(np.diff(path.levels).mean())
        going = float(np.diff(path.nosings).mean())
        return path.longer(level, path.left[-1] + going, path.right[-1] + going)

    def _next_floor(self, last: float, depths: Sequence[float], notes: list[str]) -> float:
        """Level to which the last riser leads, where no floor is drawn [m].

        NaN: there is no more riser; infinite: it is taken as the others.
        """
        if self._storey_at(last, FLUSH) is not None:
            return math.nan
        low, high = RISES
        above = [each for each in self.storeys if low <= each.level - last <= high]
        if above:
            notes.append(f"its last riser leads to the level of the storey {above[0].name!r}")
            return above[0].level
        if abs(depths[-1] - float(np.median(depths[:-1]))) > UNLIKE:
            notes.append(
                "no floor is drawn at its head: its last tread, of another depth than the "
                "others, is taken for the edge of it"
            )
            return math.nan
        notes.append("no floor is drawn at its head: the last riser is taken as the others")
        return math.inf

    def _base(self, path: Path, notes: list[str]) -> float:
        """Level of the floor before the first riser: as drawn, else of a storey, else a guess."""
        if not math.isnan(path.base):
            return path.base
        first = float(path.levels[0])
        drawn = floor_before(path, self.ground)
        if not math.isnan(drawn):
            return drawn
        low, high = RISES
        floors = [each for each in self.storeys if low <= first - each.level <= high]
        if floors:
            notes.append(f"its first riser begins at the level of the storey {floors[-1].name!r}")
            return floors[-1].level
        notes.append("no floor is drawn at its foot: the first riser is taken as the others")
        return first - float(np.diff(path.levels).mean())

    def _plate_at(self, path: Path, *, head: bool) -> int | None:
        """Number of the surface on which an end of a flight begins; None: none is drawn there."""
        import shapely

        level = float(path.levels[-1]) if head else path.base
        s = path.nosings[-1] + LANDS if head else path.nosings[0] - LANDS
        at = shapely.points(path.frame.back(float(s), path.middle))
        near = [k for k, each in enumerate(self.plates) if abs(each.level - level) <= FLUSH]
        on = [k for k in near if shapely.distance(self.plates[k].shape, at) < LANDS]
        return min(on, key=lambda k: abs(self.plates[k].level - level), default=None)

    def _floor(self, number: int | None, level: float, at: Array) -> str:
        """Key of the floor at an end of a flight; the floor is noted, and what is clear of it."""
        plate = None if number is None else self.plates[number]
        if plate is not None and plate.depth < DEEPEST_TREAD:
            plate = None
        storey = self._storey_at(level, OF_STOREY)
        if storey is not None and plate is not None and not self._is_floor(plate, storey):
            storey = None
        if storey is not None:
            key, name = f"storey:{storey.identity}", storey.name
        elif plate is not None:
            key, name = f"landing:{number}", f"landing at {level:.2f} m"
        else:
            key = f"level:{level:.2f}:{at[0]:.1f}:{at[1]:.1f}"
            name = f"floor at {level:.2f} m"
        known = self.floors.get(key) or Floor(key, name, level, storey.identity if storey else "")
        if plate is not None and number is not None:
            outline, walls = self._clear(number, at)
            known = replace(
                known,
                outlines=(*known.outlines, outline + self.origin[:2]),
                walls=np.vstack([known.walls, walls + np.tile(self.origin[:2], 2)]),
            )
        self.floors[key] = known
        return key

    def _is_floor(self, plate: Plate, storey: Storey) -> bool:
        """Whether a surface near the level of a storey is its floor, not a landing beside it."""
        return abs(plate.level - storey.level) <= FLUSH or not self.is_stair[plate.owners[0]]

    def _clear(self, number: int, at: Array) -> tuple[Array, Array]:
        """What is clear of a surface about a place; of a landing all of it, worked out once."""
        if number in self._cleared:
            return self._cleared[number]
        plate = self.plates[number]
        if max(plate.box) < FARTHEST:
            self._cleared[number] = found = self._clear_about(plate, plate.middle)
            return found
        return self._clear_about(plate, at)

    def _clear_about(self, plate: Plate, at: Array) -> tuple[Array, Array]:
        low, high = at - FARTHEST, at + FARTHEST
        walls = walls_around(self.obstacles, plate.level, low, high)
        shape = free_outline(plate.shape, walls, at[None])
        return Plate(plate.level, shape, plate.owners).corners, walls
