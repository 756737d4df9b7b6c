"""``kaidan lab experiment`` and ``kaidan lab campaign``, texts to the letter."""

import json
import re

import pytest
from typer.testing import CliRunner

pytest.importorskip("mujoco")
pytest.importorskip("pyarrow")

from kaidan.cli import app
from kaidan.errors import InputError
from kaidan.lab.calibration.fitted import fitted
from kaidan.physics import SmoothBelt
from kaidan.robot import Robot
from kaidan.work.lock import Lock

runner = CliRunner()
QUICK = ["lab", "experiment", "kenaf", "--spacings", "150mm", "--angles", "55deg,70deg",
         "--trials", "2", "--track", "smooth-belt", "--workers", "1"]  # fmt: skip


def told(*words):
    done = runner.invoke(app, list(words))
    if done.exception and not isinstance(done.exception, SystemExit):
        raise done.exception
    return done


@pytest.fixture(scope="module")
def store(tmp_path_factory):
    folder = tmp_path_factory.mktemp("campaign") / "store"
    done = told(*QUICK, "--store", str(folder), "--figure", str(folder) + ".svg", "--csv",
                str(folder) + ".csv")  # fmt: skip
    assert done.exit_code == 0
    return folder, done.output


def test_what_is_shown(store):
    folder, output = store
    lines = output.splitlines()
    assert (
        lines[0] == "kenaf: 4 trials; smooth-belt, 0.1 m/s, friction 3, 10 nosings a trial, seed 0"
    )
    assert "  150 mm up    55:o  70:x" in lines
    assert lines[-2] == f"wrote {folder}.csv"
    assert re.fullmatch(rf"wrote {re.escape(str(folder))}\.svg \(\d+ kB\)", lines[-1])
    table = folder.with_suffix(".csv").read_text().splitlines()
    assert table[0].startswith("nosing_spacing_m,angle_deg,direction,trials,climbed,fell,")
    assert table[1].startswith("0.15,55.0,up,2,2,0,0,,")
    assert folder.with_suffix(".svg").stat().st_size > 10_000


def test_the_same_command_again_does_nothing_again_and_says_the_same(store):
    folder, output = store
    again = told(*QUICK, "--store", str(folder)).output
    assert again.splitlines()[0] == "4 of 4 trials were in the store already."
    assert output.splitlines()[:-2] == again.splitlines()[1:]


def test_json(store):
    folder, _ = store
    found = json.loads(told(*QUICK, "--store", str(folder), "--json").output)
    (spacing,) = found["spacings"]
    assert spacing["climbed_up_to_deg"] == pytest.approx(55.0)
    assert spacing["fell_from_deg"] == pytest.approx(70.0)
    assert spacing["theta_M_deg"] is None
    assert [each["fell"] for each in spacing["up"]] == [0, 2]
    assert found["seed"] == 0


def test_campaign_status_resume_export(store, tmp_path):
    folder, _ = store
    status = told("lab", "campaign", "status", str(folder)).output.splitlines()
    assert status[0] == f"{folder}: 4 trials (trials in MuJoCo)"
    assert status[1] == "  verification-test  4 of 4 done, 0 missing"
    assert status[2:4] == ["  climbed            2", "  fell_backward      2"]
    whole = json.loads(told("lab", "campaign", "status", str(folder), "--json").output)
    assert whole["plans"] == [{"kind": "verification-test", "trials": 4, "done": 4, "missing": 0}]
    resumed = told("lab", "campaign", "resume", str(folder), "--workers", "1").output
    assert resumed == f"{folder}: 0 trials done, 4 in the store before\n"
    file = tmp_path / "all.csv"
    assert told("lab", "campaign", "export", str(folder), str(file)).output == (
        f"wrote {file}: 4 trials\n"
    )
    assert len(file.read_text().splitlines()) == 5


