"""Plates to cut: links, wheels with their teeth, cams, guides, the frame; and blocks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from linkwright.fabrication.holes import Pose, check_holes, holes_of
from linkwright.fabrication.mounting import mounting_holes
from linkwright.fabrication.part import Hole, Part, Place
from linkwright.fabrication.wheel_plates import WheelPlates
from linkwright.layering.arrangement import Layers
from linkwright.mechanism.link_shape import material_of
from linkwright.shapes.shape import Shape
from linkwright.solids.solid import Solid

#: How far from its centre a pin's head reaches at most, in radii of the pin.
HEADS = 1.6


@dataclass
class Plates:
    """Makes the plates of a machine in layers."""

    layers: Layers
    pose: Pose

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
            shape = self.wheels.shape(each)
            yield self._part(each, shape, self._holes(each, shape), height[each.name])
        for each in solids:
            if each.sort == "block" and len(each.plates) > 1:
                yield self._part(each, each.shape, (), self._block(each))

    def _part(self, solid: Solid, shape: Shape, holes: tuple[Hole, ...], height: tuple[float, float]) -> Part:
        low, high = height
        bored = Shape(shape.pieces, tuple((each.centre, each.radius) for each in holes))
        material = material_of(self.layers.mechanism, solid.carrier)
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

    def _block(self, block: Solid) -> tuple[float, float]:
        """Between which heights a block is: through its guide and up, or down, to the plate of its link."""
        guide, own = (self.layers.height[name] for name in (block.plates[0], block.plates[-1]))
        return (guide[0], own[0]) if guide < own else (own[1], guide[1])
