"""Smallest gaps of random machines with random outlines, judged by shapely's distances in many positions.

    python -m tests.unit.collisions.against_shapely --count 1000 --seed 0 --workers 2

Positions are solved by the package, geometry is shapely's alone. Of every pair of outlines the distances in 7 200
positions, made smaller by golden section around the lowest ones, must agree with the smallest gap found: no collision
may be missed, and the gap must be there at the time that is named, but at ends of what is reached. Intervals below
a clearance must hold all the positions that are below it, and none that is not. Where a machine goes away without
bound, the gaps are those of the positions that are solved, and are compared in these. Exit code: 0 nothing wrong, 1
something wrong.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import combinations
from multiprocessing import get_context

import numpy as np
import shapely
from tests.unit.collisions.random_machines import random_machine

import linkwright as lw
from linkwright.analysis.analysis import Analysis
from linkwright.collisions.gaps import Gap, Moving, smallest_gaps
from linkwright.kinematics.placement import placements

POSITIONS, GOLDEN, MINIMA = 7_200, 20, 3
#: Largest difference, as share of the machine's size.
ALLOWED = 1e-6
RATIO = 0.5 * (5.0**0.5 - 1.0)


@dataclass
class Judged:
    """What became of a machine: ``wrong``: sentences; ``worst``: largest differences, as share of the size, of gaps
    from shapely's refined ones and from those at the time named, and the first in m."""

    seed: int
    kind: str
    pairs: int = 0
    overlaps: int = 0
    spans: int = 0
    worst: float = 0.0
    worst_there: float = 0.0
    worst_metres: float = 0.0
    seconds: tuple[float, float] = (0.0, 0.0)
    complete: bool = True
    exact: bool = True
    wrong: list[str] = field(default_factory=list)


def outlines(motion: lw.Motion, moving: Moving) -> list[tuple[np.ndarray, float]]:
    """Shapely's geometries of the pieces of a shape at all positions, and their radii; any where none is reached."""
    placed = placements(motion)[moving.carrier]
    place, turn = (np.nan_to_num(rows[:, 0] + 1j * rows[:, 1], nan=1.0) for rows in (placed.origin, placed.direction))
    found = []
    for piece in moving.shape.pieces:
        rings = [place[:, None] + turn[:, None] * ring for ring in piece.rings]
        corners = [np.stack([ring.real, ring.imag], axis=-1) for ring in rings]
        if piece.filled:
            loops = [shapely.linearrings(ring) for ring in corners]
            holes = np.stack(loops[1:], axis=-1) if len(loops) > 1 else None
            found.append((shapely.polygons(loops[0], holes=holes), piece.radius))
        elif len(piece.corners) > 1:
            found.append((shapely.linestrings(corners[0]), piece.radius))
        else:
            found.append((shapely.points(corners[0][:, 0]), piece.radius))
    return found


def distances(
    one: Sequence[tuple[np.ndarray, float]], other: Sequence[tuple[np.ndarray, float]], which: slice = slice(None)
) -> np.ndarray:
    """Gaps at positions, 0 where they overlap."""
    found = [shapely.distance(a[which], b[which]) - ra - rb for a, ra in one for b, rb in other]
    return np.maximum(np.min(found, axis=0), 0.0)


def judged_safely(seed: int) -> Judged:
    """The same; what is refused is wrong."""
    try:
        return judged(seed)
    except Exception as error:
        return Judged(seed, "error", wrong=[f"{seed}: {type(error).__name__}: {error}"])


def judged(seed: int, positions: int = POSITIONS) -> Judged:
    """A random machine: what the package finds against shapely."""
    machine = random_machine(seed)
    mechanism, size, clearance = machine.mechanism, machine.mechanism.size, machine.clearance
    result = Judged(seed, machine.kind)
    motion = lw.solve_motion(mechanism, failures="mark")
    if not motion.ok.any():
        return result
    pairs = [*combinations(machine.shapes, 2)]
    began = time.perf_counter()
    gaps = smallest_gaps(motion, pairs, clearance=clearance, spans=True)
    needed = time.perf_counter() - began
    result.exact = gaps[0].exact
    dense = lw.solve_motion(mechanism, steps=positions, failures="mark") if result.exact else motion
    resolver = Analysis.of(motion).resolver
    good = dense.ok if resolver.complete or not result.exact else dense.ok & resolver.reached(dense.time)
    result.complete = bool(good.all())
    began = time.perf_counter()
    placed = {id(each): outlines(dense, each) for each in machine.shapes}
    found = [np.where(good, distances(placed[id(a)], placed[id(b)]), np.inf) for a, b in pairs]
    result.seconds = needed, time.perf_counter() - began
    between = Between(motion, machine.shapes, pairs)
    refined = _refined(between, dense, found) if result.exact else [np.inf] * len(pairs)
    there = between.distances(range(len(pairs)), np.array([gap.time for gap in gaps]))
    for k, gap in enumerate(gaps):
        name = f"{seed} ({machine.kind}) pair {k}"
        least = min(float(found[k].min()), refined[k])
        result.pairs += 1
        result.overlaps += gap.size == 0.0
        result.spans += len(gap.spans)
        off = gap.size - least if result.complete else max(gap.size - least, 0.0)
        result.worst, result.worst_metres = max(result.worst, abs(off) / size), max(result.worst_metres, abs(off))
        if least == 0.0 and gap.size > 0.0:
            result.wrong.append(f"{name}: collision missed, gap {gap.size}")
        elif abs(off) > ALLOWED * size:
            result.wrong.append(f"{name}: gap {gap.size}, shapely {least}, size {size}")
        if np.isfinite(there[k]) and result.exact and not between.at_end(gap.time):
            result.worst_there = max(result.worst_there, abs(gap.size - there[k]) / size)
            if abs(gap.size - there[k]) > ALLOWED * size:
                result.wrong.append(f"{name}: gap {gap.size}, at its time {gap.time} there is {there[k]}")
        result.wrong += [f"{name}: {text}" for text in _spans_wrong(gap, dense.time, found[k], clearance, size)]
    return result


