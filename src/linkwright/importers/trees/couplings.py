"""Linear couplings of joints as gear pairs, belts, and racks with pinions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from linkwright.core.data import Plain
from linkwright.importers.layout import Wheels, free_name
from linkwright.importers.model_text import DEGREE, Writer, shortest
from linkwright.importers.trees.placed import Placed
from linkwright.importers.trees.points import SAME, Point
from linkwright.importers.trees.tree import Coupling
from linkwright.words import _

#: Factors below this share of the largest are none.
NEGLIGIBLE = 1e-9
#: Ratios of wheels that turn the same way, nearer to 1 than this factor, are those of belts rather than of a wheel in
#: a ring; the larger pulley's share of the distance between the centres.
LIKE_BELTS, PULLEY = 2.0, 0.25


@dataclass
class Row:
    """A coupling by groups: Σ turns · rotation + Σ slides · displacement = const; ``off``: by what it fails at the
    start."""

    coupling: Coupling
    turns: dict[str, float]
    slides: dict[str, float]
    off: float


@dataclass
class Rack:
    """A rack and its pinion by their groups; ``radius`` with the sign of the side on which the centre lies."""

    row: Row
    pinion: str
    rack: str
    through: Point
    centre: Point
    radius: float
    #: What the row misses at the start as an angle of the pinion, rad.
    off: float


@dataclass
class Pair:
    """Two wheels by their groups on a carrier, with what they miss at the start as an angle of the second, rad."""

    row: Row
    first: str
    second: str
    carrier: str
    ratio: float
    distance: float
    off: float


class Rows:
    """Finds the elements of all couplings: first the points they need, then the joints."""

    def __init__(self, made: Placed) -> None:
        self.made = made
        self.found: list[Rack | Pair] = []

    def add_points(self) -> None:
        """Looks for the elements; racks need a point on their pitch lines."""
        for coupling in self.made.tree.couplings:
            row = self._row(coupling)
            if not row.turns and not row.slides:
                continue
            found = self._racked(row) if row.slides else self._paired(row)
            if found is None:
                self._refuse(coupling)
            else:
                self.found.append(found)

    def add_wheels(self) -> None:
        """The joints, once bodies and points have names."""
        writer = Writer(self.made.layout)
        for each in self.found:
            made = self._rack(each, writer) if isinstance(each, Rack) else self._pair(each, writer)
            self.made.layout.wheels.append(made)

    def _refuse(self, coupling: Coupling) -> None:
        message = _("the coupling of {joints} has no counterpart and is left out", joints=tuple(coupling.factors))
        remedy = _("a pair of wheels needs a common carrier with their pins at a distance; add what is between them")
        self.made.remarks.remark("warning", message, remedy, "import.coupling", line=coupling.line, key=coupling.name)

    def _row(self, coupling: Coupling) -> Row:
        turns: dict[str, float] = {}
        slides: dict[str, float] = {}
        off = -coupling.rest
        for name, factor in coupling.factors.items():
            joint = self.made.tree.joints[name]
            parent, child = self.made.group(joint.parent), self.made.group(joint.child)
            off += factor * joint.moved
            if parent == child:
                continue
            if joint.turns is None:
                slides[name] = slides.get(name, 0.0) + factor
                continue
            for group, sign in ((child, joint.sense), (parent, -joint.sense)):
                turns[group] = turns.get(group, 0.0) + sign * factor
        largest = max([abs(each) for each in (*turns.values(), *slides.values())], default=0.0)
        turns = {key: each for key, each in turns.items() if abs(each) > NEGLIGIBLE * largest}
        slides = {key: each for key, each in slides.items() if abs(each) > NEGLIGIBLE * largest}
        return Row(coupling, turns, slides, off)

    # -- wheels

    def _paired(self, row: Row) -> Pair | None:
        """Two wheels on a carrier that is a third of the row, or on any where these two turn alike."""
        groups = list(row.turns)
        if len(groups) == 3:
            choices = [(each, *(other for other in groups if other != each)) for each in groups]
        elif len(groups) == 2:
            choices = [(each, *groups) for each in self.made.bodies if each not in groups]
        else:
            return None
        last = self.made.group(self.made.tree.joints[next(iter(row.coupling.factors))].child)
        for carrier, first, second in choices:
            if first == last:
                first, second = second, first
            for distance in self._distances(carrier, first, second):
                ratio = -row.turns[first] / row.turns[second]
                return Pair(row, first, second, carrier, ratio, distance, row.off / row.turns[second])
        return None

    def _distances(self, carrier: str, first: str, second: str) -> Iterator[float]:
        """Distances of pins of two wheels on a carrier, apart."""
        for one in self._pins(first, carrier):
            for other in self._pins(second, carrier):
                distance = abs(one.places[carrier] - other.places[carrier])
                if distance > self.made.points.tolerance:
                    yield distance

    def _pins(self, group: str, carrier: str) -> list[Point]:
        return [each for each in self.made.points.of(group) if each.pinned and carrier in each.places]

    def _pair(self, pair: Pair, writer: Writer) -> Wheels:
        a, b, carrier = (self.made.bodies[each] for each in (pair.first, pair.second, pair.carrier))
        values: Plain = {"links": [a, b]}
        kind = "gear"
        if 1 / LIKE_BELTS < pair.ratio < LIKE_BELTS:
            kind, largest = "belt", PULLEY * pair.distance
            radii = [largest * min(1.0, pair.ratio), largest * min(1.0, 1 / pair.ratio)]
            values["radii"] = [f"{each / writer.factor!r} {self.made.layout.unit}" for each in radii]
        else:
            values["ratio"] = float(shortest(pair.ratio, 1e-15 * abs(pair.ratio)))
        values["carrier"] = carrier
        turned = (
            (writer.axis(b) - writer.axis(carrier)) - pair.ratio * (writer.axis(a) - writer.axis(carrier)) - pair.off
        )
        if pair.off or not all(self._directed(each) for each in (a, b, carrier)):
            values["phase"] = self._angle(turned)
        return Wheels(self._name(pair.row), kind, values)

    # -- racks

    def _racked(self, row: Row) -> Rack | None:
        """A pinion that is pinned on one end of the row's guides, and its rack, the other end."""
        for rack, carrier in self._ends(row):
            found = self._way(row, rack, carrier)
            if found is None:
                continue
            direction, lever = found
            pinions = [each for each in row.turns if each not in self._slid(row)]
            for centre in self._pins(pinions[0], carrier) if len(pinions) == 1 else ():
                radius = row.turns[pinions[0]] / lever
                place = self.made.start(carrier, centre.places[carrier]) - radius * 1j * direction
                through = self._pitch_point(row, rack, place, pinions[0])
                off = row.off / row.turns[pinions[0]]
                return Rack(row, pinions[0], rack, through, centre, radius, off)
        return None

    def _slid(self, row: Row) -> list[str]:
        """The groups that the row's slides join, each as often as they do."""
        joints = [self.made.tree.joints[each] for each in row.slides]
        return [self.made.group(part) for joint in joints for part in (joint.parent, joint.child)]

    def _ends(self, row: Row) -> list[tuple[str, str]]:
        """The two groups at the ends of the row's slides, which hang together, both ways round."""
        groups = self._slid(row)
        ends = [each for each in groups if groups.count(each) == 1]
        return [(ends[0], ends[1]), (ends[1], ends[0])] if len(ends) == 2 else []

    def _way(self, row: Row, rack: str, carrier: str) -> tuple[complex, float] | None:
        """The direction of the slides, and the row's factor of the carrier's displacement against the rack."""
        at, left, direction = rack, dict(row.slides), 0j
        levers: list[float] = []
        while at != carrier:
            for name, factor in left.items():
                joint = self.made.tree.joints[name]
                guide, block = self.made.group(joint.parent), self.made.group(joint.child)
                if at not in (guide, block):
                    continue
                inside = self.made.groups.inside[joint.parent].turn
                way = self.made.groups.start[guide].turn * inside * (joint.slides or 1)
                direction = direction or way
                dot = (way * direction.conjugate()).real
                levers.append(factor * dot * (1.0 if at == guide else -1.0))
                at = block if at == guide else guide
                del left[name]
                break
            else:
                return None
        alike = max(levers) - min(levers) <= SAME * max(abs(each) for each in levers)
        return (direction, levers[0]) if alike and not left else None

    def _pitch_point(self, row: Row, rack: str, place: complex, pinion: str) -> Point:
        """A point of the rack on its pitch line, at the pinion."""
        name, inside = f"{row.coupling.name}_pitch", self.made.groups.start[rack].back(place)
        found = self.made.points.mark(name, rack, inside)
        return self.made.points.alone(name, rack, inside) if pinion in found.places else found

    def _rack(self, found: Rack, writer: Writer) -> Wheels:
        pinion, rack = self.made.bodies[found.pinion], self.made.bodies[found.rack]
        values: Plain = {
            "pinion": pinion,
            "rack": rack,
            "through": self.made.named[id(found.through)],
            "radius": writer.length(abs(found.radius)),
        }
        if found.off or not (self._directed(pinion) and self._directed(rack)):
            values["phase"] = self._angle(writer.axis(pinion) - writer.axis(rack) - found.off)
        return Wheels(self._name(found.row), "rack", values)

    def _directed(self, body: str) -> bool:
        """Whether the drawing shows how a body is turned."""
        return body == "frame" or self.made.layout.bodies[body].spread

    def _name(self, row: Row) -> str:
        made = self.made.layout
        taken = {*(each.name for each in made.slides), *(each.name for each in made.wheels), *made.bodies}
        return free_name(row.coupling.name, taken | {*self.made.named.values()}, "coupling")

    @staticmethod
    def _angle(radians: float) -> str:
        return f"{shortest(radians / DEGREE, SAME * 1e-5)} deg"
