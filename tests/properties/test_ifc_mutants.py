"""Damaged building models: stairs, a refusal or one line, whatever the damage; nothing else.

A few in every run; 2,000 by name (``-m slow``), which takes half an hour: each is a process.
"""

import random
import re

import pytest

pytest.importorskip("ifcopenshell", reason="skipped: ifcopenshell not installed")

from ifc_cases import House, monolith, regular
from kaidan.errors import InputError
from kaidan.readers import found_in

NUMBERS = (b"1E308", b"-1.", b"0.", b"1E-300", b"NAN", b"99999999999999999999")


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    house = House("IFC2X3", "m", storeys=((0.0, "a"), (1.0, "b")))
    flight = house.add("IfcStairFlight", "one", [monolith(house, *regular(5, 0.175, 0.28))])
    house.properties(flight, "Pset_StairFlightCommon", NumberOfRiser=5, RiserHeight=0.175)
    return house.write(tmp_path_factory.mktemp("ifc") / "sound.ifc").read_bytes()


def mutant(sound: bytes, draw: random.Random) -> bytes:
    """The same model with one to twenty faults: bytes, references, numbers, names."""
    damaged = bytearray(sound)
    data = sound.index(b"DATA;")
    for _ in range(draw.choice([1, 1, 2, 5, 20])):
        at = draw.randrange(data if draw.random() < 0.9 else 0, len(damaged) - 40)
        kind = draw.randrange(6)
        if kind == 0:
            damaged[at] = draw.randrange(256)
        elif kind == 1:
            del damaged[at : at + draw.randrange(1, 30)]
        elif kind == 2:
            begin = draw.randrange(len(damaged))
            damaged[at:at] = damaged[begin : begin + draw.randrange(1, 60)]
        else:
            pattern = (rb"#\d+", rb"-?\d+\.\d*(?:E-?\d+)?", rb"=IFC\w+")[kind - 3]
            found = list(re.finditer(pattern, bytes(damaged)))
            if found:
                one = draw.choice(found)
                other = draw.choice(NUMBERS) if kind == 4 else draw.choice(found).group()
                damaged[one.start() : one.end()] = other
    return bytes(damaged)


def ends_well(content: bytes, path) -> None:
    path.write_bytes(content)
    try:
        found = found_in(path)
    except InputError as error:
        said = str(error)
    else:
        said = ""
        assert found.staircases or found.refusals
    assert "\n" not in said


def test_an_identity_that_is_no_text(sound, tmp_path):
    """Nine of 2,000 mutants: a reference or a number where the GlobalId of a storey stands."""
    damaged = re.sub(rb"(=IFCBUILDINGSTOREY\()'[^']*'", rb"\1(1.,2.)", sound)
    assert damaged != sound
    path = tmp_path / "mutant.ifc"
    path.write_bytes(damaged)
    with pytest.raises(InputError, match=r"the GlobalId of #\d+ is no text"):
        found_in(path)


def test_a_few_mutants(sound, tmp_path):
    draw = random.Random(11)
    for _ in range(8):
        ends_well(mutant(sound, draw), tmp_path / "mutant.ifc")


@pytest.mark.slow
def test_two_thousand_mutants(sound, tmp_path):
    draw = random.Random(12)
    for _ in range(2000):
        ends_well(mutant(sound, draw), tmp_path / "mutant.ifc")
