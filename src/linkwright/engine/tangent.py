"""Forward derivatives: every line's change with one input."""

from __future__ import annotations

from linkwright.engine.program import Program
from linkwright.engine.replay import Replay, depending
from linkwright.engine.trace import Mask, Node, Scalar, Trace, Value


def tangents(replay: Replay, name: str) -> dict[int, Scalar]:
    """d(line)/d(input) for every line that depends on the input."""
    program = replay.program
    found: dict[int, Scalar] = {}
    for index in sorted(depending(program, [name])):
        node = program.nodes[index]
        found[index] = _tangent(replay, node, index, found) if node.args else 1.0
    return found


def _tangent(replay: Replay, node: Node, index: int, found: dict[int, Scalar]) -> Scalar:
    t, values = replay.trace, replay.values
    change = [found.get(a, 0.0) for a in node.args]
    args = [values[a] for a in node.args]
    if node.op in ("add", "sub"):
        return t.add(*change) if node.op == "add" else t.sub(*change)
    if node.op == "mul":
        return t.add(t.mul(change[0], args[1]), t.mul(args[0], change[1]))
    if node.op == "div":
        return t.mul(t.sub(change[0], t.mul(values[index], change[1])), t.div(1.0, args[1]))
    if node.op == "neg":
        return t.neg(change[0])
    if node.op == "select":
        condition: Mask = args[0] if isinstance(args[0], Value) else bool(args[0])
        return t.select(condition, change[1], change[2])
    return t.mul(change[0], slope(t, node.op, args[0], values[index]))


def slope(t: Trace, op: str, argument: Scalar, value: Scalar) -> Scalar:
    """Derivative of a function of one argument."""
    if op == "sqrt":
        return t.div(0.5, value)
    if op == "abs":
        return t.select(t.compare("less", argument, 0.0), -1.0, 1.0)
    if op == "sin":
        return t.unary("cos", argument)
    if op == "cos":
        return t.neg(t.unary("sin", argument))
    raise ValueError(f"the operation '{op}' has no derivative")


def numeric_outputs(program: Program) -> list[tuple[str, int]]:
    """Outputs that are numbers."""
    return [(name, i) for name, i in program.outputs if not program.yields_truth(i)]
