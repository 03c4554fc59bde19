"""Closed loops of lines and arcs that begin where others end."""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence

from linkwright.shapes.loop import Loop, circle
from linkwright.shapes.segments import Segment

#: Largest angle (rad) of an arc of an outline.
LARGEST_ARC = 1.5 * math.pi
#: What leaves each place: where to, and along what.
Arrows = dict[int, list[tuple[int, Segment]]]


def closed_loops(segments: Sequence[Segment], near: float, tails: float) -> list[Loop] | None:
    """Loops of segments whose ends are one where they lie within ``near`` (m) of each other: those around material
    first, each kind in order of size; None where segments do not close. Ends no longer than ``tails`` (m) that lead
    nowhere are left out.

    Where loops touch themselves they are parted, so that none passes a place twice.
    """
    spots = Spots(near)
    arrows: Arrows = defaultdict(list)
    for each in segments:
        start, end = spots.number(each.start), spots.number(each.end)
        if start == end and each.length <= 4.0 * near:
            continue
        if any(known == end and abs(other.at(0.5) - each.at(0.5)) <= near for known, other in arrows[start]):
            continue
        arrows[start].append((end, each))
    _prune(arrows, tails)
    if not _balanced(arrows):
        return None
    rings = [_merged(ring, near) for ring in _rings(arrows)]
    loops = [_loop(ring) for ring in rings]
    loops = [loop for loop in loops if abs(loop.area) > near * loop.length]
    return sorted(loops, key=lambda loop: (loop.area < 0.0, -abs(loop.area)))


def _balanced(arrows: Arrows) -> bool:
    """Whether as many arrows leave every place as arrive there."""
    leave = Counter({start: len(leaving) for start, leaving in arrows.items() if leaving})
    return leave == Counter(end for leaving in arrows.values() for end, _segment in leaving)


def _prune(arrows: Arrows, longest: float) -> None:
    """Takes out short ends that lead nowhere: what lines that cross at a small angle leave beyond each other is
    nearer to the outline than its two sides can be told apart."""
    while True:
        arrived = {end for leaving in arrows.values() for end, _segment in leaving}
        tails = [
            (start, each)
            for start, leaving in arrows.items()
            for each in leaving
            if each[1].length <= longest and (start not in arrived or not arrows.get(each[0]))
        ]
        if not tails:
            return
        for start, each in tails:
            arrows[start].remove(each)


class Spots:
    """Numbers of places: one for all within a distance."""

    def __init__(self, near: float) -> None:
        self.near = near
        self.cells: dict[tuple[int, int], list[tuple[complex, int]]] = defaultdict(list)
        self.count = 0

    def number(self, place: complex) -> int:
        """The number of a place, a new one where no known place is near."""
        x, y = math.floor(place.real / self.near), math.floor(place.imag / self.near)
        for cell in ((x + i, y + k) for i in (0, -1, 1) for k in (0, -1, 1)):
            for known, number in self.cells.get(cell, ()):
                if abs(known - place) <= self.near:
                    return number
        self.cells[x, y].append((place, self.count))
        self.count += 1
        return self.count - 1


def _rings(arrows: Arrows) -> Iterator[list[Segment]]:
    """Simple rings: each goes on to the left at a place where several leave, and is parted where it comes back."""
    for first in list(arrows):
        while arrows[first]:
            path: list[tuple[int, Segment]] = []
            place = first
            passed = {first: 0}
            while True:
                heading = path[-1][1].edge.heading(1.0) if path else 0.0
                leaving = arrows[place]
                nxt = max(leaving, key=lambda each: _turn(heading, each[1]))
                leaving.remove(nxt)
                path.append((place, nxt[1]))
                place = nxt[0]
                if place in passed:
                    begin = passed[place]
                    yield [segment for _place, segment in path[begin:]]
                    for each, _segment in path[begin + 1 :]:
                        passed.pop(each, None)
                    del path[begin:]
                    if not path:
                        break
                else:
                    passed[place] = len(path)


def _turn(heading: float, segment: Segment) -> float:
    """By how much a segment turns left from a heading, -π to π; the way back is the last choice."""
    turn = (segment.edge.heading(0.0) - heading + math.pi) % (2.0 * math.pi) - math.pi
    return -math.pi if turn > math.pi - 1e-6 else turn


def _merged(ring: list[Segment], near: float) -> list[Segment]:
    """The ring with one segment for those that go on along one line or circle."""
    found: list[Segment] = []
    for each in ring:
        together = _joined(found[-1], each, near) if found else None
        if together:
            found[-1] = together
        else:
            found.append(each)
    if len(found) > 2:
        together = _joined(found[-1], found[0], near)
        if together:
            found = [together, *found[1:-1]]
    return found


def _joined(one: Segment, other: Segment, near: float) -> Segment | None:
    """One segment for two that follow each other on one line or circle."""
    if not one.sweep and not other.sweep:
        chord = other.end - one.start
        off = abs(((one.end - one.start) * chord.conjugate()).imag)
        forward = ((one.end - one.start) * (other.end - other.start).conjugate()).real > 0.0
        return Segment(one.start, other.end) if forward and off <= 0.1 * near * abs(chord) else None
    if not one.sweep * other.sweep > 0.0 or abs(one.sweep + other.sweep) > LARGEST_ARC:
        return None
    if abs(one.centre - other.centre) + abs(one.radius - other.radius) > near:
        return None
    return Segment(one.start, other.end, one.centre, one.sweep + other.sweep)


def _loop(ring: list[Segment]) -> Loop:
    """A ring as a loop in which every edge begins exactly where the one before it ends; a whole circle as two half
    arcs."""
    if len(ring) < 4 and all(each.sweep for each in ring):
        first, sweep = ring[0], sum(each.sweep for each in ring)
        if all(abs(each.centre - first.centre) < 1e-6 * first.radius for each in ring) and abs(sweep) > 6.28:
            return circle(first.centre, first.radius, clockwise=sweep < 0.0)
    ends = [each.start for each in ring[1:]] + [ring[0].start]
    return Loop(
        tuple(Segment(each.start, end, each.centre, each.sweep).edge for each, end in zip(ring, ends, strict=True))
    )
