"""What is turned: pins with their heads, posts, and the spacers and washers that keep plates on a pin apart."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import pairwise

from linkwright.core.quantity import shown
from linkwright.fabrication.holes import Assembly, axis, fixed_plates, hubs_around, pin_radius
from linkwright.fabrication.part import Part, Place, Sort
from linkwright.fabrication.room import Room
from linkwright.layering.arrangement import Layers
from linkwright.shapes.shape import disc
from linkwright.solids.solid import Solid
from linkwright.words import Message, _

_SHOULDER = _(
    "There is no room for a spacer of {length} on {pin}: turn it with a shoulder there, or take retaining rings.",
    code="cut.shoulder",
)

#: Radius of washers and spacers as a share of their pin's where it has no head.
RING = 1.6
#: The thinnest wall of a spacer, as a share of its pin's radius; where there is less room the pin has a shoulder.
THINNEST = 0.15
#: Lengths nearer to each other than this are one, m.
SAME = 1e-9


@dataclass(frozen=True)
class Turned:
    """Makes the turned parts of a machine in layers; ``material``: its name and density (kg/m³)."""

    layers: Layers
    pose: Assembly
    room: Room
    material: str
    density: float
    fit: float
    washer: float
    notes: dict[Message, None] = field(default_factory=dict)

    def pins(self) -> Iterator[Part]:
        """A part for every pin and post: between the lower face of its lowest plate and the upper face of its highest
        one, and the heads outside."""
        for pin in self._pins():
            low, high = self._reach(pin)
            radius, heads, bore = pin_radius(pin), self._heads(pin, high), self._bore(pin)
            volume = math.pi * ((radius**2 - bore**2) * (high - low) + pin.head**2 * sum(heads))
            yield Part(
                pin.name,
                "pin",
                replace(disc(0j, radius), holes=((0j, bore),) if bore else ()),
                high - low,
                self.material,
                self.density * volume,
                min(self.layers.layer[plate] for plate in pin.plates),
                (Place(pin.carrier, axis(pin), low, pin.name),),
                diameter=2.0 * radius,
                bore=2.0 * bore,
                head=2.0 * pin.head if any(heads) else 0.0,
                heads=heads,
            )

    def _bore(self, post: Solid) -> float:
        """The radius of the bore of a post that is the hub around a pin, m; 0 of any other."""
        if post.sort == "pin":
            return 0.0
        for pin in self._pins():
            if pin.sort == "pin" and post in hubs_around(self.layers, self.pose, pin):
                fixed = bool(fixed_plates(self.layers, pin) & {*post.plates})
                return pin_radius(pin) + (0.0 if fixed else 0.5 * self.fit)
        return 0.0

    def rings(self) -> Iterator[Part]:
        """Spacers and washers, equal ones as one part with several places."""
        found: dict[tuple[Sort, int, int, int], list[tuple[Place, int]]] = {}
        for pin in self._pins():
            if pin.sort == "pin":
                for sort, length, place, layers in self._gaps(pin):
                    outer = self._outer(pin, *layers)
                    if outer - pin_radius(pin) - 0.5 * self.fit < THINNEST * pin_radius(pin):
                        self.notes[_SHOULDER.format(pin=pin.name, length=shown(length, "length"))] = None
                    else:
                        key = sort, _steps(length), _steps(outer), _steps(pin_radius(pin))
                        found.setdefault(key, []).append((place, layers[0]))
        sorts: tuple[Sort, ...] = ("spacer", "washer")
        for sort in sorts:
            rows = sorted(key for key in found if key[0] == sort)
            for number, key in enumerate(rows, 1):
                name = f"{sort} {number}" if len(rows) > 1 else sort
                yield self._ring(name, sort, key[1:], found[key])

    def _ring(self, name: str, sort: Sort, sizes: tuple[int, int, int], places: list[tuple[Place, int]]) -> Part:
        """A spacer or washer: length, outer radius and radius of its pin in steps of SAME."""
        length, outer, pin = (each * SAME for each in sizes)
        inner = pin + 0.5 * self.fit
        shape = replace(disc(0j, outer), holes=((0j, inner),))
        mass = self.density * math.pi * (outer**2 - inner**2) * length
        return Part(
            name,
            sort,
            shape,
            length,
            self.material,
            mass,
            min(layer for _place, layer in places),
            tuple(place for place, _layer in places),
            diameter=2.0 * outer,
            bore=2.0 * inner,
        )

    def _pins(self) -> list[Solid]:
        return [each for each in self.layers.solids.by_name.values() if each.sort in ("pin", "post")]

    def _reach(self, pin: Solid) -> tuple[float, float]:
        """Height of the lowest and of the highest face of a pin's plates, m."""
        heights = [self.layers.height[plate] for plate in pin.plates]
        return min(low for low, _high in heights), max(high for _low, high in heights)

    def _heads(self, pin: Solid, top: float) -> tuple[float, float]:
        """Heights of the lower and of the upper head: as high as the pin's radius, within the layer next to its
        plates; none below the base and above the cover."""
        if pin.head <= 0.0:
            return 0.0, 0.0
        layer, height = self.layers.layer, self.layers.height
        last, ends = max(layer[plate] for plate in pin.plates), (0, max(layer.values()))
        above = [height[name][0] for name, each in layer.items() if each > last + 1]
        thinnest = min(high - low for low, high in map(height.__getitem__, pin.plates))
        size = min(pin_radius(pin), thinnest, min(above, default=math.inf) - top)
        frame = [layer[plate] for plate in pin.plates if self.layers.solids.by_name[plate].sort == "frame"]
        return (0.0 if ends[0] in frame else size), (0.0 if ends[1] in frame else size)

    def _gaps(self, pin: Solid) -> Iterator[tuple[Sort, float, Place, tuple[int, int]]]:
        """What lies between the plates on a pin: sort, length, place, and the layers below and above."""
        ordered = sorted(pin.plates, key=lambda plate: self.layers.height[plate])
        hubs = [self._reach(each) for each in hubs_around(self.layers, self.pose, pin)]
        top = self.layers.height[ordered[0]][1]
        for lower, upper in pairwise(ordered):
            top = max(top, self.layers.height[lower][1])
            length = self.layers.height[upper][0] - top
            within_hub = any(low < top + 0.5 * length < high for low, high in hubs)
            if length > SAME and not within_hub:
                sort: Sort = "washer" if abs(length - self.washer) <= SAME else "spacer"
                layers = self.layers.layer[lower], self.layers.layer[upper]
                yield sort, length, Place(pin.carrier, axis(pin), top, pin.name), layers

    def _outer(self, pin: Solid, below: int, above: int) -> float:
        """The outer radius of a spacer or washer between two layers, m: that of a head, or as much as there is room
        for in the layers between."""
        wanted = pin.head or RING * pin_radius(pin)
        return min(wanted, self.room.radius(pin, below + 1, above - 1)) if above > below + 1 else wanted


def _steps(length: float) -> int:
    return round(length / SAME)
