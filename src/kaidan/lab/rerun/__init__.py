"""Answers as recordings for the viewer of Rerun."""
