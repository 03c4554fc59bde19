"""Programs some of whose inputs are given per design and position."""

from __future__ import annotations

from collections.abc import Collection
from typing import Literal

from linkwright.formula.node import Node
from linkwright.formula.program import Program


def inputs_as_fields(
    program: Program, names: Collection[str], op: Literal["field", "position"] = "field"
) -> Program:
    """The same program with parameters, positions and states of some ``names`` taken as fields, or positions, of the
    same names."""
    nodes: list[Node] = []
    for node in program.nodes:
        if not node.args and node.name in names:
            nodes.append(node._replace(op=op, varies=True))
        else:
            nodes.append(node._replace(varies=node.varies or any(nodes[each].varies for each in node.args)))
    following = tuple((name, index) for name, index in program.next_states if name not in names)
    return Program(tuple(nodes), program.outputs, following)


def states_as_fields(program: Program, names: Collection[str] | None = None) -> Program:
    """The same program with every state (or those of some ``names``) taken from outside, as a field of the same name.

    Positions are then independent of each other: for evaluating again, and differentiating,
    what an iteration from position to position has found.
    """
    return inputs_as_fields(program, program.states if names is None else names)
