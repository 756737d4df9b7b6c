"""What the kernel keeps in memory and hands on: each declared once.

A record is a place that holds numbers, a row of a table or a part of one; its fields may be written
to. A named tuple is a value: it is handed on whole and never changes. The C struct, the dtype of
numpy and the plain kernel all follow from these classes.

::

    a point k of the ground                      a part of the robot: hull of two discs

       k+1 o------                                    e = unit vector disc 1 -> disc 2
           | u (unit vector k -> k+1)              .--------------------------.
           | m = left normal of u                 ( c1 . r1 --> e      c2 . r2 )
      -----o k                                     '--------------------------'  flat: the lower
                                                                                 common tangent

    feature = POINT * point + PART * part + kind      kind: VERTEX, DISC_1 or DISC_2
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from kaidan.contact.memory import Row, Table

#: Features: what can touch what.
VERTEX, DISC_1, DISC_2 = range(3)
KIND_MASK = 3
PART, PART_BITS, PART_MASK = 4, 2, 15
POINT, POINT_BITS = 64, 6
NO_FEATURE = -1
#: What a support stands on; its point where no grouser may stand.
NOSING, TREAD, FACE = range(3)
NOWHERE = -1


@dataclass(slots=True)
class Point:
    """A point of the ground, and the segment that begins there."""

    x: float
    z: float
    u_x: float
    """Unit vector to the next point."""
    u_z: float
    length: float
    """Of the segment [m]."""
    convex: bool


@dataclass(slots=True)
class Disc:
    """An end of a part, in the body frame [m]."""

    x: float
    z: float
    r: float


@dataclass(slots=True)
class Part:
    """A part of the robot's underside."""

    one: Disc
    two: Disc
    e_x: float
    """Unit vector from one disc to the other, and how far they lie apart [m]."""
    e_z: float
    axis: float
    sine: float
    """Of the taper."""
    cosine: float
    flat: float
    """Length of the straight underside [m]."""
    side: float
    """Of the axis that looks down, 1 or -1."""
    kind: int
    """A `PartKind`."""


@dataclass(slots=True)
class Touch:
    """A contact that carries a pose: what touches what, where [m], and the normal there.

    The normal is that of the belt as it gives way.
    """

    feature: int
    x: float
    z: float
    n_x: float
    n_z: float


@dataclass(slots=True)
class Pose:
    """A stable pose of a path."""

    s: float
    """Arclength [m]: of the centroid's path, with the inclination times 0.3 m."""
    x: float
    """Centroid, along [m]."""
    z: float
    """Centroid, up [m]."""
    inclination: float
    """Nose up positive [rad]."""
    rear: Touch
    front: Touch
    path_direction: float
    """Of the centroid, above the horizontal [rad]."""
    leg: int
    """Number of the line of poses: it grows by one with every rotation."""
    rear_lean: float
    """Tilt of the rear contact's normal on the rigid outline, ahead positive [rad]."""


@dataclass(slots=True)
class EventRow:
    """Something that happened along a path."""

    kind: int
    """An `Event`."""
    s: float
    x: float
    z: float
    inclination: float
    feature: int
    other: int
    pose: int


@dataclass(slots=True)
class Spot:
    """Where the body is: centroid [m] and inclination [rad]."""

    x: float
    z: float
    inclination: float


@dataclass(slots=True)
class RotationRow:
    """One rotation about contacts: fields as of `kaidan.contact.RotationRecord`."""

    sense: float
    s: float
    pivot: int
    start: Spot
    end: Spot
    angle: float
    rate_before: float
    rate_after: float
    kinetic: float
    barrier: float
    topples_with_momentum: bool
    outcome: int
    pivot_x: float
    pivot_z: float
    barrier_across: float


