"""Values and gradients of cycle programs: the stages backwards, through events and extremes.

A result of the last stages is followed back to the dimensions (reverse derivatives). An extreme over
the positions changes as the output does at its position (envelope theorem); the solution x of g(x, p) = 0
found by an iteration changes by dx/dp = -g_p / g_x (implicit function theorem).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.engine.cycle import CycleProgram, Known
from linkwright.engine.program import Program
from linkwright.engine.reductions import PLACE, VALID_COUNT, Accumulation, Reduction
from linkwright.engine.reverse_programs import (
    along_positions,
    back_from_formulas,
    back_from_solution,
    bar,
    with_slopes,
)
from linkwright.engine.stage import Stage
from linkwright.engine.summaries import Arrays, Backend, Run, over_designs, reduced
from linkwright.engine.table import Tables

Bars = dict[str, Floats]

Key = TypeVar("Key")

#: Reductions whose adjoint is spread over all valid positions.
_SPREAD = ("sum", "mean", "rms")
#: Reductions without a slope.
_STEPWISE = ("count", "argmin", "argmax")
_COUNT = Reduction("valid", "count")


def cycle_gradient(
    cycle: CycleProgram, value: str | Sequence[str], wrt: Sequence[str] | None = None
) -> CycleGradient:
    """Value and gradient of a result of a cycle program, or of several, with respect to dimensions.

    ``value``: names of results that are numbers; ``wrt``: names of dimensions, None for all of them.
    Kept fields, position numbers and counts are taken as constants. Raises ValueError for unknown names,
    and for stages on the way that carry states but do not say what they solve (``Stage.roots``).
    """
    names = cycle.dimensions if wrt is None else tuple(wrt)
    unknown = [name for name in names if name not in cycle.dimensions]
    if unknown:
        raise ValueError(f"the cycle program has no dimension {', '.join(unknown)}")
    values = (value,) if isinstance(value, str) else tuple(value)
    for each in values:
        if each not in cycle.results:
            raise ValueError(f"the cycle program has no result '{each}'")
    stages = cycle.stages
    if len(values) == 1:
        stages, first = _up_to(stages, values[0])
        values = (first,)
    active, wanted = set(names), set(values)
    for stage in stages:
        if any(name in active for name in stage.parameters):
            active |= set(stage.results)
    backwards: list[Backwards] = []
    for number in reversed(range(len(stages))):
        stage = stages[number]
        asked = tuple(name for name in stage.results if name in wanted and name in active)
        if asked:
            # a solution does not depend on where its search starts
            taken = stage.accumulation.parameters if stage.roots else stage.parameters
            own = tuple(name for name in taken if name in active)
            backwards.append(Backwards(number, stage, asked, own))
            wanted |= set(own)
    recorded = list(stages)
    for step in backwards:
        recorded[step.number] = step.recorded
    forwards, plain = (CycleProgram(tuple(each), cycle.dimensions) for each in (recorded, stages))
    return CycleGradient(forwards, plain, values, names, tuple(backwards))


def _up_to(stages: tuple[Stage, ...], value: str) -> tuple[tuple[Stage, ...], str]:
    """The stages that lead to a result, and its first name: formulas that only hand it on are left out."""
    last = next(k for k, stage in enumerate(stages) if value in stage.results)
    formulas, earlier = stages[last].formulas, {name for stage in stages[:last] for name in stage.results}
    if formulas is not None:
        output = stages[last].reductions[value].output
        node = formulas.nodes[dict(formulas.outputs)[output]]
        if node.name in earlier:
            return _up_to(stages[:last], node.name)
    return stages[: last + 1], value


@dataclass(frozen=True, eq=False)
class CycleGradient:
    """Values and gradients of results: the cycle program forwards, then for each some of its stages backwards.

    ``plain``: the stages for the values alone, whose names among their results are ``values``.
    """

    cycle: CycleProgram
    plain: CycleProgram
    values: tuple[str, ...]
    wrt: tuple[str, ...]
    backwards: tuple[Backwards, ...]

    @property
    def value(self) -> str:
        """The name of the first value."""
        return self.values[0]

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the columns that :meth:`evaluate` takes."""
        return self.cycle.dimensions

    def evaluate(
        self,
        table: ArrayLike,
        positions: Arrays | None = None,
        fields: Arrays | None = None,
        *,
        tables: Tables | None = None,
        threads: int | None = None,
        backend: Backend = "auto",
    ) -> tuple[Floats, Floats]:
        """The first value (designs,) and its gradient (designs, wrt), as :meth:`evaluate_all`."""
        values, gradients = self.evaluate_all(
            table, positions, fields, tables=tables, threads=threads, backend=backend
        )
        return values[0], gradients[0]

    def evaluate_all(
        self,
        table: ArrayLike,
        positions: Arrays | None = None,
        fields: Arrays | None = None,
        *,
        tables: Tables | None = None,
        threads: int | None = None,
        backend: Backend = "auto",
    ) -> tuple[Floats, Floats]:
        """All values (values, designs) and gradients (values, designs, wrt); inputs as for
        :meth:`CycleProgram.evaluate`. NaN for designs without the result.
        """
        count = len(np.asarray(table))
        values = np.empty((len(self.values), count))
        gradients = np.zeros((len(self.values), count, len(self.wrt)))
        first = 0
        for end, known, run in self.cycle.blocks(
            table, positions, fields, tables=tables, threads=threads, backend=backend
        ):
            for row, value in enumerate(self.values):
                values[row, first:end] = known.values[value]
                bars: Bars = {value: np.ones(end - first)}
                with np.errstate(all="ignore"):
                    for step in self.backwards:
                        step.pass_on(known, bars, run)
                for column, name in enumerate(self.wrt):
                    gradients[row, first:end, column] = bars.get(name, 0.0)
            first = end
        gradients[np.isnan(values)] = np.nan
        return values, gradients


