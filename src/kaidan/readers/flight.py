"""A flight as a reader found it: nosings with their doubt.

::

            left            The nosings of a flight are segments, seen on the way up. Along the
       .-----o-----.        heading lies s, up lies z. The (s, z) of the nosings have a covariance:
       |    /     /|        near ones may err alike. What all have in common, the doubt of gravity
    z  |   o     o |        and of scale, stands apart, because it does not average out.
    |  |  /     /  |
    | s '-----o----'
    |/      right
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from kaidan.readers.kinds import Array
from kaidan.readers.regular_flight import ALIKE, RegularFlight, uniform_columns, uniform_flight
from kaidan.terrain.doubt import factor
from kaidan.terrain.gap import Gap
from kaidan.terrain.polyline import frozen
from kaidan.terrain.profile import Profile
from kaidan.terrain.room import Opening
from kaidan.terrain.stairs import MOST_TWISTED, UNSTATED_LANDING, Stairs
from kaidan.terrain.stairs_uncertainty import LARGEST_DOUBT, StairsUncertainty

UNCHECKED = 0.0095 / math.sqrt(12.0)
"""Standard deviation of single steps below which a reader cannot see [m]: evenly within the 9.5 mm
that IBC 1011.5.4 allows between the largest and the smallest of a flight."""
MICROMETRE = 6
"""Digits to which exact lengths are rounded [m]."""
EXACT = 1e-4
"""Standard uncertainty below which a nosing counts as exact [m]: files round to it."""
LAST_SPREAD = 0.02
"""Standard deviation of the last rise about the others [m], where nobody drew it: floors are laid
after the steps. A judgement; ISO 14122-3 lets an end riser differ by 15 %, 27 mm of 180."""
LOWEST_CEILING = 1.2
"""Height above the nosings from which something is a ceiling and no handrail [m]."""
LEAST_HEADROOM = 0.2
"""Headroom below which no sheet states one [m]: no robot is lower."""
CERTAIN = 3.0
"""Standard uncertainties from which something stands out of its doubt."""
_LEVEL = math.tan(math.radians(0.2))
"""Slope across or skew of a nosing below which it is none [1]."""


@dataclass(frozen=True, eq=False)
class FlightEstimate:
    """A straight flight from its lower floor up, in metres, z up."""

    left: Array
    """Left ends of the nosings, seen on the way up, from bottom to top, shape (m, 3)."""
    right: Array
    """Right ends, shape (m, 3)."""
    heading: float
    """Direction of ascent in the plan, from x towards y [rad]."""
    covariance: Array
    """Of s and z of the nosings, what all have in common apart, shape (m, 2, m, 2) [m^2]."""
    gravity: float
    """Standard uncertainty of the tilt of gravity along the heading, common to all [rad]."""
    scale: float
    """Standard uncertainty of the scale, common to all [1]."""
    floor: float = math.nan
    """Level of the floor before the first nosing [m]; NaN: it was not seen."""
    floor_sigma: float = 0.0
    """Standard uncertainty of that level [m]."""
    with_floor: Array | None = None
    """Covariance of s and z of the nosings with that level, shape (m, 2) [m^2]; None: nothing in
    common."""
    ends: bool = True
    """Whether the last nosing is the edge of a landing that was seen."""
    step_spread: float = 0.0
    """Standard deviation of single rises and goings that the reader could not see [m]: those of a
    flight that was fitted as a regular one."""
    roughness: float = 0.0
    """Root mean square distance of what was measured from the steps [m]."""
    width: float = math.nan
    """Clear width [m]; NaN: not seen."""
    headroom: float = math.nan
    """Least height above the line of the nosings [m]; NaN: not seen."""
    clear: tuple[Opening, ...] = ()
    """Clear widths up to heights above the line of the nosings, where they differ."""
    gaps: tuple[Gap, ...] = ()
    """Gaps in it or before or behind it, from its first nosing on."""
    run_up: float = math.nan
    """Length of the floor before the first nosing as far as it was seen [m]; NaN: not seen."""
    run_out: float = math.nan
    """Length of the landing behind the last nosing as far as it was seen [m]; NaN: not seen."""
    room_before: float = math.nan
    """Distance from the first nosing to what stands across the way before it [m]; NaN: nothing was
    seen there."""
    room_behind: float = math.nan
    """The same behind the last nosing [m]."""
    overhang: float = 0.0
    """Overhang of the nosings over the treads below [m]."""
    open_risers: bool = False
    drawn_first: float = math.nan
    """First riser as it is drawn, where the file states another, which counts here [m]; NaN: not
    so."""
    drawn_last: float = math.nan
    """Last riser likewise [m]."""
    notes: tuple[str, ...] = ()
    """What the reader must know, as sentences."""

    def __len__(self) -> int:
        return len(self.left)

    @cached_property
    def middle(self) -> Array:
        """Middles of the nosings, shape (m, 3) [m]."""
        return np.asarray((self.left + self.right) / 2)

    @property
    def base(self) -> float:
        """Level of the floor; where it was not seen, of one that a regular riser leads up from."""
        if self.begins:
            return self.floor
        rises = np.diff(self.middle[:, 2])
        return float(self.middle[0, 2] - (rises.mean() if len(rises) else 0.0))

    @property
    def begins(self) -> bool:
        """Whether the lower floor was seen, so that the first riser is known."""
        return math.isfinite(self.floor)

    def line(self, lateral: float = 0.0) -> Array:
        """(s, z) of the nosings at a distance to the left of the middle, shape (m, 2) [m].

        s counts from the middle of the first nosing, z from `base`.
        """
        across = self.left - self.right
        length = np.maximum(np.hypot(across[:, 0], across[:, 1]), 1e-9)[:, None]
        at = self.middle + across / length * lateral
        ahead = np.array([math.cos(self.heading), math.sin(self.heading)])
        s = (at[:, :2] - self.middle[0, :2]) @ ahead
        return np.column_stack([s, at[:, 2] - self.base])

    @cached_property
    def regular(self) -> RegularFlight:
        """Uniform flight through all nosings but a last one behind a gap; NaN: fewer than two.

        Where chi squared says that steps are not alike, the last one is one of them.
        """
        if len(self) < 2:
            return RegularFlight(*(math.nan,) * 6, 0)
        if self._behind_a_gap:
            measured = self._measured[:-2, :-2]
            return uniform_flight(self.line()[:-1], np.asarray(np.linalg.inv(measured)), measured)
        return uniform_flight(self.line(), self.weights, self._measured)

    @property
    def _behind_a_gap(self) -> bool:
        """Whether a gap lies before the last nosing, so that its going is that gap's too."""
        if len(self) < 3:
            return False
        before, last = (float(each) for each in self.line()[-2:, 0])
        return any(
            gap.end is not None and gap.start is not None and before < gap.start < last
            and gap.end > last - UNCHECKED for gap in self.gaps
        )  # fmt: skip

    @property
    def drawn_rises(self) -> Array:
        """Risers from bottom to top as they were drawn or measured, shape (m,) [m]."""
        found = np.diff(self.line()[:, 1], prepend=0.0)
        for end, drawn in ((0, self.drawn_first), (-1, self.drawn_last)):
            found[end] = drawn if math.isfinite(drawn) else found[end]
        return found

    @property
    def typical_step(self) -> tuple[float, float]:
        """Middle one of the rises between the end risers, and of the goings [m]; NaN: one step."""
        if len(self) < 2:
            return math.nan, math.nan
        going, rise = np.diff(self.line(), axis=0).T
        return float(np.median(rise[:-1] if len(rise) > 1 else rise)), float(np.median(going))

    @property
    def last_rise(self) -> tuple[float, float]:
        """Last rise and its standard uncertainty beside the others [m], of more than two nosings.

        Estimated from what was measured of it and from `LAST_SPREAD` about the others, which are
        taken as regular.
        """
        m = len(self)
        design = np.column_stack([uniform_columns(m), np.eye(2 * m)[-1]])
        weights = np.asarray(np.linalg.inv(self._measured))
        normal = design.T @ weights @ design
        normal[4, 4] += LAST_SPREAD**-2
        found = np.linalg.inv(normal)
        fit = found @ design.T @ weights @ self.line().ravel()
        return float(fit[3] + fit[4]), math.sqrt(found[4, 4])

    @property
    def _measured(self) -> Array:
        """Covariance of what was measured in the order of `full_covariance`, shape (2m, 2m)."""
        least = 1e-14 if self.covariance.any() else EXACT**2
        size = 2 * len(self)
        return np.asarray(self.covariance.reshape(size, size) + least * np.eye(size))

    @property
    def weights(self) -> Array:
        """Inverse of the covariance of nosings about a uniform flight, shape (2m, 2m) [m^-2].

        In the order of `full_covariance`. Beyond what was measured the last one of a flight that
        was not drawn has `LAST_SPREAD`.
        """
        covariance = self._measured
        if not self.is_exact and len(self) > 2:
            covariance[-1, -1] += LAST_SPREAD**2
        return np.asarray(np.linalg.inv(covariance))

    @property
    def is_exact(self) -> bool:
        """Whether it is drawn and not measured, so that nothing of it is in doubt."""
        return not (self.covariance.any() or self.gravity or self.scale or self.step_spread)

    @property
    def sigmas(self) -> Array:
        """Standard uncertainties of s and z of each nosing, shape (m, 2) [m]."""
        return np.asarray(np.sqrt(np.einsum("kiki->ki", self.covariance)))

    @property
    def angle_sigma(self) -> float:
        """Standard uncertainty of the slope, gravity included [rad]."""
        return math.hypot(self.regular.sigmas()[0], self.gravity)

    @property
    def spacing_sigma(self) -> float:
        """Standard uncertainty of the nosing spacing, scale included [m]."""
        return math.hypot(self.regular.sigmas()[1], self.scale * self.regular.spacing)

    def full_covariance(self) -> Array:
        """Covariance of s and z of all nosings, what they have in common included.

        Returns
        -------
        array, shape (2m, 2m)
            In the order s, z of the first nosing, of the second and so on, with the foot of the
            first nosing on the floor as the origin [m^2].
        """
        m, line = len(self), self.line()
        found = self.covariance.reshape(2 * m, 2 * m).copy()
        tilted = np.column_stack([-line[:, 1], line[:, 0]]).ravel() * self.gravity
        scaled = line.ravel() * self.scale
        for common in (tilted, scaled):
            found += np.outer(common, common)
        if self.begins:  # levels count from the floor, and err alike with it
            lifted = np.tile([0.0, 1.0], m)
            alike = np.zeros(2 * m) if self.with_floor is None else self.with_floor.ravel()
            alike = alike - lifted * self.floor_sigma**2 / 2
            found -= np.outer(alike, lifted) + np.outer(lifted, alike)
        own = np.tril(np.ones((m, m))) * self.step_spread
        steps = own @ own.T
        found[0::2, 0::2] += steps - self.step_spread**2  # the first nosing is the origin of s
        found[1::2, 1::2] += steps
        return found

    def doubt_of_a_step(self) -> tuple[float, float]:
        """Standard uncertainty of a single going and of a single rise, root mean square [m]."""
        if len(self) < 2:
            return self.step_spread, self.step_spread
        each = np.einsum("kikj->kij", self.covariance)
        both = np.einsum("kikj->kij", self.covariance[1:, :, :-1])
        pair = (each[1:] + each[:-1] - both - both.swapaxes(1, 2)).mean(axis=0)
        going, rise = np.sqrt(np.diag(pair) + self.step_spread**2).tolist()
        return going, rise

    def _doubt_of_the_ends(self, listed: bool) -> tuple[float, float]:
        """Standard uncertainty of the first and of the last rise [m]; of a list as measured."""
        covariance = self.full_covariance()
        first = math.sqrt(covariance[1, 1]) if self.begins else 0.0
        if not listed:
            return first, self.last_rise[1] if len(self) > 2 else 0.0
        apart = covariance[-1, -1] + covariance[-3, -3] - 2 * covariance[-1, -3]
        return first, math.sqrt(max(apart, 0.0))

    def stairs(
        self,
        name: str = "stairs",
        *,
        lower: float = math.nan,
        upper: float = math.nan,
        leaves: tuple[float, float] = (0.0, 0.0),
    ) -> Stairs:
        """Data sheet: uniform where the steps are all alike as far as can be seen, else their list.

        Parameters
        ----------
        name : str
            What people call it.
        lower, upper : float
            Lengths of the landings [m]; NaN: not seen.
        leaves : (float, float)
            Leaves of doors opposite that open onto the lower and onto the upper one [m].

        Raises
        ------
        InputError
            Steps that no sheet takes.
        """
        line, regular = self.line(), self.regular
        step_going, step_rise = self.doubt_of_a_step()
        if self.is_exact:  # without the rounding of arithmetic
            line = line.round(MICROMETRE)
            regular = replace(
                regular,
                rise=round(regular.rise, MICROMETRE),
                going=round(regular.going, MICROMETRE),
            )
        known = {
            "lower_landing": lower,
            "upper_landing": upper,
            "width": self.width,
            "headroom": max(self.headroom, LEAST_HEADROOM),
        }
        sheet: dict[str, Any] = {
            key: round(v, MICROMETRE) for key, v in known.items() if math.isfinite(v)
        }
        if not regular.alike < ALIKE and not self._behind_a_gap:
            angle, spacing = self.angle_sigma, self.spacing_sigma
            sheet |= {"rise": regular.rise, "going": regular.going, "steps": len(self)}
            sheet |= {"first_rise": float(line[0, 1])} if self.begins else {}
            step_rise = max(self.step_spread, min(step_rise, UNCHECKED))
            step_going = max(self.step_spread, min(step_going, UNCHECKED))
            if not self.is_exact and len(self) > 2:
                sheet["last_rise"] = self.last_rise[0]
        else:
            angle, spacing = self.gravity, self.scale * regular.spacing
            sheet["rises"] = tuple(np.diff(line[:, 1], prepend=0.0).tolist())
            sheet["goings"] = tuple(np.diff(line[:, 0]).tolist())
        if not self.is_exact:
            first, last = self._doubt_of_the_ends("rises" in sheet)
            sheet["uncertainty"] = StairsUncertainty(
                angle=angle,
                nosing_spacing=spacing,
                rise=step_rise,
                going=step_going,
                first_rise=min(first, LARGEST_DOUBT),
                last_rise=min(last, LARGEST_DOUBT),
            )
        opening = zip(("lower_leaf", "upper_leaf"), leaves, strict=True)
        sheet |= {key: leaf for key, leaf in opening if leaf > 0.0}
        drawn = {"first_rise_drawn": self.drawn_first, "last_rise_drawn": self.drawn_last}
        sheet |= {key: round(v, MICROMETRE) for key, v in drawn.items() if math.isfinite(v)}
        seen = {"foot_seen": self.begins, "head_seen": self.ends}
        sheet |= {key: False for key, was in seen.items() if not was}
        sheet |= {"clear": self.clear, "gaps": self.gaps}
        sheet |= self._across()
        return Stairs(
            name=name, nosing_overhang=self.overhang, open_risers=self.open_risers, **sheet
        )

    def _across(self) -> dict[str, tuple[float, ...]]:
        """Slopes across and skews of the nosings, where they stand out of the doubt of their ends.

        The ends are taken to be known as the nosing is, twice its standard uncertainty for half of
        its length; less than 0.2 degrees is none.
        """
        if not 2 <= len(self) <= MOST_TWISTED:
            return {}
        way = self.left - self.right
        along = np.array([math.cos(self.heading), math.sin(self.heading)])
        aside = way[:, :2] @ np.array([-along[1], along[0]])
        if (aside < 0.2).any():
            return {}
        found = {"cross_slopes": way[:, 2] / aside, "skews": way[:, :2] @ along / aside}
        sigmas = self.sigmas
        doubts = {"cross_slopes": 2 * sigmas[:, 1] / aside, "skews": 2 * sigmas[:, 0] / aside}
        return {
            name: tuple(np.arctan(each).tolist())
            for name, each in found.items()
            if (np.abs(each) > np.maximum(_LEVEL, CERTAIN * doubts[name])).any()
        }

    def profile(
        self,
        name: str = "profile",
        *,
        lateral: float = 0.0,
        lower: float = UNSTATED_LANDING,
        upper: float = UNSTATED_LANDING,
    ) -> Profile:
        """Terrain under a line along the heading, with all of its doubt.

        Parameters
        ----------
        name : str
            What people call it.
        lateral : float
            How far to the left of the middle of the nosings, seen on the way up [m].
        lower, upper : float
            Lengths of the landings [m].

        Returns
        -------
        Profile
            Treads are level from nosing to nosing, risers are vertical.
        """
        nosings = self.line(lateral)
        foot = np.column_stack([nosings[:, 0], np.r_[0.0, nosings[:-1, 1]]])
        steps = np.stack([foot, nosings], axis=1).reshape(-1, 2)
        first, last = nosings[0, 0] - lower, nosings[-1, 0] + upper
        points = np.vstack([[first, 0.0], steps, [last, nosings[-1, 1]]])
        covariance = self.full_covariance()
        return Profile(
            points=frozen(points),
            nosings=frozen(nosings),
            edges=frozen(nosings),
            overhangs=self.overhang > 0,
            open_risers=self.open_risers,
            roughness=self.roughness,
            name=name,
            covariance=frozen(covariance) if covariance.any() else None,
        )

    def draws(self, count: int, seed: int = 0) -> Array:
        """Nosings as they may be, shape (count, m, 2): (s, z) from the foot of the first [m]."""
        line, covariance = self.line(), self.full_covariance()
        if not covariance.any():
            return np.tile(line, (count, 1, 1))
        unit = np.random.default_rng(seed).standard_normal((covariance.shape[0], count))
        return line + (factor(covariance) @ unit).T.reshape(count, *line.shape)


def independent(each: Array) -> Array:
    """Covariance of nosings that do not err alike, from that of each, shape (m, 2, 2) [m^2]."""
    m = len(each)
    found = np.zeros((m, 2, m, 2))
    found[np.arange(m), :, np.arange(m), :] = each
    return found