@dataclass(slots=True)
class Margin:
    """Forces and margins of a pose; margins are positive when safe."""

    required_friction: float
    """Least friction coefficient with which the contacts hold the robot [1]; inf: none does.

    Of the active pair where a contact is just being exchanged, else the least over all pairs of
    contacts: at the least coefficient the load lies on the surface of the cone of all contact
    forces, on a facet between two edges, so two contacts carry it.
    """
    rear_load: float
    """Normal force at the rear contact [N/kg]."""
    rear_traction: float
    """Tangential force at the rear contact, driving ahead positive [N/kg]."""
    front_load: float
    front_traction: float
    traction: float
    """Force along the path, g sin psi + a [N/kg]."""
    back: float
    """Static stability margin to the back: rear contact to gravity line [m]."""
    front: float
    """Static stability margin to the front: gravity line to front contact [m]."""
    back_rise: float
    """Rise of the centroid until it stands over the fixed rear contact (Hirose) [m]."""
    front_rise: float
    """Rise of the centroid until it stands over the fixed front contact (Hirose) [m]."""
    energy: float
    """Energy margin along the flow, the smaller of both sides [m]; NaN until worked out."""
    energy_side: float
    """Side of `energy`, +1 back, -1 front; NaN until worked out."""
    force_angle: float
    """Force-angle measure of Papadopoulos and Rey [rad m N/kg]."""
    zmp: float
    """Where the gravity line meets the line of the contacts, 0 rear to 1 front."""
    contacts: int
    """How many."""
    belly_touches: bool
    steepest_face: float
    """Largest angle of a contact normal from the vertical [rad]."""
    tilt: float
    """Of effective gravity: its horizontal over its vertical part, backward positive."""
    bounded: bool
    """Whether `energy` is the rise itself; else a lower bound.

    It is a bound where the robot wedges or does not come over the contact within 90 degrees.
    """
    outer_rear: int
    """Features of the outermost contacts."""
    outer_front: int
    without: int
    """Point of the ground that does not count here; -1: all do."""


@dataclass(slots=True)
class Touching:
    """A contact of a pose, its gap [m], and the kind of its part."""

    feature: int
    x: float
    z: float
    n_x: float
    n_z: float
    gap: float
    kind: int


@dataclass(slots=True)
class Job:
    """One traverse of a batch."""

    terrain: int
    """Number of the terrain."""
    robot: int
    """Number of the robot."""
    x_start: float
    """Centroid at the start [m]."""
    x_end: float
    """Centroid at the end [m]."""
    inclination: float = 0.0
    """From which the robot settles at the start [rad]."""
    acceleration: float = 0.0
    """Along the path of the centroid [m/s^2]."""
    gyration: float = 0.2
    """Radius of gyration about the centroid [m]."""
    reference: float = 0.0
    """Inclination above which `Summary.extra` counts [rad]."""


@dataclass(slots=True)
class Summary:
    """What a traverse of a batch came to."""

    status: int
    """A `Status`."""
    poses: int
    """How many."""
    events: int
    rotations: int
    largest_inclination: float
    """[rad]"""
    smallest_inclination: float
    extra: float
    """Largest inclination above the reference [rad]."""
    largest_rotation: float
    """Largest angle of a rotation [rad]."""
    topples_with_momentum: bool
    """Whether some rotation topples with the momentum gained."""
    x: float
    """Centroid reached [m]."""
    required_friction: float
    """Largest [1]; NaN without margins, as those that follow."""
    static_margin: float
    """Smallest [m]."""
    energy: float
    """Smallest energy margin along the flow [m]."""
    belly_touches: bool


@dataclass(slots=True)
class Rating:
    """How a traverse rates; but for the status NaN where the robot does not arrive."""

    status: int
    """A `Status`."""
    required_friction: float
    """Largest, but where the trailing end leaves an edge as it lands [1]."""
    belly_touches: bool
    largest_rotation: float
    """Largest angle of rotations that follow one another at once [rad]."""
    rocking: float
    """Largest part of such an angle that counts as rocking [rad]."""
    impact_speed: float
    """Largest speed at which an end comes down [m/s]."""
    spare: float
    """Least rise still to climb before rotations topple, less all drops so far [m].

    Under gravity that is tilted as stated.
    """
    held: float
    """Least margin of the belts with grousers in the worst case [rad].

    Infinite without grousers, or where more nosings than there is room for touch a flat.
    """
    held_at_best: float
    """The same in the best case [rad]."""


@dataclass(slots=True)
class Edge:
    """A place of the terrain [m]."""

    x: float
    z: float


@dataclass(slots=True)
class Slide:
    """Way of the belts along the ground, at the rear and at the front contact [m]."""

    rear: float
    front: float


@dataclass(slots=True)
class Zone:
    """Places between a smallest and a largest x, a smallest and a largest z [m]."""

    x_min: float
    x_max: float
    z_min: float
    z_max: float


@dataclass(slots=True)
class Flight:
    """First and last place of a flight, along [m], and its mean slope [rad]."""

    begin: float
    end: float
    slope: float


@dataclass(slots=True)
class Passed:
    """A nosing that passes an end of a flat."""

    s: float
    """Arclength [m]."""
    reached: bool
    """Whether the flat reaches it, or leaves it."""
    point: int
    part: int
    row: int
    """Of the pose before."""
    share: float
    """Of the distance to the next pose."""


