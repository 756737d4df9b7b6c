"""Landings on the page: a turn is entered at the foot of the stairs, judged, shared and refused."""

import re

import pytest

QUESTION = "#/check?robot=absolem&stairs=ibc&surface=concrete-dry&flippers=flat"
TURN = "&s.width=1&s.upper_turn=half&s.upper_landing=1.2&s.upper_landing_width=2.2"


def opened(page, address=QUESTION):
    page.goto(address)
    page.wait_for_selector(".light[data-verdict=unsure], .light[data-verdict=no-go]")
    stairs = page.get_by_role("region", name="Stairs")
    stairs.get_by_text("Its figures").click()
    stairs.get_by_text("Landings", exact=True).click()
    return stairs


def entered(stairs, end, label, value):
    number = stairs.get_by_role("group", name=end).get_by_role("spinbutton", name=label)
    number.fill(value)
    number.press("Enter")


def test_an_operator_enters_a_landing_with_a_half_turn(page):
    stairs = opened(page)
    upper = stairs.get_by_role("group", name="Upper landing")
    assert upper.get_by_label("Width across the flight").first.is_hidden()
    upper.get_by_role("radio", name="180°").focus()
    page.keyboard.press("Space")
    page.wait_for_selector('.light[data-verdict="failed"]')
    refused = "upper_turn = half needs width and upper_landing and upper_landing_width too"
    assert refused in page.inner_text(".light [role=alert]")
    needed = "Clear width; Length along the flight; Width across the flight."
    assert needed in upper.get_by_role("status").inner_text()
    width = stairs.get_by_role("spinbutton", name="Clear width")
    width.fill("1000")
    width.press("Enter")
    entered(stairs, "Upper landing", "Length along the flight", "1200")
    entered(stairs, "Upper landing", "Width across the flight", "2200")
    page.wait_for_selector(".turns li")
    said = "Turn by 180°, upper landing: on the spot, it sweeps 901 mm of 1200 mm"
    assert said in page.inner_text(".turns")
    assert "flippers stowed for it" in page.inner_text(".turns")
    assert upper.get_by_role("status").inner_text() == ""
    assert "s.upper_turn=half" in page.url
    entered(stairs, "Upper landing", "Door opposite", "700")
    page.wait_for_function("() => /no way found/.test(document.querySelector('.turns')?.innerText)")
    assert page.inner_text(".light .word") == "NO-GO"
    assert "It cannot turn by 180 deg on the upper landing" in page.inner_text(".answer")
    entered(stairs, "Upper landing", "Door opposite", "")
    page.wait_for_function("() => /on the spot/.test(document.querySelector('.turns')?.innerText)")
    assert "upper_leaf" not in page.url


@pytest.mark.slow
def test_the_address_has_the_turn_and_a_passage_goes_with_it(desk):
    stairs = opened(desk, QUESTION + TURN + "&s.upper_passage=1.1")
    assert "180°, upper landing" in desk.inner_text(".turns")
    upper = stairs.get_by_role("group", name="Upper landing")
    assert upper.get_by_role("radio", name="180°").is_checked()
    entered(stairs, "Upper landing", "Width of the level passage", "0")
    desk.wait_for_url(re.compile(r"s\.upper_passage=0(&|$)"))
    desk.wait_for_selector(".turns li")
    upper.get_by_text("None", exact=True).click()
    desk.wait_for_function("() => !document.querySelector('.turns')")
    desk.wait_for_selector(".light[data-verdict=unsure]")
    desk.go_back()
    desk.wait_for_selector(".turns li")


@pytest.mark.slow
def test_landings_in_inches_and_japanese(desk):
    opened(desk, QUESTION + TURN)
    desk.get_by_text("Settings").click()
    desk.get_by_label("Lengths").select_option("in")
    desk.wait_for_selector(".turns li")
    assert "it sweeps 35.49 in of 47.24 in" in desk.inner_text(".turns")
    desk.get_by_label("Language").select_option("ja")
    desk.wait_for_selector("html[lang=ja] .turns li")
    assert "上の床、180° 旋回: その場で旋回" in desk.inner_text(".turns")


@pytest.mark.slow
def test_nonsense_is_refused_in_words(desk):
    stairs = opened(desk, QUESTION + TURN)
    for value, said in (("-5", "-0.005 m is not within"), ("9e9", "is not within 0 to 100 m")):
        entered(stairs, "Upper landing", "Width across the flight", value)
        desk.wait_for_selector('.light[data-verdict="failed"]')
        desk.wait_for_function(
            "said => document.querySelector('.light [role=alert]')?.innerText.includes(said)",
            arg=said,
        )
