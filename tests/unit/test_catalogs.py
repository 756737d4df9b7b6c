"""The catalogues hold the published figures, and the loader refuses what is no sheet."""

import math
import os
from pathlib import Path

import pytest

from kaidan import catalog
from kaidan.errors import InputError, UnknownNameError
from kaidan.robot import Posture, Robot
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs

# L, C_L, C_N, R front, R rear [mm], mass [kg]: the table of kaidan's fact sheet, row by row.
ROBOTS = {
    "kenaf": (470, 196, 71, 65, 65, None),
    "absolem": (500, 279, 184, 89, 89, 38.7),
    "absolem-flat": (1141, 599, 180, 29, 29, 38.7),
    "marv": (512, 254, 161, 116.5, 116.5, 60.4),
    "ozbot-atr": (1045, 438, 308, 140, 110, 146.3),
    "csiro-dtr": (518, 155, 159, 64, 84, 37.8),
    "superdroid-hd2": (720, 358, 172, 129, 129, 34.0),
    "marmotte": (720, 344, 155, 129, 129, 51.5),
}
# Steepest angle [deg] and nosing spacing [mm]: the fact sheet's table; where it has no row
# (the UK's and DIN's other classes, the two real flights), atan(R/G) and hypot(R, G) by hand.
STAIRS = {
    "ibc": (32.5, 331),
    "ibc-dwelling": (37.8, 321),
    "ada": (32.7, 333),
    "osha": (45.0, 341),
    "osha-ship": (70.0, 325),
    "uk-private": (42.0, 329),
    "uk-utility": (37.2, 314),
    "uk-general": (34.2, 302),
    "din-dwelling": (41.0, 305),
    "din-general": (36.2, 322),
    "iso-14122-3": (45.0, 297),
    "japan-dwelling": (56.9, 275),
    "nist-arena": (40.7, 307),
    "schependomlaan": (40.4, 289),
}
CODES = {
    # rise [mm] from, to; going [mm] from, to; slope [deg] to; 2 R + G [mm] from, to
    "ibc": ((102, 178), (279, 1e4), 90, (0, 1e4)),
    "ibc-dwelling": ((0, 197), (254, 1e4), 90, (0, 1e4)),
    "ada": ((100, 180), (280, 1e4), 90, (0, 1e4)),
    "osha": ((0, 241), (241, 1e4), 50, (0, 1e4)),
    "osha-ship": ((165, 305), (100, 1e4), 70, (0, 1e4)),
    "uk-private": ((150, 220), (220, 300), 42, (550, 700)),
    "uk-utility": ((150, 190), (250, 400), 90, (550, 700)),
    "uk-general": ((150, 170), (250, 400), 90, (550, 700)),
    "din-dwelling": ((140, 200), (230, 370), 90, (0, 1e4)),
    "din-general": ((140, 190), (260, 370), 90, (0, 1e4)),
    "iso-14122-3": ((0, 1e4), (210, 310), 45, (600, 660)),
    "japan-dwelling": ((0, 230), (150, 1e4), 90, (0, 1e4)),
}


def test_the_tables_here_are_complete():
    assert set(ROBOTS) == set(catalog.names("robots"))
    assert set(STAIRS) == set(catalog.names("stairs"))
    assert set(catalog.names("surfaces")) == {"concrete-dry", "concrete-wet", "petg-on-plywood"}


@pytest.mark.parametrize("name", ROBOTS)
def test_robots_have_the_published_figures(name):
    robot = Robot.named(name)
    track = robot.track
    lengths = (
        track.flat_length,
        robot.com_from_front,
        robot.com_height,
        track.front_radius,
        track.rear_radius,
    )
    assert (*(round(1e3 * length, 6) for length in lengths), robot.mass) == ROBOTS[name]