@dataclass(slots=True)
class Way:
    """A way between two poses of a path, on which a figure may be the largest."""

    row: int
    """Of the pose before."""
    group: int
    s_behind: float
    """Place of the pose behind, of both ends, of the pose ahead [m]."""
    s_begin: float
    s_end: float
    s_ahead: float
    behind: float
    """The figure there; NaN where the path does not lead on to it."""
    begin: float
    end: float
    ahead: float
    promise: float
    """How high the figure may be in between."""


@dataclass(slots=True)
class Support:
    """What a pose stands on, or may stand on: as many rows a pose as it has slots."""

    is_one: bool
    x: float
    """Place from the centroid [m]."""
    z: float
    normal: float
    """Tilt of its normal [rad]."""
    place: int
    """`NOSING`, `TREAD` or `FACE`."""
    point: int
    """Of the ground, where a grouser may stand; ``NOWHERE``: none."""
    tread: float
    """Tilt of the normal of the tread there [rad]; NaN: none."""
    curvature: float
    """Of the belt [1/m]."""
    lift: float
    """Of that point above the axle of the end that leans against a face [m]; NaN: no face."""
    beyond: float
    """How far beyond its nosing it lies on the tread [m]."""
    flat: float
    """Tilt of the normal of the flat over which the end would come, were it farther back [rad].

    NaN: there is none.
    """
    beside: float
    """Gap between the point and the next belt that passes it another way [m]."""


@dataclass(slots=True)
class Load:
    """Sum of the contact forces of a pose [N/kg], and the friction that smooth belts require."""

    x: float
    z: float
    coulomb: float
    """Angle of friction [rad]."""


@dataclass(slots=True)
class Extreme:
    """Extreme figures of a phase; each place is that of the front contact there [m]."""

    poses: int
    """How many."""
    friction: float
    """Largest that is required [1]."""
    friction_place: float
    slides_below: float
    """Friction below which the trailing end slides down as the robot lands [1]; NaN: it leaves no
    edge."""
    static_margin: float
    """Smallest towards the downhill end [m]."""
    traction: float
    """Largest tractive force over mass [N/kg]."""
    belly: bool
    """Whether it carries somewhere."""
    energy: float
    """Least rise that a fall downhill needs [m]; infinite: no pose counts."""
    energy_place: float
    steadiness: float
    """The same about the flat, by the sudden stop that brings it about [m]."""
    steadiness_place: float
    uphill: float
    """The same uphill, traversing [m]."""
    uphill_place: float
    tilt_downhill: float
    """Least tilt of gravity at which it rotates by more than rocking [rad]."""
    tilt_downhill_place: float
    tilt_uphill: float
    """The same uphill, traversing [rad]."""
    tilt_uphill_place: float


class Grousers(NamedTuple):
    """Grousers under load, and the nosings that they meet: one case of what is given as ranges."""

    height: float
    """Under load [m]."""
    spacing: float
    """[m]"""
    tip_width: float
    """Along the belt [m]."""
    nosing_radius: float
    """[m]"""
    rigid: bool
    """Whether they are rigid and sharp: of several nosings two carry, and one that has passed a
    nosing rolls off it. Else they share the load, and are worn round."""


class At(NamedTuple):
    """Where the body is: centroid [m], cosine and sine of the inclination."""

    x: float
    z: float
    c: float
    s: float


class Held(NamedTuple):
    """A pose on two contacts, and the direction of its line of poses."""

    x: float
    z: float
    phi: float
    """Inclination [rad]."""
    t_x: float
    """Unit tangent (x, z, ARM phi)."""
    t_z: float
    t_w: float
    rear: int
    """Features."""
    front: int


class Turn(NamedTuple):
    """A rotation about one contact."""

    pivot: int
    """Feature."""
    start: At
    o_x: float
    """Point of the pivot at the start [m]."""
    o_z: float
    finish: At
    f_x: float
    """Point of the pivot at the end [m]."""
    f_z: float
    sense: float
    """+1 nose up, -1 nose down."""
    end: float
    """Angle by which it turns [rad], and its cosine and sine."""
    c: float
    s: float
    h_x: float
    """What it turns about: centre of the end that rolls [m], whose radius a vertex has not."""
    h_z: float
    radius: float
    n_x: float
    """Normal of the supporting line of the pivot's part, and its height over the pivot [m]."""
    n_z: float
    height: float


