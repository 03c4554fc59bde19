"""The fewest layers, then the shortest pins, then plates as near as can be to the frame."""

from __future__ import annotations

from dataclasses import dataclass
from time import monotonic

from linkwright.layers.problem import Problem
from linkwright.layers.program import Answer, Program

#: Seconds after which a search tells what it has found so far.
TIME_LIMIT = 60.0


@dataclass(frozen=True)
class Search:
    """What a search came to: ``layer`` of every plate, None without; ``count`` of layers above the base.

    ``fewest``: whether it is proved that no fewer do, or without layers that there are none; ``shortest``: that no
    layers of that count have shorter pins.
    """

    layer: dict[str, int] | None
    count: int
    fewest: bool = True
    shortest: bool = True


def arrange(problem: Problem, time_limit: float = TIME_LIMIT) -> Search:
    """The layers of a problem, the best by proof unless the time is over before."""
    end = monotonic() + time_limit
    most, few = problem.most_layers, len(problem.plates)
    fewest = True
    for count in (*range(1, min(few, most) + 1), most, *range(few + 1, most)):
        answer = _solved(problem, count, end, best=count != most)
        if count == most and answer.layer is None:
            return Search(None, count, answer.proved)
        if answer.layer is not None and count != most:
            return Search(dict(answer.layer), count, fewest, answer.proved)
        fewest = fewest and (answer.proved or count == most)
    answer = _solved(problem, most, end, best=True)
    return Search(None if answer.layer is None else dict(answer.layer), most, fewest, answer.proved)


def has_layers(problem: Problem) -> bool:
    """Whether there are any layers at all; raises TimeoutError where a minute does not tell."""
    found = Program(problem, problem.most_layers).solve(TIME_LIMIT, best=False)
    if not found.proved:
        raise TimeoutError
    return found.layer is not None


def _solved(problem: Problem, count: int, end: float, *, best: bool) -> Answer:
    return Program(problem, count).solve(max(end - monotonic(), 0.0), best=best)
