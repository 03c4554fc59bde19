"""Random mechanisms with gears, belts, racks and cams, on moving carriers and in loops, against the reference.

    python -m tests.random_geared --count 500 --seed 1
    python -m tests.random_geared --count 1000 --orders 6 --workers 2

Each one is put down assembled, followed by both codes over five positions, and compared: positions, velocities,
accelerations, all reactions with what presses teeth apart, couples, the driver's torque; to 1e-9 of the largest of
its kind; and powers and balances must be right to rounding. With ``--orders`` its file is read in so many orders of
its links, joints and points, all of which must agree with the reference. Those that the reference does not reach, or
whose equations are so badly conditioned that rounding would be judged, must not crash, and do not count; cams within
groups that are followed are refused with their sentence, and do not count either. Model files of what fails are
printed.

Exit code: 0 nothing wrong, 1 something wrong, 2 wrong use.
"""

from __future__ import annotations

import argparse
import signal
import sys
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from itertools import count as from_here
from multiprocessing import get_context

import numpy as np
from tests.reference.geared_judge import TIMES, disagreements, well_placed
from tests.reference.geared_loops import looped_case, reordered
from tests.reference.geared_mechanisms import GearedCase, geared_case

import linkwright as lw

STRIDE = 1_000_000  # mechanisms of one seed
#: Codes of what a kind of joint does not offer.
LACKING = ("model.kind_lacks", "joints.cam_sums")
AGREES, UNJUDGED, UNOFFERED = "agrees", "not judged", "not offered"


@dataclass(frozen=True)
class Verdict:
    """``kind``: agrees, differs, refused, crash, not judged or not offered; ``lines``: what is wrong."""

    number: int
    kind: str
    pieces: tuple[str, ...]
    lines: tuple[str, ...] = ()
    text: str = ""

    @property
    def counts(self) -> bool:
        return self.kind not in (UNJUDGED, UNOFFERED)


def case_of(number: int) -> GearedCase:
    """In turn a mechanism of pieces one after the other, and one of loops."""
    return looped_case(number) if number % 2 else geared_case(number)


def verdict(number: int, orders: int) -> Verdict:
    """On one mechanism in some orders of its file."""
    case = case_of(number)
    translate = partial(Verdict, number)
    reference = well_placed(case)
    if reference is None:
        with suppress(lw.LinkwrightError):
            lw.solve_forces(lw.solve_motion(lw.loads(case.text), times=TIMES))
        return translate(UNJUDGED, case.kinds)
    for order in range(orders):
        text = reordered(case.text, np.random.default_rng([number, order])) if order else case.text
        kind, lines = AGREES, tuple[str, ...]()
        try:
            lines = tuple(disagreements(case, reference, text))
            kind = "differs" if lines else AGREES
        except lw.LinkwrightError as error:
            if error.code in LACKING:
                return translate(UNOFFERED, case.kinds)
            kind, lines = "refused", (str(error),)
        except Exception:
            kind, lines = "crash", tuple(traceback.format_exc().splitlines()[-6:])
        if kind != AGREES:
            return translate(kind, case.kinds, (f"order {order}", *lines), text)
    return translate(AGREES, case.kinds)


def verdicts(seed: int, orders: int, workers: int) -> Iterator[Verdict]:
    """On one mechanism after the other, without end."""
    numbers, judge = from_here(seed * STRIDE), partial(verdict, orders=orders)
    if workers == 1:
        yield from map(judge, numbers)
        return
    with get_context("spawn").Pool(workers, signal.signal, (signal.SIGINT, signal.SIG_IGN)) as pool:
        while True:
            yield from pool.imap(judge, [next(numbers) for _ in range(16 * workers)])


def run(count: int, seed: int, orders: int, workers: int) -> int:
    """Judges until ``count`` mechanisms are compared."""
    kinds: Counter[str] = Counter()
    pieces: Counter[str] = Counter()
    began, code, compared = time.monotonic(), 0, 0
    for found in verdicts(seed, orders, workers):
        kinds[found.kind] += 1
        if found.counts:
            compared += 1
            pieces.update(found.pieces)
            if found.kind != AGREES:
                code = 1
                print(f"{found.number}: {found.kind}\n  " + "\n  ".join(found.lines) + f"\n{found.text}")
        if compared == count:
            break
    print(
        ", ".join(f"{n} {kind}" for kind, n in sorted(kinds.items())),
        f"in {orders} orders each, {time.monotonic() - began:.0f} s",
    )
    print("pieces:", ", ".join(f"{n} {kind}" for kind, n in sorted(pieces.items())))
    return code


def main() -> int:
    """Reads the options."""
    parser = argparse.ArgumentParser(prog="python -m tests.random_geared", description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=100, help="how many mechanisms (default 100)")
    parser.add_argument("--seed", type=int, default=1, help="which sequence of mechanisms (default 1)")
    parser.add_argument("--orders", type=int, default=1, help="orders of each file (default 1)")
    parser.add_argument("--workers", type=int, default=1, help="processes (default 1)")
    given = parser.parse_args()
    if min(given.count, given.orders, given.workers) < 1:
        parser.error("--count, --orders and --workers are numbers above zero")
    warnings.simplefilter("error")
    return run(given.count, given.seed, given.orders, given.workers)


if __name__ == "__main__":
    sys.exit(main())