class Swept(NamedTuple):
    """Centres of a part's discs as a rotation begins, and the ranges of x that they sweep [m]."""

    a_x: float
    a_z: float
    b_x: float
    b_z: float
    left1: float
    right1: float
    left2: float
    right2: float


class Side(NamedTuple):
    """Side of a part as a rotation begins."""

    faces_down: bool
    """Whether it does so at one end; else it meets nothing: the ground reaches down."""
    n_x: float
    n_z: float
    level: float
    """How far the pivot lies beyond its line [m]."""
    foot: float
    """Where along it the pivot lies, from its first end [m]."""


class First(NamedTuple):
    """What closes first within a rotation: the angle [rad], and the feature."""

    angle: float
    feature: int


class Release(NamedTuple):
    """A pose from which the robot turns to one side, the tilt of effective gravity frozen."""

    x: float
    z: float
    phi: float
    sense: float
    """+1 nose up, -1 nose down."""
    kappa: float


class Fallen(NamedTuple):
    """How a rotation ended."""

    outcome: int
    """A `RotationOutcome`."""
    rear: int
    """The two contacts that arrest it, if it is arrested."""
    front: int
    x: float
    z: float
    phi: float
    before: float
    """Rate of turn just before the last impact [rad/s]."""
    after: float
    """And just after it, turning about the last contact (0 if it stops)."""
    angle: float
    """Through which it turned [rad]."""


class Press(NamedTuple):
    """A contact that bears a load: its point [m], its unit normal into the robot."""

    x: float
    z: float
    n_x: float
    n_z: float


class Forces(NamedTuple):
    """Least friction with which two contacts hold [1], and their forces [N/kg].

    Tractions are positive where they drive the robot ahead.
    """

    required_friction: float
    first_load: float
    first_traction: float
    second_load: float
    second_traction: float


class Bound(NamedTuple):
    """Edge of a cone narrower by e as a bound on an inner force l.

    ``a - b tan(e) + (c - d tan(e)) l >= 0``
    """

    a: float
    b: float
    c: float
    d: float


class Cone(NamedTuple):
    """A contact and its cone: place from the centroid [m], tilt of the normal, friction [rad]."""

    x: float
    z: float
    alpha: float
    phi: float


class Friction(NamedTuple):
    """Angles of friction of nosings, treads and riser faces [rad]."""

    nosings: float
    treads: float
    faces: float


class Tip(NamedTuple):
    """Tip of a grouser as it comes to stand at a support."""

    stands: bool
    """Whether one can."""
    tilt: float
    """Of the normal under it [rad]."""
    run: float
    """Length along the belt over which it stands on the tread [m]."""
    off: float
    """And over which one that has passed the nosing rolls off it [m]."""
    ahead: float
    """How far it stands ahead of the nosing, along the belt [m]."""


class Outer(NamedTuple):
    """How far behind and ahead of the gravity line the outermost contacts lie, and where [m]."""

    back: float
    front: float
    r_x: float
    r_z: float
    f_x: float
    f_z: float


class Samples(NamedTuple):
    """Poses of a path and between two of it: the row of the path before each, and its margins."""

    rows: Row[int]
    poses: Table[Pose]
    margins: Table[Margin]


class Looked(NamedTuple):
    """Poses whose tilts are looked at."""

    at: Row[int]
    """Row of the path that each counts as."""
    pose: Row[int]
    """Row of its own."""
    reach: Row[float]
    """Rotation that is rocking [rad]."""
    alone: Row[float]
    """Tilt of gravity at which it rotates at all [rad]."""
    tilt: Row[float]
    """And by more than rocking."""


class Known(NamedTuple):
    """What is known of poses of a path, and of others between them, whose extremes are looked for.

    Of the poses of the path: phase, corner, whence, back.
    """

    phase: Row[int]
    """Number of the phase of each: 0 enters, 1 traverses, 2 lands."""
    corner: Row[bool]
    """Where a contact runs over a corner: the pose between two phases is of both."""
    at: Row[int]
    """Pose of the path that each counts as."""
    lasts: Row[bool]
    """Whether the robot stands so for a while."""
    friction: Row[float]
    """Required [1]."""
    traction: Row[float]
    """Tractive force over mass, without its sign [N/kg]."""
    leaves: Row[bool]
    """Whether the trailing end leaves an edge."""
    whence: Row[float]
    """Inclination from which each came down by rocking [rad]; minus infinity: from none."""
    back: Row[bool]
    """Which came down otherwise, so that they only come back."""


