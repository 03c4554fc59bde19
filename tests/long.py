"""The long run: every test, and what takes minutes to hours: ``python -m tests.long``.

    python -m tests.long                      all steps, one after the other
    python -m tests.long --list               what they are
    python -m tests.long --only tests random  some of them
    python -m tests.long --from machines      what is left after an interruption

Before each release; its result is noted in the release's notes. What a step prints goes to `build/long/`, its result
to `build/long/result.txt` as soon as it ends. Exit code: 0 all passed, 1 something failed, 130 interrupted.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from datetime import date
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "build" / "long"
#: Arguments of Python, by the name of a step.
STEPS: Mapping[str, str] = {
    "tests": "-m pytest -q -n 2 --dist worksteal --share all",
    "machines": "-m tests.random_mechanisms --count 2000 --seed {day} --workers 2",
    "gears": "-m tests.random_geared --count 500 --seed {day}",
    "numbers": "-m tests.brute_force --count 200 --seed {day}",
    "gradients": "-m tests.gradients --count 100 --seed {day}",
    "joints": "-m tests.random_cells --seeds 10",
    "branches": "-m tests.random_branches --count 400 --first {day}",
    "drawings": "-m tests.unit.kinematics.random_drawings --count 200 --off 2",
    "solids": "-m tests.unit.solids.checks",
    "sheets": "-m tests.course_mistakes",
    "starts": "-m tests.unit.synthesis.trace_starts",
    "large": "-m tests.large_inputs",
    "alone": "-m tests.designs_alone --count 100 --seed {day}",
    "cluster": "-m tests.cluster",
    "benchmarks": "-m benchmarks --no-page",
    "mujoco": "-m tests.mujoco_cycles",
    "mutants": "-m tests.mutants --count 150 --seed {day} --workers 2",
}


def ended(name: str, command: Sequence[str]) -> bool:
    """Runs a step, what it prints goes into a file; whether it passed."""
    began, log = time.monotonic(), FOLDER / f"{name}.txt"
    print(f"{name}: {' '.join(['python', *command])}", flush=True)
    with log.open("w", encoding="utf-8") as file:
        code = subprocess.run(
            [sys.executable, *command], cwd=ROOT, stdout=file, stderr=subprocess.STDOUT, check=False
        ).returncode
    last = (log.read_text("utf-8", errors="replace").replace("\r", "\n").split("\n") or [""])[-2:]
    said = f"{name}: {'passed' if code == 0 else f'FAILED ({code})'} in {time.monotonic() - began:.0f} s; "
    said += " ".join(line for line in last if line).strip()
    print(said, flush=True)
    with (FOLDER / "result.txt").open("a", encoding="utf-8") as file:
        file.write(f"{date.today()} {said}\n")
    return code == 0


def chosen(given: argparse.Namespace) -> list[str]:
    """Names of the steps that were asked for, in their order."""
    names = [name for name in STEPS if not given.only or name in given.only]
    return names[names.index(given.start) :] if given.start in names else names


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the steps."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.long", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--only", nargs="+", choices=list(STEPS), metavar="STEP", help=", ".join(STEPS))
    parser.add_argument("--from", dest="start", choices=list(STEPS), metavar="STEP", help="the first one")
    parser.add_argument("--list", action="store_true", help="shows the steps")
    given = parser.parse_args(arguments)
    commands = {name: STEPS[name].format(day=date.today().toordinal()).split() for name in chosen(given)}
    if given.list:
        for name, command in commands.items():
            print(f"{name:<12}{' '.join(['python', *command])}")
        return 0
    FOLDER.mkdir(parents=True, exist_ok=True)
    try:
        passed = [ended(name, command) for name, command in commands.items()]
    except KeyboardInterrupt:
        print("interrupted; --from goes on with a step", file=sys.stderr)
        return 130
    return 0 if all(passed) else 1


if __name__ == "__main__":
    sys.exit(main())
