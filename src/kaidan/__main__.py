"""The command ``kaidan``, also as ``python -m kaidan``.

Nothing is imported here that takes time, so that Ctrl-C at the start ends in one line too.
"""

import sys


def main() -> None:
    """Run the command line and end the process with its exit code."""
    try:
        from kaidan.cli import run

        code = run(sys.argv[1:])
    except KeyboardInterrupt:
        print("kaidan: interrupted", file=sys.stderr)  # noqa: T201
        code = 130
    sys.exit(code)


if __name__ == "__main__":
    main()
