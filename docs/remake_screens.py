"""Take the pictures of pages that the docs show anew, or those named, in a Chromium of the system.

Look at what changes before you commit it; each stays under 100 kB.
"""

import io
import os
import shutil
import subprocess
import sys
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page, sync_playwright

STATIC = Path(__file__).parent / "_static"
LARGEST = 100_000
"""Of a picture [bytes]."""
SHOWN = (1000, 1300)
"""Largest of a picture [pixels]."""
QUESTION = "#/check?robot=absolem&stairs=ibc&surface=concrete-dry"
ANSWERED = ".light[data-verdict=unsure]"


def desk(page: Page) -> None:
    page.goto(QUESTION)
    page.wait_for_selector("svg.traverse .contact", state="attached")


def phone(page: Page) -> None:
    page.goto(f"{QUESTION}&flippers=flat")
    page.wait_for_selector(ANSWERED)
    page.evaluate("document.getElementById('answer').scrollIntoView()")


def margin(page: Page) -> None:
    page.goto(f"{QUESTION}&flippers=flat&tab=margin")
    page.wait_for_selector("#tab-margin svg.chart")
    page.evaluate("document.querySelector('.pictures').scrollIntoView()")


def building(page: Page) -> None:
    page.goto("#/building")
    page.get_by_label("Building model").set_input_files(STATIC / "house.ifc")
    for title in ("Absolem (NIFTi/TRADR, BlueBotics)", "OzBot ATR (BIA5/CSIRO)"):
        page.get_by_label(title, exact=True).check()
    page.get_by_role("combobox", name="Surface").last.select_option("concrete-dry")
    page.get_by_role("button", name="Judge the building").click()
    page.wait_for_selector(".building table")
    page.evaluate("document.querySelector('.storeys').scrollIntoView()")


def report(page: Page) -> None:
    body = {"robot": "absolem", "stairs": "ibc", "surface": "concrete-dry", "flippers": "flat"}
    made = page.request.post("/api/report", data=body)
    page.set_content(made.text().replace("color-scheme: light", "color-scheme: only light"))


def live(page: Page) -> None:
    page.goto("live.html")
    page.wait_for_selector("body[data-ready]")
    page.locator("#robot").select_option("absolem")
    page.locator("#stairs").select_option("ibc")
    page.get_by_role("textbox", name="Flippers").fill("flat")
    page.get_by_label("Speed of the replay").select_option("5")
    samples = "\n".join(
        f"{k / 10},{0.567 + 0.17 * (k / 90) ** 4:.4f},{k % 2 / 1000},0" for k in range(100)
    ).encode()  # it rears at the end
    recording = {"name": "climb.csv", "mimeType": "text/csv",
                 "buffer": b"t,inclination,inclination_rate,acceleration\n" + samples}  # fmt: skip
    page.get_by_label("Recorded climb (CSV, bag, MCAP)").set_input_files(recording)
    page.get_by_role("button", name="Replay").click()
    page.wait_for_selector("#alarm.tip_over")


SCREENS = {
    "page-desk.png": (desk, 1280, 1600, "en", "light"),
    "page-phone.png": (phone, 390, 760, "en", "contrast"),
    "page-phone-ja.png": (phone, 390, 760, "ja", "light"),
    "page-margin.png": (margin, 1024, 760, "en", "dark"),
    "page-building.png": (building, 1280, 1280, "en", "light"),
    "report.png": (report, 900, 1220, "en", "light"),
    "live.png": (live, 820, 900, "en", "light"),
}
"""What is shown by the file, the size of the screen, the language and the colours."""


def main() -> None:
    server = subprocess.Popen(
        [sys.executable, "-m", "kaidan", "serve", "--port", "0", "--workers", "1"],
        stdout=subprocess.PIPE,
        encoding="utf-8",
    )
    assert server.stdout is not None
    address = server.stdout.readline().strip()
    place = os.environ.get("KAIDAN_CHROMIUM") or shutil.which("chromium")
    try:
        with sync_playwright() as driver:
            browser = driver.chromium.launch(executable_path=place, args=["--no-sandbox"])
            for name in sys.argv[1:] or SCREENS:
                show, wide, tall, language, theme = SCREENS[name]
                page = browser.new_context(
                    viewport={"width": wide, "height": tall},
                    base_url=address,
                    reduced_motion="reduce",
                ).new_page()
                page.add_init_script(
                    f"localStorage.setItem('kaidan.language', '{language}');"
                    f"localStorage.setItem('kaidan.theme', '{theme}')"
                )
                show(page)
                page.wait_for_timeout(500)
                shot = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
                shot.thumbnail(SHOWN)
                shot = shot.quantize(255, Image.Quantize.MAXCOVERAGE)
                shot.save(STATIC / name, optimize=True)
                size = (STATIC / name).stat().st_size
                assert size <= LARGEST, f"{name}: {size} bytes"
                print(name, size)
            browser.close()
    finally:
        server.terminate()
        server.wait()


if __name__ == "__main__":
    main()
