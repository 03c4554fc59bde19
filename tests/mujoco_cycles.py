"""One cycle in MuJoCo of every gallery machine with one input: how far its loops open, and how exact its points are.

    python -m tests.mujoco_cycles                      all of them, as exported without options
    python -m tests.mujoco_cycles --steps 1000         with so many time steps per cycle
    python -m tests.mujoco_cycles --loops connect kite some of them, with another way of closing

Needs MuJoCo (`pip install mujoco`). Exit code: 0 all that MuJoCo can carry are within 0.01 mm, 1 not.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter

import numpy as np
from tests import store

import linkwright as lw

#: Largest gap of a loop, and largest distance of a point from its exact place, m.
GOAL = 1e-5
#: Code of the refusal of machines with cams, which MuJoCo does not carry.
CAM = "joints.cam_sums"


def machines(names: list[str]) -> list[str]:
    """Gallery machines with one input."""
    return [name for name in names or store.names() if len(store.machine(name).drivers) == 1]


def ways(found: lw.MujocoLoops) -> str:
    """What closes the loops, with how many of each."""
    counts = Counter(each.closed_by if each.degree is None else f"joint({each.degree})" for each in found.joints)
    return ", ".join(f"{count} {way}" if count > 1 else way for way, count in counts.items())


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--steps", type=int, help="time steps per cycle (default: those of the export)")
    parser.add_argument("--loops", default="auto")
    parser.add_argument("--closure", type=float, default=GOAL, help="largest gap of couplings, m")
    asked = parser.parse_args(arguments)
    print(
        f"{'machine':30} {'closed by':24} {'gap, mm':>9} {'at':16} {'off, mm':>9} {'point':18} {'steps':>6} {'s':>4}"
    )
    missed = 0
    for name in machines(asked.names):
        motion, begun = store.motion(name), time.perf_counter()
        duration = motion.positions.period or float(np.ptp(motion.time))
        step = duration / asked.steps if asked.steps else None
        try:
            found = lw.mujoco_loops(motion, loops=asked.loops, closure=asked.closure, timestep=step, simulate=True)
        except lw.LinkwrightError as refusal:
            print(f"{name:30} not exported: {refusal}")
            missed += refusal.code != CAM
            continue
        cycle = found.cycle
        assert cycle is not None
        missed += max(cycle.gap.distance, cycle.off.distance) > GOAL
        gap, off = 1e3 * cycle.gap.distance, 1e3 * cycle.off.distance
        print(
            f"{name:30} {ways(found):24} {gap:9.1e} {cycle.gap.name:16} {off:9.1e} {cycle.off.name:18} "
            f"{cycle.steps:6} {time.perf_counter() - begun:4.1f}",
            flush=True,
        )
    print(f"{missed} missed the goal of {1e3 * GOAL:g} mm")
    return int(missed > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
