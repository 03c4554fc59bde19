"""Random mechanisms judged by the independent multibody reference, as many as wanted.

    python -m tests.random_mechanisms --count 2000 --seed 1 --workers 2
    python -m tests.random_mechanisms FILE ... [--steps 36]

Each mechanism is solved over its cycle and compared position by position with a branch followed independently
(`tests/reference/judge.py`). What is done is kept in the folder of results: an interrupted run goes on where it
stopped, as long as neither the package nor the reference has changed. Mechanisms that fail are written there as
model files, with what was wrong in their first lines.

Exit code: 0 nothing wrong, 1 something wrong, 2 wrong use, 130 interrupted.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import re
import signal
import sys
import time
import warnings
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from multiprocessing import get_context
from pathlib import Path
from types import FrameType

from tests.reference.general_case import general_case
from tests.reference.judge import GOOD, UNSURE, Verdict, judged

STRIDE = 1_000_000  # mechanisms of one seed
MEANING = {
    "not read": "a correct model file was refused",
    "not solved": "a mechanism that can move was refused as a whole",
    "refused": "a position was refused that the branch reaches regularly",
    "beyond a limit": "a position was given, without a word, that the branch does not reach",
    "other branch": "positions of another assembly",
    "wrong number": "a number differs by more than rounding",
    "forces refused": "motion found, forces refused",
    "crash": "an error that is no sentence",
    "too slow": "no answer in time",
    UNSURE: "neither right nor wrong can be said",
}


@dataclass
class Result:
    seed: int
    steps: int
    kind: str
    lines: list[str]
    positions: int
    seconds: float
    notes: dict[str, int]


class TooSlow(Exception):
    pass


def _alarm(signum: int, frame: FrameType | None) -> None:
    raise TooSlow


def judge_in_time(text: str, steps: int, limit: int) -> Verdict:
    """The verdict, or that there was none within `limit` seconds."""
    before = signal.signal(signal.SIGALRM, _alarm)
    signal.alarm(limit)
    try:
        return judged(text, steps)
    except TooSlow:
        return Verdict("too slow", [f"more than {limit} s"])
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def judge_seed(seed: int, limit: int = 60) -> Result:
    case, began = general_case(seed), time.perf_counter()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            verdict = judge_in_time(case.text, case.steps, limit)
        except Warning as warning:
            verdict = Verdict("crash", [f"warning: {warning}"])
    return Result(
        seed, case.steps, verdict.kind, verdict.lines, verdict.positions, time.perf_counter() - began, verdict.notes
    )


def fingerprint() -> str:
    """Of the package's and the reference's sources: results of others are not gone on with."""
    import linkwright

    digest = hashlib.sha256()
    for folder in (Path(linkwright.__file__).parent, Path(__file__).parent / "reference"):
        for path in sorted(folder.rglob("*.py")):
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


class Results:
    """Results on disk, one line each; written as soon as they are known."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.path = folder / "results.jsonl"
        folder.mkdir(parents=True, exist_ok=True)
        mark = fingerprint()
        lines = self.path.read_text("utf-8").splitlines() if self.path.exists() else []
        same = bool(lines) and json.loads(lines[0]).get("sources") == mark
        self.found = [Result(**json.loads(line)) for line in lines[1:] if line.endswith("}")] if same else []
        if not same:
            for stale in folder.glob("*.yaml"):
                stale.unlink()
            self.path.write_text(json.dumps({"sources": mark}) + "\n", "utf-8")

    def add(self, result: Result) -> None:
        self.found.append(result)
        with self.path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(asdict(result)) + "\n")
        if result.kind not in GOOD:
            case = general_case(result.seed)
            said = [f"# {result.kind}, steps={result.steps}"]
            said += [f"# {line}" for entry in result.lines[:5] for line in entry.splitlines()]
            name = f"{result.kind.replace(' ', '_')}_{result.seed}.yaml"
            (self.folder / name).write_text("\n".join(said) + "\n" + case.text, "utf-8")


