"""Parts that are one body: fixed to each other in the tree, or welded; and where all of them lie at the start."""

from __future__ import annotations

import cmath
from collections.abc import Iterable
from dataclasses import dataclass

from linkwright.importers.trees.tree import WORLD, Tree, TreeJoint


@dataclass(frozen=True)
class Move:
    """A displacement in the plane: z → turn · z + shift."""

    turn: complex = 1 + 0j
    shift: complex = 0j

    def __call__(self, place: complex) -> complex:
        return self.turn * place + self.shift

    def after(self, first: Move) -> Move:
        """The displacement that ``first`` and then this one make."""
        return Move(self.turn * first.turn, self(first.shift))

    @property
    def back(self) -> Move:
        """The displacement that undoes this one."""
        turn = self.turn.conjugate()
        return Move(turn, -turn * self.shift)


def joint_move(joint: TreeJoint) -> Move:
    """How the joint displaces its child against its parent from the reference pose to the start."""
    if joint.turns is not None:
        turn = cmath.exp(1j * joint.sense * joint.moved) if joint.moved else 1 + 0j
        return Move(turn, joint.turns - turn * joint.turns)
    return Move(shift=(joint.slides or 0j) * joint.moved)


def part_moves(joints: Iterable[TreeJoint]) -> dict[str, Move]:
    """How joints, those of parents first, displace all parts from the reference pose to the start."""
    moves = {WORLD: Move()}
    for joint in joints:
        moves[joint.child] = moves[joint.parent].after(joint_move(joint))
    return moves


class Groups:
    """Rigid groups of parts; every place is brought to the reference pose of the group's first part.

    ``of``: the first part of the group of each part; ``inside``: from a part's reference pose to the group's;
    ``start``: from the group's reference pose to where it lies at the start.
    """

    def __init__(self, tree: Tree) -> None:
        self.tree = tree
        self.of = {name: name for name in (WORLD, *tree.parts)}
        self.inside = {name: Move() for name in self.of}
        for joint in tree.joints.values():
            if not joint.moves:
                self._join(joint.parent, joint.child, Move())
        for weld in tree.welds:
            self._join(weld.a, weld.b, Move(weld.turn, weld.shift))
        moves = part_moves(tree.joints.values())
        self.start = {name: moves[name] for name in set(self.of.values())}

    def _join(self, a: str, b: str, move: Move) -> None:
        """Makes two groups one; the one with the world, else the one that comes first, stays."""
        kept, gone, step = self.of[a], self.of[b], self.inside[a].after(move).after(self.inside[b].back)
        if kept == gone:
            return
        order = list(self.of)
        if order.index(gone) < order.index(kept):
            kept, gone, step = gone, kept, step.back
        for part, group in self.of.items():
            if group == gone:
                self.of[part], self.inside[part] = kept, step.after(self.inside[part])

    def members(self, group: str) -> list[str]:
        """Its parts in the order of the tree."""
        return [part for part, each in self.of.items() if each == group]
