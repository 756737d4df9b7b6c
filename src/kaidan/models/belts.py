"""Belts of a question: what is known of their grousers, as cases of what is given as ranges."""

import math

from kaidan.contact import Grousers
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.rubber import height_lost, rubber_modulus
from kaidan.question import Question
from kaidan.robot import Robot, Track
from kaidan.terrain.stairs import NOSING_RADII, Stairs
from kaidan.traversal import Traverse

HEIGHT = (0.010, 0.020)
"""Height of grousers where the sheet says no more than that there are some [m]."""
SPACING = (0.035, 0.060)
"""Spacing of such grousers [m]."""
TIP_WIDTH = (0.1, 0.3)
"""Width of the tips of such grousers, over their spacing [1]."""
YIELD = (0.0, 0.5)
"""Share of its height that a grouser of unknown hardness loses under load [1]."""
_OF_BELTS = [name for name in Track.model_fields if name == "belt" or name.startswith("grouser_")]


def holds_otherwise(question: Question) -> bool:
    """Whether more than one friction of smooth belts counts, and what grousers hold is known."""
    surface = question.surface
    differs = surface is not None and surface.differs
    return not question.yaw and (question.robot.track.has_grousers or differs)


def grousers_of(question: Question, track: Track, *, best: bool) -> tuple[Grousers, ...]:
    """Grousers of a track in the worst or in the best case.

    In the worst case three must hold: hard and sharp ones, of the narrowest spacing, which reach
    less high over the edge of a riser, and of the widest; and soft ones that lose height under
    load, but share it between all nosings. In the best case they are soft and lose nothing.
    """
    end = 1 if best else 0
    height = HEIGHT[end] if track.grouser_height is None else track.grouser_height
    least, most = _lost(question, track, height)
    low, high = SPACING if track.grouser_spacing is None else (track.grouser_spacing,) * 2
    share = TIP_WIDTH[1 - end]
    radius = nosing_radii(question)[1 - end]

    def one(spacing: float, lost: float, *, rigid: bool) -> Grousers:
        width = share * spacing if track.grouser_tip_width is None else track.grouser_tip_width
        return Grousers(height * (1.0 - lost), spacing, width, radius, rigid)

    if best:
        return (one(low, least, rigid=False),)
    hard = [one(spacing, least, rigid=True) for spacing in dict.fromkeys((low, high))]
    return (*hard, one(high, most, rigid=False))


def nosing_radii(question: Question) -> tuple[float, float]:
    """Smallest and largest radius of the nosings [m]."""
    terrain = question.terrain
    flights = terrain if isinstance(terrain, tuple) else (terrain,)
    each = [one.nosing_radii if isinstance(one, Stairs) else NOSING_RADII for one in flights]
    return min(low for low, _ in each), max(high for _, high in each)


def without_belts(robot: Robot) -> Robot:
    """Robot of whose belts nothing is known."""
    unknown = dict.fromkeys(_OF_BELTS)
    return robot.model_copy(update={"track": robot.track.model_copy(update=unknown)})


def bears(question: Question, track: Track, found: Traverse | None = None) -> bool:
    """Whether the belts have grousers that bear the tractive force, see `strength_margin`."""
    return track.has_grousers and not strength_margin(question, track, found) <= 0.0


def strength_margin(question: Question, track: Track, found: Traverse | None = None) -> float:
    """Strength of a grouser less half of the tractive force [N]; NaN: not known.

    That force is the largest of a traverse; without one it is the weight.
    """
    mass = question.stance.mass
    if track.grouser_strength is None or mass is None:
        return math.nan
    phases = () if found is None else found.phases
    over_weight = max((each.traction_over_weight for each in phases), default=1.0)
    return track.grouser_strength - 0.5 * mass * STANDARD_GRAVITY * over_weight


def _lost(question: Question, track: Track, height: float) -> tuple[float, float]:
    """Share of its height that a grouser loses under load, the least and the most [1].

    Of a known hardness: at most with half the weight across and along it, the other half being the
    other track's.
    """
    mass, width, length = question.stance.mass, track.grouser_tip_width, track.width
    hardness = track.grouser_hardness
    if mass is None or width is None or length is None or hardness is None or height <= 0.0:
        return YIELD
    half = 0.5 * mass * STANDARD_GRAVITY
    modulus = rubber_modulus(S=hardness)
    lost = height_lost(N=half, T=half, h=height, w=width, b=length, E=modulus)
    return 0.0, float(lost) / height
