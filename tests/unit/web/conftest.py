import threading
import time
from contextlib import contextmanager

import httpx
import pytest

from kaidan.web.server import listening, server_of


@contextmanager
def served(*, host="127.0.0.1", token="", workers=1):
    """Client of a server that runs in a thread, on a port that was free."""
    with listening(host, 0) as opened:
        server = server_of(host=host, token=token, workers=workers)
        thread = threading.Thread(target=server.run, kwargs={"sockets": [opened]})
        thread.start()
        while not server.started:
            time.sleep(0.01)
        try:
            port = opened.getsockname()[1]
            with httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=60) as client:
                yield client
        finally:
            server.should_exit = True
            thread.join()


@pytest.fixture(scope="module")
def client():
    with served() as found:
        yield found
