import os
import sys
from pathlib import Path

import pytest
from hypothesis import settings

sys.path.insert(0, str(Path(__file__).parent))
os.environ.pop("COLUMNS", None)  # tables as wide as they like, whatever screen runs the tests

# the same examples in every run, so that a check of main says something of main;
# HYPOTHESIS_PROFILE=random looks farther
settings.register_profile("same", derandomize=True, deadline=None)
settings.register_profile("random", deadline=None)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "same"))


@pytest.fixture(scope="module")
def compiled_kernel():
    """Contact kernel compiled if numba is there, for tests that ask many contact answers.

    One worker compiles, the others wait and read numba's cache. Without numba the plain kernel
    answers the same, hundreds of times more slowly.
    """
    from kaidan import contact

    with contact.using_kernel("compiled" if contact.numba_is_installed() else "plain"):
        yield
