"""Loops that a tree writes as joints that mimic others: which of them a pin replaces, and where such pins are."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from linkwright.importers.trees.rigid_groups import Move, part_moves
from linkwright.importers.trees.tree import WORLD, Coupling, Pin, Tree, TreeJoint

#: Positions in which points of two links must stay together, within this share of the size of the tree.
POSES, TOGETHER = 9, 1e-5
#: Smallest share of the largest singular value with which a common point is determined.
DETERMINED = 1e-4
#: How far the independent joints move, rad or shares of the tree's size, where limits do not say less.
RANGE = 0.7
#: By what share of its range each joint is ahead of the one before it.
GOLDEN = (math.sqrt(5) - 1) / 2


def drop_implied(tree: Tree) -> None:
    """Leaves out couplings that follow from pins of the same loop: a pin determines two joints."""
    for pin in tree.pins:
        _drop(tree, _loop(tree, pin.a, pin.b))


def add_pins(tree: Tree) -> list[str]:
    """Pins of links whose points stay together as their joints mimic others; returns their names."""
    found: list[str] = []
    while (pin := next(_common_points(tree), None)) is not None:
        tree.pins.append(pin)
        found.append(pin.name)
        _drop(tree, _loop(tree, pin.a, pin.b))
    return found


def mimics(tree: Tree) -> dict[str, Coupling]:
    """The coupling of each joint that follows another one: its first."""
    return {next(iter(each.factors)): each for each in tree.couplings}


def follow(values: dict[str, float], followers: Mapping[str, Coupling]) -> None:
    """Sets the coordinates of joints that follow others, also along chains of them."""
    for _pass in followers:
        for name, coupling in followers.items():
            other, factor = list(coupling.factors.items())[-1]
            values[name] = coupling.rest - factor * values[other]


def _loop(tree: Tree, a: str, b: str) -> list[TreeJoint]:
    """The moving joints between two parts."""
    above = {joint.child: joint for joint in tree.joints.values()}
    chains: list[dict[str, TreeJoint]] = []
    for part in (a, b):
        chain = {}
        while part != WORLD:
            joint = above[part]
            chain[joint.name] = joint
            part = joint.parent
        chains.append(chain)
    one, other = chains
    between = {**{k: v for k, v in one.items() if k not in other}, **{k: v for k, v in other.items() if k not in one}}
    return [each for each in between.values() if each.moves]


def _drop(tree: Tree, loop: list[TreeJoint]) -> None:
    """Drops the couplings of two joints of a loop; of three that of the one that follows a neighbour stays."""
    coupled = mimics(tree)
    followers = [joint for joint in tree.joints.values() if joint in loop and joint.name in coupled]
    if len(loop) == 3 and len(followers) == 3:
        beside = [joint for joint in followers if _on_one_carrier(tree, coupled[joint.name])]
        followers.remove((beside or followers)[0])
    if len(followers) == 2:
        gone = [coupled[joint.name] for joint in followers]
        tree.couplings = [each for each in tree.couplings if each not in gone]


def _on_one_carrier(tree: Tree, coupling: Coupling) -> bool:
    return len({tree.joints[name].parent for name in coupling.factors}) == 1


def _common_points(tree: Tree) -> Iterator[Pin]:
    """Pins that may replace two couplings, in the order of the tree."""
    coupled = mimics(tree)
    poses = list(_poses(tree, coupled))
    names = [WORLD, *tree.parts]
    pinned = {(pin.a, pin.b) for pin in tree.pins}
    for index, a in enumerate(names):
        for b in names[index + 1 :]:
            loop = _loop(tree, a, b)
            hinges = all(joint.turns is not None for joint in loop)
            followers = [joint for joint in loop if joint.name in coupled]
            if len(loop) != 3 or not hinges or len(followers) < 2 or (a, b) in pinned or (b, a) in pinned:
                continue
            found = _common(tree, [(pose[a], pose[b]) for pose in poses])
            if found is not None:
                yield Pin(f"{a}_{b}", a, b, *found, line=followers[-1].line)


def _common(tree: Tree, poses: list[tuple[Move, Move]]) -> tuple[complex, complex] | None:
    """The point of each of two parts that stay together; None: there are none, or many."""
    rows, wanted = [], []
    for one, other in poses:
        rows.append([one.turn.real, -one.turn.imag, -other.turn.real, other.turn.imag])
        rows.append([one.turn.imag, one.turn.real, -other.turn.imag, -other.turn.real])
        gap = other.shift - one.shift
        wanted += [gap.real, gap.imag]
    size = _size(tree)
    found, _unused, _rank, singular = np.linalg.lstsq(np.array(rows), np.array(wanted), rcond=None)
    worst = np.abs(np.array(rows) @ found - wanted).max()
    if singular[-1] < DETERMINED * singular[0] or worst > TOGETHER * size or np.abs(found).max() > 10 * size:
        return None
    return complex(found[0], found[1]), complex(found[2], found[3])


def _size(tree: Tree) -> float:
    places = [joint.turns for joint in tree.joints.values() if joint.turns is not None]
    places += [part.centre for part in tree.parts.values()]
    return max((abs(each - places[0]) for each in places), default=1.0) or 1.0


def _poses(tree: Tree, followers: Mapping[str, Coupling]) -> Iterator[dict[str, Move]]:
    """Displacements of all parts from the reference pose in some positions."""
    size = _size(tree)
    for pose in range(POSES):
        values: dict[str, float] = {}
        for number, joint in enumerate(tree.joints.values()):
            reach = RANGE * (size if joint.slides is not None else 1.0)
            low = max(-reach, -math.inf if joint.low is None else joint.low)
            high = min(reach, math.inf if joint.high is None else joint.high)
            values[joint.name] = low + (high - low) * math.modf(pose / (POSES - 1) + number * GOLDEN)[0]
        follow(values, followers)
        yield part_moves(replace(joint, moved=values[joint.name]) for joint in tree.joints.values())
