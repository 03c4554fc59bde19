"""Positions of one group: its joints in the trace, its driven coordinates, its closed form or Newton's steps."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from linkwright.elements import Connection, Group, TreeJoint
from linkwright.formula.linear_algebra import Matrix, Vec, determinant, inverse, product
from linkwright.formula.recently_made import Recent
from linkwright.formula.trace import Mask, Scalar, cos, sin, stop
from linkwright.groups.base import DYADS, Chain, Dyad, Solved, WholeGroup
from linkwright.joints.base import JOINTS
from linkwright.joints.pose import UNTURNED, Pose, Rotor
from linkwright.kinematics.dimensions import Dimensions, DriverInput
from linkwright.kinematics.equation import ChainPair, Equation
from linkwright.kinematics.rotations import Angles, counted_links, geared
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology.analysis import Structure

Coordinate = Rotor | Scalar | None


def cut_of(connection: Connection, dimensions: Dimensions, angles: Callable[[str], Scalar]) -> Equation:
    """The equation of a cut joint."""
    return Equation(dimensions.mechanism.joints[connection.joint], connection, dimensions, angles)


def pair_of(step: TreeJoint, dimensions: Dimensions) -> ChainPair:
    """The traced form of a chain's joint."""
    if step not in dimensions.pairs:
        joint = dimensions.mechanism.joints[step.joint]
        dimensions.pairs[step] = ChainPair(joint, step, dimensions)
    return dimensions.pairs[step]


def jacobian(
    group: Group, cuts: Sequence[Equation], poses: Mapping[str, Pose], dimensions: Dimensions
) -> list[list[Scalar]]:
    """Rows: equations of the cuts; columns: the unknown chain coordinates.

    How a unit rate of a coordinate moves and turns the anchor of an end, times the derivatives of the rows by it.
    """
    steps = group.unknowns
    matrix: list[list[Scalar]] = []
    for cut in cuts:
        rows: list[list[Scalar]] = [[0.0] * len(steps) for _ in range(cut.rows)]
        for end, parts in cut.parts(poses).items():
            tip = poses[end].place
            for step, turn in _turning(group, end):
                pivot = poses[step.child].place
                shift = (tip - pivot).perp if step.turns else pair_of(step, dimensions).normal(poses[step.parent])
                k = steps.index(step)
                for row, (x, y, about) in zip(rows, parts, strict=True):
                    row[k] = row[k] + (x * shift.x + y * shift.y + about * turn)
                if step.turns:
                    tip = pivot
        matrix += rows
    return matrix


def _turning(group: Group, end: str) -> Iterator[tuple[TreeJoint, float]]:
    """The unknown joints from an end inwards, and whether they turn it.

    1 for the first that turns, as the coordinate of a pin is the absolute rotation of its link; else 0.
    """
    first = 1.0
    for step in group.path(end):
        if step.free:
            yield step, first if step.turns else 0.0
            first = 0.0 if step.turns else first


#: Below this ratio of the square under the root to its best value a position is called singular.
SINGULAR = 1e-10


@dataclass
class Placed:
    """A group in position: its Jacobian's inverse, and how well it is closed; ``gap``: what is left open
    where nothing is solved."""

    group: Group
    cuts: tuple[Equation, ...]
    dyad: Dyad | None = None
    inverse: Matrix = field(default_factory=list)
    valid: Mask = True
    reached: Mask = True
    quality: Scalar = 1.0
    facts: Mapping[str, Scalar] = field(default_factory=dict)
    next_states: dict[str, Scalar] = field(default_factory=dict)
    gap: list[Scalar] = field(default_factory=list)
    residual: Scalar = 0.0
    determinant: Scalar = 1.0
    coordinates: Mapping[TreeJoint, Coordinate] = field(default_factory=dict)
    rates: Mapping[TreeJoint, Scalar] = field(default_factory=dict)
    seconds: Mapping[TreeJoint, Scalar] = field(default_factory=dict)

    def judge(self, solved: Solved) -> None:
        """Notes how a closed form was met."""
        self.facts = solved.facts
        self.reached = solved.square >= -SINGULAR * solved.scale
        self.valid = solved.square > SINGULAR * solved.scale
        known_zero = isinstance(solved.scale, float) and solved.scale == 0.0
        self.quality = solved.square if known_zero else solved.square / solved.scale


