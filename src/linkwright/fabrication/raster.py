"""Sheets as cells, and where on them a part still fits."""

from __future__ import annotations

import cmath
import math

import numpy as np
from scipy import fft

from linkwright.core.arrays import Complexes, Flags, Floats
from linkwright.shapes.distance import core_distances
from linkwright.shapes.shape import Piece, Shape

#: Corners from which on a ring is simplified.
MANY = 24
#: Cells along a block of which all are looked at or none.
BLOCK = 6


def turned(shape: Shape, turn: float, to: complex = 0j) -> Shape:
    """A shape turned about its origin (rad), then moved, without its bored holes."""
    way = cmath.exp(1j * turn)
    return Shape(
        tuple(Piece(tuple(way * ring + to for ring in each.rings), each.radius, each.filled) for each in shape.pieces)
    )


def box(shape: Shape) -> tuple[complex, complex]:
    """Lowest and highest x and y of a shape, m."""
    corners = [(each.corners, each.radius) for each in shape.pieces]
    low = complex(min(z.real.min() - r for z, r in corners), min(z.imag.min() - r for z, r in corners))
    high = complex(max(z.real.max() + r for z, r in corners), max(z.imag.max() + r for z, r in corners))
    return low, high


def simplified(shape: Shape, tolerance: float) -> Shape:
    """A shape with fewer corners, within which the given one lies and which nowhere leaves it by more than twice a
    ``tolerance`` (m): rings by Douglas and Peucker, widened by it."""
    pieces = []
    for piece in shape.pieces:
        rings = tuple(_fewer(ring, tolerance, piece.filled) for ring in piece.rings)
        same = sum(map(len, rings)) == len(piece.corners)
        pieces.append(piece if same else Piece(rings, piece.radius + tolerance, piece.filled))
    return Shape(tuple(pieces))


def _fewer(ring: Complexes, tolerance: float, closed: bool) -> Complexes:
    """The corners of a chain from which the others are no farther than a tolerance."""
    if len(ring) < MANY:
        return ring
    chain = np.append(ring, ring[:1]) if closed else ring
    far = int(np.argmax(np.abs(chain - chain[0])))
    kept, ranges = {0, far, len(chain) - 1}, [(0, far), (far, len(chain) - 1)]
    while ranges:
        first, last = ranges.pop()
        if last - first < 2:
            continue
        away = core_distances(Piece((chain[[first, last]],), 0.0), chain[first + 1 : last])
        farthest = first + 1 + int(np.argmax(away))
        if away.max() > tolerance:
            kept.add(farthest)
            ranges += [(first, farthest), (farthest, last)]
    return np.asarray(chain[sorted(kept)][: -1 if closed else None])


class Cells:
    """Square cells of the side ``side`` (m) that cover a sheet from its lower left corner; rows go up."""

    def __init__(self, width: float, height: float, side: float) -> None:
        self.side = side
        self.columns, self.rows = math.ceil(width / side), math.ceil(height / side)
        self.taken = np.zeros((self.rows, self.columns), dtype=np.bool_)
        self.size = (fft.next_fast_len(self.rows, real=True), fft.next_fast_len(self.columns, real=True))
        self._spectrum: Complexes | None = None

    def take(self, shape: Shape, spacing: float) -> None:
        """Marks the cells which a shape on the sheet touches or comes nearer to than ``spacing`` (m)."""
        low, high = box(shape)
        (left, below), (right, above) = self._cell(low - spacing * (1 + 1j)), self._cell(high + spacing * (1 + 1j))
        rows, columns = slice(max(below, 0), above + 1), slice(max(left, 0), right + 1)
        part = self.taken[rows, columns]
        part |= touched(shape, complex(columns.start, rows.start) * self.side, part.shape, self.side, spacing)
        self._spectrum = None

    def _cell(self, place: complex) -> tuple[int, int]:
        return math.floor(place.real / self.side), math.floor(place.imag / self.side)

    def free(self, mask: Flags, room: complex) -> Flags:
        """Where the lower left cell of a mask (rows, columns) may be so that all its cells are free, (rows, columns)
        from the sheet's lower left cell on and no farther to the right and up than ``room`` (m)."""
        rows, columns = (math.floor(each / self.side + 1e-6) + 1 for each in (room.imag, room.real))
        if self._spectrum is None:
            self._spectrum = fft.rfft2(self.taken.astype(float), self.size)
        # how many taken cells the mask would meet, by its correlation with them
        met: Floats = fft.irfft2(self._spectrum * fft.rfft2(mask.astype(float), self.size).conj(), self.size)
        return np.asarray(met[:rows, :columns] < 0.5)


def touched(shape: Shape, corner: complex, size: tuple[int, ...], side: float, spacing: float = 0.0) -> Flags:
    """Which of ``size`` (rows, columns) cells with their lower left corner at a place a shape may touch, or come
    nearer to than ``spacing``: those whose middle is no farther from it than half of a cell's diagonal more."""
    rows, columns = size
    across, up = side * (np.arange(columns) + 0.5), side * (np.arange(rows) + 0.5)
    middles = np.asarray(corner + across + 1j * up[:, None], dtype=complex)
    found = np.zeros((rows, columns), dtype=np.bool_)
    for piece in shape.pieces:
        if piece.filled:
            found |= _within(piece, middles.real[0], middles.imag[:, 0])
        reach = piece.radius + spacing + side * math.sqrt(0.5)
        rest = _near(piece, middles, reach, side) & ~found
        found[rest] = core_distances(piece, middles[rest]) <= reach
    return found


def _within(piece: Piece, across: Floats, up: Floats) -> Flags:
    """Which places (rows, columns) of a lattice are within a filled core: to the left are an odd number of sides."""
    start, end = piece.sides[:, 0], piece.sides[:, 1]
    found = np.zeros((len(up), len(across)), dtype=np.bool_)
    for row, y in enumerate(up.tolist()):
        crossed = (start.imag > y) != (end.imag > y)
        a, b = start[crossed], end[crossed]
        places = np.sort(a.real + (y - a.imag) / (b.imag - a.imag) * (b.real - a.real))
        found[row] = np.searchsorted(places, across) % 2 == 1
    return found


def _near(piece: Piece, middles: Complexes, reach: float, side: float) -> Flags:
    """Which cells are in blocks that a core comes near to."""
    rows, columns = middles.shape
    blocks = middles[::BLOCK, ::BLOCK] + 0.5 * (BLOCK - 1) * side * (1 + 1j)
    near = core_distances(piece, blocks.ravel()).reshape(blocks.shape) <= reach + 0.5 * math.sqrt(2.0) * BLOCK * side
    return np.repeat(np.repeat(near, BLOCK, axis=0)[:rows], BLOCK, axis=1)[:, :columns]
