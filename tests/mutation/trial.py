"""One mutant tried: tests run in a forked process in which the changed module takes the place of the right one."""

from __future__ import annotations

import importlib
import importlib.abc
import importlib.util
import io
import os
import signal
import sys
import tempfile
import time
from collections.abc import Sequence
from contextlib import redirect_stderr, redirect_stdout
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType

from tests.mutation.covering import ROOT, SOURCE

#: Imported once, before the processes are forked; nothing of the package is among them.
HEAVY = (
    "numpy", "scipy.optimize", "scipy.interpolate", "scipy.stats", "scipy.linalg", "pytest",
    "hypothesis", "llvmlite.binding", "ruamel.yaml", "mpmath", "matplotlib.figure", "pandas", "ast", "unittest.mock",
)  # fmt: skip


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
        exec(compile(self.text, str(self.path), "exec"), module.__dict__)


def killed(path: str, text: str, tests: Sequence[str], seconds: float) -> tuple[bool, str]:
    """Whether a test fails (or does not end) with the changed text, and which says so."""
    reading, writing = os.pipe()
    process = os.fork()
    if process == 0:
        os.close(reading)
        code = 1
        try:
            code = _child(path, text, tests, writing)
        finally:
            os._exit(code)
    os.close(writing)
    code = _waited(process, time.monotonic() + seconds)
    with os.fdopen(reading, "r", encoding="utf-8") as pipe:
        said = pipe.read()
    if code is None:
        return True, "no end in time"
    return code != 0, said.strip() or f"exit code {code}"


def _child(path: str, text: str, tests: Sequence[str], writing: int) -> int:
    import pytest

    os.setsid()
    os.chdir(ROOT)
    sys.path.insert(0, str(SOURCE.parent))
    sys.dont_write_bytecode = True
    sys.meta_path.insert(0, _Changed(SOURCE / path, text))
    with tempfile.TemporaryDirectory() as cache:
        os.environ["LINKWRIGHT_CACHE"] = cache
        said = io.StringIO()
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, 1)
        os.dup2(null, 2)
        witness = _Witness()
        with redirect_stdout(said), redirect_stderr(said):
            code = pytest.main(
                ["-x", "-q", "-p", "no:cacheprovider", "-p", "no:xdist", "--no-header", "--tb=no", *tests],
                plugins=[witness],
            )
    os.write(writing, (witness.failed or said.getvalue()[-200:] if code else "").encode("utf-8")[:4000])
    return int(code)


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
