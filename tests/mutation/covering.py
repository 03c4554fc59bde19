"""Which tests run which lines of the analysis packages, and how long each test takes.

Recorded once by coverage.py with one context per test; times are the processor's, so that a busy machine does not
change them. What the package and the tests keep from one test for the next (traced programs, cached results) is
forgotten before each test, so that every test shows all that it uses.
"""

from __future__ import annotations

import ast
import hashlib
import json
import os
import subprocess
import sys
import tempfile
from collections import OrderedDict
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "src" / "linkwright"
#: Tests of the tests, of speed, and of other processes: they say nothing about a changed line, or too slowly.
LEFT_OUT = ("tests/contract/test_benchmarks_run.py", "tests/cli/test_process.py", "tests/cli/test_start.py")


@dataclass
class Covering:
    """`tests` by place ``path:line`` (path below the package), seconds by test, files by place."""

    tests: dict[str, list[str]] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)

    def of(self, path: str, lines: range) -> list[str]:
        """Tests that run one of the lines, or, for what importing runs, any line of the module."""
        places = {compiled_at(path).get(line, line) for line in lines}
        found = {test for line in places for test in self.tests.get(f"{path}:{line}", ())}
        if found == {""} or not within_functions(path).intersection(lines):
            found = {t for place, tests in self.tests.items() if place.startswith(f"{path}:") for t in tests}
        return sorted(found - {""})

    def by_promise(self, tests: list[str], seconds: float, module: str = "") -> list[str]:
        """The tests, from each file its quickest in turn, as many as fit into the time.

        Files named for the ``module`` come first, with all their tests. Behind them the others of the same files,
        which may share a fixture with them.
        """
        own, chosen = set(tests), []
        files = {test.split("::")[0] for test in tests}
        rest = [t for t in self.seconds if t not in own and t.split("::")[0] in files]
        for group in (tests, rest):
            ranks: dict[str, int] = {}
            ranked = []
            for test in sorted(group, key=lambda t: self.seconds.get(t, 1.0)):
                file = test.split("::")[0]
                ranks[file] = ranks.get(file, 0) + 1
                named = bool(module) and module in file
                ranked.append((0 if named else ranks[file], self.seconds.get(test, 1.0), test))
            chosen += [(cost, test) for _, cost, test in sorted(ranked)]
        kept, left = [], seconds
        for cost, test in chosen:
            if cost <= left:
                kept.append(test)
                left -= cost
        return kept


@cache
def within_functions(path: str) -> set[int]:
    """Lines of a module that run when a function is called, not when the module is imported."""
    tree = ast.parse((SOURCE / path).read_text("utf-8"))
    functions = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]
    return {k for each in functions for k in range(each.body[0].lineno, (each.end_lineno or 0) + 1)}


@cache
def compiled_at(path: str) -> dict[int, int]:
    """Lines of functions whose source is compiled, with the line that has it compiled: nothing else shows that they
    run."""
    tree = ast.parse((SOURCE / path).read_text("utf-8"))
    calls = [
        each for each in ast.walk(tree) if isinstance(each, ast.Call) and ast.unparse(each.func) == "Kernels"
    ]
    given = {each.id: call.lineno for call in calls for each in ast.walk(call) if isinstance(each, ast.Name)}
    functions = [each for each in ast.walk(tree) if isinstance(each, ast.FunctionDef) and each.name in given]
    return {
        k: given[each.name]
        for each in functions
        for k in range(each.body[0].lineno, (each.end_lineno or 0) + 1)
    }


class Recorder:
    """A pytest plugin: one context of coverage per test."""

    def __init__(self, coverage: Any) -> None:
        self.coverage = coverage
        self.seconds: dict[str, float] = {}
        self.failed: set[str] = set()

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Any:
        forget()
        began = sum(os.times()[:4])
        self.coverage.switch_context(item.nodeid)
        try:
            return (yield)
        finally:
            self.coverage.switch_context("")
            if item.nodeid not in self.failed:
                self.seconds[item.nodeid] = sum(os.times()[:4]) - began

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed:
            self.failed.add(report.nodeid)


def forget() -> None:
    """Empty what modules of the package and of the tests keep."""
    for name, module in list(sys.modules.items()):
        if not name.startswith(("linkwright", "tests.")):
            continue
        for key, value in list(vars(module).items()):
            if hasattr(value, "cache_clear") and getattr(value, "__module__", name) == name:
                value.cache_clear()
            kept = getattr(value, "_kept", value if key == "_kept" else None)
            if isinstance(kept, OrderedDict):
                kept.clear()


def record(target: Path, file: str) -> None:
    """Run one test file under coverage and write the result; called in a process of its own."""
    import coverage

    tool = coverage.Coverage(data_file=None, source=[str(SOURCE)], messages=False)
    recorder = Recorder(tool)
    tool.start()
    pytest.main(["-q", "-p", "no:cacheprovider", file], plugins=[recorder])
    tool.stop()
    data = tool.get_data()
    tests: dict[str, list[str]] = {}
    for path in data.measured_files():
        below = Path(path).relative_to(SOURCE).as_posix()
        for line, contexts in data.contexts_by_lineno(path).items():
            tests[f"{below}:{line}"] = sorted(contexts)
    target.write_text(json.dumps({"tests": tests, "seconds": recorder.seconds}), "utf-8")


def fingerprint(*folders: str) -> str:
    """Of the package's sources, and of tests where asked for."""
    digest = hashlib.sha256()
    for root in (SOURCE, *(ROOT / folder for folder in folders)):
        for path in sorted(root.rglob("*.py")) if root.is_dir() else [root]:
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def covering(folder: Path, workers: int, *, keep: bool = False) -> Covering:
    """Records of all test files, kept in `folder`; made anew where sources or the file have changed.

    keep: take what is there as it is.
    """
    files = [str(p.relative_to(ROOT)) for p in sorted((ROOT / "tests").rglob("test_*.py"))]
    parts = {
        file: folder / file.replace("/", "-").replace(".py", ".json")
        for file in files
        if file not in LEFT_OUT
    }
    folder.mkdir(parents=True, exist_ok=True)
    if not keep:
        with ThreadPoolExecutor(workers) as pool, tempfile.TemporaryDirectory() as cache:
            for k, _ in enumerate(pool.map(lambda item: _recorded(*item, cache), parts.items()), 1):
                print(
                    f"\rwhich tests run which lines: {k}/{len(parts)} ", end="", file=sys.stderr, flush=True
                )
    found = Covering()
    for part in parts.values():
        if part.exists():
            values = json.loads(part.read_text("utf-8"))
            for place, names in values["tests"].items():
                found.tests.setdefault(place, []).extend(names)
            found.seconds |= values["seconds"]
    return found


def _recorded(file: str, part: Path, cache: str) -> None:
    mark, known = fingerprint(file), part.with_suffix(".mark")
    if part.exists() and known.exists() and known.read_text() == mark:
        return
    part.unlink(missing_ok=True)
    path = os.pathsep.join([str(SOURCE.parent), *os.environ.get("PYTHONPATH", "").split(os.pathsep)])
    surroundings = {**os.environ, "LINKWRIGHT_CACHE": cache, "PYTHONPATH": path}
    command = [sys.executable, "-m", "tests.mutation.covering", str(part), file]
    subprocess.run(command, cwd=ROOT, env=surroundings, stdout=subprocess.DEVNULL, check=False)
    known.write_text(mark)


if __name__ == "__main__":
    record(Path(sys.argv[1]), sys.argv[2])
