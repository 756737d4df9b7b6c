"""A disk without room: what says so, and what is said."""

import errno
import sqlite3

FULL = "the disk of the server is full: ask who runs it to make room"
"""What a client reads where `is_full` holds."""
_NO_ROOM = {errno.ENOSPC, errno.EFBIG, getattr(errno, "EDQUOT", errno.ENOSPC)}


def is_full(error: BaseException) -> bool:
    """Whether something could not be written for want of room."""
    if isinstance(error, sqlite3.OperationalError):
        # a bound on the size of files comes as an error of writing
        return error.sqlite_errorcode in (sqlite3.SQLITE_FULL, sqlite3.SQLITE_IOERR_WRITE)
    if isinstance(error, OSError):
        return error.errno in _NO_ROOM
    return error.__context__ is not None and is_full(error.__context__)
