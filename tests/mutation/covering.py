"""Which tests run which lines of the analysis packages, and how long each test takes.

Recorded once by coverage.py with one context per test. What the package and the tests keep from one test for the
next (traced programs, cached results) is forgotten before each test, so that every test shows all that it uses.
"""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
import tempfile
from collections import OrderedDict
from collections.abc import Iterator
from dataclasses import dataclass, field
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
        """Tests that run one of the lines, or, for what only importing runs, any line of the module."""
        found = {test for line in lines for test in self.tests.get(f"{path}:{line}", ())}
        if "" in found and len(found) == 1:
            found = {t for place, tests in self.tests.items() if place.startswith(f"{path}:") for t in tests}
        return sorted(found - {""})

    def by_promise(self, tests: list[str], seconds: float) -> list[str]:
        """The tests, from each file its quickest in turn, as many as fit into the time.

        Behind them the others of the same files, which may share a fixture with them.
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
                ranked.append((ranks[file], self.seconds.get(test, 1.0), test))
            chosen += [(cost, test) for _, cost, test in sorted(ranked)]
        kept, left = [], seconds
        for cost, test in chosen:
            if cost <= left:
                kept.append(test)
                left -= cost
        return kept


class Recorder:
    """A pytest plugin: one context of coverage per test."""

    def __init__(self, coverage: Any) -> None:
        self.coverage = coverage
        self.seconds: dict[str, float] = {}

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Any:
        forget()
        self.coverage.switch_context(item.nodeid)
        try:
            return (yield)
        finally:
            self.coverage.switch_context("")

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if not report.failed:
            self.seconds[report.nodeid] = self.seconds.get(report.nodeid, 0.0) + report.duration


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


def record(target: Path, arguments: list[str]) -> None:
    """Run the tests under coverage and write the result; called in a process of its own."""
    import coverage

    tool = coverage.Coverage(data_file=None, source=[str(SOURCE)], messages=False)
    recorder = Recorder(tool)
    tool.start()
    pytest.main(["-q", "-p", "no:cacheprovider", *arguments], plugins=[recorder])
    tool.stop()
    data = tool.get_data()
    tests: dict[str, list[str]] = {}
    for path in data.measured_files():
        below = Path(path).relative_to(SOURCE).as_posix()
        for line, contexts in data.contexts_by_lineno(path).items():
            tests[f"{below}:{line}"] = sorted(contexts)
    target.write_text(json.dumps({"tests": tests, "seconds": recorder.seconds}), "utf-8")


def fingerprint() -> str:
    digest = hashlib.sha256()
    for path in sources():
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def sources() -> Iterator[Path]:
    yield from sorted(SOURCE.rglob("*.py"))
    yield from sorted(p for p in (ROOT / "tests").rglob("*.py") if "mutation" not in p.parts)


def covering(folder: Path, workers: int, *, keep: bool = False, tests: list[str] | None = None) -> Covering:
    """The record kept in `folder`, made anew where sources have changed (in `workers` processes)."""
    folder.mkdir(parents=True, exist_ok=True)
    mark = fingerprint()
    kept = folder / "covering.json"
    if kept.exists():
        known = json.loads(kept.read_text("utf-8"))
        if keep or known["mark"] == mark:
            return Covering(known["tests"], known["seconds"])
    print("recording which tests run which lines …", file=sys.stderr)
    found = Covering()
    files = tests or [str(p.relative_to(ROOT)) for p in sorted((ROOT / "tests").rglob("test_*.py"))]
    files = [name for name in files if name not in LEFT_OUT]
    parts = [folder / f"part{k}.json" for k in range(workers)]
    with tempfile.TemporaryDirectory() as cache:
        running = [_start(part, files[k::workers], f"{cache}/{k}") for k, part in enumerate(parts)]
        for process in running:
            process.wait()
    for part in parts:
        values = json.loads(part.read_text("utf-8"))
        for place, names in values["tests"].items():
            found.tests[place] = sorted({*found.tests.get(place, ()), *names})
        found.seconds |= values["seconds"]
    kept.write_text(json.dumps({"mark": mark, "tests": found.tests, "seconds": found.seconds}), "utf-8")
    return found


def _start(part: Path, files: list[str], cache: str) -> subprocess.Popen[bytes]:
    part.unlink(missing_ok=True)
    path = os.pathsep.join([str(SOURCE.parent), *os.environ.get("PYTHONPATH", "").split(os.pathsep)])
    surroundings = {**os.environ, "LINKWRIGHT_CACHE": cache, "PYTHONPATH": path}
    command = [sys.executable, "-m", "tests.mutation.covering", str(part), *files]
    return subprocess.Popen(command, cwd=ROOT, env=surroundings, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    record(Path(sys.argv[1]), sys.argv[2:])
