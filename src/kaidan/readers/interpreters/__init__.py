"""One module for each kind, with ``found(contents, hints) -> Found``: what it means."""
