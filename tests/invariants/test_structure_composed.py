"""Machines put together from known Assur groups, their links and joints in any order: the analysis takes them apart
into just these groups, in an order in which they can be solved."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
import pytest

import linkwright as lw
from linkwright.topology import Group, Structure

#: By signature: class, order, the links with their own pins (lower case: on links before), guides (guide, block).
GROUPS: dict[str, tuple[int, int, dict[str, str], list[tuple[str, str]]]] = {
    "RRR": (2, 2, {"A": "oI", "B": "pI"}, []),
    "RRP": (2, 2, {"A": "oI", "B": "I"}, [("", "B")]),
    "RPR": (2, 2, {"A": "o", "B": "p"}, [("A", "B")]),
    "PRP": (2, 2, {"A": "I", "B": "I"}, [("", "A"), ("", "B")]),
    "RPP": (2, 2, {"A": "o", "B": ""}, [("A", "B"), ("", "B")]),
    "RRR-RRR": (3, 3, {"A": "oI", "B": "pJ", "C": "qK", "D": "IJK"}, []),
    "RRP-RRR": (3, 3, {"A": "o", "B": "pJ", "C": "qK", "D": "JK"}, [("A", "D")]),
    "RRRRR-RRRR": (3, 4, {"A": "oI", "B": "pJ", "C": "qK", "D": "rL", "E": "IJM", "F": "KLM"}, []),
    "RRRR-RR": (4, 2, {"A": "oIJ", "B": "pKL", "C": "IK", "D": "JL"}, []),
}


@dataclass
class Composed:
    """A machine, and what each of its groups is made of."""

    random: np.random.Generator
    points: dict[str, list[str]] = field(default_factory=lambda: {"frame": []})
    joints: list[str] = field(default_factory=list)
    drivers: list[str] = field(default_factory=list)
    expected: dict[frozenset[str], tuple[str, int, int, frozenset[str], frozenset[str]]] = field(default_factory=dict)
    owners: set[str] = field(default_factory=set)

    def name(self, kind: str) -> str:
        """A new name, not in the order in which it is given."""
        found = f"{kind}{self.random.integers(10**6)}"
        assert found not in self.owners
        self.owners.add(found)
        return found

    def before(self) -> str:
        return str(self.random.choice(list(self.points)))

    def crank(self) -> None:
        pin, link = self.name("P"), self.name("crank")
        self.points["frame"].append(pin)
        self.points[link] = [pin, self.name("P")]
        self.drivers.append(f"{self.name('d')}: {{turn: {link}, about: {pin}, speed: {len(self.drivers) + 1} rad/s}}")

    def add(self, signature: str) -> None:
        group_class, order, links, guides = GROUPS[signature]
        names, pins = {key: self.name("L") for key in links}, {}
        on, outer = list(self.points), set()
        for key, own in links.items():
            for pin in own:
                if pin.islower():
                    carrier = str(self.random.choice(on))
                    pins[pin] = self.name("P")
                    self.points[carrier].append(pins[pin])
                    outer.add(pins[pin])
                elif pin not in pins:
                    pins[pin] = self.name("P")
            self.points[names[key]] = [pins[pin] for pin in own]
        for guide, block in guides:
            carrier = names[guide] if guide else str(self.random.choice(on))
            ends = [carrier, names[block]] if self.random.random() < 0.5 else [names[block], carrier]
            places = [self.name("Q") for _ in ends]
            for link, place in zip(ends, places, strict=True):
                self.points[link].append(place)
            joint = self.name("J")
            outer |= set() if guide else {joint}
            self.joints.append(
                f"{joint}: {{kind: prismatic, guide: {ends[0]}, through: {places[0]}, "
                f"direction: {self.random.integers(360)} deg, block: {ends[1]}, at: {places[1]}}}"
            )
            pins[joint] = joint
        mine = frozenset(names.values())
        inner = frozenset(pins.values()) - outer
        self.expected[mine] = signature, group_class, order, inner, frozenset(outer)

    def text(self) -> str:
        def placed(link: str) -> str:
            own = (f"{p}: [{x:.4f} m, {y:.4f} m]" for p in self.points[link] for x, y in [self.random.random(2)])
            return f"points: {{{', '.join(own)}}}"

        moving = [f"{link}: {{{placed(link)}}}" for link in self.points if link != "frame"]
        self.random.shuffle(moving)
        self.random.shuffle(self.joints)
        rooms = {"links": moving, "joints": self.joints, "drivers": self.drivers}
        rows = [f"{room}:\n  " + "\n  ".join(each) for room, each in rooms.items() if each]
        return "\n".join(["format: 1", f"frame: {{{placed('frame')}}}", *rows, ""])


def composed(seed: int) -> tuple[Composed, Structure]:
    random = np.random.default_rng(seed)
    made = Composed(random)
    for _ in range(1 + seed % 2):
        made.crank()
    for kind in random.choice(list(GROUPS), random.integers(2, 6)):
        made.add(str(kind))
    return made, lw.structure(lw.loads(made.text()))


def letters(signature: str) -> list[Counter[str]]:
    return [Counter(part) for part in signature.split("-")]


def check(group: Group, expected: tuple[str, int, int, frozenset[str], frozenset[str]], solved: set[str]) -> None:
    signature, group_class, order, inner, outer = expected
    if group_class == 2:
        assert group.signature == signature
    else:
        assert letters(group.signature) == letters(signature)
    assert (group.assur_class, group.assur_order) == (group_class, order)
    assert {c.joint for c in group.inner_joints} == inner
    assert {c.joint for c in group.outer_joints} == outer
    assert all(end in solved or end in group.links for c in group.joints for end in (c.a, c.b))
    assert {step.child for step in group.tree} == set(group.links) and len(group.tree) == len(group.links)
    placed = set(solved)
    for step in group.tree:
        assert step.parent in placed and step.child not in placed
        placed.add(step.child)
    assert len(group.unknowns) == 2 * len(group.cuts) == len(group.links) // 2 * 2
    for link in group.links:
        way = list(group.path(link))
        assert way[0].child == link and way[-1].parent in solved
        assert all(a.parent == b.child for a, b in pairwise(way))


@pytest.mark.parametrize("seed", range(40))
def test_a_machine_is_taken_apart_into_the_groups_of_which_it_was_made(seed: int) -> None:
    made, found = composed(seed)
    drivers = len(made.drivers)
    assert (found.mobility, found.grubler, found.redundant) == (drivers, drivers, ())
    groups = [group for group in found.groups if group.assur_class > 1]
    assert {frozenset(group.links) for group in groups} == set(made.expected)
    assert len(found.groups) == len(groups) + drivers
    assert found.mechanism_class == max(each[1] for each in made.expected.values())
    solved = {"frame"}
    for group in found.groups:
        if group.assur_class > 1:
            check(group, made.expected[frozenset(group.links)], solved)
        else:
            assert group.signature == "R" and len(group.drivers) == 1 and group.unknowns == ()
        solved.update(group.links)
