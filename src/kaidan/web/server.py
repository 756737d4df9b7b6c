"""The server: where it listens, and what it says about that."""

import ipaddress
import secrets
import socket
from typing import Any

import uvicorn

from kaidan.errors import InputError, short
from kaidan.web.app import app_of
from kaidan.web.connections import Connection
from kaidan.web.guard import SHORTEST_TOKEN, Guard
from kaidan.web.pace import Paced
from kaidan.web.state import State

_SAID = 4096
"""Longest message of a page on a websocket [bytes]; it has nothing to say there."""


def is_local(host: str) -> bool:
    """Whether only this machine can reach an address.

    Examples
    --------
    >>> is_local("127.0.0.1"), is_local("0.0.0.0")
    (True, False)
    """
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


def listening(host: str, port: int) -> socket.socket:
    """Socket that listens; port 0 is one that is free."""
    try:
        family = socket.AF_INET6 if ":" in host else socket.AF_INET
        opened = socket.create_server((host, port), family=family, backlog=2048)
    except (OSError, UnicodeError) as error:
        why = getattr(error, "strerror", None) or str(error)
        raise InputError(f"cannot listen at {short(host)}, port {port}: {why}") from None
    # else a small answer waits 40 ms for the client's word that its head has come
    opened.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return opened


def server_of(state: State, *, host: str, token: str, workers: int, **how: Any) -> uvicorn.Server:
    """Server that has yet to run on a socket that listens.

    token: what clients must know; empty: none, which only this machine may be allowed.
    **how: as `kaidan.web.app.app_of` has it.
    """
    hosts = () if is_local(host) else (host, socket.gethostname(), socket.getfqdn())
    config = uvicorn.Config(
        Guard(Paced(app_of(state, workers=workers, **how)), token=token, hosts=hosts),
        log_level="warning",
        access_log=False,
        server_header=False,
        proxy_headers=False,
        http=Connection,
        ws_max_size=_SAID,
        timeout_keep_alive=int(Connection.patience.head),  # which ends the connection then
        timeout_graceful_shutdown=5,
    )
    return uvicorn.Server(config)


def token_for(host: str, stated: str | None) -> str:
    """Token that clients must send: what was stated, or a new one where one is needed.

    Empty: no token is needed.
    """
    if stated and not is_local(host) and len(stated) < SHORTEST_TOKEN:
        raise InputError(
            f"--token has {len(stated)} characters: at {short(host)} it needs {SHORTEST_TOKEN}; "
            "without --token the server makes one"
        )
    return stated or ("" if is_local(host) else secrets.token_urlsafe(24))
