"""Values and gradients of formulas of summaries over the positions, for many designs at once, and of programs.

The value is differentiated back to the parameters (reverse mode); an extreme over the positions changes as the
output does at its position (envelope theorem).

Where they go back over the positions, the adjoint of a number is the derivative of the objective with respect to it;
its name is :func:`bar`.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import cached_property
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.formula.differentiation import Adjoints, numeric_outputs, tangents
from linkwright.formula.program import Program
from linkwright.formula.reductions import VALID_COUNT, Accumulation, Reduction, Results
from linkwright.formula.replay import Replay, across_designs, depending
from linkwright.formula.summaries import Arrays, How, Run, in_blocks, over_designs, reduced
from linkwright.formula.trace import Scalar, Trace

#: Reductions whose adjoint is spread over all valid positions.
_SPREAD = ("sum", "mean", "rms")
#: Reductions without a slope.
_STEPWISE = ("count", "argmin", "argmax")
_VALUE, _SLOPES = "value", "slopes"
#: Configurations of a block.
_BLOCK = 1 << 23
Columns = dict[str, ArrayLike]


class Gradient:
    """The value of ``total`` and its gradient by the parameters ``wrt``, all of them by default.

    ``total``: a summary of the program's outputs, or a program per design with one output, whose parameters are
    parameters of ``program`` and names of summaries as ``output.mean``. Only positions where the output ``valid``
    holds enter (all, without such an output); ``complete``: a design with another one has no value.
    """

    def __init__(
        self,
        program: Program,
        total: Program | Reduction,
        wrt: Iterable[str] | None = None,
        *,
        valid: str | None = "valid",
        complete: bool = False,
    ) -> None:
        self.program, self.complete = program, complete
        self.total = total if isinstance(total, Program) else _of_one(total)
        self.valid = valid if valid in program.output_names else None
        own = [name for name in self.total.parameters if name in program.parameters]
        read = [name for name in self.total.parameters if name not in (*own, VALID_COUNT)]
        self.read = {name: Reduction.named(name) for name in read}
        needed = Accumulation(program, tuple(self.read.values()), self.valid).needed.parameters
        self.parameters = tuple(name for name in program.parameters if name in {*needed, *own})
        self.wrt = program.parameters if wrt is None else tuple(wrt)
        unknown = [name for name in self.wrt if name not in program.parameters]
        if unknown:
            raise ValueError(f"the program has no parameter {', '.join(unknown)}")
        self._programs: dict[tuple[str, ...], Program] = {}

    # the way forwards -----------------------------------------------------------------------------------
    @cached_property
    def _values(self) -> Program:
        return across_designs(self.total)

    @cached_property
    def _forwards(self) -> Accumulation:
        """All summaries that the value and the way back need."""
        asked = list(self.read.values())
        places = [place for each in asked if (place := _place(each)) is not None]
        program, lines = self.program, []
        if self._fused is not None:
            program, _ = self._along
            lines = [name for name in program.output_names if name not in self.program.output_names]
        sums = [Reduction(name, "sum") for name in lines]
        return Accumulation(program, tuple(dict.fromkeys([*asked, *places, *sums])), self.valid)

    @cached_property
    def _fused(self) -> Reduction | None:
        """The only summary over all positions, if it is the only one: its slopes are found on the way forwards."""
        spread = {each for each in self.read.values() if each.kind in _SPREAD}
        return spread.pop() if len(spread) == 1 else None

    @cached_property
    def _along(self) -> tuple[Program, Program]:
        """What is summed over the positions on the way back, and what follows from the sums."""
        spread = tuple(dict.fromkeys(each for each in self.read.values() if each.kind in _SPREAD))
        return along_positions(self.program, spread, self.wrt, fused=self._fused is not None)

    def values(
        self, table: ArrayLike, positions: Arrays | None = None, fields: Arrays | None = None, **how: Unpack[How]
    ) -> Floats:
        """The value alone, (designs,)."""
        plain = Accumulation(self.program, tuple(self.read.values()), self.valid)

        def found(numbers: Floats, rows: Arrays, run: Run) -> Results:
            return {_VALUE: self._value(numbers, self._reduced(plain, numbers, rows, run), run)}

        return np.asarray(in_blocks(found, _BLOCK, self.parameters, table, positions, fields, **how)[_VALUE])

    def _reduced(self, sums: Accumulation, numbers: Floats, fields: Arrays, run: Run) -> Results:
        if sums.parameters != self.parameters:
            places = [self.parameters.index(name) for name in sums.parameters]
            numbers = np.ascontiguousarray(numbers[:, places])
        return reduced(sums, numbers, _own(sums, fields), run)

    def _columns(self, numbers: Floats, results: Results) -> Columns:
        return {**dict(zip(self.parameters, numbers.T, strict=True)), **results}

    @cached_property
    def _alone(self) -> str | None:
        """The summary that the value is; None for a formula of some."""
        ((_, line),) = self.total.outputs
        name = self.total.nodes[line].name if not self.total.nodes[line].args else None
        return name if name in self.read else None

    def _value(self, numbers: Floats, results: Results, run: Run) -> Floats:
        if self._alone is not None:
            value: Floats = np.array(results[self._alone], dtype=np.float64)
        else:
            columns = self._columns(numbers, results)
            columns_by_name = {name: np.asarray(columns[name], dtype=np.float64) for name in self._values.positions}
            value = over_designs(self._values, columns_by_name, len(numbers), run)[0].copy()
        if self.complete:
            value[results[VALID_COUNT] != run.length] = np.nan
        return value

    # the way back ---------------------------------------------------------------------------------------
    def evaluate(
        self, table: ArrayLike, positions: Arrays | None = None, fields: Arrays | None = None, **how: Unpack[How]
    ) -> tuple[Floats, Floats]:
        """Value (designs,) and gradient (designs, wrt); NaN for designs without the value.

        ``table``: (designs, parameters); ``positions``: (n,) per name; ``fields``: (designs, n) per name.
        """
        found = in_blocks(self._sloped, _BLOCK, self.parameters, table, positions, fields, **how)
        return np.asarray(found[_VALUE]), np.asarray(found[_SLOPES])

    def _sloped(self, numbers: Floats, fields: Arrays, run: Run) -> Results:
        """Value and gradient of some designs."""
        results = self._reduced(self._forwards, numbers, fields, run)
        value = self._value(numbers, results, run)
        with np.errstate(all="ignore"):
            bars = self._back(numbers, results, fields, run)
        gradient = np.zeros((len(numbers), len(self.wrt)))
        for column, name in enumerate(self.wrt):
            gradient[:, column] = bars.get(name, 0.0)
        gradient[np.isnan(value)] = np.nan
        return {_VALUE: value, _SLOPES: gradient}

    def _back(self, numbers: Floats, results: Results, fields: Arrays, run: Run) -> dict[str, Floats]:
        """Derivatives of the value by the parameters, (designs,) by name."""
        columns = self._columns(numbers, results)
        if self._alone is not None:
            return self._from_summaries({self._alone: np.ones(len(numbers))}, columns, fields, run)
        found = self._through(
            self.total,
            self.total.output_names,
            (*self.wrt, *self.read),
            {**columns, bar(self.total.output_names[0]): np.ones(len(numbers))},
            len(numbers),
            run,
        )
        bars = {name: each for name, each in found.items() if name in self.wrt}
        _add(bars, self._from_summaries(found, columns, fields, run))
        return bars

    def _from_summaries(
        self, found: Mapping[str, Floats], columns: Columns, fields: Arrays, run: Run
    ) -> dict[str, Floats]:
        """From derivatives by the summaries those by the parameters."""
        bars: dict[str, Floats] = {}
        count = len(np.asarray(columns[VALID_COUNT]))
        weights: dict[Reduction, Floats] = {}
        for name, reduction in self.read.items():
            if name in found and reduction.kind not in _STEPWISE:
                weights[reduction] = weights.get(reduction, 0.0) + found[name]
        spread = {each: weight for each, weight in weights.items() if each.kind in _SPREAD}
        if spread:
            _add(bars, self._through_positions(columns, spread, fields, run))
        places: dict[Reduction, dict[str, Floats]] = {}
        for each, weight in weights.items():
            place = _place(each)
            if place is not None:
                there = places.setdefault(place, {})
                there[each.output] = there.get(each.output, 0.0) + weight
        for place, outputs in places.items():
            there_columns = {**columns, **self._there(columns[place.name], fields, run)}
            there_columns |= {bar(name): weight for name, weight in outputs.items()}
            _add(bars, self._through(self.program, tuple(outputs), self.wrt, there_columns, count, run))
        return bars

    def _through(
        self, source: Program, outputs: Sequence[str], active: Sequence[str], columns: Columns, count: int, run: Run
    ) -> dict[str, Floats]:
        """From derivatives by outputs, columns of their own, those by inputs at one position of every design."""
        key = (str(source is self.program), *outputs)
        if key not in self._programs:
            self._programs[key] = back_from_formulas(source, outputs, active)
        return _evaluated(self._programs[key], columns, count, run)

    def _through_positions(
        self, columns: Columns, spread: Mapping[Reduction, Floats], fields: Arrays, run: Run
    ) -> dict[str, Floats]:
        """Derivatives by what is summed over all valid positions."""
        count = np.asarray(columns[VALID_COUNT], dtype=np.float64)
        shares: dict[Reduction, Floats] = {}
        for each, weight in spread.items():
            shares[each] = weight if each.kind == "sum" else weight / count
            if each.kind == "rms":
                shares[each] = shares[each] / np.asarray(columns[each.name])
        along, after = self._along
        if self._fused is None:
            names = [name for name in along.output_names if name not in self.program.output_names]
            sums = Accumulation(along, tuple(Reduction(name, "sum") for name in names), self.valid)
            columns_by_name: Columns = {**columns, **{bar(name): 0.0 for name in self.read}}
            columns_by_name |= {bar(each.name): share for each, share in shares.items()}
            table = np.empty((len(count), len(sums.parameters)))
            for column, name in enumerate(sums.parameters):
                table[:, column] = columns_by_name[name]
            columns = {**columns, **reduced(sums, table, _own(sums, fields), run)}
        found = _evaluated(after, columns, len(count), run)
        if self._fused is not None:
            found = {name: each * shares[self._fused] for name, each in found.items()}
        return found

    def _there(self, places: ArrayLike, fields: Arrays, run: Run) -> dict[str, Floats]:
        """The inputs at one position of every design, NaN where there is none."""
        numbers = np.asarray(places, dtype=np.float64)
        missing = ~(numbers >= 0.0)
        index, designs = np.where(missing, 0.0, numbers).astype(np.int64), np.arange(len(numbers))
        found = {name: np.asarray(run.positions[name])[index] for name in self.program.positions}
        found |= {name: np.asarray(fields[name])[designs, index] for name in self.program.fields}
        return {name: np.where(missing, np.nan, values) for name, values in found.items()}


def _own(accumulation: Accumulation, fields: Arrays) -> Arrays:
    return {name: fields[name] for name in accumulation.needed.fields}


def _of_one(reduction: Reduction) -> Program:
    """A summary as a program per design."""
    t = Trace()
    return Program.of(t, {_VALUE: t.parameter(reduction.name)})


def _evaluated(program: Program, columns: Columns, count: int, run: Run) -> dict[str, Floats]:
    """Derivatives that a program over the designs gives, by the names of the inputs."""
    columns_by_name = {name: np.asarray(columns[name], dtype=np.float64) for name in program.positions}
    rows = over_designs(program, columns_by_name, count, run)
    return {name.removeprefix(bar("")): row for name, row in zip(program.output_names, rows, strict=True)}


def _place(reduction: Reduction) -> Reduction | None:
    """The number of the one position whose value a reduction is."""
    if reduction.kind == "min":
        return Reduction(reduction.output, "argmin")
    return Reduction(reduction.output, "argmax") if reduction.kind == "max" else None


def _add(into: dict[str, Floats], more: Mapping[str, Floats]) -> None:
    for name, value in more.items():
        into[name] = into[name] + value if name in into else value


def bar(name: str) -> str:
    """The name of a number's adjoint."""
    return f"bar:{name}"


