"""The folder of a server that is given none."""

from pathlib import Path

import pytest

pytest.importorskip("fastapi")

from kaidan.web.state import usual_folder


@pytest.mark.parametrize("relative", ["", "state", "./state", "../state", "~/state"])
def test_a_relative_folder_of_the_environment_is_ignored(monkeypatch, tmp_path, relative):
    """XDG Base Directory Specification 0.8: all paths in these variables must be absolute."""
    monkeypatch.delenv("LOCALAPPDATA", raising=False)
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("XDG_STATE_HOME", relative)
    assert usual_folder() == tmp_path / ".local" / "state" / "kaidan"
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "own"))
    assert usual_folder() == Path(tmp_path / "own" / "kaidan")
