"""Metrics of random loaded machines against the same numbers by brute force, on 20 000 positions of the cycle.

    python -m tests.brute_force --count 200 --workers 1 --seed 1
    python -m tests.brute_force --only 1000013 --seed 1

Machines of `tests/reference/loaded_machines.py` are solved at many positions; extremes are the tops of parabolas
through the highest samples, means are means of samples (see `tests/reference/sampled_cycle.py`, with how far each may
be off where a signal jumps). Of every metric the worst relative difference is printed, beside that among values whose
samples meet no jump. A difference above what the samples allow is wrong; model files of what fails are printed.

Exit code: 0 nothing wrong, 1 something wrong, 2 wrong use.
"""

from __future__ import annotations

import argparse
import signal
import sys
import time
import traceback
import warnings
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import islice
from math import isnan
from multiprocessing import get_context

from tests.reference.loaded_machines import LoadedMachine, loaded_machine, loaded_machines
from tests.reference.sampled_numbers import SampledMachine

import linkwright as lw

POSITIONS = 20_000
#: Differences this small, relative to the largest number of the same unit, are rounding.
ROUNDING = 1e-10
#: Slack below which samples meet no jump, relative.
SMOOTH = 1e-9
#: Values smaller than this share of the largest of their unit are judged beside it; SI, below which all is rounding.
SMALL, LEAST = 1e-3, 1e-6
#: Metrics whose sign is chosen where both are as large.
SIZES = ("velocity_ratio",)


@dataclass(frozen=True)
class Judged:
    """One value: relative difference from brute force, relative slack of this."""

    metric: str
    subject: str
    difference: float
    slack: float
    wrong: str = ""


@dataclass
class Verdict:
    """On one machine; ``refused``: why it could not be judged, ``crash``: an error that is no sentence."""

    number: int
    kinds: tuple[str, ...]
    values: list[Judged] = field(default_factory=list)
    unjudged: Counter[str] = field(default_factory=Counter)
    refused: str = ""
    crash: str = ""
    text: str = ""

    @property
    def wrong(self) -> list[Judged]:
        return [each for each in self.values if each.wrong]


class TooSlow(Exception):
    """No answer in time."""


def _alarm(signum: int, frame: object) -> None:
    raise TooSlow


def verdict(machine: LoadedMachine, limit: int = 300) -> Verdict:
    """What is found of a machine within ``limit`` seconds."""
    found = Verdict(machine.seed, machine.kinds, text=machine.text)
    before = signal.signal(signal.SIGALRM, _alarm)
    signal.alarm(limit)
    try:
        found.values = list(_judged(machine.mechanism, found.unjudged))
    except lw.LinkwrightError as error:
        found.refused = f"{error.code}: {error}"
    except TooSlow:
        found.refused = f"more than {limit} s"
    except Exception:
        found.crash = "".join(traceback.format_exc().splitlines(True)[-6:])
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)
    return found


def _judged(mechanism: lw.Mechanism, unjudged: Counter[str]) -> Iterator[Judged]:
    table = lw.metrics(lw.solve_forces(mechanism))
    sampled = SampledMachine(mechanism, POSITIONS)
    largest: dict[str, float] = defaultdict(float)
    for row in table:
        if abs(row.value) < float("inf"):
            largest[row.unit] = max(largest[row.unit], abs(row.value))
    seen: set[tuple[str, str]] = set()
    for row in table:
        first = (row.metric, row.subject) not in seen  # of several the outermost
        seen.add((row.metric, row.subject))
        bounded = sampled.number(row) if row.exact and first else None
        if bounded is None or isnan(bounded.value):
            unjudged[row.metric] += 1
            continue
        scale = max(abs(bounded.value), SMALL * largest[row.unit], LEAST)
        value = abs(row.value) if row.metric in SIZES else row.value
        difference, slack = abs(value - bounded.value), bounded.slack + ROUNDING * max(largest[row.unit], 1.0)
        said = f"{row.value!r}, by brute force {bounded.value!r} ± {slack:.1e}"
        yield Judged(
            row.metric, row.subject, difference / scale, bounded.slack / scale, "" if difference <= slack else said
        )


