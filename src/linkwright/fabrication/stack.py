"""What is on every axis of a machine, and the plates between the axes: what a section through the pins shows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.fabrication.columns import Bar, Column, Development
from linkwright.fabrication.cut_parts import CutParts
from linkwright.fabrication.holes import Pose, axis, hubs_around
from linkwright.fabrication.part import Part
from linkwright.solids.solid import Solid, Solids


@dataclass(frozen=True, eq=False)
class Axis:
    """A pin or post, a block, or the middle of a plate without either: ``solid``; the ``plates`` in its section.

    ``pin``: the part that it is; ``rings``: washers and spacers on it; ``hubs``: posts around it; ``blocks`` through
    which it goes.
    """

    solid: Solid
    plates: tuple[str, ...]
    pin: Part | None = None
    rings: tuple[Part, ...] = ()
    hubs: tuple[Part, ...] = ()
    blocks: tuple[Solid, ...] = ()

    @property
    def at(self) -> complex:
        """Its place in the axes of the link that carries it, m."""
        return axis(self.solid) if self.pin is not None else self.solid.shape.bound[0]


@dataclass(frozen=True, eq=False)
class Stack:
    """The parts of a machine along its axes."""

    cut: CutParts

    @property
    def solids(self) -> Solids:
        """All that takes room."""
        return self.cut.layers.solids

    @cached_property
    def pose(self) -> Pose:
        """Where the links are, by which axes are sorted."""
        return Pose.of(self.cut.layers)

    @cached_property
    def plates(self) -> dict[str, Part]:
        """The plates by name."""
        return {part.name: part for part in self.cut.parts if part.name in self.cut.layers.height}

    @cached_property
    def axes(self) -> list[Axis]:
        """Pins, posts, blocks without pins, and the middles of all other plates, from left to right."""
        every = self.solids.by_name.values()
        round_solids = [solid for solid in every if solid.sort in ("pin", "post")]
        hubs = {pin.name: hubs_around(self.cut.layers, self.pose, pin) for pin in round_solids if pin.sort == "pin"}
        inner = {hub.name for each in hubs.values() for hub in each}
        found = [self._pinned(pin, hubs.get(pin.name, [])) for pin in round_solids if pin.name not in inner]
        pinned = {block.name for each in found for block in each.blocks}
        for solid in every:
            if solid.sort == "block" and solid.name not in pinned:
                found.append(Axis(solid, self._around(solid), blocks=(solid,)))
        held = {plate for each in found for plate in each.plates}
        found += [Axis(solid, (solid.name,)) for solid in every if solid.is_plate and solid.name not in held]
        return sorted(found, key=lambda each: self.pose.world(each.solid.carrier, each.at).real)

    def _pinned(self, pin: Solid, hubs: Sequence[Solid]) -> Axis:
        """The axis of a pin or post."""
        parts = {part.name: part for part in self.cut.parts}
        blocks = tuple(
            each for each in self.solids.by_name.values() if each.sort == "block" and self._within(pin, each)
        )
        rings = tuple(part for part in self.cut.parts if part.sort in ("spacer", "washer"))
        rings = tuple(part for part in rings if any(place.on == pin.name for place in part.places))
        plates = (*pin.plates, *(plate for each in (*hubs, *blocks) for plate in self._around(each)))
        around = tuple(parts[hub.name] for hub in hubs)
        return Axis(pin, tuple(dict.fromkeys(plates)), parts[pin.name], rings, around, blocks)

    def _within(self, pin: Solid, block: Solid) -> bool:
        """Whether a pin goes through a block."""
        pair = (min(pin.name, block.name), max(pin.name, block.name))
        if block.name in pin.plates:
            return True
        return pair in self.solids.joined and pin.carrier == block.carrier

    def _around(self, block: Solid) -> tuple[str, ...]:
        """The plates in a section through a block or hub: its own and that of its guide."""
        guides = [a if b == block.name else b for a, b in self.solids.level if block.name in (a, b)]
        return tuple(dict.fromkeys((*block.plates, *guides)))

    def height(self, plate: str) -> tuple[float, float]:
        """Lower and upper face of a plate, m."""
        return self.cut.layers.height[plate]

    def reach(self, at: Axis) -> tuple[float, float]:
        """Between which heights an axis takes room, m, with the heads of its pin."""
        ends = [height for plate in at.plates for height in self.height(plate)]
        for part in (at.pin, *at.hubs):
            if part is not None:
                ends += [part.places[0].z + each for prism in part.prisms() for each in (prism.low, prism.high)]
        return min(ends), max(ends)

    def development(self) -> Development:
        """The axes side by side."""
        columns = [Column(each.solid.name, *self.reach(each)) for each in self.axes]
        bars = []
        for name in self.plates:
            low, high = self.height(name)
            own = {k for k, each in enumerate(self.axes) if name in each.plates}
            bar = Bar(name, low, high, frozenset(own))
            if self.solids.by_name[name].sort == "frame":
                bar = Bar(name, low, high, frozenset(own | set(self._free(bar, columns))))
            bars.append(bar)
        return Development(columns, bars, tuple(range(len(columns)))).improved()

    def _free(self, frame: Bar, columns: list[Column]) -> Iterator[int]:
        """The columns that leave room for the frame."""
        return (k for k, column in enumerate(columns) if not frame.meets(column))

    def half_width(self, plate: str, on: Axis) -> float:
        """How far the material of a plate reaches around an axis, m."""
        place = on.at
        if any((min(each.name, plate), max(each.name, plate)) in self.solids.level for each in on.blocks):
            return max(map(across, on.blocks)) + 0.5 * float(np.diff(self.height(plate))[0])
        if on.solid.carrier != self.solids.by_name[plate].carrier:
            holes = [hole.centre for hole in self.plates[plate].holes if hole.pin == on.solid.name]
            if not holes:
                return 0.5 * float(np.diff(self.height(plate))[0])
            place = holes[0]
        outer = [loop for loop in self.plates[plate].loops if loop.area > 0]
        return min(edge.distance(place) for loop in outer for edge in loop.edges)


def across(block: Solid) -> float:
    """Half the width of a block across its guide, m."""
    corners = block.shape.pieces[0].corners
    return 0.5 * float(min(abs(corners[1] - corners[0]), abs(corners[2] - corners[1])))
