"""What a building is for robots: its flights, verdicts, turns on landings, and ways to storeys."""

from typing import Any, ClassVar, Literal

from kaidan.answer import Answer, Part
from kaidan.models.landing_figures import TurnFigures
from kaidan.modes import Direction, Facing, Verdict
from kaidan.readers.building import Outcome
from kaidan.terrain.stairs import Stairs

Binding = Literal[
    "stability",
    "friction",
    "width",
    "headroom",
    "turning",
    "landing",
    "gap",
    "doors",
    "drawing",
    "",
]
"""What decides, in a word."""


class StoreyShown(Part):
    """A storey."""

    identity: str
    """GlobalId."""
    name: str
    """Name in the model."""
    level_m: float
    """Height [m]."""


class FlightShown(Part):
    """A straight flight, as it is drawn."""

    identity: str
    """GlobalId; with a number where several flights are one element."""
    name: str
    """Name in the model."""
    storey: str
    """Storey that it belongs to."""
    category: str
    """What the model calls it, such as IfcStairFlight."""
    steps: int
    """Risers, the last one onto the floor included."""
    rise_m: float
    """Mean rise of its regular steps [m]."""
    going_m: float
    """Mean going likewise [m]."""
    first_rise_m: float | None
    """First riser as it is drawn [m]; null: no floor is drawn at its foot."""
    last_rise_m: float
    """Last riser likewise [m]."""
    angle_deg: float
    """Slope of the line through the nosings [deg]."""
    nosing_spacing_m: float
    """Mean distance from nosing to nosing [m]."""
    irregularity_m: float
    """Largest minus smallest rise or going, the larger of the two [m]."""
    width_m: float
    """Clear width [m]."""
    headroom_m: float | None
    """Least height above the nosings [m]; null: nothing is drawn above."""
    overhang_m: float
    """Overhang of the nosings [m]."""
    open_risers: bool
    """Whether a riser is open."""
    lower: str
    """Key of the floor at its foot."""
    upper: str
    """Key of the floor at its head."""
    notes: tuple[str, ...]
    """What was taken for granted, and what the model states otherwise."""
    lane: tuple[tuple[float, float], ...]
    """Corners of the clear lane in the plan, the foot's right one first [m]."""
    nosings: tuple[tuple[float, float, float, float], ...]
    """Ends of each nosing in the plan: x, y of the left one, x, y of the right one [m]."""
    elements: tuple[str, ...]
    """GlobalIds of what its treads are drawn as, and of what these are part of."""
    sheet: Stairs
    """Data sheet with which it is judged."""


class ElementShown(Part):
    """A stair, a flight, a ramp, a lift or an escalator of the file, and what became of it."""

    identity: str
    """GlobalId."""
    name: str
    """Name in the model."""
    category: str
    """What the model calls it, such as IfcTransportElement."""
    kind: str
    """Stair, flight, ramp, ramp flight, lift, escalator, moving walk, transport element; empty: it
    is called none of these, and flights are drawn as it."""
    storey: str
    """Storey that the model puts it into; empty: none."""
    outcome: Outcome
    """What became of it and of its parts."""
    flights: tuple[str, ...]
    """Identities of its flights."""
    reasons: tuple[str, ...]
    """Why what is drawn of itself is not judged; of its parts they say it themselves."""
    notes: tuple[str, ...]
    """What it states otherwise than it is drawn."""


class FloorShown(Part):
    """Where flights begin and end."""

    key: str
    """By which flights name it."""
    name: str
    """The storey's, or that of a landing."""
    level_m: float
    """Height [m]."""
    landing: bool
    """Whether it is a landing and no floor of a storey."""
    outlines: tuple[tuple[tuple[float, float], ...], ...]
    """Clear outlines in the plan, as far as they are drawn [m]."""
    walls: tuple[tuple[float, float, float, float], ...]
    """What stands on it, as segments in the plan [m]."""


class DoorShown(Part):
    """A door at an end of a flight."""

    identity: str
    """GlobalId."""
    name: str
    """Name in the model."""
    floor: str
    """Key of the floor."""
    clear_width_m: float
    """Width less frame and leaf, 100 mm taken for both [m]."""
    height_m: float
    """Of the door [m]."""
    threshold_m: float
    """Sill above the floor [m]."""
    leaf_m: float | None
    """Width of a leaf that opens about a hinge [m]; zero: none does, null: not stated."""
    x: float
    """Middle in the plan [m]."""
    y: float
    """The same [m]."""