class GroupTracer:
    """Traces the positions of groups, one after the other, into ``poses``."""

    def __init__(
        self,
        dimensions: Dimensions,
        drivers: Mapping[str, DriverInput],
        poses: dict[str, Pose],
        angles: Angles,
        *,
        iterations: int,
        mode: Callable[[Group], Scalar],
    ) -> None:
        self.dimensions = dimensions
        self.drivers = drivers
        self.poses = poses
        self.iterations = iterations
        self.mode = mode
        self.angles = angles

    def place(self, group: Group) -> Placed:
        """Poses of the group's links, found and stored."""
        placed = Placed(group, tuple(cut_of(c, self.dimensions, self.angles) for c in group.cuts))
        if not group.unknowns:
            self._hang(group, {})
            return placed
        shape = dyad_shape(group) if self.iterations else None
        if not self.iterations:
            self._newton(placed)
        elif shape is not None:
            self._closed_form(placed, *shape)
        elif (complete := complete_form(group)) is not None:
            self._complete(placed, complete)
        elif in_one_step(group):
            self._one_step(placed)
        else:
            self._newton(placed)
        return placed

    # chains -------------------------------------------------------------------------------
    def driven(self, step: TreeJoint, parent: Pose) -> Coordinate:
        """Coordinate of a driven joint."""
        assert step.driver is not None
        driver_motion = self.drivers[step.driver]
        if driver_motion.turn is None:
            return driver_motion.slide
        driver = self.dimensions.mechanism.drivers[step.driver]
        turn = driver_motion.turn if step.child == driver.link else driver_motion.turn.conjugate
        return Rotor(parent.rotor.now.turn(turn), parent.rotor.local)

    def _hang(self, group: Group, coordinates: Mapping[TreeJoint, Coordinate]) -> None:
        for step in group.tree:
            parent = self.poses[step.parent]
            coordinate = self.driven(step, parent) if step.driver else coordinates.get(step)
            if step.free and step.turns and not isinstance(coordinate, Rotor):
                assert coordinate is not None
                self.angles.give(step.child, coordinate)
                coordinate = Rotor(Vec(cos(coordinate), sin(coordinate)), UNTURNED.local)
            self.poses[step.child] = pair_of(step, self.dimensions).place(parent, coordinate)

    def _trial(self, group: Group, start: TreeJoint | None, end: str) -> dict[str, Pose]:
        """Poses along one chain with slides at zero; with ``start`` in the axes of its child, unturned."""
        steps = list(group.path(end))[::-1]
        first = steps[0].parent if steps else end
        poses = {first: self.poses[first]}
        for step in steps:
            parent = poses[step.parent]
            if step == start:
                pose = pair_of(step, self.dimensions).place(parent, UNTURNED)
                poses[step.child] = Pose(pose.anchor, Vec(0.0, 0.0), UNTURNED)
                continue
            coordinate = self.driven(step, parent) if step.driver else 0.0
            poses[step.child] = pair_of(step, self.dimensions).place(parent, coordinate)
        return poses

    # closed form --------------------------------------------------------------------------
    def _closed_form(self, placed: Placed, dyad: Dyad, ends: tuple[str, str]) -> None:
        group, cut = placed.group, placed.cuts[0]
        chains = [self._chain(group, cut, end) for end in ends]
        solved = dyad.solve(chains[0], chains[1], self.mode(group))
        steps = [step for end in ends for step in chain_unknowns(group, end)]
        self._hang(group, dict(zip(steps, solved.coordinates, strict=True)))
        placed.dyad = dyad
        placed.judge(solved)
        sign = 1.0 if steps == list(group.unknowns) else -1.0
        matrix = jacobian(group, placed.cuts, self.poses, self.dimensions)
        placed.inverse = inverse(matrix, solved.inverse_determinant * sign)

    def _chain(self, group: Group, cut: Equation, end: str) -> Chain:
        steps = chain_unknowns(group, end)
        if not steps:
            return Chain(cut.place(end, self._trial(group, None, end)))
        turning = steps[0] if steps[0].turns else None
        trial = self._trial(group, turning, end)
        anchor = cut.place(end, trial)
        guides = [step for step in steps if step.slides]
        directions = [pair_of(step, self.dimensions).normal(trial[step.parent]) for step in guides]
        senses = tuple(1.0 if step.child == step.connection.b else -1.0 for step in guides)
        if turning is None:
            return Chain(anchor, None, tuple(directions), senses)
        parent = self._trial(group, None, turning.parent)[turning.parent]
        pivot = pair_of(turning, self.dimensions).place(parent, UNTURNED).place
        return Chain(pivot, anchor, tuple(directions), senses)

    def _complete(self, placed: Placed, form: WholeGroup) -> None:
        """A closed form of a group's own."""
        group, solved = placed.group, form.place(self, placed.group)
        self._hang(group, dict(zip(group.unknowns, solved.coordinates, strict=True)))
        placed.dyad = form  # type: ignore[assignment]
        placed.judge(solved)
        placed.inverse = inverse(jacobian(group, placed.cuts, self.poses, self.dimensions))

    # higher pairs alone -------------------------------------------------------------------
    def _one_step(self, placed: Placed) -> None:
        """Rows that are linear in the unknowns: what they leave open with all unknowns at zero gives the solution."""
        group = placed.group
        self._hang(group, dict.fromkeys(group.unknowns, 0.0))
        placed.inverse = inverse(jacobian(group, placed.cuts, self.poses, self.dimensions))
        gap = self._gap(placed)
        solved = [-each for each in product(placed.inverse, gap)]
        self.angles.forget(group)
        self._hang(group, dict(zip(group.unknowns, solved, strict=True)))

    def _gap(self, placed: Placed) -> list[Scalar]:
        return [entry for cut in placed.cuts for entry in cut.residual(self.poses)]

    # Newton -------------------------------------------------------------------------------
    def _newton(self, placed: Placed) -> None:
        group = placed.group
        coordinates: dict[TreeJoint, Coordinate] = {step: self._start(group, step) for step in group.unknowns}
        correction: list[Scalar] = [0.0] * len(group.unknowns)
        for remaining in reversed(range(self.iterations)):
            if remaining == 0:
                coordinates = {step: _stopped(value) for step, value in coordinates.items()}
            self.angles.forget(group)
            self._hang(group, coordinates)
            matrix = inverse(jacobian(group, placed.cuts, self.poses, self.dimensions))
            correction = product(matrix, self._gap(placed))
            coordinates = {
                step: moved(value, -change)
                for (step, value), change in zip(coordinates.items(), correction, strict=True)
            }
        self.angles.forget(group)
        self._hang(group, coordinates)
        matrix = jacobian(group, placed.cuts, self.poses, self.dimensions)
        placed.inverse, placed.determinant = inverse(matrix), determinant(matrix)
        placed.gap = [] if self.iterations else self._gap(placed)
        placed.coordinates = coordinates
        placed.next_states = carried(coordinates)
        placed.residual = _relative_square(group, correction, self.dimensions)
        placed.valid = placed.reached = placed.residual < CONVERGED
        placed.facts = {"correction²": placed.residual}

    def _start(self, group: Group, step: TreeJoint) -> Coordinate:
        trace, name = self.dimensions.trace, state_name(step)
        if step.slides:
            return trace.field_input(f"{name}.s")
        if geared(group):
            return trace.field_input(f"{name}.angle")
        return Rotor(Vec(trace.field_input(f"{name}.x"), trace.field_input(f"{name}.y")), UNTURNED.local)


