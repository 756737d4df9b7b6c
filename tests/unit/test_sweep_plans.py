"""A sweep of cells: what varies, how it is cut into chunks, kept, resumed and written."""

import json
import math
import subprocess
import sys
import time

import numpy as np
import pytest
import xarray as xr

from kaidan import InputError, Payload, Robot, Stairs, sweep
from kaidan.cli.varying import varied
from kaidan.override import overridden
from kaidan.sweeps.cells import CELLS, NOT_GO, VERDICTS
from kaidan.sweeps.parameters import parameter, question_of, shaped
from kaidan.sweeps.plan import Along, Plan
from kaidan.sweeps.running import carried_out
from kaidan.sweeps.summary import SweepSummary, summary_of

CLOSED = {"robot": "absolem", "stairs": "ibc", "model": "closed-form", "flippers": "flat"}


def cells(plan):
    return [values for chunk in plan.specs() for values in chunk.values()]


# What can vary


def test_a_list_varies_and_a_tuple_is_one_value():
    plan = Plan.of(CLOSED | {"friction": [0.6, (0.6, 1.0)], "theta_d": (0.0, 0.02)})
    assert plan.labels == {"friction": (0.6, "0.6..1")}
    assert plan.base["theta_d"] == (0.0, 0.02)
    assert [each["friction"] for each in cells(plan)] == [0.6, (0.6, 1.0)]


def test_what_does_not_drive_the_robot_varies_fastest():
    plan = Plan.of(CLOSED | {"friction": [0.5, 0.6], "com_height": [0.1, 0.2]})
    assert plan.order == ("com_height", "friction")
    assert [(each["com_height"], each["friction"]) for each in cells(plan)] == [
        (0.1, 0.5), (0.1, 0.6), (0.2, 0.5), (0.2, 0.6)]  # fmt: skip
    values = np.arange(4)
    assert plan.spread(values).tolist() == [[0, 2], [1, 3]]  # friction first, as it was written


def test_labelled_arrays_keep_their_dimensions():
    x = xr.DataArray([0.1, 0.2, 0.3], dims="x")
    z = xr.DataArray([0.1, 0.2], dims="z", coords={"z": [10, 20]})
    plan = Plan.of(CLOSED | {"com_from_front": x + 0 * z, "com_height": z})
    assert plan.labels == {"x": (0, 1, 2), "z": (10, 20)}
    assert [(each["com_from_front"], each["com_height"]) for each in cells(plan)] == [
        (0.1, 0.1), (0.1, 0.2), (0.2, 0.1), (0.2, 0.2), (0.3, 0.1), (0.3, 0.2)]  # fmt: skip


def test_rows_that_say_the_same_are_judged_once():
    rows = {"rise": Along("flight", [0.15, 0.17, 0.15]), "going": Along("flight", [0.3, 0.3, 0.3])}
    plan = Plan.of({"robot": "kenaf", "model": "contact", "friction": [0.5, 1.0], **rows})
    assert (len(plan), plan.different) == (6, 4)
    assert plan.spread(np.arange(4)).tolist() == [[0, 2, 0], [1, 3, 1]]


def test_a_name_counts_as_what_it_names():
    kenaf = Robot.named("kenaf")
    assert Plan.of(CLOSED | {"robot": kenaf}).digest == Plan.of(CLOSED | {"robot": "kenaf"}).digest
    assert Plan.of(CLOSED).digest != Plan.of(CLOSED, screen=True).digest
    other = Plan.of(CLOSED | {"friction": [0.5]})
    assert other.digest != Plan.of(CLOSED | {"friction": [0.6]}).digest


def test_chunks_keep_together_what_shares_a_traverse():
    many = {"com_height": np.linspace(0.05, 0.3, 500), "friction": [0.4, 0.6, 0.8]}
    plan = Plan.of(CLOSED | many)
    assert plan.chunk_size % 3 == 0
    assert len(plan.chunks) <= 64
    chunk = plan.chunk(3, 6)
    assert chunk.distinct["com_height"] == (many["com_height"][1],)
    assert Plan.of(CLOSED | {"flippers": "best", "risk": np.full(1000, 0.1)}).chunk_size <= 100


