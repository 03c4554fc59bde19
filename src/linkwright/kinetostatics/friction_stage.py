"""Friction that agrees with the reactions it causes, as traced values: Newton's steps, and what they leave.

Without wheels, racks and cams all joint forces are linear in the friction, so that the forces that press the parts
of the joints together are f = |R + H f|, with R the reactions without friction. If the sizes of H have a spectral
radius below 1, this is a contraction: one solution, to which every iteration comes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from linkwright.core.dataclass import dataclass
from linkwright.engine.linear import product, solution
from linkwright.engine.trace import Mask, Scalar, Value, absolute, maximum, select, slope, sqrt, stop
from linkwright.engine.vector import Vec
from linkwright.kinetostatics.friction import FrictionTerm, FrictionTerms, still_name
from linkwright.kinetostatics.site import guide_state
from linkwright.kinetostatics.trace import ForceTrace
from linkwright.loads.site import Wrench
from linkwright.mechanism.mechanism import Mechanism

#: Newton's steps, and what the last one may leave, as share of the largest force.
STEPS, LEFT = 6, 1e-12
#: Power of the sizes of H whose largest sum of a row bounds that of the spectral radius.
POWER = 8
#: More terms than this make programs that take longer to compile than they save.
MOST = 16

Wrenches = Mapping[str, list[Wrench]]


def can_be_traced(mechanism: Mechanism, terms: int) -> bool:
    """Whether the joint forces are linear in the friction, and its terms not too many."""
    return not terms or (terms <= MOST and not any(joint.higher for joint in mechanism.joints.values()))


@dataclass(frozen=True)
class SolvedFriction:
    """Sizes of the friction by the names of its fields, and whether they are certain to be the only ones."""

    sizes: Mapping[str, Scalar]
    certain: Mask


def solved_friction(friction: FrictionTerms, forces_of: Callable[[Wrenches], ForceTrace]) -> SolvedFriction:
    """The friction at one position; ``forces_of``: the joint forces under further wrenches."""
    motion, terms = friction.motion, friction.terms
    plain, rubbing = forces_of({}), forces_of(friction.wrenches())
    factors = [_factor(friction, term) for term in terms]
    first = [_pressing(plain, term) for term in terms]
    gains = [
        [_slope(_pressing(rubbing, term), motion.trace.field_input(by.field)) * factor
         for by, factor in zip(terms, factors, strict=True)]
        for term in terms
    ]  # fmt: skip
    sizes = [_length(each) for each in first]
    for step in range(STEPS):
        sizes = _newton(first, gains, [stop(size) for size in sizes] if step == STEPS - 1 else sizes)
    found = [_length(force) for force in _under(first, gains, sizes)]
    gap, largest = 0.0, 0.0  # type: Scalar, Scalar
    for size, again in zip(sizes, found, strict=True):
        gap, largest = maximum(gap, absolute(again - size)), maximum(largest, again)
    certain = motion.trace.logic("and", gap <= LEFT * largest, _bound(gains) < 1.0)
    held = {term.field: size * c for term, size, c in zip(terms, sizes, factors, strict=True)}
    return SolvedFriction(held, certain)


def caused(friction: FrictionTerms, forces: ForceTrace, field: str) -> Scalar:
    """The friction, by the name of its field, that joint forces cause."""
    (term,) = (each for each in friction.terms if each.field == field)
    return _length(_pressing(forces, term)) * _factor(friction, term)


def _factor(friction: FrictionTerms, term: FrictionTerm) -> Scalar:
    """Friction over the force that presses the parts together: against the joint's rate, zero where it stands."""
    motion, dimensions = friction.motion, friction.motion.dimensions
    arm = dimensions(f"{term.joint}.friction")
    if term.slides:
        rate = guide_state(motion, term.joint)[2]
    else:
        rate = motion.states[term.b].omega - motion.states[term.a].omega
        arm = arm * dimensions(f"{term.joint}.pin_radius")
    still = motion.trace.parameter(still_name(term))
    return select(rate > still, -arm, select(rate < -still, arm, 0.0))


def _pressing(forces: ForceTrace, term: FrictionTerm) -> Vec:
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


def _under(first: list[Vec], gains: list[list[Vec]], sizes: list[Scalar]) -> list[Vec]:
    """The forces under friction of given pressing forces."""
    return [
        Vec(*(
            free + product([[getattr(gain, axis) for gain in row]], sizes)[0]
            for axis, free in (("x", force.x), ("y", force.y))
        ))
        for force, row in zip(first, gains, strict=True)
    ]  # fmt: skip


def _newton(first: list[Vec], gains: list[list[Vec]], sizes: list[Scalar]) -> list[Scalar]:
    """One step for f = |R + H f|."""
    matrix, gaps = [], []
    for j, force in enumerate(_under(first, gains, sizes)):
        length = _length(force)
        inverse = 1.0 / select(length > 0.0, length, 1.0)
        along = Vec(force.x * inverse, force.y * inverse)
        row = [-along.dot(gain) for gain in gains[j]]
        row[j] = row[j] + 1.0
        matrix.append(row)
        gaps.append(length - sizes[j])
    return [size + step for size, step in zip(sizes, solution(matrix, gaps), strict=True)]


def _bound(gains: list[list[Vec]]) -> Scalar:
    """At least the given power of the spectral radius of the sizes of H."""
    sizes = [[_length(gain) for gain in row] for row in gains]
    sums: list[Scalar] = [1.0] * len(sizes)
    for _ in range(POWER):
        sums = product(sizes, sums)
    largest: Scalar = 0.0
    for each in sums:
        largest = maximum(largest, each)
    return largest
