"""Points of rigid groups: what coincides on a body is one, what is pinned has one name."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from linkwright.importers.layout import free_name

#: Places of a body within this share of the machine's size are one.
SAME = 1e-9


@dataclass
class Point:
    """A point with its place on each group that has it; ``pinned``: it is a joint of at least two groups."""

    wanted: str
    places: dict[str, complex] = field(default_factory=dict)
    pinned: bool = False


class Points:
    """All points; ``size`` (m) of the machine says what coincides."""

    def __init__(self, size: float) -> None:
        self.tolerance = SAME * size
        self.all: list[Point] = []

    def at(self, group: str, place: complex) -> Point | None:
        """The point of a group at a place."""
        near = (each for each in self.all if group in each.places)
        return next((each for each in near if abs(each.places[group] - place) <= self.tolerance), None)

    def mark(self, name: str, group: str, place: complex) -> Point:
        """The point of a group at a place, a new one where there is none."""
        found = self.at(group, place)
        if found is None:
            found = Point(name, {group: place})
            self.all.append(found)
        return found

    def alone(self, name: str, group: str, place: complex) -> Point:
        """A new point of one group, even where it has another there."""
        found = Point(name, {group: place})
        self.all.append(found)
        return found

    def pin(self, name: str, first: tuple[str, complex], second: tuple[str, complex]) -> Point:
        """A pin of two groups; a pin that one of them has there already takes the other in."""
        one, other = self.at(*first), self.at(*second)
        if one is not None and other is not None and one is not other and not one.places.keys() & other.places.keys():
            one.places |= other.places
            one.wanted = one.wanted if one.pinned or not other.pinned else other.wanted
            self.all.remove(other)
            one.pinned = True
            return one
        for found, (group, place) in ((one, second), (other, first)):
            if found is not None and group not in found.places:
                found.places[group] = place
                found.wanted = found.wanted if found.pinned else name
                found.pinned = True
                return found
        if one is not None and one is other:
            return one
        found = Point(name, dict((first, second)), pinned=True)
        self.all.append(found)
        return found

    def of(self, group: str) -> Iterable[Point]:
        """The points of a group."""
        return (each for each in self.all if group in each.places)

    def names(self) -> dict[int, str]:
        """A name for each point by its id; pins choose first."""
        taken: set[str] = set()
        found = {}
        for point in sorted(self.all, key=lambda each: not each.pinned):
            found[id(point)] = free_name(point.wanted, taken)
            taken.add(found[id(point)])
        return found
