"""Mutation run: break the code in one place at a time, and see whether a test notices.

mutmut leaves decorated functions out, which is every function of the contact kernel, and starts
a process a mutant. Here the tests are collected once; each mutant is a fork in which the code of
one function is exchanged, and only the tests that pass over its line are run, the fastest first.
A test that fails in such a fork though nothing is changed is named and left out.

Example (see docs/mutation.md)::

    python benchmarks/mutation.py --of src/kaidan/contact/kernel/gaps.py --out gaps.jsonl \\
        -- tests/unit/contact -m "not slow"
"""

import argparse
import gc
import importlib
import json
import os
import resource
import signal
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import asdict
from functools import _lru_cache_wrapper, partial
from pathlib import Path
from types import CodeType, FrameType, FunctionType
from typing import Any

import pytest

from mutants import HANGS, KILLED, SURVIVES, UNTESTED, Mutant, answers, mutants

LEAST_LIMIT = 1.0
"""CPU time that a test may take at least before a mutant counts as one that hangs [s]."""
SLOWER = 8.0
"""A mutant may hang if a test takes this many times its usual CPU time."""
PATIENCE = 5.0
"""It hangs if that test, alone, takes so many times as long still."""
MEMORY = 4 << 30
"""Address space of a mutant beyond what the tests have taken already [B]: of many modules that is
gigabytes, and a limit on all of it would end mutants that nothing notices."""
OFF = [part for name in ("cacheprovider", "xdist", "faulthandler") for part in ("-p", f"no:{name}")]
"""Plugins that are of no use here; the last would tell of each mutant that ends its process."""


def load(path: Path) -> None:
    """Import a module of ``src`` that no test has imported yet."""
    parts = path.with_suffix("").parts
    first = len(parts) - parts[::-1].index("src")
    importlib.import_module(".".join(parts[first:]).removesuffix(".__init__"))


def live(path: Path) -> dict[str, list[FunctionType]]:
    """Functions of a file that this process holds."""
    gc.unfreeze()  # what the tests have set aside
    held: dict[str, list[FunctionType]] = {}
    for each in gc.get_objects():
        if type(each) is FunctionType and each.__code__.co_filename == str(path):
            held.setdefault(each.__code__.co_qualname, []).append(each)
    return held


def caches() -> list[_lru_cache_wrapper]:
    """Functions that remember their answers, but for those that are frozen."""
    # isinstance would look through a weak proxy, whose object may be gone
    return [each for each in gc.get_objects() if type(each) is _lru_cache_wrapper]


def all_caches() -> list[_lru_cache_wrapper]:
    """Those that are frozen too; all that there is by now is frozen."""
    gc.unfreeze()
    held = caches()
    gc.freeze()
    return held


def empty(held: list[_lru_cache_wrapper]) -> None:
    """Let functions forget what they remember."""
    for each in held:
        each.cache_clear()


def taken() -> int:
    """Address space of this process [B]."""
    pages = int(Path("/proc/self/statm").read_text().split()[0])
    return pages * resource.getpagesize()


class Lines:
    """Lines of some files over which one test passes."""

    def __init__(self, paths: list[Path]) -> None:
        self.paths = {str(path) for path in paths}
        self.seen: set[tuple[str, int]] = set()
        self.done: Counter[CodeType] = Counter()

    def call(self, frame: FrameType, event: str, argument: object) -> object:
        if frame.f_code.co_filename not in self.paths or self.done[frame.f_code] > 100_000:
            return None
        return self.line

    def line(self, frame: FrameType, event: str, argument: object) -> object:
        if event == "line":
            at = (frame.f_code.co_filename, frame.f_lineno)
            if at in self.seen:
                self.done[frame.f_code] += 1
            else:
                self.seen.add(at)
                self.done[frame.f_code] = 0
        return self.line


