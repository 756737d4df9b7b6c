"""The view of one robot on one staircase, as an operator and a designer use it."""

import json
import re

import httpx
import pytest

from kaidan.assessment.sentences import advice
from kaidan.modes import Verdict
from kaidan.text.japanese import japanese

QUESTION = "#/check?robot=absolem&stairs=ibc&surface=concrete-dry&flippers=flat"
BODY = {
    "robot": "absolem", "stairs": "ibc", "surface": "concrete-dry", "flippers": "flat",
    "direction": "up",
}  # fmt: skip


def verdict(page, word):
    """Wait for a verdict; its word as the page shows it."""
    page.wait_for_selector(f'.light[data-verdict="{word}"]')
    return page.inner_text(".light .word")


def numbers(page):
    """Figures of the answer on the page by their names in the JSON, as they are held."""
    found = page.eval_on_selector_all(
        ".answer data[data-of], #tab-findings data[data-of]",
        "all => all.map(each => [each.dataset.of, each.value])",
    )
    return {name: float(value) for name, value in found}


def test_an_operator_gets_from_nothing_to_a_printed_sheet(page):
    page.goto("./")
    assert page.inner_text(".light .word") == "NO QUESTION YET"
    page.get_by_role("combobox", name="Robot", exact=True).select_option("absolem")
    page.get_by_role("combobox", name="Stairs", exact=True).select_option("ibc")
    page.get_by_role("combobox", name="Surface", exact=True).select_option("concrete-dry")
    page.get_by_text("Flat", exact=True).click()
    assert verdict(page, "unsure") == "UNSURE"
    assert "Friction decides (enter, step 1)" in page.inner_text(".reason")
    assert "A surface with a friction of 0.92 or more" in page.inner_text(".do")
    page.wait_for_selector("#tab-side svg.traverse .force")
    page.evaluate("window.print = () => { window.printed = true; }")
    page.get_by_role("button", name="Print sheet").click()
    assert page.evaluate("window.printed")
    page.emulate_media(media="print")
    assert "Mission sheet" in page.inner_text("#sheet")
    assert "robot=absolem" in page.inner_text("#sheet")
    assert page.locator(".inputs").is_hidden()
    sheet = page.pdf(prefer_css_page_size=True, print_background=True)
    assert len(re.findall(rb"/Type\s*/Page\b", sheet)) == 1


def test_rough_says_what_to_secure_and_unsure_what_to_measure(desk):
    """Flat, Absolem drops onto the landing at 2.2 m/s; a centroid to 20 mm leaves the rest open."""
    desk.goto(QUESTION.replace("surface=concrete-dry", "surface=own&mu_low=1.2&mu_high=1.2"))
    assert verdict(desk, "rough") == "ROUGH"
    assert "payload, arm and antennas" in desk.inner_text(".secure")
    assert desk.locator(".measure").count() == 0
    desk.goto("about:blank")
    desk.goto(QUESTION + "&u.com_height=0.02")
    assert verdict(desk, "unsure") == "UNSURE"
    assert "%" in desk.inner_text(".measure")
    assert desk.locator(".secure").count() == 0


def test_each_verdict_has_a_shape_of_its_own(desk):
    """Who sees no colour tells them apart."""
    desk.goto("./")
    desk.wait_for_selector("body.ready")
    drawn = desk.evaluate("""async verdicts => {
      const { symbol } = await import("/js/light.js");
      return verdicts.map((each) => symbol(each).innerHTML);
    }""", list(Verdict))  # fmt: skip
    assert len(set(drawn)) == len(Verdict)


@pytest.mark.slow
@pytest.mark.parametrize("language", ["en", "ja"])
def test_a_sheet_with_a_plan_of_flippers_is_one_page(desk, language):
    desk.add_init_script(f"localStorage.setItem('kaidan.language', '{language}')")
    desk.goto(QUESTION.replace("flippers=flat", "flippers=best"))
    desk.wait_for_selector("#tab-side svg.traverse .force", state="attached")
    desk.emulate_media(media="print")
    sheet = desk.pdf(prefer_css_page_size=True, print_background=True)
    assert len(re.findall(rb"/Type\s*/Page\b", sheet)) == 1


