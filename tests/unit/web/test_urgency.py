"""Quick questions do not wait for long ones, and what nobody waits for leaves the line."""

import asyncio
import contextlib
import json
import os
import select
import socket
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from kaidan.web.bodies import while_there
from kaidan.web.remembered import Remembered
from kaidan.web.urgency import QUICK as QUICK_NICE
from kaidan.web.urgency import THOROUGH, Hands, is_quick
from kaidan.web.workers import Limits, Reply, Workers
from serving import LONG, served

QUICK = {"robot": "absolem", "stairs": "ibc", "friction": 1.0, "flippers": "stowed"}
"""A question that is answered at once."""
ME = "127.0.0.1"
"""A client."""
BEST = {"robot": "absolem-flat", "stairs": "ibc", "friction": 1.0, "flippers": "best"}
"""One for which a posture is to be found."""


def _run(coroutine):
    # in a thread of its own: a browser that other tests drive leaves its event loop in this one
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(asyncio.run, coroutine).result()


def test_a_quick_question_does_not_wait_for_a_long_one():
    text = json.dumps(LONG)
    with served() as client:
        place = (client.base_url.host, client.base_url.port)
        with socket.create_connection(place) as asking:
            head = f"POST /api/sweep HTTP/1.1\r\nHost: {place[0]}:{place[1]}\r\n"
            head += f"Content-Type: application/json\r\nContent-Length: {len(text)}\r\n\r\n"
            asking.sendall((head + text).encode())
            time.sleep(0.2)
            assert client.post("/api/assess", json=QUICK).status_code == 200
            assert select.select([asking], [], [], 0)[0] == []  # no answer yet


@pytest.mark.parametrize("verb", ["estimate", "assess"])
def test_a_prepared_worker_imports_nothing_for_its_first_question(verb):
    program = (
        "import sys; from kaidan.web import tasks; tasks.prepare(sys.argv[1]); "
        "before = set(sys.modules); "
        "body = {'robot': 'absolem', 'stairs': 'ada', 'friction': 0.7, 'flippers': 'stowed'}; "
        "head, _ = tasks.done({'kind': 'ask', 'verb': sys.argv[1], 'body': body}); "
        "print(head['status'], sorted(set(sys.modules) - before))"
    )
    command = [sys.executable, "-c", program, verb]
    said = subprocess.run(command, capture_output=True, text=True, check=True)
    assert said.stdout == "200 []\n"


def test_the_estimate_is_the_closed_form_without_advice(client):
    gentle = {"angle": "30deg", "nosing_spacing": "150mm"}
    asked = {"robot": "kenaf", "stairs": gentle, "friction": 0.3}
    found = client.post("/api/estimate", json=asked).json()
    whole = client.post("/api/assess", json=asked | {"model": "closed-form"}).json()
    assert found["what_would_help"] == []
    assert whole["what_would_help"] != []
    assert found["findings"] == whole["findings"]
    assert found["verdict"] == whole["verdict"] != "go"


@pytest.mark.parametrize(
    ("verb", "body", "quick"),
    [
        ("assess", {"flippers": "flat"}, True),
        ("assess", {"flippers": ["flat", {}]}, True),
        ("assess", {}, False),
        ("assess", {"flippers": "best"}, False),
        ("assess", {"flippers": "flat", "model": "physics"}, False),
        ("assess", {"question": {"best_of": [], "model": "contact"}}, True),
        ("assess", {"question": {"best_of": ["flippers"]}}, False),
        ("assess", {"question": 7}, False),
        ("estimate", {}, True),
        ("margin", {}, True),
        ("sweep", {"flippers": "flat"}, False),
        ("margin", {"stairs": ["ibc"] * 40_000}, False),
        ("assess", {"flippers": "flat", "stairs": "ibc+ibc+ibc"}, True),
        ("assess", {"flippers": "flat", "stairs": "ibc+ibc+ibc+ibc"}, False),
        ("assess", {"flippers": "flat", "stairs": [[k, k] for k in range(300)]}, True),
        ("assess", {"flippers": "flat", "stairs": [[k, k] for k in range(400)]}, False),
        ("assess", {"question": {"best_of": [], "terrain": [{}, {}, {}, {}]}}, False),
        ("estimate", {"robot": {"title": "long" * 20_000}}, False),
    ],
)
def test_what_is_quick(verb, body, quick):
    assert is_quick({"verb": verb, "body": body}) is quick


class Counting:
    """Who answers when it may and counts what came, and what was given up."""

    def __init__(self):
        self.asked, self.given_up = 0, 0
        self.may = asyncio.Event()

    async def __call__(self, task, client):
        self.asked += 1
        try:
            await self.may.wait()
        except asyncio.CancelledError:
            self.given_up += 1
            raise
        return Reply(200, b"{}")


