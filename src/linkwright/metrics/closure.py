"""How well a group's closure determines its motion: angles between the ways in which its cut can move."""

from __future__ import annotations

import numpy as np

from linkwright.joints.prismatic import PrismaticJoint
from linkwright.kinematics.cycle import Floats
from linkwright.kinematics.drawing import guide_angle
from linkwright.kinematics.motion import Motion
from linkwright.structure.group import Group, TreeJoint


def dyads(motion: Motion) -> tuple[Group, ...]:
    """The groups of two unknowns that are cut at a pin."""
    return tuple(group for group in closable(motion) if len(group.unknowns) == 2)


def closable(motion: Motion) -> tuple[Group, ...]:
    """The groups whose cuts are all pins."""
    return tuple(
        group
        for group in motion.structure.groups
        if group.unknowns and group.cuts and all(cut.kind == "revolute" for cut in group.cuts)
    )


def columns(motion: Motion, group: Group) -> Floats:
    """Directions in which the cuts move with each unknown, (n, equations, unknowns), each column of length 1."""
    found = np.zeros((motion.steps, 2 * len(group.cuts), len(group.unknowns)))
    for row, cut in enumerate(group.cuts):
        place = motion.point(cut.joint).position
        for sign, end in ((1.0, cut.a), (-1.0, cut.b)):
            for step in group.path(end):
                if step.free:
                    column = group.unknowns.index(step)
                    found[:, 2 * row : 2 * row + 2, column] += sign * _way(motion, step, place)
    with np.errstate(all="ignore"):
        return np.asarray(found / np.linalg.norm(found, axis=1)[:, None, :])


def _way(motion: Motion, step: TreeJoint, place: Floats) -> Floats:
    """Velocity of the cut for a unit rate of one joint, (n, 2)."""
    if step.kind == "revolute":
        arm = place - motion.point(step.joint).position
        return np.stack([-arm[:, 1], arm[:, 0]], axis=1)
    joint = motion.mechanism.joints[step.joint]
    assert isinstance(joint, PrismaticJoint)
    angle = guide_angle(motion.mechanism, joint)
    e = motion.link(joint.guide).direction
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * e[:, 0] - s * e[:, 1], s * e[:, 0] + c * e[:, 1]], axis=1)


def transmission_angle(motion: Motion, group: Group) -> Floats:
    """Transmission angle of a dyad, (n,) rad, 0 to π/2.

    The acute angle between the two ways in which the dyad's cut can move. RRR: between coupler and output link;
    RRP: between the rod and the normal of the guide; RPR: between the line of the two pins and the normal of the
    slot; PRP and RPP: between the two guides. Its sine is the determinant of the closure equations with unit
    columns, so zero is a dead point.
    """
    j = columns(motion, group)
    cross = j[:, 0, 0] * j[:, 1, 1] - j[:, 1, 0] * j[:, 0, 1]
    dot = j[:, 0, 0] * j[:, 0, 1] + j[:, 1, 0] * j[:, 1, 1]
    return np.arctan2(np.abs(cross), np.abs(dot))


def conditioning(motion: Motion, group: Group) -> Floats:
    """Determinant of the closure equations with unit columns, (n,), 0 (singular) to 1; a dyad's is sin μ."""
    j = columns(motion, group)
    known = np.isfinite(j).all(axis=(1, 2))
    found = np.full(motion.steps, np.nan)
    found[known] = np.abs(np.linalg.det(j[known]))
    return found
