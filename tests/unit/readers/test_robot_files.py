"""Robots of files: small ones of these tests, of which every figure is known by hand."""

import math

import pytest

from kaidan.errors import InputError
from kaidan.readers import found_in
from kaidan.readers.hints import Hints
from robot_files import (
    ACROSS,
    TANK,
    tank_mjcf,
    tank_sdf,
    tank_urdf,
    urdf,
    urdf_joint,
    urdf_link,
    urdf_shape,
)

UPRIGHT = math.pi / 2
NEAR = 1e-9
"""Sums of a dozen numbers in double precision; angles go through sines."""


def found(tmp_path, content, name="tank.xml", **hints):
    path = tmp_path / name
    path.write_bytes(content)
    return found_in(path, Hints(**hints))


def robot(tmp_path, content, **hints):
    (one,) = found(tmp_path, content, **hints).robots
    return one


def refusal(tmp_path, content, **hints):
    (one,) = found(tmp_path, content, **hints).refusals
    return one


def figure(one, key):
    return one.figures[key].value


DIALECTS = {
    "URDF": tank_urdf(),
    "SDF 1.6": tank_sdf(),
    "SDF 1.9": tank_sdf("1.9", relative=True),
    "MJCF": tank_mjcf(),
}


@pytest.mark.parametrize("content", DIALECTS.values(), ids=DIALECTS)
def test_the_tank_in_every_dialect(tmp_path, content):
    one = robot(tmp_path, content)
    for key, value in TANK.items():
        assert figure(one, key) == pytest.approx(value, abs=NEAR), key
    expected = {
        "track.flat_length": 0.5, "track.front_radius": 0.09, "track.rear_radius": 0.09,
        "track.gauge": 0.4, "track.width": 0.1,
        "front_flippers.length": 0.3, "front_flippers.root_radius": 0.09,
        "front_flippers.tip_radius": 0.03, "front_flippers.pivot_height": 0.09,
        "front_flippers.pivot_inset": 0.0, "front_flippers.mass": 2.0,
        "front_flippers.com_from_pivot": 0.1, "rear_flippers.length": 0.3,
        "rear_flippers.com_from_pivot": 0.1,
    }  # fmt: skip
    for key, value in expected.items():
        assert figure(one, key) == pytest.approx(value, abs=NEAR), key
    assert one.angles == {"front": UPRIGHT, "rear": UPRIGHT}
    sheet = one.robot()
    assert sheet.front_flippers.stowed_angle == pytest.approx(UPRIGHT)
    assert sheet.stance().com_height == pytest.approx(TANK["com_height"], rel=1e-5)
    assert sheet.title == "tank"


@pytest.mark.parametrize("axis", ["0 1 0", "0 -1 0"])
def test_flippers_rise_whatever_the_sense_of_their_axis(tmp_path, axis):
    one = robot(tmp_path, tank_urdf(axis=axis))
    assert figure(one, "com_height") == pytest.approx(TANK["com_height"], abs=NEAR)


def test_flippers_are_found_by_their_shape_where_no_name_says_so(tmp_path):
    one = robot(tmp_path, tank_urdf(flipper="part"))
    assert one.gear.how_flippers == "shaped"
    assert figure(one, "rear_flippers.length") == pytest.approx(0.3)


def test_a_single_arm_in_the_middle_is_no_flipper(tmp_path):
    arm = urdf_link("lifter", 1.0, shapes=urdf_shape('<box size="0.6 0.05 0.05"/>', "0.3 0 0"))
    joint = urdf_joint("lift", "revolute", "base_link", "lifter", "0 0 0.2")
    one = robot(tmp_path, tank_urdf(flipper="", more=arm + joint))
    assert one.gear.flippers == {}


def test_the_whole_underside_as_in_the_file(tmp_path):
    """By hand: level flippers end 60 mm above the track's underside, so L stays 500 mm.

    They move the centroid down by 4 kg * 100 mm / 34 kg.
    """
    one = robot(tmp_path, tank_urdf())
    assert one.as_in_file["flat_length"] == pytest.approx(0.5)
    assert one.as_in_file["com_height"] == pytest.approx(TANK["com_height"] - 0.4 / 34)


