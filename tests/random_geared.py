"""Random mechanisms with gears, belts and racks, on moving carriers and in loops, against the independent reference.

    python -m tests.random_geared --count 500 --seed 1

Each one is put down assembled, followed by both codes over five positions, and compared: positions, velocities,
accelerations, all reactions with what presses teeth apart, the driver's torque; to 1e-9 of the largest number of its
kind. Those that the reference does not reach, or whose equations are so badly conditioned that rounding would be
judged, must not crash, and do not count. Model files of what fails are printed.

Exit code: 0 nothing wrong, 1 something wrong, 2 wrong use.
"""

from __future__ import annotations

import argparse
import sys
import time
import traceback
import warnings
from collections import Counter
from contextlib import suppress

from tests.reference.geared_judge import TIMES, disagreements, well_placed
from tests.reference.geared_mechanisms import GearedCase, geared_case

import linkwright as lw

STRIDE = 1_000_000  # mechanisms of one seed


def verdict(case: GearedCase) -> tuple[str, list[str]]:
    """agrees, differs, refused, crash, or not judged; with what is wrong."""
    try:
        reference = well_placed(case)
        if reference is not None:
            found = disagreements(case, reference)
            return ("differs", found) if found else ("agrees", [])
        with suppress(lw.LinkwrightError):
            lw.solve_forces(lw.solve_motion(lw.loads(case.text), times=TIMES))
        return "not judged", []
    except lw.LinkwrightError as error:
        return "refused", [str(error)]
    except Exception:
        return "crash", traceback.format_exc().splitlines()[-6:]


def run(count: int, seed: int) -> int:
    """Judges until ``count`` mechanisms are compared."""
    kinds: Counter[str] = Counter()
    pieces: Counter[str] = Counter()
    began, number, code = time.process_time(), seed * STRIDE, 0
    while kinds.total() - kinds["not judged"] < count:
        case = geared_case(number)
        kind, lines = verdict(case)
        kinds[kind] += 1
        if kind != "not judged":
            pieces.update(case.kinds)
        if kind not in ("agrees", "not judged"):
            code = 1
            print(f"{number}: {kind}\n  " + "\n  ".join(lines) + f"\n{case.text}")
        number += 1
    print(
        ", ".join(f"{n} {kind}" for kind, n in sorted(kinds.items())),
        f"in {time.process_time() - began:.0f} s",
    )
    print("pieces:", ", ".join(f"{n} {kind}" for kind, n in sorted(pieces.items())))
    return code


def main() -> int:
    """Reads the options."""
    parser = argparse.ArgumentParser(prog="python -m tests.random_geared", description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=100, help="how many mechanisms (default 100)")
    parser.add_argument("--seed", type=int, default=1, help="which sequence of mechanisms (default 1)")
    given = parser.parse_args()
    if given.count < 1:
        parser.error("--count is a number above zero")
    warnings.simplefilter("error")
    return run(given.count, given.seed)


if __name__ == "__main__":
    sys.exit(main())
