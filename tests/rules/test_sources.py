"""Every number of the catalogues says where it came from."""

import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from kaidan import catalog

CATALOG = Path(catalog.__file__).parent
FILES = sorted(
    path
    for kind in ("robots", "unweighed", "stairs", "surfaces")
    for path in (CATALOG / kind).iterdir()
)
STATUS = ("V: ", "C: ", "D: ", "U: ")


def numbers(table: dict[str, Any], path: str = "") -> Iterator[str]:
    """Dotted names of everything in a file that is a number, a list, a truth value or a belt.

    A truth value is a fact too, but one the code or drawing shows at a glance: it needs none.
    """
    for key, value in table.items():
        if key == "sources":
            continue
        if isinstance(value, dict):
            yield from numbers(value, f"{path}{key}.")
        elif key == "belt" or (
            isinstance(value, int | float | list) and not isinstance(value, bool)
        ):
            yield path + key


def test_there_are_catalogues_to_check():
    assert len(FILES) >= 25


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_every_number_has_a_source_and_every_source_a_number(path):
    table = tomllib.loads(path.read_text(encoding="utf-8"))
    assert set(table["sources"]) == set(numbers(table))


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_every_source_begins_with_its_status_letter_and_says_something(path):
    sources = tomllib.loads(path.read_text(encoding="utf-8"))["sources"]
    for field, source in sources.items():
        assert source.startswith(STATUS), field
        assert len(source) > 12, field


def test_robots_without_a_centroid_say_where_their_figures_come_from():
    for name, entry in catalog.gross_robots().items():
        assert set(entry) == {"title", "figures", "source"}, name
        assert entry["source"].startswith(STATUS), name


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_a_file_is_called_as_the_sheet_is_and_is_plain_ascii(path):
    text = path.read_bytes()
    assert text.isascii(), "a terminal of any encoding shows it"
    assert tomllib.loads(text.decode())["name"] == path.stem
    assert path.suffix == ".toml"
