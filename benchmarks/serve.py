"""Users of the server on loopback: latency of answers, and memory over thousands of requests.

Each user asks once a second, of so many different questions that a share of them is new; the time
is from sending to the last byte. At a slider a user asks for ten estimates a second, each once the
one before has come, and for a whole answer when the slider rests; meanwhile somebody searches for
the best flippers. Memory is the resident set of the server and of its workers, once after a tenth
of the requests and once at the end. The server is a process of its own. What else the machine did
is the load at the end, a mean of a minute that has this benchmark in it.
"""

import argparse
import asyncio
import itertools
import os
import random
import re
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

import httpx
import numpy as np

from record import finish, options

STAIRS = ("ibc", "ada", "osha-ship")


def questions(different: int, least: float = 0.5) -> list[dict[str, object]]:
    """So many different questions with a stated posture, at the least friction and above."""
    return [
        {"robot": "absolem", "stairs": STAIRS[k % 3], "flippers": ("flat", "stowed")[k % 2],
         "friction": round(least + 0.001 * k, 4)}
        for k in range(different)
    ]  # fmt: skip


async def slider(client: httpx.AsyncClient, seconds: float, first: int, found: list):
    """One user at the slider of the centroid's height, who rests every second."""
    end, k = time.perf_counter() + seconds, 0
    while time.perf_counter() < end:
        height = 0.08 + 1e-6 * (first + k)
        body = {"robot": "absolem", "stairs": "ibc", "surface": "concrete-dry", "flippers": "flat",
                "override": {"com_height": height}}  # fmt: skip
        for verb in ("estimate", "assess") if k % 10 == 9 else ("estimate",):
            began = time.perf_counter()
            answer = await client.post(f"/api/{verb}", json=body)
            took = time.perf_counter() - began
            found.append((verb, took, answer.status_code))
            await asyncio.sleep(max(0.0, 0.1 - took))
        k += 1


async def searcher(client: httpx.AsyncClient, seconds: float):
    """Somebody who has the best flippers found, of one question after another."""
    end, k = time.perf_counter() + seconds, 0
    while time.perf_counter() < end:
        body = {"robot": "absolem", "stairs": "ada", "friction": 0.6 + 1e-4 * k}
        await client.post("/api/assess", json=body)
        k += 1


async def sliders(address: str, users: int, seconds: float) -> dict:
    """Latencies of estimates while so many users move a slider [ms]."""
    found: list[tuple[str, float, int]] = []
    limits = httpx.Limits(max_connections=users + 1)
    async with httpx.AsyncClient(base_url=address, timeout=60, limits=limits) as client:
        moving = (slider(client, seconds, 10_000 * k, found) for k in range(users))
        await asyncio.gather(*moving, searcher(client, seconds))
    times = np.array([took for verb, took, _ in found if verb == "estimate"]) * 1e3
    return {
        "estimates": len(times),
        "errors": sum(status != 200 for *_, status in found),
        "p50_ms": float(np.percentile(times, 50)),
        "p95_ms": float(np.percentile(times, 95)),
    }


async def user(client: httpx.AsyncClient, seconds: float, asked: itertools.cycle, found: list):
    """One user: a request a second, wherever in the second it began."""
    await asyncio.sleep(random.random())
    end = time.perf_counter() + seconds
    while (began := time.perf_counter()) < end:
        answer = await client.post("/api/assess", json=next(asked))
        took = time.perf_counter() - began
        found.append((took, answer.status_code))
        await asyncio.sleep(max(0.0, 1.0 - took))


async def load(
    address: str, users: int, seconds: float, every: list[dict[str, object]], warm: bool
) -> dict:
    """Latencies of many users [ms], and errors."""
    limits = httpx.Limits(max_connections=users)
    async with httpx.AsyncClient(base_url=address, timeout=60, limits=limits) as client:
        if warm:
            for each in every:
                await client.post("/api/assess", json=each)
        random.seed(1)
        random.shuffle(every)
        found: list[tuple[float, int]] = []
        asked = itertools.cycle(every)
        await asyncio.gather(*(user(client, seconds, asked, found) for _ in range(users)))
    times = np.array([took for took, _ in found]) * 1e3
    return {
        "requests": len(found),
        "errors": sum(status != 200 for _, status in found),
        "p50_ms": float(np.percentile(times, 50)),
        "p95_ms": float(np.percentile(times, 95)),
    }


