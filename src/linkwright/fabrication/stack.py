"""What is on every axis of a machine, and the plates between the axes: what a section through the pins shows."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.fabrication.columns import Bar, Column, Development
from linkwright.fabrication.cut_parts import CutParts
from linkwright.fabrication.holes import Assembly, axis, hubs_around
from linkwright.fabrication.part import Part
from linkwright.solids.solid import Solid, Solids


@dataclass(frozen=True, eq=False)
class Axis:
    """A pin or post, or the middle of a plate without either: ``solid``; the ``plates`` in its section.

    ``pin``: the part that it is; ``rings``: washers and spacers on it; ``hubs``: posts around it.
    """

    solid: Solid
    plates: tuple[str, ...]
    pin: Part | None = None
    rings: tuple[Part, ...] = ()
    hubs: tuple[Part, ...] = ()

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
    def pose(self) -> Assembly:
        """Where the links are, by which axes are sorted."""
        return Assembly.of(self.cut.layers)

    @cached_property
    def plates(self) -> dict[str, Part]:
        """The plates by name."""
        return {part.name: part for part in self.cut.parts if part.name in self.cut.layers.height}

    @cached_property
    def axes(self) -> list[Axis]:
        """Pins, posts, and the middles of all other plates, from left to right."""
        every = self.solids.by_name.values()
        round_solids = [solid for solid in every if solid.sort in ("pin", "post")]
        hubs = {pin.name: hubs_around(self.cut.layers, self.pose, pin) for pin in round_solids if pin.sort == "pin"}
        inner = {hub.name for each in hubs.values() for hub in each}
        found = [self._pinned(pin, hubs.get(pin.name, [])) for pin in round_solids if pin.name not in inner]
        held = {plate for each in found for plate in each.plates}
        alone = (solid for solid in every if solid.is_plate and solid.name not in held)
        found += [Axis(solid, self._with_guides([solid.name])) for solid in alone]
        return sorted(found, key=lambda each: self.pose.links[each.solid.carrier].of(each.at).real)

    def _pinned(self, pin: Solid, hubs: Sequence[Solid]) -> Axis:
        """The axis of a pin or post."""
        parts = {part.name: part for part in self.cut.parts}
        rings = tuple(part for part in self.cut.parts if part.sort in ("spacer", "washer"))
        rings = tuple(part for part in rings if any(place.on == pin.name for place in part.places))
        plates = self._with_guides([*pin.plates, *(plate for hub in hubs for plate in hub.plates)])
        return Axis(pin, plates, parts[pin.name], rings, tuple(parts[hub.name] for hub in hubs))

    def _with_guides(self, plates: Iterable[str]) -> tuple[str, ...]:
        """Plates, and those in which the blocks among them slide."""
        found = dict.fromkeys(plates)
        for one, other in self.solids.level:
            for block, guide in ((one, other), (other, one)):
                if block in found and self.slides_in(block, guide):
                    found[guide] = None
        return tuple(found)

    def slides_in(self, block: str, guide: str) -> bool:
        """Whether a plate is a block that slides in another plate."""
        level = (block, guide) in self.solids.level or (guide, block) in self.solids.level
        sorts = [self.solids.by_name[each].sort for each in (block, guide)]
        return level and sorts[0] == "block" and sorts[1] != "block"

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
        if on.solid.carrier != self.solids.by_name[plate].carrier:
            holes = [hole.centre for hole in self.plates[plate].holes if hole.pin == on.solid.name]
            if not holes:
                return 0.5 * float(np.diff(self.height(plate))[0])
            place = holes[0]
        outer = [loop for loop in self.plates[plate].loops if loop.area > 0]
        return min(edge.distance(place) for loop in outer for edge in loop.edges)