def test_chunks_of_searched_cells_are_small():
    """A search takes a third of a second, and it is what is done where no posture is stated."""
    many = {**CLOSED, "com_height": np.linspace(0.05, 0.3, 20_000), "model": "contact"}
    many.pop("flippers", None)
    assert Plan.of(many).chunk_size == 100
    assert Plan.of(many | {"flippers": ["flat", "best"]}).chunk_size == 100
    assert Plan.of(many | {"flippers": "stowed"}).chunk_size > 100
    assert Plan.of(many | {"model": "closed-form"}).chunk_size > 100


@pytest.mark.parametrize(
    ("name", "kind", "unit"),
    [("friction", "number", "1"), ("rise", "length", "m"), ("robot", None, ""),
     ("track.front_radius", "length", "m"), ("front_flippers.length", "length", "m"),
     ("payload.mass", "mass", "kg"), ("drive.max_traction", "force", "N")],
)  # fmt: skip
def test_what_a_parameter_measures(name, kind, unit):
    assert parameter(name) == (name, kind, unit)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("frction", "unknown parameter 'frction'; known: friction, acceleration"),
        (
            "track.length",
            "'track.length' is no figure of a robot's sheet; did you mean flat_length[?] Known",
        ),
        (
            "track.colour",
            "'track.colour' is no figure of a robot's sheet; known there: flat_length",
        ),
        ("engine.power", "'engine.power' is no figure of a robot's sheet"),
        (
            "track.flat_lenght",
            "'track.flat_lenght' is no figure of a robot's sheet; did you mean flat_length[?] "
            "Known there: flat_length, front_radius",
        ),
        ("track.belts", "'track.belts' is no figure of a robot's sheet; did you mean belt[?]"),
    ],
)
def test_an_unknown_parameter_is_refused(name, said):
    with pytest.raises(InputError, match=said.replace("(", r"\(")):
        parameter(name)


def test_figures_of_a_sheet_by_name():
    robot = Robot.named("absolem")
    assert overridden(robot, {"front_flippers.length": 0.4}).front_flippers.length == 0.4
    with pytest.raises(InputError, match="robot 'kenaf' has no front_flippers, so no front_"):
        overridden(Robot.named("kenaf"), {"front_flippers.length": 0.4})
    question = question_of({"robot": robot, "stairs": "ibc", "payload": "5kg@200mm,300mm",
                            "payload.height": 0.5})  # fmt: skip
    assert question.payload == (Payload(mass=5.0, from_front=0.2, height=0.5),)
    with pytest.raises(InputError, match=r"payload.height needs one payload, not 0"):
        question_of({"robot": robot, "stairs": "ibc", "payload.height": 0.5})


def test_the_shape_of_stairs():
    ibc = Stairs.named("ibc")
    assert shaped(ibc, {}) is ibc
    assert shaped(ibc, {"rise": 0.15, "steps": 9.0}).steps == 9
    steep = shaped(ibc, {"angle": math.radians(40)})
    assert (steep.angle, steep.nosing_spacing) == pytest.approx((math.radians(40), 0.331), abs=1e-3)
    assert steep.name == ibc.name
    with pytest.raises(InputError, match="either rise and going or angle and nosing_spacing"):
        shaped(ibc, {"rise": 0.15, "angle": 0.5})
    with pytest.raises(InputError, match="no stairs"):
        shaped(None, {"rise": 0.15})
    with pytest.raises(InputError, match="are not uniform"):
        shaped(Stairs(rises=(0.1, 0.1), goings=(0.3,)), {"rise": 0.15})


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"friction": []}, "a parameter has no value"),
        ({"friction": np.ones((2, 2))}, "friction has 2 dimensions"),
        ({"friction": Along("row", [1, 2]), "risk": Along("row", [0.1])}, "row has other labels"),
        ({"friction": np.ones(4000), "risk": np.ones(4000)}, "16,000,000 cells are more than"),
        ({"robot": ["kenaf", "nobody"]}, "no robot is called 'nobody'"),
    ],
)
def test_a_plan_that_says_nothing_is_refused(values, said):
    with pytest.raises(InputError, match=said):
        Plan.of(CLOSED | values)


