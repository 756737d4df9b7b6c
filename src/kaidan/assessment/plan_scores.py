"""Scores of postures in each phase of a traverse, driven from a start of its own.

So a posture that is good for landing is found although it would never have come so far.
"""

import math
from collections.abc import Hashable, Iterable
from functools import cached_property, lru_cache
from typing import NamedTuple

from kaidan import contact
from kaidan.assessment.plans import GENTLE, cost_of_drop, off
from kaidan.errors import InputError
from kaidan.models import planned
from kaidan.models.findings import ROUNDING as NO_MARGIN
from kaidan.models.gap import most_friction
from kaidan.models.quasi_static import profile_of
from kaidan.modes import Facing, Phase, Verdict
from kaidan.outline import Outline
from kaidan.question import Question
from kaidan.robot import Posture
from kaidan.terrain.profile import Profile
from kaidan.traversal.rating import Gripping, Part, Rated, rate
from kaidan.traversal.rotations import ROCKING

COARSE = 0.04
"""Arclength between poses while searching [m]; events are located anyway."""
ENOUGH = 15.0
"""Margin beyond which more is not better [deg]."""
ROUNDING = 0.05
"""Difference of margins that is none [deg]."""
MANY = 4096
"""Ratings on one terrain beyond which they are forgotten."""
UNRATED = "unrated"
TERRAINS = 16
"""Terrains, with the direction and the acceleration, of which ratings are remembered."""


class Score(NamedTuple):
    """What a drive of one phase lets one hope for; larger is better."""

    rank: int
    """Of the verdict that it comes to at most, with its sign turned; it knows no fall."""
    failing: int
    """Ways in which it fails in the worst case, with its sign turned."""
    margin: float
    """Smallest margin of slope in the worst case, `ENOUGH` at most [deg]."""
    drop: float
    """Largest rotation, with its sign turned [deg]."""
    tipping: float = -90.0
    """Smallest margin of slope against tipping alone, `ENOUGH` at most [deg]."""

    @property
    def value(self) -> float:
        """Margin less what the drop costs [deg]."""
        return self.margin - float(cost_of_drop(-self.drop))

    def does(self, margin: float) -> bool:
        """Whether no other posture has to be tried for such a margin [deg]."""
        goes = self.rank == -Verdict.GO.rank
        return goes and self.margin >= margin and -self.drop <= GENTLE

    @property
    def merit(self) -> tuple[int, int, float]:
        """Order of postures in one phase; larger is better."""
        return self.rank, self.failing, round(self.value, 2)


FAILED = Score(rank=-Verdict.NO_GO.rank, failing=-9, margin=-90.0, drop=-90.0)


@lru_cache(maxsize=TERRAINS)
def rated_on(
    terrain: Hashable,
    down: bool,
    acceleration: float,
    tilts: tuple[float, float],
    belts: Gripping | None = None,
) -> dict[Hashable, Rated | None]:
    """Ratings that are remembered of one terrain, by outline, start and end."""
    return {}


def terrain_key(profile: Profile) -> Hashable:
    """What tells a terrain from others."""
    return profile.points.tobytes(), profile.nosings.tobytes(), profile.roughness


def outline_key(outline: Outline) -> tuple[Hashable, ...]:
    """What tells an underside from others."""
    return outline.parts.tobytes(), outline.kinds.tobytes(), outline.stance, outline.gyration


