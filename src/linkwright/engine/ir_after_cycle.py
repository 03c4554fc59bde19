"""What is evaluated once per design after its last position, as LLVM intermediate representation."""

from __future__ import annotations

from collections.abc import Callable

from linkwright.engine.ir_lines import LineWriter
from linkwright.engine.lines import Lines
from linkwright.engine.program import Program
from linkwright.engine.reductions import Accumulation


def following_lines(
    accumulation: Accumulation,
    following: Program,
    width: int,
    steps: list[str],
    load: Callable[[str, int], list[str]],
    *,
    wide: bool,
) -> tuple[list[str], list[str]]:
    """Instructions that evaluate ``following``, and the operands that hold its outputs.

    ``steps``: the accumulators' values; ``load(name, place)``: instructions that read a parameter of a
    design; ``wide``: whether the lanes are designs.
    """
    lines = Lines.of(following)
    writer = LineWriter(lines, width, wide=wide)
    writer.tables = [accumulation.tables.index(name) for name in following.tables]
    code: list[str] = []
    for index, line in enumerate(lines.lines):
        name = writer.names[index] = f"%g{index}"
        if line.op == "parameter":
            origin, place = accumulation.source(following.parameters[line.place])
            if origin == "step":
                writer.names[index] = steps[place]
            elif origin == "parameter":
                code += load(name, place)
            else:
                count = f"{name}.count" if wide else name
                code.append(f"{count} = sitofp i64 %count to double")
                code += writer.spread(count, name, "double") if wide else []
        elif line.is_operation:
            writer.write(index)
    return code + writer.preamble, [writer.operand(index, wide) for index in lines.outputs]
