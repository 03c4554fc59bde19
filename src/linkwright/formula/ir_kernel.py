"""A program as one function of machine code: loops over designs and positions around its lines."""

from __future__ import annotations

from linkwright.formula.ir_accumulators import AccumulatorWriter
from linkwright.formula.ir_lines import LineWriter
from linkwright.formula.ir_module import ENTRY, Shape, in_blocks, load_block, module_text, optimisation
from linkwright.formula.lines import Lines
from linkwright.formula.reductions import Accumulation


def kernel(lines: Lines, width: int, accumulation: Accumulation | None, *, library: bool = False) -> tuple[str, int]:
    """The module, and how much it is to be optimised; ``library``: functions are called from outside, by lanes."""
    text = Kernel(lines, width, accumulation, library).text()
    return text, optimisation(text)


class Kernel:
    """Lanes are positions: full vectors first, then the last ones, overlapping the others."""

    def __init__(self, lines: Lines, width: int, accumulation: Accumulation | None, library: bool) -> None:
        self.lines = lines
        self.shape = Shape.of(lines, accumulation)
        self.width = width
        self.accumulation = accumulation
        self.writer = LineWriter(lines, width, library=library)
        self.sums = None if accumulation is None else AccumulatorWriter(self.writer, accumulation)

    def text(self) -> str:
        """The module's text."""
        self._write_lines()
        updates = [] if self.sums is None else self._updates()
        preamble, ready = in_blocks("design", [*self._design_inputs(), *self.writer.preamble])
        body = [
            f"define void @{ENTRY}(ptr noalias readonly %block) nounwind {{",
            "entry:",
            *load_block(self.shape),
            *self._tail_mask(),
            "br label %design",
            "design:",
            "%d = phi i64 [ 0, %entry ], [ %d.next, %advance ]",
            *preamble,
            "br label %segment",
            *self._segment(f"%{ready}"),
            *self._loop(updates),
            *self._finish(),
            "}",
        ]
        return module_text(body, self.width)

    def _write_lines(self) -> None:
        rows: dict[int, list[int]] = {}
        for row, index in enumerate(self.lines.outputs):
            rows.setdefault(index, []).append(row)
        for index, line in enumerate(self.lines.lines):
            if line.is_operation:
                self.writer.write(index)
            elif line.op in ("position", "field"):
                self.writer.body += self._load(index)
            if self.sums is None:
                for row in rows.get(index, ()):
                    self._store(row, index)

    def _load(self, index: int) -> list[str]:
        line = self.lines.lines[index]
        base = f"%position{line.place}" if line.op == "position" else f"%fieldrow{line.place}"
        return [
            f"%l{index} = getelementptr double, ptr {base}, i64 %i",
            f"%v{index} = load {self.writer.vector}, ptr %l{index}, align 8",
        ]

    def _store(self, row: int, index: int) -> None:
        code: list[str] = []
        value = self.writer.as_number(index, code)
        self.writer.body += [
            *code,
            f"%o{row} = getelementptr double, ptr %row{row}, i64 %i",
            f"store {self.writer.vector} {value}, ptr %o{row}, align 8",
        ]

    def _design_inputs(self) -> list[str]:
        shape, accumulation = self.shape, self.accumulation
        parameters = shape.parameters if accumulation is None else len(accumulation.parameters)
        code = [f"%p.at = mul i64 %d, {parameters}", "%p.row = getelementptr double, ptr %parameters, i64 %p.at"]
        for index, line in enumerate(self.lines.lines):
            if line.op == "parameter":
                code += [
                    f"%pp{index} = getelementptr double, ptr %p.row, i64 {line.place}",
                    f"%v{index} = load double, ptr %pp{index}, align 8",
                ]
        if shape.fields:
            code.append("%f.at = mul i64 %d, %length")
        for place in range(shape.fields):
            code.append(f"%fieldrow{place} = getelementptr double, ptr %field{place}, i64 %f.at")
        return code + self._out_rows()

    def _out_rows(self) -> list[str]:
        if self.accumulation is not None:
            width = self.accumulation.width
            return [f"%o.at = mul i64 %d, {width}", "%out.row = getelementptr double, ptr %out, i64 %o.at"]
        code = [f"%o.step = mul i64 %length, {self.shape.outputs}", "%o.at = mul i64 %d, %o.step"]
        code.append("%row0 = getelementptr double, ptr %out, i64 %o.at")
        for row in range(1, self.shape.outputs):
            code.append(f"%row{row} = getelementptr double, ptr %row{row - 1}, i64 %length")
        return code

    def _tail_mask(self) -> list[str]:
        integers, lanes = self.writer.integers, self.writer.numbers()
        return [
            *self.writer.spread("%tail.low", "%low", "i64"),
            *self.writer.spread("%tail.high", "%high", "i64"),
            f"%above = icmp sge {integers} {lanes}, %low",
            f"%below = icmp slt {integers} {lanes}, %high",
            f"%tail.mask = and {self.writer.mask} %above, %below",
            "%has.full = icmp sgt i64 %full.end, 0",
            "%has.tail = icmp sge i64 %tail.start, 0",
            f"%tail.end = add i64 %tail.start, {self.width}",
            "%first.start = select i1 %has.full, i64 0, i64 %tail.start",
            "%first.end = select i1 %has.full, i64 %full.end, i64 %tail.end",
            "%first.again = and i1 %has.full, %has.tail",
            f"%first.mask = select i1 %has.full, {self.writer.mask} "
            f"{self.writer.all_true}, {self.writer.mask} %tail.mask",
        ]

    def _segment(self, ready: str) -> list[str]:
        mask = self.writer.mask
        return [
            "segment:",
            f"%start = phi i64 [ %first.start, {ready} ], [ %tail.start, %turned ]",
            f"%end = phi i64 [ %first.end, {ready} ], [ %tail.end, %turned ]",
            f"%again = phi i1 [ %first.again, {ready} ], [ false, %turned ]",
            f"%fresh = phi {mask} [ %first.mask, {ready} ], [ %tail.mask, %turned ]",
            *self._phis("s", {ready: None, "%turned": "b"}),
            "br label %loop",
        ]

    def _phis(self, name: str, sources: dict[str, str | None]) -> list[str]:
        code = []
        for k, step in enumerate(self.sums.steps if self.sums else ()):
            assert self.sums is not None
            values = {
                origin: self.sums.start(step.kind) if value is None else f"%{value}{k}"
                for origin, value in sources.items()
            }
            edges = ", ".join(f"[ {value}, {origin} ]" for origin, value in values.items())
            code.append(f"%{name}{k} = phi {self.sums.kind(step.kind)} {edges}")
        return code

    def _updates(self) -> list[str]:
        assert self.sums is not None
        code = self.sums.update()
        if any(step.kind.startswith("arg") for step in self.sums.steps):
            position = [
                *self.writer.spread("%i", "%i.all", "i64"),
                f"%position = add {self.writer.integers} %i.all, {self.writer.numbers()}",
            ]
            code = position + code
        return code

    def _loop(self, updates: list[str]) -> list[str]:
        code, last = in_blocks("loop", [*self.writer.body, *updates])
        return [
            "loop:",
            f"%i = phi i64 [ %start, %segment ], [ %i.next, %{last} ]",
            *self._phis("a", {"%segment": "s", f"%{last}": "b"}),
            *code,
            f"%i.next = add i64 %i, {self.width}",
            "%more = icmp slt i64 %i.next, %end",
            "br i1 %more, label %loop, label %turned",
            "turned:",
            "br i1 %again, label %segment, label %finish",
        ]

    def _finish(self) -> list[str]:
        code: list[str] = []
        steps = self.sums.steps if self.sums is not None else ()
        for k in sorted(range(len(steps)), key=lambda k: "arg" in steps[k].kind):
            assert self.sums is not None
            code += self.sums.finish_lanes(k)
            code += self._store_result(k, f"%r{k}")
        return [
            "finish:",
            *in_blocks("finish", code)[0],
            "br label %advance",
            "advance:",
            "%d.next = add i64 %d, 1",
            "%d.more = icmp slt i64 %d.next, %designs",
            "br i1 %d.more, label %design, label %done",
            "done:",
            "ret void",
        ]

    def _store_result(self, place: int, value: str) -> list[str]:
        """Store one number of a design's row of results."""
        return [
            f"%z{place} = getelementptr double, ptr %out.row, i64 {place}",
            f"store double {value}, ptr %z{place}, align 8",
        ]