def test_numbers_on_the_page_are_those_of_the_api(desk, server):
    desk.goto(QUESTION + "&u.com_height=0.005&tab=findings")
    verdict(desk, "unsure")
    desk.wait_for_selector("#tab-findings table")
    body = BODY | {"uncertainty": {"com_height": 0.005}}
    answer = httpx.post(server.address + "api/assess", json=body, timeout=60).json()
    shown = numbers(desk)
    assert shown["failure_probability"] == answer["failure_probability"]
    for name, value in shown.items():
        found = answer
        for part in name.split("."):
            found = found[part]
        assert value == found, name
    assert {"margin_deg", "margin_best_deg", "required_friction"} <= shown.keys()
    assert len(shown) > 15


@pytest.mark.slow
def test_a_slider_changes_the_question_and_the_address_has_it(desk):
    desk.goto(QUESTION)
    verdict(desk, "unsure")
    before = numbers(desk)["margin_deg"]
    desk.get_by_text("Its figures").first.click()
    slider = desk.get_by_role("slider", name="C_N, centroid above the underside")
    for _ in range(3):
        slider.press("PageUp")
    desk.wait_for_url(re.compile(r"r\.com_height"))
    desk.wait_for_selector(".light[data-verdict]:not([data-verdict=working])")
    after = numbers(desk)["margin_deg"]
    assert after != before
    shared = desk.url
    desk.goto("about:blank")
    desk.goto(shared)
    desk.wait_for_selector(".light[data-verdict=unsure], .light[data-verdict=no-go]")
    assert numbers(desk)["margin_deg"] == after


@pytest.mark.slow
def test_back_and_forward_go_through_the_questions(desk):
    desk.goto(QUESTION)
    verdict(desk, "unsure")
    desk.get_by_role("combobox", name="Stairs", exact=True).select_option("osha-ship")
    verdict(desk, "no-go")
    desk.go_back()
    verdict(desk, "unsure")
    assert desk.get_by_role("combobox", name="Stairs", exact=True).input_value() == "ibc"
    desk.go_forward()
    verdict(desk, "no-go")


@pytest.mark.slow
def test_the_traverse_is_scrubbed_and_played(desk):
    desk.goto(QUESTION)
    desk.wait_for_selector("#tab-side svg.traverse .force")
    where = desk.get_by_label("Position along the traverse")
    where.focus()
    where.press("Home")
    assert re.search(r"enter", desk.inner_text("#tab-side .compact"))
    where.press("End")
    assert re.search(r"land", desk.inner_text("#tab-side .compact"))
    desk.get_by_role("button", name="Pose that decides").click()
    at = int(where.input_value())
    desk.get_by_role("button", name="Play").click()
    desk.get_by_role("button", name="Pause").click()
    assert int(where.input_value()) >= at


@pytest.mark.slow
def test_charts_say_where_one_is(desk):
    desk.goto(QUESTION + "&tab=margin")
    assert "you are here" in desk.text_content("#tab-margin svg.chart .here")
    assert "32.5°" in desk.get_attribute("#tab-margin svg.chart", "aria-label")
    desk.get_by_role("tab", name="Acceleration plane").click()
    assert "you are here" in desk.text_content("#tab-plane svg.chart .here")


@pytest.mark.slow
def test_a_robot_that_nobody_weighed_is_marked_in_every_list(desk):
    desk.goto("#/check?robot=talon&stairs=ibc&surface=concrete-dry")
    group = desk.locator("optgroup", has=desk.locator("option[value=talon]"))
    assert group.get_attribute("label") == "Catalogue, UNSURE until weighed"
    assert verdict(desk, "unsure") == "UNSURE"
    for tab in ("Traverse", "Margin chart", "Acceleration plane", "Map of poses"):
        desk.get_by_role("tab", name=tab).click()
        assert "Weigh it" in desk.inner_text("[role=tabpanel]:visible")
    for view in ("Building", "Jobs"):
        desk.get_by_role("link", name=view).click()
        marked = desk.locator("label.check:visible", has_text="UNSURE until weighed")
        assert marked.count() == 4


