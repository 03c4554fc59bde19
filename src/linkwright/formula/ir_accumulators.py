"""Accumulators of reductions as LLVM intermediate representation."""

from __future__ import annotations

from linkwright.core.arrays import EQUAL
from linkwright.formula.ir_functions import number
from linkwright.formula.ir_lines import FAST, LineWriter
from linkwright.formula.reductions import Accumulation, Step

_START = {"min": float("inf"), "max": float("-inf")}
_BETTER = {"min": "olt", "max": "ogt"}
#: Those that are better or as good, and which sign, times :data:`EQUAL`, makes a positive number worse.
_AS_GOOD, _WORSE = {"min": "ole", "max": "oge"}, {"min": 1.0, "max": -1.0}
#: The position number of an extreme that no number reached.
NO_INDEX = 2**62


class AccumulatorWriter:
    """Accumulator ``k`` is ``%a{k}`` at the start of a turn of the loop and ``%b{k}`` at its end.

    ``%position``: the i64 vector of the lanes' position numbers; ``%fresh``: the mask of the
    lanes that have no value yet.
    """

    def __init__(self, writer: LineWriter, accumulation: Accumulation) -> None:
        self.w = writer
        self.steps = accumulation.steps
        self.rows = dict(zip(accumulation.needed.output_names, writer.outputs, strict=True))
        self._valid = accumulation.valid
        self._column = accumulation.column
        self._masks: dict[str, str] = {}

    def kind(self, step: str) -> str:
        """LLVM type of an accumulator."""
        return self.w.integers if step in ("argmin", "argmax", "count") else self.w.vector

    def start(self, step: str) -> str:
        """Its value before the first position."""
        if step in ("argmin", "argmax"):
            return self.w.same("i64", NO_INDEX)
        if step in _START:
            return self.w.constant(_START[step], True)
        return "zeroinitializer"

    def update(self) -> list[str]:
        """Instructions that let a turn's positions enter."""
        code: list[str] = []
        for k, step in enumerate(self.steps):
            if step.kind in _BETTER:
                code += self._extreme(k, step)
            elif step.kind == "count":
                code += self._count(k, step.output)
            elif step.kind in ("sum", "square"):
                code += self._sum(k, step.kind, step.output)
        return code

    def finish_lanes(self, k: int) -> list[str]:
        """Instructions that bring the lanes of one accumulator together in ``%r{k}``.

        Extremes come first, then their position numbers.
        """
        step = self.steps[k]
        kind, value = self.kind(step.kind), f"%b{k}"
        suffix = f"v{self.w.width}f64"
        if step.kind in _BETTER:
            extreme = f"call nnan nsz double @llvm.vector.reduce.f{step.kind}.{suffix}"
            return [f"%r{k} = {extreme}({kind} {value})"]  # no NaN: only what compares as better came in
        if step.kind in ("sum", "square"):
            total = f"call {FAST} double @llvm.vector.reduce.fadd.{suffix}"
            return [f"%r{k} = {total}(double {number(-0.0)}, {kind} {value})"]
        if step.kind == "count":
            return [
                f"%q{k} = call i64 @llvm.vector.reduce.add.v{self.w.width}i64({kind} {value})",
                f"%r{k} = sitofp i64 %q{k} to double",
            ]
        return self._first_index(k, step)

    def _first_index(self, k: int, step: Step) -> list[str]:
        side = self._column[Step(step.kind.removeprefix("arg"), step.output)]
        vector, mask = self.w.vector, self.w.mask
        none, kind = self.start(step.kind), step.kind.removeprefix("arg")
        return [
            *self.w.spread(f"%r{side}", f"%best{k}", "double"),
            *self._worse(f"%equal{k}", f"%best{k}", kind),
            f"%at{k} = fcmp {_AS_GOOD[kind]} {vector} %b{side}, %equal{k}",
            f"%i{k} = select {mask} %at{k}, {self.w.integers} %b{k}, {self.w.integers} {none}",
            f"%q{k} = call i64 @llvm.vector.reduce.smin.v{self.w.width}i64({self.w.integers} %i{k})",
            f"%none{k} = icmp eq i64 %q{k}, {NO_INDEX}",
            f"%p{k} = select i1 %none{k}, i64 -1, i64 %q{k}",
            f"%r{k} = sitofp i64 %p{k} to double",
        ]

    def _entering(self, code: list[str], *, once: bool) -> str | None:
        """The mask of the positions that enter; ``once``: a repeated position must not."""
        parts = [] if self._valid is None else [self._truth(code, self._valid)]
        if once:
            parts.append("%fresh")
        if len(parts) < 2:
            return parts[0] if parts else None
        if "both" not in self._masks:
            self._masks["both"] = "%entering"
            code.append(f"%entering = and {self.w.mask} {parts[0]}, {parts[1]}")
        return self._masks["both"]

    def _truth(self, code: list[str], output: str) -> str:
        index = self.rows[output]
        operand = self.w.operand(index, True)
        if self.w.lines[index].truth:
            return operand
        name = f"%truth{index}"
        if name not in self._masks:
            self._masks[name] = name
            code.append(f"{name} = fcmp une {self.w.vector} {operand}, {self.w.constant(0.0, True)}")
        return name

    def _extreme(self, k: int, step: Step) -> list[str]:
        """An extreme, and its position number."""
        code: list[str] = []
        vector, mask = self.w.vector, self.w.mask
        value = self.w.as_number(self.rows[step.output], code)
        entering = self._entering(code, once=False)
        arg = self._column.get(Step(f"arg{step.kind}", step.output))
        compared = value
        if arg is not None:
            code += self._worse(f"%surely{k}", value, step.kind)
            compared = f"%surely{k}"
        code.append(f"%c{k} = fcmp {_BETTER[step.kind]} {vector} {compared}, %a{k}")
        better = f"%c{k}"
        if entering is not None and arg is None:
            return [
                *code,
                f"%e{k} = select {mask} %c{k}, {vector} {value}, {vector} %a{k}",
                f"%b{k} = select {mask} {entering}, {vector} %e{k}, {vector} %a{k}",
            ]
        if entering is not None:
            better = f"%e{k}"
            code.append(f"%e{k} = and {mask} %c{k}, {entering}")
        code.append(f"%b{k} = select {mask} {better}, {vector} {value}, {vector} %a{k}")
        if arg is not None:
            kinds = self.w.integers
            code.append(f"%b{arg} = select {mask} {better}, {kinds} %position, {kinds} %a{arg}")
        return code

    def _worse(self, name: str, value: str, kind: str) -> list[str]:
        """The worst values that are equal to some but for rounding."""
        vector, off = self.w.vector, _WORSE[kind] * EQUAL
        above, below = (self.w.constant(1.0 + each, True) for each in (off, -off))
        return [
            f"{name}_up = fcmp ogt {vector} {value}, {self.w.constant(0.0, True)}",
            f"{name}_by = select {self.w.mask} {name}_up, {vector} {above}, {vector} {below}",
            f"{name} = fmul {vector} {value}, {name}_by",
        ]

    def _count(self, k: int, output: str) -> list[str]:
        code: list[str] = []
        held, entering = self._truth(code, output), self._entering(code, once=True)
        return [
            *code,
            f"%h{k} = and {self.w.mask} {held}, {entering}",
            f"%o{k} = zext {self.w.mask} %h{k} to {self.w.integers}",
            f"%b{k} = add {self.w.integers} %a{k}, %o{k}",
        ]

    def _sum(self, k: int, step: str, output: str) -> list[str]:
        code: list[str] = []
        vector = self.w.vector
        value = self.w.as_number(self.rows[output], code)
        entering = self._entering(code, once=True)
        if step == "square":
            code.append(f"%squared{k} = fmul {FAST} {vector} {value}, {value}")
            value = f"%squared{k}"
        return [
            *code,
            f"%t{k} = fadd {FAST} {vector} {value}, %a{k}",
            f"%b{k} = select {self.w.mask} {entering}, {vector} %t{k}, {vector} %a{k}",
        ]
