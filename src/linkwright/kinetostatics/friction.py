"""Coulomb friction in joints: couples in pins, forces along guides, as inputs that an iteration sets."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.applied_loads.site import Wrench
from linkwright.core.arrays import Floats
from linkwright.core.outputs import RelativeAngle, row_name
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Scalar
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.trace import MotionOutputs, MotionTrace
from linkwright.kinetostatics.load_site import guide_state
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
