"""Chunks of designs on threads."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
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


def spread_over(count: int, size: int, threads: int, work: Callable[[int, int], None]) -> None:
    """Call ``work(first, after_last)`` for every chunk, on ``threads`` threads."""
    parts = list(chunks(count, size))
    if threads <= 1 or len(parts) == 1:
        for first, after in parts:
            work(first, after)
        return
    pool = _pool(threads, os.getpid())
    futures = [pool.submit(work, first, after) for first, after in parts]
    try:
        for future in futures:
            future.result()
    finally:
        for future in futures:
            future.cancel()
