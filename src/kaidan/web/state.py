"""The folder in which a server keeps what outlives it: its key, its jobs, and passing files."""

import os
import shutil
from pathlib import Path
from typing import Self

from kaidan.errors import InputError, short
from kaidan.work.lock import Lock


def usual_folder() -> Path:
    """Folder of a server that is given none: that of the user's programs.

    A relative one is ignored, as the XDG Base Directory Specification has it.
    """
    stated = (os.environ.get(name, "") for name in ("XDG_STATE_HOME", "LOCALAPPDATA"))
    bases = (Path(base) for base in stated if Path(base).is_absolute())
    return next(bases, Path.home() / ".local" / "state") / "kaidan"


class State:
    """A folder that belongs to one server at a time.

    folder: made if it is not there, readable by its owner alone.
    """

    def __init__(self, folder: Path) -> None:
        self.folder, self.passing, self.jobs = folder, folder / "passing", folder / "jobs"
        try:
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            folder.chmod(0o700)
            self._lock = self._locked()
            shutil.rmtree(self.passing, ignore_errors=True)  # of a server that was killed
            for each in (self.passing, self.jobs):
                each.mkdir(mode=0o700, exist_ok=True)
        except OSError as error:
            raise InputError(f"{short(folder)}: cannot be written: {error.strerror}") from None

    def _locked(self) -> Lock:
        try:
            return Lock(self.folder)
        except InputError:
            raise InputError(
                f"{short(self.folder)}: another server keeps its state there; give this one a "
                "folder of its own with --state"
            ) from None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *raised: object) -> None:
        shutil.rmtree(self.passing, ignore_errors=True)
        self._lock.release()
