"""How well a group's closure determines its motion: angles between the ways in which its cut can move, traced."""

from __future__ import annotations

from linkwright.elements import Group, TreeJoint
from linkwright.formula.linear_algebra import Vec, determinant
from linkwright.formula.recently_made import Recent
from linkwright.formula.trace import Scalar, absolute, angle, sqrt
from linkwright.kinematics.trace import MotionOutputs
from linkwright.kinetostatics.load_site import guide_state
from linkwright.topology.analysis import Structure


def dyads(structure: Structure) -> tuple[Group, ...]:
    """The groups of two unknowns that are cut at a pin."""
    return tuple(group for group in closable(structure) if len(group.unknowns) == 2)


def closable(structure: Structure) -> tuple[Group, ...]:
    """The groups whose cuts are all pins."""
    return _closable.get(
        structure,
        None,
        lambda: tuple(
            group
            for group in structure.groups
            if group.unknowns and group.cuts and all(cut.turns for cut in group.cuts)
        ),
    )


_closable: Recent[Structure, tuple[Group, ...]] = Recent(64)


def transmission(outputs: MotionOutputs, group: Group) -> Scalar:
    """Transmission angle of a dyad, 0 to π/2.

    The acute angle between the two ways in which the dyad's cut can move. RRR: between coupler and output link;
    RRP: between the rod and the normal of the guide; RPR: between the line of the two pins and the normal of the
    slot; PRP and RPP: between the two guides. Its sine is the determinant of the closure equations with unit
    columns, so zero is a dead point.
    """
    return angle(*_across_and_along(_columns(outputs, group)))


def half_transmission(outputs: MotionOutputs, group: Group) -> Scalar:
    """Tangent of half the transmission angle, 0 to 1, which grows with the angle and costs no arc tangent."""
    columns = _columns(outputs, group)
    across, along = _across_and_along(columns)
    return _share(across, _sizes(outputs, group, columns) + along)


def _across_and_along(columns: list[list[Scalar]]) -> tuple[Scalar, Scalar]:
    """Sine and cosine of the acute angle between two columns, times their lengths."""
    (a, b), (c, d) = columns
    return absolute(a * d - b * c), absolute(a * c + b * d)


def conditioning(outputs: MotionOutputs, group: Group) -> Scalar:
    """Determinant of the closure equations with unit columns, 0 (singular) to 1; a dyad's is sin μ."""
    columns = _columns(outputs, group)
    return _share(absolute(determinant(columns)), _sizes(outputs, group, columns))


def _share(part: Scalar, all_of_it: Scalar) -> Scalar:
    """A quotient; 0 where a column is known to be zero, as for pins at one place."""
    return 0.0 if isinstance(all_of_it, float) and all_of_it == 0.0 else part / all_of_it


def _sizes(outputs: MotionOutputs, group: Group, columns: list[list[Scalar]]) -> Scalar:
    """Product of the lengths of all columns."""
    sizes: Scalar = 1.0
    for step, column in zip(group.unknowns, columns, strict=True):
        sizes = sizes * _size(outputs, group, step, column)
    return sizes


def _size(outputs: MotionOutputs, group: Group, step: TreeJoint, column: list[Scalar]) -> Scalar:
    """Length of a column: where it moves one cut that is on its own link, no position changes it."""
    moved = [(cut, end) for cut in group.cuts for end in (cut.a, cut.b) if step in group.path(end)]
    if len(moved) == 1:
        ((cut, end),) = moved
        if step.slides:
            return 1.0
        if step.child == end:
            return outputs.motion.dimensions.distance(end, step.joint, cut.joint)
    return sqrt(sum((entry * entry for entry in column), 0.0))


def _columns(outputs: MotionOutputs, group: Group) -> list[list[Scalar]]:
    """Directions in which the cuts move with each unknown: per unknown a column of two entries per cut."""
    found: list[list[Scalar]] = [[0.0] * (2 * len(group.cuts)) for _ in group.unknowns]
    for row, cut in enumerate(group.cuts):
        place = outputs.point(cut.joint)[0]
        for sense, end in ((1.0, cut.a), (-1.0, cut.b)):
            for step in group.path(end):
                if step.free:
                    way = _way(outputs, step, place) * sense
                    column = found[group.unknowns.index(step)]
                    column[2 * row] = column[2 * row] + way.x
                    column[2 * row + 1] = column[2 * row + 1] + way.y
    return found


def _way(outputs: MotionOutputs, step: TreeJoint, place: Vec) -> Vec:
    """Velocity of the cut for a unit rate of one joint."""
    if step.turns:
        return (place - outputs.point(step.joint)[0]).perp
    return guide_state(outputs.motion, step.joint)[0]
