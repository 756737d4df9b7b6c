"""Marks of the verdicts: who sees no colour sees a shape, and there is a word besides."""

MARKS = {"go": "●", "caution": "▲", "no-go": "■", "outside-model": "◇"}
"""By verdict; all are in DejaVu Sans."""
