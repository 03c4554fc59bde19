"""Mutants of the analysis packages: does a test notice each small change?

    python -m tests.mutants --count 300 --seed 1 --workers 2
    python -m tests.mutants --only kinetostatics/friction.py --count 50 --seed 3

Of all mutants of the packages (`tests/mutation/mutate.py`) a random sample is tried: the tests that run the changed
line, those of files named for the module and the quickest of each file first, until one fails. What is left when the
budget is used up meets more of these tests with `--again`. Survivors are printed.
Mutants that nobody could notice stand, each with the reason, in `tests/equivalent_mutants.txt`; they are left out of
the share.

Exit code: 0 at least 90 % of the others killed, 1 fewer, 2 wrong use, 130 interrupted.
"""

from __future__ import annotations

import argparse
import json
import random
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from multiprocessing import get_context
from pathlib import Path
from signal import SIG_IGN, SIGINT, signal
from typing import ClassVar

from tests.mutation.covering import ROOT, Covering, covering, fingerprint
from tests.mutation.mutate import Mutant, mutants
from tests.mutation.probes import SOURCE
from tests.mutation.trial import killed, preload

PACKAGES = (
    "kinematics",
    "groups",
    "topology",
    "kinetostatics",
    "applied_loads",
    "drivers",
    "joints",
    "analysis",
    "machine",
    "engine",
    "study",
    "units.py",
)
EQUIVALENT = Path(__file__).parent / "equivalent_mutants.txt"
WANTED = 0.9


@dataclass
class Trial:
    key: str
    kind: str
    place: str
    state: str  # killed, survived, not run, equivalent
    by: str
    seconds: float


def all_mutants(only: Sequence[str]) -> list[Mutant]:
    found = []
    for name in only:
        path = SOURCE / name
        for file in [path] if path.suffix else sorted(path.rglob("*.py")):
            found += mutants(file.relative_to(SOURCE).as_posix(), file.read_text("utf-8"))
    return found


def equivalents() -> dict[str, str]:
    """Reasons by key (path | before | after, * for any after); in the file the indented reason follows its key."""
    known: dict[str, str] = {}
    lines = EQUIVALENT.read_text("utf-8").splitlines() if EQUIVALENT.exists() else []
    for line in lines:
        if line.startswith("#") or not line.strip():
            continue
        if line.startswith(" "):
            known[list(known)[-1]] = line.strip()
        else:
            known[line.strip()] = ""
    missing = [key for key, reason in known.items() if not reason]
    if missing:
        raise SystemExit(f"{EQUIVALENT.name}: no reason is given for {missing[0]}")
    return known


def tried(mutant: Mutant, cover: Covering, known: dict[str, str], budget: float, again: float) -> Trial:
    source = (SOURCE / mutant.path).read_text("utf-8")
    key, place = mutant.key(source), f"{mutant.path}:{mutant.lines[0]}"
    reason = known.get(key) or known.get(f"{mutant.path} | {mutant.changed_lines(source)[0]} | *")
    if reason:
        return Trial(key, mutant.kind, place, "equivalent", reason, 0.0)
    tests = cover.of(mutant)
    if not tests:
        return Trial(key, mutant.kind, place, "not run", "no test runs the line", 0.0)
    chosen, began = cover.by_promise(tests, budget, Path(mutant.path).stem), time.monotonic()
    first, soon = max(1, min(30, len(chosen))), len(chosen)
    if again:
        done, of_line = set(chosen), set(tests)
        more = cover.by_promise(tests, budget + again, Path(mutant.path).stem)
        chosen += [test for test in more if test in of_line and test not in done]
    for part in (chosen[:first], chosen[first:soon], chosen[soon:]):
        if part:
            expected = sum(cover.seconds.get(test, 1.0) for test in part)
            dead, said = killed(mutant.path, mutant.applied(source), part, 30 + 6 * expected)
            if dead:
                return Trial(key, mutant.kind, place, "killed", said, time.monotonic() - began)
    return Trial(key, mutant.kind, place, "survived", f"{len(chosen)} tests", time.monotonic() - began)


class Work:
    """What the worker processes share: they are forked after it is made."""

    cover = Covering()
    known: ClassVar[dict[str, str]] = {}
    budget, again = 30.0, 0.0


def _try(mutant: Mutant) -> Trial:
    return tried(mutant, Work.cover, Work.known, Work.budget, Work.again)


