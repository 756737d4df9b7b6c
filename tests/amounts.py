"""Proofs in two sizes: a few cases in every run, all of them among the slow tests."""

import os

import pytest

SHARE = 5
"""Part of the examples of a property that every run looks at."""


def few_of(count, fast):
    """Numbers from 0, the first of them in every run, all others slow."""
    return [k if k < fast else pytest.param(k, marks=pytest.mark.slow) for k in range(count)]


def slow(case):
    """A case by name alone."""
    return pytest.param(case, marks=pytest.mark.slow)


def fast_and_slow(few, many):
    """An amount for every run, and the whole one by name."""
    whole = many if isinstance(many, tuple) else (many,)
    return [few, pytest.param(*whole, marks=pytest.mark.slow)]


def examples(whole, share=SHARE):
    """Examples of a property: a part of them, but for a profile that looks at all of them."""
    every_run = os.environ.get("HYPOTHESIS_PROFILE", "same") == "same"
    return -(-whole // share) if every_run else whole
