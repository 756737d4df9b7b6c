"""A client that asks too fast, or again at once when it was sent away, waits; others do not."""

import asyncio
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from kaidan.web import pace
from kaidan.web.pace import BURST, REFUSAL, REQUEST, Paced


async def application(scope, receive, send):
    """It answers with the status that is its path."""
    await send({"type": "http.response.start", "status": int(scope["path"][1:]), "headers": []})
    await send({"type": "http.response.body"})


async def asked(app, status, client="192.0.2.1"):
    """Status of a request."""
    found = []

    async def send(message):
        found.append(message.get("status"))

    scope = {"type": "http", "path": f"/{status}", "client": (client, 1), "headers": []}
    await app(scope, None, send)
    return found[0]


def taken(coroutine):
    """What comes of a coroutine, and how long it took [s]."""
    began = time.monotonic()
    with ThreadPoolExecutor(1) as thread:  # a browser that other tests drive has this one's loop
        found = thread.submit(asyncio.run, coroutine()).result()
    return found, time.monotonic() - began


@pytest.mark.parametrize(("status", "cost"), [(200, REQUEST), (429, REQUEST + REFUSAL)])
def test_a_client_is_answered_at_its_pace(status, cost):
    count = round((BURST + 0.5) / cost)  # half a second more than it may be ahead

    async def run():
        app = Paced(application)
        return [await asked(app, status) for _ in range(count)]

    found, took = taken(run)
    assert set(found) == {status}
    assert took > 0.4  # half a second, less what the clock rounds and the last one waits for


def test_another_client_does_not_wait():
    async def run():
        app = Paced(application)
        loud = [asyncio.create_task(asked(app, 429)) for _ in range(100)]  # 1.9 s of waiting
        await asyncio.sleep(0.1)
        began = time.monotonic()
        assert await asked(app, 200, client="192.0.2.2") == 200
        took = time.monotonic() - began
        await asyncio.gather(*loud)
        return took

    quiet, whole = taken(run)
    assert quiet < 0.5 < whole


def test_who_would_wait_for_too_long_is_sent_away_at_once(monkeypatch):
    monkeypatch.setattr(pace, "LONGEST", 0.1)

    async def run():
        app = Paced(application)
        return await asyncio.gather(*(asked(app, 200) for _ in range(1000)))

    found, _ = taken(run)
    # so many may be ahead and wait; which of the others come late enough nobody knows
    assert found.count(200) >= (BURST + 0.1) / REQUEST
    assert found.count(429) > 0


def test_clients_of_before_are_forgotten(monkeypatch):
    monkeypatch.setattr(pace, "_MOST_CLIENTS", 10)

    async def run():
        app = Paced(application)
        for k in range(100):
            await asked(app, 200, client=f"192.0.2.{k}")
            await asyncio.sleep(REQUEST)
        return len(app._due)

    assert taken(run)[0] <= 12
