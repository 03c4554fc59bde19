"""The text of a module of machine code around a program's lines: its call block, its blocks, its declarations."""

from __future__ import annotations

from dataclasses import dataclass

from linkwright.formula.functions import FUNCTIONS
from linkwright.formula.ir_functions import vector_functions
from linkwright.formula.ir_lookup import lookup_functions
from linkwright.formula.ir_vectors import Lanes
from linkwright.formula.lines import Lines
from linkwright.formula.reductions import Accumulation

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
