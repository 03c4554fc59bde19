"""Swept areas of many designs, with gradients: curves of all designs over the same pieces, each one's hull alone."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from linkwright.analysis.by_name import chosen_subjects, metric_of
from linkwright.analysis.of_designs import MetricsOfDesigns
from linkwright.analysis.swept_area import of_driver, points, turned
from linkwright.analysis.swept_hull import Curves, SweptHull
from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.curves.pieces import HIGH, LOW
from linkwright.cycle.cycle import Cycle
from linkwright.cycle.gradient import Backward
from linkwright.cycle.machine import Machine, NotTogether
from linkwright.cycle.solved import Solved
from linkwright.cycle.summaries import Signal
from linkwright.events.course import moves
from linkwright.formula.summaries import Backend
from linkwright.formula.threads import cores, spread_over
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.mechanism import Mechanism

#: Designs whose curves are held at the same time.
BLOCK = 256


def swept(name: str, mechanism: Mechanism) -> dict[str, tuple[str, ...]]:
    """The points of the subjects of a registered number that is the area of a hull; none for another."""
    metric, subject = metric_of(name) or (None, "")
    known = {} if metric is None else metric().swept(mechanism)
    return {each: known[each] for each in (chosen_subjects(name, subject, known) if known else ())}


def hulls_of_designs(mechanism: Mechanism, varied: Iterable[str], names: Iterable[str]) -> HullsOfDesigns | None:
    """Areas of hulls, ``swept_area``, ``swept_area_of_link jaw``; None where the cycle is no formula of one position
    (see ``cycle.machine.Machine``), or the dimensions move its times."""
    nominal = solve_motion(mechanism, failures="mark")
    try:
        machine = Machine(mechanism, nominal, varied, unloaded=True)
    except NotTogether:
        return None
    if any(moves(mechanism, address, nominal.positions.steps) for address in machine.varied):
        return None
    return HullsOfDesigns(machine, names)


class HullsOfDesigns(MetricsOfDesigns):
    """Areas of hulls; of several links the largest. Made by :func:`hulls_of_designs`."""

    def __init__(self, machine: Machine, names: Iterable[str]) -> None:
        self.machine, self._keys = machine, points(machine.mechanism)
        self.kinds = dict.fromkeys(names, "area")
        number = {key: k for k, key in enumerate(self._keys)}
        groups = [swept(name, machine.mechanism).values() for name in self.kinds]
        self._chosen = [[[number[key] for key in own] for own in subjects] for subjects in groups]
        self._words = [f"{key}.{axis}" for key in self._keys for axis in "xy"]
        self.cycle = Cycle(machine, (), even=self._words)

    @property
    def dimensions(self) -> tuple[str, ...]:
        """Those of the varied dimensions on which the areas depend."""
        taken = self.cycle.columns
        return tuple(name for name in self.machine.varied if name in taken)

    def evaluate(
        self, columns: Mapping[str, Floats], *, threads: int | None = None, backend: Backend = "auto"
    ) -> tuple[dict[str, Floats], Flags]:
        """The areas (designs,) by name, and which designs are certain."""
        values, _ = self._found(columns, np.empty((0, len(self.kinds))), (), threads, backend)
        return dict(zip(self.kinds, values, strict=True)), np.asarray(np.isfinite(values).all(axis=0))

    def gradients(
        self,
        sums: Sequence[Mapping[str, float]],
        columns: Mapping[str, Floats],
        by: Sequence[str],
        *,
        threads: int | None = 1,
        backend: Backend = "auto",
    ) -> tuple[Floats, Floats]:
        """Weighted sums of areas (sums, designs) and their gradients (sums, designs, by); NaN of designs that do not
        pass."""
        factors = np.array([[weights.get(name, 0.0) for name in self.kinds] for weights in sums])
        values, slopes = self._found(columns, factors, tuple(by), threads, backend)
        return factors @ values, slopes

    def _found(
        self,
        columns: Mapping[str, Floats],
        factors: Floats,
        by: tuple[str, ...],
        threads: int | None,
        backend: Backend,
    ) -> tuple[Floats, Floats]:
        """Areas (kinds, designs), and derivatives (sums, designs, by) of their sums by factors (sums, kinds)."""
        own = {name: column for name, column in columns.items() if name in self.machine.varied}
        count = len(next(iter(columns.values())))
        values = np.full((len(self.kinds), count), np.nan)
        slopes = np.full((len(factors), count, len(by)), np.nan)
        self.machine.compiled = None if backend == "auto" else backend == "llvm"

        def work(first: int, end: int) -> None:
            solved = Solved(self.cycle, {name: column[first:end] for name, column in own.items()})
            rows = [solved.pieces.values(self.cycle.number[Signal(each)]) for each in self._words]
            weights = np.zeros((len(factors), len(rows), *rows[0].shape))
            for k in np.flatnonzero(solved.passed & ~solved.pieces.unmet).tolist():
                mine = np.flatnonzero(solved.pieces.design == k)
                values[:, first + k] = self._areas(solved, np.stack(rows)[:, :, mine], mine, factors, weights)
            known = np.isfinite(values[:, first:end]).all(axis=0)
            for number, each in enumerate(weights):
                signals = {Signal(words): row for words, row in zip(self._words, each, strict=True)}
                found = Backward(solved).gradient({}, (signals, np.zeros(len(solved.pieces.stretch))))
                for place, name in enumerate(by):
                    slopes[number, first:end, place] = np.where(known, found[name], np.nan)

        spread_over(count, BLOCK, cores() if threads is None else threads, work)
        return values, slopes

    def _areas(self, solved: Solved, rows: Floats, mine: Indices, factors: Floats, weights: Floats) -> Floats:
        """The areas (kinds,) of one design, from its points (rows, POINTS, pieces); adds to the weights, (sums, rows,
        POINTS, all pieces), those of its pieces ``mine`` in the sums."""
        columns = solved.pieces.columns
        edges = np.append(columns[LOW][mine], columns[HIGH][mine][-1:])
        curves, found = self._curves(rows, edges), np.empty(len(self.kinds))
        for number, chosen in enumerate(self._chosen):
            hull = max((SweptHull(curves, own) for own in chosen), key=lambda each: each.area)
            found[number] = hull.area
            if factors[:, number].any():
                own = hull.weights().swapaxes(2, 3).reshape(rows.shape)
                weights[:, :, :, mine] += factors[:, number, None, None, None] * own
        return found

    def _curves(self, rows: Floats, edges: Floats) -> Curves:
        """The curves of a design's points, (rows, POINTS, pieces), between edges, s."""
        pieces = rows.shape[2]
        values = rows.reshape(len(self._keys), 2, rows.shape[1], pieces).swapaxes(2, 3)
        begins, ends = np.zeros((2, pieces), dtype=bool)
        spans = np.tile([0, pieces * rows.shape[1]], (len(values), 1))
        if not self.machine.course.turns:
            begins, ends = turned(self.machine.mechanism, edges, self.machine.course.closed)
            spans[:] = of_driver(self.machine.mechanism, edges)
        spans[(values == values[:, :, :1, :1]).all(axis=(1, 2, 3))] = 0, 1
        return Curves(values, begins, ends, spans)
