"""Names on plates: the plate's own, and at each hole that of its pin, where there is room."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Complexes
from linkwright.fabrication.part import Hole, Part
from linkwright.pictures.svg import width
from linkwright.shapes.distance import contains

#: Heights of capital letters that are tried, as shares of the plate's smallest hole or width; the smallest one that a
#: cutter can engrave, m.
SIZES, SMALLEST = (0.8, 0.6, 0.45, 0.3), 0.8e-3
#: Room around a text as a share of its height.
ROOM = 0.35
#: Directions around a hole in which its name is tried.
WAYS = 16
#: Height of capital letters in sizes of a font.
CAPITAL = 0.72


@dataclass(frozen=True)
class Engraving:
    """A line of text around its middle ``at`` (m), its capitals ``height`` high (m), turned by ``turn`` (rad)."""

    text: str
    at: complex
    height: float
    turn: float = 0.0

    @property
    def width(self) -> float:
        """How wide it is, m, estimated a little too large."""
        return width(self.text, self.height / CAPITAL)

    @property
    def box(self) -> Complexes:
        """Places on the edge of its box with some room around, (16,) m."""
        x, y = 0.5 * self.width + ROOM * self.height, (0.5 + ROOM) * self.height
        share = np.linspace(-1.0, 1.0, 5)
        sides = [complex(x * s, sign * y) for s in share for sign in (-1.0, 1.0)]
        ends = [complex(sign * x, y * s) for s in share[1:-1] for sign in (-1.0, 1.0)]
        return np.asarray(self.at + cmath.exp(1j * self.turn) * np.array([*sides, *ends]))


@dataclass(frozen=True)
class _Plate:
    """A plate with its holes, and the names that it has already."""

    part: Part
    found: list[Engraving]

    def has_room(self, text: Engraving) -> bool:
        """Whether a text lies on the plate, off all holes and other texts."""
        box = text.box
        if not contains(self.part.shape, np.append(box, text.at)).all():
            return False
        reach = 0.5 * abs(complex(text.width, text.height))
        for centre, radius in self.part.shape.holes:
            if abs(centre - text.at) < radius + reach and _nearest(text, centre) < radius:
                return False
        return all(_apart(text, other) for other in self.found)


def engravings(part: Part) -> tuple[Engraving, ...]:
    """The names on a plate: beside every hole the pin's, or within the hole where there is no room, and the plate's
    own where there is room for it."""
    plate = _Plate(part, [])
    for hole in part.holes:
        if not hole.pin:
            continue
        size = 2.0 * hole.radius
        places = (
            Engraving(_short(hole.pin), hole.centre + way * (hole.radius + reach), height, turn)
            for height in _heights(size)
            for way, turn in _around(part, hole.centre)
            for reach in [_reach(_short(hole.pin), height, way, turn)]
        )
        places = (each for each in places if _is_nearest(part, hole, each))
        if not _put(plate, places):
            plate.found.append(_within(hole))
    size = min((2.0 * radius for _centre, radius in part.shape.holes), default=0.25 * part.shape.bound[1])
    _put(plate, (Engraving(part.name, at, height, turn) for height in _heights(size) for at, turn in _middles(part)))
    return tuple(plate.found)


def _put(plate: _Plate, places: Iterable[Engraving]) -> bool:
    """Adds the first text that has room, and says whether there is one."""
    chosen = next((each for each in places if plate.has_room(each)), None)
    if chosen is not None:
        plate.found.append(chosen)
    return chosen is not None


def _within(hole: Hole) -> Engraving:
    """The name of a pin on what falls out of its hole."""
    text = Engraving(_short(hole.pin), hole.centre, hole.radius)
    return Engraving(text.text, text.at, text.height * min(1.0, 1.6 * hole.radius / text.width))


def _is_nearest(part: Part, hole: Hole, text: Engraving) -> bool:
    """Whether the edge of no other hole is as near to the middle of a text as that of its own."""
    others = (each for each in part.holes if each is not hole)
    return all(_edge(each, text) > 1.2 * _edge(hole, text) for each in others)


def _edge(hole: Hole, text: Engraving) -> float:
    """From the edge of a hole to the middle of a text, m."""
    return abs(abs(hole.centre - text.at) - hole.radius)


def _short(pin: str) -> str:
    """The name of a pin without the word before it."""
    return pin.removeprefix("pin ").removeprefix("post ")


def _heights(size: float) -> Iterator[float]:
    found = [share * size for share in SIZES]
    yield from (each for each in found if each >= SMALLEST)
    if found[-1] < SMALLEST <= size:
        yield SMALLEST


def _around(part: Part, centre: complex) -> Iterator[tuple[complex, float]]:
    """Directions around a hole, those to and from other holes first, and the turn of a text there."""
    others = [each.centre - centre for each in part.holes if abs(each.centre - centre) > 0.0]
    ways = [each / abs(each) for each in sorted(others, key=abs)]
    ways += [-each for each in ways] + [1j * each for each in ways] + [-1j * each for each in ways]
    ways += [cmath.exp(2j * math.pi * k / WAYS) for k in range(WAYS)]
    for way in ways:
        yield way, _upright(cmath.phase(way))
        yield way, 0.0


def _upright(turn: float) -> float:
    """The direction of a line of text, turned by half a turn where it would be upside down."""
    return turn if -0.5 * math.pi + 1e-9 < turn <= 0.5 * math.pi + 1e-9 else turn - math.copysign(math.pi, turn)


def _reach(text: str, height: float, way: complex, turn: float) -> float:
    """From the edge of a hole to the middle of a text beside it, m."""
    along = way * cmath.exp(-1j * turn)
    x, y = 0.5 * width(text, height / CAPITAL) + ROOM * height, (0.5 + ROOM) * height
    return abs(along.real) * x + abs(along.imag) * y


def _middles(part: Part) -> Iterator[tuple[complex, float]]:
    """Places for the name of a plate: between its holes, the longest stretch first, then over its length."""
    centres = [each.centre for each in part.holes]
    pairs = [(a, b) for k, a in enumerate(centres) for b in centres[k + 1 :] if a != b]
    for a, b in sorted(pairs, key=lambda pair: -abs(pair[1] - pair[0])):
        for share in (0.5, 0.35, 0.65):
            yield a + share * (b - a), _upright(cmath.phase(b - a))
    middle, reach = part.shape.bound
    for out in (0.0, 0.3, 0.6):
        for k in range(WAYS if out else 1):
            yield middle + out * reach * cmath.exp(2j * math.pi * k / WAYS), 0.0


def _nearest(text: Engraving, place: complex) -> float:
    """Distance of a place from the box of a text, m."""
    local = (place - text.at) * cmath.exp(-1j * text.turn)
    x, y = 0.5 * text.width + ROOM * text.height, (0.5 + ROOM) * text.height
    return abs(complex(max(abs(local.real) - x, 0.0), max(abs(local.imag) - y, 0.0)))


def _apart(one: Engraving, other: Engraving) -> bool:
    """Whether a line parts the boxes of two texts."""
    a, b = one.box, other.box
    for way in (cmath.exp(1j * one.turn), cmath.exp(1j * other.turn)):
        for axis in (way, 1j * way):
            first, second = (a * axis.conjugate()).real, (b * axis.conjugate()).real
            if first.max() < second.min() or second.max() < first.min():
                return True
    return False
