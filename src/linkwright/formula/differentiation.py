"""Exact derivatives of a program's lines: forward, in reverse, and by symbols that only stand for other values."""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass

from linkwright.formula.operations import FUNCTIONS, Node
from linkwright.formula.program import Program
from linkwright.formula.replay import WITHOUT_SLOPE, Replay, depending, operations
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


@dataclass(slots=True)
class Adjoint:
    """d(objective)/d(line); zero wherever ``mask`` does not hold (None: everywhere meant)."""

    value: Scalar
    mask: Mask | None = None


class Adjoints:
    """Adjoints of the lines of a replayed program, gathered from their uses.

    Behind a selection an adjoint is zero where the other branch is taken. There the lines may
    be infinite or NaN, so products with them are selected to zero, not multiplied by it.
    """

    def __init__(self, replay: Replay, active: set[int]) -> None:
        self._replay = replay
        self._trace = replay.trace
        self._active = active
        self.found: dict[int, Adjoint] = {}

    def add(self, index: int, value: Scalar, mask: Mask | None = None) -> None:
        """Let a use of a line enter."""
        if index not in self._active or (isinstance(value, float) and value == 0.0):
            return
        known = self.found.get(index)
        if known is None:
            self.found[index] = Adjoint(value, mask)
            return
        known.value = self._trace.add(known.value, value)
        if known.mask is not None:
            known.mask = self._either(known.mask, mask)

    def _either(self, one: Mask, other: Mask | None) -> Mask | None:
        """Where at least one holds; None where that is everywhere."""
        if other is None or one == self._trace.negate(other) or other == self._trace.negate(one):
            return None
        return self._trace.logic("or", one, other)

    def sweep_back(self, chosen: set[int]) -> None:
        """Pass the adjoints of the chosen lines on to their arguments, last line first."""
        for index in operations(self._replay.program, chosen & self._active):
            adjoint = self.found.get(index)
            if adjoint is not None:
                self._pass_on(index, self._replay.program.nodes[index], adjoint)

    def _pass_on(self, index: int, node: Node, adjoint: Adjoint) -> None:
        t, values, g, mask = self._trace, self._replay.values, adjoint.value, adjoint.mask
        args = node.args
        if node.op in ("add", "sub"):
            self.add(args[0], g, mask)
            self.add(args[1], g if node.op == "add" else t.neg(g), mask)
        elif node.op == "neg":
            self.add(args[0], t.neg(g), mask)
        elif node.op == "select":
            self._pass_on_choice(args, g, mask)
        elif node.op == "mul":
            for one, other in (args, args[::-1]):
                if one in self._active:
                    self.add(one, self._product(g, values[other], mask), mask)
        elif node.op == "div":
            share = self._product(g, t.div(1.0, values[args[1]]), mask)
            self.add(args[0], share, mask)
            if args[1] in self._active:
                self.add(args[1], t.neg(self._product(share, values[index], mask)), mask)
        else:
            arguments = [values[a] for a in args]
            for place, arg in enumerate(args):
                if arg in self._active:
                    factor = slope_of(t, node, arguments, values[index], place)
                    self.add(arg, self._product(g, factor, mask), mask)

    def _pass_on_choice(self, args: tuple[int, ...], g: Scalar, mask: Mask | None) -> None:
        t = self._trace
        mask_value = self._replay.values[args[0]]
        condition: Mask = mask_value if isinstance(mask_value, Value) else bool(mask_value)
        branches = ((args[1], condition), (args[2], t.negate(condition)))
        for place, (branch, holds) in enumerate(branches):
            if branch not in self._active:
                continue
            part = t.select(condition, g, 0.0) if place == 0 else t.select(condition, 0.0, g)
            self.add(branch, part, holds if mask is None else t.logic("and", mask, holds))

    def _product(self, g: Scalar, factor: Scalar, mask: Mask | None) -> Scalar:
        product = self._trace.mul(g, factor)
        return product if mask is None else self._trace.select(mask, product, 0.0)


class Symbols:
    """The symbols of the equations in a trace, which all share the same ones, and with them their derivatives."""

    def __init__(self, trace: Trace) -> None:
        self.trace = trace
        self._all: list[Value] = []
        self._in: dict[int, tuple[Value, ...]] = {}
        self._slopes: dict[tuple[int, int], Scalar] = {}

    def number(self, k: int) -> Value:
        """The symbol of a number, from 0."""
        while len(self._all) <= k:
            self._all.append(self.trace.position(f"~{len(self._all)}"))
        return self._all[k]

    def derivatives(self, value: Scalar, moving: Container[int]) -> list[tuple[int, Scalar]]:
        """Those of a value by the symbols in it that are ``moving``, all by the numbers of their lines."""
        if not isinstance(value, Value):
            return []
        if value.index not in self._in:
            needed = set(self.trace.needed([value.index]))
            self._in[value.index] = tuple(symbol for symbol in self._all if symbol.index in needed)
        found = self._in[value.index]
        return [(symbol.index, self._slope(value, symbol)) for symbol in found if symbol.index in moving]

    def _slope(self, value: Value, symbol: Value) -> Scalar:
        key = value.index, symbol.index
        if key not in self._slopes:
            self._slopes[key] = slope(value, {symbol: 1.0})
        return self._slopes[key]
