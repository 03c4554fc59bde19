"""Accumulators of reductions as LLVM intermediate representation."""

from __future__ import annotations

from linkwright.engine.ir_lines import FAST, LineWriter, number
from linkwright.engine.reductions import Accumulation

_START = {"min": float("inf"), "max": float("-inf")}
_BETTER = {"min": "olt", "max": "ogt"}
#: The position number of an extreme that no number reached.
NO_INDEX = 2**62


class AccumulatorWriter:
    """Accumulator ``k`` is ``%a{k}`` at the start of a turn of the loop and ``%b{k}`` at its end.

    ``position``: the i64 vector of the lanes' position numbers; ``fresh``: the mask of the
    lanes that are not seen yet, or None where all lanes are.
    """

    def __init__(self, writer: LineWriter, accumulation: Accumulation, fresh: str | None) -> None:
        self.w = writer
        self.steps = accumulation.steps
        self.rows = dict(zip(accumulation.needed.output_names, writer.outputs, strict=True))
        self.integers = f"<{writer.width} x i64>"
        self._fresh = fresh
        self._valid = accumulation.valid
        self._column = accumulation.column
        self._masks: dict[str, str] = {}

    def kind(self, step: str) -> str:
        """LLVM type of an accumulator."""
        return self.integers if step in ("argmin", "argmax", "count") else self.w.vector

    def start(self, step: str) -> str:
        """Its value before the first position."""
        if step in ("argmin", "argmax"):
            return f"<{', '.join([f'i64 {NO_INDEX}'] * self.w.width)}>"
        if step in _START:
            return self.w.constant(_START[step], True)
        return "zeroinitializer"

    def update(self) -> list[str]:
        """Instructions that let a turn's positions enter."""
        code: list[str] = []
        for k, (step, output) in enumerate(self.steps):
            if step in _BETTER:
                code += self._extreme(k, step, output)
            elif step == "count":
                code += self._count(k, output)
            elif step in ("sum", "square"):
                code += self._sum(k, step, output)
        return code

    def finish_lanes(self, k: int, target: str) -> list[str]:
        """Instructions that bring the lanes of one accumulator together and store them."""
        step, output = self.steps[k]
        kind, value = self.kind(step), f"%b{k}"
        suffix = f"v{self.w.width}f64"
        if step in _BETTER:
            code = [f"%r{k} = call double @llvm.vector.reduce.f{step}.{suffix}({kind} {value})"]
        elif step in ("sum", "square"):
            total = f"call {FAST} double @llvm.vector.reduce.fadd.{suffix}"
            code = [f"%r{k} = {total}(double {number(-0.0)}, {kind} {value})"]
        elif step == "count":
            code = [
                f"%q{k} = call i64 @llvm.vector.reduce.add.v{self.w.width}i64({kind} {value})",
                f"%r{k} = sitofp i64 %q{k} to double",
            ]
        else:
            code = self._first_index(k, step, output)
        return [*code, f"store double %r{k}, ptr {target}"]

    def _first_index(self, k: int, step: str, output: str) -> list[str]:
        side = self._column[step.removeprefix("arg"), output]
        vector, mask = self.w.vector, self.w.mask
        none = self.start(step)
        return [
            *self.w.spread(f"%r{side}", f"%best{k}", "double"),
            f"%at{k} = fcmp oeq {vector} %b{side}, %best{k}",
            f"%i{k} = select {mask} %at{k}, {self.integers} %b{k}, {self.integers} {none}",
            f"%q{k} = call i64 @llvm.vector.reduce.smin.v{self.w.width}i64({self.integers} %i{k})",
            f"%none{k} = icmp eq i64 %q{k}, {NO_INDEX}",
            f"%p{k} = select i1 %none{k}, i64 -1, i64 %q{k}",
            f"%r{k} = sitofp i64 %p{k} to double",
        ]

    def as_double(self, k: int) -> tuple[list[str], str]:
        """One accumulator as a vector of numbers (the lanes are designs)."""
        step, _ = self.steps[k]
        if step in ("argmin", "argmax"):
            none = f"<{', '.join(['i64 -1'] * self.w.width)}>"
            code = [
                f"%none{k} = icmp eq {self.integers} %b{k}, {self.start(step)}",
                f"%p{k} = select {self.w.mask} %none{k}, {self.integers} {none}, {self.integers} %b{k}",
                f"%r{k} = sitofp {self.integers} %p{k} to {self.w.vector}",
            ]
            return code, f"%r{k}"
        if step == "count":
            return [f"%r{k} = sitofp {self.integers} %b{k} to {self.w.vector}"], f"%r{k}"
        return [], f"%b{k}"

    def _entering(self, code: list[str], *, once: bool) -> str | None:
        """The mask of the positions that enter; ``once``: a repeated position must not."""
        parts = [] if self._valid is None else [self._truth(code, self._valid)]
        if once and self._fresh is not None:
            parts.append(self._fresh)
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

    def _extreme(self, k: int, step: str, output: str) -> list[str]:
        code: list[str] = []
        vector, mask = self.w.vector, self.w.mask
        value = self.w.as_number(self.rows[output], code)
        entering = self._entering(code, once=False)
        code.append(f"%c{k} = fcmp {_BETTER[step]} {vector} {value}, %a{k}")
        arg = self._column.get(("arg" + step, output))
        if entering is None:
            code.append(f"%b{k} = select {mask} %c{k}, {vector} {value}, {vector} %a{k}")
        elif arg is None:
            code += [
                f"%e{k} = select {mask} %c{k}, {vector} {value}, {vector} %a{k}",
                f"%b{k} = select {mask} {entering}, {vector} %e{k}, {vector} %a{k}",
            ]
        else:
            code += [
                f"%e{k} = and {mask} %c{k}, {entering}",
                f"%b{k} = select {mask} %e{k}, {vector} {value}, {vector} %a{k}",
            ]
        if arg is not None:
            better = f"%c{k}" if entering is None else f"%e{k}"
            kinds = self.integers
            code.append(f"%b{arg} = select {mask} {better}, {kinds} %position, {kinds} %a{arg}")
        return code

    def _count(self, k: int, output: str) -> list[str]:
        code: list[str] = []
        held = self._truth(code, output)
        entering = self._entering(code, once=True)
        if entering is not None:
            code.append(f"%h{k} = and {self.w.mask} {held}, {entering}")
            held = f"%h{k}"
        return [
            *code,
            f"%o{k} = zext {self.w.mask} {held} to {self.integers}",
            f"%b{k} = add {self.integers} %a{k}, %o{k}",
        ]

    def _sum(self, k: int, step: str, output: str) -> list[str]:
        code: list[str] = []
        vector = self.w.vector
        value = self.w.as_number(self.rows[output], code)
        entering = self._entering(code, once=True)
        if step == "square":
            code.append(f"%squared{k} = fmul {FAST} {vector} {value}, {value}")
            value = f"%squared{k}"
        total = f"%b{k}" if entering is None else f"%t{k}"
        code.append(f"{total} = fadd {FAST} {vector} {value}, %a{k}")
        if entering is not None:
            code.append(f"%b{k} = select {self.w.mask} {entering}, {vector} %t{k}, {vector} %a{k}")
        return code
