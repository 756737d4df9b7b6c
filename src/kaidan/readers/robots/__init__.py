"""Robots: the mechanism that a file describes, and the data sheet that follows from it."""
