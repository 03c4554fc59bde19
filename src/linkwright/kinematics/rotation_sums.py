"""Rotations of links as sums: of unknown ones, of drivers' turns, and of what higher pairs make of these."""

from __future__ import annotations

import math
from collections.abc import Iterable

from linkwright.core.linear_sums import LinearSums
from linkwright.elements.topology import TreeJoint
from linkwright.joints.base import LackingError
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology.analysis import Structure

#: ``turn`` of a link, ``slide`` of a guide, ``drive`` of a driver.
Key = tuple[str, str]
Terms = dict[Key, float]


class RotationSums:
    """What links' rotations and guides' displacements gain together over a full cycle.

    ``unknowns``: rotations of links that turn freely on their chains, displacements of guides; ``rotations``: of all
    links, in these and the drivers' turns; ``sums``: unknowns that higher pairs make depend on others.
    """

    def __init__(self, mechanism: Mechanism, structure: Structure) -> None:
        self.mechanism = mechanism
        self.rotations: dict[str, Terms] = {"frame": {}}
        self.unknowns: list[Key] = []
        self._steps: dict[str, TreeJoint] = {}
        self._looped: set[Key] = set()
        rows = []
        for group in structure.groups:
            for step in group.tree:
                self._hang(step)
            for cut in group.cuts:
                if cut.higher:
                    rows.append(cut.joint)
                    continue
                if cut.slides:
                    self.unknowns.append(("slide", cut.joint))
                    self._looped.add(("slide", cut.joint))
                for end in (cut.a, cut.b):
                    self._looped.update(self._path(end))
        sums: LinearSums[Key] = LinearSums()
        for name in rows:
            if (terms := self._row(name)) is not None:
                sums.add(terms, 0.0, self._order)
        self.sums = {key: terms for key, (terms, _) in sums.solved.items()}
        self.unknowns = [key for key in self.unknowns if key not in self.sums]

    def _hang(self, step: TreeJoint) -> None:
        self._steps[step.child] = step
        own = dict(self.rotations[step.parent])
        if step.turns and step.driver:
            sign = 1.0 if step.child == self.mechanism.drivers[step.driver].link else -1.0
            key = ("drive", step.driver)
            own[key] = own.get(key, 0.0) + sign
        elif step.turns:
            own = {("turn", step.child): 1.0}
            self.unknowns.append(("turn", step.child))
        elif step.slides and not step.driver:
            self.unknowns.append(("slide", step.joint))
        self.rotations[step.child] = own

    def _path(self, link: str) -> Iterable[Key]:
        """What moves a link: the unknowns of all chains on which it hangs."""
        while link in self._steps:
            step = self._steps[link]
            yield from self.rotations[link]
            if step.slides:
                yield "slide", step.joint
            link = step.parent

    def _order(self, key: Key) -> float:
        """Every sum gives up one unknown: one that no loop holds if there is one."""
        return -math.inf if key[0] == "drive" else float(key not in self._looped)

    def _row(self, joint: str) -> Terms | None:
        """The sum of a higher pair; None of one that is no sum."""
        try:
            rotations, slides = self.mechanism.joints[joint].gains(self.mechanism)
        except LackingError:
            return None
        terms: Terms = {}
        for link, factor in rotations.items():
            for key, share in self.rotations[link].items():
                terms[key] = terms.get(key, 0.0) + factor * share
        for name, factor in slides.items():
            key = ("slide", name) if ("slide", name) in self.unknowns else ("drive", self._driver(name))
            terms[key] = terms.get(key, 0.0) + factor
        return terms

    def _driver(self, joint: str) -> str:
        return next(name for name, driver in self.mechanism.drivers.items() if driver.joint == joint)

    def reduced(self, terms: Terms) -> Terms:
        """A sum in the unknowns that are left, and drivers."""
        found: Terms = {}
        for key, factor in terms.items():
            for each, share in self.sums.get(key, {key: 1.0}).items():
                found[each] = found.get(each, 0.0) + factor * share
        return found
