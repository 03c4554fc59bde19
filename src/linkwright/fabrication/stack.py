"""What is on every axis of a machine, and the plates between the axes: what a section through the pins shows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.fabrication.body import Pose
from linkwright.fabrication.columns import Bar, Column, Development
from linkwright.fabrication.cut_parts import CutParts
from linkwright.fabrication.part import Part
from linkwright.shapes.boundary import boundary
from linkwright.solids.solid import Solid, Solids


@dataclass(frozen=True, eq=False)
class Axis:
    """A pin or post with the washers and spacers on it, or a block, or the middle of a plate without either.

    ``plates``: those in its section; ``at``: its place in the axes of its ``carrier``, m.
    """

    solid: Solid
    plates: tuple[str, ...]
    pin: Part | None
    rings: tuple[Part, ...]
    blocks: tuple[Solid, ...]

    @property
    def at(self) -> complex:
        """Its place in the axes of the link that carries it, m."""
        return self.solid.shape.bound[0]


@dataclass(frozen=True, eq=False)
class Stack:
    """The parts of a machine along its axes; ``poses``: where the links are, by which axes are sorted."""

    cut: CutParts
    poses: Mapping[str, Pose]

    @property
    def solids(self) -> Solids:
        """All that takes room."""
        return self.cut.layers.solids

    @cached_property
    def plates(self) -> dict[str, Part]:
        """The plates by name."""
        return {part.name: part for part in self.cut.parts if part.name in self.cut.layers.height}

    @cached_property
    def axes(self) -> list[Axis]:
        """Pins, posts, blocks without pins, and the middles of all other plates, from left to right."""
        parts = {part.name: part for part in self.cut.parts}
        every = self.solids.by_name.values()
        found = []
        for solid in every:
            if solid.sort in ("pin", "post"):
                blocks = tuple(each for each in every if each.sort == "block" and self._within(solid, each))
                rings = tuple(part for part in parts.values() if any(place.on == solid.name for place in part.places))
                rings = tuple(part for part in rings if part.sort in ("spacer", "washer"))
                plates = (*solid.plates, *(plate for each in blocks for plate in self._around(each)))
                found.append(Axis(solid, tuple(dict.fromkeys(plates)), parts.get(solid.name), rings, blocks))
        pinned = {each.name for axis in found for each in axis.blocks}
        for solid in every:
            if solid.sort == "block" and solid.name not in pinned:
                found.append(Axis(solid, self._around(solid), None, (), (solid,)))
        held = {plate for axis in found for plate in axis.plates}
        alone = (solid for solid in every if solid.is_plate and solid.name not in held)
        found += [Axis(solid, (solid.name,), None, (), ()) for solid in alone]
        return sorted(found, key=lambda axis: self.poses[axis.solid.carrier].of(axis.at).real)

    def _within(self, pin: Solid, block: Solid) -> bool:
        """Whether a pin goes through a block."""
        pair = (min(pin.name, block.name), max(pin.name, block.name))
        if block.name in pin.plates:
            return True
        return pair in self.solids.joined and pin.carrier == block.carrier

    def _around(self, block: Solid) -> tuple[str, ...]:
        """The plates in a section through a block: its own and that of its guide."""
        guides = [a if b == block.name else b for a, b in self.solids.level if block.name in (a, b)]
        return tuple(dict.fromkeys((*block.plates, *guides)))

    def height(self, plate: str) -> tuple[float, float]:
        """Lower and upper face of a plate, m."""
        return self.cut.layers.height[plate]

    def reach(self, axis: Axis) -> tuple[float, float]:
        """Between which heights an axis takes room, m, with the heads of its pin."""
        ends = [height for plate in axis.plates for height in self.height(plate)]
        if axis.pin is not None:
            z = axis.pin.places[0].z
            ends += [z + each for prism in axis.pin.prisms() for each in (prism.low, prism.high)]
        return min(ends), max(ends)

    def development(self) -> Development:
        """The axes side by side."""
        columns = [Column(axis.solid.name, *self.reach(axis)) for axis in self.axes]
        bars = []
        for name in self.plates:
            low, high = self.height(name)
            own = {k for k, axis in enumerate(self.axes) if name in axis.plates}
            bar = Bar(name, low, high, frozenset(own))
            if self.solids.by_name[name].sort == "frame":
                bar = Bar(name, low, high, frozenset(own | set(self._free(bar, columns))))
            bars.append(bar)
        return Development(columns, bars, tuple(range(len(columns)))).improved()

    def _free(self, frame: Bar, columns: list[Column]) -> Iterator[int]:
        """The columns that leave room for the frame."""
        return (k for k, column in enumerate(columns) if not frame.meets(column))

    def half_width(self, plate: str, axis: Axis) -> float:
        """How far the material of a plate reaches around an axis, m."""
        place = axis.at
        if any((min(each.name, plate), max(each.name, plate)) in self.solids.level for each in axis.blocks):
            return max(map(across, axis.blocks)) + 0.5 * float(np.diff(self.height(plate))[0])
        if axis.solid.carrier != self.solids.by_name[plate].carrier:
            holes = [hole.centre for hole in self.plates[plate].holes if hole.pin == axis.solid.name]
            if not holes:
                return 0.5 * float(np.diff(self.height(plate))[0])
            place = holes[0]
        outer = [loop for loop in boundary(self.plates[plate].shape) if loop.area > 0]
        return min(edge.distance(place) for loop in outer for edge in loop.edges)


def across(block: Solid) -> float:
    """Half the width of a block across its guide, m."""
    corners = block.shape.pieces[0].corners
    return 0.5 * float(min(abs(corners[1] - corners[0]), abs(corners[2] - corners[1])))
