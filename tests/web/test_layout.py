"""What fits on a screen, what an address keeps, and where the keyboard stays."""

import base64
import json

import pytest

from web.conftest import VIEWPORTS

QUESTION = "robot=absolem&stairs=ibc&surface=concrete-dry&flippers=flat"
ANSWERED = ".light[data-verdict]:not([data-verdict=working])"
UNEVEN = {
    "name": "a_name_without_any_space_that_no_line_of_a_phone_can_hold_at_once", "steps": 3,
    "rises": [0.15, 0.17, 0.16], "goings": [0.28, 0.30],
}  # fmt: skip


def packed(sheet):
    """Sheet as an address has it."""
    return "~" + base64.urlsafe_b64encode(json.dumps(sheet).encode()).decode().rstrip("=")


@pytest.fixture
def phone(desk):
    desk.set_viewport_size(VIEWPORTS["phone"])
    return desk


def test_uneven_stairs_with_a_long_name_fit_a_phone_and_show_each_step(phone):
    phone.goto(f"#/check?robot=kenaf&stairs={packed(UNEVEN)}&surface=concrete-dry")
    phone.wait_for_selector(ANSWERED)
    wide = phone.evaluate("document.documentElement.scrollWidth")
    assert wide == VIEWPORTS["phone"]["width"]
    panel = phone.get_by_role("region", name="Stairs", exact=True)
    panel.get_by_text("Its figures").click()
    said = "3 risers that differ: 150 mm – 170 mm, goings 280 mm – 300 mm, slope 29.6°"
    assert panel.get_by_role("img", name=said).is_visible()  # atan(0.33 / 0.58)
    panel.get_by_text("Each step").click()
    rows = panel.locator("tbody tr").all_inner_texts()
    assert [row.split() for row in rows] == [
        ["1", "150", "mm", "280", "mm"], ["2", "170", "mm", "300", "mm"], ["3", "160", "mm", "–"],
    ]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("tab", ["margin", "plane", "map"])
def test_letters_of_charts_can_be_read_on_a_phone(phone, tab):
    phone.goto(f"#/check?{QUESTION}&tab={tab}")
    chart = phone.locator(f"#tab-{tab} svg.chart")
    chart.wait_for()
    drawn = chart.bounding_box()
    for text in chart.locator("text").all():
        box = text.bounding_box()
        assert max(box["width"], box["height"]) > 12  # also of a single digit of an axis
        assert drawn["x"] - 1 <= box["x"]
        assert box["x"] + box["width"] <= drawn["x"] + drawn["width"] + 1


def test_an_address_keeps_a_turn_that_nobody_saw(desk):
    desk.goto(f"#/check?{QUESTION}&s.upper_turn=unknown")
    desk.wait_for_selector(ANSWERED)
    assert "s.upper_turn=unknown" in desk.evaluate("location.hash")
    with desk.expect_response("**/api/assess") as came:
        desk.reload()
    assert came.value.request.post_data_json["stairs"]["upper_turn"] == "unknown"


def test_an_address_with_a_tab_that_is_none_shows_the_traverse(desk):
    desk.goto(f"#/check?{QUESTION}&tab=nonsense")
    desk.wait_for_selector("#tab-side svg.traverse")


def test_an_address_changes_no_object_but_the_sheet(desk):
    desk.goto(f"#/check?{QUESTION}&r.__proto__.width=5&s.constructor=3")
    desk.wait_for_selector(ANSWERED)
    assert desk.evaluate("({}).width") is None


@pytest.mark.slow
def test_the_keyboard_stays_at_a_job_and_at_a_setting(desk):
    desk.goto(f"#/work?{QUESTION}")
    for _ in range(2):
        desk.get_by_role("button", name="Begin").click()
        desk.wait_for_selector("[data-job]")
    desk.locator("[data-job]").nth(1).wait_for()
    first = desk.locator("[data-job]").last  # the older one ends first
    name = first.get_attribute("data-job")
    first.locator("button").last.focus()
    first.locator("button", has_text="Show").wait_for()
    desk.wait_for_timeout(1500)  # two looks at the list
    assert desk.evaluate("document.activeElement.closest('[data-job]').dataset.job") == name
    desk.get_by_text("Settings").click()
    desk.get_by_label("Language").select_option("ja")
    assert desk.evaluate("document.activeElement.id") == "setting-language"
    desk.keyboard.press("Escape")
    assert not desk.locator("#setting-language").is_visible()
