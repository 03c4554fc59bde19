"""Velocities and accelerations of one group from its closure: J q̇ = -(drift), J q̈ = -(bend).

The same three lines serve every group: the chains are run through with the unknown rates at zero, what
is then missing at the cuts gives the right side, and the chains are run through again.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from linkwright.elements.topology import TreeJoint
from linkwright.formula.linear import product
from linkwright.formula.trace import Scalar
from linkwright.joints.pose import Pose, State
from linkwright.kinematics.closure import pair_of
from linkwright.kinematics.dimensions import Dimensions, DriverInput
from linkwright.kinematics.groups import Placed

Rates = Mapping[TreeJoint, Scalar]


class RateTracer:
    """Traces rates group after group into ``states``; keeps the chain coordinates' rates in ``found``."""

    def __init__(
        self,
        dimensions: Dimensions,
        drivers: Mapping[str, DriverInput],
        poses: Mapping[str, Pose],
        states: dict[str, State],
    ) -> None:
        self.dimensions = dimensions
        self.drivers = drivers
        self.poses = poses
        self.states = states
        self.found: dict[TreeJoint, Scalar] = {}

    def move(self, placed: Placed) -> None:
        """Velocities and accelerations of a group's links, found and stored."""
        unknowns = placed.group.unknowns
        self._velocities(placed, dict.fromkeys(unknowns, 0.0))
        drift = [entry for cut in placed.cuts for entry in cut.drift(self.states)]
        rates = self._solved(placed, drift)
        self._velocities(placed, rates)
        self._accelerations(placed, dict.fromkeys(unknowns, 0.0))
        bend = [entry for cut in placed.cuts for entry in cut.bend(self.states)]
        seconds = self._solved(placed, bend)
        self._accelerations(placed, seconds)
        placed.rates, placed.seconds = rates, seconds

    def _solved(self, placed: Placed, gap: Sequence[Scalar]) -> Rates:
        solution = product(placed.inverse, [-entry for entry in gap])
        return dict(zip(placed.group.unknowns, solution, strict=True))

    def _velocities(self, placed: Placed, rates: Rates) -> None:
        for step in placed.group.tree:
            parent = self.states[step.parent]
            rate = self._rate(step, parent.omega, rates)
            self.found[step] = rate
            pair = pair_of(step, self.dimensions)
            self.states[step.child] = pair.rates(parent, self.poses[step.child], rate)

    def _accelerations(self, placed: Placed, seconds: Rates) -> None:
        for step in placed.group.tree:
            parent, child = self.states[step.parent], self.states[step.child]
            second = self._second(step, parent.alpha, seconds)
            pair = pair_of(step, self.dimensions)
            self.states[step.child] = pair.accelerate(parent, child, self.found[step], second)

    def _rate(self, step: TreeJoint, carried: Scalar, rates: Rates) -> Scalar:
        if step.driver is None:
            return rates.get(step, 0.0)
        return self._with_drive(step, self.drivers[step.driver].rate, carried)

    def _second(self, step: TreeJoint, carried: Scalar, seconds: Rates) -> Scalar:
        if step.driver is None:
            return seconds.get(step, 0.0)
        return self._with_drive(step, self.drivers[step.driver].second, carried)

    def _with_drive(self, step: TreeJoint, value: Scalar, carried: Scalar) -> Scalar:
        """A driver's rate as the chain counts it: absolute for a pin, of the block for a guide."""
        if step.slides:
            return value
        assert step.driver is not None
        own = step.child == self.dimensions.mechanism.drivers[step.driver].link
        return carried + value if own else carried - value
