"""Positions of one group: its driven coordinates, its closed form or Newton's steps."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from linkwright.engine.linear import Matrix, determinant, inverse, product
from linkwright.engine.trace import Mask, Scalar, stop
from linkwright.engine.vector import Vec
from linkwright.groups.base import DYADS, Chain, Dyad, Rotor
from linkwright.kinematics.closure import Cut, PinCut, cut_of, jacobian
from linkwright.kinematics.dimensions import Dimensions
from linkwright.kinematics.inputs import DriverInput
from linkwright.kinematics.pairs import Coordinate, Guide, pair_of
from linkwright.kinematics.pose import UNTURNED, Pose
from linkwright.kinematics.size import mechanism_size
from linkwright.structure.group import Group, TreeJoint

#: Below this ratio of the square under the root to its best value a position is called singular.
SINGULAR = 1e-10


@dataclass
class Placed:
    """A group in position: its Jacobian's inverse, and how well it is closed."""

    group: Group
    cuts: tuple[Cut, ...]
    dyad: Dyad | None = None
    inverse: Matrix = field(default_factory=list)
    valid: Mask = True
    reached: Mask = True
    quality: Scalar = 1.0
    facts: Mapping[str, Scalar] = field(default_factory=dict)
    next_states: dict[str, Scalar] = field(default_factory=dict)
    residual: Scalar = 0.0
    determinant: Scalar = 1.0
    coordinates: Mapping[TreeJoint, Coordinate] = field(default_factory=dict)
    rates: Mapping[TreeJoint, Scalar] = field(default_factory=dict)
    seconds: Mapping[TreeJoint, Scalar] = field(default_factory=dict)


class GroupTracer:
    """Traces the positions of groups, one after the other, into ``poses``."""

    def __init__(
        self,
        dimensions: Dimensions,
        drivers: Mapping[str, DriverInput],
        poses: dict[str, Pose],
        *,
        iterations: int,
        mode: Callable[[Group], Scalar],
    ) -> None:
        self.dimensions = dimensions
        self.drivers = drivers
        self.poses = poses
        self.iterations = iterations
        self.mode = mode

    def place(self, group: Group) -> Placed:
        """Poses of the group's links, found and stored."""
        placed = Placed(group, tuple(cut_of(c, self.dimensions) for c in group.cuts))
        if not group.unknowns:
            self._hang(group, {})
            return placed
        shape = dyad_shape(group)
        if shape is None:
            self._newton(placed)
        else:
            self._closed_form(placed, *shape)
        return placed

    # chains -------------------------------------------------------------------------------
    def driven(self, step: TreeJoint, parent: Pose) -> Coordinate:
        """Coordinate of a driven joint."""
        assert step.driver is not None
        given = self.drivers[step.driver]
        if given.turn is None:
            return given.slide
        driver = self.dimensions.mechanism.drivers[step.driver]
        turn = given.turn if step.child == driver.link else given.turn.conjugate
        return Rotor(parent.rotor.now.turn(turn), parent.rotor.local)

    def _hang(self, group: Group, coordinates: Mapping[TreeJoint, Coordinate]) -> None:
        for step in group.tree:
            parent = self.poses[step.parent]
            coordinate = self.driven(step, parent) if step.driver else coordinates.get(step)
            self.poses[step.child] = pair_of(step, self.dimensions).place(parent, coordinate)

    def _trial(self, group: Group, start: TreeJoint | None, end: str) -> dict[str, Pose]:
        """Poses along one chain with slides at zero; with ``start`` in the axes of its child, unturned."""
        poses = dict(self.poses)
        for step in reversed(list(group.path(end))):
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
        assert isinstance(cut, PinCut)
        chains = [self._chain(group, cut, end) for end in ends]
        solved = dyad.solve(chains[0], chains[1], self.mode(group))
        steps = [step for end in ends for step in chain_unknowns(group, end)]
        self._hang(group, dict(zip(steps, solved.coordinates, strict=True)))
        placed.dyad = dyad
        placed.facts = solved.facts
        placed.reached = solved.square >= -SINGULAR * solved.scale
        placed.valid = solved.square > SINGULAR * solved.scale
        placed.quality = solved.square / solved.scale
        sign = 1.0 if steps == list(group.unknowns) else -1.0
        matrix = jacobian(group, placed.cuts, self.poses, self.dimensions)
        placed.inverse = inverse(matrix, solved.inverse_determinant * sign)

    def _chain(self, group: Group, cut: PinCut, end: str) -> Chain:
        steps = chain_unknowns(group, end)
        if not steps:
            return Chain(self._trial(group, None, end)[end].point(cut.point(end)))
        turning = steps[0] if steps[0].kind == "revolute" else None
        trial = self._trial(group, turning, end)
        anchor = trial[end].point(cut.point(end))
        guides = [(step, pair) for step in steps if isinstance(pair := pair_of(step, self.dimensions), Guide)]
        directions = [pair.normal(trial[step.parent]) for step, pair in guides]
        senses = tuple(pair.sign for _, pair in guides)
        if turning is None:
            return Chain(anchor, None, tuple(directions), senses)
        parent = self._trial(group, None, turning.parent)[turning.parent]
        pivot = pair_of(turning, self.dimensions).place(parent, UNTURNED).place
        return Chain(pivot, anchor, tuple(directions), senses)

    # Newton -------------------------------------------------------------------------------
    def _newton(self, placed: Placed) -> None:
        group = placed.group
        coordinates: dict[TreeJoint, Coordinate] = {step: self._start(group, step) for step in group.unknowns}
        correction: list[Scalar] = []
        for remaining in reversed(range(self.iterations)):
            if remaining == 0:
                coordinates = {step: _stopped(value) for step, value in coordinates.items()}
            self._hang(group, coordinates)
            matrix = inverse(jacobian(group, placed.cuts, self.poses, self.dimensions))
            gap = [entry for cut in placed.cuts for entry in cut.residual(self.poses)]
            correction = product(matrix, gap)
            coordinates = {
                step: moved(value, -change)
                for (step, value), change in zip(coordinates.items(), correction, strict=True)
            }
        self._hang(group, coordinates)
        matrix = jacobian(group, placed.cuts, self.poses, self.dimensions)
        placed.inverse, placed.determinant = inverse(matrix), determinant(matrix)
        placed.coordinates = coordinates
        placed.next_states = carried(group, coordinates)
        placed.residual = _relative_square(group, correction, self.dimensions)
        placed.valid = placed.reached = placed.residual < CONVERGED
        placed.facts = {"correction²": placed.residual}

    def _start(self, group: Group, step: TreeJoint) -> Coordinate:
        trace, name = self.dimensions.trace, state_name(group, step)
        if step.kind == "prismatic":
            return trace.state(f"{name}.s")
        return Rotor(Vec(trace.state(f"{name}.x"), trace.state(f"{name}.y")), UNTURNED.local)