def try_all(chosen: list[Mutant], workers: int) -> Iterator[Trial]:
    if workers == 1:
        yield from map(_try, chosen)
        return
    with get_context("fork").Pool(workers, signal, (SIGINT, SIG_IGN)) as pool:
        yield from pool.imap_unordered(_try, chosen)


def show(trial: Trial) -> None:
    _, before, after = trial.key.split(" | ", 2)
    print(f"\n{trial.place} ({trial.kind}) {trial.state}: {trial.by}\n- {before}\n+ {after}", flush=True)


def summary(trials: list[Trial]) -> tuple[str, float]:
    counts = {
        state: sum(t.state == state for t in trials) for state in ("killed", "survived", "not run", "equivalent")
    }
    others = len(trials) - counts["equivalent"]
    share = counts["killed"] / others if others else 1.0
    told = ", ".join(f"{n} {state}" for state, n in counts.items())
    return f"{len(trials)} mutants: {told}; {share:.1%} of the non-equivalent ones killed", share


def run(given: argparse.Namespace) -> int:
    folder = ROOT / "build" / "mutants" if given.folder is None else given.folder
    only = given.only or PACKAGES
    population = all_mutants(only)
    chosen = random.Random(given.seed).sample(population, min(given.count, len(population)))
    Work.cover = covering(folder / "covering", chosen, given.workers)
    Work.known, Work.budget, Work.again = equivalents(), given.budget, given.again
    preload()
    _check_unchanged(Work.cover, chosen)
    print(f"{len(chosen)} of {len(population)} mutants", file=sys.stderr)
    journal = folder / f"trials-{given.seed}-{given.count}-{'-'.join(only).replace('/', '.')[:60]}.jsonl"
    trials, rest = _done_before(journal, chosen)
    began, code = time.monotonic(), 0
    try:
        for k, trial in enumerate(try_all(rest, given.workers), 1):
            trials.append(trial)
            with journal.open("a", encoding="utf-8") as file:
                file.write(json.dumps(asdict(trial)) + "\n")
            if trial.state in ("survived", "not run"):
                show(trial)
            left = (time.monotonic() - began) / k * (len(rest) - k) / 60
            print(f"\r{k}/{len(rest)}, about {left:.1f} min left ", end="", file=sys.stderr, flush=True)
    except KeyboardInterrupt:
        print("\ninterrupted; the same command goes on from here", file=sys.stderr)
        code = 130
    text, share = summary(trials)
    print(f"\n{text}")
    return code or int(share < WANTED)


def _check_unchanged(cover: Covering, chosen: list[Mutant]) -> None:
    """The tests must pass on the unchanged modules, else every mutant would seem to be killed."""
    for mutant in chosen[:5]:
        tests = cover.of(mutant)
        source = (SOURCE / mutant.path).read_text("utf-8")
        failed, said = killed(mutant.path, source, cover.by_promise(tests, 5.0), 300) if tests else (False, "")
        if failed:
            raise SystemExit(f"{said} fails on the unchanged package; mutants would say nothing")


def _done_before(journal: Path, chosen: list[Mutant]) -> tuple[list[Trial], list[Mutant]]:
    """Trials of an interrupted run of the same sources, and the mutants that are left."""
    mark = json.dumps({"sources": fingerprint("tests")})
    lines = journal.read_text("utf-8").splitlines() if journal.exists() else []
    if not lines or lines[0] != mark:
        journal.write_text(mark + "\n", "utf-8")
        return [], chosen
    trials = [Trial(**json.loads(line)) for line in lines[1:] if line.endswith("}")]
    done = [trial.key for trial in trials]
    rest = []
    for mutant in chosen:
        key = mutant.key((SOURCE / mutant.path).read_text("utf-8"))
        if key in done:
            done.remove(key)
        else:
            rest.append(mutant)
    for trial in trials:
        if trial.state in ("survived", "not run"):
            show(trial)
    return trials, rest


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.mutants", description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=300, help="size of the sample (default 300)")
    parser.add_argument("--seed", type=int, default=1, help="which sample (default 1)")
    parser.add_argument("--workers", type=int, default=1, help="processes (default 1)")
    parser.add_argument("--only", nargs="+", help=f"packages or modules (default {' '.join(PACKAGES)})")
    parser.add_argument("--budget", type=float, default=30.0, help="seconds of tests per mutant (default 30)")
    parser.add_argument("--again", type=float, default=0.0, help="seconds of more tests of the line (default 0)")
    parser.add_argument("--folder", type=Path, help="where the record is kept (default build/mutants)")
    return run(parser.parse_args())


if __name__ == "__main__":
    sys.exit(main())
