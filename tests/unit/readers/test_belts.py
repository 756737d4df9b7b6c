"""What a robot of a file stands on: a belt, what stands for one, or wheels that are none."""

import math

import pytest

import kaidan
from kaidan.errors import RefusedError
from kaidan.readers import found_in
from kaidan.readers.hints import Hints
from robot_files import (
    ACROSS,
    sdf_inertial,
    sdf_wheel,
    tank_sdf,
    tank_urdf,
    urdf,
    urdf_joint,
    urdf_link,
    urdf_shape,
)

SIDES = {"left": 0.2, "right": -0.2}


def found(tmp_path, content, **hints):
    path = tmp_path / "robot.xml"
    path.write_bytes(content)
    return found_in(path, Hints(**hints))


def robot(tmp_path, content, **hints):
    (one,) = found(tmp_path, content, **hints).robots
    return one


def refusal(tmp_path, content, **hints):
    (one,) = found(tmp_path, content, **hints).refusals
    return one


def places(count, pitch):
    return [pitch * (number - (count - 1) / 2) for number in range(count)]


def urdf_wheels(count, pitch, radius, aside=0.0):
    """Wheels of 60 mm width a side that turn; every second one so far outside the others."""
    parts = [urdf_link("base_link", 20.0, "0 0 0.1")]
    for side, y in SIDES.items():
        for number, x in enumerate(places(count, pitch)):
            name = f"{side}_{number}"
            shape = urdf_shape(f'<cylinder radius="{radius}" length="0.06"/>', rpy=ACROSS)
            parts.append(urdf_link(name, 0.5, shapes=shape))
            out = math.copysign(aside * (number % 2), y)
            parts.append(
                urdf_joint(f"{name}_j", "continuous", "base_link", name, f"{x} {y + out} 0")
            )
    return urdf(*parts)


def sdf_wheels(count, pitch, radius):
    parts = [f'<link name="base">{sdf_inertial(20.0, 0.0, 0.1)}</link>']
    for side, y in SIDES.items():
        for number, x in enumerate(places(count, pitch)):
            name = f"{side}_{number}"
            parts.append(
                f'<link name="{name}"><pose>{x} {y} 0 0 0 0</pose>{sdf_inertial(0.5)}'
                f'{sdf_wheel(radius)}</link><joint name="{name}_j" type="revolute">'
                f"<parent>base</parent><child>{name}</child><axis><xyz>0 1 0</xyz></axis></joint>"
            )
    return f'<sdf version="1.6"><model name="m">{"".join(parts)}</model></sdf>'.encode()


def mjcf_wheels(count, pitch, radius):
    parts = [
        f'<body name="{side}_{number}" pos="{x} {y} 0"><joint type="hinge" axis="0 1 0"/>'
        f'<geom type="cylinder" size="{radius} 0.03" euler="90 0 0" mass="0.5"/></body>'
        for side, y in SIDES.items()
        for number, x in enumerate(places(count, pitch))
    ]
    return (
        '<mujoco><worldbody><body name="base"><freejoint/>'
        '<inertial pos="0 0 0.1" mass="20" diaginertia="1 1 1"/>'
        f"{''.join(parts)}</body></worldbody></mujoco>"
    ).encode()


DIALECTS = {"URDF": urdf_wheels, "SDF": sdf_wheels, "MJCF": mjcf_wheels}


@pytest.mark.parametrize("wheels", DIALECTS.values(), ids=DIALECTS)
@pytest.mark.parametrize("pitch", [0.04, 0.15, 0.16])
def test_wheels_that_overlap_stand_for_a_belt_that_is_assumed(tmp_path, wheels, pitch):
    """Solid wheels of 80 mm radius touch at 160 mm: nearer ones could not turn."""
    one = robot(tmp_path, wheels(4, pitch, 0.08))
    assert one.figures["track.flat_length"].value == pytest.approx(3 * pitch)
    assert one.figures["track.drawn_as"].value == "wheels"
    assert one.notes[-1] == (
        "The file draws wheels alone. A belt over them is assumed: check that there is one."
    )
    assert one.robot().track.assumed_over == "wheels"


@pytest.mark.parametrize("wheels", DIALECTS.values(), ids=DIALECTS)
@pytest.mark.parametrize(("count", "pitch"), [(4, 0.17), (2, 0.5), (3, 0.25)])
def test_wheels_apart_from_one_another_are_no_track(tmp_path, wheels, count, pitch):
    refused = refusal(tmp_path, wheels(count, pitch, 0.08))
    assert str(refused) == (
        "It has wheels and no track: a nosing drops between wheels of 80 mm radius that stand "
        f"{1e3 * pitch:.0f} mm apart. If a belt runs over them, state it: "
        "--override track.belt=smooth."
    )


