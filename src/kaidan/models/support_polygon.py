"""Oblique approach: the support polygon of both tracks on a regular flight.

::

        left track     o-------o-------o------     nosings stand gauge tan(psi) farther ahead
                      /                 .
                     / edge downhill     .  edge uphill
                    /                     .
        right track o-------o-------o------

The robot holds without rotation while the zero moment point stays inside the polygon of all
contacts, at every progress. The edge downhill is worst just after a contact is lost, the edge
uphill just before one is made, each on either track: four cases, all in closed form. Over its side
the robot tips about the lower track.
"""

import math
from collections.abc import Callable
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.answer import Part
from kaidan.errors import InputError
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.oblique import body_inclination, oblique_friction
from kaidan.mechanics.oblique_support import (
    edge_energy,
    edge_limit,
    edge_slack,
    other_offset,
    sideways_limit,
)
from kaidan.models.drive_limits import steepest_for_drive
from kaidan.models.findings import Array, Finding, Findings, Later, each_at_risk
from kaidan.models.regular_flight import no_regular_flight
from kaidan.models.samples import Draws, draws, nominal
from kaidan.models.sentences.support_polygon import FLIGHT_ALONE
from kaidan.modes import (
    DRIVE,
    ENERGY,
    FAILS,
    SLIDES_DOWN,
    SLIDES_UP,
    SUPPORT_POLYGON,
    TIP_DOWNHILL,
    TIP_SIDEWAYS,
    TIP_UPHILL,
    IfFails,
    Phase,
)
from kaidan.question import LARGEST_YAW, Question
from kaidan.terrain.stairs import Stairs

SCAN = math.radians(0.25)
"""Step of the search for the yaw at which the verdict changes [rad]."""
_NAME = SUPPORT_POLYGON.name


class SupportPolygonFigures(Part):
    """What the support polygon knows beside the margins."""

    shown_as: ClassVar[str] = "support_polygon"

    yaw_limit_deg: float | None
    """Yaw from which on the robot tips on the flight [deg]; null if it tips without any, or holds
    up to 80 deg."""
    energy_margin_mm: float
    """Smallest rise of the centroid on its way over any edge [mm]."""


def judge(question: Question, *, known: Findings | None = None) -> Findings:
    """Findings of the support polygon on the regular flight of a question, at its yaw.

    Parameters
    ----------
    question : Question
        Its robot must have a gauge. Entering and landing are not judged.
    known : Findings, optional
        Of a similar question; not used.

    Raises
    ------
    InputError
        A robot whose tracks' distance is not known.
    """
    _ = question.robot.weighed
    flight = question.flight
    if flight is None or isinstance(question.terrain, tuple):
        return Findings(model=_NAME, outside="the terrain is no single flight of stairs")
    gauge_of(question)
    outside = no_regular_flight(question, flight)
    if outside:
        return Findings(model=_NAME, outside=outside)
    psi = np.array([question.yaw])
    at = nominal(question, flight)
    needed = float(
        oblique_friction(theta_s=at.theta_s, psi=question.yaw, a=question.acceleration).max()
    )
    mu_low, mu_high = question.friction
    of_friction, of_angle = _supply_samples(question, at)
    angle = math.atan(needed)
    uphill = question.acceleration >= -STANDARD_GRAVITY * math.sin(flight.angle)
    slides = Finding(
        mode=SLIDES_DOWN if uphill else SLIDES_UP,
        worst=np.arctan(np.maximum(mu_low + of_friction, 0.0)) - angle - of_angle,
        best=np.arctan(np.maximum(mu_high + of_friction, 0.0)) - angle - of_angle,
        phase=Phase.TRAVERSE,
        model=_NAME,
    )
    inclination = float(body_inclination(theta_s=at.theta_s, psi=question.yaw).max())
    spare = steepest_for_drive(question, question.acceleration) - inclination - of_angle
    stalls = Finding(mode=DRIVE, worst=spare, best=spare, phase=Phase.TRAVERSE, model=_NAME)
    energy = float(energy_of(question, flight, psi)[0])
    return Findings(
        model=_NAME,
        each=(
            *tips(question, flight, instead=FAILS),
            slides,
            stalls,
            energy_finding(question, energy),
        ),
        required_friction=needed,
        figures=Later(lambda: (figures_of(question, flight, energy),)),
        notes=(FLIGHT_ALONE,),
        basis=flight,
    )


def tips(
    question: Question, flight: Stairs, *, instead: IfFails | None = None
) -> tuple[Finding, ...]:
    """Findings of tipping over the polygon's edges, less the allowances.

    instead: verdicts where nothing tells what happens after the tip.
    """
    bare = margins_of(question, flight, np.array([question.yaw]))[:, 0]
    d, M = question.allowance_d, question.allowance_M
    off = {TIP_DOWNHILL: (d.high + M.high, d.low + M.low)}
    return tuple(
        Finding(
            mode=mode,
            worst=margin - off.get(mode, (d.high, d.low))[0],
            best=margin - off.get(mode, (d.high, d.low))[1],
            instead=instead,
            phase=Phase.TRAVERSE,
            model=_NAME,
        )
        for mode, margin in zip((TIP_DOWNHILL, TIP_UPHILL, TIP_SIDEWAYS), bare, strict=True)
    )


