"""The d-a plane (the paper's Fig. 7): limits, areas, states, a plan through area E."""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from kaidan.answer import Answer, Part
from kaidan.errors import InputError
from kaidan.mechanics.margins import AccelerationBounds, acceleration_bounds
from kaidan.mechanics.plane import Area, area
from kaidan.mechanics.slipping import slip_acceleration_up
from kaidan.mechanics.tipping import a_r0, a_rn
from kaidan.models.closed_form import judge
from kaidan.models.closed_form_figures import Basis, Pose
from kaidan.modes import Direction, Facing
from kaidan.question import Question
from kaidan.verbs.acceleration_plan import AccelerationPlan, acceleration_plan

Array = NDArray[np.float64]
Column = tuple[float | None, ...]

CELLS = 200
"""Cells of the progress in which the curves are given."""


class State(Part):
    """A state of the paper's Fig. 3."""

    state: Literal["A", "B", "C", "D"]
    from_m: float
    """Its start in the progress [m]."""
    to_m: float
    """Its end [m]."""
    contacts: int
    """Nosings that carry."""


class Stay(Part):
    """Stretch of the progress in which the requested acceleration lies in one area."""

    area: str
    """A to E, or DOWNHILL_SLIP."""
    from_m: float
    """Its start in the progress [m]."""
    to_m: float
    """Its end [m]."""


class Region(Part):
    """Part of an area of the plane: everything between two curves over the progress."""

    area: str
    """A to E, or DOWNHILL_SLIP."""
    d_m: tuple[float, ...]
    """Progress [m]."""
    low: Column
    """Lower curve [m/s^2]; null where nothing bounds it."""
    high: Column
    """Upper curve [m/s^2]; null where nothing bounds it."""


class Curves(Part):
    """Tip limits over the progress."""

    d_m: tuple[float, ...]
    """Progress [m]; state C stands twice, before and after the lowest contact has left."""
    a_r0: Column
    """Above it the robot tips downhill, Eq. (15) [m/s^2]."""
    a_rn: Column
    """Below it the robot tips uphill, Eq. (16) [m/s^2]."""
    a_r0_safe: Column
    """With theta_d and theta_M subtracted at their high end [m/s^2]."""
    a_rn_safe: Column
    """With theta_d subtracted at its high end [m/s^2]."""


class PaperBand(Part):
    """The paper's own ends of the stable band, Eqs. (17) and (18): no slip at its lower end."""

    a_max: float | None
    """[m/s^2]"""
    a_min: float | None
    """[m/s^2]"""


class Plane(Answer):
    """The d-a plane: accelerations up the stairs, progress from the uphill end; null outside."""

    text_module = "plane"

    model: Literal["closed-form"] = "closed-form"
    robot: str
    stairs: str
    surface: str | None
    direction: Direction
    facing: Facing
    downhill_end: Literal["tail", "nose"]
    """End of the robot that points down the stairs."""
    outside: str | None
    """Why the closed form does not apply; null if it does."""
    angle_deg: float
    """Slope of the governing step [deg]."""
    nosing_spacing_m: float
    """Nosing to nosing on the governing step [m]."""
    contacts_n: int
    """n = floor(L / p)."""
    flat_length_m: float
    """L, flippers in line included [m]."""
    com_from_uphill_end_m: float
    """C_L, from the UPHILL end of the flat [m]."""
    com_height_m: float
    """C_N [m]."""
    friction: tuple[float, float] | None
    """Smallest and largest static friction [1]; null where it is not known."""
    acceleration: float
    """Acceleration requested [m/s^2]."""
    a_S: float | None = None
    """Above it the tracks slip and the robot slides down, Eq. (14), smallest friction [m/s^2]."""
    a_S_high: float | None = None
    """The same with the largest friction [m/s^2]."""
    a_slides_up: float | None = None
    """Below it the tracks slip and the robot slides up, smallest friction [m/s^2]."""
    min_a_r0: float | None = None
    """Smallest a_r0 over the progress [m/s^2]."""
    max_a_rn: float | None = None
    """Largest a_rn over the progress [m/s^2]."""
    a_max: float | None = None
    """Upper end of the stable band [m/s^2]; null if no constant acceleration is stable."""
    a_min: float | None = None
    """Lower end of the stable band, sliding up included [m/s^2]; null likewise."""
    paper: PaperBand | None = None
    """The paper's own ends of the band."""
    states: tuple[State, ...] = ()
    """States A to D of the paper's Fig. 3."""
    areas: tuple[Stay, ...] = ()
    """Areas through which the requested acceleration goes, in order."""
    curves: Curves | None = None
    """Tip limits over the progress."""
    regions: tuple[Region, ...] = ()
    """Areas of the plane as bands between curves."""
    plan: AccelerationPlan | None
    """Plan of the acceleration, if one was requested."""

    @property
    def exit_code(self) -> int:
        """3 outside the model, 1 if a plan is needed and there is none, else 0."""
        if self.outside:
            return 3
        return 0 if self.plan is None or self.plan.found or self.plan.needless else 1


