"""Authored buildings, random in twelve traits, against what was drawn: no flight lost, no wrong GO.

The other judge is `kaidan.assess` of the same flight entered by hand, from the figures that it was
drawn with. A few in every run, 60 by name (``-m slow``).
"""

import numpy as np
import pytest

pytest.importorskip("ifcopenshell", reason="skipped: ifcopenshell not installed")

import kaidan
from authored_buildings import TRAITS, authored
from ifc_cases import parsed_here
from kaidan import Stairs
from kaidan.verbs.building import building

NEAR = 1e-4
"""What the reader promises of a drawn step [m]."""
RAIL = 0.14
"""Width that two handrails of 50 mm take, 20 mm inside the edges [m]."""


@pytest.fixture(autouse=True)
def parser(monkeypatch):
    parsed_here(monkeypatch)


def by_hand(known, width):
    """Verdict on a flight as it was drawn."""
    sheet = Stairs(
        rise=known.middle, going=known.going, steps=len(known.rises), first_rise=known.rises[0],
        last_rise=known.rises[-1], width=width, lower_landing=known.lower,
        upper_landing=known.upper,
    )  # fmt: skip
    return kaidan.assess("absolem", sheet, friction=1.0).verdict


def faults(drawn, path):
    """What is lost, judged wrongly or without a reason, in words."""
    found = building(drawn.house.write(path), ["absolem"], friction=1.0)
    yield from lost(drawn, found)
    cells = {each.flight: each for each in found.cells}
    for known in drawn.flights:
        flights = [each for each in found.flights if each.elements[0] == known.element]
        if len(flights) != 1:
            yield f"{len(flights)} flights of {known}"
            continue
        (flight,) = flights
        yield from misread(known, flight)
        verdict = cells[flight.identity].verdict
        if verdict == "go" and (known.gap or known.doubted or by_hand(known, known.width) != "go"):
            yield f"wrong GO: {known}"
        if verdict == "no-go" and not known.gap:
            kindest = by_hand(known, known.width - RAIL * known.rails)
            if kindest != "no-go":
                yield f"wrong NO-GO, {cells[flight.identity].governs}: {known}"


def lost(drawn, found):
    """Elements that are not there, or became something else, or have no reason."""
    became = {each.identity: each.outcome for each in found.elements}
    if became != drawn.elements:
        yield f"elements {became}, drawn {drawn.elements}"
    parts = {each for flight in found.flights for each in flight.elements}
    for each in found.elements:
        if each.outcome not in ("judged", "judged in part") and each.identity in parts:
            yield f"{each.identity} is {each.outcome} and judged"
        if each.outcome == "refused" and not each.reasons and each.category != "IfcRamp":
            yield f"{each.identity} has no reason"
    text, table = str(found), found.columns()
    for each in found.elements:
        if each.reasons and each.identity not in text:
            yield f"{each.identity} is not in the text"
        if each.identity not in " ".join(filter(None, table["elements"])):
            yield f"{each.identity} is not in the table"


def misread(known, flight):
    rises = (flight.first_rise_m, flight.rise_m, flight.last_rise_m)
    drawn = (known.rises[0], known.middle, known.rises[-1])
    off = [abs(one - other) for one, other in zip(rises, drawn, strict=True)]
    off.append(abs(flight.going_m - known.going))
    if flight.steps != len(known.rises) or max(off) > NEAR:
        yield f"read as {flight.steps} risers of {rises}, drawn as {known}"
    gaps = [each.length for each in flight.sheet.gaps]
    drawn_gaps = [known.gap] if known.gap else []
    if len(gaps) != len(drawn_gaps) or not np.allclose(gaps, drawn_gaps, atol=NEAR):
        yield f"gaps {gaps} of {known}"


@pytest.mark.parametrize("trait", TRAITS)
def test_each_trait_alone(trait, tmp_path):
    drawn = authored(TRAITS.index(trait), {trait})
    assert list(faults(drawn, tmp_path / "house.ifc")) == []


def test_finish_and_properties_are_held_against_each_other(tmp_path):
    drawn = authored(5, {"finish", "properties"})
    assert all(known.doubted for known in drawn.flights)
    assert list(faults(drawn, tmp_path / "house.ifc")) == []


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(60))
def test_sixty_buildings(seed, tmp_path):
    drawn = authored(1000 + seed)
    assert list(faults(drawn, tmp_path / "house.ifc")) == []