def back_from_formulas(program: Program, outputs: Sequence[str], active: Collection[str]) -> Program:
    """Adjoints of the active inputs from those of the outputs; all inputs are positions, one for a design."""
    t = Trace()
    names = (*program.parameters, *program.positions, *program.fields)
    replay = Replay(program, trace=t, inputs={name: t.position(name) for name in names})
    adjoints = Adjoints(replay, depending(program, active))
    places = dict(program.outputs)
    for name in outputs:
        adjoints.add(places[name], replay.trace.position(bar(name)))
    adjoints.sweep_back(set(range(len(program.nodes))))
    return Program.of(replay.trace, _of_inputs(program, active, adjoints))


def along_positions(
    program: Program, reductions: Sequence[Reduction], active: Collection[str], *, fused: bool
) -> tuple[Program, Program]:
    """What of the adjoints of the active parameters is summed over the positions, besides the outputs, and from the
    sums, ``line.sum``, and the parameters the adjoints themselves, across designs.

    What a position's output weighs is a parameter, the adjoint of the reduction's name: of a sum the adjoint itself,
    of a mean divided by the count, of a root mean square divided by the count and the root. ``fused``: for the only
    reduction it is 1.
    """
    replay = Replay(program)
    weights: dict[Reduction, Scalar] = {
        each: 1.0 if fused else replay.trace.parameter(bar(each.name)) for each in reductions
    }
    along = Program.of(replay.trace, {**replay.outputs, **_lines(replay, weights, active)})
    return along, across_designs(_after_positions(program, active, along))


