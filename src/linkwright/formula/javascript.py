"""Programs as JavaScript text: what browsers run where no WebAssembly module can be made.

A kernel is a function of plain arrays: ``(parameters, positions, fields, tables, out, n)``; ``positions``,
``fields`` and ``tables`` are lists of Float64Array, a table as in :attr:`Table.numbers`; ``out`` holds every output's
``n`` values, one output after the other.
"""

from __future__ import annotations

import math

from linkwright.formula.functions import FUNCTIONS
from linkwright.formula.lines import Line, Lines
from linkwright.formula.program import Program

_BETWEEN = {
    "add": "+",
    "sub": "-",
    "mul": "*",
    "div": "/",
    "less": "<",
    "less_equal": "<=",
    "and": "&&",
    "or": "||",
}
_INPUT = {"position": "positions[{0}][i]", "field": "fields[{0}][i]"}


def javascript(program: Program, name: str) -> str:
    """The program as the text of a function of that name; ``look(table, x, order)`` is expected beside it."""
    lines = Lines.of(program)
    design = [
        _stated(i, line) for i, line in enumerate(lines.lines) if not line.varies and line.op != "constant"
    ]
    loop = [_stated(i, line) for i, line in enumerate(lines.lines) if line.varies]
    stored = [f"out[{row}*n+i]={_number(lines, i)};" for row, i in enumerate(lines.outputs)]
    constants = [_constant(i, line.constant) for i, line in enumerate(lines.lines) if line.op == "constant"]
    return "\n".join(
        [
            f"function {name}(parameters,positions,fields,tables,out,n){{",
            *constants, *design, "for(let i=0;i<n;i++){", *loop, *stored, "}}",
        ]
    )  # fmt: skip


def _constant(index: int, value: float) -> str:
    if math.isinf(value):
        return f"const v{index}={'-' if value < 0 else ''}Infinity;"
    return f"const v{index}={'NaN' if math.isnan(value) else repr(value)};"


def _number(lines: Lines, index: int) -> str:
    return f"+v{index}" if lines.lines[index].truth else f"v{index}"


def _stated(index: int, line: Line) -> str:
    return f"const v{index}={_spelled(line)};"


def _spelled(line: Line) -> str:
    args = [f"v{each}" for each in line.args]
    if line.op in _BETWEEN:
        return f"{args[0]}{_BETWEEN[line.op]} {args[1]}"
    if line.op in FUNCTIONS:
        return f"Math.{line.op}({','.join(args)})"
    if line.op in _INPUT:
        return _INPUT[line.op].format(line.place)
    match line.op:
        case "parameter":
            return f"parameters[{line.place}]"
        case "lookup":
            return f"look(tables[{line.place}],{args[0]},{line.constant:.0f})"
        case "neg":
            return f"-{args[0]}"
        case "not":
            return f"!{args[0]}"
        case "select":
            return f"{args[0]}?{args[1]}:{args[2]}"
        case "number":
            return f"+{args[0]}"
        case "truth":
            return f"{args[0]}!==0"
    raise ValueError(f"'{line.op}' has no JavaScript")
