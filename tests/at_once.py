"""Several pieces of work, all begun at the same moment."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from linkwright.errors import LinkwrightError


def at_once(*work: Callable[[], Any]) -> list[Any]:
    """What each piece of work gives, or the error that it raises, all begun at the same moment."""
    gate, found = threading.Barrier(len(work)), [None] * len(work)

    def run(place: int) -> None:
        gate.wait()
        try:
            found[place] = work[place]()
        except LinkwrightError as error:
            found[place] = error

    threads = [threading.Thread(target=run, args=(place,)) for place in range(len(work))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return found
