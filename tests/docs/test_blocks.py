"""Every fenced Python and shell block of the README and the documentation, executed.

``pycon``
    a doctest; names live on from block to block of a page.
``python``
    executed, likewise.
``console``
    ``$ `` begins a command of bash, what follows is its output, standard error included. Where
    output is shown it must be that, but for lines that are only ``...``. Without output shown the
    command must not be refused (exit code 2). All commands of a page run in one empty folder: those
    of kaidan alone in this process, what needs a shell in one, and the README's, which strangers
    try first, as they would.
``sh``
    a command line that someone else executes; `ELSEWHERE` says who.
"""

import ast
import contextlib
import doctest
import io
import math
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest
from markdown_it import MarkdownIt

from answered import each_once
from kaidan.cli import run
from kaidan.modes import Verdict

ROOT = Path(__file__).parents[2]
PAGES = sorted(
    path.relative_to(ROOT)
    for path in (
        *ROOT.glob("*.md"),
        *(path for path in ROOT.glob("docs/**/*.md") if "_build" not in path.parts),
    )
)
KNOWN = {"pycon", "python", "console", "sh"}
SILENT = {"", "text", "toml", "json"}
"""Languages that nothing executes; ```` ```{directive} ```` is Sphinx's."""

ELSEWHERE = {
    "pip install .": ".ci/run, as part of the README's line",
    "python3 -m venv .venv && . .venv/bin/activate": ".ci/run, elsewhere",
    "pip install -e '.[dev]'": ".ci/run",
    ".ci/kernel": ".ci/run, for a short while",
    "python native/kernel_source.py kernel.c": ".ci/kernel",
    "KAIDAN_BUILD_NATIVE=0 pip install .": "by hand",
    "pip install -e .": ".ci/run, within '.[dev]'",
    "python3 -m venv fresh && fresh/bin/pip install -c constraints.txt '.[test]'": "by hand",
    "fresh/bin/kaidan doctor && fresh/bin/python -m pytest -q tests/unit/mechanics "
    'tests/unit/readers tests/validation -m "not slow"': "by hand",
    "pip install '.[docs]'": ".ci/run, within '.[dev]'",
    "ruff format --check . && ruff check . && mypy && lint-imports": ".ci/run",
    'pytest -n auto -m "not slow"': ".ci/run",
    "pytest -m slow": ".ci/run",
    "python benchmarks/startup.py": "by hand",
    "python benchmarks/assess.py": "by hand",
    "python benchmarks/clouds.py": "by hand",
    "python benchmarks/large_scan.py": "by hand",
    "python benchmarks/pairs.py": "by hand",
    "python benchmarks/stream.py": "by hand",
    "python benchmarks/physics.py": "by hand",
    "python benchmarks/experiment.py": "by hand",
    "pip install 'kaidan[physics,cluster]'   # several machines": ".ci/run, within '.[dev]'",
    "pip install 'kaidan[sweeps]'   # tables in Parquet and Zarr, stores, labelled Datasets": (
        ".ci/run, within '.[dev]'"
    ),
    "pip install 'kaidan[report]'   # matplotlib, ReportLab, segno": ".ci/run, within '.[dev]'",
    "pip install 'kaidan[rerun]'   # rerun-sdk": ".ci/run, within '.[dev]'",
    "pip install 'kaidan[ifc]'   # ifcopenshell and shapely": ".ci/run, within '.[dev]'",
    "python benchmarks/building.py": "by hand",
    "python benchmarks/serve.py": "by hand",
    "pip install 'kaidan[design]'   # scipy, which searches": ".ci/run, within '.[dev]'",
    "pip install 'kaidan[sensitivity]'   # SALib": ".ci/run, within '.[dev]'",
    "pip install 'kaidan[web]'   # FastAPI and uvicorn": ".ci/run, within '.[dev]'",
    "kaidan serve": "tests/unit/web",
    "dask scheduler --port 8786": "test_cluster.py",
    "dask worker tcp://10.0.0.1:8786 --nworkers auto --nthreads 1": "test_cluster.py",
    "kaidan lab experiment kenaf --store belt --scheduler tcp://10.0.0.1:8786": "test_cluster.py",
    "python benchmarks/campaign.py": "by hand",
    "python benchmarks/sweep.py": "by hand",
    "python benchmarks/contact.py": "by hand",
    "kaidan lab calibrate compliance --store compliance --figure compliance.svg": "by hand",
    "kaidan lab calibrate yielding --store yielding --figure region.svg": "by hand",
    "kaidan lab calibrate rig.toml": "tests/lab/rig/test_rig_kit.py",
    "kaidan lab calibrate theta-m --store theta-m": "by hand",
    "kaidan lab calibrate engagement --store engagement": "by hand",
    "kaidan lab calibrate grousers --seed 1 --tried 160 --store grousers": "by hand",
    "kaidan lab calibrate effects --trials 2 --step 3deg --store effects --figure effects.svg "
    "--csv effects.csv": "by hand",
    "pytest -m slow -s tests/validation/test_physics_acceptance.py": "by hand",
    "pip install 'kaidan[physics,calibration]'": ".ci/run, within '.[dev]'",
    "pip install 'kaidan[physics]'": ".ci/run, within '.[dev]'",
    "sphinx-build -W -n -b html docs docs/_build/html": "test_site.py",
    "mutmut run --max-children 1   # about four minutes on one core": "by hand",
    "mutmut results": "by hand",
}


