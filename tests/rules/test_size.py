"""kaidan grows no larger than its CHANGELOG says."""

import re

from rules.size import ROOT, Longest, sizes

ROW = re.compile(r"^\| ([^|]+?) \| ([\d,]+) \| ([\d,]+) \|$", re.MULTILINE)


def test_nothing_is_larger_than_the_changelog_says():
    unreleased = (ROOT / "CHANGELOG.md").read_text().split("\n## [")[1]
    stated = {
        name: int(last.replace(",", "")) + int(more.replace(",", ""))
        for name, last, more in ROW.findall(unreleased)
    }
    found = {
        name: size.count if isinstance(size, Longest) else size for name, size in sizes().items()
    }
    assert found.keys() == stated.keys()
    larger = {name: (size, stated[name]) for name, size in found.items() if size > stated[name]}
    assert larger == {}, "make it smaller, or say in the CHANGELOG by how much it may grow and why"
