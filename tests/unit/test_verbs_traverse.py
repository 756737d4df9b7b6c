"""The traverse as data and pictures: forces balance, poses thinned, repeats told once, films."""

import math
from io import BytesIO
from pathlib import Path
from types import SimpleNamespace

import jsonschema
import numpy as np
import pytest

import kaidan
from contact_cases import vector
from kaidan import films
from kaidan.contact import Contact, PartKind, Placement
from kaidan.errors import InputError, MissingExtraError
from kaidan.figures import animation, saving
from kaidan.figures.pose_map_figure import pose_map_figure
from kaidan.figures.side_view import hull, reach
from kaidan.figures.traverse_figure import traverse_figure
from kaidan.figures.traverse_side import chosen
from kaidan.question import Question
from kaidan.terrain.stairs import Stairs
from kaidan.text.event_log import lines_of
from kaidan.traversal.contact_forces import contact_forces
from kaidan.verbs.pose_map import PoseMap, pose_map
from kaidan.verbs.traverse import driven, traverse_report
from kaidan.verbs.traverse_report import LogEntryShown, PartShown, PlaceShown, TraverseReport

FLIGHT = Stairs(name="short", rise=0.178, going=0.279, steps=4)


MARMOTTE, KENAF = (Question.in_one_posture(name, FLIGHT) for name in ("marmotte", "kenaf"))


@pytest.fixture(scope="module")
def passages():
    return {each.robot.name: driven(each) for each in (MARMOTTE, KENAF)}


@pytest.fixture(scope="module")
def marmotte(passages):
    return traverse_report(MARMOTTE, passages["marmotte"])


@pytest.fixture(scope="module")
def kenaf(passages):
    return traverse_report(KENAF, passages["kenaf"])


@pytest.mark.parametrize("who", ["marmotte", "kenaf"])
def test_forces_balance_the_weight(who, passages):
    passage = passages[who]
    path = passage.path
    for row in range(0, len(path.poses), 37):
        forces = [force for force in contact_forces(passage, row, 0.0) if force.load]
        steepest = max(abs(force.traction / force.load) for force in forces)
        assert steepest <= path.margins.required_friction[row] + 1e-6
        # statics by hand: forces sum to the weight, moments about the centroid to nothing
        total = np.sum([vector(force) for force in forces], axis=0)
        assert total == pytest.approx([0.0, 9.80665], abs=1e-6)
        moment = sum(
            (f.point[0] - path.x[row]) * vector(f)[1] - (f.point[1] - path.z[row]) * vector(f)[0]
            for f in forces
        )
        assert moment == pytest.approx(0.0, abs=1e-6)


def test_two_contacts_on_a_plane_do_not_pull_against_each_other():
    """Where one of them bears next to nothing, any force along the plane would do."""
    plane, place = (-math.sin(0.3), math.cos(0.3)), Placement(0.0, 0.1, 0.3)
    # gravity's line meets the plane a hundredth of a millimetre ahead of the front one
    touched = [
        Contact((x, x * math.tan(0.3)), plane, 0, 0.0, PartKind.TRACK) for x in (-0.3, -1e-5)
    ]
    path = SimpleNamespace(
        margins=SimpleNamespace(tilt=[0.0], required_friction=[math.tan(0.3)]),
        poses=SimpleNamespace(placement=lambda row: place, path_direction=[0.3]),
        contacts_at=lambda place: touched, carrying=lambda row: touched,
    )  # fmt: skip
    rear, front = contact_forces(SimpleNamespace(path=path, descending=False), 0, 0.0)
    assert vector(rear) == pytest.approx((0.0, -9.80665 * 1e-5 / 0.3), abs=1e-7)
    assert vector(front) == pytest.approx((0.0, 9.80665), abs=1e-3)
    assert front.traction / front.load == pytest.approx(math.tan(0.3), abs=1e-6)


def test_more_than_two_contacts_on_a_plane_are_equal_springs():
    """docs/theory/loads.md: N_i = W cos(theta) [1/m + (x_z - mean)(x_i - mean) / sum]."""
    question = Question.in_one_posture("kenaf", Stairs.inclined(angle=0.3, nosing_spacing=0.150))
    passage = driven(question)
    path = passage.path
    rows = np.flatnonzero((path.margins.contacts == 4) & (passage.phase_of_pose == "traverse"))
    row = int(rows[1])  # at the first the tail still touches the floor
    forces, c, s = contact_forces(passage, row, 0.0), math.cos(0.3), math.sin(0.3)
    assert len(forces) == 4
    x = np.array([(f.point[0] - path.x[row]) * c + (f.point[1] - path.z[row]) * s for f in forces])
    gravity_line = -0.071 * s / c  # Kenaf's C_N tan(theta) behind the foot of the centroid
    apart = x - x.mean()
    shares = 1 / 4 + (gravity_line - x.mean()) * apart / (apart**2).sum()
    assert (shares > 0).all()
    np.testing.assert_allclose([f.load for f in forces], 9.80665 * c * shares, rtol=1e-9)
    shown = traverse_report(question, passage).poses
    assert len(shown.forces) == len(shown.x_m)
    for each in shown.forces:
        up = sum(f.load_over_weight * f.normal_z - f.traction_over_weight * f.normal_x
                 for f in each)  # fmt: skip
        assert up == pytest.approx(1.0, abs=1e-9)  # the weight


