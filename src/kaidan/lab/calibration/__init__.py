"""Calibration: what of the physics the paper's text fixes, and what that predicts blind."""
