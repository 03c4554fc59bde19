"""How far long work has come, on the standard error where that is a terminal."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from linkwright.cli.session import Session
from linkwright.core.progress import Progress, reporting
from linkwright.words import Message, Say, _

BAR = 24
CLEAR = "\r\x1b[K"
#: Seconds of work after which the time that is left is estimated.
KNOWN = 1.0


@contextmanager
def progress(say: Say, what: Message) -> Iterator[Progress | None]:
    """A function that is told (done, total) and shows a bar with the time that is left; None where nobody would see
    it. All long work within the block tells it as well.

    The bar is wiped when all is done, also where the work is interrupted.
    """
    stream = sys.stderr
    if not stream.isatty():
        yield None
        return
    begun, before, title = time.monotonic(), 0, say(what)

    def report(done: int, total: int) -> None:
        nonlocal begun, before
        full = BAR * done // max(total, 1)
        bar = f"{title} [{'#' * full}{' ' * (BAR - full)}] {done}/{total}"
        now = time.monotonic()
        if done < before:  # the next one of several works
            begun = now
        before, spent = done, now - begun
        if done and spent > KNOWN:
            bar += "  " + say(_("about {time} left", time=_time(spent * (total - done) / done)))
        stream.write(CLEAR + (bar if done < total else ""))  # results may be shown at once
        stream.flush()

    try:
        stream.write(f"{CLEAR}{title} …")
        stream.flush()
        with reporting(report):
            yield report
    finally:
        stream.write(CLEAR)
        stream.flush()


@contextmanager
def kept(
    state: str | None, name: str, asked: Iterable[object], session: Session
) -> Iterator[Progress | None]:
    """``kept_in`` of a command, with a bar; an interruption names the file that is left."""
    from linkwright.designs.finished_parts import RESUME, Interrupted, kept_in

    try:
        with (
            progress(session.say, _("computing designs")) as report,
            kept_in(state, name, *asked, progress=report),
        ):
            yield report
    except Interrupted as stopped:
        session.tell(session.say(RESUME.format(path=stopped.state)))
        raise


def _time(seconds: float) -> str:
    """A time as it is estimated: seconds, minutes, hours."""
    for unit, size in (("h", 3600.0), ("min", 60.0)):
        if seconds >= 2 * size:
            return f"{seconds / size:.0f} {unit}"
    return f"{max(seconds, 1.0):.0f} s"
