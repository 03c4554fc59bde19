"""Summaries of an output over the positions: what is accumulated, and what is made of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from linkwright.engine.program import Program

Kind = Literal["min", "max", "mean", "sum", "rms", "argmin", "argmax", "count"]
KINDS: tuple[str, ...] = get_args(Kind)
Floats = NDArray[np.float64]

#: The key of the number of valid positions among the results.
VALID_COUNT = "valid.count"

#: What a kind needs: accumulators of the same output.
_NEEDS: dict[str, tuple[str, ...]] = {
    "min": ("min",),
    "max": ("max",),
    "mean": ("sum",),
    "sum": ("sum",),
    "rms": ("square",),
    "argmin": ("min", "argmin"),
    "argmax": ("max", "argmax"),
    "count": ("count",),
}


@dataclass(frozen=True, slots=True)
class Reduction:
    """One summary of one output over the valid positions.

    ``kind``: ``min``, ``max``, ``mean``, ``sum``, ``rms`` (root of the mean square), ``argmin``
    and ``argmax`` (number of the first position with the extreme), ``count`` (number of valid
    positions where a truth output holds, or a number is not zero). Extremes skip NaN; the other
    kinds pass it on.
    """

    output: str
    kind: Kind

    @property
    def name(self) -> str:
        """The key among the results."""
        return f"{self.output}.{self.kind}"


@dataclass(frozen=True)
class Accumulation:
    """The accumulators that a set of reductions of a program needs.

    ``steps``: (accumulator, output), each once. ``valid``: the truth output that says which
    positions enter, or None for all of them. ``after``: a program per design, evaluated after
    the last position; its parameters are parameters of ``program``, or accumulators as
    ``output.sum``, ``output.square``, ``output.min``, ``output.max``, or ``valid.count``.
    """

    program: Program
    reductions: tuple[Reduction, ...]
    valid: str | None = None
    after: Program | None = None

    def __post_init__(self) -> None:
        names = set(self.program.output_names)
        if self.after is not None and (self.program.next_states or _has_positions(self.after)):
            raise ValueError("only a program per design, without states, can follow the positions")
        for reduction in self.reductions:
            if reduction.kind not in KINDS:
                raise ValueError(f"there is no reduction '{reduction.kind}': use one of {', '.join(KINDS)}")
            if reduction.output not in names:
                raise ValueError(f"the program has no output '{reduction.output}' to reduce")
        if self.valid is not None and self.valid not in names:
            raise ValueError(f"the program has no output '{self.valid}' that says which positions are valid")

    @cached_property
    def steps(self) -> tuple[tuple[str, str], ...]:
        wanted = [(step, r.output) for r in self.reductions for step in _NEEDS[r.kind]]
        if self.valid is not None:
            wanted.append(("count", self.valid))
        for name in self.after.parameters if self.after is not None else ():
            if name != VALID_COUNT and name not in self.program.parameters:
                output, _, step = name.rpartition(".")
                wanted.append((step, output))
        return tuple(dict.fromkeys(wanted))

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        """The parameters that the reduced outputs and what follows depend on."""
        following = self.after.parameters if self.after is not None else ()
        own = [name for name in following if name in self.program.parameters]
        return tuple(dict.fromkeys([*self.needed.parameters, *own]))

    @cached_property
    def tables(self) -> tuple[str, ...]:
        """The tables that are looked up along the positions and after them."""
        following = self.after.tables if self.after is not None else ()
        return tuple(dict.fromkeys([*self.needed.tables, *following]))

    @cached_property
    def column(self) -> dict[tuple[str, str], int]:
        """Where the accumulators stand in a row of the table."""
        return {step: place for place, step in enumerate(self.steps)}

    @property
    def width(self) -> int:
        """Numbers of one design: accumulators, then the outputs of what follows."""
        return len(self.steps) + (len(self.after.outputs) if self.after is not None else 0)

    def source(self, name: str) -> tuple[str, int]:
        """Where a parameter of ``after`` comes from: ("parameter" or "step", place), or ("count", 0)."""
        if name in self.program.parameters:
            return "parameter", self.parameters.index(name)
        if name == VALID_COUNT:
            return ("count", 0) if self.valid is None else ("step", self.column["count", self.valid])
        output, _, step = name.rpartition(".")
        return "step", self.column[step, output]

    @cached_property
    def needed(self) -> Program:
        """The program without the outputs that nothing here uses."""
        outputs = dict.fromkeys(output for _, output in self.steps)
        if set(outputs) == set(self.program.output_names):
            return self.program
        return self.program.only(list(outputs))

    @property
    def key(self) -> str:
        """What decides the code, apart from the program."""
        return f"{self.steps} {self.valid} {'' if self.after is None else self.after.key}"

    def start(self, designs: int) -> Floats:
        """Accumulators before the first position, shape (designs, width)."""
        table = np.zeros((designs, self.width))
        for column, (step, _) in enumerate(self.steps):
            table[:, column] = _START.get(step, 0.0)
        table[:, len(self.steps) :] = np.nan
        return table

    def finish(self, table: Floats, n: int) -> dict[str, NDArray[np.float64] | NDArray[np.int64]]:
        """Results of every design from its table (designs, width) over ``n`` positions.

        Where no position is valid: NaN, position number -1, count 0 and sum 0.
        """
        at = {step: table[:, column] for column, step in enumerate(self.steps)}
        valid = at["count", self.valid] if self.valid is not None else np.full(len(table), float(n))
        results: dict[str, NDArray[np.float64] | NDArray[np.int64]] = {}
        for reduction in self.reductions:
            results[reduction.name] = _result(reduction, at, valid)
        for place, (name, _) in enumerate(self.after.outputs if self.after is not None else ()):
            results[name] = table[:, len(self.steps) + place].copy()
        results[VALID_COUNT] = valid.astype(np.int64)
        return results


def _has_positions(program: Program) -> bool:
    return bool(program.positions or program.fields or program.states)


_START = {"min": np.inf, "max": -np.inf, "argmin": -1.0, "argmax": -1.0}


def _result(
    reduction: Reduction, at: dict[tuple[str, str], Floats], valid: Floats
) -> NDArray[np.float64] | NDArray[np.int64]:
    output, kind = reduction.output, reduction.kind
    if kind in ("argmin", "argmax", "count"):
        return at[kind, output].astype(np.int64)
    if kind == "sum":
        return at["sum", output].copy()
    with np.errstate(invalid="ignore", divide="ignore"):
        if kind == "mean":
            return np.asarray(at["sum", output] / valid)
        if kind == "rms":
            return np.sqrt(at["square", output] / valid)
    return np.where(valid > 0.0, at[kind, output], np.nan)


def accumulate(
    accumulation: Accumulation, table: Floats, outputs: Floats, names: Sequence[str], first: int
) -> None:
    """Let positions ``first``… of (outputs, designs, positions) enter the accumulators (in place)."""
    rows = dict(zip(names, outputs, strict=True))
    mask = None if accumulation.valid is None else rows[accumulation.valid] != 0.0
    column = accumulation.column
    for step, output in accumulation.steps:
        values, into = rows[output], table[:, column[step, output]]
        if step in ("min", "max"):
            side = "arg" + step
            arg = table[:, column[side, output]] if (side, output) in column else None
            _extreme(step, values, mask, into, arg, first)
        elif step == "count":
            held = (values != 0.0) if mask is None else (values != 0.0) & mask
            into += held.sum(axis=1)
        elif step in ("sum", "square"):
            entering = values if mask is None else np.where(mask, values, 0.0)
            into += (entering if step == "sum" else entering * entering).sum(axis=1)


def _extreme(
    step: str, values: Floats, mask: NDArray[np.bool_] | None, into: Floats, arg: Floats | None, first: int
) -> None:
    sign = 1.0 if step == "min" else -1.0
    entering = np.where(np.isnan(values), np.inf, sign * values)
    if mask is not None:
        entering = np.where(mask, entering, np.inf)
    best = entering.min(axis=1)
    better = best < sign * into
    into[better] = sign * best[better]
    if arg is not None:
        arg[better] = first + entering.argmin(axis=1)[better]