def _lines(replay: Replay, weights: Mapping[Reduction, Scalar], active: Collection[str]) -> dict[str, Scalar | bool]:
    """At one position the adjoints of the active lines per design."""
    program = replay.program
    lines, places = depending(program, active), dict(program.outputs)
    adjoints = Adjoints(replay, lines)
    for reduction, weight in weights.items():
        place = places[reduction.output]
        if reduction.kind == "rms":
            weight = replay.trace.mul(weight, replay.values[place])
        adjoints.add(place, weight)
    adjoints.sweep_back({i for i, node in enumerate(program.nodes) if node.varies})
    found = {index: adjoints.found.get(index) for index in boundary(program, lines)}
    return {f"line {index}": adjoint.value for index, adjoint in found.items() if adjoint is not None}


def _after_positions(program: Program, active: Collection[str], along: Program) -> Program:
    """From the sums of the adjoints of the lines per design those of the parameters."""
    fixed = [i for i, node in enumerate(program.nodes) if not node.varies]
    replay = Replay(program, fixed)
    adjoints = Adjoints(replay, depending(program, active))
    summed = set(along.output_names)
    for index in fixed:
        if f"line {index}" in summed:
            adjoints.add(index, replay.trace.parameter(f"line {index}.sum"))
    adjoints.sweep_back(set(fixed))
    return Program.of(replay.trace, _of_inputs(program, active, adjoints))


