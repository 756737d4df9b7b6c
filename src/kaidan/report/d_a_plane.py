"""The d-a plane of a case (the paper's Fig. 7): limits, areas, states, a plan through area E."""

import math
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.assessment.case import Case
from kaidan.assessment.closed_form import judge
from kaidan.assessment.pose import Pose, governing_pose
from kaidan.mechanics.margins import acceleration_bounds
from kaidan.mechanics.plane import Area, area
from kaidan.mechanics.slipping import slip_acceleration_up
from kaidan.mechanics.tipping import a_r0, a_rn
from kaidan.report.area_e_plan import Planned, planned

Array = NDArray[np.float64]

CELLS = 200
"""Cells of the progress in which the curves are told."""


class Region(NamedTuple):
    """Part of an area of the plane: everything between two curves over the progress."""

    area: Area
    d: Array
    low: Array
    """Minus infinity where nothing bounds it."""
    high: Array


class Stay(NamedTuple):
    """Stretch of the progress in which one acceleration lies in one area."""

    area: Area
    start: float
    end: float


class Plane(NamedTuple):
    """The d-a plane; accelerations up the stairs, progress from the uphill end [m, m/s^2]."""

    robot: str
    stairs: str
    surface: str | None
    direction: str
    facing: str
    nose_up: bool
    pose: Pose
    mu_s: tuple[float, float]
    """Smallest and largest static friction; NaN where it is not known."""
    acceleration: float
    """Acceleration asked about."""
    outside: str
    """Why the model does not apply; empty if it does, and all numbers below NaN if it does not."""
    d: Array
    """Progress; state C stands twice, before and after the lowest contact has left."""
    a_r0: Array
    a_rn: Array
    a_r0_safe: Array
    """With theta_d and theta_M taken off on the worst reading."""
    a_rn_safe: Array
    a_S: float
    a_S_high: float
    """With the largest friction."""
    a_slip_down: float
    min_a_r0: float
    max_a_rn: float
    a_max: float
    a_min: float
    """Lower end of the stable band, downhill slip included."""
    d_C: float
    """Progress of state C."""
    plan: Planned | None

    @property
    def p(self) -> float:
        """Nosing spacing [m]."""
        return self.pose.p

    @property
    def limits(self) -> dict[str, float]:
        """What bounds the areas throughout; unknown friction bounds nothing."""
        known = not math.isnan(self.a_S)
        return {
            "a_S": self.a_S if known else math.inf,
            "a_slip_down": self.a_slip_down if known else -math.inf,
            "min_a_r0": self.min_a_r0,
            "max_a_rn": self.max_a_rn,
        }

    def area_at(self, d: float, a: float) -> Area:
        """Area in which a point of the plane lies."""
        pose = self.pose
        k = pose.n if d < self.d_C else pose.n - 1
        at: dict[str, Any] = {"theta_s": pose.theta_s, "C_L": pose.C_L, "C_N": pose.C_N}
        upper, lower = a_r0(s=d + k * pose.p, **at), a_rn(d=d, **at)
        return Area(int(area(a=a, a_r0=upper, a_rn=lower, **self.limits)))

    def stays(self, a: float) -> tuple[Stay, ...]:
        """Areas through which one acceleration goes over the progress."""
        if self.outside:
            return ()
        cuts = {0.0, self.d_C, self.p}
        for curve in (self.a_r0, self.a_rn):
            cuts.update(d for _, d in self._crossings(curve, a))
        edges = sorted(cut for cut in cuts if 0 <= cut <= self.p)
        found: list[Stay] = []
        for start, end in pairwise(edges):
            here = self.area_at((start + end) / 2, a)
            if found and found[-1].area == here:
                found[-1] = Stay(here, found[-1].start, end)
            else:
                found.append(Stay(here, start, end))
        return tuple(found)

    def regions(self) -> tuple[Region, ...]:
        """Areas of the plane as bands between curves, in the order A, B, C, downhill slip, D, E."""
        if self.outside:
            return ()
        at = self.limits
        levels = (at["a_S"], at["a_slip_down"])
        corners = [
            corner
            for curve in (self.a_r0, self.a_rn)
            for level in levels
            for corner in self._crossings(curve, level)
        ]
        after, places = [index + 1 for index, _ in corners], [d for _, d in corners]
        order = np.argsort(places)
        d, r0, rn = (
            np.insert(curve, np.array(after, dtype=int)[order], np.array(values)[order])
            for curve, values in (
                (self.d, places),
                (self.a_r0, [self._between(self.a_r0, *corner) for corner in corners]),
                (self.a_rn, [self._between(self.a_rn, *corner) for corner in corners]),
            )
        )
        slip_up, slip_down = (np.full_like(d, level) for level in levels)
        upper, lower = np.minimum(slip_up, r0), np.maximum(slip_down, rn)
        low, high = max(at["a_slip_down"], self.max_a_rn), min(at["a_S"], self.min_a_r0)
        below = np.minimum(rn, upper)
        parts = [
            (Area.A, slip_up, np.full_like(d, np.inf)),
            (Area.B, upper, slip_up),
            (Area.C, np.full_like(d, -np.inf), below),
            (Area.DOWNHILL_SLIP, below, np.minimum(slip_down, upper)),
        ]
        if low < high:
            parts += [
                (Area.D, np.full_like(d, low), np.full_like(d, high)),
                (Area.E, lower, np.full_like(d, low)),
                (Area.E, np.full_like(d, high), upper),
            ]
        else:
            parts.append((Area.E, lower, upper))
        return tuple(Region(name, d, foot, np.maximum(head, foot)) for name, foot, head in parts)

    def _crossings(self, curve: Array, level: float) -> list[tuple[int, float]]:
        """Where a curve crosses a level: index of the point before, and progress."""
        found = []
        for index in range(len(self.d) - 1):
            (x, y), (left, right) = self.d[index : index + 2], curve[index : index + 2]
            if x < y and (left - level) * (right - level) < 0:
                found.append((index, float(x + (y - x) * (level - left) / (right - left))))
        return found

    def _between(self, curve: Array, index: int, d: float) -> float:
        """Value of a curve between two points of the grid, where it is straight."""
        (x, y), (left, right) = self.d[index : index + 2], curve[index : index + 2]
        return float(left + (right - left) * (d - x) / (y - x))

    def states(self) -> tuple[tuple[str, float, float, int], ...]:
        """States A to D: name, start and end in the progress [m], contacts that carry."""
        if self.outside:
            return ()
        n, d_C = self.pose.n, self.d_C
        first = () if d_C == 0 else (("A", 0.0, 0.0, n + 1), ("B", 0.0, d_C, n + 1))
        return (*first, ("C", d_C, d_C, n), ("D", d_C, self.p, n))

    def as_dict(self) -> dict[str, Any]:
        """Everything, for JSON."""
        pose = self.pose
        band = self.a_min < self.a_max
        return {
            "model": "closed-form",
            "robot": self.robot,
            "stairs": self.stairs,
            "surface": self.surface,
            "direction": self.direction,
            "facing": self.facing,
            "outside": self.outside or None,
            "angle_deg": math.degrees(pose.theta_s),
            "nosing_spacing_m": pose.p,
            "contacts_n": pose.n,
            "flat_length_m": pose.L,
            "com_from_uphill_end_m": pose.C_L,
            "com_height_m": pose.C_N,
            "friction": None if math.isnan(self.mu_s[0]) else list(self.mu_s),
            "acceleration": self.acceleration,
            "a_S": self.a_S,
            "a_slip_down": self.a_slip_down,
            "min_a_r0": self.min_a_r0,
            "max_a_rn": self.max_a_rn,
            "a_max": self.a_max if band else None,
            "a_min": self.a_min if band else None,
            "paper": {"a_max": self.a_max, "a_min": self.max_a_rn},
            "states": [
                {"state": name, "from_m": start, "to_m": end, "contacts": contacts}
                for name, start, end, contacts in self.states()
            ],
            "areas": [
                {"area": stay.area.name, "from_m": stay.start, "to_m": stay.end}
                for stay in self.stays(self.acceleration)
            ],
            "curves": {
                "d_m": self.d,
                "a_r0": self.a_r0,
                "a_rn": self.a_rn,
                "a_r0_safe": self.a_r0_safe,
                "a_rn_safe": self.a_rn_safe,
            },
            "plan": None if self.plan is None else self.plan.as_dict(),
        }


