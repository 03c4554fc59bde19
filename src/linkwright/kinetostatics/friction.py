"""Coulomb friction in joints: couples and forces that an iteration sets, or traced in agreement with the reactions.

Joint forces are linear in the friction and in the sizes of the forces between teeth, which press with either flank.
Separating forces of teeth do no work, so that the latter change no force between teeth. Hence the forces that press
the parts of the joints together are f = |R + A f + B |S + C f||, with R and S the forces without friction. If the
sizes H = |A| + |B| |C| have a spectral radius below 1, this is a contraction: one solution, to which every iteration
comes. Joint forces follow from the last group to the first, and the friction block by block with them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from linkwright.applied_loads.site import Wrench
from linkwright.core.arrays import Floats
from linkwright.core.outputs import RelativeAngle, row_name
from linkwright.elements import Connection
from linkwright.formula.differentiation import slope
from linkwright.formula.linear_algebra import ZERO, Vec, product, solution
from linkwright.formula.trace import Mask, Scalar, Value, absolute, maximum, select, sqrt, stop
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.trace import MotionOutputs, MotionTrace
from linkwright.kinetostatics.load_site import guide_state
from linkwright.kinetostatics.trace import ForceTrace, Size
from linkwright.mechanism.mechanism import Mechanism


@dataclass(frozen=True)
class FrictionTerm:
    """Friction between link ``a`` and link ``b`` at a joint.

    Pin: couple on b of magnitude ``coefficient`` · pin radius · reaction, against the relative rotation. Guide:
    force on the block of magnitude ``coefficient`` · normal force, against the sliding.
    """

    joint: str
    a: str
    b: str
    arm: float
    slides: bool

    @property
    def field(self) -> str:
        """Name of the program's input that holds it."""
        return row_name("friction", self.joint, on=self.b)

    def __str__(self) -> str:
        return self.field


class FrictionTerms:
    """All friction of a mechanism's joints."""

    def __init__(self, motion: MotionTrace, terms: tuple[FrictionTerm, ...]) -> None:
        self.motion = motion
        self.terms = terms

    @classmethod
    def of(cls, mechanism: Mechanism, motion: MotionTrace) -> FrictionTerms:
        """The friction terms of the joints of a mechanism that have a coefficient; ``motion``: of its shape.

        Raises:
            LinkwrightError: a pin with friction but without a radius.
        """
        terms = []
        for name, joint in mechanism.joints.items():
            arm, slides = joint.friction_arm, joint.coordinate == "slide"
            if arm:
                pairs = [(c.a, c.b) for p in motion.placed.values() for c in p.group.joints if c.joint == name]
                terms += [FrictionTerm(name, a, b, arm, slides) for a, b in pairs]
        return cls(motion, tuple(terms))

    @cached_property
    def blocks(self) -> tuple[tuple[FrictionTerm, ...], ...]:
        """The terms in the order in which their joint forces follow, from the last group to the first: those of a
        block from their own friction and that of the blocks before.

        A block has the terms of one group; of more where a link has the same pin in several.
        """
        groups = [placed.group for placed in self.motion.placed.values()]
        own, first = {}, {}
        for term in self.terms:
            at = [(k, c) for k, group in enumerate(groups) for c in group.joints if c.joint == term.joint]
            own[term] = next(k for k, c in at if (c.a, c.b) == (term.a, term.b))
            first[term] = min(k for k, c in at if term.b in (c.a, c.b))
        blocks: list[list[FrictionTerm]] = []
        reach = len(groups)
        for term in sorted(self.terms, key=own.__getitem__, reverse=True):
            if own[term] < reach:
                blocks.append([])
            blocks[-1].append(term)
            reach = min(reach, first[term])
        return tuple(map(tuple, blocks))

    def wrenches(self, sizes: Mapping[str, Scalar] | None = None) -> dict[str, list[Wrench]]:
        """The friction as loads on both links; magnitudes by the names of the fields, else inputs of these names."""
        term_sizes = sizes or {term.field: self.motion.trace.field_input(term.field) for term in self.terms}
        return {term.field: self._wrenches(term, term_sizes[term.field]) for term in self.terms}

    def _wrenches(self, term: FrictionTerm, size: Scalar) -> list[Wrench]:
        if not term.slides:
            return [Wrench(term.b, torque=size), Wrench(term.a, torque=-size)]
        direction, place, _ = guide_state(self.motion, term.joint)
        force = Vec(direction.x * size, direction.y * size)
        return [Wrench(term.b, force, place), Wrench(term.a, -force, place)]