# What comes out


def test_a_cell_without_meaning_is_outside_and_says_why():
    table = sweep("absolem", "ibc", model="closed-form", com_from_front=[0.3, 3.0], friction=1.0)
    assert table.verdict.values.tolist()[1] == VERDICTS.index("outside-model")
    assert np.isnan(table.margin_deg.values[1])
    assert "puts the centroid outside the robot" in str(table.refusal.values[1])
    assert str(table.refusal.values[0]) == ""


def test_a_sweep_of_nothing_but_nonsense_is_refused():
    with pytest.raises(InputError, match="puts the centroid outside the robot"):
        sweep("absolem", "ibc", model="closed-form", com_from_front=[3.0, 4.0])


def test_threads_processes_and_one_after_the_other_find_the_same(tmp_path):
    plan = Plan.of(CLOSED | {"com_height": [0.1, 0.2, 0.3], "friction": [0.6, 0.9]})
    one = carried_out(plan, workers=1)
    ways = [
        carried_out(plan, scheduler="threads", workers=3),
        carried_out(plan, scheduler="processes", workers=2, store=tmp_path / "kept"),
        carried_out(plan, store=tmp_path / "kept"),
    ]
    for other in ways:
        for name, array in one.variables.items():
            np.testing.assert_array_equal(array, other.variables[name], err_msg=name)


KILLED = """
import sys, time
from kaidan.sweeps import cells
from kaidan.sweeps.plan import Plan
from kaidan.sweeps.running import carried_out
judged = cells.judged_row
def slowly(*args):
    time.sleep(0.05)
    return judged(*args)
cells.judged_row = slowly
plan = Plan.of({"robot": "absolem", "stairs": "ibc", "model": "closed-form", "flippers": "flat",
                "com_height": [0.05 + 0.001 * k for k in range(200)]})
carried_out(plan, workers=2, store=sys.argv[1])
"""


def test_a_sweep_that_is_killed_goes_on(tmp_path):
    pytest.importorskip("pyarrow")
    from kaidan.work import read_table

    store = tmp_path / "kept"
    process = subprocess.Popen([sys.executable, "-c", KILLED, str(store)])
    end = time.monotonic() + 60
    while not any(path.stat().st_size for path in store.glob("journal-*")):
        assert time.monotonic() < end
        time.sleep(0.02)
    time.sleep(0.5)
    process.kill()
    process.wait()
    varies = {"com_height": [0.05 + 0.001 * k for k in range(200)]}
    plan = Plan.of(CLOSED | varies)
    before = read_table(store, ["id", "first"]).num_rows
    assert 0 < before < len(plan.chunks)
    found = carried_out(plan, store=store)
    rows = read_table(store, ["first"]).column("first").to_pylist()
    assert sorted(rows) == list(plan.chunks)
    whole = carried_out(plan)
    np.testing.assert_array_equal(found.variables["margin_deg"], whole.variables["margin_deg"])


def test_a_store_of_trials_takes_no_sweep(tmp_path):
    pytest.importorskip("pyarrow")
    from campaign_cases import FAKE
    from kaidan.work import Store

    with Store(tmp_path, FAKE):
        pass
    with pytest.raises(InputError, match="holds fake, not cells of a sweep"):
        carried_out(Plan.of(CLOSED), store=tmp_path)