class Between:
    """Pairs of shapes between the positions of a motion, in the same assembly."""

    def __init__(self, motion: lw.Motion, shapes: Sequence[Moving], pairs: Sequence[tuple[Moving, Moving]]) -> None:
        resolver = Analysis.of(motion).resolver
        self._solve, self._slack = resolver.motion, 1e-6 * float(np.ptp(motion.time))
        self._ends = np.array([each for each, _ in resolver.edges])
        self._shapes, self._pairs = shapes, pairs

    def at_end(self, time: float) -> bool:
        """Whether an end of what is reached is there: places are known to the root of its time's digits only."""
        return bool((np.abs(self._ends - time) < self._slack).any())

    def distances(self, owner: Sequence[int], times: np.ndarray) -> np.ndarray:
        """Gaps of pairs by their numbers at a time each; NaN out of reach."""
        motion = self._solve(times)
        placed = {id(each): outlines(motion, each) for each in self._shapes}
        pairs = [self._pairs[k] for k in owner]
        rows = [distances(placed[id(a)], placed[id(b)], slice(row, row + 1))[0] for row, (a, b) in enumerate(pairs)]
        return np.where(motion.ok, rows, np.nan)


def _refined(between: Between, dense: lw.Motion, found: Sequence[np.ndarray]) -> list[float]:
    """The lowest minima made smaller by golden section between the positions next to them."""
    step = float(dense.time[1] - dense.time[0])
    low: list[float] = []
    owner: list[int] = []
    for k, values in enumerate(found):
        before, behind = np.roll(values, 1), np.roll(values, -1)
        at = np.flatnonzero((values <= before) & (values <= behind) & np.isfinite(values) & (values > 0.0))
        at = at[(at > 0) & (at < len(values) - 1)]
        for index in at[np.argsort(values[at], kind="stable")][:MINIMA]:
            low.append(float(dense.time[index]) - step)
            owner.append(k)
    least = [float(values.min()) for values in found]
    if not low:
        return least
    begin = np.array(low)
    end = begin + 2.0 * step

    def at_times(times: np.ndarray) -> np.ndarray:
        return np.nan_to_num(between.distances(owner, times), nan=np.inf)

    inner, outer = end - RATIO * (end - begin), begin + RATIO * (end - begin)
    first, second = at_times(inner), at_times(outer)
    for _ in range(GOLDEN):
        left = first < second
        end, begin = np.where(left, outer, end), np.where(left, begin, inner)
        new = np.where(left, end - RATIO * (end - begin), begin + RATIO * (end - begin))
        values = at_times(new)
        inner, outer = np.where(left, new, outer), np.where(left, inner, new)
        first, second = np.where(left, values, second), np.where(left, first, values)
    for row, k in enumerate(owner):
        least[k] = min(least[k], float(first[row]), float(second[row]))
    return least


def _spans_wrong(gap: Gap, time: np.ndarray, values: np.ndarray, clearance: float, size: float) -> list[str]:
    """Positions that the spans have wrong."""
    asked = (values < clearance) if clearance > 0.0 else values <= 0.0
    held, near = np.zeros(len(time), dtype=bool), np.zeros(len(time), dtype=bool)
    slack = 1e-8 * float(np.ptp(time))
    for begin, end in gap.spans:
        held |= (time >= begin) & (time <= end)
        near |= (np.abs(time - begin) < slack) | (np.abs(time - end) < slack)
    wrong = (asked != held) & np.isfinite(values) & ~near & (np.abs(values - clearance) > 1e-7 * size)
    first = int(wrong.argmax())
    return [f"spans {gap.spans[:3]} at {time[first]}: gap {values[first]}, {clearance} wanted"] if wrong.any() else []


def main(arguments: Sequence[str]) -> int:
    """Judges as many machines as wanted."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0, help="the first one")
    parser.add_argument("--workers", type=int, default=2)
    asked = parser.parse_args(arguments)
    seeds = range(asked.seed, asked.seed + asked.count)
    done: list[Judged] = []
    with get_context("fork").Pool(asked.workers) as pool:
        for result in pool.imap_unordered(judged_safely, seeds, chunksize=1):
            done.append(result)
            for text in result.wrong:
                print(text, flush=True)
            if len(done) % 50 == 0:
                print(len(done), "machines", flush=True)
    print(
        Counter(each.kind for each in done),
        f"{sum(not each.complete for each in done)} reached in part",
        f"{sum(not each.exact for each in done)} in positions alone",
    )
    print(sum(each.pairs for each in done), "pairs", sum(each.overlaps for each in done), "overlap")
    print("spans", sum(each.spans for each in done))
    print("largest difference, share of the size", max(each.worst for each in done))
    print("largest difference, m", max(each.worst_metres for each in done))
    print("largest difference at the time named", max(each.worst_there for each in done))
    ours, theirs = (sum(each.seconds[k] for each in done) for k in (0, 1))
    print(f"seconds: ours {ours:.1f}, shapely {theirs:.1f}")
    wrong = sum(bool(each.wrong) for each in done)
    print("wrong", wrong)
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
