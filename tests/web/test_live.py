"""The live page: the alarm of a replayed climb is seen and heard, and a lost server is noticed."""

import base64
import json

import httpx
import pytest

from climbs import SLOPE, climb, csv_of
from web.conftest import pictures

BODY = {"robot": "kenaf", "stairs": {"angle": SLOPE, "nosing_spacing": 0.150}}
ROWS = [{**row._asdict(), "acceleration": 0.0} for row in climb()]


def fed(server, name, rows, **more):
    said = httpx.post(f"{server.address}api/live/{name}", json={"samples": rows, **more})
    assert said.status_code == 200
    return said.json()


@pytest.fixture
def climbing(server):
    return httpx.post(f"{server.address}api/live", json=BODY).json()["id"]


NOTED = """() => {
  const at = (id) => document.getElementById(id);
  window.seen = [];
  new MutationObserver(() => window.seen.push([
    at("alarm").className, ...["said", "why", "margin", "phase"].map((id) => at(id).innerText),
  ])).observe(at("alarm"), { attributes: true });
}"""


def wait_for(page, *moods):
    """What the page said in the last of these moods, one right after the other.

    A mood may be over before a test looks: without a sample a second is enough.
    """
    found = page.wait_for_function(
        """moods => {
          const seen = window.seen.map(each => each[0]);
          const at = seen.findIndex((_, k) => moods.every((mood, n) => seen[k + n] === mood));
          return at >= 0 && window.seen[at + moods.length - 1].slice(1);
        }""",
        arg=moods,
    )
    return found.json_value()


def ready(page, name=""):
    page.goto(f"live.html{'#' + name if name else ''}")
    page.wait_for_selector("body[data-ready]")
    page.evaluate(NOTED)


def test_an_alarm_from_a_replay_is_seen_and_heard(page, tmp_path):
    steep = csv_of(climb())  # steeper than the flight of the catalogue: it tips
    (tmp_path / "climb.csv").write_text(steep)
    ready(page)
    page.locator("#robot").select_option("absolem")
    page.locator("#stairs").select_option("ibc")
    page.get_by_role("textbox", name="Flippers").fill("flat")
    page.get_by_label("Speed of the replay").select_option("5")
    page.get_by_label("Recorded climb (CSV, bag, MCAP)").set_input_files(tmp_path / "climb.csv")
    page.get_by_role("button", name="Replay").click()
    wait_for(page, "calm")
    assert "ALARM" in wait_for(page, "tip_over")[0]
    assert page.get_by_role("alert").first.get_attribute("id") == "alarm"
    page.wait_for_selector("body[data-beeps]")
    shot(page, "tip_over")
    page.get_by_text("The climb is over.").wait_for()
    assert page.inner_text("#margin") != "–"


def test_a_sensor_that_falls_silent_is_noticed(desk, server, climbing):
    ready(desk, climbing)
    fed(server, climbing, ROWS[:40])
    said, why, margin, _ = wait_for(desk, "calm", "silent")
    assert (said, why) == ("SENSOR SILENT", "No sample comes in time: stop.")
    assert margin == "–"  # what it was is no longer so
    fed(server, climbing, ROWS[40:60], recorded=True)
    wait_for(desk, "calm", "silent", "calm")


def test_a_server_that_is_gone_is_a_silent_sensor_too(desk, server, climbing):
    ready(desk, climbing)
    fed(server, climbing, ROWS[:40], recorded=True)
    wait_for(desk, "calm")
    server.stop()
    try:
        wait_for(desk, "calm", "silent")
    finally:
        server.start()


def alive(count, begin=0.0, tilt=0.7):
    """Samples of a sensor of 100 Hz that is alive."""
    return [
        {"t": begin + 0.01 * k, "inclination": tilt, "inclination_rate": 1e-3 * (k % 3),
         "acceleration": 0.0}
        for k in range(count)
    ]  # fmt: skip


BLIND = {
    "no_data": ("NO DATA", lambda k, row: row | {"inclination": None}),
    "half_blind": ("HALF BLIND", lambda k, row: row | ({"inclination": None} if k % 2 else {})),
    "frozen": ("SENSOR FROZEN", lambda k, row: row | {"inclination_rate": 0.0}),
    "clock": ("CLOCK FAULT", lambda k, row: row | {"t": 0.5}),
}


