"""The terrain along the robot's path: a 2-D polyline, faces of risers included.

From any `Stairs`, from several flights with landings between them, or from points that somebody
measured. What overhangs (nosings, scans) is replaced by its upper envelope and flagged: a track
rests on what it meets from above.
"""

import math
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from kaidan.errors import InputError, shown
from kaidan.sheet import Itself
from kaidan.terrain.doubt import (
    covariance_as_stated,
    covariance_of_steps,
    doubt_of_a_step,
    factor,
)
from kaidan.terrain.flights import line_of_flights
from kaidan.terrain.polyline import ROUGHNESS, convex_corners, frozen, measured_line, upper_envelope
from kaidan.terrain.shape import Shape, is_level, shape_of
from kaidan.terrain.stairs import Stairs
from kaidan.terrain.stairs_uncertainty import StairsUncertainty

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Profile:
    """Terrain from the lower to the upper landing; frozen, complete, checked.

    Build it with `of_stairs`, `of_flights` or `of_points`.
    """

    points: Array
    """Upper envelope, shape (n, 2): x ahead (up the stairs), z up [m]; x never decreases."""
    nosings: Array
    """Nosings from bottom to top, shape (m, 2) [m]."""
    edges: Array
    """Upper ends of all steep parts in the order of the points, shape (k, 2) [m]: the nosings, and
    those of parts that fall."""
    overhangs: bool
    """Whether the terrain hung over itself and was replaced by its envelope."""
    open_risers: bool
    """Whether risers are open, so that their faces stand here but carry nothing."""
    roughness: float = 0.0
    """Largest prominence of a bump or dent that makes no nosing [m]."""
    name: str = "profile"
    """What people call it."""
    covariance: Array | None = None
    """Covariance of the places of the nosings, in the order x and z of the first, of the second
    and so on, shape (2m, 2m) [m^2]; None: they are exact."""

    @classmethod
    def of_stairs(cls, stairs: Stairs) -> Self:
        """Profile of a flight with its landings."""
        return cls.of_flights([stairs])

    @classmethod
    def of_flights(cls, flights: Sequence[Stairs]) -> Self:
        """Profile of several straight flights in a row.

        Parameters
        ----------
        flights : sequence of Stairs
            From bottom to top. Between two flights lies the upper landing of the lower one.

        Returns
        -------
        Profile
            The first nosing of the first flight stands at x = 0, its lower landing at z = 0. Doubt
            of single rises and goings becomes its covariance, of several flights that of the angle
            and of the nosing spacing of each too; landings are exact.

        Raises
        ------
        InputError
            No flight, or too many nosings with a doubt of their own, see `kaidan.terrain.doubt`.
        """
        if not flights:
            raise InputError("profile: no flight of stairs was given")
        return cls._of_flights(*map(Itself, flights))

    @classmethod
    @lru_cache(maxsize=64)
    def _of_flights(cls, *themselves: Itself[Stairs]) -> Self:
        """The same, remembered: changed questions have one terrain."""
        flights = [each.sheet for each in themselves]
        points, nosings, edges, covariance = line_of_flights(flights)
        return cls(
            points=points,
            nosings=nosings,
            edges=edges,
            overhangs=any(flight.nosing_overhang > 0 for flight in flights),
            open_risers=any(flight.open_risers for flight in flights),
            covariance=covariance,
        )

    @classmethod
    def of_points(
        cls,
        points: ArrayLike,
        *,
        name: str = "profile",
        sigma: ArrayLike | None = None,
        covariance: ArrayLike | None = None,
    ) -> Self:
        """Profile through measured points.

        Parameters
        ----------
        points : array, shape (n, 2)
            x ahead and z up [m], in order along the surface from the lower to the upper end.
        name : str
            What people call it.
        sigma : array, shape (m, 2) or (2,), optional
            Standard uncertainty of x and of z of each nosing, apart from the others [m].
        covariance : array, shape (2m, 2m), optional
            Instead of it, see `covariance` [m^2].

        Returns
        -------
        Profile
            Nosings are the peaks of ``z - x`` that stand out by more than 15 mm: convex corners
            between a part steeper than 45 degrees and one less steep, wherever points lie on the
            line between them. A vertical riser before a level tread stands out by the smaller of
            its height and the tread's depth. Repeated points are dropped, and a vertical face goes
            up and down within itself no more.

        Raises
        ------
        InputError
            Not (n, 2) finite numbers of metres, fewer than two different points, a line that
            crosses itself, or a doubt that no nosings have.
        """
        from kaidan.contact import without_folds

        envelope, overhangs = upper_envelope(measured_line(points))
        envelope = without_folds(envelope)
        nosings, falling, roughness = convex_corners(envelope)
        return cls(
            points=frozen(envelope),
            nosings=frozen(envelope[nosings]),
            edges=frozen(envelope[np.union1d(nosings, falling)]),
            overhangs=overhangs,
            open_risers=False,
            roughness=roughness,
            name=name,
            covariance=covariance_as_stated(len(nosings), sigma, covariance),
        )

    @classmethod
    def from_dict(cls, table: Mapping[str, Any]) -> Self:
        """Profile that `to_dict` wrote.

        Raises
        ------
        InputError
            A key that is not known, or points that are none.
        """
        extra = set(table) - {"name", "points", "overhangs", "open_risers", "sigma", "covariance"}
        if extra:
            raise InputError(f"profile: {shown(sorted(extra)[0])} is not a known field")
        made = cls.of_points(
            table["points"],
            name=str(table.get("name", "profile")),
            sigma=table.get("sigma"),
            covariance=table.get("covariance"),
        )
        overhangs = made.overhangs or bool(table.get("overhangs", False))
        return replace(made, overhangs=overhangs, open_risers=bool(table.get("open_risers", False)))

    def to_dict(self) -> dict[str, Any]:
        """Name, points and what is known of them, for JSON."""
        table = {
            "name": self.name,
            "points": self.points.tolist(),
            "overhangs": self.overhangs,
            "open_risers": self.open_risers,
        }
        return (
            table if self.covariance is None else table | {"covariance": self.covariance.tolist()}
        )

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: Any) -> Any:
        """As a field of a sheet: itself, or the table of `to_dict`."""
        from kaidan.terrain.table import table_schema

        return table_schema(cls)

    def __eq__(self, other: object) -> bool:
        """Whether both are the same terrain under the same name."""
        if not isinstance(other, Profile):
            return NotImplemented
        return self._alike == other._alike

    def __hash__(self) -> int:
        """Of what makes it equal to another."""
        return hash(self._alike)

    @cached_property
    def _alike(self) -> tuple[Any, ...]:
        """What is the same of equal profiles, which are compared again and again."""
        doubt = np.empty((0, 0)) if self.covariance is None else self.covariance
        tables = (each + 0.0 for each in (self.points, self.nosings, doubt))  # no zero with a minus
        of_tables = tuple((each.shape, each.tobytes()) for each in tables)
        return self.name, self.overhangs, self.open_risers, self.roughness, of_tables

    def as_stairs(self, name: str) -> Stairs | None:
        """Steps as a measured flight; None where the profile has no such steps.

        Their doubt is that of a step in the root mean square.
        """
        x, z = self.nosings.T
        going, rise = doubt_of_a_step(self.covariance)
        try:
            return Stairs(
                name=name,
                rises=tuple(np.diff(z, prepend=self.points[0, 1]).tolist()),
                goings=tuple(np.diff(x).tolist()),
                open_risers=self.open_risers,
                uncertainty=StairsUncertainty(rise=rise, going=going),
            )
        except InputError:
            return None

    @property
    def spacings(self) -> Array:
        """Distances from nosing to nosing [m], one fewer than the nosings."""
        apart = np.diff(self.nosings, axis=0)
        return np.asarray(np.hypot(apart[:, 0], apart[:, 1]))

    @property
    def nosing_spacing(self) -> float:
        """Mean distance from nosing to nosing [m]; NaN with fewer than two."""
        return float(self.spacings.mean()) if len(self.nosings) > 1 else math.nan

    @cached_property
    def angle(self) -> float:
        """Slope of the line fitted to the nosings [rad]; NaN with fewer than two."""
        if len(self.nosings) < 2:
            return math.nan
        x, z = (self.nosings - self.nosings.mean(axis=0)).T
        return math.atan2(float(x @ z), float(x @ x))

    @property
    def irregularity(self) -> float:
        """Largest distance of a nosing from the line fitted to them, across it [m]."""
        if len(self.nosings) < 2:
            return math.nan
        x, z = (self.nosings - self.nosings.mean(axis=0)).T
        return float(np.abs(z * math.cos(self.angle) - x * math.sin(self.angle)).max())

    @property
    def landings(self) -> tuple[float, float]:
        """Lengths before the first nosing and behind the last one [m]; without nosings, of all."""
        first, last = float(self.points[0, 0]), float(self.points[-1, 0])
        if len(self.nosings) == 0:
            return last - first, last - first
        return float(self.nosings[0, 0]) - first, last - float(self.nosings[-1, 0])

    @property
    def rise(self) -> float:
        """Height of the last point above the first [m]; negative: the profile falls."""
        return float(self.points[-1, 1] - self.points[0, 1])

    @cached_property
    def shape(self) -> Shape:
        """What it is from its lower to its upper end: see `kaidan.terrain.shape`."""
        return shape_of(self.points, self.nosings, self.edges)

    @property
    def is_level(self) -> bool:
        """Whether it is a floor without a step."""
        return is_level(self.points, self.edges)

    @property
    def falls(self) -> bool:
        """Whether its nosings lead down towards +x."""
        return len(self.nosings) > 0 and bool(self.nosings[-1, 1] < self.nosings[0, 1])

    def upward(self, *, descending: bool) -> Self:
        """Same terrain from its lower to its upper end, for a robot that goes up or down it.

        A profile that falls from left to right, as somebody measured it on the way down, is seen
        from the other side.

        Parameters
        ----------
        descending : bool
            Whether the robot is to go down.

        Returns
        -------
        Profile

        Raises
        ------
        InputError
            It falls by more than `ROUGHNESS`, and the robot is to go up.
        """
        if self.rise >= -ROUGHNESS:
            return self
        if self.covariance is not None:
            raise InputError(
                "profile: it falls from left to right: give the points, and the doubt of the "
                "nosings, the other way round"
            )
        if not descending:
            raise InputError(
                f"profile: it falls by {-self.rise:.2f} m from left to right: drive it down, or "
                "give the points the other way round"
            )
        turned = type(self).of_points(self.points[::-1] * np.array([-1.0, 1.0]), name=self.name)
        return replace(turned, overhangs=self.overhangs, open_risers=self.open_risers)

    def reflected(self) -> Self:
        """Profile seen from the other side: x reversed."""
        return self._reflected

    @cached_property
    def _reflected(self) -> Self:
        mirror = np.array([-1.0, 1.0])
        doubt = None
        if self.covariance is not None:
            signs = np.tile(mirror, len(self.nosings))
            doubt = self.covariance.reshape(len(self.nosings), 2, len(self.nosings), 2)
            doubt = doubt[::-1, :, ::-1].reshape(len(signs), -1) * signs * signs[:, None]
        return replace(
            self,
            points=frozen(self.points[::-1] * mirror),
            nosings=frozen(self.nosings[::-1] * mirror),
            edges=frozen(self.edges[::-1] * mirror),
            covariance=None if doubt is None else frozen(doubt),
        )

    def with_doubt(self, *, rise: float = 0.0, going: float = 0.0) -> Self:
        """Same terrain, each rise and going in doubt apart from the others, by so much [m]."""
        sigma = np.full((len(self.nosings), 2), (going, rise))
        sigma[:1, 0] = 0.0
        return replace(self, covariance=covariance_of_steps(sigma))

    def drawn_nosings(self, unit: Array) -> Array:
        """Nosings drawn about those here, shape (draws, m, 2) [m].

        Parameters
        ----------
        unit : array, shape (2m, draws)
            Independent standard normals.
        """
        if self.covariance is None:
            return np.asarray(np.broadcast_to(self.nosings, (unit.shape[1], *self.nosings.shape)))
        off = (factor(self.covariance) @ unit).T
        return np.asarray(self.nosings + off.reshape(len(off), *self.nosings.shape))

    def step_of(self, x: float) -> int:
        """Number of the last nosing at or behind x, counted from 1 at the bottom; 0 before it."""
        return bisect_right(self._places, x + 1e-9)

    @cached_property
    def _places(self) -> list[float]:
        """Nosings, along [m]."""
        places: list[float] = self.nosings[:, 0].tolist()
        return places