def verdicts(seed: int, count: int, workers: int) -> Iterator[Verdict]:
    """On so many machines of a sequence."""
    chosen = islice(loaded_machines(seed), count)
    if workers == 1:
        yield from map(verdict, chosen)
        return
    with get_context("spawn").Pool(workers, _begin) as pool:
        yield from pool.imap(verdict_of, [each.seed for each in chosen])


def _begin() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    warnings.simplefilter("error")


def verdict_of(number: int) -> Verdict:
    """On the machine of a number."""
    machine = loaded_machine(number)
    if machine is None:
        raise SystemExit(f"no machine of number {number}")
    return verdict(machine)


def table(found: list[Verdict]) -> str:
    """The worst relative differences of every metric."""
    by_metric: dict[str, list[Judged]] = defaultdict(list)
    for each in found:
        for value in each.values:
            by_metric[value.metric].append(value)
    lines = [f"{'metric':<28}{'values':>8}{'worst':>10}{'its slack':>10}{'smooth':>8}{'worst':>10}{'wrong':>7}"]
    for metric, values in sorted(by_metric.items()):
        worst = max(values, key=lambda one: one.difference)
        smooth = [one for one in values if one.slack <= SMOOTH]
        best = max((one.difference for one in smooth), default=float("nan"))
        wrong = sum(bool(one.wrong) for one in values)
        lines.append(
            f"{metric:<28}{len(values):>8}{worst.difference:>10.1e}{worst.slack:>10.1e}"
            f"{len(smooth):>8}{best:>10.1e}{wrong:>7}"
        )
    unjudged = sum((each.unjudged for each in found), Counter[str]())
    lines.append("not judged: " + ", ".join(f"{n} {name}" for name, n in sorted(unjudged.items())))
    return "\n".join(lines)


def run(found: Iterator[Verdict], count: int) -> int:
    """Prints what is wrong as it is found, then the table."""
    done, kinds, began = list[Verdict](), Counter[str](), time.monotonic()
    for each in found:
        done.append(each)
        kinds.update(each.kinds)
        for one in each.wrong:
            print(f"{each.number}: {one.metric} {one.subject}: {one.wrong}")
        if each.refused or each.crash:
            print(f"{each.number}: {each.refused or each.crash}")
        if each.wrong or each.crash:
            print(f"loads: {', '.join(each.kinds)}\n{each.text}", flush=True)
        if len(done) % 10 == 0 or len(done) == count:
            print(f"{len(done)}/{count}, {time.monotonic() - began:.0f} s", file=sys.stderr, flush=True)
    print(table(done))
    print("loads: " + ", ".join(f"{n} {kind}" for kind, n in sorted(kinds.items())))
    failing = sum(bool(each.wrong or each.crash) for each in done)
    refused = sum(bool(each.refused) for each in done)
    print(f"{len(done)} machines, {failing} with something wrong, {refused} refused")
    return int(failing > 0)


def main() -> int:
    """Reads the options."""
    parser = argparse.ArgumentParser(prog="python -m tests.brute_force", description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=20, help="how many machines (default 20)")
    parser.add_argument("--seed", type=int, default=1, help="which sequence of machines (default 1)")
    parser.add_argument("--workers", type=int, default=1, help="processes (default 1)")
    parser.add_argument("--only", type=int, nargs="+", metavar="NUMBER", help="machines of these numbers")
    given = parser.parse_args()
    if min(given.count, given.workers) < 1:
        parser.error("--count and --workers are numbers above zero")
    warnings.simplefilter("error")
    if given.only:
        return run(map(verdict_of, given.only), len(given.only))
    return run(verdicts(given.seed, given.count, given.workers), given.count)


if __name__ == "__main__":
    sys.exit(main())
