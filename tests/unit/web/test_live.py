"""Live climbs: what is fed comes out, to who knows the climb's name, and as the monitor says it."""

import http.client
import json
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from http.server import BaseHTTPRequestHandler, HTTPServer

import httpx
import pytest

import kaidan
from climbs import SLOPE, climb, csv_of, recording
from kaidan import Stairs
from kaidan.cli import run
from kaidan.errors import InputError
from kaidan.text.monitor import summary
from kaidan.verbs.monitor.sending import Channel
from kaidan.web import channels
from kaidan.web.asking import live_question
from kaidan.web.workers import Limits
from serving import served, workers

BODY = {"robot": "kenaf", "stairs": {"angle": SLOPE, "nosing_spacing": 0.150}}
ROWS = [{**row._asdict(), "acceleration": 0.0} for row in climb()]


def watched(client, name):
    """Websocket of a climb."""
    from websockets.sync.client import connect

    address = str(client.base_url).rstrip("/").replace("http", "ws")
    return connect(f"{address}/api/live/{name}", proxy=None)


def test_states_are_those_of_the_monitor_and_come_to_who_watches(client):
    head = client.post("/api/live", json=BODY).json()
    assert head["robot"] == "kenaf"
    with watched(client, head["id"]) as socket:
        assert json.loads(socket.recv(5)) == head
        sent = client.post(f"/api/live/{head['id']}", json={"samples": ROWS}).json()["states"]
        came = [json.loads(socket.recv(5)) for _ in ROWS]
    assert came == sent
    flight = Stairs.inclined(angle=SLOPE, nosing_spacing=0.150)
    from kaidan.verbs.monitor import Sample

    plain = kaidan.monitor("kenaf", flight, [Sample(**row) for row in ROWS])
    for state, expected in zip(came, plain.to_dict()["states"], strict=True):
        for name in ("t_s", "margin_deg", "time_to_tip_s", "alarm", "status"):
            assert state[name] == expected[name]
    assert [each["alarm"] for each in came[:: len(came) - 1]] == [False, True]


def test_who_comes_later_is_sent_what_was_and_again_begins_anew(client):
    name = client.post("/api/live", json=BODY).json()["id"]
    client.post(f"/api/live/{name}", json={"samples": ROWS[:3], "recorded": True})
    with watched(client, name) as socket:
        assert [json.loads(socket.recv(5))["kind"] for _ in range(4)] == ["begin"] + 3 * ["state"]
        ended = client.post(
            f"/api/live/{name}",
            json={"samples": ROWS[:1], "again": True, "end": True, "recorded": True},
        ).json()
        assert [json.loads(socket.recv(5))["kind"] for _ in range(3)] == ["begin", "state", "end"]
    assert ended["summary"].startswith("1 samples, 0 not judged")


def test_a_sensor_that_falls_silent_is_said_to_who_watches_and_a_recording_never_is(client):
    name = client.post("/api/live", json=BODY).json()["id"]
    with watched(client, name) as socket:
        client.post(f"/api/live/{name}", json={"samples": ROWS[:20], "recorded": True})
        client.post(f"/api/live/{name}", json={"samples": [ROWS[20]]})
        came = [json.loads(socket.recv(5)) for _ in range(1 + 21)]
        assert (came[-2]["due_s"], came[-1]["due_s"]) == (None, pytest.approx(0.2, abs=0.01))
        missing = json.loads(socket.recv(5))
        assert (missing["status"], missing["causes"]) == ("missing", ["silent"])
        assert missing["margin_deg"] is None
        client.post(f"/api/live/{name}", json={"samples": ROWS[21:60], "recorded": True})
        back = [json.loads(socket.recv(5))["causes"] for _ in ROWS[21:60]]
        assert (back[0], back[-1]) == (["silent"], [])
        with pytest.raises(TimeoutError):
            socket.recv(0.5)
    # who comes later knows it too
    client.post(f"/api/live/{name}", json={"samples": [ROWS[60]]})
    with watched(client, name) as socket:
        while json.loads(socket.recv(5)).get("status") != "missing":
            pass
    ended = client.post(f"/api/live/{name}", json={"end": True}).json()["summary"]
    assert "SILENT  No sample came in time." in ended


def test_limits_of_the_sensor_are_taken(client):
    limits = {"resolution": "0.1deg", "no_data_on": "3s"}
    name = client.post("/api/live", json=BODY | {"limits": limits}).json()["id"]
    slow = [
        {"t": t, "inclination": 0.6, "inclination_rate": 0, "acceleration": 0} for t in range(9)
    ]
    states = client.post(f"/api/live/{name}", json={"samples": slow, "recorded": True}).json()
    assert not any(state["alarm"] for state in states["states"])


def test_an_unknown_climb_is_neither_seen_nor_fed(client):
    from websockets.exceptions import ConnectionClosed

    assert client.post("/api/live/nothing", json={"samples": []}).status_code == 404
    with watched(client, "nothing") as socket, pytest.raises(ConnectionClosed) as closed:
        socket.recv(5)
    assert closed.value.rcvd.code == 4404


