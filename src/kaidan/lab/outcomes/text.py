"""Public outcomes beside kaidan's answers, as text."""

from typing import TYPE_CHECKING

from kaidan.tables import table

if TYPE_CHECKING:
    from kaidan.lab.outcomes.known_outcomes import KnownOutcomes, Pair, Tally

AIM = "Aim, over tests: no wrong GO, at least 80 % agree, at most 15 % CAUTION."
_EVIDENCE = {"test": "tests of real robots", "simulation": "simulations of other projects"}
_COLUMNS = {
    "robot": "robot",
    "stairs": "stairs",
    "direction": "goes",
    "outcome": "outcome",
    "status": "status",
    "answer": "kaidan",
    "where": "where",
    "comparison": "comparison",
}


def text(found: "KnownOutcomes") -> str:
    """One line a pair, the counts, and what they are to be."""
    return "\n".join(
        [
            table([_row(pair) for pair in found.pairs], _COLUMNS),
            "",
            *map(_counted, found.tallies),
            AIM,
            f"Of {found.reported} more public outcomes and claims no geometry is public.",
        ]
    )


def _row(pair: "Pair") -> dict[str, str]:
    return {
        "robot": pair.robot,
        "stairs": pair.stairs,
        "direction": pair.direction,
        "outcome": pair.outcome,
        "status": pair.status,
        "answer": pair.verdict.label,
        "where": f"{pair.governs}, {pair.phase}" if pair.phase else pair.governs,
        "comparison": pair.comparison,
    }


def _counted(tally: "Tally") -> str:
    def share(count: int) -> str:
        return f" ({100 * count / tally.pairs:.0f} %)" if tally.pairs else ""

    outside = f", {tally.no_answer} outside the model" if tally.no_answer else ""
    return (
        f"{_EVIDENCE[tally.evidence]}, {tally.pairs} in all: "
        f"{tally.agree} agree{share(tally.agree)}, "
        f"{tally.wrong_go} wrong GO, {tally.wrong_no_go} wrong NO-GO, "
        f"{tally.caution} CAUTION{share(tally.caution)}{outside}"
    )
