"""Outlines of the plates of wheels, rings and racks, with their teeth where these are known."""

from __future__ import annotations

import cmath
import math

import numpy as np

from linkwright.fabrication.teeth import Toothed, pinion_of, toothed
from linkwright.gears.rack import Rack
from linkwright.joints.rack import RackPair
from linkwright.mechanism.mechanism import Mechanism
from linkwright.shapes.shape import Shape, corners_of, joined, polygon
from linkwright.solids.carriers import Carriers
from linkwright.solids.solid import Solid

#: Sizes of a disc and its gear are equal to this share.
SAME = 1e-6
#: From a plate's edge to the tips of its teeth at most, in modules: teeth of rings may be shortened.
NEAR_TIP = 0.7
#: Corners of the rim of a ring.
RIM = 720


class WheelPlates:
    """The teeth of the wheels of a machine, in the axes of what carries them."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism, self.carriers = mechanism, Carriers(mechanism)
        self.gears = toothed(mechanism)

    def shape(self, plate: Solid) -> Shape:
        """The outline of a plate, without its holes: of a wheel or rack with its teeth where they are known."""
        if plate.sort == "wheel":
            for gear in self.gears:
                if self.carriers.carrier(gear.link) == plate.carrier and self._is(plate, gear):
                    return self._wheel(plate, gear)
            for joint in self.mechanism.joints.values():
                if isinstance(joint, RackPair) and self.carriers.carrier(joint.rack) == plate.carrier:
                    shape = self._rack(plate, joint)
                    if shape is not None:
                        return shape
        return plate.shape

    def _is(self, plate: Solid, gear: Toothed) -> bool:
        """Whether a plate is a gear: about the same centre, to the tips of the same teeth."""
        centre = self.carriers.places[gear.link].of(gear.centre)
        tip = 0.5 * gear.gear.tip_diameter
        (piece,) = plate.shape.pieces[:1]
        away = np.abs(piece.corners - centre)
        reach = away.min() - piece.radius if gear.gear.internal else away.max() + piece.radius
        round_about = math.isclose(away.min(), away.max(), rel_tol=1e-3, abs_tol=SAME * tip)
        return bool(round_about and abs(reach - tip) < NEAR_TIP * gear.gear.module)

    def _wheel(self, plate: Solid, gear: Toothed) -> Shape:
        place = self.carriers.places[gear.link]
        teeth = place.origin + place.turn * gear.corners
        if not gear.gear.internal:
            return polygon(teeth)
        centre, (piece,) = place.of(gear.centre), plate.shape.pieces[:1]
        rim = float(np.abs(piece.corners - centre).max()) + piece.radius
        outer = centre + rim * np.exp(2j * np.pi * np.arange(RIM) / RIM)
        return polygon(outer, [teeth])

    def _rack(self, plate: Solid, joint: RackPair) -> Shape | None:
        """A rectangle to the roots of its teeth, and as many whole teeth as it has room for."""
        pinion = next((each for each in self.gears if each.link == joint.pinion), None)
        gear = pinion_of(joint)
        (piece,) = plate.shape.pieces[:1]
        if gear is None or pinion is None or len(plate.shape.pieces) > 1 or len(piece.corners) != 4:
            return None
        place, rack = self.carriers.places[joint.rack], Rack(1, gear.module, gear.pressure_angle)
        way = place.turn * cmath.exp(1j * joint.direction)
        through = self.carriers.place(joint.rack, joint.through)
        local = (piece.corners - through) * way.conjugate()
        if joint.side < 0:  # half a turn puts the teeth up
            local, way = -local, -way
        # a tooth of the pinion is so far along the line from `through` when its centre is above that, and a tooth
        # of the rack half a pitch further
        angle = (joint.phase or 0.0) + pinion.turn - joint.direction + 0.5 * math.pi * joint.side
        first = joint.radius * angle + 0.5 * rack.pitch
        low, high = float(local.real.min()), float(local.real.max())
        number = math.ceil((low - first) / rack.pitch + 0.5)
        count = math.floor((high - first) / rack.pitch - 0.5) - number + 1
        if count < 1:
            return None
        start = first + number * rack.pitch
        teeth = corners_of(Rack(count, gear.module, gear.pressure_angle).outline()) + start
        back, root = float(local.imag.min()), -rack.dedendum * gear.module
        body = [complex(low, back), complex(high, back), complex(high, root), complex(low, root)]
        return joined((polygon(through + way * np.array(body)), polygon(through + way * teeth)))
