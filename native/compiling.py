"""From the generated C to a library that Python loads: a C compiler and Python's headers do it."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

#: Whole numbers wrap; one rounding for each operation, none fused; nobody reads errno. Numbers side
#: by side are not written as one, for what then reads one of them would wait: a tenth more time.
EXACT = (
    "-std=gnu11", "-O3", "-fno-tree-slp-vectorize", "-fwrapv", "-ffp-contract=off",
    "-fno-math-errno", "-g0",
)  # fmt: skip
#: Tried in this order where the environment names none in ``CC``; any takes the options of GCC.
COMPILERS = ("cc", "gcc", "clang", "zig")
#: For which the library is built: a tag of wheels, this machine's unless the environment names one.
PLATFORM = os.environ.get("KAIDAN_PLATFORM") or re.sub(r"\W", "_", sysconfig.get_platform())
#: File name of the library: of Python's stable interface.
LIBRARY = "_native.pyd" if PLATFORM.startswith("win") else "_native.abi3.so"


class NoCompilerError(Exception):
    """There is no C compiler, or it refuses."""


def compiler() -> list[str]:
    """Command of the C compiler: ``CC``, or the first that is installed."""
    if os.environ.get("CC"):
        return shlex.split(os.environ["CC"], posix=os.name != "nt")
    for name in COMPILERS:
        if shutil.which(name):
            return [name, "cc"] if name == "zig" else [name]
    raise NoCompilerError(f"none of {', '.join(COMPILERS)} is installed")


def linking() -> list[str]:
    """Options with which Python's own functions are found when the library is loaded."""
    if PLATFORM.startswith("win"):
        return ["-shared", f"-L{Path(sys.base_prefix) / 'libs'}", "-lpython3"]
    if PLATFORM.startswith("macosx"):
        return ["-shared", "-Wl,-undefined,dynamic_lookup"]
    return ["-shared", "-fPIC"]


def compile_library(source: Path, library: Path) -> None:
    """Compile a module of C; ``CFLAGS``, ``LDFLAGS`` and ``ARCHFLAGS`` are honored."""
    more = [each for name in ("ARCHFLAGS", "CFLAGS", "LDFLAGS")
            for each in shlex.split(os.environ.get(name, ""))]  # fmt: skip
    include = f"-I{sysconfig.get_path('include')}"
    command = [*compiler(), *EXACT, include, str(source), "-o", str(library), *linking(), *more]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as error:
        raise NoCompilerError(str(error)) from error
    if done.returncode:
        raise NoCompilerError(f"{shlex.join(command)}\n{done.stderr}")
