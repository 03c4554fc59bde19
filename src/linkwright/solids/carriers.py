"""Which links move as one, and where their points are on the one that carries them."""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from linkwright.joints.lower_pair import RigidJoint
from linkwright.mechanism.mechanism import Mechanism


@dataclass(frozen=True)
class Place:
    """Where a link is on its carrier: ``origin`` (m) and ``turn`` (unit complex number) of its axes there."""

    carrier: str
    origin: complex = 0j
    turn: complex = 1 + 0j

    def of(self, local: complex) -> complex:
        """A point of the link in the carrier's axes, m."""
        return self.origin + self.turn * local


@dataclass(frozen=True)
class Carriers:
    """Links that are welded to each other, each group carried by its first link, that of the frame by the frame."""

    mechanism: Mechanism

    @cached_property
    def places(self) -> Mapping[str, Place]:
        """Where every link is."""
        found: dict[str, Place] = {}
        for first in ("frame", *self.mechanism.links):
            if first not in found:
                found[first] = Place(first)
                self._spread(first, found)
        return found

    def _spread(self, first: str, found: dict[str, Place]) -> None:
        waiting = [first]
        for link in waiting:
            for weld in self.mechanism.welds.values():
                if link in weld.links:
                    (other,) = set(weld.links) - {link}
                    if other not in found:
                        found[other] = self._welded(weld, link, other, found[link])
                        waiting.append(other)

    def _welded(self, weld: RigidJoint, link: str, other: str, place: Place) -> Place:
        angle = weld.angle if other == weld.links[1] else -weld.angle
        turn = place.turn * cmath.exp(1j * angle)
        return Place(place.carrier, place.of(self._local(link, weld.at)) - turn * self._local(other, weld.at), turn)

    def _local(self, link: str, point: str) -> complex:
        return complex(*self.mechanism.link(link).points[point])

    def carrier(self, link: str) -> str:
        """The link that carries a link."""
        return self.places[link].carrier

    def place(self, link: str, point: str) -> complex:
        """A point of a link in the axes of its carrier, m."""
        return self.places[link].of(self._local(link, point))

    def groups(self) -> Iterator[tuple[str, tuple[str, ...]]]:
        """Carriers with the links of each, the frame first."""
        for carrier in dict.fromkeys(each.carrier for each in self.places.values()):
            yield carrier, tuple(link for link, each in self.places.items() if each.carrier == carrier)
