"""Programs whose states are known beforehand."""

from __future__ import annotations

from linkwright.engine.program import Program


def states_as_fields(program: Program) -> Program:
    """The same program with every state taken from outside, as a field of the same name.

    Positions are then independent of each other: for evaluating again, and differentiating,
    what an iteration from position to position has found.
    """
    nodes = tuple(node._replace(op="field") if node.op == "state" else node for node in program.nodes)
    return Program(nodes, program.outputs)
