"""Equations of rotations of links, some of which say the same."""

from linkwright.topology.constraints import ConstraintGraph


def test_a_chain_of_equal_wheels_on_links_that_a_guide_holds_at_an_angle_is_redundant() -> None:
    graph = ConstraintGraph(dict.fromkeys(("frame", "a", "b"), 3), [])
    graph.hold_rotation("guide", "a", "b")
    graph.sum_rotations("chain", {"a": 1.0, "b": -1.0})
    graph.sum_rotations("gear", {"a": 1.0, "b": 1.0})
    assert graph.redundant == ["chain"]
    assert [equation.source for equation in graph.equations] == ["guide", "gear"]