def test_a_store_of_a_sweep_is_no_plan_of_trials(tmp_path):
    pytest.importorskip("pyarrow")
    from kaidan.lab.campaign import resume
    from kaidan.work import state_of

    carried_out(Plan.of(CLOSED | {"friction": [0.5, 0.6]}), store=tmp_path)
    assert state_of(tmp_path).work == CELLS.name
    with pytest.raises(InputError, match="holds cells of a sweep: the command that began it"):
        resume(tmp_path)


@pytest.mark.parametrize("suffix", [".csv", ".parquet", ".zarr"])
def test_tables_hold_every_cell(tmp_path, suffix):
    plan = Plan.of(CLOSED | {"com_height": [0.1, 0.2, 0.3], "friction": [0.6, 0.9]})
    found = carried_out(plan)
    file = tmp_path / f"table{suffix}"
    if suffix == ".zarr":
        pytest.importorskip("zarr")
        found.write(file)
        back = xr.open_zarr(file)
        np.testing.assert_array_equal(back.margin_deg, found.variables["margin_deg"])
        return
    if suffix == ".parquet":
        pq = pytest.importorskip("pyarrow.parquet")
        found.write(file)
        columns = pq.read_table(file).to_pydict()
    else:
        import csv

        found.write(file)
        rows = list(csv.DictReader(file.read_text().splitlines()))
        columns = {name: [row[name] for row in rows] for name in rows[0]}
    assert [float(each) for each in columns["com_height"]] == [0.1, 0.1, 0.2, 0.2, 0.3, 0.3]
    margins = [float(each) for each in columns["margin_deg"]]
    assert margins == pytest.approx(found.variables["margin_deg"].ravel().tolist(), rel=1e-12)
    assert set(columns["verdict"]) <= set(VERDICTS)


def test_a_table_of_another_kind_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"unknown suffix '.xls'; known: .parquet, .csv, .zarr"):
        carried_out(Plan.of(CLOSED)).write(tmp_path / "table.xls")


def test_summary_counts_what_there_is():
    plan = Plan.of(CLOSED | {"friction": [0.4, 0.9, 1.2], "com_from_front": [0.3, 3.0]})
    found = summary_of(carried_out(plan))
    assert (found.cells, found.judged, sum(found.verdicts.values())) == (6, 6, 6)
    assert found.governs["refused"] == found.verdicts["outside-model"] == 3
    assert SweepSummary.from_json(found.to_json()) == found
    assert found.rows[0].of == {"friction": "0.4", "com_from_front": "0.3"}


# The command


def test_values_of_the_option():
    assert varied(["acceleration=0m/s2..1m/s2/3"]) == {"acceleration": [0.0, 0.5, 1.0]}
    assert varied(["robot=absolem, kenaf"]) == {"robot": ["absolem", "kenaf"]}
    for text, said in [
        ("friction", "write NAME=VALUES"),
        ("rise=15", "has no unit"),
        ("rise=15cm..20cm/1", "write LOW..HIGH/COUNT with a count of 2"),
        ("luck=1", "unknown parameter 'luck'"),
    ]:
        with pytest.raises(InputError, match=said):
            varied([text])
    with pytest.raises(InputError, match="friction is given twice"):
        varied(["friction=1", "friction=2"])


def test_the_command_sweeps(tmp_path):
    from typer.testing import CliRunner

    from kaidan.cli import app_for

    words = ["sweep", "absolem,kenaf", "ibc", "--model", "closed-form", "--flippers", "stowed",
             "--vary", "friction=0.6,1.2", "--json", "--table", f"{tmp_path}/t.csv"]  # fmt: skip
    done = CliRunner().invoke(app_for(["sweep"]), words)
    assert done.exit_code == 0, done.output
    answer = json.loads(done.stdout)
    assert answer["dimensions"] == {"robot": 2, "friction": 2}
    assert len((tmp_path / "t.csv").read_text().splitlines()) == 5


def test_codes_of_verdicts_go_on_from_those_of_an_answer():
    assert VERDICTS[NOT_GO] == "not-go"
