"""Small robots as files, written for these tests."""

INERTIAL = (
    '<inertial><origin xyz="{xyz}" rpy="{rpy}"/><mass value="{mass}"/><inertia ixx="{i[0]}" '
    'iyy="{i[1]}" izz="{i[2]}" ixy="{i[3]}" ixz="{i[4]}" iyz="{i[5]}"/></inertial>'
)


def inertial(mass, xyz="0 0 0", rpy="0 0 0", i=(0.1, 0.2, 0.25, 0.01, -0.02, 0.015)):
    return INERTIAL.format(xyz=xyz, rpy=rpy, mass=mass, i=i)


def urdf_link(name, mass=1.0, xyz="0 0 0", rpy="0 0 0", shapes="", **more):
    return f'<link name="{name}">{inertial(mass, xyz, rpy, **more)}{shapes}</link>'


def urdf_joint(name, kind, parent, child, xyz="0 0 0", rpy="0 0 0", axis="0 1 0", more=""):
    limit = '<limit lower="-3" upper="3" effort="10" velocity="0.8"/>'
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/>{limit}{more}</joint>'
    )


def urdf_shape(shape, xyz="0 0 0", rpy="0 0 0", tag="collision", name=""):
    origin = f'<origin xyz="{xyz}" rpy="{rpy}"/>'
    return f'<{tag} name="{name}">{origin}<geometry>{shape}</geometry></{tag}>'


def urdf(*parts, name="tested"):
    return f'<?xml version="1.0"?><robot name="{name}">{"".join(parts)}</robot>'.encode()


ACROSS = "1.5707963267948966 0 0"
"""A cylinder along y."""


def arm_of_four(root=""):
    """Four links in a row, oblique everywhere; a branch, a slide, a fixed joint."""
    joint = (
        f'<joint name="loose" type="fixed"><parent link="{root}"/><child link="base"/></joint>'
        if root
        else ""
    )
    head = f'<link name="{root}"/>' if root else ""
    return urdf(
        head,
        urdf_link("base", 11.0, "0.1 -0.02 0.3", "0.3 -0.2 0.5"),
        urdf_link("upper", 3.0, "0.2 0.05 -0.1", "1.1 0.4 -0.7", i=(0.05, 0.06, 0.07, 0, 0.01, 0)),
        urdf_link("fore", 2.0, "-0.1 0.3 0.1", "0.2 0.9 2.0"),
        urdf_link("tool", 0.7, "0.01 0.02 0.4"),
        urdf_link("mast", 1.5, "0 0 0.6", i=(0.02, 0.02, 0.003, 0, 0, 0)),
        joint,
        urdf_joint("shoulder", "revolute", "base", "upper", "0.4 0.1 0.2", "0.2 0.3 -0.4", "1 2 3"),
        urdf_joint("elbow", "continuous", "upper", "fore", "0.5 0 -0.1", "-0.6 0.1 0.9", "0 -1 1"),
        urdf_joint("grip", "fixed", "fore", "tool", "0.1 0.2 0.3", "0.5 0.5 0.5"),
        urdf_joint("lift", "prismatic", "base", "mast", "-0.2 0 0.3", "0.1 0 0.2", "0.3 0 1"),
    )


BODY = {"mass": 20.0, "at": (0.02, 0.0, 0.1)}
"""The tank: L 500, R 90 mm, tracks at y = +-200 mm, flippers 300 mm long with tips of 30 mm.

By hand: 20 kg at x 20, z 100 mm; two tracks of 5 kg at z 20 mm; four flippers of 1 kg, 100 mm from
pivots at x +-250 mm. Flippers upright: 34 kg, x = 0.4 / 34 m, z = (2 + 0.2 + 0.4) / 34 m, from the
middle of the track, whose underside lies at z = -90 mm.
"""
TANK = {"mass": 34.0, "com_from_front": 0.25 - 0.4 / 34, "com_height": 0.09 + 2.6 / 34}
SIDES = {"left": 1, "right": -1}
ENDS = {"front": 1, "rear": -1}
POINT = (0.0,) * 6


def track_shapes():
    wheel = '<cylinder radius="0.09" length="0.1"/>'
    return (
        urdf_shape('<box size="0.5 0.1 0.18"/>')
        + urdf_shape(wheel, "0.25 0 0", ACROSS)
        + urdf_shape(wheel, "-0.25 0 0", ACROSS)
    )


def flipper_shapes(outward, named="arm"):
    return urdf_shape('<cylinder radius="0.09" length="0.05"/>', "0 0 0", ACROSS) + urdf_shape(
        '<cylinder radius="0.03" length="0.05"/>', f"{0.3 * outward} 0 0", ACROSS, name=named
    )


