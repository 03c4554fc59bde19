"""The search: fewest joints first, each level from its atlas and from the designs of the levels below.

A level lets many starts from its atlas descend, the best of them further, and keeps a pool of good designs of
different structure that err in different places. Until its share of the time is over, an attempt shakes a member of
the pool, or hangs one more dyad on a member of the pools below, parts joints while there is room, and descends.
Eight-bars of 8 joints are a level of their own. A pool soon turns about what it has found, so all
levels begin again in rounds, from other starts; at last the designs of all rounds go on together. The best are
polished at fine positions, with the penalties weighted so that the demands hold.
"""

from __future__ import annotations

import pickle
import threading
import time
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from itertools import islice, pairwise
from typing import Any, NamedTuple, TypeVar

import numpy as np

from linkwright.core.arrays import Floats, Integers
from linkwright.core.progress import Progress
from linkwright.designs.checkpoints import checkpointed, current_checkpoints, identity
from linkwright.designs.cluster import current, hands, in_turn
from linkwright.formula.threads import chunks, cores
from linkwright.synthesis.free_curve.atlas import NEAREST, Laid, atlas
from linkwright.synthesis.free_curve.linkages import Placed
from linkwright.synthesis.free_curve.placing import FAR
from linkwright.synthesis.free_curve.target import COARSE, FINE, MIDDLE, Target
from linkwright.synthesis.free_curve.topology import Design, Draw, shaken, with_dyad, with_joint

#: Most joints of a four-bar, six-bar, eight-bar and of any linkage.
JOINTS = (5, 8, 10, 12)
T = TypeVar("T")
#: Pools take one design in at a time.
_LOCK = threading.Lock()


class Level(NamedTuple):
    """Most joints, number of its atlas, its part of the time, and whether its linkages grow from none with fewer."""

    joints: int
    atlas: int | None
    part: float
    separate: bool = False


SIX_BARS, SLIDING = 1, 4
ONE_DYAD = 0, SLIDING
#: Eight-bars of 8 joints have another pool than six-bars, linkages of one sliding dyad from four-bars, as in one pool
#: each would crowd out the other.
LEVELS = (
    Level(5, 0, 0.5),
    Level(5, SLIDING, 0.5, separate=True),
    Level(8, SIX_BARS, 3.5),
    Level(8, 3, 2.5, separate=True),
    Level(9, 2, 2.5),
    Level(10, 2, 3.5),
    Level(12, None, 7.0),
)
#: Starts of a piece of work, how many of all descend further, and their share of a level's time.
SOME, CHOSEN, STARTING = 100, 50, 0.5
#: What share of the drawn starts goes on after each step, so many steps (all of the nearest, which come first).
BEGUN = ((0.5, 60, COARSE), (0.25, 30, MIDDLE))
#: Processor seconds of a level with part 1 in a round of all levels; shares of the time after which the designs of
#: the rounds go on together, and after which the best are polished.
ROUND, MERGED, ENDED = 4.0, 0.85, 0.96
POOL = 30
#: Seconds of attempts between two looks at the pool, here and on a cluster; seconds between two times that all pools
#: are stored.
BATCH, AWAY, SAVED = 0.2, 1.0, 2.0
#: Chance that a design with room for one more joint gets one.
PARTED = 0.8
#: Joints that one more dyad brings: its pin and its point of a link, or a pivot of its own as well.
HUNG = 2, 3
#: Dyads drawn of which a promising one is taken.
DRAWS = 96
#: Share of the attempts that close that goes on after each of two steps, among this many recent ones.
GOES_ON, RECENT = (0.5, 0.25), 200
#: Designs have similar errors whose misses have a product above this; as many of them stay in a pool.
NICHE, CROWD = 0.9, 4
#: Weight of the penalties in the descent after which a design comes into a pool.
STRICT = 10.0
#: Weight of the penalties, and the angle (rad) above the minimum, in the steps of the polish; the angle where a
#: demand is lacking after them.
POLISH = ((10.0, 0.005), (300.0, 0.003), (10000.0, 0.0015))
LACKING = 0.003, 0.003, 0.006


