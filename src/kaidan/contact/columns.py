"""Columns of the kernel's tables and the packing of features: the memory layout, named once.

Plain integers, so that the compiler treats each as the literal that it stands for. Only this
package reads tables by column; everybody else reads the records of :mod:`kaidan.contact.records`.

::

    feature = POINT * point + PART * part + kind      kind: VERTEX, DISC_1 or DISC_2
"""

# Ground, a row a point: place [m], unit vector to the next point, length of that segment [m],
# 1.0 if the point is convex.
X, Z, U_X, U_Z, LENGTH, CONVEX = range(6)
GROUND_COLUMNS = 6

# Body, a row a part: disc 1 (centre, radius [m]), disc 2, unit vector and distance between them,
# sine and cosine of the taper, length of the flat [m], side of the underside, kind of the part.
X1, Z1, R1, X2, Z2, R2, E_X, E_Z, AXIS, SINE, COSINE, FLAT, SIDE, KIND = range(14)
BODY_COLUMNS = 14
# A disc within a row of the body: DISC * (0 or 1) + one of these.
DISC_X, DISC_Z, DISC_R = range(3)
DISC = 3

# Features: what can touch what.
VERTEX, DISC_1, DISC_2 = range(3)
KIND_MASK = 3
PART, PART_BITS, PART_MASK = 4, 2, 15
POINT, POINT_BITS = 64, 6
NO_FEATURE = -1

# Poses: arclength [m], centroid [m], inclination [rad], the two features, their points [m] and
# normals (of the belts as they give way), direction of the path [rad], number of the line of poses,
# tilt of the rear contact's normal on the rigid outline [rad].
(
    POSE_S, POSE_X, POSE_Z, POSE_PHI, POSE_REAR, POSE_FRONT,
    REAR_X, REAR_Z, FRONT_X, FRONT_Z, REAR_N_X, REAR_N_Z, FRONT_N_X, FRONT_N_Z,
    POSE_PSI, POSE_LEG, REAR_LEAN,
) = range(17)  # fmt: skip
POSE_COLUMNS = 17

# Events: kind, arclength [m], centroid [m], inclination [rad], feature, other feature, row of the
# pose.
(
    EVENT_KIND, EVENT_S, EVENT_X, EVENT_Z, EVENT_PHI, EVENT_FEATURE, EVENT_OTHER, EVENT_POSE,
) = range(8)  # fmt: skip
EVENT_COLUMNS = 8

# Rotations: see kaidan.contact.records.Rotation.
(
    ROTATION_SENSE, ROTATION_S, ROTATION_PIVOT, START_X, START_Z, START_PHI,
    END_X, END_Z, END_PHI, ROTATION_ANGLE, RATE_BEFORE, RATE_AFTER, KINETIC, BARRIER, TOPPLES,
    OUTCOME, PIVOT_X, PIVOT_Z, BARRIER_ACROSS,
) = range(19)  # fmt: skip
ROTATION_COLUMNS = 19

# Margins: see kaidan.contact.records.Margins.
(
    FRICTION, REAR_N, REAR_T, FRONT_N, FRONT_T, TRACTION, BACK, FRONT, BACK_RISE, FRONT_RISE,
    ENERGY, ENERGY_SIDE, FORCE_ANGLE, ZMP, CONTACTS, BELLY_TOUCHES, STEEPEST, TILT, BOUNDED,
    OUTER_REAR, OUTER_FRONT, WITHOUT,
) = range(22)  # fmt: skip
MARGIN_COLUMNS = 22

# Contacts of one pose: feature, point [m], normal, gap [m], kind of the part.
(
    CONTACT_FEATURE, CONTACT_X, CONTACT_Z, CONTACT_N_X, CONTACT_N_Z, CONTACT_GAP, CONTACT_KIND,
) = range(7)  # fmt: skip
CONTACT_COLUMNS = 7

# Jobs of a batch and the summary of each.
(
    JOB_TERRAIN, JOB_ROBOT, JOB_START, JOB_END, JOB_PHI, JOB_ACCELERATION, JOB_GYRATION,
    JOB_REFERENCE,
) = range(8)  # fmt: skip
JOB_COLUMNS = 8
(
    SUMMARY_STATUS, SUMMARY_POSES, SUMMARY_EVENTS, SUMMARY_ROTATIONS, SUMMARY_HIGHEST,
    SUMMARY_LOWEST, SUMMARY_EXTRA, SUMMARY_ANGLE, SUMMARY_TOPPLES, SUMMARY_REACHED,
    SUMMARY_FRICTION, SUMMARY_STABILITY, SUMMARY_ENERGY, SUMMARY_BELLY,
) = range(14)  # fmt: skip
SUMMARY_COLUMNS = 14