def boundary(program: Program, active: set[int]) -> list[int]:
    """Active lines per design that lines per position or outputs use."""
    used = {a for node in program.nodes if node.varies for a in node.args}
    used.update(i for _, i in program.outputs)
    return sorted(i for i in used if i in active and not program.nodes[i].varies)


def _of_inputs(program: Program, active: Collection[str], adjoints: Adjoints) -> dict[str, Scalar | bool]:
    """The adjoints of the active inputs by name; inputs without one are left out."""
    found: dict[str, Scalar] = {}
    for index, node in enumerate(program.nodes):
        if not node.args and node.name in active and index in adjoints.found:
            found[bar(node.name)] = found.get(bar(node.name), 0.0) + adjoints.found[index].value
    return dict(found)


#: The result that is the sum of the seeds times the outputs.


def forward(program: Program, wrt: Sequence[str]) -> Program:
    """A program with the outputs of ``program`` and ``output|input`` = d(output)/d(input).

    ``wrt``: names of parameters, positions or fields. What is under ``stop``
    counts as constant; truth outputs have no derivative. Cost: about one to two evaluations
    per input. Raises ValueError for an input that the program does not have.
    """
    _check_inputs(wrt, (*program.parameters, *program.positions, *program.fields))
    replay = Replay(program)
    outputs = replay.outputs
    for name in wrt:
        found = tangents(replay, name)
        for output, index in numeric_outputs(program):
            outputs[f"{output}|{name}"] = found.get(index, 0.0)
    return Program.of(replay.trace, outputs)


def reverse(
    program: Program, seeds: Sequence[str], wrt: Sequence[str] | None = None, valid: str | None = "valid"
) -> Gradient:
    """The gradient of sum over positions of seed times output, for seeds at evaluation.

    ``seeds``: names of outputs; each one's weights are a field ``seed:output`` (designs, n). ``wrt``: names of
    parameters, None for all of them in the order of the program. Only the positions where the output ``valid`` holds
    enter (all, without such an output). ``stop`` and fields are constants. Raises ValueError for unknown names.
    """
    _check_inputs(wrt or (), program.parameters)
    unknown = [name for name in seeds if name not in dict(numeric_outputs(program))]
    if unknown:
        raise ValueError(f"the program has no output {', '.join(unknown)} to differentiate")
    replay = Replay(program)
    total: Scalar = 0.0
    for name in seeds:
        total = total + replay.trace.field_input(f"seed:{name}") * replay.outputs[name]
    outputs = {_VALUE: total} | ({valid: replay.outputs[valid]} if valid in program.output_names else {})
    return Gradient(Program.of(replay.trace, outputs), Reduction(_VALUE, "sum"), wrt, valid=valid)


def _check_inputs(names: Sequence[str], known: Sequence[str]) -> None:
    unknown = [name for name in names if name not in known]
    if unknown:
        raise ValueError(f"the program has no input {', '.join(unknown)} to differentiate by")
