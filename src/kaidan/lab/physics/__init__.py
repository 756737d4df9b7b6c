"""Trials in MuJoCo as files: log, picture, film, model."""
