"""The command line: degrees and millimetres in, verdicts and pictures out.

Exit codes: those of `kaidan.modes.EXIT_CODES`, 3 also for a file that holds nothing to judge, 70 a
fault of kaidan's own, 130 after Ctrl-C.
"""

import errno
import os
import re
import sys
from collections.abc import Sequence
from contextlib import suppress
from difflib import get_close_matches
from importlib import import_module
from pathlib import Path
from traceback import extract_tb, print_exc
from typing import Annotated, Any, TextIO

import typer

_COMMANDS = {
    "assess": ("assess",),
    "building": ("building",),
    "catalogs": ("robots", "stairs", "surfaces"),
    "compare": ("compare",),
    "design": ("design",),
    "doctor": ("doctor",),
    "lab": ("lab",),
    "live": ("live",),
    "margin": ("margin",),
    "measure": ("measure",),
    "monitor": ("monitor",),
    "new": ("new",),
    "plane": ("plane",),
    "posture": ("posture",),
    "read": ("read",),
    "report": ("report",),
    "schema": ("schema",),
    "sensitivity": ("sensitivity",),
    "serve": ("serve",),
    "study": ("study",),
    "sweep": ("sweep",),
    "traverse": ("traverse",),
}
"""Commands by the module that registers them: a requested one is loaded alone."""
_LABORATORY = "kaidan.lab.cli"
"""What registers `lab`: the one door to the laboratory, which nothing here imports."""
_MOVED = ("agree", "calibrate", "campaign", "experiment", "outcomes", "physics", "reproduce")
"""Commands that became those of the laboratory."""
_MOVED_OPTIONS = {"--rerun": "kaidan lab rerun, of the answer that --json prints"}

_START_LIGHTLY = {
    "OPENBLAS_NUM_THREADS": "1",  # no matrix here is worth the threads numpy would start
    "PYDANTIC_DISABLE_PLUGINS": "__all__",  # kaidan uses none, and looking for some takes time
}

COMPLETE = "_KAIDAN_COMPLETE"
"""Variable by which the completion script of a shell calls."""
INTERNAL = 70
"""Exit code of a fault of kaidan's own: EX_SOFTWARE of sysexits.h."""
_CANNOT_BE_WRITTEN = (errno.ENOSPC, errno.EDQUOT, errno.EIO, errno.EBADF, errno.EFBIG)
_ENDLESS = re.compile(r"\S{300,}")
_UsageError: type[Exception] = typer.BadParameter.__mro__[1]
"""Of click, which typer brings along under different names."""


def _print_version(requested: bool) -> None:
    if requested:
        from kaidan import __version__

        typer.echo(__version__)
        raise typer.Exit


def kaidan(
    version: Annotated[
        bool,
        typer.Option("--version", "-V", callback=_print_version, help="Show the version and exit."),
    ] = False,
) -> None:
    """Can this tracked robot take these stairs?

    Robots and stairs are names (kaidan robots, kaidan stairs) or sheets of your own: kaidan
    measure robot -h and kaidan measure stairs -h say how to get there with scales, tape and level.
    Then ask: kaidan assess ROBOT STAIRS.
    """


def app_for(words: Sequence[str]) -> typer.Typer:
    """Command line with the command that comes first, or with all if that is none of them."""
    command = words[0] if words else ""
    known = {each for commands in _COMMANDS.values() for each in commands}
    app = typer.Typer(
        name="kaidan",
        no_args_is_help=True,
        add_completion=command not in known,
        pretty_exceptions_enable=False,
        rich_markup_mode=None,
        context_settings={"help_option_names": ["-h", "--help"]},
    )
    app.callback()(kaidan)
    modules = [name for name, commands in _COMMANDS.items() if command in commands] or _COMMANDS
    for name in modules:
        module = _LABORATORY if name == "lab" else f"kaidan.cli.{name}"
        import_module(module).register(app)
    return app


