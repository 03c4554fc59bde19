"""A loop of a test that must have something to look at."""

from collections.abc import Iterable
from typing import TypeVar

Thing = TypeVar("Thing")


def every(things: Iterable[Thing], *, least: int = 1) -> list[Thing]:
    """The things, of which there are ``least`` or more: a loop over none would check nothing."""
    found = list(things)
    assert len(found) >= least, f"{len(found)} things to look at, where {least} or more are expected"
    return found
