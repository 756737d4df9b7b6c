"""A fair share for each client: no address may hold so much that nothing is left for another."""

import ipaddress
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from typing import NoReturn

from starlette.exceptions import HTTPException

NOT_BEFORE = 5
"""When a client may ask again that was sent away [s]."""


@lru_cache(4096)
def network_of(address: str) -> str:
    """What counts as one client: an IPv4 address, or the /64 that one household has of IPv6.

    Examples
    --------
    >>> network_of("192.0.2.7"), network_of("2001:db8::7"), network_of("::ffff:192.0.2.7")
    ('192.0.2.7', '2001:db8::/64', '192.0.2.7')
    """
    try:
        found = ipaddress.ip_address(address.partition("%")[0])
    except ValueError:
        return address
    if isinstance(found, ipaddress.IPv4Address):
        return str(found)
    if found.ipv4_mapped is not None:
        return str(found.ipv4_mapped)
    return str(ipaddress.ip_network((found, 64), strict=False))


def share_of(most: int) -> int:
    """How many of so many places one client may hold: half of them, and one at least."""
    return max(1, most // 2)


def send_away(text: str, *, whole: bool = False) -> NoReturn:
    """Refuse a client that holds its share already, or anybody if the whole is taken."""
    raise HTTPException(503 if whole else 429, text, {"Retry-After": str(NOT_BEFORE)})


class Places:
    """So many places, of which no client holds more than its share."""

    def __init__(self, most: int, what: str) -> None:
        self.most, self.what = most, what
        self._held: Counter[str] = Counter()

    def take(self, client: str) -> None:
        """Take a place for a client."""
        share = share_of(self.most)
        if self._held[client] >= share:
            send_away(f"your address has its share, {share} {self.what}: wait until one has ended")
        if self._held.total() >= self.most:
            send_away(f"{self.most} {self.what} of all clients: ask again in a while", whole=True)
        self._held[client] += 1

    def give_back(self, client: str) -> None:
        """Give a place of a client back."""
        self._held[client] -= 1
        if not self._held[client]:
            del self._held[client]

    @contextmanager
    def held(self, client: str) -> Iterator[None]:
        """Hold a place for a client meanwhile."""
        self.take(client)
        try:
            yield
        finally:
            self.give_back(client)
