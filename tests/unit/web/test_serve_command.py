"""``kaidan serve`` as a process: what it says, whom it keeps out, and what a kill leaves behind."""

import os
import re
import signal
import socket
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import httpx
import pytest

from kaidan.cli import run
from kaidan.web.server import listening


@contextmanager
def command(*words, folder):
    """Process of the command, and the address that it says."""
    started = subprocess.Popen(
        [sys.executable, "-m", "kaidan", "serve", "--port", "0", "--workers", "1",
         "--state", str(folder), *words],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    try:
        yield started, started.stdout.readline().strip()
    finally:
        started.kill()
        started.communicate()


def answered(address):
    """Status of a server that may still be starting."""
    end = time.monotonic() + 120
    while True:
        try:
            return httpx.get(address, timeout=10).status_code
        except httpx.TransportError:
            assert time.monotonic() < end
            time.sleep(0.1)


def gone(pid):
    """Whether a process ends soon."""
    end = time.monotonic() + 60
    while time.monotonic() < end:
        try:
            state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
        except FileNotFoundError:
            return True
        if state == "Z":
            return True
        time.sleep(0.1)
    return False


@pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="skipped: no /proc")
def test_a_killed_server_leaves_no_process_and_the_next_one_no_file(tmp_path):
    with command(folder=tmp_path) as (first, address):
        assert re.fullmatch(r"http://127\.0\.0\.1:\d+/", address)
        assert answered(address + "api/catalogue") == 200
        listed = subprocess.run(
            ["ps", "-o", "pid=", "--ppid", str(first.pid)], capture_output=True, text=True
        ).stdout.split()
        (tmp_path / "passing" / "left").write_text("of a client")
        first.send_signal(signal.SIGKILL)
        first.wait()
        assert all(gone(int(pid)) for pid in listed)
    with command(folder=tmp_path) as (second, address):
        assert answered(address + "api/catalogue") == 200
        assert not (tmp_path / "passing" / "left").exists()
        assert (tmp_path / "key").stat().st_mode & 0o077 == 0
        assert tmp_path.stat().st_mode & 0o077 == 0
        with command(folder=tmp_path) as (third, said):
            assert said == ""
            assert third.wait(120) == 2
            assert "another server keeps its state there" in third.stderr.read()
        second.send_signal(signal.SIGINT)
        assert second.wait(120) in (0, 130)
        assert "Traceback" not in second.stderr.read()


def test_elsewhere_it_makes_a_token_and_warns(tmp_path):
    with command("--host", "0.0.0.0", folder=tmp_path) as (started, address):
        token = re.fullmatch(r"http://0\.0\.0\.0:\d+/\?token=([\w-]{32})", address)[1]
        here = address.replace("0.0.0.0", "127.0.0.1")
        assert answered(here.partition("?")[0]) == 401
        assert answered(here.partition("?")[0] + f"?token={token}") == 303
        started.send_signal(signal.SIGINT)
        said = started.communicate(timeout=120)[1]
        assert "nothing is encrypted" in said
        assert token not in said


def test_a_port_that_is_taken_is_one_line(capsys, tmp_path):
    with listening("127.0.0.1", 0) as opened:
        assert opened.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY) == 1
        port = str(opened.getsockname()[1])
        assert run(["serve", "--port", port, "--state", str(tmp_path)]) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"kaidan: cannot listen at 127.0.0.1, port {port}: ")
    assert said.count("\n") == 1


def test_without_the_extra_it_says_what_to_install(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "fastapi", None)
    assert run(["serve"]) == 2
    assert "pip install 'kaidan[web]'" in capsys.readouterr().err