def test_stated_joints_are_kept(tmp_path):
    """By hand: front flippers at 30 degrees above level, 2 kg at 100 mm."""
    joints = {f"front_{side}_flipper_j": -math.radians(30) for side in ("left", "right")}
    one = robot(tmp_path, tank_urdf(), joints=joints)
    assert one.angles["front"] == pytest.approx(math.radians(30))
    lower = 2 * 0.1 * (1 - math.sin(math.radians(30))) / 34
    ahead = 2 * 0.1 * math.cos(math.radians(30)) / 34
    assert figure(one, "com_height") == pytest.approx(TANK["com_height"] - lower)
    assert figure(one, "com_from_front") == pytest.approx(TANK["com_from_front"] - ahead)


def test_limits_that_forbid_upright_flippers_are_said(tmp_path):
    text = tank_urdf().replace(b'type="continuous"', b'type="revolute"')
    text = text.replace(b'lower="-3" upper="3"', b'lower="-1" upper="1"')
    one = robot(tmp_path, text)
    assert one.angles == {"front": 0.0, "rear": 0.0}
    assert any(
        note == "The front flippers cannot be raised to 90 deg within the limits of their joints: "
        "taken at 0 deg."
        for note in one.notes
    )


def test_another_front_and_another_up(tmp_path):
    """The tank seen from the other side: C_L from its other end."""
    one = robot(tmp_path, tank_urdf(), forward="-x")
    assert figure(one, "com_from_front") == pytest.approx(0.5 - TANK["com_from_front"])
    with pytest.raises(InputError, match=r"^hints: forward = \+x and up = -x are along one axis$"):
        found(tmp_path, tank_urdf(), up="-x")


def test_figures_that_are_stated_replace_those_of_the_file(tmp_path):
    sheet = robot(
        tmp_path, tank_urdf(), figures={"com_height": 0.2, "front_flippers.length": 0.25}
    ).robot()
    assert (sheet.com_height, sheet.front_flippers.length) == (0.2, 0.25)
    assert sheet.sources["com_height"] == "U: stated by the user"


def test_a_raised_idler_is_found(tmp_path):
    """By hand: a wheel 150 mm ahead of the flat, its axle 200 mm up; the flat is 20 mm lower."""
    wheel = urdf_shape('<cylinder radius="0.06" length="0.1"/>', "0.4 0 0.11", ACROSS)
    plain = urdf_shape('<box size="0.5 0.1 0.18"/>')
    shapes = plain + "".join(
        urdf_shape('<cylinder radius="0.09" length="0.1"/>', f"{x} 0 0", ACROSS)
        for x in (0.25, -0.25)
    )
    one = robot(tmp_path, tank_urdf(flipper="", shapes=shapes + wheel))
    (raised,) = figure(one, "track.wheels")
    assert raised == pytest.approx({"from_front": -0.15, "height": 0.2, "radius": 0.06})
    assert figure(one, "track.flat_length") == pytest.approx(0.5)
    assert one.robot().track.wheels[0].from_front == pytest.approx(-0.15)


def test_one_box_for_a_track_has_corners(tmp_path):
    one = robot(tmp_path, tank_urdf(flipper="", shapes=urdf_shape('<box size="0.7 0.1 0.18"/>')))
    assert figure(one, "track.flat_length") == pytest.approx(0.7)
    assert figure(one, "track.front_radius") == 0.0
    assert one.notes == (
        "The front end of the track is a corner without a wheel: R = 0.",
        "The rear end of the track is a corner without a wheel: R = 0.",
        "The file draws a box for each track. A belt round it is assumed, with square ends.",
    )


def test_capsules_and_spheres_are_round_ends(tmp_path):
    """A capsule along x: 400 mm between its ends, 80 mm of radius."""
    shapes = urdf_shape('<capsule radius="0.08" length="0.4"/>', rpy="0 1.5707963267948966 0")
    one = robot(tmp_path, tank_urdf(flipper="", shapes=shapes))
    assert figure(one, "track.flat_length") == pytest.approx(0.4)
    assert figure(one, "track.rear_radius") == pytest.approx(0.08)