class Leading(NamedTuple):
    """How a path leads over which terrain."""

    descending: bool
    whole: bool
    """Whether one flat carries all along on a flight."""
    counts: Row[int]
    """Which poses of each phase count for its energy: `NO_POSE`, `BESIDE_NOSINGS`, `EVERY_POSE`."""
    tops: Table[Zone]
    """Where the uppermost contact stands on a flight's last nosing or beyond."""
    flights: Table[Flight]
    """First and last place of the contacts on each flight [m]."""
    nosings: Row[float]
    """Places of the nosings in their order [m]."""
    height: float
    """Centroid above the flat [m]."""
    gyration: float
    """Least radius of gyration about the centroid [m]."""


@dataclass(slots=True)
class GrouserCase:
    """One case of grousers under load, of nosings and of friction, all of which have to hold."""

    height: float
    spacing: float
    tip_width: float
    nosing_radius: float
    rigid: bool
    nosings: float
    """Angle of friction of nosings beside them [rad]."""
    treads: float
    faces: float
    best: bool
    """Whether it is one of the best case, or of the worst."""


class Belts(NamedTuple):
    """Belts with grousers, and on what they stand."""

    grousers: Table[GrouserCase]
    """Cases, all of which have to hold."""
    treads: Row[float]
    """Tilt of the normal of the tread uphill of each point of the ground [rad]; NaN: none."""
    climbs: bool
    """Whether the way leads up the stairs."""
    steep: float
    """Slope beyond which the ground is a face [rad]."""
    touch: float
    """Gap up to which a nosing lies on a flat [m]."""
    slip: float
    """How far beyond the spacing of grousers a slip is followed [m]."""


class Course(NamedTuple):
    """How traverses over one terrain are driven and rated."""

    step: float
    """Arclength between poses [m]."""
    zones: Table[Zone]
    """Places of the front contact at which the robot lands."""
    edges: Table[Edge]
    """Edges of the terrain that may hold an end as it comes down."""
    rough: float
    """Distance within which an edge is not ahead of another [m]."""
    tilt_rear: float
    """Tilt of gravity towards an end that comes down, for the rise to spare [rad]."""
    tilt_front: float


class Figures(NamedTuple):
    """A figure along a path, of which the largest of each group is looked for."""

    s: Row[float]
    """Arclength of each pose [m]."""
    line: Row[bool]
    """Whether the path leads on from a pose to the next."""
    values: Row[float]
    """The figure at each pose."""
    group: Row[int]
    """Number of the group of each pose; negative: of none."""
    narrow: Row[bool]
    """Whether the way from a pose to the next may hide a peak that no line tells of."""


class Stance(NamedTuple):
    """How a robot stands on stairs."""

    climbs: bool
    """Whether it goes up: going down, the belt brings no tips over the edge of a face behind."""
    steep: float
    """Slope beyond which a segment of the ground is a face [rad]."""
    touch: float
    """Gap up to which a nosing lies on a flat [m]."""
    reach: float
    """Distance from the centroid that no part of the robot exceeds [m]."""


class Pull(NamedTuple):
    """What pulls a robot that is driven."""

    a: float
    """Acceleration along the path of the centroid [m/s^2]."""
    g: float
    """Gravity [m/s^2]."""
    tilt: float = 0.0
    """Of gravity itself: its horizontal part backward over its vertical part g."""


@dataclass(slots=True)
class Scene:
    """Terrain and robot, and where the last look at the terrain began: the next one is near."""

    ground: Table[Point]
    body: Table[Part]
    hint: int = 0


class Journey(NamedTuple):
    """From where to where the robot is driven, and how."""

    x_start: float
    """Centroid at the start [m]."""
    x_end: float
    inclination: float
    """From which the robot settles at the start [rad]."""
    step: float
    """Arclength between poses [m]."""
    gyration: float
    """Radius of gyration about the centroid [m], for the energy of rotations."""


@dataclass(slots=True)
class Log:
    """What a drive writes down, and how far it has come."""

    poses: Table[Pose]
    events: Table[EventRow]
    rotations: Table[RotationRow]
    keeps: bool
    """Whether poses are written down, and what the momentum of a rotation can still do: without
    them a drive tells no more than how it ends."""
    n_pose: int = 0
    n_event: int = 0
    n_rotation: int = 0
    s: float = 0.0
    """Arclength [m]."""
    leg: int = 0
    """Number of the line of poses."""
