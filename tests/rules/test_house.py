"""CONTRIBUTING shows the house as it is."""

import ast
import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_every_floor_is_in_the_table():
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text())
    layers = settings["tool"]["importlinter"]["contracts"][0]["layers"]
    floors = {name for layer in layers for name in layer.split(" | ")} - {"__main__"}
    lines = (ROOT / "CONTRIBUTING.md").read_text().splitlines()
    cells = [line.split("|")[1] for line in lines if line.startswith("| `")]
    told = {name.rstrip("/") for cell in cells for name in re.findall("`([^`]+)`", cell)}
    assert floors <= told, "a floor of pyproject.toml that CONTRIBUTING does not name"
    folders = {name for name in told if not name.startswith("tests/")}
    assert folders <= floors, "a floor that is no more"


def test_figures_import_no_answer_but_for_its_type():
    """As contracts see types as well, they cannot tell."""
    source = ROOT / "src" / "kaidan"
    for path in [*(source / "figures").glob("*.py"), *(source / "lab").glob("*/*figure.py")]:
        tree = ast.parse(path.read_text())
        of_types = {
            id(each)
            for node in ast.walk(tree)
            if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"
            for each in ast.walk(node)
        }
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom) and id(node) not in of_types:
                computes = re.match(r"kaidan\.(verbs|assessment|sweeps|physics)\b", node.module)
                assert computes is None, f"{path.name}: {node.module}"