def tank_urdf(flipper="flipper", track="track", body="", shapes=None, more="", axis="0 1 0"):
    parts = [urdf_link("base_link", BODY["mass"], "0.02 0 0.1", shapes=body, i=POINT)]
    for side, y in SIDES.items():
        name = f"{side}_{track}"
        own = track_shapes() if shapes is None else shapes
        parts.append(urdf_link(name, 5.0, "0 0 0.02", shapes=own, i=POINT))
        parts.append(urdf_joint(f"{name}_j", "fixed", "base_link", name, f"0 {0.2 * y} 0"))
        for end, x in ENDS.items():
            if not flipper:
                continue
            name = f"{end}_{side}_{flipper}"
            parts.append(urdf_link(name, 1.0, f"{0.1 * x} 0 0", shapes=flipper_shapes(x), i=POINT))
            place = f"{0.25 * x} {0.28 * y} 0"
            parts.append(urdf_joint(f"{name}_j", "continuous", "base_link", name, place, axis=axis))
    return urdf(*parts, more, name="tank")


def sdf_inertial(mass, x=0.0, z=0.0):
    zero = "".join(f"<i{axes}>0</i{axes}>" for axes in ("xx", "yy", "zz", "xy", "xz", "yz"))
    return (
        f"<inertial><pose>{x} 0 {z} 0 0 0</pose><mass>{mass}</mass><inertia>{zero}</inertia>"
        "</inertial>"
    )


def sdf_wheel(radius, x=0.0):
    return (
        f'<collision name="w{radius}{x}"><pose>{x} 0 0 1.5707963267948966 0 0</pose><geometry>'
        f"<cylinder><radius>{radius}</radius><length>0.1</length></cylinder></geometry></collision>"
    )


def tank_sdf(version="1.6", relative=False):
    """The tank in SDF; `relative`: placed by frames of others, as from version 1.7 on."""
    parts = [f'<link name="base_link">{sdf_inertial(20.0, 0.02, 0.1)}</link>']
    for side, y in SIDES.items():
        track = f"{side}_track"
        wheels = sdf_wheel(0.09, 0.25) + sdf_wheel(0.09, -0.25)
        parts.append(
            f'<link name="{track}"><pose>0 {0.2 * y} 0 0 0 0</pose>{sdf_inertial(5.0, 0.0, 0.02)}'
            f"{wheels}</link>"
            f'<joint name="{track}_j" type="fixed"><parent>base_link</parent>'
            f"<child>{track}</child></joint>"
        )
        for end, x in ENDS.items():
            name = f"{end}_{side}_flipper"
            # the rear one is turned about z, so that its own x points away from the robot
            yaw = 0.0 if x > 0 else 3.141592653589793
            pose = f"<pose>{0.25 * x} {0.28 * y} 0 0 0 {yaw}</pose>"
            if relative:
                pose = f'<pose relative_to="{track}">{0.25 * x} {0.08 * y} 0 0 0 {yaw}</pose>'
            parts.append(
                f'<link name="{name}">{pose}{sdf_inertial(1.0, 0.1)}'
                f"{sdf_wheel(0.09)}{sdf_wheel(0.03, 0.3)}</link>"
                f'<joint name="{name}_j" type="revolute"><parent>{track}</parent>'
                f"<child>{name}</child><axis><xyz>0 1 0</xyz><limit><lower>-1e16</lower>"
                "<upper>1e16</upper><velocity>0.8</velocity></limit></axis></joint>"
            )
    return f'<sdf version="{version}"><model name="tank">{"".join(parts)}</model></sdf>'.encode()


def tank_mjcf():
    parts = []
    wheel = '<geom type="cylinder" size="{} 0.05" pos="{} 0 0" euler="90 0 0" mass="0"/>'
    for side, y in SIDES.items():
        wheels = wheel.format(0.09, 0.25) + wheel.format(0.09, -0.25)
        parts.append(
            f'<body name="{side}_track" pos="0 {0.2 * y} 0">'
            f'<inertial pos="0 0 0.02" mass="5" diaginertia="0 0 0"/>{wheels}</body>'
        )
        for end, x in ENDS.items():
            name = f"{end}_{side}_flipper"
            parts.append(
                f'<body name="{name}" pos="{0.25 * x} {0.28 * y} 0">'
                f'<inertial pos="{0.1 * x} 0 0" mass="1" diaginertia="0 0 0"/>'
                f'<joint name="{name}_j" axis="0 1 0"/>{wheel.format(0.09, 0)}'
                f"{wheel.format(0.03, 0.3 * x)}</body>"
            )
    return (
        '<mujoco model="tank"><worldbody><body name="base_link"><freejoint/>'
        '<inertial pos="0.02 0 0.1" mass="20" diaginertia="0 0 0"/>'
        f"{''.join(parts)}</body></worldbody></mujoco>"
    ).encode()
