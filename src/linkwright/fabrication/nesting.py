"""Parts laid out on sheets."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Flags
from linkwright.core.plane import convex_hull
from linkwright.fabrication.raster import Cells, box, simplified, touched, turned
from linkwright.shapes.distance import gap
from linkwright.shapes.shape import Shape

#: Cells along the longer side of a sheet: as many as the narrowest part asks for, between these.
FEWEST, MOST = 300, 1000
#: Cells across the narrowest part.
ACROSS = 4.0
#: Turns (rad) that are tried, from that in which a part takes the smallest rectangle; those where none of them fits.
TURNS = tuple(0.5 * math.pi * k for k in range(4))
MORE_TURNS = tuple(math.pi / 12.0 * k for k in range(24))
#: By how much outlines with many corners are simplified, in cells.
SIMPLER = 0.05
#: How often a part is pushed on to the left and down, and the distance (in cells) below which that is not worth it.
PUSHES, SHORT = 8, 0.02
#: Share of a sheet's size that is rounding.
ROUNDED = 1e-9


@dataclass(frozen=True)
class Placed:
    """Where a part is on the ``sheet`` of a number from 0: turned about its origin by ``turn`` (rad), then moved by
    ``place`` (m) from the sheet's lower left corner."""

    sheet: int
    place: complex
    turn: float


@dataclass(frozen=True, eq=False)
class _Turned:
    """A part in one turn: its shape with the lower left corner of its box in the origin, which was at ``low`` (m),
    the size of the box, and the cells it touches."""

    turn: float
    shape: Shape
    low: complex
    size: complex
    mask: Flags


class _Sheet:
    """A sheet without its edge, and what is on it."""

    def __init__(self, size: complex, spacing: float, side: float) -> None:
        self.size, self.spacing = size, spacing
        self.cells = Cells(size.real, size.imag, side)
        self.shapes: list[Shape] = []
        self.used = 0.0

    def room(self, part: _Turned) -> complex | None:
        """The place farthest to the left, and there the lowest one, where a part fits; None where there is none."""
        if not self.shapes:
            return 0j
        free = self.cells.free(part.mask, self.size - part.size)
        columns = free.any(axis=0)
        if not columns.any():
            return None
        column = int(np.argmax(columns))
        return complex(column, int(np.argmax(free[:, column]))) * self.cells.side

    def put(self, part: _Turned, place: complex) -> complex:
        """Puts a part at a place, pushed as far to the left and down as it goes; gives the place."""
        for _push in range(PUSHES if self.shapes else 0):
            before = place
            place -= self._clear(part, place, place.real)
            place -= 1j * self._clear(part, place, place.imag)
            if abs(place - before) < SHORT * self.cells.side:
                break
        there = turned(part.shape, 0.0, place)
        self.cells.take(there, self.spacing)
        self.shapes.append(there)
        self.used = max(self.used, place.real + part.size.real)
        return place

    def _clear(self, part: _Turned, place: complex, most: float) -> float:
        """How far (m) a part may be moved in any direction, up to ``most``."""
        there = turned(part.shape, 0.0, place)
        for apart, other in sorted(((_apart(there, each), each) for each in self.shapes), key=lambda each: each[0]):
            if apart - self.spacing >= most:
                break
            most = min(most, max(gap(there, other) - self.spacing, 0.0))
        return most


def _apart(one: Shape, other: Shape) -> float:
    """Distance of the boxes of two shapes, m."""
    (low, high), (least, greatest) = box(one), box(other)
    way = complex(
        max(low.real - greatest.real, least.real - high.real, 0.0),
        max(low.imag - greatest.imag, least.imag - high.imag, 0.0),
    )
    return abs(way)


