"""From the start of a process to the printed table, against starting NumPy."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from importlib.metadata import distributions

from benchmarks.timing import Candidate, Rounds, in_turns

NUMPY = "python -c 'import numpy'"
#: Commands, and how many times as long as starting NumPy each may take.
COMMANDS = {"check": 1.2, "solve": 2.5, "metrics": 3.5, "plot": 9.0}
MODEL = "gallery:jaw_crusher_sixbar"
BARE = "python -c pass"
_PROGRAM = "import sys; from linkwright.cli import main; sys.argv[1:] = {}; sys.exit(main())"
_LINE = re.compile(r"import time:\s+(\d+) \|\s+\d+ \|\s*(\S+)")


def _command(code: str, *options: str) -> list[str]:
    return [sys.executable, *options, "-c", code]


def named(command: str) -> str:
    """A command as it is written in a terminal."""
    return f"linkwright {command} {MODEL}"


def _program(command: str, folder: str) -> str:
    more = ["--force", "--output", f"{folder}/drawn.svg"] if command == "plot" else []
    return _PROGRAM.format([command, MODEL, *more])


@contextmanager
def _environment() -> Iterator[dict[str, str]]:
    """An environment in which modules are compiled to byte code once, in a folder that goes away."""
    with tempfile.TemporaryDirectory(prefix="linkwright_benchmarks_") as folder:
        kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
        yield {**kept, "PYTHONPYCACHEPREFIX": folder, "PYTHONIOENCODING": "utf-8"}


def _call(command: list[str], environment: dict[str, str]) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, check=True, capture_output=True, encoding="utf-8", env=environment)


def measure(rounds: int) -> Rounds:
    """Every command as a new process, in turns; modules are compiled to byte code before."""
    with _environment() as environment:
        folder = environment["PYTHONPYCACHEPREFIX"]
        own = {named(command): _command(_program(command, folder)) for command in COMMANDS}
        commands = {BARE: _command("pass"), NUMPY: _command("import numpy"), **own}
        candidates = [Candidate(name, partial(_call, command, environment)) for name, command in commands.items()]
        return in_turns(candidates, rounds, 0.0)


def parts() -> dict[str, float]:
    """Milliseconds of the imports of ``linkwright solve`` by who is imported, without what they import themselves.

    Measured with ``-X importtime``, which itself adds to every import.
    """
    with _environment() as environment:
        folder = environment["PYTHONPYCACHEPREFIX"]
        command = _command(_program("solve", folder), "-X", "importtime")
        reports = [_call(command, environment).stderr for _ in range(4)][1:]
    return min(map(_by_owner, reports), key=lambda found: sum(found.values()))


def _by_owner(report: str) -> dict[str, float]:
    installed = {
        top.split("/")[0].removesuffix(".py")
        for each in distributions()
        for top in (str(path) for path in (each.files or []))
        if not top.startswith((".", "_"))
    }
    found: defaultdict[str, float] = defaultdict(float)
    for match in _LINE.finditer(report):
        top = match[2].split(".")[0]
        own = top if top in ("linkwright", "numpy") or (top in installed and not top.endswith("dist-info")) else ""
        found[own or "the standard library"] += float(match[1]) / 1e3
    return dict(sorted(found.items(), key=lambda entry: -entry[1]))
