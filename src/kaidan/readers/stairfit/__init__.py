"""Stairs in points: gravity, heading, a fitted stair polyline, single steps, flights in a chain."""