@pytest.mark.parametrize(
    ("body", "text"),
    [
        ({"samples": 5}, "samples = 5 is not a list"),
        ({"samples": [5]}, "samples[0] = 5 is not a table"),
        ({"samples": [{"t": "x"}]}, "samples[0]: t = 'x' is not a number"),
        ({"samples": [{"x": 1}]}, "samples[0]: 'x' is not known; known: t, inclination"),
        ({"samples": [{}] * 2001}, "samples: 2001 are more than 2000 at once"),
        ({"stop": 1}, "live: 'stop' is not known; known: again, end, recorded, samples"),
        ({"end": True}, "no samples came"),
    ],
)
def test_what_has_no_meaning_is_refused(client, body, text):
    name = client.post("/api/live", json=BODY).json()["id"]
    answer = client.post(f"/api/live/{name}", json=body)
    assert answer.status_code == 422
    assert text in answer.json()["error"]


def test_a_climb_that_cannot_be_watched_is_refused(client):
    for body, text in (
        ({"robot": "kenaf"}, "live: no stairs"),
        (BODY | {"limits": 5}, "limits = 5 is not a table"),
        (BODY | {"limits": {"unjudged_on": 10.5}}, "alarm: unjudged_on is not a known field"),
        (BODY | {"limits": {"margin_on": 1.0, "margin_off": 0.5}}, "margin_off"),
        ({"robot": "kenaf", "stairs": [[0, 0], [1, 0]]}, "the monitor needs the spacing"),
    ):
        answer = client.post("/api/live", json=body)
        assert answer.status_code == 422, body
        assert text in answer.json()["error"]


def test_an_origin_of_elsewhere_sees_nothing(client):
    from websockets.exceptions import InvalidStatus
    from websockets.sync.client import connect

    address = str(client.base_url).rstrip("/").replace("http", "ws")
    with (
        pytest.raises(InvalidStatus),
        connect(f"{address}/api/live/x", origin="http://evil.example", proxy=None),
    ):
        pass


def test_a_recorded_climb_becomes_samples(client, tmp_path):
    pytest.importorskip("rosbags", reason="skipped: rosbags not installed")
    plain = client.post("/api/samples", files={"file": csv_of(climb()).encode()}).json()["samples"]
    assert plain[-1]["inclination"] == climb()[-1].inclination
    bag = recording(climb(), tmp_path / "climb").read_bytes()
    found = client.post("/api/samples", files={"file": bag}, data={"nose": "up"}).json()["samples"]
    assert [each["t"] for each in found] == pytest.approx([each["t"] for each in plain])
    name = client.post("/api/live", json=BODY).json()["id"]
    states = client.post(f"/api/live/{name}", json={"samples": found}).json()["states"]
    assert states[-1]["alarm"]
    refused = client.post("/api/samples", files={"file": b"\x00\x01"})
    assert refused.status_code == 422


def test_the_sender_brings_a_file_to_the_page(client, tmp_path, capsys):
    file = tmp_path / "climb.csv"
    file.write_text(csv_of(climb()))
    stairs = tmp_path / "flight.toml"
    flight = Stairs.inclined(angle=SLOPE, nosing_spacing=0.150)
    stairs.write_text(flight.to_toml())
    words = ["live", "kenaf", str(stairs), str(file), "--to", str(client.base_url)]
    assert run(words) == 0
    page, *said = capsys.readouterr().out.splitlines()
    assert said == summary(kaidan.monitor("kenaf", flight, file)).splitlines()
    name = page.partition("#")[2]
    assert page.endswith(f"/live.html#{name}")
    assert run([*words[:-1], page, "--pace", "1000"]) == 0  # a page that waits
    assert run(["live", "kenaf", "ibc", str(file), "--to", "nowhere"]) == 2
    assert "--to 'nowhere' is no address" in capsys.readouterr().err
    assert run(["live", "kenaf", "ibc", str(file), "--to", "http://127.0.0.1:1/"]) == 2
    assert "no answer" in capsys.readouterr().err


def test_a_sensor_that_is_sent_through_a_pipe_has_to_come_in_time(client, tmp_path):
    stairs = tmp_path / "flight.toml"
    stairs.write_text(Stairs.inclined(angle=SLOPE, nosing_spacing=0.150).to_toml())
    words = ["live", "kenaf", str(stairs), "-", "--to", str(client.base_url), "--no-data", "1s"]
    with subprocess.Popen(
        [sys.executable, "-m", "kaidan", *words], encoding="utf-8",
        stdin=subprocess.PIPE, stdout=subprocess.PIPE,
    ) as process:  # fmt: skip
        name = process.stdout.readline().strip().partition("#")[2]
        with watched(client, name) as socket:
            process.stdin.write(csv_of(climb()[:30]))
            process.stdin.flush()
            came = [json.loads(socket.recv(10)) for _ in range(1 + 30)]
            assert {each["due_s"] for each in came[2:]} == {1.0}
            missing = json.loads(socket.recv(10))
            assert missing["causes"] == ["silent"]
        process.stdin.close()
        assert "SILENT  No sample came in time." in process.stdout.read()
        assert process.wait(timeout=60) == 0


