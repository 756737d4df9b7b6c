"""The table in the page of decisions is the one that decides."""

import re
from pathlib import Path

from kaidan.modes import FAILURE_MODES, IfFails, Verdict

PAGE = Path(__file__).parents[2] / "docs/decisions.md"


def written() -> dict[str, IfFails]:
    """Verdicts of each failure mode as the page has them."""
    words = "|".join(each.label for each in Verdict)
    row = re.compile(rf"\| [^|]+ \| ({words}) \| ({words}) \| ({words}) \| (`[a-z_`, ]+) \|$", re.M)
    by_label = {each.label: each for each in Verdict}
    return {
        key: IfFails(*(by_label[word] for word in (best, worst, unknown)))
        for best, worst, unknown, keys in row.findall(PAGE.read_text(encoding="utf-8"))
        for key in re.findall(r"\w+", keys)
    }


def test_each_failure_mode_stands_in_the_table_with_its_verdicts():
    assert written() == {key: mode.if_fails for key, mode in FAILURE_MODES.items()}