def test_the_same_question_at_once_is_judged_once_and_given_up_by_the_last():
    async def run():
        hands = Counting()
        known = Remembered(hands)
        first, second = (asyncio.create_task(known.ask({"q": 1}, ME)) for _ in range(2))
        await asyncio.sleep(0.01)
        first.cancel()  # the other one still waits
        await asyncio.sleep(0.01)
        hands.may.set()
        assert (await second).status == 200
        assert (hands.asked, hands.given_up) == (1, 0)
        hands.may.clear()
        alone = asyncio.create_task(known.ask({"q": 2}, ME))
        await asyncio.sleep(0.01)
        alone.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            await alone
        hands.may.set()
        again = await known.ask({"q": 2}, ME)
        assert again.status == 200
        assert (hands.asked, hands.given_up) == (3, 1)

    _run(run())


def test_an_estimate_does_not_wait_for_answers(tmp_path):
    async def run():
        hands = Hands(1, Limits(), tmp_path)
        busy = await hands.quick._free(ME)
        asked = {"kind": "ask", "verb": "assess", "body": {"flippers": "flat"}}
        answer = asyncio.create_task(hands.ask(asked, ME))
        await asyncio.sleep(0)
        estimate = {"kind": "ask", "verb": "estimate", "body": QUICK}
        found = await hands.ask(estimate, ME)
        assert found.status == 200
        assert not answer.done()
        answer.cancel()
        hands.quick._release(busy, ME)
        await hands.__aexit__(None, None, None)

    _run(run())


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_workers_are_of_one_session_in_which_estimates_go_first(tmp_path):
    # between sessions, niceness means nothing where the kernel makes groups of them
    async def run():
        async with Hands(1, Limits(), tmp_path) as hands:
            for verb, body in (("estimate", QUICK), ("assess", QUICK), ("assess", BEST)):
                found = await hands.ask({"kind": "ask", "verb": verb, "body": body}, ME)
                assert found.status == 200
            every = (hands.estimates, hands.quick, hands.thorough)
            return [next(iter(each._all)).process.pid for each in every], [
                _of_process(worker.process.pid) for each in every for worker in each._all
            ]

    pids, found = _run(run())
    own = os.getpriority(os.PRIO_PROCESS, 0)
    wanted = [min(own + by, 19) for by in (0, QUICK_NICE, THOROUGH)]
    assert found == [(pid, os.getsid(0), nice) for pid, nice in zip(pids, wanted, strict=True)]


def _of_process(pid):
    """Group, session and niceness of a process."""
    return os.getpgid(pid), os.getsid(pid), os.getpriority(os.PRIO_PROCESS, pid)


def test_the_line_goes_in_turn_and_who_gives_up_leaves_it(tmp_path):
    async def run():
        order = []

        async def ask(hands, name, client=ME):
            asked = {"kind": "ask", "verb": "estimate", "body": {"name": name}}
            await hands.ask(asked, client)
            order.append(name)

        async with Workers(1, Limits(), tmp_path) as hands:
            names = ("first", "gone", "second", "third")
            line = [asyncio.create_task(ask(hands, name)) for name in names]
            await asyncio.sleep(0)
            line[1].cancel()
            await asyncio.gather(*line, return_exceptions=True)
        return order

    assert _run(run()) == ["first", "second", "third"]


def test_clients_take_turns_and_one_has_half_of_the_line(tmp_path):
    async def run():
        order = []

        async def ask(hands, client):
            task = {"kind": "ask", "verb": "estimate", "body": {}}
            reply = await hands.ask(task, client)
            order.append((client, reply.status))

        async with Workers(1, Limits(waiting=4), tmp_path) as hands:
            clients = ("loud", "loud", "loud", "loud", "quiet", "calm", "late")
            await asyncio.gather(*(ask(hands, client) for client in clients))
        return order

    # one is at work, two of one client may wait, then one of each other, and four in all
    answered = [("loud", 422), ("loud", 422), ("quiet", 422), ("calm", 422), ("loud", 422)]
    assert _run(run()) == [("loud", 429), ("late", 503), *answered]


def test_one_client_leaves_workers_for_another(tmp_path):
    """However long its tasks take: of two workers it keeps one busy."""

    async def run():
        async with Workers(2, Limits(), tmp_path, most=1) as hands:
            held = await hands._free("loud")
            more = asyncio.create_task(hands._free("loud"))
            await asyncio.sleep(0)
            assert not more.done()
            task = {"kind": "ask", "verb": "estimate", "body": QUICK}
            assert (await hands.ask(task, "quiet")).status == 200
            assert not more.done()
            hands._release(held, "loud")
            return await more

    _run(run())


class Leaving:
    """A request whose client leaves after a while."""

    def __init__(self, seconds):
        self.seconds = seconds

    async def receive(self):
        await asyncio.sleep(self.seconds)
        return {"type": "http.disconnect"}


@pytest.mark.parametrize(("seconds", "status", "given_up"), [(0.02, 499, 1), (60.0, 200, 0)])
def test_what_a_client_asked_that_has_gone_is_given_up(seconds, status, given_up):
    async def run():
        hands = Counting()
        if not given_up:
            hands.may.set()
        found = await while_there(Leaving(seconds), Remembered(hands).ask({"q": 1}, ME))
        await asyncio.sleep(0.01)
        return found.status_code, hands.given_up

    assert _run(run()) == (status, given_up)
