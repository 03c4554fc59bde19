"""Work in numbers of calls: the same on every machine, where a time is not."""

import cProfile
from collections.abc import Callable

#: Calls that some two seconds of this program's work hold (``python -m tests.large_inputs`` takes the times).
AT_ONCE = 10_000_000


def calls(work: Callable[[], object]) -> int:
    """How often functions, of Python and of C, are called while ``work`` runs in this thread."""
    profile = cProfile.Profile()
    profile.runcall(work)
    return sum(entry.callcount for entry in profile.getstats())
