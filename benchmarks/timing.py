"""Candidates timed in turns in one process."""

from __future__ import annotations

import gc
import statistics
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

Run = Callable[[], object]
Clock = Callable[[], float]


@dataclass(frozen=True)
class Candidate:
    """Something to be timed. ``share``: the part of the work that one call does (1 for all of it)."""

    name: str
    run: Run
    share: float = 1.0
    note: str = ""


@dataclass(frozen=True)
class Timing:
    """Seconds for the whole work, one per round."""

    name: str
    seconds: tuple[float, ...]
    note: str = ""

    @property
    def median(self) -> float:
        """Median over the rounds."""
        return statistics.median(self.seconds)

    @property
    def best(self) -> float:
        """The shortest round."""
        return min(self.seconds)


class Rounds:
    """Timings of candidates that took turns: round k of one stands beside round k of the others."""

    def __init__(self, timings: Sequence[Timing]) -> None:
        self.timings = {timing.name: timing for timing in timings}

    def __contains__(self, name: str) -> bool:
        return name in self.timings

    def ratio(self, slow: str, fast: str) -> float:
        """How many times longer ``slow`` takes than ``fast``: the median over the rounds."""
        pairs = zip(self.timings[slow].seconds, self.timings[fast].seconds, strict=True)
        return statistics.median(a / b for a, b in pairs)

    def best_ratio(self, slow: str, fast: str) -> float:
        """The same from the shortest rounds."""
        return self.timings[slow].best / self.timings[fast].best


def in_turns(
    candidates: Sequence[Candidate], rounds: int, slice_s: float, clock: Clock = time.perf_counter
) -> Rounds:
    """Times every candidate once per round for about ``slice_s`` seconds; the order moves on by one each round.

    ``clock``: ``time.process_time`` for work of one thread, which other processes then hardly disturb.
    """
    repeats = {each.name: _repeats(each.run, slice_s, clock) for each in candidates}
    seconds: dict[str, list[float]] = {each.name: [] for each in candidates}
    gc.collect()
    for turn in range(rounds):
        at = turn % len(candidates)
        for each in (*candidates[at:], *candidates[:at]):
            seconds[each.name].append(_timed(each.run, repeats[each.name], clock) / each.share)
    return Rounds([Timing(each.name, tuple(seconds[each.name]), each.note) for each in candidates])


def _timed(run: Run, repeats: int, clock: Clock) -> float:
    run()
    began = clock()
    for _ in range(repeats):
        run()
    return (clock() - began) / repeats


def _repeats(run: Run, slice_s: float, clock: Clock) -> int:
    run()
    single = _timed(run, 1, clock)
    return max(1, min(100_000, int(slice_s / max(single, 1e-7))))


def milliseconds(timings: Mapping[str, Sequence[float]]) -> dict[str, float]:
    """Medians in milliseconds."""
    return {name: 1e3 * statistics.median(values) for name, values in timings.items()}