#: Square of the last Newton correction (relative) below which a position counts as found.
CONVERGED = 1e-16


def carried(coordinates: Mapping[TreeJoint, Coordinate]) -> dict[str, Scalar]:
    """Chain coordinates by the names of the states that carry them to the next position."""
    states: dict[str, Scalar] = {}
    for step, value in coordinates.items():
        name = state_name(step)
        if isinstance(value, Rotor):
            states |= {f"{name}.x": value.now.x, f"{name}.y": value.now.y}
        else:
            assert value is not None
            states[f"{name}.s" if step.slides else f"{name}.angle"] = value
    return states


def state_name(step: TreeJoint) -> str:
    """Name of the carried coordinate of a chain's joint."""
    return f"{step.joint}:{step.child}"


def dyad_shape(group: Group) -> tuple[Dyad, tuple[str, str]] | None:
    """The closed form of a group, and the ends of its cut in the order of that form; None for others."""
    return _shapes.get(group, None, lambda: _dyad_shape(group))


_shapes: Recent[Group, tuple[Dyad, tuple[str, str]] | None] = Recent(1024)


def _dyad_shape(group: Group) -> tuple[Dyad, tuple[str, str]] | None:
    if len(group.cuts) != 1 or not group.cuts[0].turns or len(group.unknowns) != 2:
        return None
    cut = group.cuts[0]
    ends = sorted((cut.a, cut.b), key=lambda link: _first_place(group, link))
    for order in ((ends[0], ends[1]), (ends[1], ends[0])):
        pattern = tuple("".join(s.connection.letter for s in chain_unknowns(group, end)) for end in order)
        for dyad in DYADS.values():
            if pattern == getattr(dyad, "pattern", None):
                return dyad(), order
    return None