class Scores:
    """Scores of postures in each phase, one end leading.

    facing, {"nose-first", "tail-first"}: which end leads.
    """

    def __init__(self, question: Question, facing: Facing, belts: Gripping | None = None) -> None:
        self.question, self.facing, self.belts = question, facing, belts
        self.known: dict[tuple[Phase, Posture], Score] = {}
        self._about: dict[Posture, tuple[Posture, Posture, Posture]] = {}
        self._outlines: dict[Posture, Outline | None] = {}
        self._down = question.direction == "down"

    def of(self, phase: Phase, posture: Posture) -> Score:
        """Score of a posture in a phase."""
        if (phase, posture) not in self.known:
            self.work_out([(phase, posture)])
        return self.known[phase, posture]

    def off(self, phase: Phase, posture: Posture) -> Score:
        """Worst score of a posture and those a tolerance off its angles."""
        each = self.about(posture)
        self.work_out((phase, one) for one in each)
        return min((self.of(phase, one) for one in each), key=lambda score: score.merit)

    def about(self, posture: Posture) -> tuple[Posture, Posture, Posture]:
        """A posture and those with all its angles up, or down; a plan is judged at the others."""
        if posture not in self._about:
            both = off(self.question.robot, posture, self.question.tolerance)
            self._about[posture] = posture, both[0], both[-1]
        return self._about[posture]

    def work_out(self, wanted: Iterable[tuple[Phase, Posture]]) -> None:
        """Work out some scores together."""
        drives: list[tuple[tuple[Phase, Posture], Hashable, Part]] = []
        for key in dict.fromkeys(wanted):
            if key in self.known:
                continue
            outline = self._outline(key[1])
            if outline is None:
                self.known[key] = FAILED
                continue
            part = Part(outline, *self.stretch(key[0]))
            way: Hashable = (*outline_key(outline), part.start, part.until)
            before = self._rated.get(way, UNRATED)
            if isinstance(before, str):
                drives.append((key, way, part))
            else:
                self.known[key] = self._score(before)
        if not drives:
            return
        rated = rate(
            self.profile,
            [part for *_, part in drives],
            descending=self._down,
            acceleration=self.question.acceleration,
            tilts=self._allowances,
            step=COARSE,
            belts=self.belts,
        )
        if len(self._rated) > MANY:
            self._rated.clear()
        for (key, way, _), each in zip(drives, rated, strict=True):
            self._rated[way] = each
            self.known[key] = self._score(each)

    def bound(self, phase: Phase) -> float:
        """Margin that no posture exceeds by friction alone, as long as the flat carries [deg]."""
        slope = self._driven.angle
        if phase is not Phase.TRAVERSE or math.isnan(slope):
            return ENOUGH
        return math.degrees(math.atan(self._friction[0]) - abs(slope)) - ROUNDING

    def _outline(self, posture: Posture) -> Outline | None:
        """Underside in a posture, the leading end ahead; None: its centroid is outside."""
        if posture not in self._outlines:
            question = self.question
            try:
                outline = Outline.of(question.robot, posture, question.payload)
            except InputError:
                self._outlines[posture] = None
            else:
                ahead = self.facing == "nose-first"
                self._outlines[posture] = outline if ahead else outline.turned_round()
        return self._outlines[posture]

    @cached_property
    def profile(self) -> Profile:
        """Terrain."""
        return profile_of(self.question)

    @cached_property
    def _driven(self) -> Profile:
        return self.profile.reflected() if self._down else self.profile

    @cached_property
    def phases(self) -> tuple[Phase, ...]:
        """Phases that may have a posture of their own."""
        return tuple(self._starts)

    def stretch(self, phase: Phase) -> tuple[contact.Placement | None, float | None]:
        """Where a phase begins, roughly, and where the centroid ends in it [m]."""
        return self._starts[phase], self._ends[phase]

    @cached_property
    def _starts(self) -> dict[Phase, contact.Placement | None]:
        """Where each phase begins, roughly: the robot settles there in the posture at hand."""
        starts: dict[Phase, contact.Placement | None] = {Phase.ENTER: None}
        nosings = self._driven.nosings
        if len(nosings) == 0:
            return starts
        stops = {
            phase: planned.stop(self.question, self.profile, phase)
            for phase in (Phase.TRAVERSE, Phase.LAND)
        }
        if stops[Phase.LAND] - stops[Phase.TRAVERSE] >= planned.STAND_OFF:
            starts[Phase.TRAVERSE] = contact.Placement(stops[Phase.TRAVERSE], 0.0, 0.0)
        slope = 0.0
        if len(nosings) > 1:
            slope = math.atan2(*(nosings[-1] - nosings[-2])[::-1].tolist())
        starts[Phase.LAND] = contact.Placement(stops[Phase.LAND], 0.0, slope)
        return starts

    @cached_property
    def _ends(self) -> dict[Phase, float | None]:
        """Where the centroid ends in each phase [m]; None: beyond the flight."""
        starts = [None if each is None else each.x for each in self._starts.values()]
        return dict(zip(self._starts, [*starts[1:], None], strict=True))

    @cached_property
    def _friction(self) -> tuple[float, float]:
        low, high = self.question.friction
        return min(low, most_friction(self.question)), high

    @cached_property
    def _allowances(self) -> tuple[float, float]:
        d, M = self.question.allowance_d.high, self.question.allowance_M.high
        return d + M, d

    @cached_property
    def _threshold(self) -> float:
        return self.question.momentum_threshold()

    @cached_property
    def _rated(self) -> dict[Hashable, Rated | None]:
        """What this process rated on the same terrain: friction plays no part but beside belts."""
        return rated_on(
            terrain_key(self.profile),
            self._down,
            self.question.acceleration,
            self._allowances,
            self.belts,
        )

    def _score(self, rated: Rated | None) -> Score:
        """Score of a phase, which is driven to its end or not."""
        if rated is None:
            return FAILED
        low, high = self._friction
        downhill, uphill = self._allowances
        required = math.atan(rated.required_friction)
        slides, slides_at_best = math.atan(low) - required, math.atan(high) - required
        if self.belts is not None:
            slides, slides_at_best = rated.held, rated.held_at_best
        tips = rated.downhill - downhill, rated.uphill - uphill
        rough = (
            min(tips) <= 0,
            rated.rocking > ROCKING,
            rated.impact_speed >= self.question.robot.tolerated_impact,
            rated.belly_touches,
        )
        unsure = slides < NO_MARGIN, rated.spare <= self._threshold
        verdict = Verdict.ROUGH if any(rough) else Verdict.GO
        verdict = Verdict.UNSURE if any(unsure) else verdict
        if slides_at_best < NO_MARGIN:
            verdict = Verdict.NO_GO
        return Score(
            rank=-verdict.rank,
            failing=-sum((*rough, *unsure)),
            margin=min(math.degrees(min(slides, *tips)), ENOUGH),
            drop=-math.degrees(rated.rotation),
            tipping=min(math.degrees(min(tips)), ENOUGH),
        )