def __getattr__(name: str) -> Any:
    """All commands as `app`, for those who run it in their own process."""
    if name == "app":
        return app_for(())
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def run(words: Sequence[str]) -> int:
    """Exit code of a command line; whatever goes wrong is said in one line on standard error.

    Parameters
    ----------
    words : sequence of str
        Command and its arguments.

    Returns
    -------
    int
        What the command ends with; 2 for what kaidan refuses, 70 for a fault of kaidan's own, 130
        after Ctrl-C, 0 if nobody reads the answer to its end (a closed pipe).
    """
    for name, value in _START_LIGHTLY.items():
        os.environ.setdefault(name, value)
    closed = sys.stdout is None  # by who started it
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w"))  # noqa: SIM115
    if closed:
        return _complain("the answer cannot be written: standard output is closed")
    from kaidan.errors import KaidanError, RefusedError
    from kaidan.modes import Verdict

    try:
        code = _outcome(words)
        sys.stdout.flush()
        return code
    except RefusedError as error:
        return _complain(str(error), Verdict.OUTSIDE_MODEL.exit_code)
    except KaidanError as error:
        return _complain(str(error))
    except _UsageError as error:
        if type(error).__name__ == "NoArgsIsHelpError":
            return _say(str(error), 2)
        return _complain(_usage(error))
    except (KeyboardInterrupt, typer.Abort):
        return _complain("interrupted", 130)
    except BrokenPipeError:
        _read_by_nobody(sys.stdout)
        return 0
    except Exception as error:
        if isinstance(error, OSError) and error.errno in _CANNOT_BE_WRITTEN:
            _read_by_nobody(sys.stdout)
            return _complain(f"the answer cannot be written: {error.strerror}")
        if type(error).__name__ == "SchemaError" and "KeyboardInterrupt" in str(error):
            return _complain("interrupted", 130)  # of pydantic, as it built a class
        if os.environ.get("KAIDAN_DEBUG"):
            print_exc()
        return _complain(_fault(error), INTERNAL)


def _outcome(words: Sequence[str]) -> int:
    """Run a command; the exit code that it asks for."""
    if COMPLETE in os.environ:  # a shell asks what may follow
        whole = typer.main.get_command(app_for(()))
        try:
            whole.main(list(words), prog_name="kaidan", complete_var=COMPLETE)
        except SystemExit as ended:
            return int(ended.code or 0)
    if words and words[0] in _MOVED:
        from kaidan.errors import InputError

        raise InputError(f"kaidan {words[0]} is now kaidan lab {words[0]} (see kaidan lab -h)")
    command = typer.main.get_command(app_for(words))
    try:
        with command.make_context("kaidan", list(words)) as context:
            command.invoke(context)
    except typer.Exit as ended:
        return ended.exit_code
    return 0


def _usage(error: Exception) -> str:
    """Refusal of a word of the command line, with what may have been meant and where to look."""
    from kaidan.errors import fault, shown

    context = getattr(error, "ctx", None)
    refused = getattr(error.__cause__, "errors", None)  # typer has pydantic read numbers
    if refused is not None:
        detail = refused()[0]
        if detail["type"] != "value_error":  # which has a text of typer's
            error.message = f"{shown(detail['input'])} {fault(detail)}"  # type: ignore[attr-defined]
    text = error.format_message().strip().replace("Value error, ", "")  # type: ignore[attr-defined]
    if type(error).__name__ == "NoSuchOption":
        option, known = (getattr(error, name) or () for name in ("option_name", "possibilities"))
        close = get_close_matches(option, known, n=1, cutoff=0.7)
        text = f"no such option: {option}{f'; did you mean {close[0]}?' if close else ''}"
        if option in _MOVED_OPTIONS:
            text = f"{option} is now {_MOVED_OPTIONS[option]}"
    where = "kaidan" if context is None else context.command_path
    return f"{text[:1].lower()}{text[1:].rstrip('.')} (see {where} -h)"


def _fault(error: Exception) -> str:
    """What an error is that nobody foresaw, where, and what to do."""
    frames = extract_tb(error.__traceback__)
    own = [frame for frame in frames if "kaidan" in frame.filename] or frames
    place = f"{Path(own[-1].filename).name}:{own[-1].lineno}"
    return (
        f"a fault of kaidan itself, {type(error).__name__} in {place}: {error}; please report it "
        "with the command and what it prints with KAIDAN_DEBUG=1"
    )


def _complain(text: str, code: int = 2) -> int:
    """Say in one line what is wrong; the exit code."""
    from kaidan.errors import within
    from kaidan.tables import printable

    line = printable(" ".join(text.split()))
    line = _ENDLESS.sub(lambda word: f"{word.group()[:57]}...", line)
    return _say(f"kaidan: {within(line)}", code)


def _say(text: str, code: int) -> int:
    """Print on standard error, if anybody listens; the exit code."""
    try:
        print(text, file=sys.stderr, flush=True)  # noqa: T201
    except OSError:
        _read_by_nobody(sys.stderr)
    return code


def _read_by_nobody(stream: TextIO) -> None:
    """Let what a stream still holds go nowhere, so that the end of the process is silent."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    with suppress(OSError, ValueError):
        os.dup2(nowhere, stream.fileno())
    os.close(nowhere)
