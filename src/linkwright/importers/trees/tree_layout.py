"""The layout of a tree of bodies: groups become links, hinges and loop closures pins, slides guides."""

from __future__ import annotations

import cmath

from linkwright.importers.layout import FRAME, Body, Drive, Layout, Remarks, Slide, free_name
from linkwright.importers.model_text import Writer
from linkwright.importers.trees.couplings import Rows
from linkwright.importers.trees.placed import Placed, vec
from linkwright.importers.trees.points import SAME, Point
from linkwright.importers.trees.springs import Ends, add_springs, anchored
from linkwright.importers.trees.tree import WORLD, Tether, Tree, TreeJoint
from linkwright.words import _


def tree_layout(tree: Tree, remarks: Remarks) -> Layout:
    """A layout of a tree; what has no counterpart is among the remarks."""
    return TreeLayout(tree, remarks).layout()


class TreeLayout:
    """Makes one layout."""

    def __init__(self, tree: Tree, remarks: Remarks) -> None:
        self.placed = Placed(tree, remarks)
        self.made = self.placed.layout
        self.ends: dict[str, tuple[Point, Point]] = {}

    def layout(self) -> Layout:
        """The whole layout."""
        self._name_bodies()
        self._pins()
        self._marks()
        self._directions()
        slides = [joint for joint in self.placed.moving if joint.slides is not None]
        for joint in slides:
            self.ends[joint.name] = self._slide_ends(joint)
        rows = Rows(self.placed)
        rows.add_points()
        tethers = [self._tether(each) for each in self.placed.tree.tethers]
        sprung = [joint for joint in slides if joint.stiffness or joint.damping]
        tethers += [anchored(self.placed, joint, self.ends[joint.name][1]) for joint in sprung]
        self.placed.named = self.placed.points.names()
        self._places()
        self.made.slides = [self._slide(joint) for joint in slides]
        self._masses()
        rows.add_wheels()
        self._drives()
        self._limits()
        add_springs(self.placed, tethers)
        return self.made

    def _name_bodies(self) -> None:
        """A link for each group, named after its heaviest part that is joined to another group."""
        self.placed.bodies[WORLD] = FRAME
        for group in self.placed.groups.start:
            members = [self.placed.tree.parts[each] for each in self.placed.groups.members(group) if each != WORLD]
            if group == WORLD or not members:
                continue
            joined = {joint.child for joint in self._joints_of(group)}
            candidates = [each for each in members if each.name in joined] or members
            chosen = max(candidates, key=lambda each: (not each.between, each.mass))
            colour = next((each.colour for each in (chosen, *members) if each.colour), "")
            name = free_name(chosen.name, self.made.bodies, "body")
            self.made.add(Body(name, colour=colour, key=chosen.name))
            self.placed.bodies[group] = name
        self.made.bodies = {self.placed.bodies[g]: self.made.bodies[self.placed.bodies[g]] for g in self._order()}

    def _order(self) -> list[str]:
        """Groups that move in the order of the tree."""
        order = list(self.placed.groups.of)
        return sorted((each for each in self.placed.bodies if each != WORLD), key=order.index)

    def _joints_of(self, group: str) -> list[TreeJoint]:
        return [
            joint
            for joint in self.placed.tree.joints.values()
            if self.placed.group(joint.child) == group and self.placed.group(joint.parent) != group
        ]

    def _pins(self) -> None:
        for joint in self.placed.moving:
            if joint.turns is not None:
                ends = self.placed.on(joint.parent, joint.turns), self.placed.on(joint.child, joint.turns)
                self.placed.pin_of[joint.name] = self.placed.points.pin(joint.name, *ends)
        for pin in self.placed.tree.pins:
            if self.placed.group(pin.a) != self.placed.group(pin.b):
                self.placed.points.pin(pin.name, self.placed.on(pin.a, pin.at_a), self.placed.on(pin.b, pin.at_b))

    def _marks(self) -> None:
        """Points that only have a name; sites of a body are often named after it, ``crank.A``."""
        for name, place in self.placed.tree.marks.items():
            self.placed.points.mark(name.removeprefix(f"{FRAME}.").removeprefix(f"{WORLD}."), WORLD, place)
        for part in self.placed.tree.parts.values():
            for name, place in part.marks.items():
                self.placed.points.mark(name.removeprefix(f"{part.name}."), *self.placed.on(part.name, place))

    def _tether(self, tether: Tether) -> Ends:
        """A tether with its points."""
        mark, on = self.placed.points.mark, self.placed.on
        ends = on(tether.a, tether.at_a), on(tether.b, tether.at_b)
        return tether, mark(tether.name, *ends[0]), mark(tether.name, *ends[1])

    def _directions(self) -> None:
        """A second point for bodies that only have a hinge: the mass centre, or a place beside it."""
        blocks = {self.placed.group(joint.child) for joint in self.placed.moving if joint.slides is not None}
        for group, name in self.placed.bodies.items():
            points = list(self.placed.points.of(group))
            if group == WORLD or group in blocks or len(points) != 1:
                continue
            hinge = points[0].places[group]
            parts = [self.placed.tree.parts[each] for each in self.placed.groups.members(group)]
            centre = self.placed.groups.inside[parts[0].name](parts[0].centre)
            away = centre - hinge if abs(centre - hinge) > 1e-3 * self.placed.size else ASIDE * self.placed.size
            self.placed.points.mark(f"{name}_tip", group, hinge + away)

    def _slide_ends(self, joint: TreeJoint) -> tuple[Point, Point]:
        """A point of the guide on the line, and the one of the block that follows it: pins where they serve."""
        guide, block = self.placed.group(joint.parent), self.placed.group(joint.child)
        own = [each for each in self.placed.points.of(block) if guide not in each.places]
        own.sort(key=lambda each: not each.pinned)
        at = (
            own[0]
            if own
            else self.placed.points.mark(joint.name, *self.placed.on(joint.child, self._inner(joint.child)))
        )
        moved = self.placed.groups.inside[joint.child].back(at.places[block])
        place = self.placed.groups.inside[joint.parent](moved)
        line = self.placed.groups.inside[joint.parent].turn * (joint.slides or 1)
        for each in self.placed.points.of(guide):
            off = (each.places[guide] - place) * line.conjugate()
            if block not in each.places and abs(off.imag) <= self.placed.points.tolerance:
                return each, at
        name = f"{joint.name}_guide" if at.wanted == joint.name else joint.name
        return self.placed.points.alone(name, guide, place), at

    def _inner(self, part: str) -> complex:
        """A place of a part that has no pin: one that has a name, else its mass centre."""
        found = self.placed.tree.parts[part]
        return next(iter(found.marks.values()), found.centre)

    def _places(self) -> None:
        for group, name in self.placed.bodies.items():
            body = self.made.body(name)
            for point in sorted(self.placed.points.of(group), key=lambda each: not each.pinned):
                body.places[self.placed.named[id(point)]] = vec(self.placed.start(group, point.places[group]))

    def _slide(self, joint: TreeJoint) -> Slide:
        through, at = self.ends[joint.name]
        guide, block = self.placed.group(joint.parent), self.placed.group(joint.child)
        direction = joint.slides or 1 + 0j
        lines = [
            self.placed.groups.start[self.placed.group(each)].turn * self.placed.groups.inside[each].turn * direction
            for each in (joint.parent, joint.child)
        ]
        name = free_name(joint.name, self._taken(), "guide")
        ends = self.placed.bodies[guide], self.placed.bodies[block]
        points = self.placed.named[id(through)], self.placed.named[id(at)]
        made = Slide(name, ends[0], points[0], angle(lines[0]), ends[1], points[1])
        away = self.placed.start(block, at.places[block]) - self.placed.start(guide, through.places[guide])
        apart = abs((away * lines[0].conjugate()).imag)
        if abs(lines[0] - lines[1]) > SAME or apart > self.placed.points.tolerance:
            made.offset = 0.0
            body = self.made.body(ends[1])
            made.block_angle = angle(lines[1]) - body.axis if body.spread else None
        return made

    def slide_name(self, joint: str) -> str:
        """The name of the guide that a slide became."""
        moving = [each.name for each in self.placed.moving if each.slides is not None]
        return self.made.slides[moving.index(joint)].name

    def _masses(self) -> None:
        """Mass, its centre and the inertia about it of each group but the frame's."""
        for group, name in self.placed.bodies.items():
            parts = [self.placed.tree.parts[each] for each in self.placed.groups.members(group) if each != WORLD]
            mass = sum(each.mass for each in parts)
            if group == WORLD or not mass:
                continue
            centres = [self.placed.groups.inside[each.name](each.centre) for each in parts]
            centre = sum(part.mass * at for part, at in zip(parts, centres, strict=True)) / mass
            body = self.made.bodies[name]
            body.mass, body.centre = mass, vec(self.placed.start(group, centre))
            body.inertia = sum(
                part.inertia + part.mass * abs(at - centre) ** 2 for part, at in zip(parts, centres, strict=True)
            )

    # -- what drives it

    def _drives(self) -> None:
        for motor in self.placed.tree.motors:
            joint = self.placed.tree.joints[motor.joint]
            if joint not in self.placed.moving:
                continue
            name = free_name(motor.name, self._taken(), "driver")
            if joint.turns is None:
                drive = Drive(name, slide=self.slide_name(joint.name))
                sense = 1.0
            else:
                moved, against = joint.child, joint.parent
                sense = joint.sense
                if self.placed.group(moved) == WORLD:
                    moved, against, sense = against, moved, -sense
                about = self.placed.named[id(self.placed.pin_of[joint.name])]
                drive = Drive(name, turn=self.placed.body(moved), about=about, against=self.placed.body(against))
            if motor.table is not None:
                times, values = motor.table
                drive.table = times, [sense * (each - joint.moved) for each in values], "cubic"
            elif motor.speed is not None:
                drive.speed = sense * motor.speed
            self.made.drives.append(drive)
            if len(self.placed.tree.motors) == 1 and motor.table is None:
                self._cycle(drive, joint, sense)

    def _taken(self) -> set[str]:
        """Names that no other joint or driver can have."""
        made = self.made
        slides, wheels, drives = ({each.name for each in one} for one in (made.slides, made.wheels, made.drives))
        return {*self.placed.named.values(), *made.bodies, *slides, *wheels, *drives}

    def _cycle(self, drive: Drive, joint: TreeJoint, sense: float) -> None:
        """From limit to limit of the one driven joint."""
        if joint.low is None or joint.high is None:
            return
        writer = Writer(self.made)
        start, rotary = writer.coordinate(drive), drive.turn is not None
        if rotary and joint.high - joint.low > FULL_TURN:
            return
        limits = (sense * (limit - joint.moved) for limit in (joint.low, joint.high))
        ends = sorted(limits, reverse=(drive.speed or 0.0) < 0)
        write = [writer.angle_sum(start, each) if rotary else writer.length(start + each) for each in ends]
        self.made.cycle = {"from": write[0], "to": write[1]}

    def _limits(self) -> None:
        """Limits that are not those of the one driver."""
        driven = self.placed.tree.motors[0].joint if self.made.cycle else ""
        others = [each for each in self.placed.moving if each.low is not None and each.name != driven]
        if others:
            message = _("limits of joints are left out: {names}", names=tuple(each.name for each in others))
            remedy = _("see in the results that the machine stays within them")
            self.placed.remarks.remark(
                "note", message, remedy, "import.limits", line=others[0].line, key=others[0].name
            )


#: How far beside a hinge a point is put that shows how a body turns, as a share of the machine's size.
ASIDE = 0.2
#: A full turn less what a limit may be rounded by, rad.
FULL_TURN = 6.2


def angle(direction: complex) -> float:
    """The angle of a direction, rad."""
    return cmath.phase(direction)
