"""The search: fewest joints first, each level from its atlas and from the designs of the levels below.

A level lets many starts from its atlas descend, the best of them further, and keeps a pool of good designs of
different structure that err in different places. Until its share of the time is over, an attempt shakes a member of
the pool, or hangs one more dyad on a member of the pools below, parts joints while there is room, and descends.
Eight-bars of 8 joints are a level of their own beside the six-bars. A pool soon turns about what it has found, so all
levels begin again in rounds, from other starts; at last the designs of all rounds go on together. The best are
polished at fine positions, with the penalties weighted so that the demands hold.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import field, replace
from itertools import islice
from typing import NamedTuple, TypeVar

import numpy as np

from linkwright.core.dataclass import dataclass
from linkwright.engine.threads import cores
from linkwright.synthesis.free_curve.atlas import atlas
from linkwright.synthesis.free_curve.kernels import FAR
from linkwright.synthesis.free_curve.linkages import Placed
from linkwright.synthesis.free_curve.moves import shaken, with_dyad, with_joint
from linkwright.synthesis.free_curve.nodes import Design, Draw
from linkwright.synthesis.free_curve.target import COARSE, FINE, MIDDLE, Fineness, Target

#: Most joints of a four-bar, six-bar, eight-bar and of any linkage.
JOINTS = (5, 8, 10, 12)
T = TypeVar("T")


class Level(NamedTuple):
    """Most joints, number of its atlas, its part of the time, and whether its linkages grow from none with fewer."""

    joints: int
    atlas: int | None
    part: float
    apart: bool = False


SIX_BARS, SLIDING = 1, 4
ONE_DYAD = 0, SLIDING
#: Eight-bars of 8 joints have a pool apart from six-bars, linkages of one sliding dyad from four-bars, as in one pool
#: each would crowd out the other.
LEVELS = (
    Level(5, 0, 0.5), Level(5, SLIDING, 0.5, apart=True), Level(8, SIX_BARS, 3.5),
    Level(8, 3, 2.5, apart=True), Level(9, 2, 2.5), Level(10, 2, 3.5), Level(12, None, 7.0),
)  # fmt: skip
#: Starts that begin together, how many of all descend further, and their share of a level's time.
SOME, CHOSEN, STARTING = 200, 50, 0.5
#: What share of the drawn starts goes on after each step, so many steps (all of the nearest, which come first).
BEGUN = ((0.5, 60, COARSE), (0.25, 30, MIDDLE))
#: Processor seconds of a level with part 1 in a round of all levels; shares of the time after which the designs of
#: the rounds go on together, and after which the best are polished.
ROUND, MERGED, ENDED = 4.0, 0.85, 0.96
POOL, BATCH = 30, 0.2
#: Chance that a design with room for one more joint gets one.
PARTED = 0.8
#: Joints that one more dyad brings: its pin and its point of a link, or a pivot of its own as well.
HUNG = 2, 3
#: Dyads drawn of which a promising one is taken.
DRAWS = 96
#: Share of the attempts that close that goes on after each of two steps, among this many recent ones.
GOES_ON, RECENT = (0.5, 0.25), 200
#: Designs err alike whose misses have a product above this; as many of them stay in a pool.
NICHE, CROWD = 0.9, 4
#: Weight of the penalties in the descent after which a design comes into a pool.
STRICT = 10.0
#: Weight of the penalties, and the angle (rad) above the least one, in the steps of the polish; the angle where a
#: demand is lacking after them.
POLISH = ((10.0, 0.005), (300.0, 0.003), (10000.0, 0.0015))
LACKING = 0.003, 0.003, 0.006


@dataclass
class Pool:
    """The best designs so far, few of one structure or erring alike, none twice."""

    designs: list[Design] = field(default_factory=list)
    tried: tuple[deque[float], ...] = field(
        default_factory=lambda: tuple(deque(maxlen=RECENT) for _ in GOES_ON)
    )

    def promises(self, step: int, value: float) -> bool:
        """Whether a descent goes on after a step: it is among the best share of the recent ones, or in the pool."""
        recent = self.tried[step]
        recent.append(value)
        return value < self.worst or sum(each < value for each in tuple(recent)) < GOES_ON[step] * len(recent)

    def add(self, design: Design) -> None:
        """Takes a design in where it is good and different enough in structure and in where it errs."""
        better = [one for one in self.designs if one.value <= design.value]
        if not design.value < self.worst or any(_same(one, design) for one in better):
            return
        kept: list[int] = []
        alike: dict[tuple[bytes, bool], int] = {}
        worse = [one for one in self.designs[len(better) :] if not _same(design, one)]
        order = [*better, design, *worse]
        errs = np.array([each.misses for each in order])
        near = (errs @ errs.T > NICHE).tolist()
        for row, each in enumerate(order):
            key = each.nodes.tobytes(), each.mirror
            most = 12 if each.joints == JOINTS[0] else 3
            if alike.get(key, 0) < most and sum(near[row][k] for k in kept) < CROWD:
                kept.append(row)
                alike[key] = alike.get(key, 0) + 1
            elif each is design:
                return
        self.designs = [order[row] for row in kept[:POOL]]

    @property
    def worst(self) -> float:
        """What a design must better."""
        return self.designs[-1].value if len(self.designs) == POOL else 0.9 * FAR

    def pick(self, draw: Draw) -> Design:
        """A design, the better the likelier."""
        return self.designs[min(int(draw.exponential(6)), len(self.designs) - 1)]


def _best(designs: list[Design], count: int) -> list[Design]:
    return sorted(designs, key=lambda each: each.value)[:count]


def _same(a: Design, b: Design) -> bool:
    near = 0.01 * b.value if a.nodes.tobytes() == b.nodes.tobytes() else 1e-5
    return abs(a.value - b.value) < near


def _lacking(pools: dict[Level, Pool], level: Level, joints: tuple[int, ...]) -> list[Pool]:
    """Pools whose designs lack one of these numbers of joints to have those of a level that is not apart."""
    return [
        pool
        for each, pool in pools.items()
        if level.joints - each.joints in joints and pool.designs and not level.apart
    ]


@dataclass
class Search:
    """One search for a target.

    Args:
        target: the curve with its demands.
        joints: most joints of a design.
        seconds: time for all of it.
        seed: of the random draws.
        progress: called with the share of the time that is over and the least objective so far.
    """

    target: Target
    joints: int
    seconds: float
    seed: int
    progress: Callable[[float, float], None] | None = None
    attempts: int = 0
    lock: threading.Lock = field(default_factory=threading.Lock)

    def run(self) -> list[Design]:
        """Designs that meet the demands, of every number of joints; an interrupt gives those found so far."""
        levels = [each for each in LEVELS if each.joints <= self.joints]
        if levels[-1].joints < self.joints:
            levels.append(Level(self.joints, SIX_BARS if self.joints < JOINTS[1] else None, LEVELS[-1].part))
        self.begin, self.draw = time.perf_counter(), np.random.default_rng(self.seed)
        self.best = {level: Pool() for level in levels}
        with ThreadPoolExecutor(cores()) as self.workers:
            try:
                self._rounds()
                last = [level for level in levels if level.joints == self.joints]
                for level, end in zip(last, np.linspace(MERGED, ENDED, len(last) + 1)[1:], strict=True):
                    self._level(level, self.best, self.begin + float(end) * self.seconds)
                return [
                    each
                    for level, pool in self.best.items()
                    if level.joints in (*JOINTS, self.joints)
                    for each in self._polished(pool)
                ]
            except KeyboardInterrupt:
                found = [each for pool in self.best.values() for each in pool.designs[:4]]
                if not found:
                    raise
                return found

    def _rounds(self) -> None:
        """As many rounds as the time holds, after the atlases have been looked up."""
        used = {level.atlas for level in self.best if level.atlas is not None}
        self.matches = {
            each: (atlas(each).nearest if each in ONE_DYAD else atlas(each).matches)(self.target)
            for each in used
        }
        over = (time.perf_counter() - self.begin) / self.seconds
        rounds = max(1, round(self.seconds * cores() / (ROUND * sum(level.part for level in self.best))))
        times = np.linspace(over, max(over, MERGED), rounds + 1)
        for number in range(rounds):
            self._round(times[number], times[number + 1])

    def _round(self, begin: float, end: float) -> None:
        """All levels once, from other starts of the atlases."""
        pools: dict[Level, Pool] = {}
        parts = np.cumsum([level.part for level in self.best])
        for level, part in zip(self.best, parts / parts[-1], strict=True):
            fewer = _lacking(pools, level, (1, 2))
            pool = pools[level] = Pool()
            over = self.begin + (begin + (end - begin) * part) * self.seconds
            try:
                for each in self._starts(level, over):
                    pool.add(each)
                for one in fewer:
                    for each in one.designs[:10]:
                        pool.add(each)
                self._level(level, pools, over)
            finally:
                for each in pool.designs:
                    self.best[level].add(each)

    def _level(self, level: Level, pools: dict[Level, Pool], end: float) -> None:
        """Attempts until the time is over."""
        pool, below = pools[level], _lacking(pools, level, HUNG)

        def work(seed: int) -> None:
            draw, stop = np.random.default_rng(seed), min(time.perf_counter() + BATCH, end)
            while time.perf_counter() < stop:
                found = self._attempt(draw, level.joints, pool, below)
                with self.lock:
                    self.attempts += 1
                    pool.add(found)

        while pool.designs and time.perf_counter() < end:
            list(self.workers.map(work, self.draw.integers(1 << 60, size=cores())))
            if self.progress is not None:
                over = (time.perf_counter() - self.begin) / self.seconds
                self.progress(min(over, 1.0), pool.designs[0].value)

    def _starts(self, level: Level, end: float) -> Iterable[Design]:
        """The best starts of an atlas, after descents, for a part of the level's time."""
        if level.atlas is None:
            return []
        matches = self.matches[level.atlas]
        order = iter(matches.order(self.draw, level.joints))
        now = time.perf_counter()
        last, near = now + STARTING * (end - now), list[Design]()
        while some := list(islice(order, SOME)):
            begun = self._each(some, lambda i: self.target.descend(matches.design(i), 30, COARSE))
            self.attempts += len(some)
            for part, steps, fineness in BEGUN:
                count = int(part * len(begun)) if near else len(begun)
                begun = self._further(_best(begun, count), steps, fineness)
            near = _best(near + begun, CHOSEN)
            if time.perf_counter() > last:
                break
        return self._each(near, self._ended)

    def _further(self, designs: list[Design], steps: int, fineness: Fineness) -> list[Design]:
        return self._each(designs, lambda each: self.target.descend(each, steps, fineness))

    def _each(self, given: Sequence[T], work: Callable[[T], Design]) -> list[Design]:
        """All after a descent, dealt to the workers."""
        hands = self.workers.map(
            lambda first: [work(each) for each in given[first :: cores()]], range(cores())
        )
        return [each for hand in hands for each in hand]

    def _attempt(self, draw: Draw, most: int, pool: Pool, below: list[Pool]) -> Design:
        """One attempt: a shake or one more dyad, and a descent that is left off where it leads nowhere."""
        design = self._next(draw, most, pool, below)
        design = self.target.descend(self.target.descend(design, 20, COARSE), 15)
        if design.value < FAR and pool.promises(0, design.value):
            design = self.target.descend(design, 30)
            if pool.promises(1, design.value):
                return self._ended(design)
        return replace(design, value=FAR)

    def _ended(self, design: Design) -> Design:
        """After the last descent, in which the demands weigh more, and examined so."""
        return self.target.checked(self.target.descend(design, 90, weight=STRICT), STRICT)

    def _next(self, draw: Draw, most: int, pool: Pool, below: list[Pool]) -> Design:
        """A design that was moved; where joints are left, most often shared ones parted."""
        design = self._moved(draw, most, pool, below)
        while design.joints < most and draw.random() < PARTED:
            design, before = with_joint(design, draw), design
            if design is before:
                break
        return design

    def _moved(self, draw: Draw, most: int, pool: Pool, below: list[Pool]) -> Design:
        """Half shaken; a quarter each with a dyad drawn at the drawing point, and with a promising one anywhere."""
        kind = draw.random()
        if below and kind < 0.5:
            base = below[int(draw.integers(len(below)))].pick(draw)
            if kind < 0.25:
                design = with_dyad(base, draw, most, self.target.turning)
                if design is not None:
                    return design
            elif most - base.joints > 1:
                found = self.target.grown(base, draw.random((DRAWS, 9)), most)
                if found:
                    return found[min(int(draw.exponential(3)), len(found) - 1)]
        return shaken(pool.pick(draw), draw)

    def _polished(self, pool: Pool) -> list[Design]:
        """The best of a pool, polished; the demands hold with a small margin."""
        found = self._each(pool.designs[:6], lambda each: polished(self.target, each))
        return [each for each in found if each.value < FAR]


def polished(target: Target, design: Design) -> Design:
    """The design after descents at fine positions; what still lacks a demand goes on, from farther within it."""
    for weight, more in POLISH:
        design = target.descend(design, 150, FINE, weight=weight, more=more)
    for more in LACKING:
        if design.value >= FAR or Placed(design, target).keeps():
            break
        design = target.descend(design, 60, FINE, weight=10 * weight, more=more)
    return target.checked(design)
