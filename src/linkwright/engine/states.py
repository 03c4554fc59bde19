"""Programs whose states, or some of whose parameters, are given per position."""

from __future__ import annotations

from collections.abc import Collection

from linkwright.engine.node import Node
from linkwright.engine.program import Program


def states_as_fields(program: Program, names: Collection[str] | None = None) -> Program:
    """The same program with every state (or those of some ``names``) taken from outside, as a field of the same name.

    Positions are then independent of each other: for evaluating again, and differentiating,
    what an iteration from position to position has found.
    """

    def given(name: str) -> bool:
        return names is None or name in names

    nodes = tuple(
        node._replace(op="field") if node.op == "state" and given(node.name) else node
        for node in program.nodes
    )
    following = tuple((name, index) for name, index in program.next_states if not given(name))
    return Program(nodes, program.outputs, following)


def parameters_as_fields(program: Program, names: Collection[str]) -> Program:
    """The same program with parameters of some ``names`` taken per position, as fields of the same names."""
    nodes: list[Node] = []
    for node in program.nodes:
        if node.op == "parameter" and node.name in names:
            nodes.append(node._replace(op="field", varies=True))
        else:
            nodes.append(node._replace(varies=node.varies or any(nodes[each].varies for each in node.args)))
    return Program(tuple(nodes), program.outputs, program.next_states)
