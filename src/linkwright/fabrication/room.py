"""How much room there is around a pin between its plates, where spacers go."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from linkwright.collisions.gaps import Moving, smallest_gaps
from linkwright.fabrication.holes import Assembly, axis, hubs_around, pin_radius
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.layering.arrangement import Layers
from linkwright.shapes.shape import disc
from linkwright.solids.solid import Solid


@dataclass
class Room:
    """The room around the pins of a machine in layers."""

    layers: Layers
    pose: Assembly

    @cached_property
    def motion(self) -> Motion:
        """The cycle."""
        return solve_motion(self.layers.mechanism, failures="mark")

    def radius(self, pin: Solid, low: int, high: int) -> float:
        """How large a ring on a pin may be in the layers from one to another, m; infinite where they are empty."""
        own = Moving(pin.carrier, pin.shape)
        pairs = [(own, each) for each in self._others(pin, low, high)]
        construction = self.layers.mechanism.construction
        clearance = 0.0 if construction is None else construction.clearance or 0.0
        gaps = smallest_gaps(self.motion, pairs)
        return min((pin_radius(pin) + each.size - clearance for each in gaps), default=math.inf)

    def _others(self, pin: Solid, low: int, high: int) -> Iterator[Moving]:
        """What else lies in layers, heads of pins among it."""
        near = {pin.name, *(each.name for each in hubs_around(self.layers, self.pose, pin))}
        for each in self.layers.solids.by_name.values():
            if each.name in near or not {*each.plates} & self.layers.layer.keys():
                continue
            first, last = self.layers.span(each.name)
            if first <= high and low <= last:
                yield Moving(each.carrier, each.shape)
            elif each.head > 0.0 and (first - 1 in range(low, high + 1) or last + 1 in range(low, high + 1)):
                yield Moving(each.carrier, disc(axis(each), each.head))
