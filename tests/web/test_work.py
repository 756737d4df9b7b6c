"""Long work on the page: begun, seen, cancelled, and still there after a reload and a new start."""

from web.test_access import serious

QUESTION = "?robot=absolem&stairs=ibc&surface=concrete-dry&flippers=flat"


def begin(page, kind):
    page.goto(f"#/work{QUESTION}")
    page.get_by_label("What to do").select_option(kind)


def state(page, word, timeout=180_000):
    page.wait_for_selector(f'.jobs li[data-state="{word}"]', timeout=timeout)


def test_a_sweep_survives_a_reload_and_a_new_start_and_is_cancelled(page, server):
    begin(page, "sweep")
    page.get_by_label("How many values").last.fill("2000")
    page.keyboard.press("Tab")
    page.get_by_role("button", name="Begin").click()
    state(page, "running")
    page.reload()
    state(page, "running")
    page.wait_for_selector(".jobs progress")
    if page.viewport_size["width"] > 1000:
        server.stop()
        server.start()
        page.reload()
        state(page, "running")
    page.get_by_role("button", name="Cancel").click()
    page.get_by_text("Nothing yet.").wait_for()


def test_robots_are_compared_and_a_pair_is_opened(desk):
    begin(desk, "compare")
    desk.get_by_label("Kenaf", exact=False).first.check()
    desk.get_by_role("button", name="Begin").click()
    state(desk, "done")
    desk.get_by_role("button", name="Show").first.click()
    desk.wait_for_selector(".work table")
    words = desk.locator(".work table .tag b").all_inner_texts()
    assert sorted(words) == ["NO-GO", "UNSURE"]
    desk.get_by_role("button", name="Open this question: kenaf").click()
    desk.wait_for_selector('.light[data-verdict="no-go"]')
    desk.go_back()
    desk.get_by_role("button", name="Delete").click()
    desk.get_by_text("Nothing yet.").wait_for()


def test_a_sweep_says_what_the_command_says(desk):
    begin(desk, "sweep")
    desk.get_by_label("How many values").last.fill("3")
    desk.keyboard.press("Tab")
    desk.get_by_role("button", name="Begin").click()
    state(desk, "done")
    desk.get_by_role("button", name="Show").click()
    desk.get_by_text("com_height").last.wait_for()
    assert serious(desk) == []
    desk.get_by_role("button", name="Delete").click()
