"""Take the pictures of the page that docs/page.md shows anew, in a Chromium of the system.

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
ANSWERED = ".light[data-verdict=caution]"


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


SCREENS = {
    "page-desk.png": (desk, 1280, 1600, "en", "light"),
    "page-phone.png": (phone, 390, 760, "en", "contrast"),
    "page-phone-ja.png": (phone, 390, 760, "ja", "light"),
    "page-margin.png": (margin, 1024, 760, "en", "dark"),
    "page-building.png": (building, 1280, 1000, "en", "light"),
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
            for name, (show, wide, tall, language, theme) in SCREENS.items():
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
