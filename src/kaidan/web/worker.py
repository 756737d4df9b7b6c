"""A worker process: tasks in, answers out, within a bound of memory, until its input ends.

Tasks and answers are frames: eight bytes of length, then so many bytes. A task is one frame of
JSON; its answer is a frame of JSON that says how it ended, then one of what is to be sent. Before
that there may be frames that say how far it is.
"""

import json
import os
import struct
import sys
import threading
import time
from typing import BinaryIO

LENGTH = struct.Struct("!Q")
_EVERY = 0.2
"""Least time between two words on how far it is [s]."""


def main() -> None:
    """Answer tasks from standard input until it ends.

    Arguments are the most memory [bytes], by how much other processes go first, and a verb that it
    answers once before its first task, or nothing.
    """
    tasks = sys.stdin.buffer
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # what a library prints is no answer
    if hasattr(os, "setpgrp"):
        os.setpgrp()  # no session of its own, beyond which "nice" means nothing on Linux
    _bound_memory(int(sys.argv[1]))
    if int(sys.argv[2]) and hasattr(os, "nice"):
        os.nice(int(sys.argv[2]))
    threading.Thread(target=_end_with, args=(os.getppid(),), daemon=True).start()
    from kaidan.progress import followed
    from kaidan.web import tasks as known

    if sys.argv[3]:
        known.prepare(sys.argv[3])
    said = 0.0

    def follow(what: str, done: int, of: int) -> None:
        nonlocal said
        if time.monotonic() - said >= _EVERY:
            said = time.monotonic()
            _write(answers, json.dumps({"progress": [what, done, of]}).encode())

    with followed(follow):
        while (frame := _read(tasks)) is not None:
            head, content = known.done(json.loads(frame))
            _write(answers, json.dumps(head).encode(), content)


def _bound_memory(most: int) -> None:
    """Refuse memory beyond so many bytes, and leave no core file."""
    if sys.platform == "win32":
        return
    import resource

    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def _end_with(parent: int) -> None:
    """Do not outlive the server, even where it was killed."""
    while os.getppid() == parent:
        time.sleep(1.0)
    os._exit(1)


def _read(stream: BinaryIO) -> bytes | None:
    head = stream.read(LENGTH.size)
    if len(head) < LENGTH.size:
        return None
    return stream.read(LENGTH.unpack(head)[0])


def _write(stream: BinaryIO, *frames: bytes) -> None:
    for frame in frames:
        stream.write(LENGTH.pack(len(frame)) + frame)
    stream.flush()


if __name__ == "__main__":
    main()
