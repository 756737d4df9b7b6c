"""Buildings drawn at random in twelve traits, of which every flight and every element is known.

Each is drawn from a seed: handrails, open shells, faces turned, gaps at the head, floors without
their finish, half-turns, two flats side by side, ramps, lifts and escalators, a single step,
winders, property sets of whole stairs. Schema, unit, place, heading and mirroring vary in all.
"""

import math
import random
from dataclasses import dataclass, field

from ifc_cases import House, blocks, box, monolith, wedges

TRAITS = (
    "rails", "shell", "turned", "gap", "finish", "half-turn", "two flats", "ramp", "lift",
    "one step", "winders", "properties",
)  # fmt: skip
SCHEMAS = (("IFC2X3", "m"), ("IFC2X3", "mm"), ("IFC4", "mm"), ("IFC4", "ft"), ("IFC4X3_ADD2", "m"))


@dataclass
class Known:
    """A flight as it was drawn."""

    element: str
    """GlobalId of what it is drawn as."""
    rises: list
    """From bottom to top as they are drawn, from slab to slab [m]."""
    going: float
    width: float
    lower: float
    """Length of the landing at its foot [m]."""
    upper: float
    gap: float = 0.0
    """Between the last tread and the floor at its head [m]."""
    doubted: bool = False
    """Whether a property set states another first or last riser."""
    rails: bool = False

    @property
    def middle(self):
        """Riser between the end ones [m]."""
        return self.rises[1]


@dataclass
class Authored:
    """A building, and what is known of it."""

    house: House
    traits: frozenset
    flights: list = field(default_factory=list)
    elements: dict = field(default_factory=dict)
    """Outcome of every stair, flight, ramp, lift and escalator by GlobalId."""


def authored(seed, traits=None):
    """Building of a seed, with about a third of the traits, or with those given."""
    draw = random.Random(seed)
    schema, unit = draw.choice(SCHEMAS)
    chosen = frozenset(each for each in TRAITS if draw.random() < 0.35)
    return _Drawing(draw, schema, unit, chosen if traits is None else frozenset(traits)).made()


