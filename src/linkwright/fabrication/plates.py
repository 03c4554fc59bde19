"""Plates to cut: links, wheels with their teeth, cams, guides, the frame; and blocks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from linkwright.fabrication.holes import Assembly, check_holes, holes_of, pin_radius
from linkwright.fabrication.mounting import mounting_holes
from linkwright.fabrication.part import Hole, Part, Place
from linkwright.fabrication.wheel_plates import WheelPlates
from linkwright.layering.arrangement import Layers
from linkwright.mechanism.plate import material_of
from linkwright.shapes.distance import contains
from linkwright.shapes.shape import Shape, polygon
from linkwright.solids.solid import Solid
from linkwright.words import Message, _

#: How far from its centre a pin's head reaches at most, in radii of the pin.
HEADS = 1.6
_CYLINDER = _(
    "{guide} and {block} slide in each other like barrel and rod: their plates show lengths and pins; take a "
    "cylinder or a telescopic tube.",
    code="cut.cylinder",
)


@dataclass
class Plates:
    """Makes the plates of a machine in layers."""

    layers: Layers
    pose: Assembly

    @cached_property
    def wheels(self) -> WheelPlates:
        """The teeth of wheels and racks."""
        return WheelPlates(self.layers.mechanism)

    @cached_property
    def holes(self) -> Mapping[str, tuple[Hole, ...]]:
        """The holes of all plates for pins and posts."""
        return holes_of(self.layers, self.pose)

    def parts(self) -> Iterator[Part]:
        """All plates from below, then the blocks that reach from their guide to the plate of their link."""
        solids = self.layers.solids.by_name.values()
        height = self.layers.height
        for each in sorted((each for each in solids if each.is_plate), key=lambda each: height[each.name]):
            shape = self._eased(each) if each.sort == "block" else self.wheels.shape(each)
            yield self._part(each, shape, self._holes(each, shape), height[each.name])
        for each in solids:
            if each.sort == "block" and len(each.plates) > 1:
                height_of_block = self._block(each)
                yield self._part(each, self._eased(each), self._through(each, height_of_block), height_of_block)

    def notes(self) -> Iterator[Message]:
        """What is drawn as plates and is to be bought, or made otherwise."""
        solids = self.layers.solids
        level = {frozenset(each) for each in solids.level}
        for joint in self.layers.mechanism.guides.values():
            together = frozenset((joint.guide, joint.block)) in level
            if together and solids.by_name[joint.block].sort != "block":
                yield _CYLINDER.format(guide=joint.guide, block=joint.block)

    def _part(self, solid: Solid, shape: Shape, holes: tuple[Hole, ...], height: tuple[float, float]) -> Part:
        low, high = height
        bored = Shape(shape.pieces, tuple((each.centre, each.radius) for each in holes))
        material = material_of(self.layers.mechanism.link(solid.carrier), self.layers.mechanism.construction)
        layer = min(self.layers.layer[plate] for plate in solid.plates)
        place = Place(solid.carrier, 0j, low, solid.name)
        part = Part(solid.name, "plate", bored, high - low, material.name, 0.0, layer, (place,), holes)
        check_holes(part)
        return replace(part, mass=sum(loop.area for loop in part.loops) * part.length * material.density)

    def _holes(self, solid: Solid, shape: Shape) -> tuple[Hole, ...]:
        """The holes of a plate; in the base plate those by which it is mounted as well."""
        holes = self.holes[solid.name]
        mechanism = self.layers.mechanism
        if solid.name != "frame" or mechanism.frame.shape is not None:
            return holes
        return holes + mounting_holes(shape, holes, HEADS)

    def _eased(self, block: Solid) -> Shape:
        """The rectangle of a block, smaller by the fit than the slot in which it slides."""
        construction = self.layers.mechanism.construction
        fit = 0.0 if construction is None else construction.fit
        corners = block.shape.pieces[0].corners
        if not fit or len(corners) != 4:
            return block.shape
        centre, side = corners.mean(), corners[1] - corners[0]
        local = (corners - centre) * (abs(side) / side)
        local -= 0.5 * fit * (np.sign(local.real) + 1j * np.sign(local.imag))
        return polygon(centre + local * (side / abs(side)))

    def _block(self, block: Solid) -> tuple[float, float]:
        """Between which heights a block is: through its guide and up, or down, to the plate of its link."""
        guide, own = (self.layers.height[name] for name in (block.plates[0], block.plates[-1]))
        if guide == own:
            return guide
        return (guide[0], own[0]) if guide < own else (own[1], guide[1])

    def _through(self, block: Solid, height: tuple[float, float]) -> tuple[Hole, ...]:
        """The holes of a block for pins of its link that go through it as well; they turn in it."""
        construction = self.layers.mechanism.construction
        fit = 0.0 if construction is None else construction.fit
        found = []
        for pin in self.layers.solids.by_name.values():
            if (
                pin.sort == "pin"
                and (min(pin.name, block.name), max(pin.name, block.name)) in self.layers.solids.joined
            ):
                centre = self.pose.links[block.carrier].local(self.pose.axis(pin))
                low, high = self.layers.z(pin.name)
                if contains(block.shape, np.array([centre]))[0] and low < height[1] and height[0] < high:
                    found.append(Hole(pin.name, centre, pin_radius(pin) + 0.5 * fit, False))
        return tuple(found)