def test_absolem_is_what_its_model_s_links_sum_to():
    """By hand from model.sdf: base, laser, tracks and four flippers of 0.75 kg turned up."""
    base = (22.4783, -0.062088, 0.166362)
    laser = (1.1, 0.2502, 0.1807)
    track = (6.06, 0.0, 0.01408)
    pivot_x, pivot_z, arm = 0.25, 0.0195, 0.08
    flippers = [(0.75, x, pivot_z + arm) for x in (pivot_x, pivot_x, -pivot_x, -pivot_x)]
    links = [base, laser, track, track, *flippers]
    mass = sum(m for m, _, _ in links)
    com_x = sum(m * x for m, x, _ in links) / mass
    com_z = sum(m * z for m, _, z in links) / mass
    underside = 0.01855 - 0.089
    robot = Robot.named("absolem")
    # 1 mm and 0.1 kg: the sheet gives as many digits
    assert robot.mass == pytest.approx(mass, abs=0.05)
    assert robot.com_from_front == pytest.approx(0.25 - com_x, abs=0.5e-3)
    assert robot.com_height == pytest.approx(com_z - underside, abs=0.5e-3)


def test_absolem_laid_flat_lies_within_a_centimetre_of_the_published_row():
    """The row reads the hull of the model's boxes, the sheet the discs: 8 mm apart in L."""
    flat = Robot.named("absolem").stance(Posture(front="flat", rear="flat"))
    row = Robot.named("absolem-flat")
    assert flat.flat_length == pytest.approx(0.5 + 2 * math.sqrt(0.33**2 - 0.06**2))
    assert flat.flat_length == pytest.approx(row.track.flat_length, abs=0.009)
    assert flat.com_from_front == pytest.approx(row.com_from_front, abs=0.005)
    assert flat.com_height == pytest.approx(row.com_height, abs=0.004)


@pytest.mark.parametrize("name", STAIRS)
def test_stairs_have_the_published_angle_and_spacing(name):
    stairs = Stairs.named(name)
    angle, spacing = STAIRS[name]
    # as many digits as the table prints: 0.1 deg, 1 mm
    assert math.degrees(stairs.angle) == pytest.approx(angle, abs=0.05)
    assert 1e3 * stairs.nosing_spacing == pytest.approx(spacing, abs=0.5)


@pytest.mark.parametrize("name", CODES)
def test_the_steepest_flight_keeps_its_code_and_a_steeper_one_would_not(name):
    rises, goings, slope, formula = CODES[name]
    stairs = Stairs.named(name)

    def allowed(rise, going):
        return (
            rises[0] - 1e-9 <= rise <= rises[1] + 1e-9
            and goings[0] - 1e-9 <= going <= goings[1] + 1e-9
            and math.degrees(math.atan2(rise, going)) <= slope + 1e-9
            and formula[0] - 1e-9 <= 2 * rise + going <= formula[1] + 1e-9
        )

    rise, going = 1e3 * stairs.rise, 1e3 * stairs.going
    assert allowed(rise, going)
    # 0.2 mm: the two flights set by a slope limit round their going up to 0.1 mm
    assert not allowed(rise + 0.2, going - 0.2)
    assert not allowed(rise, going - 0.2) or not allowed(rise + 0.2, going)


def test_only_the_flights_without_riser_boards_are_open():
    open_ones = {name for name in STAIRS if Stairs.named(name).open_risers}
    assert open_ones == {"osha-ship", "nist-arena"}


def test_real_flights_have_their_counted_risers():
    nist, precast = Stairs.named("nist-arena"), Stairs.named("schependomlaan")
    assert nist.step_rises == (0.230, 0.2, 0.2, 0.2, 0.2)
    assert precast.step_rises == (0.1875,) * 8


def test_surfaces_have_the_published_ranges():
    ranges = {
        name: (Surface.named(name).friction_low, Surface.named(name).friction_high)
        for name in catalog.names("surfaces")
    }
    assert ranges == {
        "concrete-dry": (0.6, 1.0),
        "concrete-wet": (0.25, 0.75),
        "petg-on-plywood": (0.0, 0.18),
    }


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("superdroid-hd2", ["55 mm to the side", "swapped"]),
        ("csiro-dtr", ["about 30 kg", "37.8 kg"]),
        ("marv", ["no main track", "closed form"]),
        ("absolem-flat", ["hull", "absolem --flippers flat", "discs"]),
        ("kenaf", ["not published", "inferred"]),
        ("marmotte", ["assumption"]),
    ],
)
def test_doubtful_robots_say_so(name, words):
    notes = " ".join(Robot.named(name).notes.replace("`", "").split())
    for word in words:
        assert word in notes