@dataclass
class Pool:
    """The best designs so far, few of one structure or with similar errors, none twice."""

    designs: list[Design] = field(default_factory=list)
    tried: tuple[deque[float], ...] = field(default_factory=lambda: tuple(deque(maxlen=RECENT) for _ in GOES_ON))

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
        selected: list[int] = []
        per_topology: dict[tuple[bytes, bool], int] = {}
        worse = [one for one in self.designs[len(better) :] if not _same(design, one)]
        order = [*better, design, *worse]
        errs = np.array([each.misses for each in order])
        near = (errs @ errs.T > NICHE).tolist()
        for row, each in enumerate(order):
            key = each.nodes.tobytes(), each.mirror
            most = 12 if each.joints == JOINTS[0] else 3
            if per_topology.get(key, 0) < most and sum(near[row][k] for k in selected) < CROWD:
                selected.append(row)
                per_topology[key] = per_topology.get(key, 0) + 1
            elif each is design:
                return
        self.designs = [order[row] for row in selected[:POOL]]

    @property
    def worst(self) -> float:
        """What a design must better."""
        return self.designs[-1].value if len(self.designs) == POOL else 0.9 * FAR

    def pick(self, draw: Draw) -> Design:
        """A design, the better the likelier."""
        return self.designs[min(int(draw.exponential(6)), len(self.designs) - 1)]


def _bare(designs: list[Design]) -> list[tuple[Integers, Floats, bool, float]]:
    """Designs as they are stored: without what is quickly recomputed."""
    return [(each.nodes, each.x, each.mirror, each.value) for each in designs]


def _best(designs: list[Design], count: int) -> list[Design]:
    return sorted(designs, key=lambda each: each.value)[:count]


def _same(a: Design, b: Design) -> bool:
    near = 0.01 * b.value if a.nodes.tobytes() == b.nodes.tobytes() else 1e-5
    return abs(a.value - b.value) < near


def _lacking(pools: dict[Level, Pool], level: Level, joints: tuple[int, ...]) -> list[Pool]:
    """Pools whose designs lack one of these numbers of joints to have those of a level without a pool of its own."""
    return [
        pool
        for each, pool in pools.items()
        if level.joints - each.joints in joints and pool.designs and not level.separate
    ]


class Stage(NamedTuple):
    """A level's work until a share of the time is over, in a round or with the designs of all rounds."""

    level: Level
    end: float
    merged: bool


