"""Finds all rows, in processes side by side, and writes them whole or not at all."""

from __future__ import annotations

import gzip
import json
import os
import signal
import sys
import time
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from multiprocessing import get_context
from pathlib import Path
from typing import NamedTuple

from tests.state import designs, drawn, findings, kinds, machines, tables
from tests.state.rows import Entries, Row, rows

import linkwright as lw

FORM = {"state": 1}
#: Parts of one machine of the gallery.
OF_MACHINES: Mapping[str, Callable[[machines.Machine], Entries]] = {**machines.PARTS, **designs.PARTS, **tables.PARTS}
#: Parts with subjects of their own, each found alone.
ALONE: Mapping[str, tuple[Callable[[str], Entries], Callable[[], tuple[str, ...]]]] = {
    **kinds.PARTS,
    "random": (drawn.drawn, drawn.subjects),
    "findings": (findings.findings, findings.subjects),
}
PARTS = (*OF_MACHINES, *ALONE)
#: Those that take longest are begun first.
LONGEST = ("references", "random", "machines", "synthesis")

#: After so many subjects a process is begun anew, since memory that is free is not always given back.
LIFE = 30


class Job(NamedTuple):
    """The rows of one subject: of all parts of a machine that are asked for, or of a part alone."""

    kind: str
    subject: str
    parts: tuple[str, ...]

    def found(self) -> list[Row]:
        if self.kind != "machines":
            return list(rows(self.kind, self.subject, ALONE[self.kind][0](self.subject)))
        return [row for part in self.parts for row in rows(part, self.subject, self.entries(part))]

    def entries(self, part: str) -> Entries:
        yield from OF_MACHINES[part](machine(self.subject))


_machines: dict[str, machines.Machine] = {}


def machine(name: str) -> machines.Machine:
    """A machine of the gallery; the last one is kept."""
    if name not in _machines:
        _machines.clear()
        _machines[name] = machines.Machine(lw.load(f"gallery:{name}"))
    return _machines[name]


def jobs(only: Sequence[str]) -> list[Job]:
    """What is to be done for some parts, the longest first."""
    asked = set(only or PARTS)
    own = tuple(part for part in OF_MACHINES if part in asked)
    found = [Job("machines", name, own) for name in lw.gallery_names()] if own else []
    found += [Job(part, name, ()) for part, (_, names) in ALONE.items() if part in asked for name in names()]
    return sorted(found, key=lambda job: LONGEST.index(job.kind) if job.kind in LONGEST else len(LONGEST))


def dump(path: Path, only: Sequence[str] = (), workers: int = 2) -> int:
    """Writes the rows of all parts, or of some, and gives their number; nothing is written where it is stopped."""
    wanted = jobs(only)
    found = sorted(row for each in progressing(finished(wanted, workers), len(wanted)) for row in each)
    whole = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        with open(whole, "wb") as file, gzip.GzipFile("", "wb", 6, file, mtime=0) as packed:
            packed.writelines(line.encode("utf-8") for line in lines(found))
        whole.replace(path)
    finally:
        whole.unlink(missing_ok=True)
    return len(found)


def lines(found: Sequence[Row]) -> Iterator[str]:
    """The head, then for every part and subject a line and its rows."""
    yield json.dumps(FORM) + "\n"
    for (part, subject), group in groupby(found, key=lambda row: row[:2]):
        yield json.dumps([part, subject], ensure_ascii=False) + "\n"
        for row in group:
            yield json.dumps(row[2:], ensure_ascii=False, separators=(",", ":")) + "\n"


def finished(wanted: Sequence[Job], workers: int) -> Iterator[list[Row]]:
    """The rows of each job, in no order."""
    if workers == 1:
        _quiet()
        yield from map(Job.found, wanted)
        return
    with get_context("spawn").Pool(workers, _begin, maxtasksperchild=LIFE) as pool:
        yield from pool.imap_unordered(Job.found, wanted)


def _begin() -> None:
    """Interruptions reach the first process alone, which ends the others."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _quiet()


def _quiet() -> None:
    """Warnings of the product are errors of their row, as in the tests."""
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    warnings.simplefilter("error")


def progressing(found: Iterable[list[Row]], most: int) -> Iterator[list[Row]]:
    """The same, with how far it is on the screen."""
    began, number = time.monotonic(), 0
    for done, each in enumerate(found, 1):
        number += len(each)
        if done % 10 == 0 or done == most or sys.stderr.isatty():
            spent = time.monotonic() - began
            end = "\n" if done == most else ""
            print(f"\r{done}/{most} subjects, {number} rows, {spent:.0f} s ", end=end, file=sys.stderr, flush=True)
        yield each