class _Drawing:
    """A building while it is drawn."""

    def __init__(self, draw, schema, unit, traits):
        self.draw, self.traits = draw, traits
        self.count = draw.randint(7 if "half-turn" in traits else 4, 11)
        self.rise = draw.choice([0.15, 0.16, 0.17, 0.175, 0.18, 0.2])
        self.going = draw.choice([0.25, 0.27, 0.29, 0.32])
        self.width = draw.choice([0.7, 0.9, 1.0, 1.2])
        self.finish = draw.choice([0.05, 0.08, 0.1]) if "finish" in traits else 0.0
        self.gap = draw.choice([0.25, 0.3, 0.45]) if "gap" in traits else 0.0
        self.landing = self.width + draw.choice([0.2, 0.5])
        flights = 2 if "half-turn" in traits else 1
        self.height = self.rise * self.count * flights
        self.house = House(schema, unit, ((0.0, "Ground"), (self.height, "First")))
        self.origin = (draw.uniform(-50, 50), draw.uniform(-50, 50))
        self.heading = draw.choice([0.0, 90.0, draw.uniform(0, 360)])
        self.mirrored = draw.random() < 0.5
        self.found = Authored(self.house, traits)

    def made(self):
        ground = [(-40, -40), (40, -40), (40, 40), (-40, 40)]
        self.add("IfcSlab", "ground", [self.house.slab(ground, -self.finish)], storey=0)
        self.stairs("Stair", 0.0)
        if "two flats" in self.traits:
            beside = -(2 * self.width + 1.0)
            self.stairs("Stair", beside)
            wall = box((0, beside + self.width / 2, 0), (3, beside + self.width / 2 + 0.1, 3))
            self.add("IfcWall", "party wall", [self.surface(wall)])
        for trait, drawn in (("ramp", self.ramp), ("lift", self.lift),
                             ("one step", self.one_step), ("winders", self.winders)):  # fmt: skip
            if trait in self.traits:
                drawn()
        return self.found

    def place(self, at=(0, 0, 0), degrees=0.0):
        """Placement of what stands in the frame of the building."""
        (x, y, z), turn = at, math.radians(self.heading)
        y = -y if self.mirrored else y
        return {
            "at": (
                self.origin[0] + x * math.cos(turn) - y * math.sin(turn),
                self.origin[1] + x * math.sin(turn) + y * math.cos(turn),
                z,
            ),
            "degrees": self.heading + (-degrees if self.mirrored else degrees),
        }

    def add(self, kind, name, items=(), at=(0, 0, 0), degrees=0.0, **more):
        made = self.house.add(kind, name, items, **self.place(at, degrees), **more)
        made.Name = None if self.draw.random() < 0.1 else name
        return made

    def surface(self, faces):
        """Faces as one item: mirrored as the building is, some of them or all turned."""
        if self.mirrored:
            faces = [[(x, -y, z) for x, y, z in reversed(each)] for each in faces]
        if "turned" in self.traits:
            share = self.draw.choice([0.3, 1.0])
            faces = [each[::-1] if self.draw.random() < share else each for each in faces]
        if self.house.file.schema != "IFC2X3" and self.draw.random() < 0.5:
            return self.house.triangles(faces)
        return self.house.faces(faces)

    def steps(self):
        """A flight from the origin along x, without its last riser."""
        rises, goings = [self.rise] * self.count, [self.going] * (self.count - 1)
        if "shell" in self.traits:
            return [self.surface(blocks(rises, goings, self.width, shell=True))]
        if "turned" in self.traits or self.draw.random() < 0.5:
            return [self.surface(blocks(rises, goings, self.width))]
        return [monolith(self.house, rises, goings, self.width, last=False)]

    def expect(self, element, outcome="judged"):
        self.found.elements[element.GlobalId] = outcome
        return element

    def stairs(self, name, beside):
        """Stairs with their floors; a half-turn comes back beside its first flight."""
        end, rise_of_one = self.going * (self.count - 1), self.rise * self.count
        whole = self.expect(self.add("IfcStair", name, at=(0, beside, 0)))
        parts = [((0, beside, 0), 0.0)]
        if "half-turn" in self.traits:
            across = self.width + 0.1
            parts.append(((end, beside + across, rise_of_one), 180.0))
            low, high = beside - self.width / 2, beside + across + self.width / 2
            deck = box((end, low, rise_of_one - 0.2), (end + self.landing, high, rise_of_one))
            self.add("IfcSlab", f"{name} landing", [self.surface(deck)], parent=whole)
            floor = box((-5 - self.gap, low - 1, self.height - 0.2 - self.finish),
                        (-self.gap, high + 1, self.height - self.finish))  # fmt: skip
        else:
            floor = box((end + self.gap, beside - 1, self.height - 0.2 - self.finish),
                        (end + self.gap + 5, beside + 1, self.height - self.finish))  # fmt: skip
        self.add("IfcSlab", f"{name} floor", [self.surface(floor)], storey=1)
        for number, (at, degrees) in enumerate(parts):
            flight = self.add("IfcStairFlight", f"{name}{number + 1}", self.steps(), at, degrees,
                              parent=whole)  # fmt: skip
            self.expect(flight)
            self.know(flight, number == 0, number == len(parts) - 1)
            if "rails" in self.traits:
                self.rails(at, degrees)
        if "properties" in self.traits:
            scale = self.house.scale
            self.house.properties(
                whole, "Pset_StairCommon", NumberOfRiser=self.count * len(parts),
                RiserHeight=self.rise * scale, TreadLength=self.going * scale,
            )  # fmt: skip

    def know(self, flight, first, last):
        """A flight as it is drawn: end risers to the slabs, landings of 4 m where floors are."""
        rises = [self.rise] * self.count
        rises[0] += self.finish if first else 0.0
        rises[-1] -= self.finish if last else 0.0
        self.found.flights.append(
            Known(
                flight.GlobalId, rises, self.going, self.width,
                lower=4.0 if first else self.landing, upper=4.0 if last else self.landing,
                gap=self.gap if last else 0.0,
                doubted=bool("properties" in self.traits and self.finish and (first or last)),
                rails="rails" in self.traits,
            )
        )  # fmt: skip

    def rails(self, at, degrees):
        """Handrails of 50 mm, 20 mm inside both edges, 0.9 m above the nosings."""
        run = self.going * (self.count - 2)
        climb = self.rise * (self.count - 2)
        side = [(0, self.rise + 0.85), (run, self.rise + climb + 0.85),
                (run, self.rise + climb + 0.9), (0, self.rise + 0.9)]  # fmt: skip
        for t in (self.width / 2 - 0.02, -self.width / 2 + 0.07):
            self.add("IfcRailing", "rail", [self.house.side(side, 0.05, t)], at, degrees)

    def ramp(self):
        """A ramp of 1:12, as a ramp with a flight, as a slab or as a proxy."""
        kind = self.draw.choice(["IfcRamp", "IfcSlab", "IfcBuildingElementProxy"])
        side = [(0, 0), (6, 0.5), (6, 0.3), (0, -0.2)]
        at, shape = (-15, 10, 0), [self.house.side(side, 1.2)]
        if kind == "IfcRamp":
            whole = self.expect(self.add(kind, "Access", at=at), "refused")
            part = self.add("IfcRampFlight", "Access 1", shape, at, parent=whole)
            self.expect(part, "refused")
            return
        made = self.add(kind, "Ramp", shape, at)
        made.Name = self.draw.choice(["Ramp 1", "Rampe", "access ramp"])
        self.expect(made, "refused")

    def lift(self):
        """A lift and an escalator: by their type, by that of their type, or by their name."""
        new = self.house.file.schema != "IFC2X3"
        for kind, name in (("ELEVATOR", "Aufzug 1"), ("ESCALATOR", "Rolltreppe 1"),
                           ("MOVINGWALKWAY", "Fahrsteig 1")):  # fmt: skip
            how = self.draw.choice(["own", "type", "name", "proxy"])
            shape = [self.surface(blocks([0.2] * 6, [0.4] * 5))]
            if how == "proxy":
                made = self.add("IfcBuildingElementProxy", name, shape, (-20, 20, 0))
                made.Name = name
            else:
                own = {("PredefinedType" if new else "OperationType"): kind} if how == "own" else {}
                made = self.add("IfcTransportElement", name, shape, (-20, 20, 0), **own)
                made.Name = name if how == "name" else "T 1"
            if how == "type":
                of = self.house.root("IfcTransportElementType", Name="t", PredefinedType=kind)
                self.house.root("IfcRelDefinesByType", RelatedObjects=[made], RelatingType=of)
            self.expect(made, "refused")

    def one_step(self):
        step = box((0, 0, -self.finish), (1.2, 1.0, 0.15 - self.finish))
        made = self.add("IfcStair", "step", [self.surface(step)], (15, 15, 0))
        self.expect(made, "refused")

    def winders(self):
        """Two straight flights of three treads and a quarter of winders between, or a spiral."""
        if self.draw.random() < 0.4:
            spiral = self.add("IfcStair", "spiral", wedges(self.house, 12, 25), (20, -20, 0))
            self.expect(spiral, "refused")
            return
        whole = self.expect(self.add("IfcStair", "winding", at=(20, -20, 0)), "judged in part")
        lower = {"rises": [0.18] * 4, "goings": [0.28] * 3, "width": 1.0}
        turn = 0.72
        for name, items, at, degrees in (
            ("w1", [monolith(self.house, **lower)], (20, -20, 0), 0),
            ("w2", self.fan(turn), (21.12, -19.5, 0), 0),
            ("w3", [monolith(self.house, **lower)], (21.62, -19.5, turn + 0.54), 90),
        ):
            part = self.add("IfcStairFlight", name, items, at, degrees, parent=whole)
            self.expect(part, "refused" if name == "w2" else "judged")

    def fan(self, first):
        """Three winders that turn by 90 deg, mirrored as the building is."""
        items = wedges(self.house, 3, 30, inner=0.001, outer=1.0, first=first)
        if not self.mirrored:
            return items
        outlines = []
        for k in range(3):
            a, b = math.radians(30 * k), math.radians(30 * (k + 1))
            outline = [(r * math.sin(v), r * math.cos(v))
                       for r, v in ((0.001, a), (0.001, b), (1.0, b), (1.0, a))]  # fmt: skip
            outlines.append(self.house.slab(outline, first + (k + 1) * 0.18, 0.18))
        return outlines
