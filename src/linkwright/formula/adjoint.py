"""Reverse derivatives: how much an objective changes with every line, in one sweep back."""

from __future__ import annotations

from dataclasses import dataclass

from linkwright.formula.node import Node
from linkwright.formula.replay import Replay, operations
from linkwright.formula.tangent import slope_of
from linkwright.formula.trace import Mask, Scalar, Value


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
