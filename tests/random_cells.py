"""Each kind of joint on each kind of group, at random, against the independent reference.

    python -m tests.random_cells --seeds 10

Exit code: 0 nothing wrong, 1 something wrong, 2 wrong use. Model files of what fails are printed.
"""

from __future__ import annotations

import argparse
import sys
import warnings
from collections import Counter

from tests.random_geared import verdict
from tests.reference import joint_cells


def main() -> int:
    """Reads the options, and judges all cells."""
    parser = argparse.ArgumentParser(prog="python -m tests.random_cells", description=__doc__.split("\n")[0])
    parser.add_argument("--seeds", type=int, default=10, help="how many machines of each cell (default 10)")
    parser.add_argument("--first", type=int, default=0, help="the first seed (default 0)")
    given = parser.parse_args()
    warnings.simplefilter("error")
    kinds: Counter[str] = Counter()
    for group in joint_cells.GROUPS:
        for kind in joint_cells.JOINTS:
            for seed in range(given.first, given.first + given.seeds):
                case = joint_cells.cell(group, kind, seed)
                found, lines = verdict(case)
                kinds[found] += 1
                if found not in ("agrees", "not judged"):
                    print(f"{group}, {kind}, {seed}: {found}\n  " + "\n  ".join(lines) + f"\n{case.text}")
    print(", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items())))
    return int(kinds.total() > kinds["agrees"] + kinds["not judged"])


if __name__ == "__main__":
    sys.exit(main())
