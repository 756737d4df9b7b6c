"""Sessions: who may see which job. A session is a word that the server signed, and no more."""

import hashlib
import hmac
import secrets
from pathlib import Path

from kaidan.errors import InputError, short
from kaidan.files import whole_file

COOKIE = "kaidan_session"
HEADER = "X-Kaidan-Session"
KEPT = 30 * 86_400
"""How long a browser keeps a session [s]."""
_KEY = 32
"""Length of a key [bytes]."""


class Sessions:
    """Sessions signed with a key that outlives the server.

    key: file of the key; made if it is not there, readable by its owner alone.
    """

    def __init__(self, key: Path) -> None:
        if not key.exists():
            with whole_file(key, durable=True) as file:
                file.write(secrets.token_bytes(_KEY))
            key.chmod(0o600)
        self._key = key.read_bytes()
        if len(self._key) != _KEY:  # anybody could sign with an empty one
            raise InputError(f"{short(key)}: no key of a server; remove it, and sessions with it")

    def new(self) -> str:
        """Session that nobody had before."""
        word = secrets.token_urlsafe(24)
        return f"{word}.{self._signed(word)}"

    def owner(self, session: str) -> str | None:
        """Who has a session, as jobs name it; None: the server never gave it out."""
        word, _, signature = session.partition(".")
        if not hmac.compare_digest(self._signed(word).encode(), signature.encode()):
            return None
        return hashlib.sha256(word.encode()).hexdigest()

    def _signed(self, word: str) -> str:
        return hmac.new(self._key, word.encode(), hashlib.sha256).hexdigest()
