"""The search: fewest links first, each level from its atlas and from the designs of the levels below.

A level looks its atlas up, lets many starts descend a little, the best of them on, and keeps a pool of good designs
of different structure that err in different places. Until its share of the time is over, an attempt shakes a member
of the pool, or hangs one more dyad on a member of the pools below, and descends. At the end the best are polished at
fine positions, with the penalties weighted so that the demands hold.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace

import numpy as np

from linkwright.engine.threads import cores
from linkwright.synthesis.free_curve.atlas import LEVELS, atlas
from linkwright.synthesis.free_curve.kernels import FAR
from linkwright.synthesis.free_curve.moves import shaken, with_dyad, with_joint
from linkwright.synthesis.free_curve.nodes import Design, Draw
from linkwright.synthesis.free_curve.target import COARSE, FINE, Target

#: Most joints of each level, and the share of the time after which it ends, for each number of levels.
JOINTS = (5, 8, 10, 12)
SHARES = {1: (1.0,), 2: (0.2, 1.0), 3: (0.1, 0.45, 1.0), 4: (0.06, 0.28, 0.55, 1.0)}
#: Starts from an atlas; those that descend on, and further on; iterations of each step.
STARTS, HALVED, CHOSEN = 2000, 250, 50
POOL, BATCH = 30, 0.2
#: Chance that a design with room for one more joint gets one.
PARTED = 0.8
#: Dyads drawn of which a promising one is taken.
DRAWS = 96
#: Designs err alike whose misses have a product above this; as many of them stay in a pool.
NICHE, CROWD = 0.9, 4
#: Weight of the penalties, and the angle (rad) above the least one, in the steps of the polish.
POLISH = ((10.0, 0.005), (300.0, 0.005), (10000.0, 0.004))


@dataclass
class Pool:
    """The best designs so far, few of one structure or erring alike, none twice."""

    designs: list[Design] = field(default_factory=list)

    def add(self, design: Design) -> None:
        """Takes a design in where it is good and different enough in structure and in where it errs."""
        if not design.value < self.worst:
            return
        kept: list[Design] = []
        alike: dict[tuple[bytes, bool], int] = {}
        order = sorted([*self.designs, design], key=lambda one: one.value)
        errs = np.array([each.misses for each in order])
        near = errs @ errs.T > NICHE
        rows: list[int] = []
        for row, each in enumerate(order):
            key = each.nodes.tobytes(), each.mirror
            most = 12 if each.joints == JOINTS[0] else 3
            if (
                alike.get(key, 0) < most
                and near[row, rows].sum() < CROWD
                and not any(_same(one, each) for one in kept)
            ):
                kept.append(each)
                rows.append(row)
                alike[key] = alike.get(key, 0) + 1
                if len(kept) == POOL:
                    break
        self.designs = kept

    @property
    def worst(self) -> float:
        """What a design must better."""
        return self.designs[-1].value if len(self.designs) == POOL else 0.9 * FAR

    def pick(self, draw: Draw) -> Design:
        """A design, the better the likelier."""
        return self.designs[min(int(draw.exponential(6)), len(self.designs) - 1)]


def _same(a: Design, b: Design) -> bool:
    near = 0.01 * b.value if a.nodes.tobytes() == b.nodes.tobytes() else 1e-5
    return abs(a.value - b.value) < near


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
        limits = [each for each in JOINTS if each < self.joints] + [self.joints]
        shares, self.begin, self.draw = (
            SHARES[len(limits)],
            time.perf_counter(),
            np.random.default_rng(self.seed),
        )
        pools: list[Pool] = []
        found: list[Design] = []
        with ThreadPoolExecutor(cores()) as self.workers:
            try:
                for level, most in enumerate(limits):
                    pools.append(Pool())
                    self._level(level, most, pools, shares[level])
                    found += self._polished(pools[-1])
            except KeyboardInterrupt:
                found += [each for pool in pools for each in pool.designs[:4]]
                if not found:
                    raise
        return found

    def _level(self, level: int, most: int, pools: list[Pool], share: float) -> None:
        pool, below = pools[-1], [each for each in pools[max(0, level - 2) : level] if each.designs]
        if level < len(LEVELS):
            for each in self._starts(level):
                pool.add(each)
        for one in below[-1].designs[:10] if below else []:
            pool.add(one)
        end = self.begin + share * self.seconds - 0.03 * self.seconds

        def work(seed: int) -> None:
            draw, stop = np.random.default_rng(seed), min(time.perf_counter() + BATCH, end)
            while time.perf_counter() < stop:
                found = self._attempt(draw, most, pool, below)
                with self.lock:
                    self.attempts += 1
                    pool.add(found)

        while pool.designs and time.perf_counter() < end:
            list(self.workers.map(work, self.draw.integers(1 << 60, size=cores())))
            if self.progress is not None:
                over = (time.perf_counter() - self.begin) / self.seconds
                self.progress(min(over, 1.0), pool.designs[0].value)

    def _starts(self, level: int) -> Iterable[Design]:
        """The best of an atlas, after descents."""
        starts = atlas(level).find(self.target, STARTS)
        self.attempts += len(starts)
        near = self._best(starts, lambda each: self.target.descend(each, 15, COARSE), HALVED)
        nearer = self._best(near, lambda each: self.target.eased(each, 60), CHOSEN)
        return self._checked(self._best(nearer, lambda each: self.target.eased(each, 150), CHOSEN))

    def _best(self, designs: list[Design], descent: Callable[[Design], Design], count: int) -> list[Design]:
        return sorted(self.workers.map(descent, designs), key=lambda each: each.value)[:count]

    def _checked(self, designs: list[Design]) -> Iterable[Design]:
        return self.workers.map(self.target.checked, designs)

    def _attempt(self, draw: Draw, most: int, pool: Pool, below: list[Pool]) -> Design:
        """One attempt: a shake or one more dyad, and a descent that is left off where it leads nowhere."""
        design = self._next(draw, most, pool, below)
        design = self.target.descend(self.target.descend(design, 25, COARSE), 10)
        if design.value < 2 * pool.worst:
            design = self.target.eased(design, 60)
        if design.value < 1.2 * pool.worst:
            return self.target.checked(self.target.eased(design, 200))
        return replace(design, value=FAR)

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
                design = with_dyad(base, draw, most)
                if design is not None:
                    return design
            elif most - base.joints > 1:
                found = self.target.grown(base, draw.random((DRAWS, 9)), most)
                if found:
                    return found[min(int(draw.exponential(3)), len(found) - 1)]
        return shaken(pool.pick(draw), draw)

    def _polished(self, pool: Pool) -> list[Design]:
        """The best of a pool, polished; the demands hold with a small margin."""

        def polish(design: Design) -> Design:
            for weight, more in POLISH:
                design = self.target.descend(design, 150, FINE, weight=weight, more=more)
            return self.target.checked(design)

        return [each for each in self.workers.map(polish, pool.designs[:6]) if each.value < FAR]