def nest(outlines: Sequence[Shape], sheet: tuple[float, float], spacing: float) -> list[Placed | None]:
    """Places of parts on sheets of one size, in the order of the parts; None of one that fits on no sheet.

    ``sheet``: width and height, m; ``spacing``: least distance (m) between parts, and from the edge of the sheet.
    Large parts come first, each in the first sheet with room and there nearest to the left edge (of a sheet higher
    than wide: the lower edge), in turns of 90° from its smallest rectangle, else of 15°; small parts go into the
    openings of large ones. Bored holes are left out. The same parts are always laid out in the same way.
    """
    width, height = sheet
    if height > width:
        return [each and _upright(each, width) for each in nest(outlines, (height, width), spacing)]
    inner = complex(width - 2.0 * spacing, height - 2.0 * spacing)
    side = _cell_side(outlines, width)
    sheets: list[_Sheet] = []
    found: list[Placed | None] = [None] * len(outlines)
    known = {id(each): _ways(each, inner, side) for each in outlines}
    for k in sorted(range(len(outlines)), key=lambda k: (-_extent(known[id(outlines[k])]), k)):
        found[k] = _place(known[id(outlines[k])], sheets, _Sheet(inner, spacing, side))
    return found


def _ways(outline: Shape, sheet: complex, side: float) -> list[_Turned]:
    """A part in all turns that are tried; none where it fits in no turn."""
    simple = simplified(outline, SIMPLER * side)
    base = _smallest_turn(simple)
    tried = (list(_turns(simple, (base + each for each in turns), sheet, side)) for turns in (TURNS, MORE_TURNS))
    return next(filter(None, tried), [])


def _extent(ways: list[_Turned]) -> float:
    """Area of a part's smallest rectangle, m²; 0 where it does not fit."""
    return min((each.size.real * each.size.imag for each in ways), default=0.0)


def _place(ways: list[_Turned], sheets: list[_Sheet], fresh: _Sheet) -> Placed | None:
    """Puts a part on the first sheet with room, or on a fresh one; None where it fits on none."""
    for number, sheet in enumerate((*sheets, fresh)):
        rooms = [(place, part) for part in ways if (place := sheet.room(part)) is not None]
        if rooms:
            place, part = min(rooms, key=lambda each: _worth(sheet, *each))
            place = sheet.put(part, place)
            if sheet is fresh:
                sheets.append(fresh)
            return Placed(number, place - part.low + sheet.spacing * (1 + 1j), part.turn)
    return None


def _worth(sheet: _Sheet, place: complex, part: _Turned) -> tuple[float, float, float]:
    """What is least for the best place: how much of the sheet is used, how far right and how far up the part is."""
    right = place.real + part.size.real
    return max(sheet.used, right), right, place.imag


def _turns(shape: Shape, turns: Iterable[float], sheet: complex, side: float) -> Iterator[_Turned]:
    """A part in those turns in which it fits on an empty sheet, once where several look the same."""
    known: set[tuple[tuple[int, ...], bytes]] = set()
    for turn in turns:
        way = turned(shape, turn)
        low, high = box(way)
        size = high - low
        if max(size.real - sheet.real, size.imag - sheet.imag) > ROUNDED * abs(sheet):
            continue
        at = turned(way, 0.0, -low)
        mask = touched(at, 0j, (math.ceil(size.imag / side), math.ceil(size.real / side)), side)
        if (key := (mask.shape, mask.tobytes())) not in known:
            known.add(key)
            yield _Turned(turn, at, low, size, mask)


def _smallest_turn(shape: Shape) -> float:
    """The turn (rad) in which a part takes the smallest rectangle: one side of it lies on one of the hull of the
    cores (exact for pieces of one radius)."""
    corners = np.concatenate([each.corners for each in shape.pieces])
    hull = convex_hull(corners)
    if len(hull) < 2:
        return 0.0
    ways = np.unique(np.round(np.angle(np.roll(hull, -1) - hull) % (0.5 * np.pi), 9))
    sizes = [box(turned(shape, -way)) for way in ways.tolist()]
    areas = np.array([(high - low).real * (high - low).imag for low, high in sizes])
    return -float(ways[np.argmax(areas <= areas.min() * (1.0 + 1e-9))])


def _cell_side(outlines: Sequence[Shape], longer: float) -> float:
    """Side of the cells, m."""
    sizes = [box(turned(each, _smallest_turn(each))) for each in outlines]
    narrowest = min((min((high - low).real, (high - low).imag) for low, high in sizes), default=longer)
    return min(max(narrowest / ACROSS, longer / MOST), longer / FEWEST)


def _upright(placed: Placed, height: float) -> Placed:
    """A place on a sheet that is turned left by a right angle, lower left corner to lower left corner."""
    return Placed(placed.sheet, 1j * placed.place + height, placed.turn + 0.5 * math.pi)
