"""Stairs in meshes that were drawn: to a tenth of a millimetre, in whatever unit and frame."""

import os
from pathlib import Path

import numpy as np
import pytest

import reader_files as made
import scenes
from kaidan.readers import found_in
from kaidan.readers.hints import Hints
from kaidan.readers.interpreters import mesh as interpreter
from kaidan.readers.kinds import Known, Mesh, Provenance, upright

NIST = os.environ.get("KAIDAN_NIST_STAIRS", "")
CORNERS = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)], float)
SIDES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
     [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
)  # fmt: skip


def triangles(scene):
    """Mesh of a scene: twelve triangles a box."""
    vertices, faces = [], []
    for number, (middle, axes, half, _) in enumerate(scene.boxes):
        vertices.append(middle + ((2 * CORNERS - 1) * half) @ axes.T)
        faces.append(SIDES + 8 * number)
    return np.vstack(vertices), np.vstack(faces)


def mesh(scene, unit=None, up=None):
    known = Provenance(
        "here", "", "stl", unit=unit and Known(unit, "file"), up=up and Known(up, "file")
    )
    return Mesh(*triangles(scene), known)


def the_flight(found):
    (stairs,) = found.staircases
    (flight,) = stairs.flights
    return flight


@pytest.mark.parametrize("turn", [0.0, 0.4, -2.0])
def test_drawn_stairs_are_exact(turn):
    """Authored, whichever way they head: 0.1 mm."""
    truth = scenes.regular(7, 0.1753, 0.2791, first=0.16, last=0.18)
    scene = scenes.with_stairs(truth, axes=scenes.turned(turn))
    flight = the_flight(interpreter.found(mesh(scene, "m", "+z"), Hints()))
    assert flight.line() == pytest.approx(truth.nosings, abs=1e-4)
    assert flight.width == pytest.approx(1.0, abs=0.011)  # sides are compared to the centimetre
    assert flight.begins
    assert flight.ends
    assert not flight.open_risers
    assert flight.run_out == pytest.approx(1.5, abs=1e-3)


@pytest.mark.parametrize("up", ["+z", "+y", "+x"])
@pytest.mark.parametrize(("unit", "metres"), [("mm", 1e-3), ("in", 0.0254), ("m", 1.0)])
def test_unit_and_up_axis_are_those_with_which_stairs_come_out(up, unit, metres):
    truth = scenes.regular(6, 0.17, 0.28)
    known = mesh(scenes.with_stairs(truth))
    frame = Mesh(known.vertices @ upright(up) / metres, known.faces, known.provenance)
    found = interpreter.found(frame, Hints())
    assert (found.provenance.up.value, found.provenance.unit.value) == (up, unit)
    assert found.provenance.up.how == "scored"
    assert the_flight(found).line() == pytest.approx(truth.nosings, abs=1e-4)


def test_two_plausible_ways_are_refused_with_both():
    """Steps of 200 x 210 mm without sides are steps of 210 x 200 mm when they lie on their back."""
    line = [(0.0, 0.0)]
    for _ in range(7):
        line += [(line[-1][0], line[-1][1] + 0.2), (line[-1][0] + 0.21, line[-1][1] + 0.2)]
    line = np.array(line)
    vertices = np.vstack([np.column_stack([line[:, 0], np.full(len(line), t), line[:, 1]])
                          for t in (0.0, 1.0)])  # fmt: skip
    n = len(line)
    faces = np.array(
        [[k, k + 1, n + k] for k in range(n - 1)]
        + [[k + 1, n + k + 1, n + k] for k in range(n - 1)]
    )
    known = Provenance("here", "", "stl", unit=Known("m", "file"))
    found = interpreter.found(Mesh(vertices, faces, known), Hints())
    assert found.staircases == ()
    said = str(found.refusals[0])
    assert "m with +z up (rise 200 mm, going 210 mm)" in said
    assert "m with +x up (rise 210 mm, going 200 mm)" in said
    stated = Mesh(
        vertices, faces, Provenance("", "", "", unit=known.unit, up=Known("+z", "person"))
    )
    assert the_flight(interpreter.found(stated, Hints())).regular.rise == pytest.approx(0.2)