NEEDS = {"docs/buildings.md": "ifcopenshell"}
"""Optional packages without which a page is skipped."""


LONG_WORK = [
    Path(f"docs/{name}.md")
    for name in (
        "design",
        "lab/calibration",
        "lab/campaigns",
        "lab/cross_check",
        "lab/experiment",
        "lab/physics",
        "stock",
    )
]
"""Pages whose commands run many trials, or many questions: among the slow tests."""


def case(page: Path) -> object:
    """A page as a case of a test."""
    return pytest.param(page, marks=pytest.mark.slow if page in LONG_WORK else ())


class Fence(NamedTuple):
    language: str
    line: int
    text: str


def fences(page: Path) -> list[Fence]:
    tokens = MarkdownIt().parse((ROOT / page).read_text(encoding="utf-8"))
    return [
        Fence(token.info.split()[0] if token.info else "", token.map[0] + 1, token.content)
        for token in tokens
        if token.type == "fence" and token.map
    ]


def commands(text: str) -> Iterator[tuple[str, list[str]]]:
    """Commands of a console block with the lines of output that are shown."""
    command, output = "", []
    for line in text.splitlines():
        if line.startswith("$ "):
            if command:
                yield command, output
            command, output = line.removeprefix("$ "), []
        elif command.endswith("\\") and line.startswith("> "):
            command = command[:-1] + line.removeprefix("> ")
        else:
            assert command, f"output before the first command: {line!r}"
            output.append(line.rstrip())
    if command:
        yield command, output


LONG = re.compile(r"-?\d+\.\d{6,}(?:e-?\d+)?")
"""A number with all its digits, of which the last ones are the machine's."""


SIZE = re.compile(r" \((?:\d+ x \d+ pixels, )?\d+ kB\)$")
"""Size of a file that was written, which hangs on the version of matplotlib."""


def same(shown: str, printed: str) -> bool:
    """Whether a line is as shown, long numbers to 1e-9: rounding differs between C libraries."""
    shown, printed = (SIZE.sub("", line) for line in (shown, printed))
    if LONG.sub("#", shown) != LONG.sub("#", printed):
        return False
    pairs = zip(LONG.findall(shown), LONG.findall(printed), strict=True)
    return all(math.isclose(float(x), float(y), rel_tol=1e-9) for x, y in pairs)


PROGRESS = re.compile(r"kaidan: \d+ of \d+ .* left$")
"""What long work says on standard error while it runs."""


def matches(shown: list[str], printed: list[str]) -> bool:
    """Whether lines are as shown, ``...`` standing for any number of lines."""
    if "..." in shown:
        at = shown.index("...")
        head, rest = shown[:at], shown[at + 1 :]
        return matches(head, printed[:at]) and any(
            matches(rest, printed[skip:]) for skip in range(at, len(printed) + 1)
        )
    return len(shown) == len(printed) and all(map(same, shown, printed))


def environment() -> dict[str, str]:
    """As on a plain terminal of no particular width, this Python's commands first."""
    kept = {name: value for name, value in os.environ.items() if name != "COLUMNS"}
    folder = str(Path(sys.executable).parent)
    return kept | {
        "PATH": folder + os.pathsep + kept["PATH"],
        "PYTHONIOENCODING": "utf-8",
        "KAIDAN_DOCS": str(ROOT / "docs"),
    }


IMPORTS = ast.Import | ast.ImportFrom
ENDS = {2, *(each.exit_code for each in Verdict)}
"""Exit codes that are no fault of kaidan."""

SHELL = re.compile(r"[|<>;&$`*?\\]")
"""What only a shell understands."""


def in_this_process(words: list[str]) -> tuple[int, str]:
    """Exit code of kaidan's command line, and what it prints."""
    printed = io.TextIOWrapper(io.BytesIO(), "utf-8", write_through=True)
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
        code = run(words)
    return code, printed.buffer.getvalue().decode()


def in_a_shell(command: str, folder: Path) -> tuple[int, str]:
    """Exit code of a command of bash, and what it prints."""
    done = subprocess.run(
        ["bash", "-c", command],
        cwd=folder,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
    )
    return done.returncode, done.stdout


def run_console(fence: Fence, folder: Path, *, as_processes: bool) -> None:
    code = 0
    for command, shown in commands(fence.text):
        if command == "echo $?":
            assert shown == [str(code)], f"line {fence.line}: exit code {code}"
            code = 0
            continue
        assert code != 2, f"line {fence.line}: the command before {command!r} is refused"
        if as_processes or SHELL.search(command) or not command.startswith("kaidan "):
            code, text = in_a_shell(command, folder)
        else:
            code, text = in_this_process(shlex.split(command)[1:])
        lines = (line.rstrip() for line in text.splitlines())
        printed = [line for line in lines if not PROGRESS.match(line)]
        while shown and not shown[-1]:
            shown.pop()
        while printed and not printed[-1]:
            printed.pop()
        if shown:
            assert matches(shown, printed), (
                f"line {fence.line}: {command}\n--- shown\n"
                + "\n".join(shown)
                + "\n--- printed\n"
                + "\n".join(printed)
            )
        assert code in ENDS, f"line {fence.line}: {command}\n{text}"
    assert code != 2, f"line {fence.line}: the last command is refused, and no echo $? says so"


