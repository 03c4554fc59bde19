"""Programs whose states are known beforehand."""

from __future__ import annotations

from collections.abc import Collection

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
