"""A full disk: what needs room is refused with 507 and leaves nothing, everything else goes on."""

import subprocess
import sys
import time

import httpx
import pytest

from kaidan.cli import run

resource = pytest.importorskip("resource", reason="skipped: no bounds on files here")

ROOM = 65_536
"""Largest file that the server may write [bytes]: the bound stands for a disk that is full."""
PROGRAM = (
    "import resource, sys; from kaidan.cli import run; "
    f"resource.setrlimit(resource.RLIMIT_FSIZE, ({ROOM}, {ROOM})); sys.exit(run(sys.argv[1:]))"
)
QUESTION = {"robot": "kenaf", "stairs": "ibc", "friction": 1.0}
LARGE = {"file": ("stairs.csv", b"0,0\n1,0\n1,1\n2,1\n" * (ROOM // 8))}


@pytest.fixture(scope="module")
def full(tmp_path_factory):
    """Client of a server that has little room, and its folder."""
    folder = tmp_path_factory.mktemp("state")
    words = ["serve", "--port", "0", "--workers", "1", "--state", str(folder)]
    command = [sys.executable, "-c", PROGRAM, *words]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        address = server.stdout.readline().strip()
        with httpx.Client(base_url=address, timeout=120) as client:
            yield client, folder
        server.terminate()


def left(folder):
    """Files of clients and folders of jobs."""
    files = [each for each in (folder / "passing").rglob("*") if each.is_file()]
    return files + [each for each in (folder / "jobs").iterdir() if each.is_dir()]


@pytest.mark.parametrize(
    ("address", "asked"),
    [
        ("/api/read", {"files": LARGE}),
        ("/api/jobs", {"files": LARGE, "data": {"verb": "read", "body": "{}"}}),
        ("/api/jobs", {"json": {"verb": "assess", "body": {"robot": "x" * 4 * ROOM}}}),
    ],
    ids=["file", "job with a file", "large job"],
)
def test_what_does_not_fit_is_refused_and_leaves_nothing(full, address, asked):
    client, folder = full
    answer = client.post(address, **asked)
    assert answer.status_code == 507
    assert answer.json()["kind"] == "full"
    assert left(folder) == []
    assert client.get("/api/jobs").json() == {"jobs": []}
    assert client.post("/api/estimate", json=QUESTION).status_code == 200


def test_a_job_whose_result_does_not_fit_has_failed_for_that(full):
    client, folder = full
    job = client.post(
        "/api/jobs", json={"verb": "margin", "body": {"robot": "kenaf", "points": 5_000}}
    )
    end = time.monotonic() + 120
    while (now := client.get(f"/api/jobs/{job.json()['id']}").json())["state"] != "failed":
        assert time.monotonic() < end, now
        time.sleep(0.1)
    assert now["error"]["kind"] == "full"
    assert [each for folder in left(folder) for each in folder.iterdir()] == []


def test_a_key_that_was_not_written_whole_is_refused(tmp_path, capsys):
    (tmp_path / "key").touch()
    assert run(["serve", "--port", "0", "--state", str(tmp_path)]) == 2
    assert "no key of a server" in capsys.readouterr().err
