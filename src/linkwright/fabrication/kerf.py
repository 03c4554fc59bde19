"""Outlines for a tool that takes some width: outwards by half the kerf, holes inwards, exact at corners and arcs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from linkwright.core.quantity import shown
from linkwright.errors import RequestError
from linkwright.fabrication.part import Hole, Part
from linkwright.shapes.shape import Piece, Shape
from linkwright.words import _


def for_kerf(part: Part, kerf: float) -> Part:
    """The part as the middle of a cut of a width (m) has to go around it; raises RequestError where a hole is smaller
    than the cut."""
    if kerf == 0.0:
        return part
    half = 0.5 * kerf
    for hole in part.holes:
        if hole.radius <= half:
            raise RequestError(
                _(
                    "the kerf of {kerf} is as wide as the hole for {pin} in {part}; give a smaller one, "
                    "or drill the hole after cutting without a kerf",
                    code="cut.kerf",
                    kerf=shown(kerf, "length"),
                    pin=hole.pin,
                    part=part.name,
                )
            )
    pieces = tuple(each for piece in part.shape.pieces for each in _widened(piece, half))
    bored = tuple((centre, radius - half) for centre, radius in part.shape.holes)
    holes = tuple(Hole(each.pin, each.centre, each.radius - half, each.fixed) for each in part.holes)
    return replace(part, shape=Shape(pieces, bored), holes=holes)


def _widened(piece: Piece, by: float) -> Iterator[Piece]:
    """Pieces whose union is all within a distance (m) of a piece."""
    if len(piece.rings) == 1:
        yield replace(piece, radius=piece.radius + by)
        return
    yield piece  # only a core with one ring has a radius: around the others go bars along their rings
    for ring in piece.rings:
        yield Piece((np.append(ring, ring[:1]),), by)
