"""Numbers on the page are those of the command, digit by digit, on questions drawn at random."""

import random
from urllib.parse import urlencode

import pytest

from amounts import fast_and_slow
from kaidan.web.asking import answered
from web.test_check import numbers

STAIRS = ("ibc", "ada", "osha-ship", "osha", "din-general", "uk-private")
FEW, MANY = 4, 200


def drawn(dice):
    """Question as the address has it."""
    robot = dice.choice(("absolem", "absolem", "kenaf", "ozbot-atr", "talon"))
    asked = {"robot": robot, "stairs": dice.choice(STAIRS), "tab": "findings"}
    asked["flippers"] = dice.choice(("flat", "stowed"))
    asked["direction"] = dice.choice(("up", "down"))
    if dice.random() < 0.6:
        low = dice.uniform(0.3, 1.5)
        asked |= {"surface": "own", "mu_low": low, "mu_high": low * dice.choice((1.0, 1.3))}
    else:
        asked["surface"] = dice.choice(("concrete-dry", ""))
    for name, low, high in (("speed", 0.05, 0.5), ("yaw", 0.01, 0.1), ("risk", 0.001, 0.1)):
        if dice.random() < 0.3:
            asked[name] = dice.uniform(low, high)
    if dice.random() < 0.5:
        asked["s.rise"] = dice.uniform(0.12, 0.22)
    if dice.random() < 0.4:
        asked |= {"u.com_height": dice.uniform(0.002, 0.02), "u.angle": 0.01}
    return asked


@pytest.mark.parametrize("count", fast_and_slow(FEW, MANY))
def test_numbers_of_random_questions(desk, count):
    dice = random.Random(12)
    desk.goto("./")
    desk.wait_for_selector("nav a")
    seen = 0
    for _ in range(count):
        with desk.expect_response("**/api/assess", timeout=60_000) as came:
            address = f"#/check?{urlencode(drawn(dice))}"
            desk.evaluate("address => { location.hash = address; }", address)
        found = came.value
        if found.status != 200:
            assert desk.wait_for_selector('.light[data-verdict="failed"]')
            continue
        answer = answered("assess", found.request.post_data_json).to_dict()
        desk.wait_for_selector(f'.light[data-verdict="{answer["verdict"]}"]')
        desk.wait_for_selector("#tab-findings table", state="attached")
        desk.wait_for_function(
            "length => document.querySelectorAll('#tab-findings tbody tr').length === length",
            arg=len(answer["findings"]),
        )
        for name, value in numbers(desk).items():
            held = answer
            for part in name.split("."):
                held = held[part]
            assert value == held, (name, found.request.post_data)
            seen += 1
    assert seen > 5 * count