def test_poses_are_thinned_but_not_where_it_matters(passages, marmotte):
    path, poses = passages["marmotte"].path, marmotte.poses
    assert poses.of == len(path.poses)
    assert len(poses.path_m) <= 500
    assert list(poses.path_m) == sorted(poses.path_m)
    few = traverse_report(MARMOTTE, passages["marmotte"], most=50).poses
    assert len(few.path_m) <= 50
    assert few.x_m[few.governing_row] == poses.x_m[poses.governing_row]
    for name in ("required_friction", "inclination_deg"):
        assert max(getattr(few, name)) == max(getattr(poses, name))
    assert max(few.required_friction) == path.margins.required_friction.max()
    assert marmotte.assessment.contact.grades.arrested is True
    assert len(marmotte.profile.nosings_m) == 4


def test_rotations_begin_at_a_listed_pose_and_end_where_the_next_line_begins(marmotte):
    poses = marmotte.poses
    assert marmotte.rotations
    for rotation in marmotte.rotations:
        first, last = rotation.placements[0], rotation.placements[-1]
        row = rotation.row
        assert (first.x_m, first.z_m) == pytest.approx((poses.x_m[row], poses.z_m[row]), abs=1e-9)
        assert poses.leg[row + 1] == poses.leg[row] + 1
        assert last.x_m == pytest.approx(poses.x_m[row + 1], abs=1e-9)
        turned = last.inclination_deg - first.inclination_deg
        assert abs(turned) == pytest.approx(rotation.angle_deg, abs=1e-9)


@pytest.mark.parametrize("who", ["marmotte", "kenaf"])
def test_an_answer_read_back_is_equal_and_fits_its_schema(who, request):
    found = request.getfixturevalue(who)
    assert TraverseReport.from_json(found.to_json()) == found
    jsonschema.validate(found.to_dict(), TraverseReport.json_schema())
    assert kaidan.traverse(who, FLIGHT, flippers="stowed") == found


def test_figures_of_an_answer_read_back_are_the_same(kenaf):
    again = TraverseReport.from_json(kenaf.to_json())
    one, other = (saving.figure_bytes(traverse_figure(each), "svg") for each in (kenaf, again))
    assert one == other


def test_the_hull_of_two_discs():
    # limit: a stadium reaches its radius beyond both centres
    part = PartShown(
        kind="track", x_1_m=-0.3, z_1_m=0.0, radius_1_m=0.1, x_2_m=0.2, z_2_m=0.0, radius_2_m=0.1
    )
    points = hull(part)
    assert points[:, 0].min() == pytest.approx(-0.4, abs=1e-12)
    assert points[:, 0].max() == pytest.approx(0.3, abs=1e-12)
    assert points[:, 1].min() == pytest.approx(-0.1, abs=1e-12)


def _entry(step, kind="passes"):
    return LogEntryShown(
        kind=kind, phase="traverse", step=step, path_m=0.3 * step, row=0, inclination_deg=32.5,
        rotation_deg=0.0, places=[PlaceShown(what="nosing", number=step, part="track")],
        text=f"to {step}",
    )  # fmt: skip


def test_what_repeats_is_told_once():
    lines = lines_of(tuple(_entry(step) for step in range(2, 11)))
    assert len(lines) == 2
    assert lines[0].endswith("to 2")
    assert lines[1].strip() == "steps 3 to 10: the same"
    by_two = lines_of(tuple(_entry(step) for step in (2, 4, 6, 8)))
    assert by_two[1].strip() == "steps 4 to 8 by 2: the same"
    uneven = lines_of(tuple(_entry(step) for step in (1, 4, 5, 9)))
    assert len(uneven) == 4


def test_never_hundreds_of_lines():
    entries = tuple(_entry(step, f"kind {step}") for step in range(300))
    lines = lines_of(entries, most=60)
    assert len(lines) == 60
    assert any("241 more lines" in line for line in lines)


