"""What layers of plates must keep: bodies that share no layer, plates that are level, layers that are fixed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

from linkwright.collisions.gaps import Gap

#: What of a body must not be where another one is: the body itself, or the heads at its ends.
Part = Literal["body", "heads"]


@dataclass(frozen=True)
class Apart:
    """Two bodies (by name) that come nearer to one another than the clearance: ``parts`` of theirs have no layer in
    common. ``gap``: the smallest one between these parts, None where that does not matter."""

    first: str
    second: str
    parts: tuple[Part, Part] = ("body", "body")
    gap: Gap | None = None


@dataclass(frozen=True)
class Level:
    """Two plates (by name) in one layer."""

    first: str
    second: str


@dataclass(frozen=True)
class Fixed:
    """A plate (by name) in a layer that is fixed; None: in all layers, as a wall."""

    plate: str
    layer: int | None


Demand = Apart | Level | Fixed


@dataclass(frozen=True)
class Problem:
    """Plates to put into layers.

    ``bodies``: the plates from the lowest to the highest of which each body reaches, by the body's name; a plate is
    the body that has itself alone. ``base``: the plate in layer 0, ``cover``: that in the highest layer; all others
    are above the one, unless fixed in layer 0, and below the other. Empty where there is none. Heads are in the layer
    below a body's lowest plate and in that above its highest, but not below the base nor above the cover.
    """

    bodies: Mapping[str, tuple[str, ...]]
    demands: tuple[Demand, ...]
    base: str = ""
    cover: str = ""

    @cached_property
    def plates(self) -> tuple[str, ...]:
        """All plates in the order of the bodies, base and cover among them."""
        found = {plate: None for plates in self.bodies.values() for plate in plates}
        found |= dict.fromkeys(each for each in (self.base, self.cover) if each)
        return tuple(found)

    @cached_property
    def fixed(self) -> Mapping[str, int | None]:
        """Layers that are fixed, by plate; of those in all layers None."""
        return {each.plate: each.layer for each in self.demands if isinstance(each, Fixed)}

    @cached_property
    def walls(self) -> frozenset[str]:
        """Plates in all layers."""
        return frozenset(plate for plate, layer in self.fixed.items() if layer is None)

    @cached_property
    def apart(self) -> tuple[Apart, ...]:
        """Which bodies are to be apart."""
        return tuple(each for each in self.demands if isinstance(each, Apart))

    @cached_property
    def leader(self) -> Mapping[str, str]:
        """Of every plate that is not a wall the first one of those that are level with it; a base in all layers
        stands for its own foot in layer 0."""
        leader = {plate: plate for plate in self.plates if plate not in self.walls or plate == self.base}
        for each in self.demands:
            if isinstance(each, Level) and not {each.first, each.second} & self.walls:
                old, new = leader[each.second], leader[each.first]
                leader = {plate: new if first == old else first for plate, first in leader.items()}
        return leader

    @cached_property
    def spans(self) -> Mapping[str, tuple[str, ...]]:
        """The plates between which bodies reach, one of those that are level; none of a body in all layers, as one
        between walls alone."""
        return {name: self._span(plates) for name, plates in self.bodies.items()}

    def _span(self, plates: Iterable[str]) -> tuple[str, ...]:
        plates = tuple(plates)
        if len(plates) == 1 and plates[0] in self.walls:
            return ()
        counted = (self.leader[each] for each in plates if each in self.leader)
        return tuple(dict.fromkeys(counted))

    def among(self, names: Iterable[str]) -> Problem:
        """The same without the demands on bodies that are not among the names."""
        known = {*names}
        return self.only(
            each
            for each in self.demands
            if (each.plate in known if isinstance(each, Fixed) else {each.first, each.second} <= known)
        )

    def only(self, demands: Iterable[Demand]) -> Problem:
        """The same with some demands only, and the bodies that these are about."""
        found = tuple(demands)
        names = {name for each in found for name in names_of(each)}
        names |= {plate for name in names for plate in self.bodies.get(name, ())}
        kept = {name: plates for name, plates in self.bodies.items() if name in names}
        return replace(self, bodies=kept, demands=found)


def names_of(demand: Demand) -> tuple[str, ...]:
    """The names of the bodies that a demand is about."""
    return (demand.plate,) if isinstance(demand, Fixed) else (demand.first, demand.second)
