"""Forward derivatives: every line's change with one input."""

from __future__ import annotations

from collections.abc import Mapping

from linkwright.formula.functions import FUNCTIONS
from linkwright.formula.node import Node
from linkwright.formula.program import Program
from linkwright.formula.replay import WITHOUT_SLOPE, Replay, depending
from linkwright.formula.trace import Mask, Scalar, Trace, Value


def tangents(replay: Replay, name: str) -> dict[int, Scalar]:
    """d(line)/d(input) for every line that depends on the input."""
    program = replay.program
    found: dict[int, Scalar] = {}
    for index in sorted(depending(program, [name])):
        node = program.nodes[index]
        args = [replay.values[a] for a in node.args]
        found[index] = _tangent(replay.trace, node, args, replay.values[index], found) if args else 1.0
    return found


def slope(value: Scalar, seeds: Mapping[Value, Scalar]) -> Scalar:
    """Derivative of a value along changes of earlier values, in the same trace.

    ``seeds``: values (inputs, or any line) and their rates; what they depend on counts as constant.
    The result is a value like every other: it can be an output, and be differentiated again.
    Raises ValueError for values of different traces.
    """
    return Slopes(seeds)(value) if isinstance(value, Value) else 0.0


class Slopes:
    """Derivatives of values along the same changes of earlier ones, which share what they have in common."""

    def __init__(self, seeds: Mapping[Value, Scalar]) -> None:
        self.seeds = tuple(seeds)
        self.found: dict[int, Scalar] = {seed.index: rate for seed, rate in seeds.items()}

    def __call__(self, value: Value) -> Scalar:
        t, found = value.trace, self.found
        if any(seed.trace is not t for seed in self.seeds):
            raise ValueError("a value and what it is differentiated by must be of one trace")
        for index in t.needed([value.index], stop=found):
            if index in found:
                continue
            line = t.lines[index]
            args, slope = line[1:], 0.0  # type: tuple[int, ...], Scalar
            changing = [arg for arg in args if not _is_zero(found.get(arg, 0.0))]
            if changing and line[0] not in WITHOUT_SLOPE:
                slope = _tangent(t, t.node(index), [_line(t, arg) for arg in args], Value(t, index), found)
            found[index] = slope
        return found.get(value.index, 0.0)


def _line(t: Trace, index: int) -> Scalar:
    node = t.node(index)
    return node.constant if node.op == "constant" else Value(t, index)


def _tangent(t: Trace, node: Node, args: list[Scalar], value: Scalar, found: dict[int, Scalar]) -> Scalar:
    change = [found.get(a, 0.0) for a in node.args]
    if node.op in ("add", "sub"):
        return t.add(*change) if node.op == "add" else t.sub(*change)
    if node.op == "mul":
        return t.add(t.mul(change[0], args[1]), t.mul(args[0], change[1]))
    if node.op == "div":
        return t.mul(t.sub(change[0], t.mul(value, change[1])), t.div(1.0, args[1]))
    if node.op == "neg":
        return t.neg(change[0])
    if node.op == "select":
        condition: Mask = args[0] if isinstance(args[0], Value) else bool(args[0])
        return t.select(condition, change[1], change[2])
    total: Scalar = 0.0
    for place, rate in enumerate(change):
        if not _is_zero(rate):
            total = t.add(total, t.mul(rate, slope_of(t, node, args, value, place)))
    return total


def slope_of(t: Trace, node: Node, args: list[Scalar], value: Scalar, place: int) -> Scalar:
    """Derivative of a function or look-up by one of its arguments."""
    if node.op == "lookup":
        return t.lookup(node.name, args[0], int(node.constant) + 1)
    slope: Scalar = FUNCTIONS[node.op].slopes[place](t, args, value)
    return slope


def _is_zero(value: Scalar) -> bool:
    return not isinstance(value, Value) and value == 0.0


def numeric_outputs(program: Program) -> list[tuple[str, int]]:
    """Outputs that are numbers."""
    return [(name, i) for name, i in program.outputs if not program.yields_truth(i)]