@dataclass(frozen=True)
class Limits:
    """Limits of acceleration on the governing step; progress [m], accelerations [m/s^2]."""

    pose: Pose
    d_C: float
    """Progress of state C."""
    d: Array
    a_r0: Array
    a_rn: Array
    a_S: float
    """Infinite where friction is not known; so is `a_slides_up`."""
    a_slides_up: float
    min_a_r0: float
    max_a_rn: float

    def area_at(self, d: float, a: float) -> Area:
        """Area in which a point of the plane lies."""
        pose = self.pose
        k = pose.n if d < self.d_C else pose.n - 1
        at: dict[str, Any] = {"theta_s": pose.theta_s, "C_L": pose.C_L, "C_N": pose.C_N}
        upper, lower = a_r0(s=d + k * pose.p, **at), a_rn(d=d, **at)
        throughout = {
            "a_S": self.a_S,
            "a_slides_up": self.a_slides_up,
            "min_a_r0": self.min_a_r0,
            "max_a_rn": self.max_a_rn,
        }
        return Area(int(area(a=a, a_r0=upper, a_rn=lower, **throughout)))

    def stays(self, a: float) -> tuple[Stay, ...]:
        """Areas through which one acceleration goes over the progress."""
        cuts = {0.0, self.d_C, self.pose.p}
        for curve in (self.a_r0, self.a_rn):
            cuts.update(d for _, d in self._crossings(curve, a))
        edges = sorted(cut for cut in cuts if 0 <= cut <= self.pose.p)
        found: list[Stay] = []
        for start, end in pairwise(edges):
            here = self.area_at((start + end) / 2, a).name
            if found and found[-1].area == here:
                start = found.pop().from_m
            found.append(Stay(area=here, from_m=start, to_m=end))
        return tuple(found)

    def regions(self) -> tuple[Region, ...]:
        """Areas of the plane as bands between curves, in the order A, B, C, sliding up, D, E."""
        levels = (self.a_S, self.a_slides_up)
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
        slides_down, slides_up = (np.full_like(d, level) for level in levels)
        upper, lower = np.minimum(slides_down, r0), np.maximum(slides_up, rn)
        low, high = max(self.a_slides_up, self.max_a_rn), min(self.a_S, self.min_a_r0)
        below = np.minimum(rn, upper)
        parts = [(Area.B, upper, slides_down), (Area.C, np.full_like(d, -np.inf), below)]
        if math.isfinite(self.a_S):
            parts.insert(0, (Area.A, slides_down, np.full_like(d, np.inf)))
            parts.append((Area.DOWNHILL_SLIP, below, np.minimum(slides_up, upper)))
        if low < high:
            parts += [
                (Area.D, np.full_like(d, low), np.full_like(d, high)),
                (Area.E, lower, np.full_like(d, low)),
                (Area.E, np.full_like(d, high), upper),
            ]
        else:
            parts.append((Area.E, lower, upper))
        return tuple(
            Region(area=name.name, d_m=d.tolist(), low=foot, high=np.maximum(head, foot))
            for name, foot, head in parts
        )

    def states(self) -> tuple[State, ...]:
        """States A to D with the contacts that carry."""
        n, d_C, p = self.pose.n, self.d_C, self.pose.p
        first: list[Any] = [] if d_C == 0 else [("A", 0.0, 0.0, n + 1), ("B", 0.0, d_C, n + 1)]
        return tuple(
            State(state=name, from_m=start, to_m=end, contacts=contacts)
            for name, start, end, contacts in (*first, ("C", d_C, d_C, n), ("D", d_C, p, n))
        )

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