def test_grousers_that_are_modelled_are_found(tmp_path):
    """By hand: boxes 20 mm high about the underside stand out by 10 mm, 50 mm apart, 8 wide."""
    boxes = "".join(
        urdf_shape('<box size="0.008 0.1 0.02"/>', f"{-0.2 + 0.05 * k} 0 -0.09", name=f"g{k}")
        for k in range(9)
    )
    one = robot(tmp_path, tank_urdf(flipper="", shapes=track_with(boxes)))
    assert figure(one, "track.flat_length") == pytest.approx(0.5)
    assert figure(one, "track.grouser_height") == pytest.approx(0.01)
    assert figure(one, "track.grouser_spacing") == pytest.approx(0.05)
    assert figure(one, "track.grouser_tip_width") == pytest.approx(0.008)
    assert one.robot().track.has_grousers


def track_with(more):
    from robot_files import track_shapes

    return track_shapes() + more


def test_the_belly_is_the_lowest_shape_over_the_flat(tmp_path):
    """By hand: a box of 100 mm about z = 20 mm ends at -30 mm, 60 mm above the underside."""
    body = urdf_shape('<box size="0.4 0.2 0.1"/>', "0 0 0.02")
    assert figure(robot(tmp_path, tank_urdf(body=body)), "track.belly_clearance") == pytest.approx(
        0.06
    )
    mesh = urdf_shape('<mesh filename="package://robot/body.stl"/>')
    one = robot(tmp_path, tank_urdf(body=body + mesh))
    assert "track.belly_clearance" not in one.figures
    assert one.notes == (
        "Meshes under the body are not opened, so its belly is not known: base_link.",
    )


def test_a_robot_of_flippers_alone_stands_on_their_roots(tmp_path):
    text = tank_urdf(track="part", shapes="")
    one = robot(tmp_path, text)
    assert figure(one, "track.flat_length") == figure(one, "track.gap") == pytest.approx(0.5)
    assert figure(one, "track.front_radius") == pytest.approx(0.09)


# faults that are usual


def test_a_centroid_off_the_middle_is_said(tmp_path):
    """By hand: 20 kg 80 mm to the left, of 34 kg in all: 47 mm; 3 % of 500, 10 % of 166 mm."""
    text = tank_urdf().replace(b'xyz="0.02 0 0.1"', b'xyz="0.02 0.08 0.1"')
    assert robot(tmp_path, text).notes == (
        "The centroid lies 47 mm to the left of the middle of the tracks: axes may be swapped, or "
        "a mass misplaced.",
        "Its masses are doubtful, so its centroid is taken as a range, C_L +- 15 and C_N +- 17 mm, "
        "and there is no GO before it is weighed.",
    )
    span = robot(tmp_path, text).robot().com_range
    assert span.from_front == pytest.approx((0.2382 - 0.015, 0.2382 + 0.015), abs=1e-4)
    stated = {"com_from_front": 0.24, "com_height": 0.17}
    assert robot(tmp_path, text, figures=stated).robot().com_range is None


def test_masses_of_zero_and_missing_ones_are_said(tmp_path):
    bare = '<link name="mast">' + urdf_shape('<box size="0.1 0.1 0.1"/>', "0 0 1") + "</link>"
    zero = urdf_link("box", 0.0, shapes=urdf_shape('<box size="0.1 0.1 0.1"/>', "0 0 1"))
    joints = urdf_joint("a", "fixed", "base_link", "mast") + urdf_joint(
        "b", "fixed", "base_link", "box"
    )
    notes = robot(tmp_path, tank_urdf(more=bare + zero + joints)).notes
    assert "No mass is stated for mast: counted as 0 kg." in notes
    assert "A mass of 0 kg is stated for box." in notes


def test_impossible_moments_of_inertia_are_said(tmp_path):
    odd = urdf_link("odd", 1.0, i=(0.1, 0.1, 0.5, 0, 0, 0))
    joint = urdf_joint("a", "fixed", "base_link", "odd")
    notes = robot(tmp_path, tank_urdf(more=odd + joint)).notes
    assert notes == ("The moments of inertia of odd are those of no body.",)


