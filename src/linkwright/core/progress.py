"""How far long work has come: a callback, given to one function or to all that is called within a block."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

#: Called with what is done and what there is to do.
Progress = Callable[[int, int], None]
#: Items of the first piece of work that is timed, seconds that a piece should take, and by how much pieces grow.
PROBE, PACE, GROWTH = 16, 0.4, 8
_current: ContextVar[Progress | None] = ContextVar("progress", default=None)


@contextmanager
def reporting(progress: Progress | None) -> Iterator[None]:
    """Within it all long work tells ``progress`` how far it is: called with (done, of how many), often and in order.

    Sweeps, studies and tolerances count designs, syntheses steps, comparisons machines, validations cases, courses
    variants. What ``progress`` raises stops the work. A function's own ``progress`` goes before it.
    """
    token = _current.set(progress)
    try:
        yield
    finally:
        _current.reset(token)


def current_progress() -> Progress | None:
    """What the surrounding ``reporting`` tells; None: nobody asks."""
    return _current.get()


def part_of(progress: Progress | None, number: int, parts: int) -> Progress | None:
    """What one of several parts of equal weight tells, ``number`` from 0."""
    if progress is None or parts == 1:
        return progress
    return lambda done, total: progress((number * total + done) // parts, total)


def paced(count: int) -> Iterator[tuple[int, int]]:
    """First and last of pieces of some work: a small one that is timed, then such as take ``PACE`` seconds."""
    first, size = 0, PROBE
    while first < count:
        begun = time.perf_counter()
        last = min(first + size, count)
        yield first, last
        taken = max(time.perf_counter() - begun, 1e-6)
        first, size = last, max(1, min(GROWTH * size, int(size * PACE / taken)))
