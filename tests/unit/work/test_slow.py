"""Minutes: the command itself killed in mid-campaign with real trials; a store of many rows."""

import json
import os
import random
import subprocess
import sys
import time

import pytest

pytest.importorskip("mujoco")
pytest.importorskip("pyarrow")

from campaign_cases import FAKE, specs, wait_until
from kaidan.errors import InputError
from kaidan.work import Store, conduct, read_table, state_of
from kaidan.work.job import Ended

pytestmark = pytest.mark.slow

COMMAND = [
    sys.executable, "-m", "kaidan", "lab", "experiment", "kenaf",
    "--spacings", "150mm,200mm", "--angles", "44deg..64deg/8", "--trials", "4",
    "--track", "sprung-noses", "--stiffness", "30kN/m", "--workers", "2", "--json",
]  # fmt: skip


def trials(store):
    try:
        return state_of(store).trials
    except InputError:
        return 0


def test_the_command_killed_again_and_again_ends_as_if_it_had_not_been(tmp_path):
    store = tmp_path / "store"
    for least in (5, 20, 40):
        campaign = subprocess.Popen(
            [*COMMAND, "--store", str(store)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        wait_until(lambda least=least: trials(store) >= least, seconds=120.0)
        campaign.kill()
        campaign.wait()
    ended = subprocess.run([*COMMAND, "--store", str(store)], capture_output=True, check=True)
    whole = subprocess.run(COMMAND, capture_output=True, check=True)
    assert json.loads(ended.stdout) == json.loads(whole.stdout)
    assert trials(store) == 64


class Idle:
    """Workers that are done before they begin."""

    def __init__(self):
        self.tasks = []

    def room(self):
        return 64 - len(self.tasks)

    def submit(self, task):
        self.tasks.append(task)

    def wait(self, _timeout):
        tasks, self.tasks = self.tasks, []
        return [Ended(task, {"outcome": "climbed"}) for task in tasks]


def test_a_store_of_many_rows_is_gone_on_with_quickly_and_in_little_memory(tmp_path):
    """The store's own cost: some 0.1 ms a trial, and less to find that it is done."""
    import resource

    count = 200_000
    with Store(tmp_path, FAKE) as store:
        conduct(specs(count), store, Idle())
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    start = time.monotonic()
    with Store(tmp_path, FAKE) as store:
        tally = conduct(specs(count + 1), store, Idle())
    assert (tally.done, tally.found) == (1, count)
    assert time.monotonic() - start < 60.0
    grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1024
    assert grown < 100e6, "16 bytes a trial, and what reading takes"
    assert state_of(tmp_path).trials == count + 1


WRITER = """
import itertools, os, sys, time
from campaign_cases import FAKE
from kaidan.work import Store, store

store.SOON = store.LATE = 0.03  # so that kills fall into settling too
opened = Store(sys.argv[1], FAKE)
for n in itertools.count(int(sys.argv[2])):
    opened.add([{"id": f"{n:032x}", "outcome": "climbed", "version": "fake 1", "n": n}])
    os.write(1, f"{n}\\n".encode())
    time.sleep(0.001)
"""


def test_48_kills_lose_nothing_that_was_taken_in(tmp_path):
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    draw = random.Random(4)
    kept = 0
    for _ in range(48):
        command = [sys.executable, "-c", WRITER, str(tmp_path), str(kept)]
        writer = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE)
        writer.stdout.readline()
        time.sleep(draw.uniform(0.0, 0.2))
        writer.kill()
        rest = writer.communicate()[0].split()
        numbers = sorted(read_table(tmp_path, ["n"]).column("n").to_pylist())
        assert numbers == list(range(len(numbers))), "each once"
        assert len(numbers) > (int(rest[-1]) if rest else kept)
        kept = len(numbers)
    assert len(list((tmp_path / "parts").iterdir())) >= 48
