"""A small cache of what was made for an object."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

Owner = TypeVar("Owner")
Made = TypeVar("Made")


class Recent(Generic[Owner, Made]):
    """The last ``limit`` results, by the identity of their owner and a key.

    Owners are compared by identity, so that a large one is not hashed; it stays alive as long
    as its result. Safe among threads; a result may be made twice, and all get the first. A copy begins empty.
    """

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._entries: OrderedDict[tuple[int, Hashable], tuple[Owner, Made]] = OrderedDict()
        self._lock = threading.Lock()

    def __reduce__(self) -> tuple[type[Recent[Owner, Made]], tuple[int]]:
        return type(self), (self._limit,)

    def get(self, owner: Owner, key: Hashable, make: Callable[[], Made]) -> Made:
        """The result for ``owner`` and ``key``, made where it is not there."""
        place = (id(owner), key)
        with self._lock:
            if place in self._entries:
                self._entries.move_to_end(place)
                return self._entries[place][1]
        made = make()
        with self._lock:
            made = self._entries.setdefault(place, (owner, made))[1]
            while len(self._entries) > self._limit:
                self._entries.popitem(last=False)
        return made
