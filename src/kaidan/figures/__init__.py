"""Figures of answers: they draw, and compute nothing.

A module that ends in ``_figure`` takes an answer and returns a matplotlib figure; ``animation``
makes a film. ``style`` holds what all figures share, ``saving`` makes the bytes of their files.
Answers are known by their fields alone: one that was read back from its JSON is drawn as well.
"""

from kaidan.errors import needed

needed("matplotlib", "a figure", "figures")
