"""No request takes the server down: a worker that is killed, hangs or eats memory."""

import logging
import os
import signal
import socket
import threading
import time

import pytest

import serving
from kaidan.web.workers import Limits
from serving import LONG, served

QUESTION = {"robot": "absolem", "stairs": "ibc", "friction": 1.0, "flippers": "stowed"}


@pytest.fixture
def workers():
    """What lists those that were not there before the test, of the server that others share."""
    others = serving.workers()
    return lambda: [each for each in serving.workers() if each not in others]


def test_a_worker_killed_in_a_request_is_one_clean_error(workers):
    with served() as client:
        answers = []
        asking = threading.Thread(
            target=lambda: answers.append(client.post("/api/sweep", json=LONG))
        )
        asking.start()
        time.sleep(1.0)
        *others, worker = workers()
        os.kill(worker, signal.SIGKILL)
        asking.join()
        assert answers[0].status_code == 503
        assert answers[0].json() == {
            "error": "the process that worked on this died; ask again",
            "kind": "died",
        }
        assert client.post("/api/assess", json=QUESTION).status_code == 200
        assert worker not in workers()
        assert set(others) <= set(workers())


def test_a_worker_killed_between_requests_is_not_noticed(workers):
    with served() as client:
        assert client.post("/api/assess", json=QUESTION).status_code == 200
        for worker in workers():
            os.kill(worker, signal.SIGKILL)
        time.sleep(0.2)
        other = QUESTION | {"friction": 1.1}
        assert client.post("/api/assess", json=other).status_code == 200


def test_what_hangs_ends():
    with served(limits=Limits(seconds=1.0)) as client:
        began = time.monotonic()
        answer = client.post("/api/sweep", json=LONG)
        assert time.monotonic() - began < 10.0  # a second, and what a loaded machine adds
        assert answer.status_code == 422
        assert answer.json()["kind"] == "time"
        assert "no answer within 1 s" in answer.json()["error"]


def test_what_eats_memory_ends():
    with served(limits=Limits(memory=1 << 30)) as client:
        answer = client.post("/api/margin", json={"robot": "kenaf", "points": 10**9})
        assert answer.status_code == 422
        assert answer.json()["kind"] in ("memory", "input")
        assert client.post("/api/assess", json=QUESTION).status_code == 200


def test_a_client_that_leaves_in_the_middle_of_its_body_is_no_fault(caplog):
    with served() as client:
        logger = logging.getLogger("uvicorn.error")
        logger.addHandler(caplog.handler)
        try:
            url = client.base_url
            with socket.create_connection((url.host, url.port)) as connection:
                head = (
                    f"POST /api/assess HTTP/1.1\r\nHost: {url.host}:{url.port}\r\n"
                    "Content-Type: application/json\r\nContent-Length: 1000\r\n\r\n"
                )
                connection.sendall(head.encode() + b'{"robot"')
            assert client.post("/api/assess", json=QUESTION).status_code == 200
        finally:
            logger.removeHandler(caplog.handler)
    assert caplog.records == []


def test_too_many_at_once_are_sent_away_and_nothing_is_left_behind(tmp_path, workers):
    with served(limits=Limits(seconds=5.0, waiting=0), state=tmp_path) as client:
        answer = client.post("/api/assess", json=QUESTION)
        assert answer.status_code == 503
        assert answer.headers["retry-after"] == "1"
    assert workers() == []
    assert not (tmp_path / "passing").exists()


@pytest.mark.parametrize(
    ("content", "kind"),
    [
        (b"", "input"),
        (b"[1]", "input"),
        (b'{"robot": NaN}', "input"),
        (b"[" * 100_000, "input"),
        (b'{"robot": "\xff"}', "input"),
        (b'{"robot": "kenaf", "stairs": "ibc", "friction": 1' + b"0" * 5000 + b"}", "input"),
        (b'{"verb": "assess", "body": {"robot": "\\ud800", "stairs": "ibc"}}', "input"),
        (b" " * (3 << 20), "too-large"),
    ],
    ids=["empty", "list", "NaN", "deep", "no UTF-8", "digits", "surrogate", "large"],
)
@pytest.mark.parametrize("verb", ["assess", "jobs", "live", "report"])
def test_a_body_that_is_none_is_refused(client, verb, content, kind):
    header = {"content-type": "application/json"}
    answer = client.post(f"/api/{verb}", content=content, headers=header)
    assert 400 <= answer.status_code < 500
    assert answer.json()["kind"] == kind


def test_an_upload_is_read_by_its_content_and_leaves_nothing(tmp_path):
    with served(state=tmp_path) as client:
        sent = {"file": ("../../../etc/passwd", b"0,0\n1,0\n1,1\n2,1\n")}
        answer = client.post("/api/read", files=sent)
        assert "passwd" not in answer.text
        assert answer.status_code in (200, 422)
        assert client.post("/api/read", data={"file": "text"}).status_code == 422
        left = [each for each in (tmp_path / "passing").rglob("*") if each.is_file()]
        assert left == []


def test_a_form_that_is_held_in_memory_is_not_read(client):
    """A form without a file may be as large as one with it."""
    began = time.monotonic()
    answer = client.post("/api/read", data={"file": "x" * (8 << 20)})
    assert (answer.status_code, answer.json()["kind"]) == (422, "input")
    assert "send multipart/form-data" in answer.json()["error"]
    fields = {"hint": "x" * (1 << 20)}
    answer = client.post("/api/read", files={"file": b"0,0"}, data=fields)
    assert answer.status_code == 400
    assert time.monotonic() - began < 30.0


@pytest.mark.parametrize(
    "content",
    [
        b'{"asset": {"version": "2.0"}, "accessors": [], "buffers": [{"byteLength": 9, '
        b'"uri": "../../../../../../../etc/passwd"}]}',
        b'<robot name="r"><link name="b"><visual><geometry><mesh filename="/etc/passwd"/>'
        b"</geometry></visual></link></robot>",
        b'<?xml version="1.0"?><!DOCTYPE r [<!ENTITY e SYSTEM "file:///etc/passwd">]>'
        b'<robot name="&e;"><link name="b"/></robot>',
    ],
    ids=["gltf", "urdf", "entity"],
)
def test_a_file_leads_to_no_other_file(client, content):
    answer = client.post("/api/read", files={"file": ("model", content)})
    assert answer.status_code in (200, 422)
    assert "root:" not in answer.text