def joint_rate(motion: Motion, term: FrictionTerm | RelativeAngle) -> Floats:
    """Rate of link b against link a, (n,) rad/s, or of the block along the guide, m/s."""
    if isinstance(term, FrictionTerm) and term.slides:
        return motion.joint(term.joint).velocity
    return np.asarray(motion.link(term.b).angular_velocity - motion.link(term.a).angular_velocity)


def moving_rate(motion: Motion, term: FrictionTerm | RelativeAngle) -> Floats:
    """The same, zero at rest."""
    if isinstance(term, FrictionTerm) and term.slides:
        joint = motion.joint(term.joint)
        return motion.moving(joint.velocity, joint.acceleration, "length")
    return motion.turning(term.b, term.a)


def traced_rate(motion: MotionTrace, term: FrictionTerm) -> Scalar:
    """The same as a traced value."""
    if not term.slides:
        return motion.turning(term.b, term.a)
    _, rate, second = MotionOutputs(motion).slide(term.joint)
    return motion.moving(rate, second, "length")


#: Newton's steps, and what the last one may leave, as share of the largest force.
STEPS, LEFT = 6, 1e-12
#: Power of the sizes of H whose largest sum of a row bounds that of the spectral radius.
POWER = 8
#: More terms than this in one block make programs that take longer to compile than they save.
MOST = 16

Wrenches = Mapping[str, list[Wrench]]


class ForcesOf(Protocol):
    """The joint forces under further wrenches, with the sizes of the forces between teeth."""

    def __call__(self, wrenches: Wrenches, *, size: Size) -> ForceTrace: ...


def can_be_traced(friction: FrictionTerms) -> bool:
    """Whether no block has too many terms."""
    return max(map(len, friction.blocks), default=0) <= MOST


@dataclass(frozen=True)
class SolvedFriction:
    """Sizes of the friction by the names of its fields, whether they agree with the reactions (``found``; else there
    are none, and the mechanism jams), and whether they are certain to be the only ones."""

    sizes: Mapping[str, Scalar]
    found: Mask
    certain: Mask


def solved_friction(friction: FrictionTerms, forces_of: ForcesOf) -> SolvedFriction:
    """The friction at one position."""
    held: dict[str, Scalar] = {term.field: 0.0 for term in friction.terms}
    gap, largest, bound = 0.0, 0.0, 0.0  # type: Scalar, Scalar, Scalar
    for terms in friction.blocks:
        factors = [_factor(friction, term) for term in terms]
        block = _block(friction, terms, factors, held, forces_of)
        sizes: list[Scalar] = [0.0] * len(terms)  # of several solutions the one that friction from nothing leads to
        for step in range(STEPS):
            sizes = _newton(block, [stop(size) for size in sizes] if step == STEPS - 1 else sizes)
        for size, force in zip(sizes, block.under(sizes)[0], strict=True):
            again = _length(force)
            gap, largest = maximum(gap, absolute(again - size)), maximum(largest, again)
        bound = maximum(bound, _bound(block.most))
        held |= {term.field: size * c for term, size, c in zip(terms, sizes, factors, strict=True)}
    found = gap <= LEFT * largest
    return SolvedFriction(held, found, friction.motion.trace.logic("and", found, bound < 1.0))


@dataclass(frozen=True)
class _Teeth:
    """The force between the teeth of one pair: without friction, what unit sizes of a block's pressing forces add to
    it, and what its unit size adds to these."""

    first: Scalar
    gains: Sequence[Scalar]
    presses: Sequence[Vec]


@dataclass(frozen=True)
class _Block:
    """Pressing forces (terms,) without friction, and what unit sizes add to them (terms, terms)."""

    first: Sequence[Vec]
    gains: Sequence[Sequence[Vec]]
    teeth: Sequence[_Teeth]

    def under(self, sizes: Sequence[Scalar]) -> tuple[list[Vec], list[list[Vec]]]:
        """The forces under friction from normal forces, and their derivatives by these."""
        forces = [
            Vec(
                *(
                    free + product([[getattr(gain, axis) for gain in row]], sizes)[0]
                    for axis, free in (("x", force.x), ("y", force.y))
                )
            )
            for force, row in zip(self.first, self.gains, strict=True)
        ]
        slopes = [list(row) for row in self.gains]
        for pair in self.teeth:
            force = pair.first + product([pair.gains], sizes)[0]
            side = select(force < 0.0, -1.0, 1.0)
            for j, press in enumerate(pair.presses):
                forces[j] = forces[j] + press * (force * side)
                slopes[j] = [gain + press * (side * by) for gain, by in zip(slopes[j], pair.gains, strict=True)]
        return forces, slopes

    @property
    def most(self) -> list[list[Scalar]]:
        """The sizes of H."""
        found = [[_length(gain) for gain in row] for row in self.gains]
        for pair in self.teeth:
            by = [absolute(gain) for gain in pair.gains]
            for j, press in enumerate(pair.presses):
                found[j] = [known + _length(press) * each for known, each in zip(found[j], by, strict=True)]
        return found


