"""The outline of a shape, exact in its arcs: of the union of its pieces, with the bored holes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from linkwright.core.arrays import Complexes
from linkwright.errors import RequestError, SelfCheckError
from linkwright.shapes.chains import closed_loops
from linkwright.shapes.distance import contains
from linkwright.shapes.loop import Loop, circle
from linkwright.shapes.rings import bent, clear_of_each_other, loops_of, overlapping
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
_OUTSIDE = _(
    "the hole of {diameter} mm in diameter at ({x}, {y}) mm breaks through the edge of its shape; make the shape "
    "wider there, or the pin thinner",
    code="shapes.bore_outside",
)
_OVERLAP = _(
    "the holes at ({x}, {y}) mm and ({u}, {v}) mm overlap; make the pins thinner, or set them farther apart",
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
    """The outline of one disc, one straight bar, one convex plate or one polygon; empty for anything else."""
    if len(shape.pieces) != 1:
        return []
    piece = shape.pieces[0]
    if piece.filled and not piece.radius:
        rings = [bent(ring, near) for ring in piece.rings]
        plain = min(map(len, rings)) > 2 and clear_of_each_other(rings, near)
        return loops_of(rings) if plain else []
    if len(piece.rings) != 1:
        return []
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
        runs = list(_runs(shape, near))
        kept = _kept(runs, shape, coarser * ASIDE * size) if runs else []
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
    if not segments:
        return
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


def _neighbours(segments: Sequence[Segment], near: float) -> list[list[int]]:
    """Pairs of segments whose boxes overlap, in order."""
    boxes = np.array([segment.edge.box for segment in segments])
    corner = near * (1 + 1j)
    pairs = np.stack(overlapping(boxes[:, 0] - corner, boxes[:, 1] + corner), axis=1)
    return sorted(np.sort(pairs, axis=1).tolist())


def _kept(runs: Sequence[list[Segment]], shape: Shape, aside: float) -> list[Segment]:
    """The segments of runs that have the union on one side only, with it to their left."""
    longest = [max(run, key=lambda each: each.length) for run in runs]
    offsets = np.minimum(aside, 0.01 * np.array([each.length for each in longest]))
    places = np.array([[each.at(share) for share in SAMPLES] for each in longest])
    headings = np.array([[each.edge.heading(share) for share in SAMPLES] for each in longest])
    left = 1j * np.exp(1j * headings) * offsets[:, None]
    inside = contains(shape, np.stack([places + left, places - left]).ravel()).reshape(2, len(runs), -1)
    leftward, rightward = inside.sum(axis=2) > 0.5 * len(SAMPLES)
    found: list[Segment] = []
    for run, there, beyond in zip(runs, leftward.tolist(), rightward.tolist(), strict=True):
        if there != beyond:
            found += run if there else [each.reversed for each in reversed(run)]
    return found


def _bored(shape: Shape, loops: Sequence[Loop], near: float) -> Iterator[Loop]:
    """The bored holes; one within another is part of that."""
    kept: list[tuple[complex, float]] = []
    for centre, radius in sorted(shape.holes, key=lambda hole: -hole[1]):
        if any(abs(centre - other) <= bigger - radius + near for other, bigger in kept):
            continue
        edge = min(each.distance(centre) for loop in loops for each in loop.edges)
        if edge < radius - near or not contains(shape, np.array([centre]))[0]:
            raise RequestError(_OUTSIDE.format(diameter=f"{2e3 * radius:.6g}", **_millimetres(centre)))
        for other, bigger in kept:
            if abs(centre - other) < bigger + radius - near:
                raise RequestError(_OVERLAP.format(**_millimetres(other), **_millimetres(centre, "uv")))
        kept.append((centre, radius))
        yield circle(centre, radius, clockwise=True)


def _millimetres(place: complex, names: str = "xy") -> dict[str, str]:
    """A place as values of a text."""
    return {name: f"{1e3 * value:.6g}" for name, value in zip(names, (place.real, place.imag), strict=True)}
