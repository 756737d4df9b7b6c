"""Fleets of robots and stocks of stairs: which share each robot takes, and what stops it."""