def _block(
    friction: FrictionTerms,
    terms: Sequence[FrictionTerm],
    factors: Sequence[Scalar],
    held: Mapping[str, Scalar],
    forces_of: ForcesOf,
) -> _Block:
    """The linear forms of one block; ``held``: the friction found before, zero of the others."""
    trace = friction.motion.trace
    free: dict[str, Scalar] = {}
    teeth: dict[str, Scalar] = {}
    inputs: dict[str, Value] = {}

    def none(connection: Connection, force: Scalar) -> Scalar:
        free[connection.joint] = force
        return 0.0

    def tooth_force(connection: Connection, force: Scalar) -> Scalar:
        name = connection.joint
        teeth[name], inputs[name] = force, trace.field_input(f"teeth:{name}")
        return inputs[name]

    plain = forces_of(friction.wrenches(held), size=none)
    fields = {term.field: trace.field_input(term.field) for term in terms}
    rubbing = forces_of(friction.wrenches({**held, **fields}), size=tooth_force)
    forces = [pressing(rubbing, term) for term in terms]
    by = list(zip(fields.values(), factors, strict=True))
    pairs = [
        _Teeth(
            free[name],
            [slope(force, {each: 1.0}) * factor for each, factor in by],
            [_slope(press, inputs[name]) for press in forces],
        )
        for name, force in teeth.items()
    ]
    return _Block(
        [pressing(plain, term) for term in terms],
        [[_slope(press, each) * factor for each, factor in by] for press in forces],
        [pair for pair in pairs if any(press != ZERO for press in pair.presses)],
    )


def caused(friction: FrictionTerms, forces: ForceTrace, field: str) -> Scalar:
    """The friction, by the name of its field, that joint forces cause."""
    (term,) = (each for each in friction.terms if each.field == field)
    return _length(pressing(forces, term)) * _factor(friction, term)


def _factor(friction: FrictionTerms, term: FrictionTerm) -> Scalar:
    """Friction over the force that presses the parts together: against the joint's rate, zero at rest."""
    motion, dimensions = friction.motion, friction.motion.dimensions
    arm = dimensions(f"{term.joint}.friction")
    if not term.slides:
        arm = arm * dimensions(f"{term.joint}.pin_radius")
    rate = traced_rate(motion, term)
    return select(rate > 0.0, -arm, select(rate < 0.0, arm, 0.0))


def pressing(forces: ForceTrace, term: FrictionTerm) -> Vec:
    """The force that presses the two parts together, of a guide across it as (force, 0)."""
    force = forces.reaction(term.joint, term.b)
    return Vec(guide_state(forces.motion, term.joint)[0].cross(force), 0.0) if term.slides else force


def _slope(force: Vec, by: Value) -> Vec:
    return Vec(slope(force.x, {by: 1.0}), slope(force.y, {by: 1.0}))


def _length(force: Vec) -> Scalar:
    """Size of a force, with the slope zero where it is zero."""
    if isinstance(force.y, float) and force.y == 0.0:
        return absolute(force.x)
    square = force.square
    return select(square > 0.0, sqrt(select(square > 0.0, square, 1.0)), 0.0)


def _newton(block: _Block, sizes: Sequence[Scalar]) -> list[Scalar]:
    """One step for f = |R + A f + B |S + C f||."""
    matrix, gaps = [], []
    for j, (force, slopes) in enumerate(zip(*block.under(sizes), strict=True)):
        length = _length(force)
        inverse = 1.0 / select(length > 0.0, length, 1.0)
        along = Vec(force.x * inverse, force.y * inverse)
        row = [-along.dot(each) for each in slopes]
        row[j] = row[j] + 1.0
        matrix.append(row)
        gaps.append(length - sizes[j])
    return [size + step for size, step in zip(sizes, solution(matrix, gaps), strict=True)]


def _bound(sizes: Sequence[Sequence[Scalar]]) -> Scalar:
    """At least this power of the spectral radius."""
    sums: list[Scalar] = [1.0] * len(sizes)
    for _ in range(POWER):
        sums = product(sizes, sums)
    largest: Scalar = 0.0
    for each in sums:
        largest = maximum(largest, each)
    return largest
