"""Mark of the kernel's sources: machine code made from others is not used."""

from __future__ import annotations

import hashlib
from pathlib import Path

from kaidan.contact.entries import KERNEL_MODULES


def source_mark() -> str:
    """Digest of all that the native kernel is built from."""
    here = Path(__file__).parent
    digest = hashlib.sha256()
    for name in ("codes", "layout", "memory", *(f"kernel/{each}" for each in KERNEL_MODULES)):
        digest.update((here / f"{name}.py").read_bytes())
    return digest.hexdigest()[:16]
