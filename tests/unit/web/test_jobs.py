"""Long work in the background: progress, cancelling, going on, and nobody else's."""

import json
import time

import httpx
import pytest

import kaidan
from kaidan.web import jobs
from serving import served

MANY = {"robot": "absolem", "stairs": "ibc", "flippers": "flat",
        "com_height": [0.1 + k / 1e5 for k in range(3000)]}  # fmt: skip
"""A sweep that takes minutes."""
SWEEP = {"robot": "absolem", "stairs": "ibc", "flippers": "flat", "friction": [0.8, 1.0, 1.2]}


def until(client, job, holds, seconds=180.0):
    """Wait until something holds of a job."""
    end = time.monotonic() + seconds
    while not holds(client.get(f"/api/jobs/{job['id']}").json()):
        assert time.monotonic() < end
        time.sleep(0.02)


def ended(client, job):
    """Job once it is over."""
    until(client, job, lambda now: now["state"] not in ("queued", "running"))
    return client.get(f"/api/jobs/{job['id']}").json()


def begun(client, verb, body):
    answer = client.post("/api/jobs", json={"verb": verb, "body": body})
    assert answer.status_code == 201, answer.text
    return answer.json()


def test_a_job_comes_to_what_the_verb_answers(client):
    job = begun(client, "sweep", SWEEP)
    done = ended(client, job)
    assert (done["state"], done["about"]) == ("done", "absolem / ibc")
    said = client.post("/api/text/sweep", json=SWEEP).json()["text"]
    assert client.get(f"/api/jobs/{job['id']}/text").text == said
    assert client.get(done["result"]).json() == client.post("/api/sweep", json=SWEEP).json()
    assert [each["id"] for each in client.get("/api/jobs").json()["jobs"]] == [job["id"]]
    assert client.delete(f"/api/jobs/{job['id']}").status_code == 204
    assert client.get("/api/jobs").json() == {"jobs": []}


def test_a_report_is_a_job_too(client):
    body = {"robot": "kenaf", "stairs": "ibc", "friction": 1.0, "format": "html"}
    done = ended(client, begun(client, "report", body))
    held, at_once = client.get(done["result"]), client.post("/api/report", json=body)
    assert held.headers["content-type"] == "text/html; charset=utf-8"
    assert held.text == at_once.text
    policy = held.headers["content-security-policy"]  # its own style shows, nothing of it runs
    assert policy == at_once.headers["content-security-policy"]
    assert "style-src 'unsafe-inline'" in policy
    assert "script-src" not in policy
    wrong = ended(client, begun(client, "report", body | {"format": "doc"}))
    assert "known: html, pdf" in wrong["error"]["error"]


def test_events_end_with_what_became_of_it(client):
    job = begun(client, "compare", {"robots": ["kenaf"], "stairs": ["ibc", "ada"], "friction": 1})
    with client.stream("GET", f"/api/jobs/{job['id']}/events") as stream:
        assert stream.headers["content-type"].startswith("text/event-stream")
        lines = [line for line in stream.iter_lines() if line.startswith("data: ")]
    last = json.loads(lines[-1].removeprefix("data: "))
    assert last["state"] == "done"


def test_a_failed_job_says_why(client):
    done = ended(client, begun(client, "assess", {"robot": "nobody", "stairs": "ibc"}))
    assert done["state"] == "failed"
    assert done["error"]["kind"] == "input"
    assert "no robot is called 'nobody'" in done["error"]["error"]
    assert client.get(f"/api/jobs/{done['id']}/result").status_code == 409


def test_nobody_sees_the_job_of_another(client):
    job = begun(client, "assess", {"robot": "kenaf", "stairs": "ibc"})
    with httpx.Client(base_url=client.base_url) as stranger:
        for method, end in (("GET", ""), ("GET", "/result"), ("GET", "/events"), ("DELETE", "")):
            answer = stranger.request(method, f"/api/jobs/{job['id']}{end}")
            assert answer.status_code == 404
            assert answer.json() == {"error": "no such job", "kind": "not-found"}
        assert stranger.get("/api/jobs").json() == {"jobs": []}
        forged = {"X-Kaidan-Session": "somebody.0123"}
        assert stranger.get(f"/api/jobs/{job['id']}", headers=forged).status_code == 404
    assert client.get(f"/api/jobs/{job['id']}").status_code == 200