def test_unequal_flippers_are_said(tmp_path):
    text = tank_urdf().replace(
        b'<link name="front_left_flipper"><inertial><origin xyz="0.1 0 0" rpy="0 0 0"/><mass '
        b'value="1.0"/>',
        b'<link name="front_left_flipper"><inertial><origin xyz="0.1 0 0" rpy="0 0 0"/><mass '
        b'value="1.5"/>',
    )
    assert robot(tmp_path, text).notes == (
        "Left and right front flipper differ by 0 mm in length and 0.50 kg.",
    )


def test_tracks_of_meshes_alone_are_a_refusal_until_figures_are_stated(tmp_path):
    mesh = urdf_shape('<mesh filename="/etc/passwd"/>')
    text = tank_urdf(flipper="", shapes=mesh)
    refused = refusal(tmp_path, text)
    assert refused.why == "mesh-tracks"
    assert refused.numbers["mass_kg"] == 30.0
    stated = {"track.flat_length": 0.5, "com_from_front": 0.24, "com_height": 0.17}
    sheet = robot(tmp_path, text, figures=stated).robot()
    assert (sheet.track.flat_length, sheet.mass) == (0.5, 30.0)


def test_no_mass_at_all_is_a_refusal(tmp_path):
    import re

    text = re.sub(rb'value="[\d.]+"', b'value="0"', tank_urdf())
    assert refusal(tmp_path, text).why == "massless"


def test_a_robot_without_level_underside_is_a_refusal(tmp_path):
    ball = urdf(urdf_link("track", shapes=urdf_shape('<sphere radius="0.2"/>')))
    assert refusal(tmp_path, ball).why == "no-flat-run"


# errors, to the letter


@pytest.mark.parametrize(
    ("old", "new", "text"),
    [
        (b'value="20.0"', b'value="heavy"', "line 1: <mass>: value = 'heavy' is not a number"),
        (b'value="20.0"', b'value="1e400"', "line 1: <mass>: value = '1e400' is beyond any robot"),
        (b'value="20.0"', b'value="-1"', "line 1: <mass>: value = -1 kg is negative"),
        (b'xyz="0.02 0 0.1"', b'xyz="0.02 0"', "line 1: <origin>: xyz = '0.02 0' is not 3 numbers"),
        (b'parent link="base_link"', b'parent link="x"', "joint 'left_track_j': no link 'x'"),
        (b"right_track", b"left_track", "line 1: link 'left_track': there are two of that name"),
    ],
)
def test_errors_name_the_line_and_the_element(tmp_path, old, new, text):
    with pytest.raises(InputError) as raised:
        found(tmp_path, tank_urdf().replace(old, new))
    assert str(raised.value) == f"{tmp_path / 'tank.xml'}{',' if 'line' in text else ':'} {text}"


def test_unknown_joints_and_angles_beyond_limits_are_refused(tmp_path):
    with pytest.raises(InputError, match=r"^joint 'front_lef_flipper_j' is not one that moves; did "
                       r"you mean front_left_flipper_j\?$"):  # fmt: skip
        found(tmp_path, tank_urdf(), joints={"front_lef_flipper_j": 0.1})
    text = tank_urdf().replace(b'type="continuous"', b'type="revolute"')
    with pytest.raises(InputError, match=r"= 4 rad is not within -3 to 3 rad$"):
        found(tmp_path, text, joints={"front_left_flipper_j": 4.0})


def test_circles_of_joints_and_two_parents_are_refused(tmp_path):
    links = "".join(urdf_link(name) for name in "abc")
    circle = urdf_joint("j", "fixed", "a", "b") + urdf_joint("k", "fixed", "b", "a")
    with pytest.raises(InputError, match=r"joint 'j' is part of a circle of joints$"):
        found(tmp_path, urdf(links, circle))
    two = urdf_joint("j", "fixed", "a", "c") + urdf_joint("k", "fixed", "b", "c")
    with pytest.raises(InputError, match="link 'c' hangs on two joints, 'j' and 'k'"):
        found(tmp_path, urdf(links, two))
