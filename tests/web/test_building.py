"""A planner with a building model: verdicts for each flight, and the flight as a question."""

import httpx
import pytest

pytest.importorskip("ifcopenshell", reason="skipped: ifcopenshell not installed")

from ifc_cases import half_turn_house

ROBOTS = ("absolem", "ozbot-atr")


@pytest.fixture(scope="module")
def house(tmp_path_factory):
    path = tmp_path_factory.mktemp("house") / "house.ifc"
    half_turn_house().write(path)
    return path


@pytest.mark.slow
def test_a_planner_gets_from_a_model_to_a_flight(page, server, house):
    page.goto("#/building")
    page.get_by_label("Building model").set_input_files(house)
    for title in ("Absolem (NIFTi/TRADR, BlueBotics)", "OzBot ATR (BIA5/CSIRO)"):
        page.get_by_label(title, exact=True).check()
    page.get_by_role("combobox", name="Surface").last.select_option("concrete-dry")
    page.get_by_role("button", name="Judge the building").click()
    page.wait_for_selector(".building table")
    with house.open("rb") as file:
        answer = httpx.post(
            server.address + "api/building",
            files={"file": file},
            data={"robots": list(ROBOTS), "surface": "concrete-dry"},
            timeout=120,
        ).json()
    words = page.locator(".building table").first.locator(".tag b").all_inner_texts()
    assert words == [cell["verdict"].upper() for cell in answer["cells"]]
    shown = page.locator('.building table:first-of-type [data-of="cell.margin_deg"]')
    margins = [float(each.get_attribute("value")) for each in shown.all()]
    assert margins == [c["margin_deg"] for c in answer["cells"] if c["margin_deg"] is not None]
    assert page.locator(".floor-plan .lane").count() == len(answer["flights"])
    plans = page.locator(".floor-plan")
    assert plans.count() == len({each["storey"] for each in answer["flights"]})
    for plan in plans.all():
        drawn = plan.bounding_box()
        bottom = drawn["y"] + drawn["height"]
        for each in plan.locator(".floor, .lane").all():
            box = each.bounding_box()
            assert drawn["y"] <= box["y"]
            assert box["y"] + box["height"] <= bottom
    named = page.locator(".floor-plan text").evaluate_all(
        "all => all.map(each => each.getBoundingClientRect()).map(({x, y}) => `${x} ${y}`)"
    )
    assert len(set(named)) == len(answer["flights"])  # no name lies over another one
    storeys = [storey["name"] for storey in answer["storeys"]]
    assert all(name in page.inner_text(".storeys") for name in storeys)
    page.get_by_role("button", name="Open this flight").nth(1).click()
    page.wait_for_selector(f'.light[data-verdict="{answer["cells"][1]["verdict"]}"]')
    assert page.inner_text(".reason").strip() == answer["cells"][1]["reason"]
    page.go_back()
    page.wait_for_selector(".building table")
