"""How the forces of higher pairs act, by the types of the pairs."""

from __future__ import annotations

import cmath
from dataclasses import dataclass, replace
from functools import singledispatch
from math import asin, atan, pi

from linkwright.joints.base import Joint
from linkwright.joints.belt import BeltPair
from linkwright.joints.gear import GearPair
from linkwright.joints.rack import RackPair
from linkwright.joints.rolling import RollingPair
from linkwright.mechanism.mechanism import Mechanism


@dataclass(frozen=True)
class Contact:
    """The force T of a higher pair on its first link, T being the multiplier of ``scale`` times the row of its sums.

    With the unit vector e at ``angle`` in the axes of ``link``, e⊥ left of it, and the angle ``lean`` of teeth or of
    ``strands``: force e⊥ T + e ``press`` |T| tan lean, or e⊥ T sin lean + e (``press`` |T| + 2 ``pull``) cos lean, N
    (``pull``: that each strand has without load). With the lever arm r of its first link, m, its row's factor: teeth
    touch in the point ``at`` (link, name) + r e, strands give ``at`` the couple r T, N·m.
    """

    scale: float
    link: str
    angle: float
    at: tuple[str, str]
    lean: float = 0.0
    strands: bool = False
    press: float = 0.0
    pull: float = 0.0


@singledispatch
def contact_of(joint: Joint, mechanism: Mechanism) -> Contact:
    """How the force of a higher pair acts.

    Raises:
        LackingError: nothing is registered for its kind.
    """
    raise joint.lacks("contact")


@contact_of.register
def of_rolling(joint: RollingPair, mechanism: Mechanism) -> Contact:
    """That of two wheels which roll on each other."""
    _, other = joint.arms(mechanism)
    angle, at = cmath.phase(joint.line(mechanism)), (joint.carrier, joint.centres[0])
    return Contact(-other, joint.carrier, angle, at, press=joint.sense)


@contact_of.register
def _(joint: GearPair, mechanism: Mechanism) -> Contact:
    return replace(of_rolling(joint, mechanism), lean=atan(joint.working_slope(mechanism)))


@contact_of.register
def _(joint: BeltPair, mechanism: Mechanism) -> Contact:
    line, (first, other) = joint.line(mechanism), joint.arms(mechanism)
    return Contact(
        -other,
        joint.carrier,
        cmath.phase(line),
        (joint.carrier, joint.centres[0]),
        lean=asin((first + other) / abs(line)),
        strands=True,
        press=0.0 if joint.pretension else 1.0,
        pull=joint.pretension,
    )


@contact_of.register
def _(joint: RackPair, mechanism: Mechanism) -> Contact:
    angle, at = joint.direction - 0.5 * pi, (joint.pinion, joint.centre)
    return Contact(1.0, joint.rack, angle, at, joint.pressure_angle, press=-joint.side)