@dataclass
class Search:
    """One search for a target, by the threads of this machine or the workers of the surrounding ``on_cluster``.

    A surrounding ``checkpointing`` stores all pools, with the time that was spent, every ``SAVED`` seconds.

    Args:
        target: the curve with its demands.
        joints: most joints of a design.
        seconds: time for all of it.
        seed: of the random draws.
        progress: called with the percents of the time that are over, and 100.
    """

    target: Target
    joints: int
    seconds: float
    seed: int
    progress: Progress | None = None
    attempts: int = 0
    stopped: bool = False

    def run(self) -> list[Design]:
        """Designs that meet the demands, of every number of joints; an interrupt gives the best found so far."""
        self.levels = [each for each in LEVELS if each.joints <= self.joints]
        if self.levels[-1].joints < self.joints:
            lowest = SIX_BARS if self.joints < JOINTS[1] else None
            self.levels.append(Level(self.joints, lowest, LEVELS[-1].part))
        self.client, self.begin = current(), time.perf_counter()
        self._begin()
        with ThreadPoolExecutor(cores()) as self.workers:
            try:
                stages = self._stages()
                while self.stage < len(stages):
                    self._staged(stages[self.stage])
                    self.stage += 1
                    self._keep()
                pools = [pool for level, pool in self.best.items() if level.joints in (*JOINTS, self.joints)]
                found = [each for pool in pools for each in pool.designs[:6]]
            except KeyboardInterrupt:
                self._keep()
                self.stopped = True
                pools = [*self.best.values(), *self.pools.values()]
                found = [each for pool in pools for each in pool.designs[:1]]
            own = (part for each in found for part in (each.nodes, each.x, each.mirror))
            made = checkpointed(lambda: _bare(self._each(found, polished)), lambda: (self.key, "polished", *own))
            return [each for each in (Design(*one) for one in made) if each.value < FAR]

    def _begin(self) -> None:
        """Resumes from the checkpoint; looks up the atlases that provide starts."""
        self.draw, self.stage, self.pools = np.random.default_rng(self.seed), 0, dict[Level, Pool]()
        self.best, self.hands = {level: Pool() for level in self.levels}, hands(self.client)
        self.saved, cache = self.begin, current_checkpoints()
        self.rounds = max(1, round(self.seconds * self.hands / (ROUND * sum(level.part for level in self.levels))))
        over = None if cache is None else cache.resumed(self.key, self._resume)
        used = {each.atlas for each in self.levels if self.stage < self.rounds * len(self.levels)} - {None}
        self.matches = {
            each: (atlas(each).nearest if each in ONE_DYAD else atlas(each).matches)(self.target) for each in used
        }
        if over is None:
            self.first = self._over()
        else:
            self.begin = time.perf_counter() - over * self.seconds

    def _resume(self, left: Any) -> float:
        """Restores a checkpoint; returns the share of the time already spent."""
        over, self.draw.bit_generator.state, best, pools, *rest = left
        self.stage, self.attempts, self.first, self.rounds = rest
        self.best |= {self.levels[k]: self._pool(designs) for k, designs in best.items()}
        self.pools = {self.levels[k]: self._pool(designs) for k, designs in pools.items()}
        return float(over)

    @cached_property
    def key(self) -> str:
        """What the pools depend on but for the clock."""
        return identity(*self.target.arguments, self.joints, self.seconds, self.seed)

    def _pool(self, designs: list[Any]) -> Pool:
        """A pool restored from a checkpoint."""
        made = [Design(*each) for each in designs]
        return Pool([replace(each, misses=self.target.misses(each)) for each in made])

    def _keep(self) -> None:
        """Stores all pools and the time spent on them, if checkpoints are on."""
        self.saved, cache = time.perf_counter(), current_checkpoints()
        if cache is None:
            return
        with _LOCK:
            best, pools = (
                {self.levels.index(level): _bare(pool.designs) for level, pool in each.items()}
                for each in (self.best, self.pools)
            )
        rest = self.stage, self.attempts, self.first, self.rounds
        cache.add(self.key, (self._over(), self.draw.bit_generator.state, best, pools, *rest))

    def _over(self) -> float:
        """The share of the time that is over."""
        return (time.perf_counter() - self.begin) / self.seconds

    def _stages(self) -> list[Stage]:
        """All levels in every round, then those of most joints with the designs of all rounds."""
        times = np.linspace(self.first, max(self.first, MERGED), self.rounds + 1)
        parts = np.cumsum([level.part for level in self.levels])
        ends = list(zip(self.levels, (parts / parts[-1]).tolist(), strict=True))
        last = [level for level in self.levels if level.joints == self.joints]
        return [
            Stage(level, begin + (end - begin) * part, False)
            for begin, end in pairwise(times.tolist())
            for level, part in ends
        ] + [
            Stage(level, end, True)
            for level, end in zip(last, np.linspace(MERGED, ENDED, len(last) + 1)[1:].tolist(), strict=True)
        ]

    def _staged(self, stage: Stage) -> None:
        """One stage; in a round from other starts of the atlas, unless restored from a checkpoint."""
        level, self.hands = stage.level, hands(self.client)
        if stage.merged:
            self._level(stage, self.best)
            return
        if level not in self.pools:
            fewer = _lacking(self.pools, level, (1, 2))
            pool = Pool()
            for each in self._starts(stage):
                pool.add(each)
            for one in fewer:
                for each in one.designs[:10]:
                    pool.add(each)
            self.pools[level] = pool
        self._level(stage, self.pools)
        for each in self.pools[level].designs:
            self.best[level].add(each)
        if level is self.levels[-1]:
            self.pools = {}

    def _level(self, stage: Stage, pools: dict[Level, Pool]) -> None:
        """Attempts until the time is over."""
        most, pool, below = stage.level.joints, pools[stage.level], _lacking(pools, stage.level, HUNG)
        batch = BATCH if self.client is None else AWAY
        while pool.designs and (left := (stage.end - self._over()) * self.seconds) > 0:
            seeds = self.draw.integers(1 << 60, size=self.hands).tolist()
            tasks = [(most, pool, below, seed, min(batch, left)) for seed in seeds]
            for count, found in self._dealt(tried, tasks):
                self.attempts += count
                for each in found:
                    pool.add(each)
            if time.perf_counter() - self.saved > SAVED:
                self._keep()
            if self.progress is not None:
                self.progress(round(100 * min(self._over(), 1.0)), 100)

    def _starts(self, stage: Stage) -> list[Design]:
        """The best starts of an atlas, after descents, for a part of the level's time."""
        if stage.level.atlas is None:
            return []
        matches = self.matches[stage.level.atlas]
        order = iter(matches.order(self.draw, stage.level.joints))
        now = self._over()
        last, near, count = now + STARTING * (stage.end - now), list[Design](), 0
        while some := list(islice(order, SOME * self.hands)):
            laid = [(int(i), matches.laid(i)) for i in some]
            tasks = [
                (stage.level.atlas, laid[first:end], count + first < NEAREST)
                for first, end in chunks(len(laid), SOME)
            ]
            for begun in self._dealt(started, tasks):
                near = _best(near + begun, CHOSEN)
            count += len(some)
            self.attempts += len(some)
            if self._over() > last:
                break
        return self._each(near, ended)

    def _each(self, designs: Sequence[Design], work: Callable[[Target, Design], Design]) -> list[Design]:
        """All after some work, dealt to the hands."""
        parts = [(work, designs[first :: self.hands]) for first in range(min(self.hands, len(designs)))]
        return [each for part in self._dealt(each_of, parts) for each in part]

    def _dealt(self, work: Callable[..., T], tasks: Sequence[tuple[Any, ...]]) -> list[T]:
        """What ``work`` gives for the target and each task, by threads or a cluster's workers."""
        if self.client is None:
            return [*self.workers.map(lambda task: work(self.target, *task), tasks)]
        jobs = [(work, self._pickled, *task) for task in tasks]
        found: dict[int, T] = dict(in_turn(self.client, _away, jobs))
        return [found[number] for number in range(len(tasks))]

    @cached_property
    def _pickled(self) -> bytes:
        return pickle.dumps(self.target)


