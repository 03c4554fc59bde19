"""How far long work has come, on the standard error where that is a terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

Report = Callable[[int, int], None]
BAR = 24
CLEAR = "\r\x1b[K"


@contextmanager
def progress(what: str) -> Iterator[Report | None]:
    """A function that is told (done, total) and shows a bar; None where nobody would see it.

    The bar is wiped when all is done, also where the work is interrupted.
    """
    stream = sys.stderr
    if not stream.isatty():
        yield None
        return

    def report(done: int, total: int) -> None:
        full = BAR * done // max(total, 1)
        bar = f"{what} [{'#' * full}{' ' * (BAR - full)}] {done}/{total}"
        stream.write(CLEAR + (bar if done < total else ""))  # results may be shown at once
        stream.flush()

    try:
        yield report
    finally:
        stream.write(CLEAR)
        stream.flush()
