import os
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
os.environ.pop("COLUMNS", None)  # tables as wide as they like, whatever screen runs the tests


@pytest.fixture(scope="session")
def compiled_kernel(tmp_path_factory):
    """Contact kernel compiled if numba is there, for tests that ask many contact answers.

    One worker compiles, the others wait and read numba's cache. Without numba the plain kernel
    answers the same, hundreds of times more slowly.
    """
    from kaidan.contact.compiling import compiled, numba_is_installed

    if not numba_is_installed():
        return
    import fcntl

    shared = tmp_path_factory.getbasetemp().parent  # of all workers
    with (shared / "contact-kernel.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        compiled("course")
