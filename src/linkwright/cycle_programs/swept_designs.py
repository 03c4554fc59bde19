"""Swept areas of many designs, with gradients: curves of all designs from one evaluation, each one's hull alone."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output
from linkwright.core.piecewise import POINTS, tails
from linkwright.cycle_programs.followed_points import followed_points
from linkwright.cycle_programs.gauss_cycle import GaussCycle
from linkwright.cycle_programs.metric_cycle import Found
from linkwright.cycle_programs.terms import Term, chosen_subjects, metric_of
from linkwright.cycle_programs.timed_cycle import TimedCycle, can_go_together, gauss_points
from linkwright.cycle_programs.traced_outputs import VALID, Traced, design_table
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.cycle_gradient import CycleGradient, cycle_gradient
from linkwright.engine.program import Program
from linkwright.engine.reductions import Reduction
from linkwright.engine.stage import Backend, Stage
from linkwright.engine.trace import Scalar
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinetostatics.traced_loads import AlongInput
from linkwright.mechanism.mechanism import Mechanism
from linkwright.metrics import Analysis
from linkwright.metrics.cycle_grid import PIECES
from linkwright.metrics.swept_area import of_driver, points, turned
from linkwright.metrics.swept_hull import Curves, SweptHull

#: Designs whose curves are kept at the same time.
BLOCK = 256
#: Share of the largest extent up to which polynomials meet the curves.
MET = 1e-7
_PASSED, _TOTAL = "passed", "total"


def swept(name: str, mechanism: Mechanism) -> dict[str, tuple[str, ...]]:
    """The points of the subjects of a registered number that is the area of a hull; none for another."""
    metric, subject = metric_of(name) or (None, "")
    known = {} if metric is None else metric().swept(mechanism)
    return {each: known[each] for each in (chosen_subjects(name, subject, known) if known else ())}


def swept_designs(mechanism: Mechanism, varied: Iterable[str], names: Iterable[str]) -> SweptDesigns | None:
    """The areas of hulls among some design numbers, ``swept_area``, ``swept_area_of_link jaw``; None where none is,
    or the designs cannot go side by side: the cycle is no whole number of turns of one driver of constant speed,
    or the way passes change points."""
    asked, addresses = [name for name in names if swept(name, mechanism)], tuple(varied)
    if not asked:
        return None
    traced = Traced(mechanism, addresses, over_cycle(mechanism, 360))
    if not can_go_together(traced, addresses):
        return None
    gauss = gauss_points(traced, AlongInput(frozenset()), Analysis.of(traced.nominal), PIECES)
    return None if gauss is None else SweptDesigns(traced, gauss, asked)


class SweptDesigns:
    """Areas of hulls of one mechanism's designs; of several links the largest. Made by :func:`swept_designs`."""

    def __init__(self, traced: Traced, gauss: GaussCycle | TimedCycle, names: Iterable[str]) -> None:
        self.traced, self._keys = traced, points(traced.mechanism)
        self.terms = tuple(Term(name, (), "area", "lower") for name in names)
        number = {key: k for k, key in enumerate(self._keys)}
        groups = [swept(each.name, traced.mechanism).values() for each in self.terms]
        self._chosen = [[[number[key] for key in own] for own in subjects] for subjects in groups]
        self._gauss = gauss
        self._followed = followed_points(traced, gauss) if isinstance(gauss, GaussCycle) else None
        places = self._places()
        self._rows = tuple(places)
        self._trace, self._signals = self._gauss.signals(places)

    def _places(self) -> dict[str, Scalar]:
        found: dict[str, Scalar] = {}
        for key in self._keys:
            place = self.traced.solver.outputs.point(key)[0]
            found |= {Output("position", key, axis).row: getattr(place, axis) for axis in "xy"}
        return found

    @cached_property
    def _curves_of(self) -> CycleProgram:
        """The places of all points at the Gauss points, as fields."""
        found = {name: self._signals[name] for name in (*self._rows, VALID)}
        reductions = {_PASSED: Reduction(self._rows[0], "first")}
        stage = Stage(Program.of(self._trace, found), reductions, valid=VALID, complete=True, keep=self._rows)
        return CycleProgram((*self._gauss.cut_stages(), stage))

    @cached_property
    def _backwards(self) -> CycleGradient:
        """The sum of all places with known weights."""
        total: Scalar = 0.0
        for name in self._rows:
            total = total + self._trace.field_input(f"by {name}") * self._signals[name]
        found = {_TOTAL: total, VALID: self._signals[VALID]}
        stage = Stage(
            Program.of(self._trace, found), {_TOTAL: Reduction(_TOTAL, "sum")}, valid=VALID, complete=True
        )
        return cycle_gradient(CycleProgram((*self._gauss.cut_stages(), stage)), _TOTAL, self.dimensions)

    @property
    def dimensions(self) -> tuple[str, ...]:
        """Those of the varied dimensions on which the areas depend."""
        free = self.traced.solver.manner.free
        return tuple(name for name in self._curves_of.dimensions if name in free)

    def evaluate(
        self, columns: Mapping[str, Floats], *, threads: int | None = None, backend: Backend = "auto"
    ) -> Found:
        """The areas of the designs with the given columns, (designs,) each."""
        values, _, _ = self._found(columns, np.empty((0, len(self.terms))), threads, backend)
        rows = dict(zip((each.name for each in self.terms), values, strict=True))
        return Found(rows, np.asarray(np.isfinite(values).all(axis=0)))

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
        factors = np.array([[weights.get(each.name, 0.0) for each in self.terms] for weights in sums])
        values, fields, carried = self._found(columns, factors, threads, backend)
        table, names = self._table(self._backwards.cycle, columns), [f"by {name}" for name in self._rows]
        slopes = np.full((*fields.shape[:2], len(by)), np.nan)
        places = [self._backwards.wrt.index(name) for name in by]
        for slope, field in zip(slopes, fields, strict=True):
            given = dict(zip(names, field.swapaxes(0, 1), strict=True))
            _, found = self._backwards.evaluate(
                table, self._gauss.positions, given | carried, threads=threads, backend=backend
            )
            slope[:] = found[:, places]
        return factors @ values, slopes

    def _found(
        self, columns: Mapping[str, Floats], factors: Floats, threads: int | None, backend: Backend
    ) -> tuple[Floats, Floats, dict[str, Floats]]:
        """Areas (terms, designs), derivatives (sums, designs, rows, n) of their sums by factors (sums, terms), and
        the coordinates of groups without closed form (designs, n) by name."""
        table = self._table(self._curves_of, columns)
        values = np.full((len(self.terms), len(table)), np.nan)
        fields = np.zeros((len(factors), len(table), len(self._rows), self._gauss.count))
        carried: list[dict[str, Floats]] = []
        for first in range(0, len(table), BLOCK):
            part = table[first : first + BLOCK]
            carried.append(self._carried(columns, slice(first, first + BLOCK), backend))
            ((_, known, _),) = self._curves_of.blocks(
                part, self._gauss.positions, carried[-1], threads=threads, backend=backend
            )
            rows = np.stack([known.fields[name] for name in self._rows], axis=1)
            for k in np.flatnonzero(np.isfinite(known.values[_PASSED])).tolist():
                curves = self._curves(rows[k])
                if tails(curves.values).max() > MET * np.ptp(curves.values, axis=(2, 3)).max():
                    continue
                for number, chosen in enumerate(self._chosen):
                    hull = max((SweptHull(curves, own) for own in chosen), key=lambda each: each.area)
                    values[number, first + k] = hull.area
                    if factors[:, number].any():
                        weights = hull.weights().swapaxes(2, 3).reshape(len(self._rows), -1)
                        fields[:, first + k] += factors[:, number, None, None] * weights
        return (
            values,
            fields,
            {n: np.concatenate([part[n] for part in carried]) for n in next(iter(carried), {})},
        )

    def _carried(self, columns: Mapping[str, Floats], designs: slice, backend: Backend) -> dict[str, Floats]:
        """The coordinates of groups without closed form of some designs."""
        if self._followed is None:
            return {}
        part = {address: column[designs] for address, column in columns.items()}
        return self._followed.of(part, self._known, backend)

    @property
    def _known(self) -> dict[str, float]:
        return {**self.traced.solver.nominal.parameters, **self._gauss.constants}

    def _curves(self, rows: Floats) -> Curves:
        """The curves of a design's points, (rows, n)."""
        pieces = self._gauss.pieces
        values = rows.reshape(len(self._keys), 2, POINTS, pieces).swapaxes(2, 3)
        begins, ends = np.zeros((2, pieces), dtype=bool)
        spans = np.tile([0, self._gauss.count], (len(values), 1))
        if isinstance(self._gauss, TimedCycle):
            edges, closed = np.array(self._gauss.edges), self.traced.positions.closed
            begins, ends = turned(self.traced.mechanism, edges, closed)
            spans[:] = of_driver(self.traced.mechanism, edges)
        spans[(values == values[:, :, :1, :1]).all(axis=(1, 2, 3))] = 0, 1
        return Curves(values, begins, ends, spans)

    def _table(self, cycle: CycleProgram, columns: Mapping[str, Floats]) -> Floats:
        return design_table(cycle.dimensions, self._known, columns)
