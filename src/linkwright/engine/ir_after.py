"""What is evaluated once per design after its last position, as LLVM intermediate representation."""

from __future__ import annotations

from linkwright.engine.ir_lines import LineWriter
from linkwright.engine.lines import Lines
from linkwright.engine.program import Program
from linkwright.engine.reductions import Accumulation


def following_lines(accumulation: Accumulation, after: Program, width: int) -> list[str]:
    """Instructions that evaluate ``after`` from ``%p.row`` and ``%r{k}``, and store its outputs.

    They go to ``%out.row``, behind the accumulators.
    """
    lines = Lines.of(after)
    writer = LineWriter(lines, width, wide=False)
    writer.tables = [accumulation.tables.index(name) for name in after.tables]
    code: list[str] = []
    for index, line in enumerate(lines.lines):
        writer.names[index] = f"%g{index}"
        if line.op == "parameter":
            origin, place = accumulation.source(after.parameters[line.place])
            if origin == "step":
                writer.names[index] = f"%r{place}"
            elif origin == "count":
                code.append(f"%g{index} = sitofp i64 %count to double")
            else:
                code.append(f"%g{index}.at = getelementptr double, ptr %p.row, i64 {place}")
                code.append(f"%g{index} = load double, ptr %g{index}.at, align 8")
        elif line.is_operation:
            writer.write(index)
    code += writer.preamble
    for place, index in enumerate(lines.outputs):
        to = f"%g.to{place}"
        code.append(f"{to} = getelementptr double, ptr %out.row, i64 {len(accumulation.steps) + place}")
        code.append(f"store double {writer.operand(index, False)}, ptr {to}, align 8")
    return code