@pytest.mark.parametrize("wide", [320, 390])
@pytest.mark.parametrize("language", ["en", "ja"])
def test_the_head_has_two_rows_on_a_phone_whatever_it_says(desk, wide, language):
    desk.set_viewport_size({"width": wide, "height": 700})
    desk.add_init_script(f"localStorage.setItem('kaidan.language', '{language}')")
    desk.goto("./")
    desk.wait_for_selector("body.ready")
    words = desk.evaluate("""async () => {
      const { state, verdict } = await (await fetch("api/texts")).json();
      const all = [...Object.values(verdict), state.empty, state.failed, state.offline_short];
      return all.map((each) => each[document.documentElement.lang]);
    }""")
    for word in words:
        desk.evaluate("word => { document.querySelector('.chip span').textContent = word; }", word)
        # two rows of targets of 44 px, the gap between them and the padding
        assert desk.locator("header").bounding_box()["height"] < 3 * 44, word


def test_what_is_refused_stands_in_the_words_of_the_command(desk):
    desk.goto("#/check?robot=nobody&stairs=ibc")
    desk.wait_for_selector('.light[data-verdict="failed"]')
    desk.goto("about:blank")
    desk.goto("#/check?robot=kenaf&stairs=ibc&surface=own&mu_low=9&mu_high=9")
    desk.wait_for_selector('.light[data-verdict="failed"]')
    assert "friction" in desk.inner_text(".light [role=alert]")


@pytest.mark.slow
def test_no_verdict_stands_while_the_next_is_worked_out(desk):
    """The estimate of the closed form is no verdict: it can say GO where the answer is NO-GO."""
    seen = []
    desk.expose_function("seen", lambda each: seen.append(each))
    desk.goto(QUESTION)
    verdict(desk, "unsure")
    desk.evaluate(
        "new MutationObserver(() => seen(document.querySelector('.light').dataset.verdict))"
        ".observe(document.querySelector('.light'), {attributes: true})"
    )
    desk.get_by_role("combobox", name="Stairs", exact=True).select_option("osha-ship")
    verdict(desk, "no-go")
    assert seen[0] == "working"
    assert set(seen) == {"working", "no-go"}


@pytest.mark.slow
def test_japanese_has_the_verdict_why_where_and_what_to_do(desk, server):
    desk.goto(QUESTION)
    desk.get_by_text("Settings").click()
    desk.get_by_label("Language").select_option("ja")
    assert verdict(desk, "unsure") == "UNSURE 判定保留"
    assert desk.get_attribute("html", "lang") == "ja"
    assert "進入、1 段目" in desk.inner_text(".reason")
    assert "0.91" in desk.inner_text(".reason")
    assert "摩擦係数 0.92 以上" in desk.inner_text(".do")
    desk.locator(".notes summary").click()
    notes = desk.locator(".notes li").all()
    english = [each for each in notes if each.get_attribute("lang") == "en"]
    assert len(notes) > 4
    assert len(english) == 2  # what the sheets of the robot and of the stairs say
    sentences = [advice.FLAT, "It rocks by 1.5 deg until the next contact arrests it.", "It sings."]
    sentences += httpx.post(server.address + "api/assess", json=BODY, timeout=60).json()["notes"]
    said = "async all => { const { japanese } = await import('/js/i18n.js'); "
    said += "return all.map(each => japanese(each)); }"
    assert desk.evaluate(said, sentences) == [japanese(each) for each in sentences]


@pytest.mark.slow
def test_inches(desk):
    desk.goto(QUESTION)
    desk.get_by_text("Settings").click()
    desk.get_by_label("Lengths").select_option("in")
    verdict(desk, "unsure")
    figure = desk.locator('.answer data[data-of="nosing_spacing_m"]')
    assert figure.inner_text() == "13.03 in"
    assert json.loads(figure.get_attribute("value")) == 0.3309456148674582
