"""Everything in the source serves somebody: what only tests name goes."""

from rules.unreached import unreached

UNNAMED = (
    "kaidan.contact.heights.TouchingHeights.contact_x",
    "kaidan.contact.heights.TouchingHeights.contact_z",
    "kaidan.contact.memory.Table._part",
    "kaidan.contact.memory._ends",
)
"""Read without their name: parts of a tuple taken apart; what a slice of a table makes."""


def test_a_command_a_verb_or_a_page_reaches_everything():
    assert [name for name in unreached() if name not in UNNAMED] == []