class Busy(BaseHTTPRequestHandler):
    """Server that has no room for the first two requests."""

    came = 0

    def do_POST(self):
        type(self).came += 1
        self.rfile.read(int(self.headers["Content-Length"]))
        said = b'{"error": "full", "summary": "3 samples"}'
        self.send_response(200 if self.came > 2 else 503)
        self.send_header("Retry-After", "0" if self.came == 1 else "60" if self.came == 2 else "")
        self.send_header("Content-Length", str(len(said)))
        self.end_headers()
        self.wfile.write(said)

    def log_message(self, *said):
        pass


def test_the_sender_waits_for_a_server_that_is_busy_and_not_for_ever():
    with HTTPServer(("127.0.0.1", 0), Busy) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        channel = Channel(f"http://127.0.0.1:{server.server_port}/api/live/x", "", "")
        with pytest.raises(InputError, match="full"):  # again at once, then in a minute
            channel.end()
        assert Busy.came == 2
        assert channel.end() == "3 samples"
        server.shutdown()
        thread.join()


def test_a_robot_without_stated_flippers_is_watched_stowed():
    """As the monitor of the command line takes it: no plan is looked for."""
    question = live_question({"robot": "absolem", "stairs": "ibc"})
    assert (question.flippers, question.best_of) == ("stowed", ())


def test_a_watch_throws_out_no_other_one_and_a_client_has_its_share():
    flight = {"robot": "kenaf", "stairs": "ibc"}
    with served() as client:
        fed = client.post("/api/live", json=BODY).json()["id"]
        client.post(f"/api/live/{fed}", json={"samples": ROWS[:2], "recorded": True})
        codes = [client.post("/api/live", json=flight).status_code for _ in range(100)]
        assert codes == [200] * 49 + [429] * 51  # half of 100 places, of which one is taken
        answer = client.post("/api/live", json=flight)
        assert answer.json()["kind"] == "share"
        assert int(answer.headers["retry-after"]) > 0
        rest = {"samples": ROWS[2:], "recorded": True}
        states = client.post(f"/api/live/{fed}", json=rest).json()["states"]
        assert states[-1]["alarm"]  # it knows what was fed before
        place = (str(client.base_url.host), client.base_url.port)
        other = http.client.HTTPConnection(*place, source_address=("127.0.0.2", 0))
        other.request("POST", "/api/live", json.dumps(flight), {"Content-Type": "application/json"})
        assert other.getresponse().status == 200
        other.close()


def test_a_climb_that_nobody_feeds_or_watches_makes_room(monkeypatch):
    monkeypatch.setattr(channels, "MOST_CHANNELS", 2)
    monkeypatch.setattr(channels, "LEFT", 3.0)
    with served() as client:
        name = client.post("/api/live", json=BODY).json()["id"]
        with watched(client, name):
            time.sleep(3.5)
            assert client.post("/api/live", json=BODY).status_code == 429
        time.sleep(0.5)  # until the server has seen that nobody watches
        assert client.post("/api/live", json=BODY).status_code == 200
        assert client.post(f"/api/live/{name}", json={"samples": []}).status_code == 404


def test_a_climb_outlives_the_worker_that_judges_it():
    others = set(workers())
    with served() as client:
        name = client.post("/api/live", json=BODY).json()["id"]
        client.post(f"/api/live/{name}", json={"samples": ROWS[:3], "recorded": True})
        for worker in set(workers()) - others:
            os.kill(worker, signal.SIGKILL)
        time.sleep(0.2)
        said = client.post(f"/api/live/{name}", json={"samples": ROWS[3:], "recorded": True})
        assert said.json()["states"][-1]["alarm"]
        ended = client.post(f"/api/live/{name}", json={"end": True}).json()
        assert ended["summary"].startswith(f"{len(ROWS)} samples, 0 not judged")


def test_a_climb_of_too_many_flights_holds_up_nobody():
    """42 climbs of 40,000 flights: each is judged within its limits, and others are answered."""
    body = {"robot": "absolem", "stairs": ["ibc"] * 40_000, "flippers": "flat"}
    with served(limits=Limits(seconds=1.0, waiting=8)) as client:
        with ThreadPoolExecutor(42) as pool:
            text = json.dumps(body)
            head = {"content-type": "application/json"}
            address = f"{client.base_url}/api/live"
            flood = [pool.submit(httpx.post, address, content=text, headers=head, timeout=120)
                     for _ in range(42)]  # fmt: skip
            time.sleep(0.5)
            estimate = {"robot": "absolem", "stairs": "ibc", "flippers": "flat"}
            assert client.post("/api/estimate", json=estimate).status_code == 200
            answers = [each.result() for each in flood]
        assert {each.json()["kind"] for each in answers} <= {"begin", "time", "share"}
        # one at work, four in the line: the others come back as soon as a worker has ended one
        assert sum(each.status_code == 429 for each in answers) > 30
