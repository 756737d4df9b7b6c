"""Users of the server while one client floods it: latency of `assess`, beside that without a flood.

The users of `serve.py` ask from 127.0.0.1; a process of its own floods from 127.0.0.2 in six ways
at once, and asks again as soon as it is answered or sent away: climbs of 40,000 flights to be
watched, samples as many as one request may have, sweeps as jobs without a session, files that take
long to read, bodies that drip, and connections with half a head. It is Linux that lets it have an
address of its own. The flood's own work is done on the same processors.
"""

import argparse
import asyncio
import json
import os
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from record import finish, options
from serve import handles, load, memory, questions, started

FLOODER = "127.0.0.2"
WATCHED = {"robot": "absolem", "stairs": ["ibc"] * 40_000, "flippers": "flat"}
SWEEP = {"robot": "absolem", "stairs": "ibc", "flippers": "flat",
         "com_height": [0.1 + k / 1e5 for k in range(3000)]}  # fmt: skip
SAMPLES = [
    {"t": k / 100, "inclination": 0.5, "inclination_rate": 0.0, "acceleration": 0.0}
    for k in range(2000)
]
POINTS = b"".join(b"%.3f,%.3f,%.3f\n" % (k % 97, k % 89, k % 83) for k in range(100_000))
MANY = {"live": 8, "feed": 4, "jobs": 4, "files": 4, "drip": 50, "half": 400}
"""Connections of each kind."""


class Flood:
    """One client that asks for all that it can get.

    Parameters
    ----------
    port : int
        Port of the server.
    """

    def __init__(self, port: int) -> None:
        self.port, self.answers, self.climb = port, Counter(), ""

    async def forever(self, kind: str) -> None:
        while True:
            try:
                made = await asyncio.open_connection(
                    "127.0.0.1", self.port, local_addr=(FLOODER, 0)
                )
            except OSError:
                await asyncio.sleep(0.1)
                continue
            try:
                await getattr(self, kind)(*made)
            except (OSError, asyncio.IncompleteReadError):
                self.answers[kind, "ended"] += 1
            finally:
                made[1].close()

    def head(self, path: str, media: str, size: int) -> bytes:
        return (
            f"POST {path} HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: {media}\r\n"
            f"Content-Length: {size}\r\n\r\n"
        ).encode()

    async def ask(self, kind, path, body, reader, writer, media="application/json") -> bytes:
        writer.write(self.head(path, media, len(body)) + body)
        head = await reader.readuntil(b"\r\n\r\n")
        size = next(each for each in head.lower().split(b"\r\n") if b"content-length" in each)
        said = await reader.readexactly(int(size.split(b":")[1]))
        self.answers[kind, int(head.split()[1])] += 1
        return said

    async def live(self, *made) -> None:
        body = json.dumps(WATCHED).encode()
        while True:
            await self.ask("live", "/api/live", body, *made)

    async def feed(self, *made) -> None:
        while not self.climb:
            body = json.dumps(WATCHED | {"stairs": "ibc"}).encode()
            said = json.loads(await self.ask("begin", "/api/live", body, *made))
            self.climb = self.climb or said.get("id", "")
        body = json.dumps({"samples": SAMPLES, "again": True}).encode()
        while True:
            await self.ask("feed", f"/api/live/{self.climb}", body, *made)

    async def jobs(self, *made) -> None:
        body = json.dumps({"verb": "sweep", "body": SWEEP}).encode()
        while True:
            await self.ask("jobs", "/api/jobs", body, *made)

    async def files(self, *made) -> None:
        part = b'--x\r\nContent-Disposition: form-data; name="file"; filename="x.csv"\r\n\r\n'
        body = part + POINTS + b"\r\n--x--\r\n"
        while True:
            await self.ask(
                "files", "/api/read", body, *made, media="multipart/form-data;boundary=x"
            )

    async def drip(self, reader, writer) -> None:
        writer.write(self.head("/api/assess", "application/json", 100_000))
        while not reader.at_eof():
            writer.write(b" ")
            await writer.drain()
            await asyncio.sleep(1.0)

    async def half(self, reader, writer) -> None:
        writer.write(b"GET / HTTP/1.1\r\nHost: ")
        await reader.read()


async def flood(port: int) -> None:
    """Flood until the standard input is closed, as it is when the owner ends; print the sums."""
    one = Flood(port)
    every = [
        asyncio.create_task(one.forever(kind)) for kind, many in MANY.items() for _ in range(many)
    ]
    await asyncio.to_thread(sys.stdin.read)
    for task in every:
        task.cancel()
    sums = sorted(one.answers.items(), key=str)
    print(", ".join(f"{kind} {how}: {many}" for (kind, how), many in sums))


def main(arguments: argparse.Namespace) -> dict[str, float]:
    found = {}
    with tempfile.TemporaryDirectory() as folder, started(Path(folder)) as (server, address):
        for name, least in (("idle", 0.5), ("flooded", 0.5005)):  # none was asked before
            words = [sys.executable, __file__, "--flood", address.rstrip("/").rpartition(":")[2]]
            pipes = dict.fromkeys(("stdin", "stdout"), subprocess.PIPE)
            other = subprocess.Popen(words, **pipes) if name == "flooded" else None
            time.sleep(5.0)
            every = questions(arguments.different, least)
            times = load(address, arguments.users, arguments.seconds, every, warm=False)
            found |= {f"{name}_{key}": value for key, value in asyncio.run(times).items()}
            found[f"{name}_load_of_the_machine"] = os.getloadavg()[0]
            found[f"{name}_server_mb"] = memory(server.pid)[server.pid]
            found[f"{name}_handles"] = handles(server.pid)
            if other is not None:
                print(other.communicate()[0].decode())
        time.sleep(30.0)  # longer than anything that was left undone may take
        found["after_server_mb"] = memory(server.pid)[server.pid]
        found["after_handles"] = handles(server.pid)
    found["ratio_of_p95"] = found["flooded_p95_ms"] / found["idle_p95_ms"]
    return found


if __name__ == "__main__":
    parser = options(argparse.ArgumentParser(description=__doc__))
    parser.add_argument("--users", type=int, default=50)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--different", type=int, default=300)
    parser.add_argument("--flood", type=int, metavar="PORT", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.flood:
        asyncio.run(flood(arguments.flood))
    else:
        targets = {"idle_errors": 0, "flooded_errors": 0, "flooded_p95_ms": 80}
        finish(main(arguments), arguments, targets)
