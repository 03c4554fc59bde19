"""Chunks of designs on threads."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor, wait
from functools import cache

Chunk = tuple[int, int]


def cores() -> int:
    """Processor cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


@cache
def _pool(threads: int, process: int) -> ThreadPoolExecutor:
    """Threads of one process; a forked process does not inherit them."""
    return ThreadPoolExecutor(threads, thread_name_prefix="linkwright")


def chunks(count: int, size: int) -> Iterator[Chunk]:
    """(first, after last) of chunks of ``size``; the last may be shorter."""
    return ((first, min(first + size, count)) for first in range(0, count, size))


def tapering(count: int, largest: int, minimum: int, threads: int) -> Iterator[Chunk]:
    """Chunks of at most ``largest`` that grow smaller to the end, by multiples of ``minimum``.

    So the threads leave off at nearly the same time.
    """
    first = 0
    while first < count:
        share = (count - first) // (2 * threads)
        size = min(largest, max(minimum, share - share % minimum))
        yield first, min(first + size, count)
        first += size


def _next(waiting: deque[Chunk]) -> Chunk | None:
    """The next chunk; None when there is none, or another thread has taken the last one."""
    try:
        return waiting.popleft()
    except IndexError:
        return None


def spread_over(
    count: int, size: int, threads: int, work: Callable[[int, int], None], *, minimum: int | None = None
) -> None:
    """Call ``work(first, after_last)`` for every chunk, on ``threads`` threads, this one among them.

    Chunks have ``size``, with ``minimum`` smaller ones at the end. The first exception is raised, once all threads
    have left off; chunks not begun by then are left out.
    """
    if not count:
        return
    if count <= (minimum or size) or (threads <= 1 and count <= size):
        work(0, count)
        return
    tapers = minimum is not None and threads > 1
    waiting = deque(tapering(count, size, minimum or size, threads) if tapers else chunks(count, size))

    def drain() -> None:
        try:
            while (chunk := _next(waiting)) is not None:
                work(*chunk)
        except BaseException:
            waiting.clear()
            raise

    helpers = min(threads, len(waiting)) - 1
    if helpers <= 0:
        drain()
        return
    pool = _pool(threads - 1, os.getpid())
    futures = [pool.submit(drain) for _ in range(helpers)]
    try:
        drain()
    finally:
        begun = [future for future in futures if not future.cancel()]
        wait(begun)
    for future in begun:
        future.result()