class ExchangedMutants:
    """Mutants of some files, each with the code of one function exchanged in this process."""

    def __init__(self, paths: list[Path]) -> None:
        self.paths = paths

    def of_file(self, path: Path) -> Iterator[tuple[Mutant, object, Callable[[], None]]]:
        """Each mutant of a file, its line, and what makes this process run it."""
        load(path)
        held = live(path)
        for mutant, code in mutants(path):
            change = partial(exchange, held[mutant.function], code)
            yield mutant, f"{path}:{mutant.line}", change

    def reached(self, ask: Callable[[], object]) -> list[object]:
        """Lines that are passed over."""
        lines = Lines(self.paths)
        sys.settrace(lines.call)
        ask()
        sys.settrace(None)
        return [f"{file}:{line}" for file, line in lines.seen]


def exchange(held: list[FunctionType], code: CodeType) -> None:
    """Give functions another code."""
    for each in held:
        each.__code__ = code.replace(co_freevars=each.__code__.co_freevars)


class Run:
    """Pytest plugin that runs mutants in place of the tests."""

    def __init__(self, chosen: argparse.Namespace) -> None:
        self.paths = [path.resolve() for path in chosen.of]
        self.out, self.only, self.longest = chosen.out, chosen.only, chosen.longest
        self.sample = chosen.sample
        self.again = None
        if chosen.again is not None:
            self.again = {each.key for each in answers(chosen.again) if each.lives}
        self.mutants = ExchangedMutants(self.paths)
        self.failed = False

    def pytest_configure(self) -> None:
        from hypothesis import settings  # not before pytest, which rewrites it

        settings.register_profile("mutation", derandomize=True, database=None, deadline=None)
        settings.load_profile("mutation")

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        self.failed |= report.failed

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        items = session.items
        usual = self._baseline(items)
        done = {each.key for each in answers(self.out)}
        counts: Counter[str] = Counter()
        last: dict[str, int] = {}
        killers: set[int] = set()
        for path in self.paths:
            every = self._sampled(list(self.mutants.of_file(path)))
            empty(all_caches())  # answers of the unchanged code, worked out by an import
            for mutant, at, change in every:
                if mutant.key in done or self.only not in mutant.function:
                    continue
                if self.again is not None and mutant.key not in self.again:
                    continue
                chosen = [k for k, (_, reached) in usual.items() if at in reached]
                chosen.sort(key=lambda k: (k != last.get(mutant.function), usual[k][0]))
                mutant.outcome = UNTESTED
                if chosen:
                    mutant.outcome, killer = self._noticed(change, items, chosen, usual)
                    if killer is not None:
                        mutant.by, last[mutant.function] = items[killer].nodeid, killer
                        killers.add(killer)
                counts[mutant.outcome] += 1
                with self.out.open("a") as file:
                    file.write(json.dumps(asdict(mutant)) + "\n")
                if mutant.lives:
                    print(f"{mutant.outcome}: {mutant.file}:{mutant.line} {mutant.function}: "
                          f"{mutant.before}  ->  {mutant.after}", flush=True)  # fmt: skip
        for k in self._failing(killers, items, usual):
            print(f"fails by now on unchanged code, what it killed is void: {items[k].nodeid}")
        print(dict(counts))
        return True

    def _sampled(self, every: list[Any]) -> list[Any]:
        """As many mutants as asked for, spread evenly over the file; all if none are asked for."""
        count = min(self.sample or len(every), len(every))
        print(f"{count} of {len(every)} mutants", flush=True)
        return [every[k * len(every) // count] for k in range(count)]

    def _baseline(self, items: list[pytest.Item]) -> dict[int, tuple[float, set[object]]]:
        """Time of each test and what it reaches, in a fork so that no cache is filled."""
        read, write = os.pipe()
        if os.fork() == 0:
            os.close(read)
            self._quiet()
            usual: dict[int, tuple[float, list[object]]] = {}
            held = all_caches()
            for k, item in enumerate(items):
                start = time.process_time()
                failed = self._ask(item)
                took = time.process_time() - start
                if failed or took > self.longest:
                    continue
                empty([*held, *caches()])  # so that all of it is passed again
                reached = self.mutants.reached(partial(self._ask, item))
                if reached:
                    usual[k] = (took, reached)
            with os.fdopen(write, "w") as pipe:
                json.dump(usual, pipe)
            os._exit(0)
        os.close(write)
        with os.fdopen(read) as pipe:
            usual = {int(k): (took, set(each)) for k, (took, each) in json.load(pipe).items()}
        os.wait()
        for k in self._failing(usual, items, usual):
            print(f"left out, as it fails alone on unchanged code: {items[k].nodeid}")
            del usual[k]
        total = sum(each[0] for each in usual.values())
        print(
            f"{len(items)} tests, {len(usual)} that pass over the code, {total:.1f} s", flush=True
        )
        return usual

    def _failing(
        self, some: Iterable[int], items: list[pytest.Item],
        usual: dict[int, tuple[float, set[object]]],
    ) -> list[int]:  # fmt: skip
        """Those of some tests that fail alone on unchanged code."""
        return [k for k in some if self._try(lambda: None, items, [k], usual)[0] != SURVIVES]

    def _ask(self, item: pytest.Item) -> bool:
        """Whether a test fails."""
        self.failed = False
        item.config.hook.pytest_runtest_protocol(item=item, nextitem=None)
        return self.failed

    def _quiet(self) -> None:
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, 1)
        os.dup2(null, 2)

    def _noticed(
        self, change: Callable[[], None], items: list[pytest.Item], chosen: list[int],
        usual: dict[int, tuple[float, set[object]]],
    ) -> tuple[str, int | None]:  # fmt: skip
        """Outcome of a mutant and the test that notices it alone, where no test ran before it."""
        while True:
            outcome, killer = self._try(change, items, chosen, usual)
            if outcome == HANGS or killer not in (None, chosen[0]):
                assert killer is not None
                outcome, _ = self._try(change, items, [killer], usual, PATIENCE)
            if killer is None or outcome != SURVIVES:
                return outcome, killer
            chosen = [each for each in chosen if each != killer]  # another test left something

    def _try(
        self, change: Callable[[], None], items: list[pytest.Item], chosen: list[int],
        usual: dict[int, tuple[float, set[object]]], patience: float = 1.0,
    ) -> tuple[str, int | None]:  # fmt: skip
        """Outcome of a mutant, in a fork, and the test that notices it."""
        read, write = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(read)
            os.setsid()
            self._quiet()
            room = taken() + MEMORY
            resource.setrlimit(resource.RLIMIT_AS, (room, room))
            change()
            for at in chosen:
                os.write(write, f"{at} ".encode())
                limit = patience * max(LEAST_LIMIT, SLOWER * usual[at][0])
                signal.setitimer(signal.ITIMER_VIRTUAL, limit)
                if self._ask(items[at]):
                    os._exit(1)
            os._exit(0)
        os.close(write)
        with os.fdopen(read) as pipe:
            tried = pipe.read().split()
        _, status = os.waitpid(child, 0)
        if status == 0:
            return SURVIVES, None
        # whatever else ends it: the process itself did not survive
        hangs = os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGVTALRM
        return HANGS if hangs else KILLED, int(tried[-1])


def main() -> None:
    split = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--of", nargs="+", type=Path, required=True, help="files to change")
    arguments.add_argument(
        "--out", type=Path, required=True, help="answers, JSON a line; continued"
    )
    arguments.add_argument("--only", default="", help="functions whose name holds this")
    arguments.add_argument("--again", type=Path, help="only what survives in this file of answers")
    arguments.add_argument("--sample", type=int, help="only so many mutants of a file [all]")
    arguments.add_argument(
        "--longest", type=float, default=60.0, help="leave out tests that take longer [s]"
    )
    arguments.add_argument(
        "--native", action="store_true", help="on the native kernel: for code outside it"
    )
    chosen = arguments.parse_args(sys.argv[1:split])
    os.environ["KAIDAN_KERNEL"] = "native" if chosen.native else "plain"
    tests = sys.argv[split + 1 :]
    pytest.main(["-q", "-s", *OFF, *tests], plugins=[Run(chosen)])


if __name__ == "__main__":
    main()