class CellShown(Part):
    """Verdict on one robot and one flight."""

    robot: str
    flight: str
    """Identity of the flight."""
    direction: Direction
    facing: Facing
    """Which end leads."""
    flippers: str
    """How they lie, as the option is written; empty for a robot without any."""
    verdict: Verdict
    governs: str
    """Failure mode that decides, or why nothing can be said."""
    binds: Binding
    """The same in a word."""
    reason: str
    """The verdict in one sentence."""
    margin_deg: float | None
    """In the worst case [deg]; null: not known."""
    margin_best_deg: float | None
    """In the best case [deg]."""


class TurnShown(TurnFigures):
    """How one robot gets from one flight to the next on a landing."""

    robot: str
    floor: str
    """Key of the landing."""
    from_flight: str
    """Identity of the flight by which it comes."""
    to_flight: str
    """Identity of the next one."""
    path: tuple[tuple[float, float, float], ...]
    """Poses on the way: x, y [m], heading [rad]."""
    footprint: tuple[float, float, float] | None
    """From the turning centre to front and rear, and width [m]."""


class WayShown(Part):
    """How one robot gets to a storey."""

    robot: str
    storey: str
    """Name of the storey."""
    verdict: Verdict | None
    """Worst of all that lies between; null: no flights lead there."""
    binds: Binding
    """What decides."""
    where: str
    """Name of the flight, landing or door at which it does."""
    reason: str
    """In one sentence."""
    flights: tuple[str, ...]
    """Identities of the flights, in their order."""
    postures: tuple[str, ...]
    """Changes of posture between the flights, as sentences."""


class BuildingAnswer(Answer):
    """Flights of a building, and what robots can do on them."""

    text_module: ClassVar[str] = "kaidan.text.building"

    path: str
    """File."""
    digest: str
    """SHA-256 of it."""
    ifc_schema: str
    """Version of IFC."""
    direction: Direction
    """In which all flights of the table are judged."""
    surface: str | None
    """Surface under the tracks; null: none was stated."""
    start: str
    """Name of the storey from which the ways begin."""
    robots: tuple[str, ...]
    """Robots, the columns of the table."""
    storeys: tuple[StoreyShown, ...]
    """From the lowest up."""
    flights: tuple[FlightShown, ...]
    """Straight flights, the rows of the table."""
    floors: tuple[FloorShown, ...]
    """Floors and landings."""
    cells: tuple[CellShown, ...]
    """Row by row."""
    turns: tuple[TurnShown, ...]
    """On each landing, for each robot."""
    doors: tuple[DoorShown, ...]
    """Doors at the ends of flights."""
    ways: tuple[WayShown, ...]
    """To each storey, for each robot."""
    elements: tuple[ElementShown, ...]
    """Every stair, flight, ramp, lift and escalator, and what became of it."""
    notes: tuple[str, ...]
    """What had to be repaired in the file."""

    def columns(self) -> dict[str, list[Any]]:
        """Columns of a table with one line for each robot on each flight.

        Elements that are not judged, or not all of them, follow with a line for each: name, storey,
        outcome and reason.
        """
        by_id = {each.identity: each for each in self.flights}
        of_flight = ("name", "storey", "steps", "rise_m", "going_m", "first_rise_m", "last_rise_m",
                     "width_m", "headroom_m")  # fmt: skip
        rows: list[dict[str, Any]] = [
            {name: getattr(one, name) for name in CellShown.model_fields}
            | {name: getattr(by_id[one.flight], name) for name in of_flight}
            | {"elements": " ".join(by_id[one.flight].elements), "outcome": "judged"}
            for one in self.cells
        ]
        rows += [
            {"name": each.name, "storey": each.storey, "elements": each.identity,
             "outcome": each.outcome, "reason": " ".join(each.reasons)}
            for each in self.elements
            if each.outcome != "judged"
        ]  # fmt: skip
        names = (*CellShown.model_fields, *of_flight, "elements", "outcome")
        return {name: [row.get(name) for row in rows] for name in names}

    @property
    def exit_code(self) -> int:
        """That of the storey which the robots reach worst, each by the best way; 3 no flights."""
        best: dict[str, Verdict] = {}
        for way in self.ways:
            if way.verdict is not None:
                best[way.storey] = min(
                    best.get(way.storey, way.verdict), way.verdict, key=lambda one: one.rank
                )
        if not self.flights:
            return Verdict.OUTSIDE_MODEL.exit_code
        return max(best.values(), key=lambda one: one.rank, default=Verdict.GO).exit_code