def test_wheels_in_different_planes_may_turn_beside_one_another(tmp_path):
    """100 mm apart along the robot, 160 mm in each of two planes that are 70 mm apart."""
    assert refusal(tmp_path, urdf_wheels(6, 0.10, 0.08, aside=0.07)).why == "wheels"


@pytest.mark.parametrize("wheels", DIALECTS.values(), ids=DIALECTS)
def test_a_belt_that_the_user_states_is_neither_refused_nor_assumed(tmp_path, wheels):
    one = robot(tmp_path, wheels(2, 0.5, 0.1), figures={"track.belt": "smooth"})
    assert one.figures["track.flat_length"].value == pytest.approx(0.5)
    track = one.robot().track
    assert (track.belt, track.assumed_over) == ("smooth", None)


def test_a_belt_that_is_stated_of_a_sheet_is_no_longer_assumed(tmp_path):
    sheet = robot(tmp_path, urdf_wheels(4, 0.15, 0.08)).robot()
    path = tmp_path / "own.toml"
    path.write_text(sheet.to_toml())
    asked = {"rise": 0.1, "going": 0.3, "steps": 4}
    stairs = kaidan.Stairs(name="low", **asked)
    question = kaidan.Question.of(str(path), stairs, friction=1.0)
    assert question.robot.track.assumed_over == "wheels"
    stated = kaidan.Question.of(str(path), stairs, friction=1.0, override="track.belt=smooth")
    assert stated.robot.track.assumed_over is None


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (
            urdf_wheels(4, 0.15, 0.08),
            "The file draws wheels alone. A belt over them is assumed: check that there is one.",
        ),
        (
            tank_urdf(flipper="", shapes=urdf_shape('<box size="0.5 0.1 0.18"/>')),
            "The file draws a box for each track. A belt round it is assumed, with square ends.",
        ),
        (tank_urdf(), ""),
    ],
    ids=["wheels", "box", "wheels and box of a track"],
)
def test_the_short_answer_says_what_is_assumed(tmp_path, content, said):
    path = tmp_path / "robot.urdf"
    path.write_bytes(content)
    stairs = kaidan.Stairs(name="low", rise=0.05, going=0.4, steps=3)
    answer = kaidan.assess(str(path), stairs, friction=1.0, flippers="stowed")
    assert answer.short().endswith("  belt assumed") == bool(said)
    lines = str(answer).splitlines()
    if said:
        first = 3 if answer.verdict == "rough" else 2  # after what is to be secured
        assert lines[first] == f"  assumed         {said}"
        assert answer.notes.count(said) == 1
    else:
        assert not any("assumed  " in line for line in lines)


# what has no track


def body(*shapes, name="body"):
    return urdf_link(name, 20.0, "0 0 0.1", shapes="".join(shapes))


@pytest.mark.parametrize(
    "content",
    [
        urdf(body(urdf_shape('<box size="0.5 0.4 0.2"/>'))),
        urdf(body(*(urdf_shape('<sphere radius="0.03"/>', f"{x} {y} -0.3")
                    for x in (0.3, -0.3) for y in (0.2, -0.2)))),
        urdf(body(urdf_shape('<mesh filename="hull.stl"/>'))),
        urdf(body(urdf_shape('<box size="0.02 0.02 0.02"/>'))),
        tank_urdf(flipper="leg", track="shoulder", shapes=""),
    ],
    ids=["a box", "four feet", "a mesh", "less than a sheet takes", "legs"],
)  # fmt: skip
def test_a_description_without_tracks_says_so_before_anything_else(tmp_path, content):
    path = tmp_path / "robot.urdf"
    path.write_bytes(content)
    with pytest.raises(RefusedError) as raised:
        kaidan.assess(str(path), "ibc")
    assert str(raised.value) == (
        f"{path}: holds no robot: It has no track: the file names and declares none, and draws no "
        "wheels that overlap. If the robot has belts, state them: --override track.belt=smooth."
    )


def test_a_steering_rod_is_no_track(tmp_path):
    """A rod that is called one lies 100 mm above the flat run from wheel to wheel."""
    rod = urdf_link("track_rod", 1.0, shapes=urdf_shape('<box size="0.02 0.5 0.02"/>'))
    joint = urdf_joint("rod_j", "fixed", "base_link", "track_rod", "0.2 0 0.1")
    wheels = urdf_wheels(2, 0.5, 0.1).decode().removesuffix("</robot>")
    assert refusal(tmp_path, f"{wheels}{rod}{joint}</robot>".encode()).why == "wheels"


