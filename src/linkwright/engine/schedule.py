"""The order of a program's lines in machine code: values are found shortly before their use."""

from __future__ import annotations

from linkwright.engine.lines import Lines


def depth_first(lines: Lines) -> list[int]:
    """Every line once, after its arguments, following the outputs from first to last."""
    order: list[int] = []
    seen: set[int] = set()
    for root in (*lines.outputs, *lines.carried):
        stack = [(root, False)]
        while stack:
            index, ready = stack.pop()
            if ready:
                order.append(index)
            elif index not in seen:
                seen.add(index)
                stack.append((index, True))
                stack.extend((a, False) for a in reversed(lines.lines[index].args))
    return order
