"""A server in a thread, and a client of it."""

import os
import subprocess
import tempfile
import threading
import time
from contextlib import ExitStack, contextmanager
from pathlib import Path

import httpx

from kaidan.web.server import listening, server_of
from kaidan.web.state import State

LONG = {"robot": "absolem", "stairs": "ibc", "flippers": "flat", "friction": 1.0,
        "com_height": [0.1 + k / 1e5 for k in range(1500)]}  # fmt: skip
"""A sweep that takes many seconds."""


def workers():
    """Workers of servers in this process, the oldest first."""
    listed = subprocess.run(
        ["ps", "--sort", "start_time,pid", "-o", "pid=,args=", "--ppid", str(os.getpid())],
        capture_output=True, text=True, check=True,
    ).stdout  # fmt: skip
    return [int(line.split()[0]) for line in listed.splitlines() if "kaidan.web.worker" in line]


@contextmanager
def served(*, host="127.0.0.1", token="", workers=1, state=None, **how):
    """Client of a server that runs in a thread, on a port that was free."""
    with ExitStack() as stack:
        folder = state or Path(stack.enter_context(tempfile.TemporaryDirectory()))
        opened = stack.enter_context(listening(host, 0))
        kept = stack.enter_context(State(folder))
        server = server_of(kept, host=host, token=token, workers=workers, **how)
        thread = threading.Thread(target=server.run, kwargs={"sockets": [opened]})
        thread.start()
        while not server.started:
            assert thread.is_alive()
            time.sleep(0.01)
        try:
            port = opened.getsockname()[1]
            with httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=60) as client:
                yield client
        finally:
            server.should_exit = True
            thread.join()
