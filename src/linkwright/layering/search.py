"""The fewest layers, then the shortest pins, then plates as near as can be to the frame."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from time import monotonic

from linkwright.layering.orders import any_layers
from linkwright.layering.problem import Problem
from linkwright.layering.program import Program

#: Seconds after which a search gives what it has found so far.
TIME_LIMIT = 30.0


@dataclass(frozen=True)
class Search:
    """What a search came to: the layer of every plate, ``count`` of layers above the base.

    ``fewest``: whether it is proved that fewer are not enough; ``shortest``: that with so many no pins are shorter.
    """

    layer: Mapping[str, int]
    count: int
    fewest: bool = True
    shortest: bool = True


def arrange(problem: Problem, time_limit: float = TIME_LIMIT) -> Search | None:
    """The best layers, by proof unless the time is over before; None where there are none.

    Raises:
        Undecided: the time is over before any are found.
    """
    until = monotonic() + time_limit
    some = any_layers(problem, until)
    if some is None:
        return None
    highest, fewest = max(some.values(), default=0), True
    for count in range(highest + 1):
        answer = Program(problem, count).solve(max(until - monotonic(), 0.0))
        if answer.layer is not None:
            return Search(answer.layer, count, fewest, answer.proved)
        fewest = fewest and answer.proved
    return Search(some, highest, fewest=False, shortest=False)
