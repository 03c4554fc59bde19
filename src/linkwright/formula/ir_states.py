"""A program that carries states, as machine code: lanes are designs, positions one after another."""

from __future__ import annotations

from linkwright.formula.ir_accumulators import AccumulatorWriter
from linkwright.formula.ir_lines import LineWriter
from linkwright.formula.ir_module import ENTRY, Shape, in_blocks, load_block, module_text
from linkwright.formula.lines import Lines
from linkwright.formula.reductions import Accumulation


class StateKernel:
    """The last vector repeats the last design in the lanes that are left over."""

    def __init__(self, lines: Lines, width: int, accumulation: Accumulation | None, library: bool) -> None:
        self.lines = lines
        self.shape = Shape.of(lines, accumulation)
        self.width = width
        self.accumulation = accumulation
        self.writer = LineWriter(lines, width, wide=True, library=library)
        self.sums = None if accumulation is None else AccumulatorWriter(self.writer, accumulation, None)

    def text(self) -> str:
        """The module's text."""
        self._write_lines()
        updates = [] if self.sums is None else self.sums.update()
        preamble, ready = in_blocks("design", [*self._design_inputs(), *self.writer.preamble])
        code, last = in_blocks("loop", [*self._position_inputs(), *self.writer.body, *updates])
        body = [
            f"define void @{ENTRY}(ptr noalias readonly %block) nounwind {{",
            "entry:",
            *load_block(self.shape),
            "%last = sub i64 %designs, 1",
            *self.writer.spread("%last", "%last.all", "i64"),
            *self._splat("%length", "%length.all"),
            "br label %design",
            "design:",
            "%d = phi i64 [ 0, %entry ], [ %d.next, %advance ]",
            *preamble,
            "br label %loop",
            "loop:",
            f"%i = phi i64 [ 0, %{ready} ], [ %i.next, %{last} ]",
            *self._phis(f"%{ready}", f"%{last}"),
            *code,
            "%i.next = add i64 %i, 1",
            "%more = icmp slt i64 %i.next, %length",
            "br i1 %more, label %loop, label %finish",
            *self._finish(),
            "}",
        ]
        return module_text(body, self.width)

    def _splat(self, scalar: str, name: str) -> list[str]:
        return self.writer.spread(scalar, name, "i64")

    def _write_lines(self) -> None:
        for index, line in enumerate(self.lines.lines):
            if line.is_operation:
                self.writer.write(index)
        if self.sums is not None:
            return
        for row, index in enumerate(self.lines.outputs):
            value = self.writer.as_number(index, self.writer.body)
            self.writer.body += [
                f"%o{row}.row = mul i64 %length, {row}",
                f"%o{row}.at = add i64 %o{row}.row, %i",
                f"%o{row}.base = getelementptr double, ptr %out, i64 %o{row}.at",
                *self.writer.scatter(value, f"%o{row}.base", "%out.offset", f"%o{row}"),
            ]

    def _design_inputs(self) -> list[str]:
        stored, kind = self.sums is None, self.writer.integers

        def numbers(value: int) -> str:
            return self.writer.same("i64", value)

        row = numbers(self.shape.outputs if self.accumulation is None else self.accumulation.width)
        parameters = self.shape.parameters if self.accumulation is None else len(self.accumulation.parameters)
        code = [
            *self._splat("%d", "%d.all"),
            f"%d.lanes = add {kind} %d.all, {self.writer.numbers()}",
            f"%d.below = icmp slt {kind} %d.lanes, %last.all",
            f"%lane = select {self.writer.mask} %d.below, {kind} %d.lanes, {kind} %last.all",
            f"%parameter.offset = mul {kind} %lane, {numbers(parameters)}",
            f"%state.offset = mul {kind} %lane, {numbers(self.shape.states)}",
            f"%field.offset = mul {kind} %lane, %length.all",
            f"%row.offset = mul {kind} %lane, {row}",
        ]
        factor = "%length.all" if stored else numbers(1)
        code.append(f"%out.offset = mul {kind} %row.offset, {factor}")
        for index, line in enumerate(self.lines.lines):
            if line.op in ("parameter", "state"):
                table = "%parameters" if line.op == "parameter" else "%starts"
                name = f"%v{index}" if line.op == "parameter" else f"%start{line.place}"
                code.append(f"%base{index} = getelementptr double, ptr {table}, i64 {line.place}")
                code += self.writer.gather(name, f"%base{index}", f"%{line.op}.offset")
        return code

    def _parameter(self, name: str, place: int) -> list[str]:
        base = f"{name}.base = getelementptr double, ptr %parameters, i64 {place}"
        return [base, *self.writer.gather(name, f"{name}.base", "%parameter.offset")]

    def _phis(self, ready: str, last: str) -> list[str]:
        v = self.writer
        code = []
        for index, line in enumerate(self.lines.lines):
            if line.op == "state":
                following = v.operand(self.lines.carried[line.place], True)
                edges = f"[ %start{line.place}, {ready} ], [ {following}, {last} ]"
                code.append(f"%v{index} = phi {v.vector} {edges}")
        for k, step in enumerate(self.sums.steps if self.sums else ()):
            assert self.sums is not None
            edges = f"[ {self.sums.start(step.kind)}, {ready} ], [ %b{k}, {last} ]"
            code.append(f"%a{k} = phi {self.sums.kind(step.kind)} {edges}")
        return code

    def _position_inputs(self) -> list[str]:
        code = self._splat("%i", "%position")
        for index, line in enumerate(self.lines.lines):
            if line.op == "position":
                code += [
                    f"%l{index} = getelementptr double, ptr %position{line.place}, i64 %i",
                    f"%x{index} = load double, ptr %l{index}, align 8",
                    *self.writer.spread(f"%x{index}", f"%v{index}", "double"),
                ]
            elif line.op == "field":
                code.append(f"%l{index} = getelementptr double, ptr %field{line.place}, i64 %i")
                code += self.writer.gather(f"%v{index}", f"%l{index}", "%field.offset")
        return code

    def _finish(self) -> list[str]:
        code: list[str] = []
        values: list[str] = []
        for k in range(len(self.sums.steps) if self.sums else 0):
            assert self.sums is not None
            converted, value = self.sums.as_double(k)
            code += converted
            values.append(value)
        for k, value in enumerate(values):
            code.append(f"%z{k} = getelementptr double, ptr %out, i64 {k}")
            code += self.writer.scatter(value, f"%z{k}", "%out.offset", f"%z{k}")
        return [
            "finish:",
            *in_blocks("finish", code)[0],
            "br label %advance",
            "advance:",
            f"%d.next = add i64 %d, {self.width}",
            "%d.more = icmp slt i64 %d.next, %designs",
            "br i1 %d.more, label %design, label %done",
            "done:",
            "ret void",
        ]