def test_jobs_of_many_sessions_are_not_more_than_the_server_holds(monkeypatch):
    monkeypatch.setattr(jobs, "MOST_OF_ALL", 1)
    with served() as client:
        begun(client, "sweep", MANY)
        answer = client.post("/api/jobs", json={"verb": "assess", "body": {}})
    assert answer.status_code == 429  # one is the share of an address, too
    assert "1 jobs of your address wait or run already" in answer.json()["error"]
    assert answer.json()["kind"] == "share"


def test_who_forgets_its_session_leaves_room_for_others_of_its_address():
    with served() as client:
        begun(client, "assess", {"robot": "kenaf", "stairs": "ibc"})  # has a session from here on
        address = f"{client.base_url}/api/jobs"
        asked = {"verb": "sweep", "body": MANY}
        flood = [httpx.post(address, json=asked) for _ in range(130)]
        taken = [each.status_code for each in flood].count(201)
        # with the first, as many as one session may have; the first may have ended meanwhile
        assert jobs.MOST_WAITING - 1 <= taken <= jobs.MOST_WAITING
        assert {each.status_code for each in flood} == {201, 429}
        assert int(flood[-1].headers["retry-after"]) > 0
        mine = begun(client, "assess", {"robot": "kenaf", "stairs": "ada", "friction": 1})
        assert ended(client, mine)["state"] == "done"  # it waits for none of the flood


def test_what_ended_keeps_its_result_and_no_more(tmp_path):
    with served(state=tmp_path) as client:
        sent = {"file": ("stairs.csv", b"0,0\n1,0\n1,1\n2,1\n" * 1000)}
        answer = client.post("/api/jobs", data={"verb": "read", "body": "{}"}, files=sent)
        assert ended(client, answer.json())["state"] == "failed"
        done = ended(client, begun(client, "sweep", SWEEP))
        left = [each for each in (tmp_path / "jobs").rglob("*") if each.is_file()]
        assert {each.name for each in left if each.parent.name == done["id"]} == {"result", "text"}
        assert {each.parent.name for each in left} == {done["id"], "jobs"}
        assert client.get("/api/jobs").json()["jobs"][-1]["about"] == "absolem / ibc"


@pytest.mark.parametrize(
    ("asked", "text"),
    [
        ({"verb": "swep", "body": {}}, "did you mean sweep?"),
        ({"verb": "read", "body": {}}, "read: no file"),
        ({"verb": "assess", "body": 3}, "body = 3 is not a table"),
    ],
)
def test_what_is_no_job_is_refused(client, asked, text):
    answer = client.post("/api/jobs", json=asked)
    assert answer.status_code == 422
    assert text in answer.json()["error"]


def test_jobs_go_on_when_the_server_comes_back(tmp_path):
    many = SWEEP | {"com_height": [0.1 + k / 1e4 for k in range(40)], "friction": 1.0}
    with served(state=tmp_path) as client:
        job = begun(client, "sweep", many)
        until(client, job, lambda now: now["progress"]["done"] > 0)
        waiting = begun(client, "assess", {"robot": "kenaf", "stairs": "ibc", "friction": 1})
        cookies = client.cookies
    with served(state=tmp_path) as client:
        client.cookies = cookies
        found = ended(client, job)
        assert found["state"] == "done", found
        result = client.get(found["result"]).json()
        assert result["cells"] == 40
        last = client.get(ended(client, waiting)["result"]).json()
        assert last == kaidan.assess("kenaf", "ibc", friction=1).to_dict()


def test_a_long_job_keeps_no_other_session_from_working(client):
    long = begun(client, "sweep", MANY)
    until(client, long, lambda now: now["state"] == "running")
    behind = begun(client, "assess", {"robot": "kenaf", "stairs": "ibc"})
    with httpx.Client(base_url=client.base_url, timeout=60) as other:
        job = begun(other, "assess", {"robot": "kenaf", "stairs": "ibc"})
        assert ended(other, job)["state"] == "done"
    assert client.get(f"/api/jobs/{long['id']}").json()["state"] == "running"
    assert client.get(f"/api/jobs/{behind['id']}").json()["state"] == "queued"
    for each in (behind, long):
        client.delete(f"/api/jobs/{each['id']}")


def test_a_running_job_can_be_cancelled(client):
    job = begun(client, "sweep", MANY)
    until(client, job, lambda now: now["state"] == "running")
    assert client.delete(f"/api/jobs/{job['id']}").status_code == 204
    assert client.get(f"/api/jobs/{job['id']}").status_code == 404
    after = begun(client, "assess", {"robot": "kenaf", "stairs": "ibc"})
    assert ended(client, after)["state"] == "done"
