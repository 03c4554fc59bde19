"""How fast this processor is, so that an answer at once means a share of its work and no time by the clock."""

import time

#: Plain loops of ``STEPS`` that two seconds held on the machine on which the bound was set.
LOOPS = 75
STEPS = 300_000


def at_once() -> float:
    """Processor time, s, that the work of two seconds there takes here and now: the pace of a processor changes."""
    least = float("inf")
    for _ in range(3):
        began, total = time.process_time(), 0
        for number in range(STEPS):
            total += number * number % 7
        least = min(least, time.process_time() - began)
    return LOOPS * least
