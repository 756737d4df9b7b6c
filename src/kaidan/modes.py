"""Vocabularies, each once: verdicts, failure modes, phases, grades, models.

A failure mode is added here, in one line; a model that returns a finding of it is judged, said,
drawn and written as JSON without another change (see CONTRIBUTING).
"""

from dataclasses import dataclass
from enum import StrEnum
from typing import Literal, NamedTuple

Direction = Literal["up", "down"]
Facing = Literal["nose-first", "tail-first"]
PhaseName = Literal["enter", "traverse", "land"]


class Verdict(StrEnum):
    """Answer to "can this robot take these stairs?", the best first."""

    GO = "go"
    """Nothing fails in the worst case."""
    ROUGH = "rough"
    """It arrives in every case known of, but rocks, lands hard or rests on its belly."""
    UNSURE = "unsure"
    """A case of something that is not known fails."""
    NO_GO = "no-go"
    """It fails in the best case too."""
    OUTSIDE_MODEL = "outside-model"
    """The model says nothing."""

    @property
    def rank(self) -> int:
        """Order, 0 the best; also the code of the verdict in arrays."""
        return _RANKS[self]

    @property
    def exit_code(self) -> int:
        """Code with which a command ends: `EXIT_CODES`."""
        return _EXIT_CODES[self]

    @property
    def label(self) -> str:
        """As people read it."""
        return "OUTSIDE THE MODEL" if self is Verdict.OUTSIDE_MODEL else self.value.upper()


_RANKS = {verdict: rank for rank, verdict in enumerate(Verdict)}
_EXIT_CODES = {
    Verdict.GO: 0,
    Verdict.NO_GO: 1,
    Verdict.OUTSIDE_MODEL: 3,
    Verdict.ROUGH: 4,
    Verdict.UNSURE: 5,
}
EXIT_CODES = "0 GO, 1 NO-GO, 2 bad input, 3 outside the model, 4 ROUGH, 5 UNSURE"
"""As help and messages say them; 2 is no verdict."""


class IfFails(NamedTuple):
    """Verdict of a failure mode on its own."""

    best: Verdict
    """Where it fails in the best case, and so in every case."""
    worst: Verdict
    """Where it fails in the worst case only."""
    unknown: Verdict
    """Where its margin is not known."""


FAILS = IfFails(Verdict.NO_GO, Verdict.UNSURE, Verdict.UNSURE)
"""The robot does not arrive."""
FAILS_IF_KNOWN = FAILS._replace(unknown=Verdict.GO)
"""The same, of what sheets often leave out: it counts where it is known."""
ROUGHLY = IfFails(Verdict.ROUGH, Verdict.ROUGH, Verdict.UNSURE)
"""The robot arrives, not smoothly: `FALLS` and the kinetic modes say whether it falls."""
OPEN = IfFails(Verdict.UNSURE, Verdict.UNSURE, Verdict.UNSURE)
"""Nothing tells whether the robot arrives: what is not seen, not measured or not simulated."""


@dataclass(frozen=True)
class FailureMode:
    """A way in which a robot fails on stairs, with a margin that is positive when safe."""

    key: str
    """Name in JSON, tables and code."""
    unit: str
    """Unit of its margin inside: rad of slope, "rad of rotation", m, m/s, N m, or "" where it only
    holds or does not."""
    label: str
    """What happens, as people say it: "tipping over its downhill end"."""
    if_fails: IfFails
    """Verdict where it fails in the best case, in the worst case only, or is not known."""

    @property
    def shown_unit(self) -> str:
        """Unit of its margin as people read it."""
        return _SHOWN[self.unit][0]

    def shown(self, margin: float) -> float:
        """Margin in that unit."""
        return margin * _SHOWN[self.unit][1]


_DEGREE = 57.29577951308232
_SHOWN = {
    "rad": ("deg", _DEGREE),
    "rad of rotation": ("deg", _DEGREE),
    "m": ("mm", 1e3),
    "m/s": ("m/s", 1.0),
    "N m": ("N m", 1.0),
    "": ("", 1.0),
}

FAILURE_MODES: dict[str, FailureMode] = {}
"""All failure modes by key; ties between margins go to the first."""


def failure_mode(key: str, unit: str, label: str, if_fails: IfFails) -> FailureMode:
    """Add a failure mode to the vocabulary.

    Parameters
    ----------
    key : str
        Name in JSON, tables and code.
    unit : {"rad", "rad of rotation", "m", "m/s", "N m", ""}
        Unit of its margin.
    label : str
        What happens, a noun phrase.
    if_fails : IfFails
        Verdict where it fails; a finding may know better.
    """
    mode = FailureMode(key, unit, label, if_fails)
    FAILURE_MODES[key] = mode
    return mode