@pytest.mark.parametrize("mood", BLIND)
def test_what_blinds_the_monitor_is_named(page, server, climbing, mood):
    word, change = BLIND[mood]
    ready(page, climbing)
    good = alive(50)
    bad = [change(k, row) for k, row in enumerate(alive(80, begin=0.5))]
    fed(server, climbing, good + bad, recorded=True)
    found = page.wait_for_function(
        "word => document.getElementById('alarm').innerText.includes(word)", arg=word
    )
    assert found
    if mood == "frozen":
        assert page.inner_text("#margin") == page.inner_text("#time") == "–"
    shot(page, mood)


def test_past_zero_it_says_that_the_robot_has_tipped_over_and_nothing_says_otherwise(
    page, server, climbing
):
    ready(page, climbing)
    fed(server, climbing, alive(50), recorded=True)
    page.get_by_text("Margin 20.1 degrees, on the flight.").wait_for()
    fed(server, climbing, alive(50, begin=0.5, tilt=1.4), recorded=True)
    said, why, margin, phase = wait_for(page, "tipped_over")
    assert said == "TIPPED OVER"
    assert why.startswith("The robot has tipped over.")
    assert margin.startswith("−")
    assert phase == page.inner_text("#time") == "–"
    assert page.inner_text("#status") == ""
    page.wait_for_timeout(5500)  # a sentence for a screen reader comes every 5 s
    assert page.inner_text("#status") == ""
    assert "NO ALARM" not in page.inner_text("main")
    shot(page, "tipped_over")
    fed(server, climbing, alive(1, begin=1.0, tilt=1.4))  # live, and then silent
    page.get_by_text("Also: SENSOR SILENT.").wait_for()
    assert page.inner_text("#said") == "TIPPED OVER"


def shot(page, name):
    if pictures():
        page.screenshot(path=pictures() / f"live-{name}-{page.viewport_size['width']}.png")


def test_a_posture_of_which_nothing_can_be_foreseen_is_not_called_free_of_alarm(desk, server):
    body = {
        "robot": "absolem",
        "stairs": "ibc",
        "flippers": "stowed",
    }  # 0.50 m on a spacing of 0.33
    name = httpx.post(f"{server.address}api/live", json=body).json()["id"]
    ready(desk, name)
    fed(server, name, ROWS[:3])
    said, why, margin, phase = wait_for(desk, "unknown")
    assert said == "NO PREDICTION"
    assert "p = 0.3309 m is more than L / 2 = 0.25 m" in why
    assert margin == phase == "–"


def test_it_speaks_the_language_of_the_page_and_lists_no_robot_that_nobody_weighed(desk):
    desk.add_init_script("localStorage.setItem('kaidan.language', 'ja')")
    ready(desk)
    assert desk.inner_text("#said") == "未開始"
    names = desk.locator("#robot option").evaluate_all("all => all.map((each) => each.value)")
    assert "absolem" in names
    assert "talon" not in names


def test_it_begins_with_the_question_of_the_page(desk):
    desk.goto("#/check?robot=absolem&stairs=ada&direction=down&flippers=angles&front=0.2")
    desk.get_by_role("link", name="Live").click()
    desk.wait_for_selector("body[data-ready]")
    fields = ("robot", "stairs", "direction", "facing", "flippers")
    shown = [desk.locator(f"#{each}").input_value() for each in fields]
    assert shown == ["absolem", "ada", "down", "nose-first", "11.459deg,0.000deg"]
    desk.get_by_role("link", name="Back to the question").click()
    desk.wait_for_selector(".light[data-verdict]:not([data-verdict=working])")
    assert desk.get_by_role("combobox", name="Stairs", exact=True).input_value() == "ada"


