"""The whole way of a robot as data to be told, drawn and written: poses, moves, phases, grades."""

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.assessment import ACCEPTED
from kaidan.assessment.case import Case
from kaidan.assessment.contact_model import climb_of
from kaidan.assessment.ruling import Ruling, ruling
from kaidan.climb import Climb, Phase
from kaidan.contact.forces import contacts_at, two_contact_forces
from kaidan.errors import InputError
from kaidan.report.fall import Stage, fall_of
from kaidan.report.moves import Move, moves_of

Array = NDArray[np.float64]

MOST_ROWS = 500
"""Most poses in the JSON object."""

_G = 9.80665
_EXIT = {"go": 0, "caution": 0, "no-go": 1, "outside-model": 3}
_COLUMNS = (
    ("way", "m"),
    ("x", "m"),
    ("z", "m"),
    ("inclination", "deg"),
    ("rear_contact_x", "m"),
    ("rear_contact_z", "m"),
    ("front_contact_x", "m"),
    ("front_contact_z", "m"),
    ("required_friction", "1"),
    ("traction_over_weight", "1"),
    ("static_margin_back", "m"),
    ("static_margin_front", "m"),
    ("energy_margin", "mm"),
    ("phase", ""),
)


@dataclass(frozen=True)
class Force:
    """A contact of a pose with the force it carries, per mass of the robot."""

    point: tuple[float, float]
    """[m]"""
    normal: tuple[float, float]
    """Unit vector from the ground into the robot."""
    load: float
    """Normal force over mass [N/kg]; NaN where nothing can hold."""
    traction: float
    """Tangential force over mass, driving ahead positive [N/kg]."""

    @property
    def vector(self) -> tuple[float, float]:
        """Force over mass [N/kg]."""
        (n_x, n_z), load, traction = self.normal, self.load, self.traction
        return load * n_x + traction * n_z, load * n_z - traction * n_x