def plane(robot: Any, stairs: Any = None, *, accelerate: bool = False, **manner: Any) -> Plane:
    """The paper's d-a plane: limits of acceleration over the progress.

    Parameters
    ----------
    robot, stairs : object
        As in `kaidan.assess`; the stairs are a regular flight.
    accelerate : bool
        Whether to plan an acceleration over the position through areas D and E.
    **manner
        As in `kaidan.assess`.

    Returns
    -------
    Plane

    Raises
    ------
    InputError
        An input without physical meaning; the text names it.

    Examples
    --------
    >>> from math import radians
    >>> from kaidan import Stairs
    >>> found = plane("kenaf", Stairs.inclined(angle=radians(44), nosing_spacing=0.2), friction=2.0)
    >>> round(found.a_max, 2), [each.area for each in found.areas]
    (0.54, ['D'])

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Figs. 3 and 7, Eqs. (14)-(18).
    """
    return d_a_plane(Question.ask(robot, stairs, **manner), accelerate=accelerate)


def d_a_plane(question: Question, *, accelerate: bool = False) -> Plane:
    """The d-a plane of a question on its governing step; see `plane`."""
    found = judge(question)
    basis: Basis | None = found.basis
    if basis is None:
        raise InputError(f"the d-a plane: {found.outside}")
    pose, mu = Pose.of(basis), question.friction
    answer: dict[str, Any] = {
        "robot": question.robot.name,
        "stairs": question.terrain_name,
        "surface": question.surface.name if question.surface else None,
        "direction": question.direction,
        "facing": question.facing,
        "downhill_end": "tail" if question.nose_up else "nose",
        "outside": found.outside or None,
        "angle_deg": math.degrees(pose.theta_s),
        "nosing_spacing_m": pose.p,
        "contacts_n": pose.n,
        "flat_length_m": pose.L,
        "com_from_uphill_end_m": pose.C_L,
        "com_height_m": pose.C_N,
        "friction": None if math.isnan(mu[0]) else mu,
        "acceleration": question.acceleration,
        "plan": acceleration_plan(question, basis, found.outside) if accelerate else None,
    }
    if found.outside:
        return Plane(**answer)
    limits, bounds = limits_of(pose, mu[0]), _bounds(pose, mu[0])
    a_max, a_min = float(bounds.a_max), float(bounds.a_min)
    return Plane(
        **answer,
        a_S=limits.a_S,
        a_S_high=float(slip_acceleration_up(mu_s=mu[1], theta_s=pose.theta_s)),
        a_slides_up=limits.a_slides_up,
        min_a_r0=limits.min_a_r0,
        max_a_rn=limits.max_a_rn,
        a_max=a_max if a_min < a_max else None,
        a_min=a_min if a_min < a_max else None,
        paper=PaperBand(a_max=a_max, a_min=limits.max_a_rn),
        states=limits.states(),
        areas=limits.stays(question.acceleration),
        curves=_curves(limits, question),
        regions=limits.regions(),
    )


def _bounds(pose: Pose, mu_s: float) -> AccelerationBounds:
    return acceleration_bounds(
        mu_s=mu_s, theta_s=pose.theta_s, L=pose.L, C_L=pose.C_L, C_N=pose.C_N, p=pose.p
    )


def limits_of(pose: Pose, mu_s: float) -> Limits:
    """Limits of acceleration at a pose; without a friction (NaN) no slipping bounds them."""
    bounds = _bounds(pose, mu_s)
    d, s, d_C = _progress(pose)
    at: dict[str, Any] = {"theta_s": pose.theta_s, "C_L": pose.C_L, "C_N": pose.C_N}
    known = not math.isnan(mu_s)
    return Limits(
        pose=pose,
        d_C=d_C,
        d=d,
        a_r0=a_r0(s=s, **at),
        a_rn=a_rn(d=d, **at),
        a_S=float(bounds.slides_down) if known else math.inf,
        a_slides_up=float(bounds.slides_up) if known else -math.inf,
        min_a_r0=float(bounds.tip_downhill),
        max_a_rn=float(bounds.tip_uphill),
    )


def _curves(limits: Limits, question: Question) -> Curves:
    """Tip limits over the progress, also on slopes that the allowances make worse."""
    pose, tilt = limits.pose, question.allowance_d.high
    d, s, _ = _progress(pose)
    com = {"C_L": pose.C_L, "C_N": pose.C_N}
    return Curves(
        d_m=d.tolist(),
        a_r0=limits.a_r0,
        a_rn=limits.a_rn,
        a_r0_safe=a_r0(s=s, theta_s=pose.theta_s + tilt + question.allowance_M.high, **com),
        a_rn_safe=a_rn(d=d, theta_s=pose.theta_s - tilt, **com),
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
