"""A plugin of pytest that notes which tests reach the places of some mutants: ``-p tests.mutation.probes``.

Before the statement of each mutant, and at the beginning of each function of its module, stands a call that notes the
test that is running; nothing else is slowed down. What the package and the tests keep from one test for the next
(traced programs, solved machines) is forgotten before each test, so that every test shows all that it uses. Times are
the processor's. The environment says which places (`PLAN`) and where the notes go (`NOTES`); each worker has its own.
"""

from __future__ import annotations

import ast
import builtins
import importlib.abc
import importlib.util
import json
import os
import sys
from collections import OrderedDict, defaultdict
from collections.abc import Sequence
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

SOURCE = Path(__file__).resolve().parents[2] / "src" / "linkwright"
PLAN, NOTES = "LINKWRIGHT_PROBES", "LINKWRIGHT_PROBE_NOTES"
CALL = "__linkwright_reached__"


class Probed(ast.NodeTransformer):
    """Puts calls before the innermost statements that hold the lines, and into all functions."""

    def __init__(self, path: str, places: Sequence[tuple[int, int]]) -> None:
        self.path, self.places = path, places

    def generic_visit(self, node: ast.AST) -> ast.AST:
        super().generic_visit(node)
        for name in ("body", "orelse", "finalbody"):
            statements = getattr(node, name, None)
            if isinstance(statements, list) and not isinstance(node, ast.Module):
                setattr(node, name, [each for own in statements for each in (*self._calls(own), own)])
        if isinstance(node, ast.FunctionDef):
            kept = 1 if ast.get_docstring(node, clean=False) is not None else 0
            node.body[kept:kept] = [_call(self.path, node.body[0])]
        return node

    def _calls(self, statement: ast.stmt) -> list[ast.stmt]:
        """Of the lines that are this statement's and of none within it."""
        lines = set(range(statement.lineno, (statement.end_lineno or 0) + 1))
        for name in ("body", "orelse", "finalbody", "handlers", "cases"):
            for inner in getattr(statement, name, ()):
                first = inner.pattern.lineno if isinstance(inner, ast.match_case) else inner.lineno
                last = max((getattr(n, "end_lineno", 0) or 0 for n in ast.walk(inner)), default=first)
                lines -= set(range(first, last + 1))
        reached = [f"{self.path}:{a}-{b}" for a, b in self.places if lines & set(range(a, b + 1))]
        return [_call(each, statement) for each in reached]


def _call(what: str, beside: ast.stmt) -> ast.stmt:
    call = ast.Expr(ast.Call(ast.Name(CALL, ast.Load()), [ast.Constant(what)], []))
    return ast.copy_location(call, beside)


class _Probing(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Finds the modules of the plan with their calls."""

    def __init__(self, plan: dict[str, list[tuple[int, int]]]) -> None:
        self.plan = plan

    def find_spec(self, name: str, path: object = None, target: object = None) -> ModuleSpec | None:
        if name.split(".", maxsplit=1)[0] != "linkwright":
            return None
        file = SOURCE.parent.joinpath(*name.split("."))
        found = file / "__init__.py" if file.is_dir() else file.with_suffix(".py")
        if found.relative_to(SOURCE).as_posix() not in self.plan:
            return None
        package = [str(file)] if file.is_dir() else None
        return importlib.util.spec_from_file_location(name, found, loader=self, submodule_search_locations=package)

    def create_module(self, spec: ModuleSpec) -> None:
        return None

    def exec_module(self, module: ModuleType) -> None:
        file = Path(str(module.__file__))
        path = file.relative_to(SOURCE).as_posix()
        tree = Probed(path, self.plan[path]).visit(ast.parse(file.read_text("utf-8")))
        exec(compile(ast.fix_missing_locations(tree), str(file), "exec"), module.__dict__)


class Notes:
    """Which tests reach what, and how long each takes."""

    def __init__(self) -> None:
        self.reached: dict[str, set[str]] = defaultdict(set)
        self.seconds: dict[str, float] = {}
        self.failed: set[str] = set()
        self.test = ""

    def reach(self, what: str) -> None:
        self.reached[what].add(self.test)

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Any:
        forget()
        self.test, began = item.nodeid, sum(os.times()[:4])
        try:
            return (yield)
        finally:
            self.test = ""
            if item.nodeid not in self.failed:
                self.seconds[item.nodeid] = sum(os.times()[:4]) - began

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed:
            self.failed.add(report.nodeid)

    def pytest_sessionfinish(self) -> None:
        part = Path(os.environ[NOTES], f"{os.environ.get('PYTEST_XDIST_WORKER', 'main')}.json")
        reached = {what: sorted(tests & set(self.seconds)) for what, tests in self.reached.items()}
        part.write_text(json.dumps({"reached": reached, "seconds": self.seconds}), "utf-8")


def forget() -> None:
    """Empty what modules of the package and of the tests keep."""
    for name, module in list(sys.modules.items()):
        if not name.startswith(("linkwright", "tests.")):
            continue
        for key, value in list(vars(module).items()):
            if hasattr(value, "cache_clear") and getattr(value, "__module__", name) == name:
                value.cache_clear()
            kept = getattr(value, "_entries", value if key == "_entries" else None)
            if isinstance(kept, OrderedDict):
                kept.clear()


def pytest_configure(config: pytest.Config) -> None:
    """In every process before the package is imported."""
    if not hasattr(builtins, CALL) and PLAN in os.environ:
        notes = Notes()
        setattr(builtins, CALL, notes.reach)
        sys.meta_path.insert(0, _Probing(json.loads(Path(os.environ[PLAN]).read_text("utf-8"))))
        config.pluginmanager.register(notes)
