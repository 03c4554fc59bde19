"""A program as one function of machine code: loops over designs and positions around its lines, and its module."""

from __future__ import annotations

from dataclasses import dataclass

from linkwright.formula.ir_functions import Lanes, lookup_functions, vector_functions
from linkwright.formula.ir_lines import AccumulatorWriter, LineWriter
from linkwright.formula.operations import FUNCTIONS
from linkwright.formula.program import Lines
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


#: Texts of more lines than this are compiled without optimisation, in blocks: the time of the optimising
#: compiler grows with the square of a block's length, that of the plain one not.
LARGE = 6_000
#: Instructions of one block of a large program.
_BLOCK = 256
#: Name of the function: one argument, the address of the call block.
ENTRY = "linkwright_run"


class Block:
    """Places of the call block, an array of 64-bit numbers and addresses."""

    DESIGNS, LENGTH, COUNT, FULL_END, TAIL_START, TAIL_LOW, TAIL_HIGH, PARAMETERS, OUT = range(9)
    INPUTS = 9


@dataclass(frozen=True, slots=True)
class Shape:
    """Numbers of inputs of each kind and of outputs."""

    parameters: int
    positions: int
    fields: int
    outputs: int
    tables: int

    @classmethod
    def of(cls, lines: Lines, accumulation: Accumulation | None) -> Shape:
        """Counted from the lines, and what follows them."""
        kinds = [line.op for line in lines.lines]
        parameters, positions, fields = (kinds.count(kind) for kind in ("parameter", "position", "field"))
        tables = lines.tables if accumulation is None else len(accumulation.tables)
        return cls(parameters, positions, fields, len(lines.outputs), tables)


def in_blocks(label: str, code: list[str]) -> tuple[list[str], str]:
    """Instructions behind a label, cut into blocks if there are many; and the last block's label."""
    if len(code) <= LARGE // 2:
        return code, label
    cut: list[str] = []
    for number, first in enumerate(range(0, len(code), _BLOCK)):
        if number:
            next_label = f"{label}.{number}"
            cut += [f"br label %{next_label}", f"{next_label}:"]
        cut += code[first : first + _BLOCK]
    return cut, f"{label}.{number}"


def load_block(shape: Shape) -> list[str]:
    """Instructions that read the call block."""
    numbers = [
        ("designs", Block.DESIGNS),
        ("length", Block.LENGTH),
        ("count", Block.COUNT),
        ("full.end", Block.FULL_END),
        ("tail.start", Block.TAIL_START),
        ("tail.low", Block.TAIL_LOW),
        ("tail.high", Block.TAIL_HIGH),
    ]
    inputs = (("position", shape.positions), ("field", shape.fields), ("table", shape.tables))
    names = [f"{kind}{k}" for kind, count in inputs for k in range(count)]
    pointers = [("parameters", Block.PARAMETERS), ("out", Block.OUT)]
    pointers += [(name, Block.INPUTS + k) for k, name in enumerate(names)]
    code = []
    for kind, entries in (("i64", numbers), ("ptr", pointers)):
        for name, place in entries:
            code.append(f"%at.{name} = getelementptr i64, ptr %block, i64 {place}")
            code.append(f"%{name} = load {kind}, ptr %at.{name}, align 8")
    return code


def module_text(body: list[str], width: int) -> str:
    """The function with the declarations that it may need."""
    lanes, suffix = Lanes(width), f"v{width}f64"
    vector, integers, pointers, mask = lanes.vector, lanes.integers, lanes.pointers, lanes.mask
    exact = [f.exact for f in FUNCTIONS.values() if f.exact]
    declarations = [
        *(f"declare {vector} @llvm.{name}.{suffix}({vector})" for name in exact),
        *(f"declare double @llvm.{name}.f64(double)" for name in exact),
        *(f"declare double @llvm.vector.reduce.{name}.{suffix}({vector})" for name in ("fmin", "fmax")),
        f"declare double @llvm.vector.reduce.fadd.{suffix}(double, {vector})",
        *(f"declare i64 @llvm.vector.reduce.{name}.v{width}i64({integers})" for name in ("add", "smin", "or")),
        f"declare {vector} @llvm.masked.gather.{suffix}.v{width}p0({pointers}, i32, {mask}, {vector})",
        *(
            f"declare double @linkwright_{f.library}({', '.join(['double'] * len(f.slopes))}) "
            "nounwind willreturn readnone"
            for f in FUNCTIONS.values()
            if f.library
        ),
    ]
    return "\n".join([*declarations, *body, *lookup_functions(body, width), *vector_functions(body, width), ""])


def optimisation(text: str) -> int:
    """How much a module is to be optimised."""
    return 0 if text.count("\n") > LARGE else 3
