"""The outline of a shape, exact in its arcs: of the union of its pieces, with the bored holes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.errors import RequestError, SelfCheckError
from linkwright.shapes.chains import closed_loops
from linkwright.shapes.distance import contains
from linkwright.shapes.loop import Loop, circle
from linkwright.shapes.segments import PARALLEL, Segment, around, meeting, tours
from linkwright.shapes.shape import Shape
from linkwright.words import _

#: Shares of a shape's size: distance below which places are one; how far from an edge its sides are looked at; length
#: of an end that may lead nowhere.
NEAR, ASIDE, TAIL = 1e-10, 1e-12, 1e-4
#: How many times coarser places are taken as one where rounding leaves an outline open.
COARSER = (1.0, 30.0, 1e3, 1e4)
#: Shares of the length of an edge at which its sides are looked at: most of them decide.
SAMPLES = (0.29, 0.5, 0.77)
#: Boxes that are compared with all others at once.
ROWS = 256
_OUTSIDE = _(
    "the hole of {diameter} mm in diameter at ({x}, {y}) mm breaks through the edge of its shape; make the shape "
    "wider there, or the pin thinner",
    code="shapes.bore_outside",
)
_OVERLAP = _(
    "the hole of {diameter} mm in diameter at ({x}, {y}) mm overlaps another one; make the pins thinner",
    code="shapes.bores_overlap",
)


def boundary(shape: Shape) -> tuple[Loop, ...]:
    """The outline of the union of all pieces: loops around material counter-clockwise, then those around slots and
    openings clockwise, each in order of size, then the bored holes, clockwise, of two half arcs each.

    The pieces are followed at the distance of their radius, these lines and arcs are parted where they meet, and
    those parts are kept that have the union on their left only. Raises RequestError for a shape without area and for
    a bored hole that is not fully within it.
    """
    centre, reach = shape.bound
    size = reach + abs(centre)
    loops = _single(shape, NEAR * size) or _union(shape, size)
    return (*loops, *_bored(shape, loops, NEAR * size))


def _single(shape: Shape, near: float) -> list[Loop]:
    """The outline of one disc, one straight bar or one convex plate; empty for anything else."""
    if len(shape.pieces) != 1 or len(shape.pieces[0].rings) != 1:
        return []
    piece = shape.pieces[0]
    corners = piece.rings[0].tolist()
    if piece.filled:
        if not _convex(piece.rings[0], near):
            return []
    elif piece.radius and len(corners) > 1:
        corners = _straight(corners, near)
    if not piece.filled and (not piece.radius or len(corners) > 2):
        return []
    return [Loop(tuple(each.edge for each in around(corners, piece.radius)))]


def _straight(corners: list[complex], near: float) -> list[complex]:
    """The outer two of corners in line; all of others."""
    first = max(corners, key=lambda each: abs(each - corners[0]))
    last = max(corners, key=lambda each: abs(each - first))
    way = last - first
    if abs(way) <= near:
        return [first]
    on_line = all(abs(((each - first) * way.conjugate()).imag) <= PARALLEL * abs(way) ** 2 for each in corners)
    return [first, last] if on_line else corners


def _convex(ring: Complexes, near: float) -> bool:
    """Whether a ring is a convex polygon, counter-clockwise, without corners in line or at one place."""
    step = np.roll(ring, -1) - ring
    if len(ring) < 3 or np.abs(step).min() <= near:
        return False
    turns = np.angle(np.roll(step, -1) / step)
    return bool(turns.min() > PARALLEL) and math.isclose(float(turns.sum()), 2.0 * math.pi, abs_tol=1e-6)


def _union(shape: Shape, size: float) -> list[Loop]:
    """The outline by parting all lines and arcs where they meet."""
    for coarser in COARSER:
        near = coarser * NEAR * size
        kept = [each for run in _runs(shape, near) for each in _sided(run, shape, coarser * ASIDE * size)]
        loops = closed_loops(kept, 4.0 * near, TAIL * size)
        if loops is not None:
            break
    else:
        raise SelfCheckError(_("the outline of a shape could not be closed", code="shapes.open"))
    if not loops:
        raise RequestError(_("the shape has no area; give it a width", code="shapes.empty"))
    return loops


def _runs(shape: Shape, near: float) -> Iterator[list[Segment]]:
    """Parts of the tours between places where they meet others: all of a run is on the outline, or nothing."""
    rows = [row for piece in shape.pieces for row in tours(piece, near)]
    segments = [segment for row in rows for segment in row]
    cuts = _cuts(segments, near)
    first = 0
    for row in rows:
        yield from _row_runs(row, cuts[first : first + len(row)], near)
        first += len(row)


def _row_runs(row: list[Segment], cuts: list[list[tuple[float, complex]]], near: float) -> Iterator[list[Segment]]:
    """The runs of one tour."""
    runs: list[list[Segment]] = [[]]
    for segment, meets in zip(row, cuts, strict=True):
        inner = sorted((each for each in meets if near < each[0] < segment.length - near), key=lambda each: each[0])
        if any(along <= near for along, _place in meets):
            runs.append([])
        last, begin = 0.0, segment.start
        for along, place in inner:
            if along - last > near:
                runs[-1].append(segment.part(last, along, (begin, place)))
                runs.append([])
                last, begin = along, place
        whole = begin == segment.start and last == 0.0
        runs[-1].append(segment if whole else segment.part(last, segment.length, (begin, segment.end)))
        if any(along >= segment.length - near for along, _place in meets):
            runs.append([])
    yield from (each for each in runs if each)


def _cuts(segments: Sequence[Segment], near: float) -> list[list[tuple[float, complex]]]:
    """Per segment the lengths along it and the places where others meet it; where neighbours only go on from each
    other they do not."""
    found: list[list[tuple[float, complex]]] = [[] for _segment in segments]
    for i, j in _neighbours(segments, near):
        one, other = segments[i], segments[j]
        joint = [one.end] if abs(one.end - other.start) <= near else []
        joint += [one.start] if abs(one.start - other.end) <= near else []
        for place in meeting(one, other, 0.1 * near):
            a, b = one.along(place), other.along(place)
            on_both = -near <= a <= one.length + near and -near <= b <= other.length + near
            if on_both and not any(abs(place - each) <= 2.0 * near for each in joint):
                found[i].append((a, place))
                found[j].append((b, place))
    return found


def _neighbours(segments: Sequence[Segment], near: float) -> Iterator[tuple[int, int]]:
    """Pairs of segments whose boxes overlap."""
    boxes = [segment.edge.box for segment in segments]
    low = np.array([[each[0].real, each[0].imag] for each in boxes]).reshape(-1, 2) - near
    high = np.array([[each[1].real, each[1].imag] for each in boxes]).reshape(-1, 2) + near
    for first in range(0, len(boxes), ROWS):
        rows: Floats = low[first : first + ROWS, None]
        touch = (rows <= high).all(axis=2) & (low <= high[first : first + ROWS, None]).all(axis=2)
        for i, j in zip(*np.nonzero(touch), strict=True):
            if first + i < j:
                yield int(first + i), int(j)


def _sided(run: list[Segment], shape: Shape, aside: float) -> list[Segment]:
    """The run with the union to its left; empty where that is on both sides or on none."""
    longest = max(run, key=lambda each: each.length)
    offset = min(aside, 0.01 * longest.length)
    places = np.array([longest.at(share) for share in SAMPLES])
    left = 1j * np.exp(1j * np.array([longest.edge.heading(share) for share in SAMPLES])) * offset
    inside = contains(shape, np.concatenate([places + left, places - left])).reshape(2, -1)
    leftward, rightward = (inside.sum(axis=1) > 0.5 * len(SAMPLES)).tolist()
    if leftward == rightward:
        return []
    return run if leftward else [each.reversed for each in reversed(run)]


def _bored(shape: Shape, loops: Sequence[Loop], near: float) -> Iterator[Loop]:
    """The bored holes; one within another is part of that."""
    kept: list[tuple[complex, float]] = []
    for centre, radius in sorted(shape.holes, key=lambda hole: -hole[1]):
        if any(abs(centre - other) <= bigger - radius + near for other, bigger in kept):
            continue
        edge = min(each.distance(centre) for loop in loops for each in loop.edges)
        about = {"diameter": f"{2e3 * radius:.6g}", "x": f"{1e3 * centre.real:.6g}", "y": f"{1e3 * centre.imag:.6g}"}
        if edge < radius - near or not contains(shape, np.array([centre]))[0]:
            raise RequestError(_OUTSIDE.format(**about))
        if any(abs(centre - other) < bigger + radius - near for other, bigger in kept):
            raise RequestError(_OVERLAP.format(**about))
        kept.append((centre, radius))
        yield circle(centre, radius, clockwise=True)
