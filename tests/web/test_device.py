"""What the device keeps: the page without its server, saved sheets, files of them."""

import json
import re

import pytest

QUESTION = "#/check?robot=absolem&stairs=ibc&surface=concrete-dry&flippers=flat"


def test_the_service_worker_keeps_every_file_of_the_page(pytestconfig):
    static = pytestconfig.rootpath / "src/kaidan/web/static"
    named = set(re.findall(r'"([\w.-]+)"', (static / "sw.js").read_text()))
    files = {path.stem if path.parent.name == "js" else path.name for path in static.rglob("*.*")}
    assert files - named == {"sw.js", "index.html"}  # itself; and "./", which is the page


def test_nothing_is_inline_and_nothing_from_elsewhere(pytestconfig):
    static = pytestconfig.rootpath / "src/kaidan/web/static"
    page = (static / "index.html").read_text()
    assert not re.search(r"\sstyle=|\son\w+=|<style|<script(?![^>]*src)", page)
    for path in static.rglob("*"):
        if path.suffix in (".js", ".css", ".html", ".webmanifest"):
            found = set(re.findall(r"https?://[\w./]+", path.read_text()))
            assert found <= {"http://www.w3.org/2000/svg"}, path.name


@pytest.mark.slow
def test_without_its_server_the_page_opens_and_says_what_it_cannot_do(desk, server):
    desk.goto("./")
    desk.evaluate("navigator.serviceWorker.ready")
    desk.wait_for_timeout(500)
    server.stop()
    try:
        desk.goto("about:blank")
        desk.goto(QUESTION)
        desk.wait_for_selector('.light[data-verdict="offline"]')
        assert "the server" in desk.inner_text(".light [role=alert]")
        assert desk.get_by_role("combobox", name="Robot", exact=True).input_value() == "absolem"
        desk.get_by_text("Its figures").first.click()
        assert "C_L 279 mm" in desk.locator(".drawing").first.text_content()
    finally:
        server.start()
    desk.get_by_role("button", name="Ask again").click()
    desk.wait_for_selector('.light[data-verdict="unsure"]')
    assert desk.locator(".banner").is_hidden()


@pytest.mark.slow
def test_saved_robots_stay_and_travel_as_a_file(desk, tmp_path):
    desk.goto(QUESTION + "&r.com_height=0.2")
    desk.wait_for_selector(".light[data-verdict=unsure]")
    desk.get_by_text("Its figures").first.click()
    desk.get_by_role("button", name="Save on this device").first.click()
    desk.get_by_role("link", name="Saved").click()
    with desk.expect_download() as sent:
        desk.get_by_role("button", name="Export all to a file").click()
    sent.value.save_as(tmp_path / "sheets.json")
    sheet = json.loads((tmp_path / "sheets.json").read_text())["robots"]["absolem*"]
    assert sheet["com_height"] == 0.2
    desk.get_by_role("button", name="Delete absolem*").click()
    assert "Nothing is saved yet" in desk.inner_text(".saved")
    desk.get_by_label("Import a file").set_input_files(tmp_path / "sheets.json")
    desk.get_by_role("button", name="Use absolem*").click()
    desk.wait_for_selector(".light[data-verdict=unsure]")
    assert "robot=%7E" in desk.url
    assert "C_N 200 mm" in desk.locator(".drawing").first.text_content()


@pytest.mark.slow
def test_a_robot_and_stairs_are_read_from_files(desk, tmp_path):
    import kaidan

    robot, stairs = tmp_path / "mine.toml", tmp_path / "points.csv"
    robot.write_text(kaidan.Robot.named("kenaf").to_toml())
    stairs.write_text("0,0\n1,0\n1,0.15\n1.3,0.15\n1.3,0.3\n3,0.3\n")
    desk.goto("./")
    desk.get_by_label("Read a file: TOML, URDF, SDF, MJCF").set_input_files(robot)
    desk.wait_for_url(re.compile("robot="))
    desk.get_by_label("Read a file: IFC").set_input_files(stairs)
    answers = ", ".join(f"[data-verdict={each}]" for each in ("go", "rough", "unsure", "no-go"))
    desk.wait_for_selector(f".light:is({answers})")
    assert "profile" in desk.inner_text(".light")


@pytest.mark.slow
def test_tape_and_scales_become_figures_with_their_doubt(desk):
    """L 600 mm, 12 and 8 kg: C_L is 240 mm by the lever; 18 risers of 3.15 m: a rise of 175 mm."""
    desk.goto("./")
    desk.get_by_text("How to measure", exact=True).click()
    stated = {
        "Distance of the bars": "600", "Front scale, level": "12", "Rear scale, level": "8",
        "Slope of the flat": "20", "Front scale, on": "10.5", "Rear scale, on": "9.5",
        "Front radius": "90", "Rear radius": "90",
    }  # fmt: skip
    for label, value in stated.items():
        desk.get_by_label(label).fill(value)
    desk.get_by_role("button", name="Work it out").first.click()
    desk.wait_for_url(re.compile("robot="))
    assert "C_L 240 mm" in desk.locator(".drawing").first.text_content()
    desk.get_by_text("How to measure with a tape").click()
    for label, value in {"Risers": "18", "Floor to floor": "3150", "First to last": "4760"}.items():
        desk.get_by_label(label).fill(value)
    desk.get_by_role("button", name="Work it out").last.click()
    desk.wait_for_url(re.compile("stairs="))
    assert "slope 32.0°, 330 mm" in desk.inner_text(".inputs")
    desk.wait_for_selector(".answer data[data-of=failure_probability]")
