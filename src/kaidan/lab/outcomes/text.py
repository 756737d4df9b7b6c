"""Public outcomes beside kaidan's answers, as text."""

from typing import TYPE_CHECKING

from kaidan.tables import table

if TYPE_CHECKING:
    from kaidan.lab.outcomes.known_outcomes import KnownOutcomes, Pair, Tally

AIM = "Aim, over tests: no wrong GO, no wrong ROUGH, at least 80 % agree, at most 15 % undecided."
_EVIDENCE = {"test": "real robot", "simulation": "simulation of others"}
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
_KNOWLEDGE = {
    "source": "what the source has",
    "operator": "what an operator knows: nothing measured, no grip",
    "grip tried": "the same, grip tried, 3 deg off heading",
}


def text(found: "KnownOutcomes") -> str:
    """One line a pair as the source has it, the counts by what is known, and their aim."""
    shown = [pair for pair in found.pairs if pair.knowledge == "source" and not pair.fill_in]
    counted = [_counted(tally) for tally in found.tallies]
    return "\n".join(
        [
            table([_row(pair) for pair in shown], _COLUMNS),
            "",
            table(counted, {name: name for name in counted[0]}),
            "",
            "In brackets: where the share lies with 95 %, were the pairs independent. They are of",
            "one rig, so it is less certain. Pairs at every 5 deg are easy, and counted apart.",
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


def _counted(tally: "Tally") -> dict[str, str]:
    return {
        "evidence": _EVIDENCE[tally.evidence] + (", every 5 deg" if tally.fill_in else ""),
        "known": _KNOWLEDGE[tally.knowledge],
        "pairs": str(tally.pairs),
        "agree": f"{tally.agree} {_span(tally.agree_share)}",
        "wrong GO": f"{tally.wrong_go} {_span(tally.wrong_go_share)}",
        "wrong ROUGH": str(tally.wrong_rough),
        "wrong NO-GO": str(tally.wrong_no_go),
        "undecided": str(tally.undecided),
        "outside": str(tally.no_answer),
    }


def _span(share: tuple[float, float]) -> str:
    return f"({100 * share[0]:.0f} to {100 * share[1]:.0f} %)"
