"""Building models that the tests author themselves, with ifcopenshell; lengths in metres."""

import io
import math
from contextlib import redirect_stdout

import ifcopenshell
import ifcopenshell.guid
import numpy as np

from kaidan.readers.formats import ifc, ifc_child

UNITS = {"m": 1.0, "mm": 1e-3, "ft": 0.3048}


def parsed_here(patch):
    """Let the parser run in this process, which has it already, and not in one of its own."""

    def parsed(source, path):
        said = io.TextIOWrapper(io.BytesIO())
        with redirect_stdout(said):
            ifc_child.main(str(path))
        line, _, rest = said.buffer.getvalue().partition(b"\n")
        return line, rest

    patch.setattr(ifc, "_parsed", parsed)


class House:
    """A model to which storeys and elements are added."""

    def __init__(self, schema="IFC4", unit="mm", storeys=((0.0, "Ground"), (3.0, "First"))):
        self.file = ifcopenshell.file(schema=schema)
        self.scale = 1.0 / UNITS[unit]
        make = self.make
        self.owner = None
        if schema == "IFC2X3":
            person = make(
                "IfcPersonAndOrganization",
                make("IfcPerson", None, "a"),
                make("IfcOrganization", None, "b"),
            )
            tool = make("IfcApplication", person.TheOrganization, "1", "c", "c")
            self.owner = make("IfcOwnerHistory", person, tool, None, "ADDED", None, None, None, 0)
        length = make("IfcSIUnit", None, "LENGTHUNIT", "MILLI" if unit == "mm" else None, "METRE")
        if unit == "ft":
            foot = make(
                "IfcMeasureWithUnit", self.file.create_entity("IfcLengthMeasure", 0.3048), length
            )
            of_length = make("IfcDimensionalExponents", 1, 0, 0, 0, 0, 0, 0)
            length = make("IfcConversionBasedUnit", of_length, "LENGTHUNIT", "FOOT", foot)
        self.context = make(
            "IfcGeometricRepresentationContext", None, "Model", 3, 1e-6, self.axes((0, 0, 0)), None
        )
        self.project = self.root(
            "IfcProject",
            Name="house",
            UnitsInContext=make("IfcUnitAssignment", [length]),
            RepresentationContexts=[self.context],
        )
        self.building = self.root("IfcBuilding", Name="b", ObjectPlacement=self.place())
        self.aggregate(self.project, [self.building])
        self.storeys = [
            self.root(
                "IfcBuildingStorey",
                Name=name,
                Elevation=level * self.scale,
                ObjectPlacement=self.place((0, 0, level)),
            )
            for level, name in storeys
        ]
        self.levels = [level for level, _ in storeys]
        if storeys:
            self.aggregate(self.building, self.storeys)

    def make(self, kind, *values):
        return self.file.create_entity(kind, *values)

    def root(self, kind, **values):
        made = self.file.create_entity(kind, GlobalId=ifcopenshell.guid.new(), **values)
        if self.owner is not None:
            made.OwnerHistory = self.owner
        return made

    def aggregate(self, whole, parts):
        self.root("IfcRelAggregates", RelatingObject=whole, RelatedObjects=parts)

    def point(self, *xyz):
        return self.make("IfcCartesianPoint", [float(each) * self.scale for each in xyz])

    def axes(self, origin, axis=None, ahead=None):
        directions = [
            None if each is None else self.make("IfcDirection", [float(v) for v in each])
            for each in (axis, ahead)
        ]
        return self.make("IfcAxis2Placement3D", self.point(*origin), *directions)

    def place(self, origin=(0, 0, 0), degrees=0.0, within=None):
        ahead = (math.cos(math.radians(degrees)), math.sin(math.radians(degrees)), 0)
        return self.make("IfcLocalPlacement", within, self.axes(origin, (0, 0, 1), ahead))

    def extruded(self, corners, depth, axes, hole=None):
        lines = [
            self.make("IfcPolyline", [self.point(*each) for each in (*ring, ring[0])])
            for ring in (corners, hole)
            if ring is not None
        ]
        kind = "IfcArbitraryClosedProfileDef" if hole is None else "IfcArbitraryProfileDefWithVoids"
        profile = self.make(kind, "AREA", None, lines[0], *([lines[1:]] if hole else []))
        up = self.make("IfcDirection", [0.0, 0.0, 1.0])
        return self.make("IfcExtrudedAreaSolid", profile, axes, up, float(depth) * self.scale)

    def slab(self, corners, top, thickness=0.2, hole=None):
        """Solid of a plan outline below a level."""
        return self.extruded(corners, thickness, self.axes((0, 0, top - thickness)), hole)

    def side(self, corners, width, t=0.0):
        """Solid of a side view (s, z), from t to the right over a width."""
        return self.extruded(corners, width, self.axes((0, t, 0), (0, -1, 0), (1, 0, 0)))

    def faces(self, polygons):
        """Surface of polygons with corners x, y, z, each seen from where its corners turn left."""
        made = []
        for corners in polygons:
            loop = self.make("IfcPolyLoop", [self.point(*each) for each in corners])
            made.append(self.make("IfcFace", [self.make("IfcFaceOuterBound", loop, True)]))
        return self.make("IfcFaceBasedSurfaceModel", [self.make("IfcConnectedFaceSet", made)])

    def triangles(self, polygons):
        """The same as triangles, each polygon with corners of its own; not in IFC2x3."""
        corners = [[float(v) * self.scale for v in each] for face in polygons for each in face]
        index, first = [], 1
        for face in polygons:
            index += [(first, first + k, first + k + 1) for k in range(1, len(face) - 1)]
            first += len(face)
        points = self.make("IfcCartesianPointList3D", corners)
        return self.make("IfcTriangulatedFaceSet", points, None, None, index, None)

    def shape(self, items, kind="SweptSolid"):
        body = self.make("IfcShapeRepresentation", self.context, "Body", kind, list(items))
        return self.make("IfcProductDefinitionShape", None, None, [body])

    def mapped(self, items, mirrored=False):
        """Items by way of a map, mirrored across the ascent."""
        body = self.make("IfcShapeRepresentation", self.context, "Body", "SweptSolid", list(items))
        source = self.make("IfcRepresentationMap", self.axes((0, 0, 0)), body)
        across = self.make("IfcDirection", [0.0, -1.0 if mirrored else 1.0, 0.0])
        operator = self.make(
            "IfcCartesianTransformationOperator3D",
            self.make("IfcDirection", [1.0, 0.0, 0.0]),
            across,
            self.point(0, 0, 0),
            1.0,
            self.make("IfcDirection", [0.0, 0.0, 1.0]),
        )
        item = self.make("IfcMappedItem", source, operator)
        return self.shape([item], "MappedRepresentation")

    def add(
        self,
        kind,
        name,
        items=(),
        *,
        at=(0, 0, 0),
        degrees=0.0,
        storey=0,
        shape=None,
        parent=None,
        **more,
    ):
        if shape is None and items:
            shape = self.shape(items)
        made = self.root(
            kind, Name=name, ObjectPlacement=self.place(at, degrees), Representation=shape, **more
        )
        if parent is not None:
            self.aggregate(parent, [made])
        elif self.storeys:
            self.root(
                "IfcRelContainedInSpatialStructure",
                RelatedElements=[made],
                RelatingStructure=self.storeys[storey],
            )
        return made

    def properties(self, element, name, **values):
        kinds = {int: "IfcCountMeasure", float: "IfcPositiveLengthMeasure"}
        made = [
            self.make(
                "IfcPropertySingleValue",
                key,
                None,
                self.file.create_entity(kinds[type(value)], value),
                None,
            )
            for key, value in values.items()
        ]
        group = self.root("IfcPropertySet", Name=name, HasProperties=made)
        self.root(
            "IfcRelDefinesByProperties", RelatedObjects=[element], RelatingPropertyDefinition=group
        )

    def write(self, path):
        self.file.write(str(path))
        return path


