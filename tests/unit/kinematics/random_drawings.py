"""Random machines whose drawings are off: the assembly that is taken must be the one that was drawn.

    python -m tests.unit.kinematics.random_drawings --count 200 --off 2

Every point is moved by a normal deviate of so many millimetres (machines of about a metre). From the assembly that
the drawing shows the drivers are led to the inputs of the exact drawing, where the exact assembly must be met. A
drawing may be refused where a dyad cannot be put together at its inputs, which it says.

Exit code: 0 nothing wrong, 1 another assembly was taken, 2 wrong use.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from dataclasses import replace

import numpy as np
from tests.reference.general_case import general_case

import linkwright as lw
from linkwright.kinematics.solver import MotionSolver

#: Largest gap, rad or share of the size, to the exact assembly.
MET = 1e-8


def verdict(seed: int, off: float) -> str:
    """right, other, refused, barred on the way, or not judged where no group is without closed form."""
    text = general_case(seed).text
    if "drawing: {" not in text:
        return "not judged"
    try:
        mechanism = lw.loads(text)
        solver = MotionSolver(mechanism)
        if not solver.motion.next_states:
            return "not judged"
        exact = solver.tracker()
        goal = exact.drawn_inputs
    except lw.LinkwrightError:
        return "not judged"
    rng = np.random.default_rng([seed, 5])
    moved = {name: (x + rng.normal(0, off), y + rng.normal(0, off)) for name, (x, y) in mechanism.drawing.items()}
    rough = MotionSolver(replace(mechanism, drawing=moved)).tracker()
    try:
        start = rough.drawn
    except lw.LinkwrightError:
        return "refused"
    way = rough.drawn_inputs + rough.nearest_drive(goal - rough.drawn_inputs)
    branch = rough.between(rough.drawn_inputs, way, start)
    if not branch.complete or branch.last is None:
        return "barred on the way"
    gap = rough.nearest_way(branch.last - exact.drawn) / rough.groups.scale
    return "right" if float(np.abs(gap).max()) < MET else "other"


def main() -> int:
    """Reads the options, and judges so many drawings."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.unit.kinematics.random_drawings", description=__doc__.split("\n")[0]
    )
    parser.add_argument("--count", type=int, default=50, help="how many drawings (default 50)")
    parser.add_argument("--first", type=int, default=0, help="the first seed (default 0)")
    parser.add_argument("--off", type=float, default=2.0, help="standard deviation, mm (default 2)")
    given = parser.parse_args()
    found: Counter[str] = Counter()
    seed = given.first
    while found.total() - found["not judged"] < given.count:
        kind = verdict(seed, 1e-3 * given.off)
        found[kind] += 1
        if kind not in ("right", "not judged"):
            print(f"{seed}: {kind}")
        seed += 1
    print(", ".join(f"{count} {kind}" for kind, count in sorted(found.items())))
    return int(found["other"] > 0)


if __name__ == "__main__":
    sys.exit(main())
