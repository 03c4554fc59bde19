"""Lines of programs: an operation and the lines that it takes."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable
from typing import NamedTuple

#: Operations that yield a truth value instead of a number.
COMPARISONS = frozenset({"less", "less_equal", "and", "or", "not"})
COMMUTATIVE = frozenset({"add", "mul", "and", "or"})


class Node(NamedTuple):
    """One line of a program: an input, a constant, or an operation on earlier lines.

    ``name``: of an input, or of the table of a ``lookup``, whose ``constant`` is the order of its derivative.
    """

    op: str
    args: tuple[int, ...]
    constant: float
    name: str
    varies: bool  # differs from position to position (else one value per design)


#: The fields of a :class:`Node` as a plain tuple: one of things that cannot refer to others is no longer looked at by
#: the garbage collector, a named one is for as long as it lives.
Entry = tuple[str, tuple[int, ...], float, str, bool]


def needed(arguments: Callable[[int], Iterable[int]], wanted: Iterable[int], stop: Container[int] = ()) -> list[int]:
    """The lines that the wanted ones are found from, in order; what is behind ``stop`` is left out.

    ``arguments``: the numbers of the lines that a line takes.
    """
    found = set(wanted)
    stack = list(found)
    while stack:
        index = stack.pop()
        if index not in stop:
            for arg in arguments(index):
                if arg not in found:
                    found.add(arg)
                    stack.append(arg)
    return sorted(found)
