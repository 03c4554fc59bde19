"""Which tests reach the places of some mutants, and how long each takes: recorded once by `probes.py`."""

from __future__ import annotations

import ast
import hashlib
import json
import os
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from tests.mutation.mutate import Mutant
from tests.mutation.probes import NOTES, PLAN, SOURCE

ROOT = Path(__file__).resolve().parents[2]
#: Tests of the tests, of speed, of other processes and of browsers: they say nothing about a changed line, or too
#: slowly.
LEFT_OUT = (
    "tests/contract/test_benchmarks_run.py",
    "tests/cli/test_process.py",
    "tests/cli/test_start.py",
    "tests/ui",
)


@dataclass
class Covering:
    """`reached`: tests by place ``path:first-last`` (path below the package), and by path of all that run any of its
    functions; `seconds` by test."""

    reached: dict[str, set[str]] = field(default_factory=lambda: defaultdict(set))
    seconds: dict[str, float] = field(default_factory=dict)

    def of(self, mutant: Mutant) -> list[str]:
        """Tests that reach the mutant's statement, or, for what importing runs, any function of the module."""
        lines = range(mutant.lines[0], mutant.lines[1] + 1)
        if not within_functions(mutant.path).intersection(lines):
            return sorted(self.reached.get(mutant.path, ()))
        return sorted(self.reached.get(place(mutant), ()))

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


def place(mutant: Mutant) -> str:
    """What is noted where a mutant's statement is reached; of a compiled function, where it is compiled."""
    first, last = probed(mutant)
    return f"{mutant.path}:{first}-{last}"


def probed(mutant: Mutant) -> tuple[int, int]:
    """The lines that show that a mutant runs."""
    first, last = mutant.lines
    line = compiled_at(mutant.path).get(first)
    return (first, last) if line is None else (line, line)


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
    calls = [each for each in ast.walk(tree) if isinstance(each, ast.Call) and ast.unparse(each.func) == "Kernels"]
    given = {each.id: call.lineno for call in calls for each in ast.walk(call) if isinstance(each, ast.Name)}
    functions = [each for each in ast.walk(tree) if isinstance(each, ast.FunctionDef) and each.name in given]
    return {k: given[each.name] for each in functions for k in range(each.body[0].lineno, (each.end_lineno or 0) + 1)}


def fingerprint(*folders: str) -> str:
    """Of the package's sources, and of tests where asked for."""
    digest = hashlib.sha256()
    for root in (SOURCE, *(ROOT / folder for folder in folders)):
        for path in sorted(root.rglob("*.py")) if root.is_dir() else [root]:
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def covering(folder: Path, mutants: Iterable[Mutant], workers: int) -> Covering:
    """What a run of all tests shows of these mutants, kept in `folder` for the same sources and mutants."""
    plan: dict[str, list[tuple[int, int]]] = defaultdict(list)
    for mutant in mutants:
        plan[mutant.path].append(probed(mutant))
    said = json.dumps(plan, sort_keys=True)
    notes = folder / f"{fingerprint('tests')}-{hashlib.sha256(said.encode()).hexdigest()[:16]}"
    if not any(notes.glob("*.json")):
        notes.mkdir(parents=True, exist_ok=True)
        _record(notes, said, workers)
    found = Covering()
    for part in notes.glob("*.json"):
        values = json.loads(part.read_text("utf-8"))
        for what, tests in values["reached"].items():
            found.reached[what] |= set(tests)
        found.seconds |= values["seconds"]
    return found


def _record(notes: Path, plan: str, workers: int) -> None:
    print("which tests reach which mutants: all tests run once", file=sys.stderr, flush=True)
    with tempfile.TemporaryDirectory() as made:
        given = Path(made, "plan")
        given.write_text(plan, "utf-8")
        surroundings = {**os.environ, "LINKWRIGHT_CACHE": made, PLAN: str(given), NOTES: str(notes)}
        surroundings["PYTHONPATH"] = os.pathsep.join([str(ROOT), str(SOURCE.parent)])
        words = ["-q", "-p", "no:cacheprovider", "-p", "tests.mutation.probes", "--share", "all"]
        words += ["-n", str(workers), "--dist", "loadfile", *(f"--ignore={each}" for each in LEFT_OUT)]
        command = [sys.executable, "-m", "pytest", *words]
        with (notes / "log.txt").open("w") as log:
            subprocess.run(command, cwd=ROOT, env=surroundings, stdout=log, check=False)
