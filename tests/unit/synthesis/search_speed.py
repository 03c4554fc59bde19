"""``python -m tests.unit.synthesis.search_speed``: a free curve searched by one worker of a cluster, and by two."""

from __future__ import annotations

import math
import os
import time

import distributed
import numpy as np

import linkwright as lw
from linkwright.synthesis.free_curve.search import Search
from linkwright.synthesis.free_curve.target import Target

OPTIONS = {"threads_per_worker": 1, "dashboard_address": None, "processes": True}


def search_speed(seconds: float) -> None:
    """Attempts of two workers against those of one, in the time that a clock gives a search, and for each processor
    second that the workers had of it: what else runs on the machine changes the first number only."""
    target = Target(np.array([9, 9 + 17j, 6j, 13 + 6j]), False, math.radians(20.0), 6.0)
    attempts, processor, load = list[int](), list[float](), os.getloadavg()[0]
    for workers in (1, 2):
        with (
            distributed.LocalCluster(n_workers=workers, **OPTIONS) as cluster,
            distributed.Client(cluster) as client,
            lw.on_cluster(client),
        ):
            Search(target, 12, 0.2 * seconds, 0).run()
            before = sum(client.run(time.process_time).values())
            search = Search(target, 12, seconds, 0)
            search.run()
            attempts.append(search.attempts)
            processor.append(sum(client.run(time.process_time).values()) - before)
    (one, two), (first, second) = attempts, processor
    print(
        f"free curve, {seconds:g} s: one worker {one} attempts in {first:.1f} processor s, "
        f"two {two} in {second:.1f}; ratio {two / one:.2f}, "
        f"for each processor second {two * first / one / second:.2f}; "
        f"load before {load:.1f} on {os.cpu_count()} cores",
        flush=True,
    )


if __name__ == "__main__":
    search_speed(20.0)
