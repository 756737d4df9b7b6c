"""Completion in the shells, by the protocol of their scripts."""

import pytest

from kaidan.cli import COMPLETE, run


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
@pytest.mark.parametrize(
    ("line", "offered"),
    [
        ("kaidan assess ab", ["absolem", "absolem-flat"]),
        ("kaidan assess pack", ["packbot-510"]),
        ("kaidan assess absolem iso", ["iso-14122-3"]),
        ("kaidan measure st", ["stairs"]),
        ("kaidan assess absolem ibc --surface concrete-", ["concrete-dry", "concrete-wet"]),
    ],
)
def test_commands_and_names_of_the_catalogues_are_offered(
    shell, line, offered, monkeypatch, capsys
):
    monkeypatch.setenv(COMPLETE, f"complete_{shell}")
    monkeypatch.setenv("COMP_WORDS", line)
    monkeypatch.setenv("COMP_CWORD", str(len(line.split()) - 1))
    monkeypatch.setenv("_TYPER_COMPLETE_ARGS", line)
    monkeypatch.setenv("_TYPER_COMPLETE_FISH_ACTION", "get-args")
    assert run([]) == 0
    told = capsys.readouterr().out
    assert all(name in told for name in offered)
    assert "kenaf" not in told


def test_the_options_that_install_it_are_those_of_the_program_alone(capsys):
    assert run(["--help"]) == 0
    assert "--install-completion" in capsys.readouterr().out
    assert run(["assess", "--help"]) == 0
    assert "--install-completion" not in capsys.readouterr().out
