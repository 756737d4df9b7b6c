"""Packages that kaidan names: their tested versions, and their licences."""

import re
import tomllib
from itertools import chain
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[2]
UNTRIED = {"imageio", "imageio-ffmpeg"}
"""Of the extra `video`, of which nothing runs in the tests."""


def named():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"].values()
    found = map(Requirement, [*project["dependencies"], *chain.from_iterable(extras)])
    return [each for each in found if each.name != "kaidan"]


def constraints():
    lines = (ROOT / "constraints.txt").read_text().splitlines()
    return [line for line in lines if not line.startswith("#")]


def test_every_line_is_a_name_and_a_version():
    assert [line for line in constraints() if not re.fullmatch(r"[a-z0-9-]+==[\w.]+", line)] == []


@pytest.mark.parametrize("requirement", named(), ids=str)
def test_every_package_has_a_tested_version_that_is_allowed(requirement):
    versions = dict(line.split("==") for line in constraints())
    name = canonicalize_name(requirement.name)
    assert (name in versions) != (name in UNTRIED)
    if name in versions:
        assert requirement.specifier.contains(versions[name])


def test_every_package_has_its_licence_and_what_it_is_for():
    text = (ROOT / "docs/licences.md").read_text()
    rows = re.findall(r"^\| ([^|]+) \| ([^|]+) \| ([^|]+) \|", text, re.MULTILINE)
    listed = {canonicalize_name(name) for names, _, _ in rows for name in names.split(", ")}
    wanted = {canonicalize_name(each.name) for each in named()}
    wanted |= {line.partition("==")[0] for line in constraints()}
    assert wanted - listed == set()
    assert all(licence.strip() and use.strip() for _, licence, use in rows)
