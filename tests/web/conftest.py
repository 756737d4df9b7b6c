"""A browser without a network, and a server of this machine alone."""

import os
import shutil
import threading
import time
from contextlib import ExitStack
from pathlib import Path

import pytest

from kaidan.web.server import listening, server_of
from kaidan.web.state import State

PLACES = ("chromium", "chromium-browser", "google-chrome-stable", "google-chrome", "chrome")
VIEWPORTS = {"phone": {"width": 390, "height": 844}, "desktop": {"width": 1280, "height": 900}}


@pytest.fixture(scope="session")
def chromium():
    """Browser of the system; a test that needs one is skipped where there is none."""
    api = pytest.importorskip("playwright.sync_api", reason="skipped: no Playwright")
    place = os.environ.get("KAIDAN_CHROMIUM") or next(filter(None, map(shutil.which, PLACES)), None)
    if place is None:
        pytest.skip("skipped: no Chromium")
    with api.sync_playwright() as driver:
        browser = driver.chromium.launch(
            executable_path=place,
            # nothing but this machine answers; root has no sandbox
            args=["--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1", "--no-sandbox"],
        )
        yield browser
        browser.close()


class Running:
    """A server in a thread, that can be stopped and started again at the same address."""

    def __init__(self, folder):
        self.port, self.folder = 0, folder
        self.start()

    def start(self):
        self.opened = listening("127.0.0.1", self.port)
        self.port = self.opened.getsockname()[1]
        self.held = ExitStack()
        kept = self.held.enter_context(State(self.folder))
        self.server = server_of(kept, host="127.0.0.1", token="", workers=1)
        self.thread = threading.Thread(target=self.server.run, kwargs={"sockets": [self.opened]})
        self.thread.start()
        while not self.server.started:
            assert self.thread.is_alive()
            time.sleep(0.01)

    def stop(self):
        self.server.should_exit = True
        self.thread.join()
        self.held.close()
        self.opened.close()

    @property
    def address(self):
        return f"http://127.0.0.1:{self.port}/"


@pytest.fixture(scope="session")
def server(tmp_path_factory):
    running = Running(tmp_path_factory.mktemp("state"))
    yield running
    running.stop()


@pytest.fixture(params=VIEWPORTS)
def page(request, chromium, server):
    """Empty page, on a phone and on a desk."""
    yield from opened(chromium, server, request.param)


@pytest.fixture
def desk(chromium, server):
    """Empty page on a desk."""
    yield from opened(chromium, server, "desktop")


def opened(chromium, server, viewport):
    context = chromium.new_context(
        viewport=VIEWPORTS[viewport], base_url=server.address, locale="en-GB",
        has_touch=viewport == "phone", accept_downloads=True,
    )  # fmt: skip
    context.set_default_timeout(60_000)
    page = context.new_page()
    faults, elsewhere = [], []
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.on(
        "console", lambda said: faults.append(said.text) if "Content Security" in said.text else 0
    )
    page.on("request", lambda sent: None if sent.url.startswith((server.address, "data:", "blob:"))
            else elsewhere.append(sent.url))  # fmt: skip
    yield page
    context.close()
    assert faults == []
    assert elsewhere == []


def pictures():
    """Folder into which journeys put pictures of what they see; None: nobody asked for them."""
    place = os.environ.get("KAIDAN_PICTURES")
    return Path(place) if place else None
