"""Build hook: the contact kernel as machine code, beside the pure package.

Where no C compiler is at hand, or ``KAIDAN_BUILD_NATIVE=0`` is set, the package is built pure: it
answers the same, about a hundred times slower. ``CFLAGS`` is honored, for sanitizers for example.
"""

from __future__ import annotations

import os
import sys
import sysconfig
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

#: Python whose stable interface is built for, the oldest that kaidan runs on.
ABI, ABI_MACRO = "cp311", "0x030B0000"


class NativeKernel(BuildHookInterface[Any]):
    """Compiles the kernel and adds it to the wheel; into the source tree for an editable one."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        if os.environ.get("KAIDAN_BUILD_NATIVE") == "0":
            return
        from setuptools.errors import BaseError, CCompilerError

        # kept until the wheel is written
        self.work = tempfile.TemporaryDirectory(prefix="kaidan-native-")
        root, work = Path(self.root), Path(self.work.name)
        try:
            built = compiled(root, work)
        except (BaseError, CCompilerError) as error:
            self.app.display_warning(f"kaidan is built without its native kernel: {error}")
            return
        if version == "editable":
            (root / "src/kaidan/contact" / built.name).write_bytes(built.read_bytes())
            return
        build_data["force_include"][str(built)] = f"kaidan/contact/{built.name}"
        build_data["pure_python"] = False
        platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
        build_data["tag"] = f"{ABI}-abi3-{platform}"

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        if hasattr(self, "work"):
            self.work.cleanup()


def compiled(root: Path, work: Path, text: str | None = None) -> Path:
    """Write, translate and compile the typed source of the kernel (or a text in its place).

    Returns the library.
    """
    from Cython.Build import cythonize
    from setuptools import Distribution, Extension

    sys.path[:0] = [str(root / "native"), str(root / "src")]
    from typed_source import typed_source

    source = work / "_native.pyx"
    source.write_text(text or typed_source(), encoding="utf-8")
    # one rounding for each operation, as in Python: none fused; errors are NaN, nobody reads errno
    exact = ["-ffp-contract=off", "-fno-math-errno"]
    options = [] if sys.platform == "win32" else ["-O3", *exact, "-g0"]
    extension = Extension(
        "kaidan.contact._native", [str(source)], py_limited_api=True,
        define_macros=[("Py_LIMITED_API", ABI_MACRO)], extra_compile_args=options,
    )  # fmt: skip
    extensions = cythonize([extension], quiet=True, build_dir=str(work))
    command = Distribution({"ext_modules": extensions}).get_command_obj("build_ext")
    command.build_lib, command.build_temp = str(work / "lib"), str(work / "temp")
    command.ensure_finalized()
    command.run()
    return Path(command.get_outputs()[0])