def monolith(house, rises, goings, width=1.0, *, last=True):
    """Flight of one solid from the origin along x; its last tread reaches one going further.

    With `last` False the last riser is left to the slab.
    """
    s, z, top = 0.0, 0.0, []
    goings = [*goings, goings[-1]]
    count = len(rises) if last else len(rises) - 1
    for rise, going in zip(rises[:count], goings, strict=False):
        z += rise
        top += [(s, z), (s + going, z)]
        s += going
    return house.side([(0, 0), *top, (s, z - 0.3), (0.3, -0.0)], width, t=width / 2)


def box(low, high):
    """Faces of a box, seen from without."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    return [
        [(x0, y0, z0), (x0, y1, z0), (x1, y1, z0), (x1, y0, z0)],
        [(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)],
        [(x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)],
        [(x1, y0, z0), (x1, y1, z0), (x1, y1, z1), (x1, y0, z1)],
        [(x1, y1, z0), (x0, y1, z0), (x0, y1, z1), (x1, y1, z1)],
        [(x0, y1, z0), (x0, y0, z0), (x0, y0, z1), (x0, y1, z1)],
    ]


def blocks(rises, goings, width=1.0, *, thick=0.15, shell=False):
    """Faces of treads from the origin along x, the last riser left to the floor: a box for each.

    Of a shell only its top and its riser are drawn.
    """
    found, s, z, half = [], 0.0, 0.0, width / 2
    for rise, going in zip(rises[:-1], goings, strict=True):
        low, z = z, z + rise
        faces = box((s, -half, max(low - thick, 0.0)), (s + going, half, z))
        riser = [(s, half, low), (s, -half, low), (s, -half, z), (s, half, z)]
        found += [faces[1], riser] if shell else faces
        s += going
    return found


def boards(house, rises, goings, width=1.0, overhang=0.03, thickness=0.04):
    """Treads as separate boards, each over the one below by the overhang: open risers."""
    z, s, found = 0.0, 0.0, []
    for rise, going in zip(rises, [*goings, goings[-1]], strict=True):
        z += rise
        outline = [
            (s, -width / 2),
            (s + going + overhang, -width / 2),
            (s + going + overhang, width / 2),
            (s, width / 2),
        ]
        found.append(house.slab(outline, z, thickness))
        s += going
    return found


def wedges(house, count, turn, rise=0.18, inner=0.3, outer=1.3, first=0.0):
    """Treads about a point, each turned by an angle [degrees]: winders or a spiral."""
    found = []
    for k in range(count):
        a, b = math.radians(k * turn), math.radians((k + 1) * turn)
        outline = [
            (r * math.sin(v), -r * math.cos(v))
            for r, v in ((inner, a), (outer, a), (outer, b), (inner, b))
        ]
        found.append(house.slab(outline, first + (k + 1) * rise, rise))
    return found


def regular(n, rise, going):
    return np.full(n, rise), np.full(n - 1, going)


def house_with_a_door(operation="SINGLE_SWING_LEFT", degrees=-90.0, schema="IFC4", away=1.2):
    """A flight of 20 risers of 150 by 300 mm, and a door of 0.9 m before its foot.

    Its leaf opens to the y of its placement: at -90 deg to the flight, at 90 deg away from it.
    """
    h = House(schema)
    h.add("IfcStairFlight", "A", [monolith(h, [0.15] * 20, [0.3] * 19, width=1.0, last=False)])
    for k, level in enumerate((0.0, 3.0)):
        across = ((-3, 0), (5.7, 9))[k]
        floor = [(x, y) for x, y in zip((across[0], across[1]) * 2, (-2, -2, 3, 3), strict=True)]
        floor[2], floor[3] = floor[3], floor[2]
        h.add("IfcSlab", f"floor {k}", [h.slab(floor, level)], storey=k)
    leaf = h.slab([(-0.45, -0.025), (0.45, -0.025), (0.45, 0.025), (-0.45, 0.025)], 2.1, 2.1)
    own = {} if schema == "IFC2X3" else {"OperationType": operation}
    door = h.add("IfcDoor", "D", [leaf], at=(-away, 0, 0), degrees=degrees, OverallWidth=900.0,
                 OverallHeight=2100.0, **own)  # fmt: skip
    if schema == "IFC2X3":
        style = h.root("IfcDoorStyle", Name="s", OperationType=operation,
                       ConstructionType="NOTDEFINED", ParameterTakesPrecedence=False,
                       Sizeable=False)  # fmt: skip
        h.root("IfcRelDefinesByType", RelatedObjects=[door], RelatingType=style)
    return h


def half_turn_house(landing=1.2, *, width=1.0, door=0.9, ceiling=None):
    """Two storeys joined by two flights of ten risers of 150 by 300 mm with a half-turn between.

    A wall stands behind the landing, a door by the foot; a steep flight leads on to the attic.
    """
    h = House(storeys=((0.0, "Ground"), (3.0, "First"), (6.0, "Attic")))
    stair = h.add("IfcStair", "Stair A")
    steps = {"rises": [0.15] * 10, "goings": [0.30] * 9, "width": width, "last": False}
    end, half, across = 9 * 0.30, width / 2, width + 0.2
    h.add("IfcStairFlight", "A1", [monolith(h, **steps)], parent=stair)
    outline = [(0, -half), (landing, -half), (landing, across + half), (0, across + half)]
    h.add("IfcSlab", "landing", [h.slab(outline, 0)], at=(end, 0, 1.5), parent=stair)
    h.add("IfcStairFlight", "A2", [monolith(h, **steps)], at=(end, across, 1.5), degrees=180,
          parent=stair)  # fmt: skip
    for k, level in enumerate((0.0, 3.0, 6.0)):
        far = 6 if k == 0 else 0
        floor = [(-3, -2), (far, -2), (far, 3), (-3, 3)]
        h.add("IfcSlab", f"floor {k}", [h.slab(floor, level)], storey=k)
    back = end + landing
    h.add(
        "IfcWall",
        "back",
        [h.slab([(back, -1), (back + 0.2, -1), (back + 0.2, 3), (back, 3)], 6, 6)],
    )
    h.add("IfcDoor", "D1", [h.slab([(-1.2, -0.5), (-1.15, -0.5), (-1.15, door - 0.5),
                                    (-1.2, door - 0.5)], 2.1, 2.1)],
          OverallWidth=door * h.scale, OverallHeight=2.1 * h.scale)  # fmt: skip
    if ceiling is not None:
        h.add("IfcSlab", "low", [h.slab([(0, -half), (end, -half), (end, half), (0, half)],
                                        1.35 + ceiling + 0.1, 0.1)])  # fmt: skip
    ladder = h.add("IfcStair", "Stair B", at=(-3, 2.2, 3), storey=1)
    h.add("IfcStairFlight", "B", [monolith(h, [0.2] * 15, [0.22] * 14, width=0.55, last=False)],
          at=(-2, 3.0, 3.0), degrees=90, parent=ladder)  # fmt: skip
    return h
