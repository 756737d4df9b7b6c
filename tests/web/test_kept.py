"""A preference keeps what was judged, chosen and loaded; no verdict stands while one is asked."""

import re
from contextlib import contextmanager

import pytest

QUESTION = "robot=absolem&stairs=ibc&surface=concrete-dry&flippers=flat"
VERDICTS = ("go", "rough", "unsure", "no-go", "outside-model")
UNSURE = '.light[data-verdict="unsure"]'


@contextmanager
def held(page, path):
    """Answers of an address are held back meanwhile."""
    waiting = []
    page.route(re.compile(path), lambda route: waiting.append(route))
    try:
        yield waiting
    finally:
        for each in waiting:
            each.continue_()
        page.unroute(re.compile(path))


@contextmanager
def unasked(page):
    """Nothing is asked of the server meanwhile that it judges."""
    asked = []
    page.on("request", lambda sent: asked.append(sent.url) if sent.method == "POST" else None)
    yield
    assert asked == []


def prefer(page, label, value):
    """Choose a preference."""
    if page.locator(".settings").get_attribute("open") is None:
        page.locator(".settings summary").click()
    page.locator(f"#setting-{label}").select_option(value)


def stands(page):
    """Whether a verdict, or what belongs to one, is to be seen."""
    word = page.get_attribute(".light", "data-verdict")
    seen = [
        each
        for each in (".said .reason", ".said .numbers", "#tab-findings table")
        if page.locator(each).is_visible()
    ]
    return word in VERDICTS or bool(seen)


def test_a_preference_keeps_the_verdict_and_the_place_in_it(page):
    page.goto(f"#/check?{QUESTION}")
    page.wait_for_selector("#tab-side svg.traverse .force")
    where = page.get_by_label("Position along the traverse")
    where.focus()
    where.press("Home")
    page.locator(".notes summary").click()
    page.get_by_text("Its figures").first.click()
    with unasked(page):
        prefer(page, "theme", "dark")
        prefer(page, "lengths", "in")
        prefer(page, "language", "ja")
        page.wait_for_selector(UNSURE)
        assert page.inner_text(".light .word") == "UNSURE 判定保留"
        assert page.locator(".notes li").first.is_visible()
        assert page.locator(".figures").first.is_visible()
        assert page.locator('.answer data[data-of="nosing_spacing_m"]').inner_text() == "13.03 in"
        page.wait_for_selector("#tab-side svg.traverse .force", state="attached")
        assert page.locator(".player input[type=range]").input_value() == "0"
        page.wait_for_timeout(500)  # what a slider that rests would still ask


def test_a_preference_keeps_what_was_typed_and_counts_it_in_its_unit(desk):
    desk.goto(f"#/check?{QUESTION}")
    desk.wait_for_selector(UNSURE)
    stairs = desk.get_by_role("region", name="Stairs", exact=True)
    stairs.get_by_text("How to measure").click()
    stairs.get_by_label("Floor to floor").fill("1778")
    prefer(desk, "lengths", "in")
    assert stairs.get_by_label("Floor to floor").input_value() == "70"  # 70 x 25.4 mm
    prefer(desk, "lengths", "mm")
    assert stairs.get_by_label("Floor to floor").input_value() == "1778"


@pytest.mark.slow
def test_a_preference_keeps_a_building_and_its_file(desk, tmp_path):
    pytest.importorskip("ifcopenshell", reason="skipped: ifcopenshell not installed")
    from ifc_cases import half_turn_house

    path = tmp_path / "house.ifc"
    half_turn_house().write(path)
    desk.goto("#/building")
    desk.get_by_label("Building model").set_input_files(path)
    desk.get_by_label("Absolem (NIFTi/TRADR, BlueBotics)", exact=True).check()
    desk.get_by_role("button", name="Judge the building").click()
    desk.wait_for_selector(".building table")
    tags = desk.locator(".building .tag b")
    words = tags.all_inner_texts()
    with unasked(desk):
        prefer(desk, "language", "ja")
        assert desk.locator(".building table").first.is_visible()
        assert [each.split()[0] for each in tags.all_inner_texts()] == words
        assert desk.locator("#model").evaluate("input => input.files[0].name") == "house.ifc"
        assert desk.locator("input[value=absolem]").first.is_checked()
    desk.locator(".building button.main").first.click()
    desk.wait_for_selector(".building table")
    desk.locator("#model").set_input_files([])  # another file, or none: another building
    assert desk.locator(".building table").count() == 0