def energy_finding(question: Question, energy: float) -> Finding:
    """Finding of the energy margin [m] against the energy threshold."""
    return Finding.certain(
        ENERGY,
        energy - question.energy_threshold(),
        phase=Phase.TRAVERSE,
        model=_NAME,
    )


def figures_of(question: Question, flight: Stairs, energy: float) -> SupportPolygonFigures:
    """Figures at the yaw of a question."""
    limit = yaw_limit(question, flight)
    return SupportPolygonFigures(
        yaw_limit_deg=None if limit is None else math.degrees(limit),
        energy_margin_mm=1e3 * energy,
    )


def _supply_samples(question: Question, at: Draws) -> tuple[Array, Array]:
    """Differences of friction and of the angle from the sheets' figures, of each sample."""
    block = next(draws(question, at))
    known = np.nan_to_num(block.mu_low - at.mu_low)[:, 0]
    return known, (block.theta_s - at.theta_s[:, : block.theta_s.shape[1]])[:, 0]


def margins_of(question: Question, flight: Stairs, psi: Array, *, certain: bool = False) -> Array:
    """Margins against tipping over the polygon's edges, worst over the flight's steps.

    question: its robot must have a gauge; its own yaw plays no part.
    psi, shape (k,): yaws [rad].
    certain: the sheets' figures only.

    Shape (3, k, samples): downhill, uphill, sideways [rad], without allowances; minus a right angle
    where a track is without any contact at times.
    """
    at = nominal(question, flight)
    if not certain:
        at = next(draws(question, at))  # one flight has few steps: one block
    edges = _edges(at, gauge_of(question), psi)
    return _margins(at, gauge_of(question), edges, question.acceleration)


def _margins(at: Draws, gauge: float, edges: "_Edges", a: float) -> Array:
    yaw = edges.yaw
    kappa = np.cos(yaw) + _END * (edges.left - edges.right) * np.sin(yaw) / gauge
    limit = edge_limit(x=edges.x, kappa=kappa, C_N=at.C_N, a=a)
    margin = _END * (limit - at.theta_s)
    without = np.isnan(margin)
    if without.any():
        slack = _END * edge_slack(x=edges.x, kappa=kappa, C_N=at.C_N, theta_s=at.theta_s, a=a)
        margin = np.where(without, np.copysign(math.pi / 2, slack), margin)
    tips = np.empty((3, *margin.shape[1:]))
    tips[0], tips[1] = np.minimum(margin[0], margin[1]), np.minimum(margin[2], margin[3])
    tips[2] = sideways_limit(gauge=gauge, C_N=at.C_N, psi=yaw) - at.theta_s
    rows = np.where(at.p / np.cos(yaw) > at.L, -math.pi / 2, tips)
    return np.asarray(rows.min(axis=-1))


def energy_of(question: Question, flight: Stairs, psi: Array) -> Array:
    """Smallest rise of the centroid on its way over any edge, the sheets' figures.

    question: its robot must have a gauge; its own yaw plays no part.
    psi, shape (k,): yaws [rad].

    Shape (k,): rise [m].
    """
    at, gauge = nominal(question, flight), gauge_of(question)
    return _energy(at, gauge, _edges(at, gauge, psi), question.acceleration)


def _energy(at: Draws, gauge: float, edges: "_Edges", a: float) -> Array:
    yaw = edges.yaw
    slope = (edges.left - edges.right) / gauge * _END
    over = edge_energy(x=edges.x, slope=slope, C_N=at.C_N, theta_s=at.theta_s, psi=yaw, a=a)
    # over the lower track: its line lies along the heading
    lean = np.sin(at.theta_s) * np.sin(yaw)
    aside = np.hypot(gauge / 2, at.C_N) * np.hypot(lean, np.cos(at.theta_s)) - (
        at.C_N * np.cos(at.theta_s) + gauge / 2 * lean
    )
    return np.asarray(np.minimum(over.min(axis=0), aside).min(axis=(1, 2)))


_END = np.array([1.0, 1.0, -1.0, -1.0])[:, None, None, None]
"""Which end each edge is at: 1 downhill, -1 uphill."""
_SIDES = np.array([1.0, -1.0])[:, None, None, None]
"""Of the yaw, as the left and as the right track have it."""


class _Edges(NamedTuple):
    """Edges at their worst, shape (4, yaws, samples, steps): their ends on both tracks."""

    right: Array
    """From the rear tip downhill, from the front tip uphill [m]."""
    left: Array
    x: Array
    """Their middle downhill of the centroid [m]."""
    yaw: Array
    """Without its sign, shape (yaws, 1, 1) [rad]."""


