"""Rotations of links with their turns, and as sums, for the pairs that add rotations up: gears, belts, racks.

A driven link's rotation is its driver's coordinate, a gear's the sum that its pair gives; only a link that a dyad or
Newton's method places has no turns of its own: its angle is the one nearest to that of the position before, a state.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence

from linkwright.core.inputs import Input
from linkwright.core.linear_sums import LinearSums
from linkwright.elements import Group, TreeJoint
from linkwright.formula.trace import Scalar, angle, nearest_turn
from linkwright.joints.base import LackingError
from linkwright.joints.pose import Pose
from linkwright.kinematics.dimensions import Dimensions
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology.analysis import Structure


def turn_state(link: str) -> str:
    """Name of the state that carries the turns of a link."""
    return Input("turn", link).name


def geared(group: Group) -> bool:
    """Whether higher pairs take part in a group, so that its rotations are unknown as angles."""
    return any(cut.higher for cut in group.cuts)


def counted_links(
    groups: Iterable[Group], touched: Mapping[str, tuple[str, ...]], adds_up: Callable[[Group], bool]
) -> list[str]:
    """Links placed without turns whose turns a later pair needs; ``touched``: links that a pair's rows turn;
    ``adds_up``: whether a group has its rotations as angles with turns."""
    steps = {step.child: (group, step) for group in groups for step in group.tree}
    found: dict[str, None] = {}
    for group in groups:
        for cut in group.cuts:
            for link in touched.get(cut.joint, ()) if cut.higher else ():
                while link in steps:
                    owner, step = steps[link]
                    if step.free and step.turns:
                        if not adds_up(owner):
                            found[link] = None
                        break
                    link = step.parent
    return list(found)


class Angles:
    """Gives the rotation of a link's x axis against the frame's with its turns, rad, as a traced value."""

    def __init__(self, groups: Sequence[Group], dimensions: Dimensions, poses: Mapping[str, Pose]) -> None:
        self.dimensions = dimensions
        self.poses = poses
        self.counted: dict[str, Scalar] = {}
        self.pairs = any(geared(group) for group in groups)
        self._steps = {step.child: (group, step) for group in groups for step in group.tree}
        self._known: dict[str, Scalar] = {"frame": 0.0}

    @property
    def carried(self) -> dict[str, Scalar]:
        """Rotations counted from position to position (``counted``, by link), by the names of their states."""
        return {turn_state(link): value for link, value in self.counted.items()}

    def __call__(self, link: str) -> Scalar:
        if link not in self._known:
            self._known[link] = self._found(*self._steps[link])
        return self._known[link]

    def counts(self, link: str) -> bool:
        """Whether the mechanism has pairs that count turns, and those of a link are known."""
        return self.pairs and self.follows(link)

    def follows(self, link: str) -> bool:
        """Whether the turns of a link are known, such as those of one that drivers turn."""
        if link not in self._steps:
            return False
        _, step = self._steps[link]
        if step.free and step.turns:
            return link in self._known
        return step.parent == "frame" or self.follows(step.parent)

    def give(self, link: str, value: Scalar) -> None:
        """Notes the rotation of a link whose group has it as an unknown."""
        self._known[link] = value

    def forget(self, group: Group) -> None:
        """Drops what follows from unknowns of a group that are about to change."""
        for link in group.links:
            self._known.pop(link, None)

    def _found(self, group: Group, step: TreeJoint) -> Scalar:
        if step.free and step.turns:
            now = self.poses[step.child].direction
            before = self.dimensions.trace.field_input(turn_state(step.child))
            found = nearest_turn(angle(now.y, now.x), before)
            self.counted[step.child] = found
            return found
        if step.turns:
            assert step.driver is not None
            own = step.child == self.dimensions.mechanism.drivers[step.driver].link
            turn = self.dimensions.trace.position(Input("turn", step.driver).name)
            return self(step.parent) + turn if own else self(step.parent) - turn
        joint = self.dimensions.mechanism.joints[step.joint]
        return self(step.parent) + joint.turned(step, self.dimensions)


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