def d_a_plane(case: Case, *, accelerate: bool = False) -> Plane:
    """The d-a plane of a case on its governing step.

    Parameters
    ----------
    case : Case
        The question.
    accelerate : bool
        Whether to plan an acceleration over the position through areas D and E.

    Returns
    -------
    Plane

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Figs. 3 and 7, Eqs. (14)-(18).
    """
    found = judge(case)
    pose = governing_pose(case, found)
    mu = float(found.nominal.mu_low[0, 0]), float(found.nominal.mu_high[0, 0])
    at: dict[str, Any] = {"L": pose.L, "C_L": pose.C_L, "C_N": pose.C_N, "p": pose.p}
    bounds = acceleration_bounds(mu_s=mu[0], theta_s=pose.theta_s, **at)
    d, s, d_C = _progress(pose)
    com = {"C_L": pose.C_L, "C_N": pose.C_N}
    tilt = case.theta_d.high
    inside = math.nan if found.outside else 1.0
    return Plane(
        robot=case.robot.name,
        stairs=case.stairs.name,
        surface=case.surface.name if case.surface else None,
        direction=case.direction,
        facing=case.facing,
        nose_up=case.nose_up,
        pose=pose,
        mu_s=mu,
        acceleration=case.acceleration,
        outside=found.outside,
        d=d,
        a_r0=inside * a_r0(s=s, theta_s=pose.theta_s, **com),
        a_rn=inside * a_rn(d=d, theta_s=pose.theta_s, **com),
        a_r0_safe=inside * a_r0(s=s, theta_s=pose.theta_s + tilt + case.theta_M.high, **com),
        a_rn_safe=inside * a_rn(d=d, theta_s=pose.theta_s - tilt, **com),
        a_S=inside * float(bounds.slip_up),
        a_S_high=inside * float(slip_acceleration_up(mu_s=mu[1], theta_s=pose.theta_s)),
        a_slip_down=inside * float(bounds.slip_down),
        min_a_r0=inside * float(bounds.tip_downhill),
        max_a_rn=inside * float(bounds.tip_uphill),
        a_max=inside * float(bounds.a_max),
        a_min=inside * float(bounds.a_min),
        d_C=d_C,
        plan=planned(case, found) if accelerate else None,
    )


def _progress(pose: Pose) -> tuple[Array, Array, float]:
    """Grid of the progress, the lowest contact behind the uphill end there, and d of state C."""
    d_C = min(max(pose.L - pose.n * pose.p, 0.0), pose.p)
    if d_C < 1e-9 * pose.p:
        d = np.linspace(0.0, pose.p, CELLS + 1)
        return d, d + (pose.n - 1) * pose.p, 0.0
    before = np.linspace(0.0, d_C, max(2, round(CELLS * d_C / pose.p)))
    after = np.linspace(d_C, pose.p, max(2, CELLS - len(before)))
    s = np.concatenate([before + pose.n * pose.p, after + (pose.n - 1) * pose.p])
    return np.concatenate([before, after]), s, d_C