#: Square of the last Newton correction (relative) below which a position counts as found.
CONVERGED = 1e-16


def carried(group: Group, coordinates: Mapping[TreeJoint, Coordinate]) -> dict[str, Scalar]:
    """Chain coordinates by the names of the states that carry them to the next position."""
    states: dict[str, Scalar] = {}
    for step, value in coordinates.items():
        name = state_name(group, step)
        if isinstance(value, Rotor):
            states |= {f"{name}.x": value.now.x, f"{name}.y": value.now.y}
        else:
            assert value is not None
            states[f"{name}.s"] = value
    return states


def state_name(group: Group, step: TreeJoint) -> str:
    """Name of the carried coordinate of a chain's joint."""
    return f"{step.joint}:{step.child}"


def dyad_shape(group: Group) -> tuple[Dyad, tuple[str, str]] | None:
    """The closed form of a group, and the ends of its cut in the order of that form; None for others."""
    if len(group.cuts) != 1 or group.cuts[0].kind != "revolute" or len(group.unknowns) != 2:
        return None
    cut = group.cuts[0]
    ends = sorted((cut.a, cut.b), key=lambda link: _first_place(group, link))
    for order in ((ends[0], ends[1]), (ends[1], ends[0])):
        pattern = tuple("".join(s.connection.letter for s in chain_unknowns(group, end)) for end in order)
        for dyad in DYADS.values():
            if pattern == dyad.pattern:
                return dyad(), order
    return None


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
    size = mechanism_size(dimensions.mechanism)
    total: Scalar = 0.0
    for step, change in zip(group.unknowns, correction, strict=True):
        relative = change * (1.0 / size) if step.kind == "prismatic" else change
        total = total + relative * relative
    return total
