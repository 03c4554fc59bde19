"""Motions integrated in one call of compiled code: many starts or designs, each with its own steps, events, times."""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import IntEnum
from functools import cache

import numpy as np

from linkwright.core.arrays import Floats, Indices, Integers
from linkwright.dynamics import event_kernels as places
from linkwright.dynamics import step_kernels as method
from linkwright.dynamics.loop_kernels import kernels
from linkwright.dynamics.right_side import RightSide
from linkwright.formula.kernel_writer import LANES
from linkwright.formula.llvm_backend import address_of, aligned
from linkwright.formula.program import Program
from linkwright.formula.table import Tables
from linkwright.formula.threads import spread_over


class Outcome(IntEnum):
    """How a motion ended."""

    WAITING = 0
    """Not begun."""
    ENDED = int(places.ENDED)
    """At its end."""
    STOPPED = int(places.STOPPED)
    """At an event that stops."""
    NO_START = int(places.NO_START)
    """No finite accelerations where it begins, or goes on after an event."""
    TOO_SMALL = int(places.TOO_SMALL)
    """The steps became too small: what lies behind has no position, or is too stiff."""
    TOO_MANY = int(places.TOO_MANY)
    """More steps than allowed."""
    RETURNED = int(places.RETURNED)
    """An event came back at once: the motion sticks or slides along it."""


class Action(IntEnum):
    """What an event does."""

    STOP = places.STOP
    """Ends the motion."""
    NOTE = places.NOTE
    """Its first time is noted."""
    FLIP = places.FLIP
    """Turns an input from 0 to 1 and back."""


@dataclass(frozen=True)
class Event:
    """An output that is watched for its root; ``flips``: the input that ``Action.FLIP`` turns."""

    output: str
    action: Action = Action.STOP
    flips: str = ""


@dataclass(frozen=True)
class Layout:
    """What a loop integrates: ``q:NAME`` with ``qd:NAME`` and ``qdd:NAME`` of the ``names``, and ``power``.

    ``watched``: outputs whose largest size is found and whose square is integrated. ``inputs``: those that differ
    from motion to motion or are flipped. ``carried``: outputs that are the next values of inputs (the starts of
    Newton's steps), by the names of these.
    """

    names: Sequence[str]
    events: Sequence[Event] = ()
    watched: Sequence[str] = ()
    inputs: Sequence[str] = ()
    carried: Mapping[str, str] = field(default_factory=dict)

    @property
    def states(self) -> int:
        """Coordinates, rates, work, integrals of squares."""
        return 2 * len(self.names) + 1 + len(self.watched)

    @property
    def first_inputs(self) -> list[str]:
        """The first inputs of the program, in the order of the loop."""
        coordinates = [f"{kind}:{name}" for kind in ("q", "qd") for name in self.names]
        return [*coordinates, "time", *self.all_inputs]

    @property
    def all_inputs(self) -> list[str]:
        """Those of each motion: ``inputs``, then the carried ones."""
        return [*self.inputs, *self.carried]

    @property
    def outputs(self) -> list[str]:
        """The outputs of the program, in the order of the loop."""
        accelerations = [f"qdd:{name}" for name in self.names]
        return [
            *accelerations,
            "power",
            *(each.output for each in self.events),
            *self.watched,
            *self.carried.values(),
        ]

    def plan(self, inside: int, samples: int) -> Integers:
        """The numbers of a run, as the kernels read them."""
        head = [len(self.names), self.states, len(self.events), len(self.watched), len(self.carried)]
        actions = [int(each.action) for each in self.events]
        flips = [list(self.inputs).index(each.flips) if each.flips else 0 for each in self.events]
        return np.array([*head, len(self.all_inputs), inside, samples, *actions, *flips], dtype=np.int64)


class Motions:
    """Motions by rows: where each is, and how it ended. Change what is to change, and advance them again.

    ``time``, ``until``: (motions,) s; ``first``: length of the next step, 0 where not known; ``state``: (motions,
    states), see :class:`Layout`; ``sides``: (motions, events), 1 or -1: sign of an event's function, NaN where its
    first value tells; 0: not watched; ``times``: of the events' last ones, NaN before; ``peaks``: (motions, watched);
    ``inputs``: (motions, inputs), as ``Layout.all_inputs``; ``samples``: (motions, times, states), NaN beyond ends.
    """

    def __init__(self, layout: Layout, count: int, samples: int = 0) -> None:
        states, events, watched = layout.states, len(layout.events), len(layout.watched)
        sizes = [places.HEAD, states, events, events, watched, len(layout.all_inputs)]
        ends = np.cumsum(sizes)
        self.records = np.zeros((count, int(ends[-1])))
        head, self.state, self.sides, self.times, self.peaks, self.inputs = np.split(self.records, ends[:-1], axis=1)
        self.time, self.until, self.first = head[:, places.AT], head[:, places.UNTIL], head[:, places.FIRST]
        self.sides[:], self.times[:] = np.nan, np.nan
        self.samples = np.full((count, samples, states), np.nan)
        self._head = head

    @property
    def outcomes(self) -> list[Outcome]:
        """How each ended."""
        return [Outcome(int(each)) for each in self._head[:, places.OUTCOME]]

    @property
    def event(self) -> Integers:
        """The event at which each stopped or that came back, its number in the layout."""
        return np.asarray(self._head[:, places.EVENT], dtype=np.int64)

    @property
    def steps(self) -> Integers:
        """Steps that each took."""
        return np.asarray(self._head[:, places.COUNT], dtype=np.int64)


