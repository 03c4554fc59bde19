"""Summaries of an output over the positions: what is accumulated, and what is made of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal, NamedTuple, get_args

import numpy as np

from linkwright.core.arrays import EQUAL, Flags, Floats, Integers
from linkwright.formula.program import Program
from linkwright.formula.replay import along_input

Kind = Literal["min", "max", "mean", "sum", "rms", "argmin", "argmax", "count"]
KINDS: tuple[str, ...] = get_args(Kind)
Results = dict[str, Floats | Integers]

#: The key of the number of valid positions among the results.
VALID_COUNT = "valid.count"


class Step(NamedTuple):
    """An accumulator: ``square`` sums squares."""

    kind: str
    output: str


@dataclass(frozen=True, slots=True)
class Reduction:
    """One summary of one output over the valid positions.

    ``kind``: ``min``, ``max``, ``mean``, ``sum``, ``rms`` (root of the mean square), ``argmin``
    and ``argmax`` (number of the first position with the extreme), ``count`` (number of valid
    positions where a truth output holds, or a number is not zero). Extremes skip NaN; the other kinds pass it on. Of
    values that are equal but for rounding the first position counts.
    """

    output: str
    kind: Kind

    @property
    def name(self) -> str:
        """The key among the results: ``output.kind``."""
        return f"{self.output}.{self.kind}"

    @classmethod
    def named(cls, name: str) -> Reduction:
        """The reduction whose key this is. Raises ValueError for a kind that does not exist."""
        for kind in get_args(Kind):
            if name.endswith(f".{kind}"):
                return cls(name.removesuffix(f".{kind}"), kind)
        raise ValueError(f"'{name}' is not a parameter, nor a reduction: use one of {', '.join(KINDS)}")

    @property
    def steps(self) -> tuple[Step, ...]:
        """The accumulators that it needs; the last one holds it."""
        kind, output = self.kind, self.output
        if kind in ("argmin", "argmax"):
            return Step(kind[3:], output), Step(kind, output)
        return (Step({"mean": "sum", "rms": "square"}.get(kind, kind), output),)


@dataclass(frozen=True)
class Accumulation:
    """The accumulators that a set of reductions of a program needs.

    ``steps``: the accumulators, each once. ``valid``: the truth output that says which positions enter, or None for
    all of them.
    """

    program: Program
    reductions: tuple[Reduction, ...]
    valid: str | None = None

    def __post_init__(self) -> None:
        names = set(self.program.output_names)
        for reduction in self.reductions:
            if reduction.kind not in KINDS:
                raise ValueError(f"there is no reduction '{reduction.kind}': use one of {', '.join(KINDS)}")
            if reduction.output not in names:
                raise ValueError(f"the program has no output '{reduction.output}' to reduce")
        if self.valid is not None and self.valid not in names:
            raise ValueError(f"the program has no output '{self.valid}' that says which positions are valid")

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        wanted = [step for r in self.reductions for step in r.steps]
        if self.valid is not None:
            wanted.append(Step("count", self.valid))
        return tuple(dict.fromkeys(wanted))

    @cached_property
    def split_by_design(self) -> tuple[Program, Accumulation] | None:
        """What is the same for all designs, and the rest; None where that is not worth while."""
        parted = along_input(self.program)
        if parted is None:
            return None
        return parted[0], replace(self, program=parted[1])

    @property
    def parameters(self) -> tuple[str, ...]:
        """The parameters that the reduced outputs depend on."""
        return self.needed.parameters

    @property
    def tables(self) -> tuple[str, ...]:
        """The tables that are looked up along the positions."""
        return self.needed.tables

    @cached_property
    def column(self) -> dict[Step, int]:
        """Where the accumulators stand in a row of the table."""
        return {step: place for place, step in enumerate(self.steps)}

    @property
    def width(self) -> int:
        """Numbers of one design."""
        return len(self.steps)

    @cached_property
    def needed(self) -> Program:
        """The program without the outputs that nothing here uses."""
        outputs = list(dict.fromkeys(step.output for step in self.steps))
        if set(outputs) == set(self.program.output_names):
            return self.program
        return self.program.only(outputs)

    @property
    def key(self) -> str:
        """What decides the code, besides the program."""
        return f"{self.steps} {self.valid} "

    def start(self, designs: int) -> Floats:
        """Accumulators before the first position, shape (designs, width)."""
        table = np.zeros((designs, self.width))
        for column, step in enumerate(self.steps):
            table[:, column] = _START.get(step.kind, 0.0)
        return table

    def finish(self, table: Floats, n: int) -> Results:
        """Results of every design from its table (designs, width) over ``n`` positions.

        Where no position is valid: NaN, position number -1, count 0 and sum 0.
        """
        rows = np.ascontiguousarray(table.T)
        valid = np.full(len(table), float(n))
        if self.valid is not None:
            valid = rows[self.column[Step("count", self.valid)]]
        results: Results = {}
        for reduction in self.reductions:
            accumulated = rows[self.column[reduction.steps[-1]]]
            results[reduction.name] = _result(reduction.kind, accumulated, valid)
        results[VALID_COUNT] = valid.astype(np.int64)
        return results


_START = {"min": np.inf, "max": -np.inf, "argmin": -1.0, "argmax": -1.0}


def _result(kind: str, accumulated: Floats, valid: Floats) -> Floats | Integers:
    if kind in ("argmin", "argmax", "count"):
        return accumulated.astype(np.int64)
    if kind in ("mean", "rms"):
        with np.errstate(invalid="ignore", divide="ignore"):
            mean = np.asarray(accumulated / valid)
            return mean if kind == "mean" else np.sqrt(mean)
    if kind in ("min", "max"):
        accumulated[accumulated == _START[kind]] = np.nan
    return accumulated


def accumulate(accumulation: Accumulation, table: Floats, outputs: Floats, names: Sequence[str], first: int) -> None:
    """Let positions ``first``… of (outputs, designs, positions) enter the accumulators (in place)."""
    rows = dict(zip(names, outputs, strict=True))
    mask = None if accumulation.valid is None else rows[accumulation.valid] != 0.0
    for column, step in enumerate(accumulation.steps):
        values, into = rows[step.output], table[:, column]
        if step.kind in ("min", "max"):
            _extreme(accumulation, step, rows, mask, table, first)
        elif step.kind == "count":
            held = (values != 0.0) if mask is None else (values != 0.0) & mask
            into += held.sum(axis=1)
        elif step.kind in ("sum", "square"):
            entering = values if mask is None else np.where(mask, values, 0.0)
            into += (entering if step.kind == "sum" else entering * entering).sum(axis=1)


def _extreme(
    accumulation: Accumulation, step: Step, rows: dict[str, Floats], mask: Flags | None, table: Floats, first: int
) -> None:
    """An extreme, and its position number."""
    values, into = rows[step.output], table[:, accumulation.column[step]]
    sign = 1.0 if step.kind == "min" else -1.0
    entering = np.where(np.isnan(values), np.inf, sign * values)
    if mask is not None:
        entering = np.where(mask, entering, np.inf)
    arg = accumulation.column.get(Step(f"arg{step.kind}", step.output))
    places = entering.argmin(axis=1)
    best = entering[np.arange(len(places)), places]
    if arg is not None:
        places = (entering <= _worse(best)[:, None]).argmax(axis=1)
        best = entering[np.arange(len(places)), places]
    better = np.flatnonzero((best if arg is None else _worse(best)) < sign * into)
    into[better] = sign * best[better]
    if arg is not None:
        table[better, arg] = first + places[better]


def _worse(values: Floats) -> Floats:
    """The largest values that are equal to some but for rounding."""
    return values * np.where(values > 0.0, 1.0 + EQUAL, 1.0 - EQUAL)
