import httpx
import pytest

from serving import served


@pytest.fixture(scope="session")
def address():
    """Address of one server, with the defaults, for all modules that ask for no other one."""
    with served() as found:
        yield found.base_url


@pytest.fixture(scope="module")
def client(address):
    """Client of its own: to the server another owner of jobs in each module."""
    with httpx.Client(base_url=address, timeout=60) as found:
        yield found