def complete_form(group: Group) -> WholeGroup | None:
    """The registered closed form that fits all of a group."""
    for name in DYADS:
        form: Any = DYADS[name]
        if hasattr(form, "fits") and group.unknowns and (found := form()).fits(group):
            return found  # type: ignore[no-any-return]
    return None


def closed_form(group: Group) -> bool:
    """Whether a group is placed without iteration."""
    return dyad_shape(group) is not None or in_one_step(group) or complete_form(group) is not None


def iterated(structure: Structure) -> tuple[Group, ...]:
    """The groups that have no closed form."""
    return _iterated.get(
        structure, None, lambda: tuple(each for each in structure.groups if each.unknowns and not closed_form(each))
    )


_iterated: Recent[Structure, tuple[Group, ...]] = Recent(64)


def counted(structure: Structure, mechanism: Mechanism) -> list[str]:
    """Links placed by closed forms or as directions whose turns a higher pair counts."""
    pairs = {name: joint.turning for name, joint in mechanism.joints.items() if joint.higher}
    return counted_links(structure.groups, pairs, _adds_up) if pairs else []


def _adds_up(group: Group) -> bool:
    return geared(group) and complete_form(group) is None


def upstream(structure: Structure, mechanism: Mechanism) -> list[Group]:
    """The groups without closed form, those whose turns are counted, and all that they hang on, in solving order."""
    wanted = {link for group in iterated(structure) for link in group.links}
    wanted.update(counted(structure, mechanism))
    gears = {name: joint.turning for name, joint in mechanism.joints.items() if joint.higher}
    found = []
    for group in reversed(structure.groups):
        if wanted & set(group.links):
            found.append(group)
            wanted |= {end for c in group.joints for end in (c.a, c.b, *gears.get(c.joint, ()))}
    return found[::-1]


def in_one_step(group: Group) -> bool:
    """Whether the higher pairs of a group determine it alone, by rows that are linear in its unknowns."""
    return bool(group.cuts) and all(cut.higher and JOINTS[cut.kind].linear(group, cut) for cut in group.cuts)


def chain_unknowns(group: Group, end: str) -> list[TreeJoint]:
    """The unknown joints of the chain that ends in a link, from the solved links outwards."""
    return [step for step in reversed(list(group.path(end))) if step.free]


def _first_place(group: Group, link: str) -> int:
    """Place in the file of the earliest link of the chain that ends in ``link``."""
    chain = [step.child for step in group.path(link)]
    return min((group.links.index(name) for name in chain), default=len(group.links))


def _stopped(value: Coordinate) -> Coordinate:
    if isinstance(value, Rotor):
        return Rotor(Vec(stop(value.now.x), stop(value.now.y)), value.local)
    assert value is not None
    return stop(value)


def moved(value: Coordinate, change: Scalar) -> Coordinate:
    """A coordinate after a small change; a rotation by the Cayley map, exact to third order."""
    if not isinstance(value, Rotor):
        assert value is not None
        return value + change
    half = 0.5 * change
    square = half * half
    scale = 1.0 / (1.0 + square)
    turn = Vec((1.0 - square) * scale, change * scale)
    return Rotor(value.now.turn(turn), value.local)


def _relative_square(group: Group, correction: Sequence[Scalar], dimensions: Dimensions) -> Scalar:
    """Sum of squares of the last correction; slides relative to the size of the mechanism."""
    size = dimensions.mechanism.size
    total: Scalar = 0.0
    for step, change in zip(group.unknowns, correction, strict=True):
        relative = change * (1.0 / size) if step.slides else change
        total = total + relative * relative
    return total