@dataclass(frozen=True)
class Journey:
    """A case, its traverse and what the contact model says of it."""

    case: Case
    found: Climb
    ruling: Ruling

    @property
    def exit_code(self) -> int:
        """0 go or caution, 1 no-go, 3 outside the model."""
        return _EXIT[self.ruling.verdict]

    @property
    def leading(self) -> str:
        """End of the robot that leads: nose or tail."""
        return "nose" if self.case.facing == "nose-first" else "tail"

    @property
    def trailing(self) -> str:
        """The other end."""
        return "tail" if self.case.facing == "nose-first" else "nose"

    @cached_property
    def moves(self) -> tuple[Move, ...]:
        """Events in order, those that belong together as one."""
        return moves_of(self.found, self.leading)

    @cached_property
    def fall(self) -> tuple[Stage, ...]:
        """Stages of the largest turn over the downhill end; empty if there is none."""
        return fall_of(self.found, self.leading)

    @cached_property
    def phase_of_pose(self) -> NDArray[np.str_]:
        """Phase of each pose."""
        return self.found.phase_of_pose

    @cached_property
    def energy(self) -> Array:
        """Energy margin of each pose against a fall downhill, else to whichever side [mm]."""
        margins = self.found.run.margins
        assert margins is not None
        return 1e3 * margins[:, 10]

    @cached_property
    def friction(self) -> Array:
        """Required friction of each pose [1]; infinite where nothing holds."""
        margins = self.found.run.margins
        assert margins is not None
        return np.where(np.isnan(margins[:, 0]), np.inf, margins[:, 0])

    @cached_property
    def governing_row(self) -> int:
        """Row of the pose that decides."""
        rows = np.arange(len(self.phase_of_pose))
        within = rows[self.phase_of_pose == self.ruling.phase] if self.ruling.phase else rows
        within = within if len(within) else rows
        if self.ruling.governs in ("slip", "friction_unknown", "drive"):
            return int(within[np.argmax(self.friction[within])])
        if not self.found.arrived:
            return int(rows[-1])
        swings = [
            (float(release[9]), float(release[1]))
            for release in self.found.run.releases
            if release[15] == 0.0
        ]
        for _, way in sorted(swings, reverse=True):
            row = self.found.run.row_before(way)
            if self.phase_of_pose[row] == Phase.TRAVERSE.value:
                return row
        return int(within[np.argmin(self.energy[within])])

    def forces_at(self, row: int) -> tuple[Force, ...]:
        """Contacts of a pose, and the forces of the pair that needs the least friction."""
        run, a = self.found.run, self.case.acceleration
        assert run.margins is not None
        pose, margins = run.poses[row], run.margins[row]
        x, z, phi, psi = (float(pose[i]) for i in (1, 2, 3, 14))
        kappa = float(margins[17])
        along = -a if self.found.descending else a
        gravity = math.sqrt(_G**2 + along**2 + 2 * _G * along * math.sin(psi))
        pull = (gravity * kappa / math.hypot(1, kappa), gravity / math.hypot(1, kappa))
        table = np.empty((32, 7))
        many, _ = contacts_at(run.ground, run.body, x, z, phi, 1e-7, table, 0)
        touched = [tuple(float(v) for v in table[k, 1:5]) for k in range(many)]
        pair = [(*pose[6:8], *pose[10:12]), (*pose[8:10], *pose[12:14])]
        pairs = [pair] + [
            sorted((touched[i], touched[j]))
            for i in range(many)
            for j in range(i)
            if (touched[i][0] - x) * (touched[j][0] - x) <= 0
        ]
        solved = [_held_by(one, two, (x, z), pull) for one, two in pairs]
        nearest = int(np.argmin([abs(found[0] - margins[0]) for found in solved]))
        (_, n_1, t_1, n_2, t_2), (one, two) = solved[nearest], pairs[nearest]
        loaded = [
            Force((p[0], p[1]), (p[2], p[3]), float(n), float(t))
            for p, n, t in ((one, n_1, t_1), (two, n_2, t_2))
        ]
        idle = [
            Force((p[0], p[1]), (p[2], p[3]), 0.0, 0.0)
            for p in touched
            if all(math.dist(p[:2], force.point) > 1e-5 for force in loaded)
        ]
        return (*loaded, *idle)

    def thinned(self, most: int = MOST_ROWS) -> NDArray[np.int64]:
        """Rows of at most so many poses: those of events first, the rest evenly."""
        count = len(self.found.run.poses)
        if count <= most:
            return np.arange(count)
        kept = {0, count - 1, self.governing_row}
        for row in self.found.run.events[:, 7]:
            if len(kept) >= most // 2:
                break
            kept.add(int(min(max(row, 0), count - 1)))
        even = np.linspace(0, count - 1, most - len(kept)).round().astype(int)
        return np.array(sorted(kept | set(even.tolist())), dtype=np.int64)

    def as_dict(self) -> dict[str, Any]:
        """All of it for JSON; x leads the way the robot goes, whether up or down."""
        found, told = self.found, self.ruling
        rows, run = self.thinned(), self.found.run
        assert run.margins is not None
        columns = np.column_stack(
            [
                run.poses[rows, 0:3],
                np.degrees(run.poses[rows, 3]),
                run.poses[rows, 6:10],
                run.margins[rows, 0],
                run.margins[rows, 5] / _G,
                run.margins[rows, 6:8],
                self.energy[rows],
            ]
        ).tolist()
        return {
            "robot": self.case.robot.name,
            "stairs": self.case.stairs.name,
            "direction": self.case.direction,
            "facing": self.case.facing,
            "acceleration": self.case.acceleration,
            "verdict": told.verdict,
            "governs": told.governs,
            "reason": told.reason,
            "margin_deg": math.degrees(told.margin),
            "phase": told.phase,
            "step": told.step,
            "status": found.status.name.lower().replace("_", "-"),
            "grades": asdict(told.grades),
            "phases": [asdict(each) for each in told.phases],
            "events": [
                {
                    "phase": each.phase.value,
                    "step": each.step,
                    "what": each.what,
                    "way_m": each.way_m,
                    "x_m": float(event[2]),
                    "z_m": float(event[3]),
                    "inclination_deg": each.inclination_deg,
                    "swing_deg": each.swing_deg,
                    "toppled_with_momentum": each.toppled_with_momentum,
                }
                for each, event in zip(found.happenings, found.events, strict=True)
            ],
            "moves": [move.text for move in self.moves],
            "fall": [asdict(stage) for stage in self.fall],
            "poses": {
                "columns": [{"name": name, "unit": unit} for name, unit in _COLUMNS],
                "rows": [
                    [*row, str(self.phase_of_pose[at])]
                    for row, at in zip(columns, rows, strict=True)
                ],
                "governing_way_m": float(run.s[self.governing_row]),
                "of": len(run.poses),
            },
            "profile": {
                "points_m": found.profile.points,
                "nosings_m": found.profile.nosings,
                "overhangs": found.profile.overhangs,
                "open_risers": found.profile.open_risers,
            },
            "outline": {
                "columns": [
                    {"name": name, "unit": "m"}
                    for name in ("x_1", "z_1", "radius_1", "x_2", "z_2", "radius_2")
                ],
                "parts": found.outline.parts,
                "kinds": [("track", "flipper", "belly")[kind] for kind in found.outline.kinds],
            },
        }


def _held_by(
    one: Sequence[float],
    two: Sequence[float],
    com: tuple[float, float],
    pull: tuple[float, float],
) -> tuple[float, float, float, float, float]:
    """Friction and forces of two contacts given as point and normal."""
    return two_contact_forces(
        one[0], one[1], one[2], one[3], two[0], two[1], two[2], two[3], *com, *pull
    )


def journey(case: Case, *, accept: str = "no-rotation", compiled: bool | None = None) -> Journey:
    """Drive a case's robot over its terrain and judge the way.

    Raises
    ------
    InputError
        An unknown `accept`.
    """
    if accept not in ACCEPTED:
        raise InputError(f"accept = {accept!r} is not known; known: {', '.join(ACCEPTED)}")
    found = climb_of(case, with_energy=True, compiled=compiled)
    return Journey(case, found, ruling(case, found, accept=accept))  # type: ignore[arg-type]
