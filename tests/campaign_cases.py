"""A campaign's work without physics: quick, and it goes wrong when it is told to."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from kaidan import work  # of which each process imports what it uses

COLUMNS = {"n": "count", "square": "number", "pid": "count"}


def run(spec):
    """{"n": 3, "seconds": 0.0, "wrong": "raise" | "die" | "die once" | "odd", "folder": ...}."""
    time.sleep(spec.get("seconds", 0.0))
    wrong = spec.get("wrong")
    if "folder" in spec:  # who did what, told outside the store
        with (Path(spec["folder"]) / "done.txt").open("a") as file:
            file.write(f"{spec['n']} {os.getpid()}\n")
    if wrong == "raise":
        raise ZeroDivisionError("half a character \ud800")
    if wrong == "missing":
        raise ImportError("no module called luck")
    if wrong == "die":
        os.kill(os.getpid(), signal.SIGKILL)
    if wrong == "die once":
        mark = Path(spec["folder"]) / f"died-{spec['n']}"
        if not mark.exists():
            mark.touch()
            os.kill(os.getpid(), signal.SIGKILL)
    outcome = "unstable" if wrong == "odd" else "climbed"
    return {"outcome": outcome, "square": float(spec["n"]) ** 2, "pid": os.getpid()}


def inputs(spec):
    return {"n": spec["n"]}


def text(spec):
    return json.dumps({"n": spec["n"]})


def version():
    return "fake 1"


FAKE = work.Work(name="fake", run=run, inputs=inputs, text=text, version=version, columns=COLUMNS)


def specs(count, **fields):
    return ({"n": n, **fields} for n in range(count))


def start(store, notes, count, seconds, *address):
    """The same in a process of its own; its workers note what they did in a folder."""
    environment = os.environ | {
        "PYTHONPATH": os.pathsep.join([str(Path(__file__).parent), *sys.path])
    }
    command = [sys.executable, __file__, str(store), str(count), str(seconds), str(notes)]
    return subprocess.Popen([*command, *address], env=environment, stdout=subprocess.PIPE)


def noted(notes):
    """Trials that were done, told by the workers themselves: n to pids."""
    done = {}
    file = notes / "done.txt"
    for line in file.read_text().splitlines() if file.exists() else ():
        n, pid = line.split()
        done.setdefault(int(n), []).append(int(pid))
    return done


def wait_until(condition, seconds=120.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


def local_campaign(folder, trials, *, count=2, tries=3):
    workers = work.LocalWorkers(FAKE, count, tries=tries)
    with work.Store(Path(folder), FAKE) as store, workers:
        return work.conduct(trials, store, workers)


if __name__ == "__main__":
    folder, count, seconds, notes, *address = sys.argv[1:]
    plan = specs(int(count), seconds=float(seconds), folder=notes)
    if address:
        with (
            work.Store(Path(folder), FAKE) as store,
            work.DaskWorkers(FAKE, address[0]) as workers,
        ):
            print(work.conduct(plan, store, workers).done)
    else:
        print(local_campaign(folder, plan).done)
