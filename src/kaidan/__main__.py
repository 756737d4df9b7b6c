"""The command ``kaidan``, also as ``python -m kaidan``.

Nothing is imported here that takes time, so that Ctrl-C at the start ends in one line too.
"""

import atexit
import gc
import os
import sys

RARELY = 200_000
"""New objects after which garbage is looked for: what modules and classes are made of is none, and
looking through it takes a tenth of the time of a short command."""


def main() -> None:
    """Run the command line and end the process with its exit code."""
    gc.set_threshold(RARELY)
    try:
        from kaidan.cli import run

        code = run(sys.argv[1:])
    except KeyboardInterrupt:
        print("kaidan: interrupted", file=sys.stderr)  # noqa: T201
        code = 130
    end(code)


def end(code: int) -> None:
    """End the process with an exit code.

    What was registered for the end is done and what was said is flushed, but what the process holds
    is not taken apart, which would take a quarter of the time of a short command. Where threads are
    still at work the interpreter ends the process.
    """
    threading = sys.modules.get("threading")
    if threading is not None and threading.active_count() > 1:
        sys.exit(code)
    atexit._run_exitfuncs()
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (AttributeError, OSError, ValueError):  # closed by who started it
            continue
    os._exit(code)


if __name__ == "__main__":
    main()