def test_it_watches_own_stairs_a_load_and_changed_figures(desk):
    stairs = {"name": "measured", "rise": 0.17, "going": 0.29, "steps": 9}
    packed = base64.urlsafe_b64encode(json.dumps(stairs).encode()).decode().rstrip("=")
    question = f"robot=absolem&stairs=~{packed}&flippers=flat&r.com_height=0.3&payload_mass=20"
    desk.goto(f"#/check?{question}&payload_height=0.5&payload_behind=0.2")
    desk.wait_for_selector(".light[data-verdict]:not([data-verdict=working])")
    desk.get_by_role("link", name="Live").click()
    desk.wait_for_selector("body[data-ready]")
    assert desk.locator("#stairs option:checked").inner_text() == "measured"
    assert "load of the question: 20.0 kg" in desk.inner_text("#given")
    with desk.expect_response("**/api/live") as begun:
        desk.get_by_role("button", name="Watch a sensor").click()
    sent = begun.value.request.post_data_json
    assert sent["stairs"] == stairs
    assert sent["override"] == {"com_height": 0.3}
    assert sent["payload"] == [{"mass": 20, "from_front": 0.2, "height": 0.5}]
    assert begun.value.json()["stairs"] == "measured"
    assert sent["limits"] == {}
    desk.get_by_label("Resolution of the sensor").fill("0.1deg")
    desk.get_by_label("Alarm without data after").fill("1s")
    with desk.expect_response("**/api/live") as begun:
        desk.get_by_role("button", name="Watch a sensor").click()
    assert begun.value.request.post_data_json["limits"] == {
        "resolution": "0.1deg", "no_data_on": "1s",
    }  # fmt: skip
    desk.locator("#robot").select_option("kenaf")
    assert desk.inner_text("#given") == ""


def test_a_robot_that_cannot_be_watched_is_not_taken_for_another(desk):
    desk.goto("#/check?robot=talon&stairs=ibc")
    desk.wait_for_selector(".light[data-verdict]:not([data-verdict=working])")
    desk.get_by_role("link", name="Live").click()
    desk.wait_for_selector("body[data-ready]")
    assert desk.locator("#robot").input_value() == ""
    desk.get_by_role("button", name="Watch a sensor").click()
    desk.locator("#error:not(:empty)").wait_for()


def test_the_numbers_are_those_of_the_server_also_for_who_comes_later(desk, server, climbing):
    last = fed(server, climbing, ROWS[:100], recorded=True)["states"][-1]
    ready(desk, climbing)
    margin = f"{last['margin_deg']:.1f}"  # the states come one by one
    desk.locator("#margin").get_by_text(margin, exact=True).wait_for()
    shown = [desk.inner_text(f"#{name}").replace("−", "-") for name in ("margin", "tilt", "phase")]
    assert shown == [margin, f"{last['tilt_deg']:.1f}", "on the flight"]


def test_a_climb_of_a_server_that_began_anew_is_over_and_says_so(desk, server, climbing):
    ready(desk, climbing)
    desk.get_by_text("Connected").wait_for()
    server.stop()
    desk.get_by_text("Not connected. Trying again.").wait_for()
    server.start()
    desk.get_by_text("This climb is not watched any more. Begin again.").wait_for()


def test_it_works_from_the_keyboard_in_japanese_and_for_assistive_technology(desk, tmp_path):
    axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="skipped: no axe")
    ready(desk)
    order = []
    for _ in range(15):
        desk.keyboard.press("Tab")
        order.append(desk.evaluate("document.activeElement.id || document.activeElement.tagName"))
    assert order == [
        "back", "language", "sound", "try", "robot", "stairs", "direction", "facing", "flippers",
        "resolution", "silence", "file", "speed", "replay", "watch",
    ]  # fmt: skip
    desk.get_by_label("Language").select_option("ja")
    assert desk.inner_text("#said") == "未開始"
    found = axe.Axe().run(desk).response["violations"]
    assert [
        (each["id"], each["impact"]) for each in found if each["impact"] in ("serious", "critical")
    ] == []


def test_what_the_server_refuses_is_said(desk):
    ready(desk)
    desk.get_by_role("textbox", name="Flippers").fill("nonsense")
    desk.get_by_role("button", name="Watch a sensor").click()
    desk.locator("#error", has_text="nonsense").wait_for()
    desk.get_by_role("button", name="Replay").click()
    desk.get_by_text("Choose a recorded climb first.").wait_for()