def test_a_file_takes_back_the_verdict_of_the_stairs_before(page, tmp_path):
    file = tmp_path / "stairs.toml"
    file.write_text("this is no sheet")
    page.goto(f"#/check?{QUESTION}&tab=findings")
    page.wait_for_selector("#tab-findings table")
    assert stands(page)
    with held(page, "api/sheets"):
        page.locator("[aria-label=Stairs] input[type=file]").set_input_files(file)
        page.get_by_text("The file is read.").wait_for()
        assert not stands(page)
        prefer(page, "language", "ja")
    page.locator("[aria-label=階段] [role=alert]").wait_for()  # refused, and said in the new page
    assert not stands(page)
    page.go_back()
    page.wait_for_selector(UNSURE)


def test_what_is_chosen_while_a_file_is_read_is_not_replaced_by_it(desk, tmp_path):
    file = tmp_path / "stairs.csv"
    file.write_text("x,z\n0,0\n1,0\n1,0.17\n1.3,0.17\n1.3,0.34\n2,0.34\n")
    desk.goto(f"#/check?{QUESTION}")
    desk.wait_for_selector(UNSURE)
    with held(desk, "api/sheets"):
        desk.locator("[aria-label=Stairs] input[type=file]").set_input_files(file)
        desk.get_by_role("combobox", name="Stairs", exact=True).select_option("ibc")
    desk.wait_for_selector(UNSURE)
    desk.wait_for_timeout(500)
    assert "stairs=ibc" in desk.url


@pytest.mark.parametrize("asked", ["api/catalogue/stairs/osha-ship", "api/assess"])
def test_no_old_verdict_stands_while_anything_is_asked(page, asked):
    page.goto(f"#/check?{QUESTION}&tab=findings")
    page.wait_for_selector("#tab-findings table")
    assert stands(page)
    with held(page, asked) as waiting:
        page.get_by_role("combobox", name="Stairs", exact=True).select_option("osha-ship")
        for _ in range(100):
            if waiting:
                break
            page.wait_for_timeout(100)
        assert waiting
        assert not stands(page)
    page.wait_for_selector('.light[data-verdict="no-go"]')
    page.wait_for_selector("#tab-findings table")
    assert stands(page)


@pytest.mark.slow
def test_what_one_job_came_to_does_not_stand_while_another_is_asked_for(desk):
    desk.goto(f"#/work?{QUESTION}")
    for kind in ("compare", "sweep"):
        desk.get_by_label("What to do").select_option(kind)
        if kind == "sweep":
            desk.get_by_label("How many values").last.fill("2")
            desk.keyboard.press("Tab")
        desk.get_by_role("button", name="Begin").click()
    desk.locator("[data-state=done]").nth(1).wait_for(timeout=180_000)
    desk.get_by_role("button", name="Show").last.click()
    desk.wait_for_selector(".work table .tag")
    with held(desk, "api/jobs/.*/text"):
        desk.get_by_role("button", name="Show").first.click()
        desk.get_by_text("The result is fetched.").wait_for()
        assert desk.locator(".work table .tag").count() == 0
    desk.locator(".work pre").wait_for()
    prefer(desk, "language", "ja")
    assert desk.locator(".work pre").is_visible()
    for _ in range(2):
        desk.locator("[data-job] button").last.click()
        desk.wait_for_timeout(500)
