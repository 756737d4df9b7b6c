"""Recordings for Rerun: written, read back by its own reader, and what is in them."""

import numpy as np
import pytest

pytest.importorskip("rerun", reason="skipped: rerun not installed")

import kaidan
from kaidan.cli import run
from kaidan.errors import MissingExtraError
from kaidan.lab.rerun.recording import traverse_recording


def entities(file):
    """Chunks of a recording by their entity, those of Rerun's own left out."""
    from rerun.chunk import RrdReader

    found = {}
    for chunk in RrdReader(file).stream():
        if not chunk.entity_path.startswith("/__"):
            found.setdefault(chunk.entity_path, []).append(chunk.to_record_batch())
    return found


def column(batches, name):
    """Values of a component, flat."""
    return np.concatenate(
        [np.ravel(np.array(batch.column(name).to_pylist(), dtype=float)) for batch in batches]
    )


@pytest.fixture(scope="module")
def traverse():
    return kaidan.traverse("absolem", "ibc", friction=0.8, flippers="flat/land:-60deg,-20deg")


def test_a_traverse_is_there_pose_by_pose(traverse, tmp_path):
    (tmp_path / "t.rrd").write_bytes(traverse_recording(traverse))
    found, poses = entities(tmp_path / "t.rrd"), traverse.poses
    assert found.keys() >= {
        "/answer", "/terrain/profile", "/terrain/nosings", "/path", "/robot", "/robot/outline",
        "/robot/centroid", "/contacts", "/events", "/margins/required_friction",
        "/margins/energy_margin_mm", "/margins/inclination_deg",
    }  # fmt: skip
    shown = column(found["/margins/inclination_deg"], "Scalars:scalars")
    assert shown.tolist() == list(poses.inclination_deg)
    places = column(found["/robot"], "Transform3D:translation").reshape(-1, 3)
    # the file has single precision
    assert places[:, 0] == pytest.approx(poses.x_m, abs=1e-6)
    assert places[:, 2] == pytest.approx(poses.z_m, abs=1e-6)
    turns = column(found["/robot"], "Transform3D:quaternion").reshape(-1, 4)
    nose_up = -2 * np.degrees(np.arctan2(turns[:, 1], turns[:, 3]))
    assert nose_up == pytest.approx(poses.inclination_deg, abs=1e-4)
    assert sum(batch.num_rows for batch in found["/events"]) == len(traverse.event_log)
    assert len(found["/robot/outline"]) == 1 + len(traverse.moves)


def test_forces_of_a_pose_carry_the_weight(traverse, tmp_path):
    (tmp_path / "t.rrd").write_bytes(traverse_recording(traverse))
    (batch,) = entities(tmp_path / "t.rrd")["/contacts"]
    drawn = [np.sum(each, axis=0) for each in batch.column("Arrows3D:vectors").to_pylist() if each]
    standing = [each for each in drawn if np.any(each)]
    # by hand: at a constant speed the forces add up to once the weight, drawn 0.2 m long
    assert np.array(standing[1:-1]) == pytest.approx(
        np.array([[0.0, 0.0, 0.2]] * (len(standing) - 2)), abs=2e-4
    )


def test_the_command_writes_it_and_refuses_another_name(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert run(["traverse", "kenaf", "ibc", "--friction", "0.8", "--json"]) == 1
    (tmp_path / "t.json").write_text(capsys.readouterr().out)
    assert run(["lab", "rerun", "t.json", "t.rrd"]) == 0
    assert "/robot" in entities(tmp_path / "t.rrd")
    assert run(["lab", "rerun", "t.json", "t.png"]) == 2
    assert "'t.png': a recording of Rerun ends in .rrd" in capsys.readouterr().err
    assert run(["traverse", "kenaf", "ibc", "--rerun", "t.rrd"]) == 2
    assert "--rerun is now kaidan lab rerun" in capsys.readouterr().err


def test_what_is_no_answer_is_refused(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "t.json").write_text("{}")
    for file in ("t.json", "nowhere.json"):
        assert run(["lab", "rerun", file, "t.rrd"]) == 2
    said = capsys.readouterr().err
    assert "no TraverseReport: " in said
    assert "nowhere.json: cannot be read: " in said


def test_without_the_extra_the_line_that_installs_it_is_said(traverse, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "rerun", None)
    with pytest.raises(MissingExtraError, match=r"pip install 'kaidan\[rerun\]'"):
        traverse_recording(traverse)


def test_a_trial_is_there_over_its_time(tmp_path):
    pytest.importorskip("mujoco", reason="skipped: mujoco not installed")
    from kaidan.lab.rerun.recording import trial_recording
    from kaidan.physics import record
    from physics_cases import spec

    log = record(spec(50.0))
    (tmp_path / "t.rrd").write_bytes(trial_recording(log))
    found = entities(tmp_path / "t.rrd")
    assert found.keys() >= {"/answer", "/robot", "/terrain/profile", "/trial/traction_N"}
    assert column(found["/trial/traction_N"], "Scalars:scalars") == pytest.approx(
        log.columns["traction_N"]
    )


def test_what_was_found_in_a_cloud_is_there_with_its_doubt(tmp_path):
    from kaidan.cli import run as command
    from reader_files import table

    rng = np.random.default_rng(4)
    treads = np.column_stack([rng.uniform(0, 2.24, 6000), rng.uniform(0, 1, 6000), np.zeros(6000)])
    treads[:, 2] = 0.17 * (np.floor(treads[:, 0] / 0.28) + 1)  # 8 steps of 170/280 mm
    floor = np.column_stack([rng.uniform(-1.5, 0, 4000), rng.uniform(0, 1, 4000), np.zeros(4000)])
    (tmp_path / "cloud.xyz").write_bytes(table(np.concatenate([treads, floor])))
    file = tmp_path / "c.rrd"
    answer = kaidan.read(tmp_path / "cloud.xyz")
    (tmp_path / "c.json").write_text(answer.to_json())
    assert command(["lab", "rerun", str(tmp_path / "c.json"), str(file)]) == 0
    found = entities(file)
    assert "/answer" in found
    count = sum(len(each.flights) for each in answer.staircases)
    assert count == 1
    assert sum(name.endswith("/nosings") for name in found) == count
    (doubt,) = [each for name, each in found.items() if name.endswith("/doubt")]
    sizes = column(doubt, "Ellipsoids3D:half_sizes").reshape(-1, 3)
    sigmas = np.array(answer.staircases[0].flights[0].sigmas)
    assert sizes[:, 2] == pytest.approx(sigmas[:, 1], rel=1e-6)  # single precision
