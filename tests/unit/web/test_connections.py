"""Connections end when their client does not go on, and an address has its share of them."""

import select
import socket
import threading
import time
from contextlib import ExitStack

import pytest

from kaidan.web import connections
from kaidan.web.connections import Connection, Patience
from serving import served

QUESTION = {"robot": "kenaf", "stairs": "ibc", "friction": 1.0}
HEAD = b"POST /api/estimate HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\n"
SHORT = Patience(head=1.0, grace=0.1, body=1.0, rate=1e6, reading=1.0)
"""Times that a test can wait for."""


@pytest.fixture
def server(monkeypatch):
    """Client of a server that waits for little."""
    monkeypatch.setattr(Connection, "patience", SHORT)
    with served() as client:
        yield client


def opened(client, said=b"", source="127.0.0.1"):
    """Connection on which something was said."""
    place = (client.base_url.host, client.base_url.port)
    made = socket.create_connection(place, timeout=30, source_address=(source, 0))
    made.sendall(said)
    return made


def rest(made):
    """What still comes until the connection ends, and how long that takes [s]."""
    began, came = time.monotonic(), b""
    try:
        while piece := made.recv(65_536):
            came += piece
    except ConnectionResetError:
        pass
    return came, time.monotonic() - began


@pytest.mark.parametrize(
    "said",
    [b"", b"\r\n", b"GET / HTTP/1.1\r\nHost: ", HEAD + b"Content-Length: 100\r\n\r\n{"],
    ids=["nothing", "line end", "half a head", "half a body"],
)
def test_what_does_not_go_on_ends(server, said):
    with opened(server, said) as made:
        came, took = rest(made)
    assert came.startswith(b"HTTP/1.1 408 ")
    assert took < 10.0  # a second, and what a loaded machine adds


def test_a_body_that_drips_ends(server):
    with opened(server, HEAD + b"Content-Length: 100000\r\n\r\n") as made:
        dripping = threading.Event()

        def drip():
            try:
                while not dripping.wait(0.1):
                    made.sendall(b" ")
            except OSError:
                pass

        threading.Thread(target=drip).start()
        came, took = rest(made)
        dripping.set()
    assert came.startswith(b"HTTP/1.1 408 ")
    assert took < 10.0


def test_a_body_that_comes_slowly_enough_is_taken(server, monkeypatch):
    """At the least rate there is no end, however long it takes."""
    monkeypatch.setattr(Connection, "patience", SHORT._replace(rate=10.0))
    body = b'{"robot": "kenaf", "stairs": "ibc", "friction": 1.0}'
    with opened(server, HEAD + b"Content-Length: %d\r\n\r\n" % len(body)) as made:
        for k in range(0, len(body), 10):
            made.sendall(body[k : k + 10])
            time.sleep(0.5)
        assert made.recv(15) == b"HTTP/1.1 200 OK"


def _go_on(made, end):
    while time.monotonic() < end:
        made.sendall(b" ")
        time.sleep(0.1)


def test_who_reads_nothing_is_left(server):
    with opened(server) as made:
        made.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        for _ in range(200):  # more than the system keeps for who does not read
            if not select.select([], [made], [], 0.2)[1]:
                break
            made.sendall(b"GET /api/openapi.json HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n" * 10)
        end = time.monotonic() + 30
        with pytest.raises(OSError, match=r"reset|[Bb]roken"):
            _go_on(made, end)


def test_a_head_without_end_is_refused(server):
    with opened(server, b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX: " + b"x" * 70_000) as made:
        assert rest(made)[0].startswith(b"HTTP/1.1 431 ")


def test_a_long_answer_is_waited_for(monkeypatch):
    """What the server takes longer for than the client may is no fault of the client."""
    monkeypatch.setattr(Connection, "patience", Patience(head=0.05, body=0.05, reading=0.05))
    monkeypatch.setattr(connections, "_EVERY", 0.01)
    asked = {"robot": "absolem", "stairs": "ibc+ibc+ibc", "flippers": "flat", "friction": 0.9}
    with served() as client:
        began = time.monotonic()
        assert client.post("/api/assess", json=asked).status_code == 200
        assert time.monotonic() - began > 0.1


def test_half_sent_requests_keep_nobody_out():
    with served() as client, ExitStack() as stack:
        for _ in range(400):
            stack.enter_context(opened(client, b"GET / HTTP/1.1\r\nHost: "))
        time.sleep(Patience().grace)
        began = time.monotonic()
        assert client.post("/api/estimate", json=QUESTION).status_code == 200
        assert time.monotonic() - began < 10.0


def test_an_address_that_is_busy_with_all_it_may_have_leaves_room_for_another(monkeypatch):
    monkeypatch.setattr(Connection, "patience", SHORT._replace(body=60.0, connections=8))
    with served() as client, ExitStack() as stack:
        said = HEAD + b"Content-Length: 100\r\n\r\n{"
        for _ in range(4):
            stack.enter_context(opened(client, said, source="127.0.0.2"))
        time.sleep(0.5)
        with opened(client, said, source="127.0.0.2") as one_more:
            came, _ = rest(one_more)
        assert came.startswith(b"HTTP/1.1 503 ")
        assert b"retry-after: " in came
        assert client.post("/api/estimate", json=QUESTION).status_code == 200


def test_fewer_files_make_fewer_connections(monkeypatch):
    monkeypatch.setattr(connections, "_open_files", lambda: 16)
    monkeypatch.setattr(Connection, "patience", Patience(grace=0.0))
    with served() as client, ExitStack() as stack:
        idle = [stack.enter_context(opened(client)) for _ in range(30)]
        assert client.post("/api/estimate", json=QUESTION).status_code == 200
        time.sleep(0.5)
        ended = sum(bool(select.select([each], [], [], 0)[0]) for each in idle)
        assert ended >= 26  # 8 connections in all, of which one address has 4
