import pytest

from serving import served


@pytest.fixture(scope="module")
def client():
    with served() as found:
        yield found