def _away(work: Callable[..., T], pickled: bytes, *task: Any) -> T:
    """What ``work`` gives, on a worker of a cluster."""
    return work(_target(pickled), *task)


@lru_cache(2)
def _target(pickled: bytes) -> Target:
    """Made once for all pieces of a search."""
    target: Target = pickle.loads(pickled)
    return target


def each_of(target: Target, work: Callable[[Target, Design], Design], designs: list[Design]) -> list[Design]:
    """All designs after some work."""
    return [work(target, each) for each in designs]


def started(target: Target, number: int, starts: list[tuple[int, Laid]], all_go_on: bool) -> list[Design]:
    """Starts from an atlas after their first descents; unless all go on, the better ones."""
    begun = [target.descend(atlas(number).design(i, laid), 30, COARSE) for i, laid in starts]
    for part, steps, fineness in BEGUN:
        some = begun if all_go_on else _best(begun, int(part * len(begun)))
        begun = [target.descend(each, steps, fineness) for each in some]
    return begun


def tried(
    target: Target, most: int, pool: Pool, below: list[Pool], seed: int, seconds: float
) -> tuple[int, list[Design]]:
    """The number of attempts in some seconds, and what they brought into the pool."""
    draw, stop = np.random.default_rng(seed), time.perf_counter() + seconds
    before, count = [*pool.designs], 0
    while time.perf_counter() < stop:
        found = attempt(target, draw, most, pool, below)
        count += 1
        with _LOCK:
            pool.add(found)
    return count, [each for each in pool.designs if not any(each is one for one in before)]


def attempt(target: Target, draw: Draw, most: int, pool: Pool, below: list[Pool]) -> Design:
    """A shake or one more dyad, and a descent that is left off where it leads nowhere."""
    design = _next(target, draw, most, pool, below)
    design = target.descend(target.descend(design, 20, COARSE), 15)
    if design.value < FAR and pool.promises(0, design.value):
        design = target.descend(design, 30)
        if pool.promises(1, design.value):
            return ended(target, design)
    return replace(design, value=FAR)


def ended(target: Target, design: Design) -> Design:
    """After the last descent, in which the demands weigh more, and examined so."""
    return target.checked(target.descend(design, 90, weight=STRICT), STRICT)


def _next(target: Target, draw: Draw, most: int, pool: Pool, below: list[Pool]) -> Design:
    """A design that was moved; where joints are left, most often shared ones parted."""
    design = _moved(target, draw, most, pool, below)
    while design.joints < most and draw.random() < PARTED:
        design, before = with_joint(design, draw), design
        if design is before:
            break
    return design


def _moved(target: Target, draw: Draw, most: int, pool: Pool, below: list[Pool]) -> Design:
    """Half shaken; a quarter each with a dyad drawn at the drawing point, and with a promising one anywhere."""
    kind = draw.random()
    if below and kind < 0.5:
        base = below[int(draw.integers(len(below)))].pick(draw)
        if kind < 0.25:
            design = with_dyad(base, draw, most, target.turning)
            if design is not None:
                return design
        elif most - base.joints > 1:
            found = target.grown(base, draw.random((DRAWS, 9)), most)
            if found:
                return found[min(int(draw.exponential(3)), len(found) - 1)]
    return shaken(pool.pick(draw), draw)


def polished(target: Target, design: Design) -> Design:
    """The design after descents at fine positions; what still lacks a demand goes on, from farther within it."""
    for weight, more in POLISH:
        design = target.descend(design, 150, FINE, weight=weight, more=more)
    for more in LACKING:
        if design.value >= FAR or Placed(design, target).keeps():
            break
        design = target.descend(design, 60, FINE, weight=10 * weight, more=more)
    return target.checked(design)