# Ratings of a batch: status, friction, belly; of rotations angle, rocking [rad],
# speed of an impact [m/s], rise to spare [m]; margin of belts with grousers in the worst and in
# the best case [rad].
(
    RATED_STATUS, RATED_FRICTION, RATED_BELLY, RATED_ANGLE, RATED_ROCKING, RATED_IMPACT,
    RATED_SPARE, RATED_HELD, RATED_HELD_BEST,
) = range(9)  # fmt: skip
RATING_COLUMNS = 9

# Points, and zones of a place: smallest and largest x, smallest and largest z [m].
POINT_COLUMNS = 2
ZONE_COLUMNS = 4

# Flights: first and last x [m], mean slope [rad].
FLIGHT_BEGIN, FLIGHT_END, FLIGHT_SLOPE = range(3)
FLIGHT_COLUMNS = 3

# Poses settled one by one: found, height [m], inclination [rad], the two features.
SETTLED_FOUND, SETTLED_Z, SETTLED_PHI, SETTLED_REAR, SETTLED_FRONT = range(5)
SETTLED_COLUMNS = 5

# Nosings that pass an end of a flat: arclength [m], whether it is reached (1.0) or left, point,
# part, row of the pose before, share of the way to the next.
PASSED_S, PASSED_REACHED, PASSED_POINT, PASSED_PART, PASSED_ROW, PASSED_SHARE = range(6)
PASSED_COLUMNS = 6

# Ways between two poses of a path: row before it, group, place of the pose behind, of both ends and
# of the pose ahead [m], the figure there, NaN where the path does not lead on to it; how high the
# figure may be in between.
(
    WAY_ROW, WAY_GROUP, WAY_S_BEHIND, WAY_S_BEGIN, WAY_S_END, WAY_S_AHEAD,
    WAY_BEHIND, WAY_BEGIN, WAY_END, WAY_AHEAD, WAY_PROMISE,
) = range(11)  # fmt: skip
WAY_COLUMNS = 11

# Supports, as many rows a pose: whether it is one (1.0); of a contact on which the pose stands its
# place from the centroid [m], tilt of its normal [rad], what it stands on (NOSING, TREAD, FACE),
# point of the ground where a grouser may stand (-1: none), tilt of the normal of the tread there
# [rad], curvature of the belt [1/m], lift of that point above the axle of the end that leans
# against a face [m] (NaN: no face), how far beyond its nosing it lies on the tread [m], tilt of the
# normal of the flat of that part, over which the end would come if it were farther back [rad]
# (NaN: there is none).
(
    SUPPORT_IS_ONE, SUPPORT_X, SUPPORT_Z, SUPPORT_NORMAL, SUPPORT_PLACE, SUPPORT_POINT,
    SUPPORT_TREAD, SUPPORT_CURVATURE, SUPPORT_LIFT, SUPPORT_BEYOND, SUPPORT_FLAT,
    SUPPORT_BESIDE,
) = range(12)  # fmt: skip
SUPPORT_COLUMNS = 12
NOSING, TREAD, FACE = range(3)
NOWHERE = -1

# Loads, a row a pose: sum of the contact forces [N/kg], angle of friction that smooth belts require
# [rad].
LOAD_X, LOAD_Z, LOAD_COULOMB = range(3)
LOAD_COLUMNS = 3

# Grousers under load: height, spacing, width of their tips, radius of the nosings that they meet
# [m], whether they are rigid (1.0); angles of friction beside them of nosings, treads and riser
# faces [rad], whether the case is the best one (1.0).
(
    GROUSER_HEIGHT, GROUSER_SPACING, GROUSER_WIDTH, GROUSER_RADIUS, GROUSER_RIGID, GROUSER_NOSINGS,
    GROUSER_TREADS, GROUSER_FACES, GROUSER_BEST,
) = range(9)  # fmt: skip
GROUSER_COLUMNS = 9

# Extremes, a row a phase: number of poses; required friction [1] and the place of the front contact
# there [m]; friction below which the trailing end slides down as the robot lands (NaN: it leaves no
# edge) [1]; static margin [m]; tractive force over mass [N/kg]; whether the belly carries; then
# each with the place of the front contact: rise that a fall downhill needs, the same about the flat
# by one sudden stop, and uphill [m], tilt of gravity to the first rock downhill and uphill [rad].
(
    EXTREME_POSES, EXTREME_FRICTION, EXTREME_FRICTION_X, EXTREME_SLIDES, EXTREME_STATIC,
    EXTREME_TRACTION, EXTREME_BELLY, EXTREME_ENERGY, EXTREME_ENERGY_X, EXTREME_STEADY,
    EXTREME_STEADY_X, EXTREME_UPHILL, EXTREME_UPHILL_X, EXTREME_TILT_DOWNHILL,
    EXTREME_TILT_DOWNHILL_X, EXTREME_TILT_UPHILL, EXTREME_TILT_UPHILL_X,
) = range(17)  # fmt: skip
EXTREME_COLUMNS = 17