class Backwards:
    """One stage backwards: from the adjoints of its results ``asked`` to those of what it takes, ``active``."""

    def __init__(self, number: int, stage: Stage, asked: tuple[str, ...], active: tuple[str, ...]) -> None:
        states = stage.accumulation.needed.states
        if states and (stage.steps is None or not stage.roots):
            raise ValueError(
                f"the states {', '.join(states)} have no gradient: say which outputs their iteration brings to "
                "zero (roots), or keep them as fields for a later stage"
            )
        self.number, self.stage, self.asked, self.active = number, stage, asked, active
        self._read = stage.accumulation.read
        self._programs: dict[object, Program] = {}
        self._sums: dict[tuple[Reduction, ...], Accumulation] = {}

    @cached_property
    def recorded(self) -> Stage:
        """The stage with everything among its results that the way back needs."""
        stage, program = self.stage, self.stage.program
        if stage.formulas is not None:
            return stage
        reductions = {**stage.reductions, **{self._name(r): r for r in self._read.values()}}
        if stage.roots:
            more = tuple((self._solved(state), index) for state, index in program.next_states)
            reductions |= {name: Reduction(name, "last") for name, _ in more}
            return replace(
                stage, program=replace(program, outputs=(*program.outputs, *more)), reductions=reductions
            )
        asked = self._asked
        if self._fused is not None:
            program, after = with_slopes(program, self._fused, self.active, stage.after, self._slope(""))
            stage = replace(stage, program=program, after=after)
        for reduction in (*asked, *self._read.values()):
            place = _place(reduction)
            if place is not None:
                reductions[self._name(place)] = place
            elif reduction.kind == "rms":
                reductions[self._name(reduction)] = reduction
        return replace(stage, reductions=reductions, count=stage.count or self._name(_COUNT))

    @property
    def _asked(self) -> list[Reduction]:
        return [r for name, r in self.stage.reductions.items() if name in self.asked]

    @cached_property
    def _fused(self) -> Reduction | None:
        """The only reduction over all positions, if it is the only one: its slopes are found on the way forwards."""
        spread = {r for r in (*self._asked, *self._read.values()) if r.kind in _SPREAD}
        return spread.pop() if len(spread) == 1 else None

    def _slope(self, parameter: str) -> str:
        return f"{self.number}:slope:{parameter}"

    def _name(self, reduction: Reduction) -> str:
        return f"{self.number}:{reduction.name}"

    def _solved(self, state: str) -> str:
        return f"{self.number}:solved:{state}"

    def pass_on(self, known: Known, bars: Bars, run: Run) -> None:
        """Let the adjoints of the results enter those of what the stage takes (in place)."""
        own = self.stage.manner(run)
        weights: dict[Reduction, Floats] = {}
        for name in self.asked:
            if name in self.stage.reductions and name in bars:
                _add(weights, self.stage.reductions[name], bars[name])
        self._through_following(known, bars, weights, own)
        smooth = {r: w for r, w in weights.items() if r.kind not in _STEPWISE}
        if self.stage.formulas is not None or self.stage.roots:
            outputs: Bars = {}
            for reduction, weight in smooth.items():
                _add(outputs, reduction.output, weight)
            self._through_formulas(known, bars, outputs, {}, own)
            return
        spread = {r: w for r, w in smooth.items() if r.kind in _SPREAD}
        if spread:
            self._through_positions(known, bars, spread, own)
        places: dict[Reduction, Bars] = {}
        for reduction, weight in smooth.items():
            place = _place(reduction)
            if place is not None:
                _add(places.setdefault(place, {}), reduction.output, weight)
        for place, outputs in places.items():
            self._through_formulas(known, bars, outputs, self._there(known, place, own), own)

    def _through_following(
        self, known: Known, bars: Bars, weights: dict[Reduction, Floats], run: Run
    ) -> None:
        """From the outputs of what follows the positions to the reductions that it takes."""
        after = self.stage.after
        outputs = tuple(name for name in self.asked if name in bars and name not in self.stage.reductions)
        if after is None or not outputs:
            return
        key = ("after", outputs)
        if key not in self._programs:
            self._programs[key] = back_from_formulas(after, outputs, (*self.active, *self._read))
        columns: dict[str, ArrayLike] = {bar(name): bars[name] for name in outputs}
        for name in after.parameters:
            if name in self._read:
                columns[name] = known.values[self._name(self._read[name])]
            else:
                columns[name] = self._count(known) if name == VALID_COUNT else known.column(name)
        for name, found in _evaluated(self._programs[key], columns, len(known.numbers), run):
            if name in self._read:
                _add(weights, self._read[name], found)
            else:
                _add(bars, name, found)

    def _through_positions(self, known: Known, bars: Bars, spread: dict[Reduction, Floats], run: Run) -> None:
        """Adjoints summed over all valid positions."""
        if self._fused is not None:
            for name in self.active:
                if self._slope(name) in known.values:
                    _add(bars, name, spread[self._fused] * known.values[self._slope(name)])
            return
        key = tuple(spread)
        if key not in self._sums:
            valid = self.stage.accumulation.valid
            self._sums[key] = along_positions(self.stage.program, key, self.active, valid)
        sums, given = self._sums[key], {}
        for reduction, weight in spread.items():
            share = weight if reduction.kind == "sum" else weight / self._count(known)
            if reduction.kind == "rms":
                share = share / known.values[self._name(reduction)]
            given[bar(reduction.name)] = share
        table = np.empty((len(known.numbers), len(sums.parameters)))
        for column, name in enumerate(sums.parameters):
            table[:, column] = given[name] if name in given else known.column(name)
        fields = {name: known.fields[name] for name in sums.needed.fields}
        found = reduced(sums, table, fields, None, run)
        for name in self.active:
            if bar(name) in found:
                _add(bars, name, np.asarray(found[bar(name)], dtype=np.float64))

    def _through_formulas(
        self, known: Known, bars: Bars, outputs: Bars, inputs: Mapping[str, ArrayLike], run: Run
    ) -> None:
        """One position of every design, or the solution of an iteration."""
        source, key = self.stage.program, tuple(outputs)
        if not outputs:
            return
        if key not in self._programs:
            if self.stage.roots:
                program = back_from_solution(source, self.stage.roots, key, self.active)
            else:
                program = back_from_formulas(source, key, self.active)
            self._programs[key] = program
        columns: dict[str, ArrayLike] = {bar(name): weight for name, weight in outputs.items()}
        columns |= {name: known.column(name) for name in source.parameters}
        columns |= {name: known.values[self._solved(name)] for name in source.states}
        columns |= inputs
        for name, found in _evaluated(self._programs[key], columns, len(known.numbers), run):
            _add(bars, name, found)

    def _there(self, known: Known, place: Reduction, run: Run) -> dict[str, Floats]:
        """The inputs at one position of every design, NaN where there is none."""
        numbers = np.asarray(known.values[self._name(place)], dtype=np.float64)
        missing = np.isnan(numbers)
        index, designs = np.where(missing, 0.0, numbers).astype(np.int64), np.arange(len(numbers))
        source = self.stage.program
        found = {name: np.asarray(run.positions[name])[index] for name in source.positions}
        found |= {name: known.fields[name][designs, index] for name in source.fields}
        return {name: np.where(missing, np.nan, values) for name, values in found.items()}

    def _count(self, known: Known) -> Floats:
        return np.asarray(known.values[self.recorded.count], dtype=np.float64)


def _evaluated(
    program: Program, columns: Mapping[str, ArrayLike], count: int, run: Run
) -> Iterator[tuple[str, Floats]]:
    """The adjoints that a program gives, by the names of the inputs."""
    rows = over_designs(program, {name: columns[name] for name in program.positions}, count, run)
    for name, row in zip(program.output_names, rows, strict=True):
        yield name.removeprefix(bar("")), row


def _place(reduction: Reduction) -> Reduction | None:
    """The number of the one position whose value a reduction is."""
    if reduction.kind in ("first", "last"):
        return Reduction(PLACE, reduction.kind)
    if reduction.of:
        return Reduction(PLACE, reduction.kind, reduction.of)
    if reduction.kind == "min":
        return Reduction(PLACE, "at_min", reduction.output)
    return Reduction(PLACE, "at_max", reduction.output) if reduction.kind == "max" else None


def _add(into: dict[Key, Floats], key: Key, value: Floats) -> None:
    into[key] = into[key] + value if key in into else value
