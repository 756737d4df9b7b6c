"""Write anew what the console blocks of pages show, by running them: PAGE ...

Lines stand as they are printed. Where a block shows `...`, as many lines are shown before and
after it as there were. Look at the difference before you commit it: the output was right once.
"""

import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "tests" / "docs"), str(ROOT / "tests")]


def main() -> None:
    from test_blocks import commands, fences, in_a_shell, matches

    for page in map(Path, sys.argv[1:]):
        page = page.resolve().relative_to(ROOT)
        text = (ROOT / page).read_text(encoding="utf-8")
        with tempfile.TemporaryDirectory() as folder:
            for fence in fences(page):
                if fence.language != "console":
                    continue
                for command, shown in commands(fence.text):
                    if command == "echo $?":
                        continue
                    _, said = in_a_shell(command, Path(folder))
                    while shown and not shown[-1]:
                        shown.pop()
                    printed = [line.rstrip() for line in said.splitlines()]
                    if not shown or matches(shown, printed):
                        continue
                    told = printed
                    if "..." in shown:
                        at = shown.index("...")
                        tail = len(shown) - at - 1
                        told = [*printed[:at], "...", *(printed[-tail:] if tail else [])]
                    text = replaced(text, fence.text, shown, told)
        (ROOT / page).write_text(text, encoding="utf-8")


def replaced(text: str, block: str, shown: list[str], told: list[str]) -> str:
    """Page with some lines of a block exchanged; blocks within a list are indented."""
    first = block.splitlines()[0]
    line = next(line for line in text.splitlines() if line.strip() == first.strip())
    indent = line[: len(line) - len(line.lstrip())]

    def lines(of: list[str]) -> str:
        return "".join(f"{indent}{each}".rstrip() + "\n" for each in of)

    assert lines(shown) in text, shown[0]
    return text.replace(lines(shown), lines(told))


if __name__ == "__main__":
    main()