@pytest.mark.parametrize("name", ROBOTS)
def test_no_uncertainty_without_a_source(name):
    assert Robot.named(name).uncertainty == type(Robot.named(name).uncertainty)()


def test_case_and_blanks_around_a_name_do_not_matter():
    assert Robot.named(" Kenaf ") == Robot.named("kenaf")


def test_a_sheet_in_the_folder_whose_name_lacks_its_ending(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "crawler.toml").write_text("")
    with pytest.raises(InputError) as caught:
        Robot.named("crawler")
    assert str(caught.value) == "crawler: no such file. Did you mean crawler.toml?"


def test_unknown_names_list_the_known_ones():
    with pytest.raises(UnknownNameError) as caught:
        Surface.named("concrete-dri")
    assert str(caught.value) == (
        "no surface is called 'concrete-dri' and no such file exists. Did you mean 'concrete-dry'? "
        "Known: concrete-dry, concrete-wet, petg-on-plywood."
    )


@pytest.mark.parametrize(
    ("kind", "name", "meant"),
    [
        (Robot, "packbot", "'packbot-510'"),
        (Robot, "iRobot PackBot 510", "'packbot-510'"),
        (Robot, "marmote", "'marmotte'"),
        (Stairs, "UK", "'uk-general' or 'uk-private' or 'uk-utility'"),
        (Stairs, "osha ship", "'osha-ship'"),
    ],
)
def test_a_part_of_a_name_finds_the_names_that_have_it(kind, name, meant):
    with pytest.raises(UnknownNameError, match=rf" Did you mean {meant}\? Known: "):
        kind.named(name)


def test_a_gross_robot_says_why_it_cannot_be_judged():
    with pytest.raises(InputError) as caught:
        Robot.named("teodor")
    assert str(caught.value) == (
        "tEODor: neither length nor centroid is published, so no margin can be computed; "
        "measure the robot: kaidan measure robot --help"
    )


def test_robots_that_nobody_weighed_have_sheets_and_others_gross_figures():
    assert set(catalog.gross_robots()) == {"teodor", "athena", "sakura-2", "survey-runner"}
    assert catalog.names("unweighed") == ("packbot-510", "quince", "talon", "taurob-tracker")


SURFACE = "friction_low = 0.5\nfriction_high = 0.6\n"


@pytest.mark.parametrize(
    "name", ["plain.toml", "with space.toml", "階段.toml", "no-suffix", "UPPER.TOML", "a.b.c.toml"]
)
def test_any_file_name_will_do(tmp_path, name):
    path = tmp_path / name
    path.write_text(SURFACE, encoding="utf-8")
    assert Surface.named(str(path)).friction_high == 0.6


@pytest.mark.parametrize(
    "content",
    [
        SURFACE.encode("utf-8-sig"),
        SURFACE.replace("\n", "\r\n").encode(),
        ('title = "Straße, 石, Ω"\n' + SURFACE).encode(),
    ],
    ids=["byte order mark", "Windows line ends", "unicode"],
)
def test_files_of_any_editor_will_do(tmp_path, content):
    path = tmp_path / "mine.toml"
    path.write_bytes(content)
    assert Surface.named(str(path)).friction_low == 0.5


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"\x89PNG\r\n\x1a\n\x00\xff", "cannot be read: not UTF-8 text"),
        (SURFACE.encode("utf-16"), "cannot be read: not UTF-8 text"),
        (b"\x00" * 40, "not valid TOML: Invalid statement (at line 1, column 1)"),
        (b"#" * 1_000_001, "cannot be read: larger than 1 MB, so not a sheet"),
        (b"a = " + b"[" * 50_000, "not a sheet: tables or lists nested too deeply"),
        (b"a = " + b"9" * 50_000, "not a sheet: a number with too many digits"),
        (
            b"",
            "surface: friction_low is missing (smallest static friction); "
            "surface: friction_high is missing (largest static friction)",
        ),
    ],
    ids=["binary", "UTF-16", "zeros", "huge", "deep", "digits", "empty"],
)
def test_what_is_no_sheet_is_refused(tmp_path, content, reason):
    path = tmp_path / "bad.toml"
    path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        Surface.named(str(path))
    assert str(caught.value) == f"{path}: {reason}"


