"""Work in numbers of calls: the same on every machine, where a time is not."""

import cProfile
from collections.abc import Callable
from typing import TypeVar

Answer = TypeVar("Answer")

#: Calls that some two seconds of this program's work hold (``python -m tests.large_inputs`` takes the times).
AT_ONCE = 10_000_000


def counted(work: Callable[[], Answer]) -> tuple[Answer, int]:
    """What ``work`` returns, and how often functions, of Python and of C, are called for it in this thread."""
    profile = cProfile.Profile()
    answer = profile.runcall(work)
    return answer, sum(entry.callcount for entry in profile.getstats())
