"""The traverse as data and pictures: forces balance, poses thinned, repeats told once, films."""

import json
import math
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest

from kaidan.assessment import case_of
from kaidan.errors import InputError, MissingExtraError
from kaidan.report import animation, files
from kaidan.report.journey import journey
from kaidan.report.landscape import landscape_of
from kaidan.report.landscape_figure import landscape_figure
from kaidan.report.moves import Move, lines_of
from kaidan.report.side_view import hull
from kaidan.report.traverse_figure import chosen, traverse_figure
from kaidan.stairs import Stairs

pytestmark = pytest.mark.usefixtures("compiled_kernel")

FLIGHT = Stairs(name="short", rise=0.178, going=0.279, steps=4)


@pytest.fixture(scope="module")
def marmotte():
    return journey(case_of("marmotte", FLIGHT))


@pytest.fixture(scope="module")
def kenaf():
    return journey(case_of("kenaf", FLIGHT))


def test_forces_balance_the_weight(marmotte):
    run = marmotte.found.run
    for row in range(0, len(run.poses), 37):
        forces = [force for force in marmotte.forces_at(row) if force.load]
        assert max(abs(f.traction / f.load) for f in forces) <= run.margins[row, 0] + 1e-6
        # statics by hand: forces sum to the weight, moments about the centroid to nothing
        total = np.sum([force.vector for force in forces], axis=0)
        assert total == pytest.approx([0.0, 9.80665], abs=1e-6)
        moment = sum(
            (f.point[0] - run.x[row]) * f.vector[1] - (f.point[1] - run.z[row]) * f.vector[0]
            for f in forces
        )
        assert moment == pytest.approx(0.0, abs=1e-6)


def test_json_thins_the_poses(marmotte):
    found = json.loads(files.json_text(marmotte.as_dict()))
    table = found["poses"]
    assert table["of"] == len(marmotte.found.run.poses)
    assert len(table["rows"]) <= 500
    assert {len(row) for row in table["rows"]} == {len(table["columns"])}
    assert table["columns"][0] == {"name": "way", "unit": "m"}
    assert [row[0] for row in table["rows"]] == sorted(row[0] for row in table["rows"])
    assert len(marmotte.thinned(50)) <= 50
    assert marmotte.governing_row in marmotte.thinned(50)
    assert found["grades"]["caught"] is True
    assert len(found["profile"]["nosings_m"]) == 4


def test_the_hull_of_two_discs():
    # limit: a stadium reaches its radius beyond both centres
    points = hull(np.array([-0.3, 0.0, 0.1, 0.2, 0.0, 0.1]))
    assert points[:, 0].min() == pytest.approx(-0.4, abs=1e-12)
    assert points[:, 0].max() == pytest.approx(0.3, abs=1e-12)
    assert points[:, 1].min() == pytest.approx(-0.1, abs=1e-12)


def _move(step, kind="passes"):
    return Move(kind, "traverse", 0.3 * step, 32.5, f"to {step}", step, (kind,))


def test_what_repeats_is_told_once():
    lines = lines_of(tuple(_move(step) for step in range(2, 11)))
    assert len(lines) == 2
    assert lines[0].endswith("to 2")
    assert lines[1].strip() == "steps 3 to 10: the same"
    by_two = lines_of(tuple(_move(step) for step in (2, 4, 6, 8)))
    assert by_two[1].strip() == "steps 4 to 8 by 2: the same"
    uneven = lines_of(tuple(_move(step) for step in (1, 4, 5, 9)))
    assert len(uneven) == 4


def test_never_hundreds_of_lines():
    moves = tuple(_move(step, f"kind {step}") for step in range(300))
    lines = lines_of(moves, most=60)
    assert len(lines) == 60
    assert any("241 more lines" in line for line in lines)


def test_poses_do_not_hide_each_other(marmotte, kenaf):
    for found in (marmotte, kenaf):
        shown = chosen(found, None)
        assert shown[0].style == "strong"
        length = sum(found.found.outline.reach)
        for i, one in enumerate(shown):
            for other in shown[:i]:
                apart = math.dist(one.stand[:2], other.stand[:2])
                assert apart >= 0.5 * length - 1e-9
    assert len(chosen(marmotte, 2)) == 2


@pytest.mark.parametrize("form", ["png", "svg", "pdf"])
def test_figures_are_valid_and_the_same_again(marmotte, kenaf, form):
    begins = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}[form]
    for found in (marmotte, kenaf):
        content = files.figure_bytes(traverse_figure(found), form)
        assert content.startswith(begins)
    assert files.figure_bytes(traverse_figure(kenaf), form) == content


def test_the_landscape_agrees_with_the_driven_path(marmotte):
    land = landscape_of(marmotte, columns=120, rows=91)
    run = marmotte.found.run
    step = land.phi[1] - land.phi[0]
    stable = land.stable
    for column in range(0, 120, 7):
        row = int(np.argmin(np.abs(run.x - land.x[column])))
        if abs(run.x[row] - land.x[column]) > 2e-3 or run.poses[row, 15] == 0:
            continue
        # the driven pose is a valley of the landscape, to the grid's step and 2 mm along
        valleys = land.phi[:-1][stable[:, column]]
        assert np.abs(valleys - run.inclination[row]).min() < 2 * step
    assert (land.above >= 0).all()
    assert files.figure_bytes(landscape_figure(land), "png").startswith(b"\x89PNG")


def test_the_film_ends_where_the_way_ends(kenaf, marmotte):
    frames = animation.frames_of(marmotte)
    assert len(frames) <= (animation.LONGEST + 8) * animation.FRAMES_PER_SECOND
    assert frames[-1].stand == pytest.approx(tuple(marmotte.found.run.poses[-1, 1:4]), abs=1e-12)
    assert any(frame.turning for frame in frames)
    assert animation.frames_of(kenaf)[-1].stand.phi > math.radians(100)  # it has fallen


def test_a_gif_is_whole(kenaf, monkeypatch):
    from PIL import Image

    monkeypatch.setattr(animation, "frames_of", lambda _, whole=animation.frames_of: whole(_)[::40])
    with Image.open(BytesIO(animation.gif_bytes(kenaf))) as film:
        assert film.n_frames > 1
        assert film.info["duration"] == 40


def test_films_that_cannot_be_made(monkeypatch):
    with pytest.raises(InputError, match=r"unknown suffix '\.avi'; known: \.mp4, \.gif"):
        animation.writer_for(Path("way.avi"))
    monkeypatch.setattr(animation, "find_spec", lambda _: None)
    with pytest.raises(MissingExtraError) as raised:
        animation.writer_for(Path("way.mp4"))
    assert str(raised.value) == (
        "a film as .mp4 needs an optional package: pip install 'kaidan[video]'"
    )