TIP_DOWNHILL = failure_mode("tip_downhill", "rad", "tipping over its downhill end", ROUGHLY)
"""The paper's falling backward, nose up the stairs."""
TIP_UPHILL = failure_mode("tip_uphill", "rad", "tipping over its uphill end", ROUGHLY)
"""The paper's falling forward."""
TIP_SIDEWAYS = failure_mode("tip_sideways", "rad", "tipping over its side", FAILS)
FALL_DOWNHILL = failure_mode("fall_downhill", "rad", "falling over its downhill end", FAILS)
"""Of a robot that rocks: tilt of gravity to its fall, less the reserve."""
FALL_UPHILL = failure_mode("fall_uphill", "rad", "falling over its uphill end", FAILS)
SLIDES_DOWN = failure_mode("slides_down", "rad", "sliding down for lack of friction", FAILS)
"""The paper's slipping, Eq. (4)."""
SLIDES_UP = failure_mode("slides_up", "rad", "sliding on uphill for lack of friction", FAILS)
GAP_JAM = failure_mode("gap_jam", "rad", "jamming because its track has a gap", OPEN)
"""Driven in MuJoCo such robots jammed with friction to spare."""
DRIVE = failure_mode("drive", "rad", "too little traction of the drive", FAILS_IF_KNOWN)
STUCK = failure_mode("stuck", "rad", "getting stuck", FAILS)
"""Its margin is minus a right angle: no slope of the stairs would do."""
ROTATION = failure_mode(
    "rotation", "rad of rotation", "rotating farther than the path obliges it to", ROUGHLY
)
"""A rotation that the path does not oblige to."""
MOMENTUM = failure_mode("momentum", "m", "toppling with the momentum of a rotation", OPEN)
IMPACT = failure_mode("impact", "m/s", "hitting the ground too fast", ROUGHLY)
"""After a drop that the path obliges to."""
ENERGY = failure_mode("energy", "m", "too little energy margin for its speed", OPEN)
HIGH_CENTRING = failure_mode("high_centring", "", "resting on its belly", ROUGHLY)
POSTURE_CHANGE = failure_mode("posture_change", "", "rotating while its flippers move", OPEN)
"""Between two postures of a plan, the robot standing: nothing tells how far from a fall."""
FLIPPER_TORQUE = failure_mode(
    "flipper_torque", "N m", "too little torque to move its flippers", FAILS
)
POSTURE_TOLERANCE = failure_mode(
    "posture_tolerance", "", "flippers some degrees off their angles", OPEN
)
"""Of a plan that was found: its verdict is worse when it is perturbed."""
GROUSER_SPEED = failure_mode("grouser_speed", "m/s", "driving too fast on grousers", OPEN)
"""Faster, grousers hooked a nosing or spun at a riser in simulations."""
LANDING_ROOM = failure_mode("landing_room", "m", "a landing shorter than the robot", OPEN)
TURNING = failure_mode("turning", "", "too little room to turn on a landing", FAILS)
NARROW = failure_mode("narrow", "m", "a flight narrower than the robot needs", FAILS)
FOOT_UNSEEN = failure_mode("foot_unseen", "", "a first riser that nobody saw", OPEN)
"""Of a scan: the flight may begin lower, or with a higher riser."""
GAP = failure_mode("gap", "m", "an end dropping into a gap", OPEN)
"""A gap that an end of the robot fits into, or behind which nobody found a floor."""
ACROSS = failure_mode("across", "", "one track meeting other ground than the other", OPEN)
"""On a profile that is not built across the path: nobody stated that both meet the same."""
FLOOR_FINISH = failure_mode(
    "floor_finish", "", "an end riser that is drawn and stated otherwise", OPEN
)
"""Of a building model: a floor or the steps may be drawn without their finish."""
LOW = failure_mode("low", "m", "a ceiling lower than the robot needs", FAILS)
TWIST = failure_mode("twist", "rad", "tipping on nosings that differ from left to right", FAILS)
UNWEIGHED = failure_mode("unweighed", "", "a centroid that nobody measured", OPEN)
"""The sheet has a range: no GO before the robot is weighed."""

TIPS = (TIP_DOWNHILL, TIP_UPHILL, TIP_SIDEWAYS)
FALLS = (FALL_DOWNHILL, FALL_UPHILL)
SUPPLIES = (SLIDES_DOWN, SLIDES_UP, DRIVE)
"""Friction and drive: what is supplied against what the stairs require."""

FORMULAS = (TIP_DOWNHILL, TIP_UPHILL, SLIDES_DOWN, SLIDES_UP)
"""Modes of the paper's formulas; arrays of codes count them from 0."""


class Undecided(StrEnum):
    """What governs a verdict and is no failure mode."""

    FRICTION_UNKNOWN = "friction_unknown"
    """Nothing fails, but nobody stated the friction."""
    MARGIN_UNKNOWN = "margin_unknown"
    """Nothing fails, but the model knows no margin."""
    OUTSIDE_MODEL = "outside_model"
    """The model says nothing."""


class Phase(StrEnum):
    """Part of a traverse."""

    ENTER = "enter"
    """From the lower (going down: upper) landing until the trailing end has left it."""
    TRAVERSE = "traverse"
    """On the flight alone."""
    LAND = "land"
    """From the first contact with the other landing until the whole robot stands on it."""


@dataclass(frozen=True)
class Model:
    """A model that answers questions."""

    name: str
    """As a question names it."""
    module: str
    """Module whose function ``judge`` answers; imported when first needed."""
    label: str
    """What it is, as people say it."""


MODELS: dict[str, Model] = {}
"""All models by name, the default first."""


def model(name: str, module: str, label: str) -> Model:
    """Add a model to those that answer questions; see CONTRIBUTING."""
    MODELS[name] = Model(name, module, label)
    return MODELS[name]


CONTACT = model("contact", "kaidan.models.contact_model", "contact model")
CLOSED_FORM = model("closed-form", "kaidan.models.closed_form", "closed form")
SUPPORT_POLYGON = model("support-polygon", "kaidan.models.support_polygon", "support polygon")
PHYSICS = model("physics", "kaidan.models.dynamic", "trial in MuJoCo")