def judge_all(seeds: list[int], workers: int, limit: int) -> Iterator[Result]:
    if workers == 1:
        yield from (judge_seed(seed, limit) for seed in seeds)
        return
    with get_context("spawn").Pool(workers, signal.signal, (signal.SIGINT, signal.SIG_IGN)) as pool:
        yield from pool.imap_unordered(_judge_one, [(seed, limit) for seed in seeds])


def _judge_one(job: tuple[int, int]) -> Result:
    return judge_seed(*job)


def summary(results: list[Result]) -> str:
    kinds = Counter(result.kind for result in results)
    outcomes: Counter[str] = Counter()
    for result in results:
        outcomes.update(result.notes)
    lines = [f"{len(results)} mechanisms, {sum(r.positions for r in results)} positions"]
    lines += [f"  {kinds[kind]:6d}  {kind}" for kind in GOOD]
    lines += [f"  {kinds[kind]:6d}  {kind}: {meaning}" for kind, meaning in MEANING.items() if kinds[kind]]
    lines += ["outcomes of positions: " + ", ".join(f"{n} {kind}" for kind, n in outcomes.most_common())]
    return "\n".join(lines)


def wrong(results: list[Result]) -> bool:
    return any(result.kind not in (*GOOD, UNSURE) for result in results)


def run(count: int, seed: int, workers: int, folder: Path, limit: int) -> int:
    results = Results(folder)
    wanted = range(seed * STRIDE, seed * STRIDE + count)
    done = {result.seed for result in results.found}
    missing = [k for k in wanted if k not in done]
    if done & set(wanted):
        print(f"{len(done & set(wanted))} of {count} done before, in {folder}", file=sys.stderr)
    began, code = time.monotonic(), 0
    try:
        for k, result in enumerate(judge_all(missing, workers, limit), 1):
            results.add(result)
            _progress(k, len(missing), began, result)
    except KeyboardInterrupt:
        print("\ninterrupted; the same command goes on from here", file=sys.stderr)
        code = 130
    shown = [result for result in results.found if result.seed in wanted]
    print("\n" + summary(shown))
    if wrong(shown):
        print(f"model files of what failed: {folder}")
    return code or int(wrong(shown))


def _progress(k: int, count: int, began: float, result: Result) -> None:
    rest = (time.monotonic() - began) / k * (count - k)
    if result.kind not in GOOD:
        print(f"\r{result.seed}: {result.kind}: {'; '.join(result.lines)[:160]}", file=sys.stderr)
    if k % 10 == 0 or k == count or sys.stderr.isatty():
        print(f"\r{k}/{count}, about {rest / 60:.1f} min left ", end="", file=sys.stderr, flush=True)


def judge_files(paths: list[Path], steps: int | None, limit: int) -> int:
    """Verdicts on model files; steps from the option, from the file's first lines (steps=36), or 360."""
    code = 0
    for path in paths:
        text = path.read_text("utf-8")
        given = re.search(r"steps=(\d+)", "".join(text.splitlines(True)[:2]))
        number = steps or (int(given[1]) if given else 360)
        verdict = judge_in_time(text, number, limit)
        print(f"{path.name} at {number} steps: {verdict.kind} {verdict.notes}")
        for line in verdict.lines[:8]:
            print(f"  {line}")
        code = max(code, int(not verdict.good))
    return code


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.random_mechanisms", description=__doc__.split("\n")[0])
    parser.add_argument("files", nargs="*", type=Path, metavar="FILE", help="model files to judge instead")
    parser.add_argument("--count", type=int, default=300, help="how many mechanisms (default 300)")
    parser.add_argument("--seed", type=int, default=1, help="which sequence of mechanisms (default 1)")
    parser.add_argument("--workers", type=int, default=1, help="processes (default 1)")
    parser.add_argument("--steps", type=int, help="steps of the cycle, for FILE")
    parser.add_argument("--limit", type=int, default=60, help="seconds for one mechanism (default 60)")
    parser.add_argument("--folder", type=Path, help="where results are kept (default build/random_mechanisms/SEED)")
    given = parser.parse_args()
    if given.files:
        return judge_files(given.files, given.steps, given.limit)
    folder = given.folder or Path("build/random_mechanisms") / str(given.seed)
    return run(given.count, given.seed, given.workers, folder, given.limit)


if __name__ == "__main__":
    sys.exit(main())