def test_a_store_that_is_being_written(store):
    folder, _ = store
    lock = Lock(folder)
    try:
        status = told("lab", "campaign", "status", str(folder)).output
        assert status.splitlines()[-1].startswith("  being written by process ")
        with pytest.raises(InputError, match="a campaign is writing it"):
            told("lab", "campaign", "resume", str(folder))
    finally:
        lock.release()


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["--spacings", "150"], "spacings '150' has no unit; write 150mm or 150cm or 150m"),
        (["--angles", "50deg..60deg"],
         "angles '50deg..60deg': write LOW..HIGH/COUNT with a count of 2 to 1000, for example "
         "44deg..66deg/12"),
        (["--angles", "60deg..50deg/3"], "angles '60deg..50deg/3': LOW is not less than HIGH"),
        (["--angles", "95deg"], "angles: 95 deg is not within 1 to 89 deg"),
        (["--track", "hover"], "--track 'hover' is not a model; known: smooth-belt, "
         "yielding-belt, sprung-noses, driven-grousers, shoe-chain"),
        (["--track", "sprung-noses"],
         "trial: sprung-noses needs a stiffness; the track of 'kenaf' states none"),
        (["--workers", "2", "--scheduler", "tcp://x"],
         "give either --workers or --scheduler, not both"),
        (["--figure", "fig.jpg"], "figure 'fig.jpg': unknown suffix '.jpg'; known: .png, .svg, "
         ".pdf"),
        (["--angles", "88deg"],
         "88 deg at 150 mm: stairs: going = 0.00523492450538 m is not within 0.02 to 2.5 m"),
    ],
)  # fmt: skip
def test_refusals(words, text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError) as caught:
        told("lab", "experiment", "kenaf", *words)
    assert str(caught.value) == text
    assert not list(tmp_path.iterdir())


def test_campaign_refusals(tmp_path):
    for words in (["status"], ["resume"], ["export"]):
        with pytest.raises(InputError) as caught:
            told(
                "lab",
                "campaign",
                *words,
                str(tmp_path),
                *(["x.csv"] if words == ["export"] else []),
            )
        assert str(caught.value) == (
            f"store {str(tmp_path)!r}: no such store (campaign.json is missing)"
        )


def test_the_dask_path_without_distributed(tmp_path, monkeypatch):
    def missing(name):
        raise ImportError(name)

    monkeypatch.setattr("kaidan.work.cluster.import_module", missing)
    with pytest.raises(ImportError) as caught:
        told(*QUICK[:-2], "--scheduler", "tcp://127.0.0.1:1")
    assert str(caught.value) == (
        "a campaign beyond this machine needs an optional package: pip install 'kaidan[cluster]'"
    )


def test_the_store_without_pyarrow(tmp_path, monkeypatch):
    def missing(name):
        raise ImportError(name)

    monkeypatch.setattr("kaidan.work.store_files.import_module", missing)
    with pytest.raises(ImportError) as caught:
        told(*QUICK)
    assert str(caught.value) == (
        "a store of trials needs an optional package: pip install 'kaidan[physics]'"
    )


def test_the_same_from_python(store):
    import kaidan

    folder, output = store
    found = kaidan.lab.experiment(
        "kenaf",
        spacings=[0.15],
        angles="55deg,70deg",
        trials=2,
        track=SmoothBelt(),
        store=folder,
        workers=1,
    )
    assert str(found).splitlines() == output.splitlines()[:-2]


def test_without_a_track_it_is_the_one_that_was_fitted_and_says_so(tmp_path):
    words = ["lab", "experiment", "kenaf", "--spacings", "150mm", "--angles", "70deg",
             "--trials", "1", "--workers", "1"]  # fmt: skip
    kept = [*words, "--store", str(tmp_path / "store")]
    lines = told(*kept).output.splitlines()
    assert (
        lines[0]
        == "kenaf: 1 trials; yielding-belt, 0.1 m/s, friction 3, 10 nosings a trial, seed 0"
    )
    assert lines[1].startswith("  The track is the one fitted to the paper's text")
    told_by = json.loads(told(*kept, "--json").output)
    # 4.1 mm under 20 kg; the sheet's own figures come before it
    assert told_by["stiffness_N_m"] == pytest.approx(20 * 9.80665 / 0.0041)
    assert told_by["track_from"] == "fit"
    own = told(*words, "--override", "track.stiffness=60kN/m", "--json").output
    assert (json.loads(own)["track_from"], json.loads(own)["stiffness_N_m"]) == ("sheet", 6e4)


def test_grousers_grip_by_their_shape_so_their_friction_is_that_of_metal_on_an_edge():
    words = ["lab", "experiment", "kenaf", "--track", "driven-grousers", "--spacings", "150mm",
             "--angles", "20deg", "--trials", "1", "--workers", "1"]  # fmt: skip
    assert told(*words).output.startswith(
        "kenaf: 1 trials; driven-grousers, 0.1 m/s, friction 0.8, 10 nosings a trial, seed 0\n"
    )


def test_the_fitted_ends_are_kenafs_alone():
    kenaf, belt = fitted(Robot.named("kenaf"))
    assert (kenaf.track.front_radius, kenaf.track.rear_radius) == (0.011, 0.011)
    assert belt.shear_ratio == 1.1
    absolem = Robot.named("absolem")
    assert fitted(absolem)[0] == absolem
