"""Both tracks on a measured flight: a finding beside any model's own.

A model in the plane sees one profile. Where nosings slope across the flight or lie askew, and at a
yaw on steps that differ, the two tracks meet other steps: the robot rolls, and its support is no
rectangle. This judges tipping on what both tracks touch, in space, on the flight alone.
"""

import math
from dataclasses import replace

import numpy as np

from kaidan.mechanics.two_tracks import TwoTrackMargins, track_points, two_track_margins
from kaidan.models.findings import Finding, Findings
from kaidan.models.sentences import two_tracks as text
from kaidan.modes import TWIST, Phase
from kaidan.question import Question
from kaidan.terrain.stairs import MOST_TWISTED, Stairs


def beside(question: Question, found: Findings) -> Findings:
    """Findings of a model with that of both tracks, worst over the flights of the question."""
    flights = question.terrain if isinstance(question.terrain, tuple) else (question.terrain,)
    if question.robot.track.gauge is None:
        return replace(found, notes=(*found.notes, text.NO_GAUGE))
    margins = [
        margins_on(question, flight)
        for flight in flights
        if isinstance(flight, Stairs) and flight.steps <= MOST_TWISTED
    ]
    margins = [each for each in margins if not math.isnan(each.roll)]
    if not margins:
        return replace(found, notes=(*found.notes, text.TOO_SHORT))
    note = text.rolls(max(each.roll for each in margins))
    return replace(
        found, each=(*found.each, _finding(question, margins, found)), notes=(*found.notes, note)
    )


def margins_on(question: Question, flight: Stairs) -> TwoTrackMargins:
    """Margins of a question's robot on the nosings of a flight, without allowances.

    question: its robot must have a gauge.
    """
    gauge, stance = question.robot.track.gauge, question.stance
    assert gauge is not None
    s = np.concatenate([[0.0], np.cumsum(flight.step_goings)])
    z = np.cumsum(flight.step_rises)
    theta = math.atan2(*(float((s - s.mean()) @ each) for each in (z, s)))
    cos, sin = math.cos(theta), math.sin(theta)
    cross, skew = (
        np.tan(np.broadcast_to(np.array(each or (0.0,)), s.shape))
        for each in (flight.cross_slopes, flight.skews)
    )
    plane = {
        "u": cos * s + sin * z,
        "w": cos * z - sin * s,
        "u_across": cos * skew + sin * cross,
        "w_across": cos * cross - sin * skew,
    }
    left, right = (
        track_points(**plane, psi=question.yaw, y=side * gauge / 2) for side in (1.0, -1.0)
    )
    nose_up = question.nose_up
    return two_track_margins(
        left=left,
        right=right,
        gauge=gauge,
        L=stance.flat_length,
        C_L=stance.com_from_front if nose_up else stance.flat_length - stance.com_from_front,
        C_N=stance.com_height,
        theta_s=theta,
        psi=question.yaw,
        a=question.acceleration,
    )


def _finding(question: Question, margins: list[TwoTrackMargins], found: Findings) -> Finding:
    """Least margin over all edges, less the allowances."""
    d, M = question.allowance_d, question.allowance_M
    worst, best = (
        min(min(each.downhill - more, each.uphill, each.sideways) for each in margins) - off
        for off, more in ((d.high, M.high), (d.low, M.low))
    )
    return Finding(
        mode=TWIST,
        worst=np.array([worst]),
        best=np.array([best]),
        phase=Phase.TRAVERSE,
        model=found.model,
    )
