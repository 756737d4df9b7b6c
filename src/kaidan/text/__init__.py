"""Every sentence for people, once: pure functions from an answer to a text.

One module a kind of answer; its function ``text`` is what `str` of the answer says and what the
command prints. Nothing here draws, prints or computes, so that a page or a report can import it.
"""