def test_folders_and_devices_are_refused(tmp_path):
    with pytest.raises(InputError) as caught:
        Robot.named(str(tmp_path))
    assert str(caught.value) == f"{tmp_path}: cannot be read: a folder, not a TOML file"
    if os.path.exists("/dev/null"):
        with pytest.raises(InputError) as caught:
            Robot.named("/dev/null")
        assert str(caught.value) == "/dev/null: cannot be read: not a regular file"


@pytest.mark.parametrize(
    "name",
    ["", " ", "\x00", "a\nb", "x" * 5000, "con", "\ud800"],
)
def test_odd_names_are_unknown_names(name):
    with pytest.raises(UnknownNameError) as caught:
        Robot.named(name)
    assert repr(name)[:50] in str(caught.value)
    assert len(str(caught.value)) < 300
    assert str(caught.value).isprintable()


@pytest.mark.parametrize("name", ["stairs.toml", "no/such/file", "./kenaf", "C:\\x.toml"])
def test_a_missing_path_is_no_unknown_name(name):
    for kind in (Robot, Stairs, Surface):
        with pytest.raises(InputError) as caught:
            kind.named(name)
        assert str(caught.value) == f"{name}: no such file"


def test_a_name_of_another_catalogue():
    with pytest.raises(UnknownNameError, match=r"^no robot is called 'ibc' and no such file "):
        Robot.named("ibc")
    with pytest.raises(UnknownNameError, match=r"exists, but a robot is. Known: "):
        Stairs.named("kenaf")


@pytest.mark.parametrize("given", ["robot", "staircase", "surface"])
@pytest.mark.parametrize("wanted", ["robot", "staircase", "surface"])
def test_a_sheet_of_another_kind_is_told(given, wanted, tmp_path):
    kinds = {"robot": Robot, "staircase": Stairs, "surface": Surface}
    sheets = {"robot": "kenaf", "staircase": "ibc", "surface": "concrete-dry"}
    path = tmp_path / "sheet.toml"
    path.write_text(kinds[given].named(sheets[given]).to_toml(), encoding="utf-8")
    if given == wanted:
        kinds[wanted].named(str(path))
        return
    with pytest.raises(InputError) as caught:
        kinds[wanted].named(str(path))
    assert str(caught.value) == f"{path}: is the sheet of a {given}, not of a {wanted}"


def test_a_sheet_with_units(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(
        'rises = ["180mm", "7 1/2in", 0.18]\ngoings = ["28cm", "11\\""]\n'
        'uncertainty = { angle = "0.5deg" }\n',
        encoding="utf-8",
    )
    flight = Stairs.named(str(path))
    assert flight.rises == (0.18, 0.1905, 0.18)
    assert flight.goings == pytest.approx((0.28, 0.2794), rel=1e-15)
    assert flight.uncertainty.angle == pytest.approx(math.radians(0.5), rel=1e-15)
    path.write_text('rise = "180"\ngoing = "0.28kg"\n', encoding="utf-8")
    with pytest.raises(InputError) as caught:
        Stairs.named(str(path))
    assert str(caught.value) == (
        f"{path}: stairs: rise = '180' has no unit; write 180mm or 180cm or 180m; "
        "stairs: going = '0.28kg': 'kg' is no unit of length; known: mm, cm, m, in, ft"
    )


def test_a_file_nobody_may_read(tmp_path, monkeypatch):
    path = tmp_path / "secret.toml"
    path.write_text(SURFACE)

    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "read_text", refuse)
    with pytest.raises(InputError) as caught:
        Surface.named(str(path))
    assert str(caught.value) == f"{path}: cannot be read: Permission denied"


def test_a_line_break_in_a_file_name_stays_out_of_the_message(tmp_path):
    path = tmp_path / "a\nb.toml"
    try:
        path.write_text("x = ")
    except OSError:
        pytest.skip("this file system knows no such name")
    with pytest.raises(InputError) as caught:
        Surface.named(str(path))
    assert "\n" not in str(caught.value)