def memory(pid: int) -> dict[int, float]:
    """Resident sets of a process and of its children [MB] (Linux)."""
    listed = subprocess.run(
        ["ps", "-o", "pid=,rss=", "--pid", str(pid), "--ppid", str(pid)],
        capture_output=True, text=True, check=True,
    ).stdout  # fmt: skip
    return {int(a): int(b) / 1024 for a, b in (line.split() for line in listed.splitlines())}


def handles(pid: int) -> int:
    """Files and sockets that a process has open (Linux)."""
    return len(list(Path(f"/proc/{pid}/fd").iterdir()))


def growth(address: str, pid: int, requests: int) -> dict:
    """Growth of memory after a tenth of the requests [MB], without the answers it remembers."""
    frictions = itertools.count(4000)
    with httpx.Client(base_url=address, timeout=60) as client:
        before: dict[int, float] = {}
        open_before = 0
        remembered = 0.0
        for k in range(requests):
            if k == requests // 10:
                before, open_before = memory(pid), handles(pid)
            if k % 4 == 0:
                client.post("/api/estimate", json={"robot": f"nobody{k}", "stairs": "ibc"})
            elif k % 4 == 1:
                client.get("/api/catalogue/robots/absolem")
            else:
                new = {"robot": "absolem", "stairs": "ibc", "flippers": "flat",
                       "friction": next(frictions) / 1e4}  # fmt: skip
                answer = client.post("/api/assess", json=new | {"model": "closed-form"})
                remembered += len(answer.content) / 1e6 if before else 0.0
        after = memory(pid)
    return {
        "handles_growth": handles(pid) - open_before,
        "server_growth_mb": after[pid] - before[pid] - min(remembered, 64.0),
        "workers_growth_mb": sum(after.values()) - sum(before.values()) - after[pid] + before[pid],
        "server_mb": after[pid],
    }


@contextmanager
def started(folder: Path):
    """A server in a process of its own, with its state in a folder, and its address."""
    server = subprocess.Popen(
        [sys.executable, "-m", "kaidan", "serve", "--port", "0", "--state", str(folder)],
        stdout=subprocess.PIPE, text=True, cwd=folder,
    )  # fmt: skip
    try:
        assert server.stdout is not None
        address = re.match(r"\S+", server.stdout.readline())[0]
        time.sleep(2.0)
        yield server, address
    finally:
        server.terminate()
        server.wait(20)


def main(arguments: argparse.Namespace) -> dict[str, float]:
    with tempfile.TemporaryDirectory() as folder, started(Path(folder)) as (server, address):
        found, every = {}, questions(arguments.different)
        for name, warm in (("new", False), ("again", True)):
            each = asyncio.run(load(address, arguments.users, arguments.seconds, every, warm))
            found |= {f"{name}_{key}": value for key, value in each.items()}
        each = asyncio.run(sliders(address, arguments.sliders, arguments.seconds / 3))
        found |= {f"slider_{key}": value for key, value in each.items()}
        found |= growth(address, server.pid, arguments.requests)
    return found | {"load_of_the_machine": os.getloadavg()[0]}


if __name__ == "__main__":
    parser = options(argparse.ArgumentParser(description=__doc__))
    parser.add_argument("--users", type=int, default=50)
    parser.add_argument("--sliders", type=int, default=21)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--different", type=int, default=300)
    parser.add_argument("--requests", type=int, default=10_000)
    arguments = parser.parse_args()
    finish(
        main(arguments),
        arguments,
        {
            "new_errors": 0,
            "new_p95_ms": 80,
            "again_errors": 0,
            "again_p95_ms": 80,
            "slider_errors": 0,
            "slider_p95_ms": 100,
            "server_growth_mb": 8,
            "handles_growth": 0,
        },
    )
