"""Everything in the source serves somebody: what only tests name goes."""

from rules.unreached import unreached

PENDING = ("kaidan.contact.",)
"""What the kernel's own issue takes away."""


def test_a_command_a_verb_or_a_page_reaches_everything():
    assert [name for name in unreached() if not name.startswith(PENDING)] == []
