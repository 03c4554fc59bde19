"""One mutant tried: tests run in a forked process in which the changed module takes the place of the right one."""

from __future__ import annotations

import importlib
import importlib.abc
import importlib.util
import linecache
import os
import signal
import sys
import tempfile
import time
import traceback
from collections.abc import Sequence
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType

from tests.mutation.covering import ROOT
from tests.mutation.probes import SOURCE

#: Imported once, before the processes are forked; nothing of the package is among them.
HEAVY = (
    "numpy",
    "scipy.optimize",
    "scipy.interpolate",
    "scipy.stats",
    "scipy.linalg",
    "pytest",
    "llvmlite.binding",
    "yaml",
    "mpmath",
    "matplotlib.figure",
    "pandas",
    "ast",
    "unittest.mock",
)
QUIETLY = (
    "-x",
    "-q",
    "-p",
    "no:cacheprovider",
    "-p",
    "no:xdist",
    "--share",
    "all",
    "-W",
    "ignore::pytest.PytestAssertRewriteWarning",
)
BROKEN = 99  # exit code of a trial that says nothing about the mutant


def preload() -> None:
    for name in HEAVY:
        try:
            importlib.import_module(name)
        except ImportError:
            continue
    if any(name.split(".")[0] == "linkwright" for name in sys.modules):
        raise RuntimeError("the package must not be imported before the mutants are made")


class _Changed(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Finds one module of the package with another text."""

    def __init__(self, path: Path, text: str) -> None:
        self.path, self.text = path, text
        parts = path.relative_to(SOURCE.parent).with_suffix("").parts
        self.name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)

    def find_spec(self, name: str, path: object = None, target: object = None) -> ModuleSpec | None:
        if name != self.name:
            return None
        package = [str(self.path.parent)] if self.path.name == "__init__.py" else None
        return importlib.util.spec_from_file_location(
            name, self.path, loader=self, submodule_search_locations=package
        )

    def create_module(self, spec: ModuleSpec) -> None:
        return None

    def exec_module(self, module: ModuleType) -> None:
        """What reads the source, as kernels that are compiled from it, sees the other text as well."""
        lines = self.text.splitlines(keepends=True)
        linecache.cache[str(self.path)] = len(self.text), None, lines, str(self.path)
        exec(compile(self.text, str(self.path), "exec"), module.__dict__)


def killed(path: str, text: str, tests: Sequence[str], seconds: float) -> tuple[bool, str]:
    """Whether a test fails (or does not end) with the changed text, and which says so."""
    reading, writing = os.pipe()
    process = os.fork()
    if process == 0:
        os.close(reading)
        code = BROKEN
        try:
            code = _child(path, text, tests, writing)
        except BaseException:
            os.write(writing, traceback.format_exc()[-1500:].encode("utf-8"))
        finally:
            os._exit(code)
    os.close(writing)
    code = _waited(process, time.monotonic() + seconds)
    with os.fdopen(reading, "r", encoding="utf-8") as pipe:
        said = pipe.read()
    if code is None:
        return True, "no end in time"
    if code == BROKEN:
        raise RuntimeError(f"the trial itself failed: {said}")
    return code != 0, said.strip()


def _child(path: str, text: str, tests: Sequence[str], writing: int) -> int:
    import pytest

    os.setsid()
    os.chdir(ROOT)
    sys.path.insert(0, str(SOURCE.parent))
    sys.dont_write_bytecode = True
    sys.meta_path.insert(0, _Changed(SOURCE / path, text))
    with tempfile.TemporaryDirectory() as cache:
        os.environ["LINKWRIGHT_CACHE"] = cache
        _silence()
        witness = _Witness()
        code = pytest.main([*QUIETLY, *tests], plugins=[witness])
    os.write(writing, witness.failed.encode("utf-8")[:4000])
    return BROKEN if code and not witness.failed else int(code)


def _silence() -> None:
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    os.dup2(null, 2)


class _Witness:
    failed = ""

    def pytest_runtest_logreport(self, report: object) -> None:
        if getattr(report, "failed", False) and not self.failed:
            self.failed = str(getattr(report, "nodeid", ""))

    def pytest_collectreport(self, report: object) -> None:
        self.pytest_runtest_logreport(report)


def _waited(process: int, deadline: float) -> int | None:
    """Exit code of a child; None where it had to be stopped."""
    while time.monotonic() < deadline:
        done, status = os.waitpid(process, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.01)
    os.killpg(process, signal.SIGKILL)
    os.waitpid(process, 0)
    return None
