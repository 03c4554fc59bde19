"""Loads whose magnitudes are traced with the motion, and the numbers of a cycle that they take."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from linkwright.applied_loads.base import Load
from linkwright.core.outputs import Output, row_name
from linkwright.formula.table import Table
from linkwright.formula.trace import Scalar
from linkwright.kinematics.trace import MotionTrace
from linkwright.kinetostatics.load_site import TracedSite, constant_name, middle_name
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.mechanism.mechanism import Mechanism

#: An angle that covers more than this is one of a link that turns.
TURNING = 1.9 * np.pi


@dataclass(frozen=True)
class AlongInput:
    """Loads whose magnitudes are traced, and what these take.

    ``outputs``: those whose limit positions they need; ``angles``: of which pairs of links (see
    ``Magnitude.angles``); ``constants`` and ``tables`` by name: numbers of the loads that are no dimensions;
    ``fallible``: loads that may have no value for some designs; ``rubbing``: friction of joints is traced as well.
    """

    names: frozenset[str]
    outputs: tuple[Output, ...] = ()
    angles: Mapping[tuple[str, str], float | None] = field(default_factory=dict)
    constants: Mapping[str, float] = field(default_factory=dict)
    tables: Mapping[str, Table] = field(default_factory=dict)
    fallible: tuple[str, ...] = ()
    rubbing: bool = False

    def sizes(self, motion: MotionTrace) -> Scalar:
        """Sum of the magnitudes of the fallible loads: not finite where one has no value."""
        return sum((traced_magnitude(motion, name) for name in self.fallible), 0.0)

    def middles(self, signals: MotionSignals) -> dict[str, float] | None:
        """Angles near which the angles that loads take stay; None where a link turns through."""
        found = {}
        for (a, b), near in self.angles.items():
            angle = signals.angle_of(a, b, near)
            low, high = float(np.nanmin(angle)), float(np.nanmax(angle))
            if not high - low <= TURNING or (near is not None and abs(angle[0] - near) > 0.9 * np.pi):
                return None
            found[middle_name(a, b)] = 0.5 * (low + high)
        return found


def numbers_of_loads(loads: Iterable[Load], mechanism: Mechanism) -> AlongInput:
    """What the magnitudes of loads of a mechanism take."""
    magnitudes = {each.name: each.magnitude for each in loads}
    sizes = magnitudes.values()
    limits = [each.limits for each in sizes if each.limits is not None]
    return AlongInput(
        frozenset(magnitudes),
        tuple(dict.fromkeys(each.output for each in limits)),
        {pair: near for each in sizes for pair, near in each.angles(mechanism).items()},
        {
            constant_name(name, key): value
            for name, each in magnitudes.items()
            for key, value in each.constants.items()
        },
        {row_name("magnitude", name): each.size.curve for name, each in magnitudes.items() if each.size.curve},
        tuple(name for name, each in magnitudes.items() if each.fallible),
    )


def traced_magnitude(motion: MotionTrace, name: str) -> Scalar:
    """The magnitude of a load over the input."""
    return TracedSite(motion, motion.mechanism.loads[name], along_input=True).magnitude()