def test_poses_do_not_hide_each_other(marmotte, kenaf):
    for found in (marmotte, kenaf):
        shown = chosen(found, None)
        assert shown[0].style == "strong"
        length = sum(reach(found.outline))
        for i, one in enumerate(shown):
            for other in shown[:i]:
                apart = math.dist(one.stand[:2], other.stand[:2])
                assert apart >= 0.5 * length - 1e-9
    assert len(chosen(marmotte, 2)) == 2


@pytest.mark.parametrize("form", ["png", "svg", "pdf"])
def test_figures_are_valid_and_the_same_again(marmotte, kenaf, form):
    begins = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}[form]
    for found in (marmotte, kenaf):
        content = saving.figure_bytes(traverse_figure(found), form)
        assert content.startswith(begins)
    assert saving.figure_bytes(traverse_figure(kenaf), form) == content


def test_the_pose_map_agrees_with_the_driven_path(passages):
    found = pose_map(MARMOTTE, passages["marmotte"], columns=120, rows=91)
    path = passages["marmotte"].path
    step = found.inclination_deg[1] - found.inclination_deg[0]
    stable = [np.array([line.x_m, line.inclination_deg]) for line in found.stable]
    for x in found.x_m[::7]:
        row = int(np.argmin(np.abs(path.x - x)))
        valleys = [line[1][np.abs(line[0] - x) < 1e-9] for line in stable]
        if abs(path.x[row] - x) > 2e-3 or path.poses.leg[row] == 0:
            continue
        # the driven pose is a valley of the map, to the grid's step and 2 mm along
        off = np.abs(np.concatenate(valleys) - math.degrees(path.inclination[row]))
        assert off.min() < 2 * step
    assert np.min(found.height_mm) == 0.0
    assert saving.figure_bytes(pose_map_figure(found), "png").startswith(b"\x89PNG")
    assert PoseMap.from_json(found.to_json()) == found
    assert str(found).startswith("Pose map of marmotte on short, up nose first: 120 places")


def test_the_film_ends_where_the_way_ends(kenaf, marmotte):
    frames = animation.frames_of(marmotte)
    assert len(frames) <= (animation.LONGEST + 8) * animation.FRAMES_PER_SECOND
    poses = marmotte.poses
    end = (poses.x_m[-1], poses.z_m[-1], math.radians(poses.inclination_deg[-1]))
    assert frames[-1].stand == pytest.approx(end, abs=1e-12)
    assert any(frame.rotating for frame in frames)
    assert animation.frames_of(kenaf)[-1].stand.phi > math.radians(100)  # it has fallen


def test_a_gif_is_whole(kenaf, monkeypatch):
    from PIL import Image

    monkeypatch.setattr(animation, "frames_of", lambda _, whole=animation.frames_of: whole(_)[::40])
    with Image.open(BytesIO(animation.film_of(kenaf, ".gif"))) as film:
        assert film.n_frames > 1
        assert film.info["duration"] == 40


def test_films_that_cannot_be_made(monkeypatch):
    with pytest.raises(InputError, match=r"unknown suffix '\.avi'; known: \.mp4, \.gif"):
        films.film_format(Path("way.avi"), "animation")
    monkeypatch.setattr(films, "find_spec", lambda _: None)
    with pytest.raises(MissingExtraError) as raised:
        films.film_format(Path("way.mp4"), "animation")
    assert str(raised.value) == (
        "a film as .mp4 needs an optional package: pip install 'kaidan[video]'"
    )
    with pytest.raises(InputError, match="video: there is no picture to show"):
        films.film_bytes([], ".gif", what="video")


def test_the_picture_shows_the_energy_margin_that_the_table_tells():
    """Of the flight it is that of any rotation, arrested or not, and less than that of any pose."""
    found = kaidan.traverse("absolem", "ibc", flippers="flat", friction=1.2)
    figures = found.assessment.contact
    assert figures is not None
    told = {each.phase: each.energy_margin_mm for each in figures.phases}["traverse"]
    drawn = saving.figure_bytes(traverse_figure(found), "svg").decode()
    poses = zip(found.poses.phase, found.poses.energy_margin_mm, strict=True)
    assert told < min(value for phase, value in poses if phase == "traverse")
    assert f"{told:.1f} mm for any rotation, arrested or not" in drawn


def test_what_a_late_phase_is_judged_by_is_told_within_the_picture():
    plan = {"flippers": "35deg,-41deg/traverse:-7deg,-10deg/land:-68deg,-20deg"}
    found = kaidan.traverse("absolem", "ibc", friction=0.73, **plan)
    figure = traverse_figure(found)
    figure.canvas.draw()
    (told,) = (
        text
        for axes in figure.axes
        for text in axes.texts
        if "for any rotation, arrested or not" in text.get_text()
    )
    label, whole = told.get_window_extent(), told.axes.get_window_extent()
    assert whole.x0 <= label.x0 < label.x1 <= whole.x1