class Loop:
    """The integration of a program's motions by DOP853, in compiled code; not where no compiler can be loaded.

    ``numbers``: values of the program's parameters and of inputs that are equal in all motions.
    """

    def __init__(
        self, program: Program, numbers: Mapping[str, float], layout: Layout, *, tables: Tables | None = None
    ) -> None:
        self.layout = layout
        self.program = program.only(layout.outputs)
        self._given = dict(numbers), tables
        self._own = threading.local()

    def start(self, count: int, samples: int = 0) -> Motions:
        """Motions at rest at zero coordinates, inputs as in ``numbers``."""
        motions = Motions(self.layout, count, samples)
        motions.inputs[:] = [self._given[0].get(name, 0.0) for name in self.layout.all_inputs]
        return motions

    def advance(
        self,
        motions: Motions,
        *,
        relative: float = 1e-9,
        absolute: float | Floats = 1e-9,
        inside: int = 3,
        grid: Sequence[float] | Floats = (),
        most: float = 1e6,
        threads: int = 1,
        rows: Indices | None = None,
    ) -> int:
        """All motions, or those of some ``rows``, on to their ends or events; evaluations of the program, eight
        motions in each.

        ``relative``, ``absolute``: tolerances of coordinates, rates and work. ``inside``: places within a step at
        which events are looked for. ``grid``: times of the samples, of as many as the motions have. ``most``: steps.
        """
        layout = self.layout
        allowed = np.broadcast_to(np.asarray(absolute, dtype=np.float64), (2 * len(layout.names) + 1,))
        settings = np.array([relative, most, *allowed])
        plan, times = layout.plan(inside, motions.samples.shape[1]), np.array([*grid, 0.0])
        if len(times) <= motions.samples.shape[1]:
            raise ValueError(f"the motions have room for {motions.samples.shape[1]} samples, not {len(times) - 1}")
        motions.sides[np.isnan(motions.sides)] = places.UNKNOWN
        all_records, all_samples = motions.records, motions.samples
        if rows is not None:
            all_records, all_samples = all_records[rows], all_samples[rows]
        calls: list[int] = []

        def work(first: int, after: int) -> None:
            records, samples = all_records[first:after], all_samples[first:after]
            calls.append(self._worker().run(plan, settings, records, times, samples))

        count = len(all_records)
        share = -(-count // max(1, threads))
        spread_over(count, -(-share // LANES) * LANES if threads > 1 else count, threads, work)
        if rows is not None:
            motions.records[rows], motions.samples[rows] = all_records, all_samples
        motions.sides[motions.sides == places.UNKNOWN] = np.nan
        return sum(calls)

    def _worker(self) -> _Worker:
        if not hasattr(self._own, "worker"):
            numbers, tables = self._given
            first = self.layout.first_inputs
            right = RightSide(self.program, numbers, lanes=LANES, tables=tables, first=first, compiled=True)
            self._own.worker = _Worker(right, self.layout)
        worker: _Worker = self._own.worker
        return worker


class _Worker:
    """The buffers of one thread."""

    def __init__(self, right: RightSide, layout: Layout) -> None:
        self._right = right
        rows = (24 + LANES * (method.SLOPES + method.COEFFICIENTS)) * layout.states
        rows += LANES * (places.LANE_ROWS + 4 * len(layout.events) + len(layout.watched) + 2 * len(layout.carried))
        self._room, self._whose = aligned((rows,)), np.zeros(LANES, dtype=np.int64)

    def run(self, plan: Integers, settings: Floats, records: Floats, grid: Floats, samples: Floats) -> int:
        """Some motions to their ends."""
        code, block = self._right.addresses
        x, out = self._right.x, self._right.out
        self._room[:] = 0.0
        given = [address_of(each) for each in (x, out, plan, settings, _table(), self._room, self._whose)]
        last = [address_of(each) for each in (records, grid, samples)]
        return int(kernels()("run", code, block, *given, *records.shape, *last))


@cache
def _table() -> Floats:
    """The coefficients of DOP853, from SciPy."""
    from scipy.integrate._ivp import dop853_coefficients as dop

    table = np.zeros(method.DENSE + 64)
    table[method.MATRIX : method.MATRIX + 256] = dop.A.ravel()
    table[method.WEIGHTS : method.WEIGHTS + 12] = dop.B
    table[method.PLACES : method.PLACES + 16] = dop.C
    table[method.ERRORS : method.ERRORS + 12] = dop.E5[:12]
    table[method.ERRORS + 16 : method.ERRORS + 28] = dop.E3[:12]
    table[method.DENSE :] = dop.D.ravel()
    return table
