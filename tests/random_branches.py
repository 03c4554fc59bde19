"""Random machines with groups without closed form: is the drawing's assembly kept, whatever the steps?

    python -m tests.random_branches --count 400 --steps 6 12 24 360
    python -m tests.random_branches FILE ...

The truth is the independent code followed in tiny steps (`tests/reference/fine_path.py`). Positions of another
assembly are jumps; positions that the fine path reaches and that are refused are lost; those of an open cycle that
lie beyond its end are counted as well.

Exit code: 0 no jump, 1 a jump, 2 wrong use.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from tests.reference.fine_path import FinePath
from tests.reference.general_case import general_case

import linkwright as lw

#: Positions at which the fine path is known; every number of steps is a part of it or a multiple.
FINE = 24
#: Largest difference of a link's direction.
SAME = 1e-7


def judged(mechanism: Any, steps: tuple[int, ...]) -> Iterator[tuple[int, Counter[str]]]:
    """Of every number of steps how many of the positions that the fine path knows are right, jumps, or lost."""
    times = lw.solve_motion(mechanism, steps=FINE, failures="mark").time
    ahead, closed = FinePath(mechanism, times), len(times) == FINE
    for count in steps:
        found: Counter[str] = Counter()
        motion = lw.solve_motion(mechanism, steps=count, failures="mark")
        for k in range(ahead.reached):
            if (k * count) % FINE:
                continue
            at = k * count // FINE
            if at >= motion.steps:
                continue
            if not motion.ok[at]:
                found["lost"] += 1
                continue
            gap = max(
                float(np.abs(motion.link(name).direction[at] - ahead.direction(name)[k]).max())
                for name in mechanism.links
            )
            found["right" if gap < SAME else "jump"] += 1
        if not closed:
            found["beyond"] = int(motion.ok[-(-(ahead.reached - 1) * count // FINE) + 1 :].sum())
        yield count, found


def machines(files: list[str], first: int, count: int) -> Iterator[tuple[str, Any]]:
    """Model files, or so many random machines with groups without closed form."""
    for name in files:
        yield Path(name).name, lw.load(name)
    seed = first
    while not files and count:
        text = general_case(seed).text
        try:
            mechanism = lw.loads(text)
            groups = lw.structure(mechanism).groups
        except lw.LinkwrightError:
            groups = ()
        if any(len(group.unknowns) > 2 for group in groups):
            yield str(seed), mechanism
            count -= 1
        seed += 1


def main() -> int:
    """Reads the options, and judges so many machines."""
    parser = argparse.ArgumentParser(prog="python -m tests.random_branches", description=__doc__.split("\n")[0])
    parser.add_argument("files", nargs="*", help="model files instead of random machines")
    parser.add_argument("--count", type=int, default=40, help="how many machines (default 40)")
    parser.add_argument("--first", type=int, default=300_000, help="the first seed (default 300000)")
    parser.add_argument("--steps", type=int, nargs="*", default=[6, 12, 24, 360], help="steps of a cycle")
    given = parser.parse_args()
    total: dict[int, Counter[str]] = {count: Counter() for count in given.steps}
    began = time.perf_counter()
    for name, mechanism in machines(given.files, given.first, given.count):
        try:
            for count, found in judged(mechanism, tuple(given.steps)):
                total[count] += found
                if found["jump"] or found["lost"]:
                    print(f"{name}, {count} steps: {dict(found)}", flush=True)
        except lw.LinkwrightError as error:
            print(f"{name}: {type(error).__name__} {str(error)[:100]}", flush=True)
    for count, all_found in total.items():
        print(f"{count} steps: " + ", ".join(f"{n} {kind}" for kind, n in sorted(all_found.items())))
    print(f"{time.perf_counter() - began:.0f} s")
    return int(any(found["jump"] for found in total.values()))


if __name__ == "__main__":
    sys.exit(main())
