"""Build hook: the contact kernel as machine code, beside the pure package.

A source distribution carries the generated C. Where no C compiler is at hand, or
``KAIDAN_BUILD_NATIVE=0`` is set, the package is built pure: it answers the same, about a hundred
times slower. With ``KAIDAN_BUILD_NATIVE=1`` that is an error. ``CC`` and ``CFLAGS`` are honored.
"""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

sys.path.insert(0, str(Path(__file__).resolve().parent))

from compiling import LIBRARY, PLATFORM, NoCompilerError, compile_library
from kernel_source import CARRIED, carried_source, kernel_source

#: Python whose stable interface is built for, the oldest that kaidan runs on.
ABI = "cp311"


class NativeKernel(BuildHookInterface[Any]):
    """Adds the kernel: its C to a source distribution, its machine code to a wheel.

    For an editable installation it lies in the source tree.
    """

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        # kept until the distribution is written
        self.work = tempfile.TemporaryDirectory(prefix="kaidan-native-")
        root, work = Path(self.root), Path(self.work.name)
        source, library = work / "kernel.c", work / LIBRARY
        if self.target_name == "sdist":
            source.write_text(kernel_source(), encoding="utf-8")
            build_data["force_include"][str(source)] = CARRIED
            return
        if os.environ.get("KAIDAN_BUILD_NATIVE") == "0":
            return
        source.write_text(carried_source() or kernel_source(), encoding="utf-8")
        try:
            compile_library(source, library)
        except NoCompilerError as error:
            if os.environ.get("KAIDAN_BUILD_NATIVE") == "1":
                raise
            self.app.display_warning(f"kaidan is built without its native kernel: {error}")
            return
        if version == "editable":
            (root / "src/kaidan/contact" / LIBRARY).write_bytes(library.read_bytes())
            return
        build_data["force_include"][str(library)] = f"kaidan/contact/{LIBRARY}"
        build_data["pure_python"] = False
        build_data["tag"] = f"{ABI}-abi3-{PLATFORM}"

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        self.work.cleanup()