def run_doctest(fence: Fence, page: Path, names: dict[str, object]) -> None:
    test = doctest.DocTestParser().get_doctest(
        fence.text, names, f"{page}:{fence.line}", str(page), fence.line
    )
    told = io.StringIO()
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS, verbose=False)
    runner.run(test, out=told.write, clear_globs=False)
    names.update(test.globs)
    assert runner.failures == 0, told.getvalue()


@pytest.mark.parametrize("page", [case(page) for page in PAGES], ids=str)
def test_blocks_of_a_page_do_what_they_show(page, tmp_path, monkeypatch):
    if str(page) in NEEDS:
        pytest.importorskip(NEEDS[str(page)], reason=f"skipped: {NEEDS[str(page)]} not installed")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("KAIDAN_DOCS", str(ROOT / "docs"))
    each_once(monkeypatch)  # many pages show the same answer
    names: dict[str, object] = {"__name__": "__main__"}
    for fence in fences(page):
        if fence.language == "pycon":
            run_doctest(fence, page, names)
        elif fence.language == "python":
            with contextlib.redirect_stdout(io.StringIO()):
                exec(compile(fence.text, f"{page}:{fence.line}", "exec"), names)
        elif fence.language == "console":
            run_console(fence, tmp_path, as_processes=page.name == "README.md")
        elif fence.language == "sh":
            for line in fence.text.splitlines():
                assert line in ELSEWHERE or line in ci_lines(), f"{page}:{fence.line}: {line}"
        else:
            directive = fence.language.startswith("{")
            assert fence.language in SILENT or directive, f"{page}:{fence.line}: {fence.language}"


@pytest.mark.parametrize("page", LONG_WORK, ids=str)
def test_blocks_of_long_work_are_spelled_as_kaidan_reads_them(page):
    """Every run looks at this much: commands, options and imports exist, their Python compiles."""
    found = 0
    for fence in fences(page):
        where = f"{page}:{fence.line}"
        if fence.language == "console":
            lines = [command for command, _ in commands(fence.text)]
        elif fence.language == "sh":
            lines = fence.text.replace("\\\n", " ").splitlines()
        else:
            lines = []
        for line in lines:
            for words in commands_of_kaidan(line):
                code, text = in_this_process([*words, "--help"])  # options are read before
                assert code == 0, f"{where}: {line}\n{text}"
                found += 1
        if fence.language in ("python", "pycon"):
            examples = doctest.DocTestParser().get_examples(fence.text)
            sources = [each.source for each in examples] or [fence.text]
            for source in sources:
                compile(source, where, "exec")
                body = [x for x in ast.parse(source).body if isinstance(x, IMPORTS)]
                exec(compile(ast.Module(body, []), where, "exec"), {})
                found += 1
    assert found


def commands_of_kaidan(line: str) -> Iterator[list[str]]:
    """Words after ``kaidan`` of each of its commands in a line for a shell."""
    lexer = shlex.shlex(line, posix=True, punctuation_chars="|&;<>")
    lexer.commenters = "#"
    lexer.whitespace_split = True
    words: list[str] = []
    for word in [*lexer, ";"]:
        if set(word) <= set("|&;<>"):
            if "kaidan" in words[:1]:
                yield words[1:]
            words = []
        else:
            words.append(word)


def ci_lines() -> list[str]:
    """The two lines of the README that .ci/run executes."""
    lines = (ROOT / "README.md").read_text(encoding="utf-8").splitlines()
    marked = [lines.index(f"<!-- ci: {name} -->") for name in ("run", "test")]
    for at in marked:
        assert lines[at + 1] == "```sh"
        assert lines[at + 3] == "```", "one command line each"
    return [lines[at + 2] for at in marked]


def test_the_readme_has_one_line_to_run_and_one_to_test():
    run, test = ci_lines()
    assert "kaidan assess" in run
    assert "pytest" in test


def test_the_readme_shows_what_its_line_prints():
    """The block after the line, which .ci/run prints too."""
    run, _ = ci_lines()
    shown = [fence.text for fence in fences(Path("README.md")) if fence.language == "console"]
    assert any(f"$ {run.split(' && ')[-1]}\n" in text for text in shown)


def test_no_block_is_left_out_by_its_language():
    found = {fence.language for page in PAGES for fence in fences(page)}
    assert found >= KNOWN - {"python"}


def test_matching_lines():
    assert matches(["a", "...", "c"], ["a", "b", "b", "c"])
    assert matches(["...", "c"], ["c"])
    assert not matches(["a"], ["a", "b"])
    assert not matches(["a", "..."], ["b"])
    assert matches(["1.1999999999999997"], ["1.2000000000000002"])
    assert not matches(["1.2"], ["1.3"])