def track_link(name, x, length, y, radius=0.1):
    ends = (length / 2, -length / 2)
    shapes = "".join(
        urdf_shape(f'<cylinder radius="{radius}" length="0.1"/>', f"{end} 0 0", ACROSS)
        for end in ends
    )
    return urdf_link(name, 5.0, shapes=shapes) + urdf_joint(
        f"{name}_j", "fixed", "base_link", name, f"{x} {y} 0"
    )


def test_a_half_track_is_no_track(tmp_path):
    """Wheels 0.5 m ahead of tracks of 0.4 m: the flat run reaches from wheel to track."""
    parts = [urdf_link("base_link", 20.0, "0 0 0.1")]
    for side, y in SIDES.items():
        parts.append(track_link(f"{side}_track", -0.2, 0.4, y))
        shape = urdf_shape('<cylinder radius="0.1" length="0.1"/>', rpy=ACROSS)
        parts.append(urdf_link(f"{side}_wheel", 1.0, shapes=shape))
        parts.append(urdf_joint(f"{side}_j", "continuous", "base_link", f"{side}_wheel",
                                f"0.5 {y} 0"))  # fmt: skip
    refused = refusal(tmp_path, urdf(*parts))
    assert (refused.why, refused.numbers["gap_mm"]) == ("wheels", pytest.approx(500.0))


def test_tracks_in_front_and_behind_leave_a_gap(tmp_path):
    """By hand: 0.3 m of track at each end of a flat run of 1.0 m leave its middle 0.4 m."""
    parts = [urdf_link("base_link", 20.0, "0 0 0.1")]
    for side, y in SIDES.items():
        parts += [track_link(f"{end}_{side}_track", x, 0.3, y)
                  for end, x in (("front", 0.35), ("rear", -0.35))]  # fmt: skip
    track = robot(tmp_path, urdf(*parts)).robot().track
    assert (track.flat_length, track.gap) == (pytest.approx(1.0), pytest.approx(0.4))
    assert track.assumed_over is None


def test_single_wheels_that_are_called_parts_of_a_track_have_its_belt(tmp_path):
    parts = [urdf_link("base_link", 20.0, "0 0 0.1")]
    for side, y in SIDES.items():
        for end, x in (("front", 0.3), ("rear", -0.3)):
            name = f"{side}_track_{end}_wheel"
            shape = urdf_shape('<cylinder radius="0.1" length="0.1"/>', rpy=ACROSS)
            parts.append(urdf_link(name, 2.0, shapes=shape))
            parts.append(urdf_joint(f"{name}_j", "fixed", "base_link", name, f"{x} {y} 0"))
    track = robot(tmp_path, urdf(*parts)).robot().track
    assert (track.flat_length, track.gap, track.assumed_over) == (pytest.approx(0.6), 0.0, None)


# flippers that are locked


LOCKED = (
    "Locked flippers, whose joints have no travel: front_left_flipper_j, rear_left_flipper_j, "
    "front_right_flipper_j, rear_right_flipper_j. They are judged at the angle of the file."
)


def locked_urdf():
    text = tank_urdf().replace(b'type="continuous"', b'type="revolute"')
    return text.replace(b'lower="-3" upper="3"', b'lower="0" upper="0"')


@pytest.mark.parametrize(
    "content",
    [
        locked_urdf(),
        tank_urdf().replace(b'type="continuous"', b'type="fixed"'),
        tank_sdf().replace(b"-1e16", b"0").replace(b"1e16", b"0"),
    ],
    ids=["limits", "fixed", "SDF"],
)
def test_flippers_without_travel_are_named_and_judged_where_they_are(tmp_path, content):
    """By hand: tips of 30 mm, 90 mm up and 300 mm ahead of pivots at the ends of the flat run."""
    one = robot(tmp_path, content)
    assert LOCKED in one.notes
    assert one.gear.flippers == {}
    assert [wheel["from_front"] for wheel in one.figures["track.wheels"].value] == [
        pytest.approx(-0.3), pytest.approx(0.8),
    ]  # fmt: skip


def test_the_bracket_of_a_flipper_that_moves_is_not_locked(tmp_path):
    """A mount that is called a flipper's, fixed to the body, holds the joint that moves it."""
    mount = urdf_link("flipper_mount", 0.5, shapes=urdf_shape('<box size="0.2 0.1 0.05"/>'))
    joint = urdf_joint("flipper_mount_j", "fixed", "base_link", "flipper_mount", "0.1 0 0.1")
    one = robot(tmp_path, tank_urdf(more=mount + joint).replace(
        b'<parent link="base_link"/><child link="front_left_flipper"/>',
        b'<parent link="flipper_mount"/><child link="front_left_flipper"/>'))  # fmt: skip
    assert not any("no travel" in note for note in one.notes)
