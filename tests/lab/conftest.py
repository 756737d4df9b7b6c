"""MuJoCo through `engine` first, which chooses how to draw without a display."""

from contextlib import suppress

from kaidan.physics.engine import engine

with suppress(ImportError):
    engine()
