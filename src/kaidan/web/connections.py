"""Connections: an end to whatever a client leaves undone, and a share of them for each address.

uvicorn ends an idle connection after an answer. It waits for ever for the first request, for the
rest of a head or a body, and for a client that does not read.
"""

import asyncio
import sys
from typing import Any, NamedTuple

from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol

from kaidan.web.shares import NOT_BEFORE, network_of, share_of

_EVERY = 1.0
"""How often a connection is looked at [s]."""
_REASONS = {
    408: (b"408 Request Timeout", b"the request took too long to come", b"timeout"),
    431: (b"431 Request Header Fields Too Large", b"the head is too large", b"too-large"),
    503: (b"503 Service Unavailable", b"too many connections; try again in a while", b"busy"),
}


class Patience(NamedTuple):
    """What a connection may take."""

    head: float = 10.0
    """Time for a whole head, from the beginning or from the answer before [s]."""
    grace: float = 3.0
    """Time for a head before the connection makes room where there is none [s]."""
    body: float = 20.0
    """Time for a body, however small [s]."""
    rate: float = 16_000.0
    """Least rate of a body that takes longer [bytes/s]: a poor radio link still has it."""
    reading: float = 30.0
    """How long a client may read nothing of what is sent to it [s]."""
    largest_head: int = 65_536
    """Largest head [bytes]."""
    connections: int = 512
    """Connections of all clients; fewer where the system lets a process open few files."""


class Connection(HttpToolsProtocol):
    """HTTP/1.1 connection that ends when its client does not go on."""

    patience = Patience()
    sent_away = False
    """Whether there is no room for it. It is refused after a while: it would come again at once."""

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Begin, or send the client away where there is no room."""
        super().connection_made(transport)
        self.network = network_of(_address(self))
        self._in_head, self._head, self._unread = False, 0, 0
        self._read = self.loop.time()
        self._wait_anew()
        self._timer = self.loop.call_later(_EVERY, self._look)
        self._admit()

    def connection_lost(self, exc: Exception | None) -> None:
        """End."""
        self._timer.cancel()
        super().connection_lost(exc)

    def handle_websocket_upgrade(self) -> None:
        """Hand the connection on; a websocket has pings of its own."""
        self._timer.cancel()
        super().handle_websocket_upgrade()

    def data_received(self, data: bytes) -> None:
        """Take what came."""
        self._came += len(data)
        super().data_received(data)
        if self._in_head:
            self._head += len(data)
            if self._head > self.patience.largest_head:
                self._refuse(431)

    def on_message_begin(self) -> None:
        """Begin a request."""
        super().on_message_begin()
        self._in_head, self._head = True, 0

    def on_headers_complete(self) -> None:
        """Wait for the body."""
        self._in_head = False
        self._wait_anew()
        super().on_headers_complete()

    def on_response_complete(self) -> None:
        """Wait for the next request."""
        self._wait_anew()
        super().on_response_complete()

    def resume_writing(self) -> None:
        """Write on: the client has read."""
        self._read = self.loop.time()
        super().resume_writing()

    @property
    def answered(self) -> bool:
        """Whether no request is under way."""
        return self.cycle is None or self.cycle.response_complete

    def _wait_anew(self) -> None:
        self.since, self._came = self.loop.time(), 0

    def _look(self) -> None:
        """End what does not go on; what was written first has the time that it is read in."""
        now, unread = self.loop.time(), self.transport.get_write_buffer_size()
        if unread < self._unread or not unread:
            self._read = now
        self._unread = unread
        if self.sent_away:
            if now - self.since > self.patience.grace:
                self._refuse(503)
        elif now - self._read > self.patience.reading:
            self.transport.abort()
        elif not unread and self._is_late(now):
            self._refuse(408)
        self._timer = self.loop.call_later(_EVERY, self._look)

    def _is_late(self, now: float) -> bool:
        """Whether the client took longer than it may for what it has to send next."""
        waited = now - self.since
        if self.answered:
            return waited > self.patience.head
        awaited = self.cycle.more_body and not self.flow.read_paused
        return awaited and waited - self._came / self.patience.rate > self.patience.body

    def _admit(self) -> None:
        """Stay where there is room, perhaps in the place of one that waits for a head."""
        most = min(self.patience.connections, _open_files() // 2)
        if len(self.connections) <= share_of(most):
            return
        here = mine = away = 0
        idle: list[Connection] = []
        each: Any  # also websockets
        for each in self.connections:
            http = isinstance(each, Connection)
            if each.transport.is_closing():
                continue
            if http and each.sent_away:
                away += 1
                continue
            here += 1
            mine += (each.network if http else network_of(_address(each))) == self.network
            if http and each is not self and each.answered:
                idle.append(each)
        if mine > share_of(most):
            idle = [each for each in idle if each.network == self.network]
        elif here <= most:
            return
        if not self._replaces(idle):
            self.sent_away = True
            self.flow.pause_reading()
            if away >= share_of(most):
                self._refuse(503)

    def _replaces(self, idle: list["Connection"]) -> bool:
        """End the one that has waited for a head for longest, once it has had its grace."""
        first = min(idle, key=lambda each: each.since, default=self)
        if first is self or self.loop.time() - first.since < self.patience.grace:
            return False
        first.transport.abort()
        return True

    def _refuse(self, status: int) -> None:
        """Say why this connection ends, where no answer has begun, and end it."""
        if self.transport.is_closing():
            return
        if self.answered or not self.cycle.response_started:
            line, text, kind = _REASONS[status]
            said = b'{"error": "%s", "kind": "%s"}' % (text, kind)
            head = b"HTTP/1.1 %s\r\ncontent-type: application/json\r\n" % line
            head += b"retry-after: %d\r\n" % NOT_BEFORE if status == 503 else b""
            head += b"content-length: %d\r\nconnection: close\r\n\r\n" % len(said)
            self.transport.write(head + said)
        self.transport.close()


def _address(connection: Any) -> str:
    """Address of a client, also of one whose connection has become a websocket."""
    return str(connection.client[0]) if connection.client else ""


def _open_files() -> int:
    """How many files this process may have open."""
    if sys.platform == "win32":
        return 8192
    import resource

    return resource.getrlimit(resource.RLIMIT_NOFILE)[0]