def test_open_risers_overhang_ceiling_and_handrail():
    truth = scenes.regular(6, 0.18, 0.25)
    scene = scenes.Scene().box((-2, -2, -0.1), (0.0, 2, 0), kind="floor")
    for (s, z), end in zip(truth.nosings, [*truth.nosings[1:, 0], 3.0], strict=True):
        scene.box((s - 0.02, -0.5, z - 0.04), (end, 0.5, z))
    scene.box((-2, -2, 3.4), (4, 2, 3.6), kind="ceiling")
    scenes.handrail(scene, truth)
    flight = the_flight(interpreter.found(mesh(scene, "m", "+z"), Hints()))
    assert flight.open_risers
    assert flight.middle[0] == pytest.approx([-0.02, 0.0, 0.18], abs=1e-4)
    assert flight.line() == pytest.approx(truth.nosings, abs=1e-4)


def test_half_turn_has_two_flights():
    truth = scenes.regular(6, 0.17, 0.28, width=1.1)
    found = interpreter.found(mesh(scenes.half_turn(truth), "m", "+z"), Hints())
    (stairs,) = found.staircases
    assert [len(flight) for flight in stairs.flights] == [6, 6]
    assert abs(stairs.landings[1].turn) == pytest.approx(np.pi, abs=1e-6)
    for flight in stairs.flights:
        assert flight.line() == pytest.approx(truth.nosings, abs=1e-4)


def test_a_scanned_mesh_is_a_cloud():
    """Triangles of 2 cm with 2 mm of noise: chosen by itself."""
    truth = scenes.regular(6, 0.17, 0.28)
    s = np.arange(-1.0, 2.6, 0.02)
    steps = np.searchsorted(truth.nosings[:, 0], s + 1e-9)
    line = []
    for k, place in enumerate(s):
        level = steps[k] * 0.17
        if k and steps[k] > steps[k - 1]:
            line += [(place, level - 0.17 + part) for part in np.arange(0.0, 0.17, 0.02)]
        line.append((place, level))
    line, t = np.array(line), np.arange(0.0, 1.01, 0.02)
    n, m = len(line), len(t)
    vertices = np.column_stack([np.repeat(line[:, 0], m), np.tile(t, n), np.repeat(line[:, 1], m)])
    vertices += np.random.default_rng(0).normal(0, 0.002, vertices.shape)
    at = np.arange((n - 1) * m).reshape(n - 1, m)[:, :-1].ravel()
    faces = np.vstack([np.column_stack([at, at + 1, at + m]),
                       np.column_stack([at + 1, at + m + 1, at + m])])  # fmt: skip
    known = Provenance("here", "", "ply", unit=Known("m", "file"), up=Known("+z", "file"))
    found = interpreter.found(Mesh(vertices, faces, known), Hints())
    flight = the_flight(found)
    assert flight.gravity > 0  # the cloud's way
    assert flight.regular.spacing == pytest.approx(truth.spacing, abs=0.003)


def test_a_cube_is_no_staircase():
    cube = scenes.Scene().box((0, 0, 0), (1, 1, 1))
    assert interpreter.found(mesh(cube, "m", "+z"), Hints()).refusals[0].why == "none"


def test_files_of_meshes_are_read_to_the_end(tmp_path):
    pytest.importorskip("trimesh")
    truth = scenes.regular(6, 0.17, 0.28)
    vertices, faces = triangles(scenes.with_stairs(truth))
    path = tmp_path / "stairs"
    path.write_bytes(made.stl(1000 * vertices, faces))
    found = found_in(path)
    assert the_flight(found).line() == pytest.approx(truth.nosings, abs=1e-4)
    assert found.provenance.unit.value == "mm"


@pytest.mark.skipif(not NIST, reason="file not given: KAIDAN_NIST_STAIRS")
def test_stairs_of_the_nist_arena():
    """Published with the model: rise 200.0 mm, going 232.5 mm, five treads, 40.70 deg."""
    flight = the_flight(found_in(Path(NIST)))
    assert len(flight) == 5
    assert np.diff(flight.line(), axis=0) == pytest.approx(
        np.tile([0.2325, 0.2], (4, 1)), abs=0.0002
    )
