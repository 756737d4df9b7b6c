"""Access: axe has no serious finding, the keyboard reaches everything, targets are large enough."""

import pytest

QUESTION = "#/check?robot=absolem&stairs=ibc&surface=concrete-dry&flippers=flat"
axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="skipped: no axe")
THEMES = ("light", "dark", "contrast")
SMALLEST = 44
"""Of a target, in CSS pixels."""


def serious(page):
    """Findings of axe that are serious or critical, each with the elements."""
    found = axe.Axe().run(page).response
    return [
        f"{each['id']}: {[node['html'][:120] for node in each['nodes'][:3]]}"
        for each in found["violations"]
        if each["impact"] in ("serious", "critical")
    ]


def opened(page, address=QUESTION, theme="light"):
    page.add_init_script(f"localStorage.setItem('kaidan.theme', '{theme}')")
    page.goto(address)
    page.wait_for_selector(".light[data-verdict=unsure]")


@pytest.mark.slow
@pytest.mark.parametrize("theme", THEMES)
def test_the_answer_has_no_serious_finding(page, theme):
    opened(page, theme=theme)
    for summary in page.locator(".inputs details > summary").all():
        summary.click()
    for tab in page.get_by_role("tab").all():
        tab.click()
        page.wait_for_timeout(400)
        assert serious(page) == []


def test_the_empty_page_building_and_saved_have_no_serious_finding(desk):
    for view in ("check", "building", "saved"):
        desk.goto(f"#/{view}")
        desk.wait_for_selector("main")
        assert serious(desk) == []


@pytest.mark.slow
def test_the_keyboard_alone_gets_from_nothing_to_an_answer(desk):
    desk.goto("./")
    desk.wait_for_selector("nav a")

    def to(label):
        """Press Tab until something of this name has the focus."""
        for _ in range(60):
            desk.keyboard.press("Tab")
            name = desk.evaluate(
                "(at => at.labels?.[0]?.innerText || at.innerText || '')(document.activeElement)"
            ).strip()
            if name.startswith(label):
                return
        raise AssertionError(f"the keyboard does not reach {label}")

    to("Skip to the answer")
    to("Robot")
    desk.keyboard.type("Absolem (")
    to("Stairs")
    desk.keyboard.type("IBC 1011.5.2, s")
    to("Surface")
    desk.keyboard.type("Rubber tracks on dry")
    to("Best found")
    desk.keyboard.press("ArrowRight")
    desk.wait_for_selector(".light[data-verdict=unsure]")
    desk.wait_for_selector("#tab-side svg.traverse .contact")
    to("Traverse")
    desk.keyboard.press("ArrowRight")
    desk.wait_for_selector("#tab-margin svg.chart")
    assert desk.evaluate("getComputedStyle(document.activeElement).outlineStyle") == "solid"


@pytest.mark.slow
def test_targets_are_large_enough_for_gloves(page):
    opened(page)
    small = page.evaluate(
        """least => [...document.querySelectorAll('button, select, summary, nav a, .segment, '
            + 'label.check, input[type=range], .file')]
        .filter(each => each.offsetParent && !each.matches('.link'))
        .filter(each => each.getBoundingClientRect().height < least - 0.5)
        .map(each => each.outerHTML.slice(0, 80))""",
        SMALLEST,
    )
    assert small == []


def test_the_page_does_not_scroll_sideways(page):
    opened(page)
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


@pytest.mark.parametrize("wide", [640, 820])
def test_a_tablet_held_upright_has_the_verdict_in_sight_and_room_for_sliders(desk, wide):
    desk.set_viewport_size({"width": wide, "height": 1180})
    opened(desk)
    assert desk.locator(".light").bounding_box()["y"] < 1180 - 200
    desk.evaluate(
        "for (const each of document.querySelectorAll('.inputs details')) each.open = true"
    )
    assert desk.evaluate("document.documentElement.scrollWidth <= innerWidth")
    panels = desk.locator(".inputs > *")
    for each in panels.all():
        assert each.evaluate("panel => panel.scrollWidth <= panel.clientWidth")