def _edges(at: Draws, gauge: float, psi: Array) -> _Edges:
    yaw = np.abs(psi)[:, None, None]
    q = at.p / np.cos(yaw)
    near, far = other_offset(p=at.p, psi=_SIDES * yaw, gauge=gauge)
    # downhill just after a loss on the right, on the left; uphill just before a gain on either
    right, left = np.array([q, far, q, near]), np.array([near, q, far, q])
    middle = (left + right) / 2
    x = np.concatenate([at.L - at.C_L - middle[:2], middle[2:] - at.C_L])
    return _Edges(right, left, x, yaw)


def yaw_limit(question: Question, flight: Stairs) -> float | None:
    """Yaw from which the robot tips on the flight, less the allowances, at the chosen risk.

    Yaw [rad]; None if it tips without any, if it holds up to the largest yaw judged, or if the
    robot's gauge is not known. Only the flight is judged, not its ends; the friction that is
    required there does not depend on the yaw.
    """
    if question.robot.track.gauge is None:
        return None
    count = math.floor(LARGEST_YAW / SCAN)
    yaws: Array = SCAN * np.arange(count + 1, dtype=np.float64)
    # each scan narrows the bracket by its number of yaws: in doubt one by one, of many samples each
    pieces, together, scans = (2, 1, 18) if question.uncertain else (64, len(yaws), 3)
    holds = _holding(question, flight)
    first = _first_to_fail(holds, yaws, together)
    if not first:
        return None
    for _ in range(scans):
        low, high = float(yaws[first - 1]), float(yaws[first])
        yaws = low + (high - low) / pieces * np.arange(pieces + 1, dtype=np.float64)
        between = _first_to_fail(holds, yaws[1:-1], pieces)
        first = pieces if between is None else between + 1
    return float(yaws[first - 1])


def _first_to_fail(
    holds: Callable[[Array], NDArray[np.bool_]], psi: Array, together: int
) -> int | None:
    """First of some yaws at which the robot does not hold, so many at once; None: there is none."""
    for begin in range(0, len(psi), together):
        at = holds(psi[begin : begin + together])
        if not at.all():
            return begin + int(np.argmin(at))
    return None


def _holding(question: Question, flight: Stairs) -> Callable[[Array], NDArray[np.bool_]]:
    """Function that says whether the robot holds at each of some yaws."""
    gauge, at, a = gauge_of(question), nominal(question, flight), question.acceleration
    drawn = next(draws(question, at))
    d, M, threshold = question.allowance_d, question.allowance_M, question.energy_threshold()

    def holds(psi: Array) -> NDArray[np.bool_]:
        edges = _edges(at, gauge, psi)
        of_drawn = edges if drawn is at else _edges(drawn, gauge, psi)
        down, up, side = _margins(drawn, gauge, of_drawn, a)
        worst = np.minimum(np.minimum(down - d.high - M.high, up - d.high), side - d.high)
        steady = _energy(at, gauge, edges, a) > threshold
        return np.asarray(steady & (each_at_risk(worst, question.risk) > 0))

    return holds


def gauge_of(question: Question) -> float:
    """Distance between the tracks, without which there is no polygon."""
    gauge = question.robot.track.gauge
    if gauge is None:
        raise InputError(
            f"robot {question.robot.name!r}: track.gauge is not known, and the support "
            "polygon needs the distance between the middles of the tracks"
        )
    return gauge


def along_heading(flight: Stairs, psi: float) -> Stairs:
    """Flight that loads one track, driven straight up, as this one does at a yaw.

    Nosings p / cos(psi) apart on a slope of tan(theta) = tan(theta_s) cos(psi). Its risers are
    cos(theta) / cos(theta_s) times as high as the real ones: entering is judged a little too hard.
    """

    def turned(rise: float, going: float) -> tuple[float, float]:
        slope = math.atan2(rise * math.cos(psi), going)
        spacing = math.hypot(rise, going) / math.cos(psi)
        return spacing * math.sin(slope), spacing * math.cos(slope)

    if flight.rise is not None and flight.going is not None:
        rise, going = turned(flight.rise, flight.going)
        ends = {
            name: None if value is None else value * rise / flight.rise
            for name, value in (("first_rise", flight.first_rise), ("last_rise", flight.last_rise))
        }
        return flight.model_copy(update={"rise": rise, "going": going, **ends})
    steps = [turned(*step) for step in zip(flight.step_rises[1:], flight.step_goings, strict=True)]
    first = flight.step_rises[0] * steps[0][0] / flight.step_rises[1]
    return flight.model_copy(
        update={
            "rises": (first, *(rise for rise, _ in steps)),
            "goings": tuple(going for _, going in steps),
        }
    )
