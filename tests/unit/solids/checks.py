"""What must hold for the solids of any machine: ``python -m tests.unit.solids.checks`` for the whole gallery.

Outlines are closed, those of shapely enclose the same area, plates hold together; what is meant to touch does so at
every position: blocks in their slots, teeth, cams with rollers and faces.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import suppress

import numpy as np
from shapely import LineString, Point, Polygon, unary_union
from shapely.geometry.base import BaseGeometry

import linkwright as lw
from linkwright.core.arrays import Complexes
from linkwright.kinematics.placement import placements
from linkwright.shapes.boundary import boundary
from linkwright.shapes.distance import gap
from linkwright.shapes.loop import Loop
from linkwright.shapes.shape import Shape
from linkwright.solids.solid import Solid, Solids
from linkwright.solids.solids_of import solids

#: Shares: of an area, by which shapely's arcs of chords are off; of a size, by which profiles and rings are.
AREA, CHORDS, RING = 2e-3, 2e-4, 6e-4
#: Positions at which contacts are looked at.
POSITIONS = 24


def faults(mechanism: lw.Mechanism) -> Iterator[str]:
    """Sentences on what is wrong."""
    found = solids(mechanism)
    names = {*found.by_name}
    for solid in found.by_name.values():
        yield from (f"{solid.name}: {fault}" for fault in _of_shape(solid))
        if not solid.plates or any(not found.by_name[each].is_plate for each in solid.plates):
            yield f"{solid.name} reaches to {solid.plates}"
    for pair in (*found.level, *found.joined):
        if not names.issuperset(pair):
            yield f"{pair} are no solids"
    with suppress(lw.LinkwrightError):
        yield from _contacts(mechanism, found)


def drawn(shape: Shape) -> BaseGeometry:
    """The union of the pieces by shapely, without holes."""
    parts = []
    for piece in shape.pieces:
        rings = [np.column_stack([ring.real, ring.imag]) for ring in piece.rings]
        if piece.filled:
            core: BaseGeometry = Polygon()
            for ring in rings:  # even-odd
                core = core.symmetric_difference(Polygon(ring))
        else:
            core = LineString(rings[0]) if len(rings[0]) > 1 else Point(rings[0][0])
        parts.append(core.buffer(piece.radius, quad_segs=64) if piece.radius else core)
    return unary_union(parts)


def polygon_of(loop: Loop) -> Polygon:
    """A loop with arcs as chords."""
    places = [edge.at(share) for edge in loop.edges for share in np.linspace(0.0, 1.0, 33)[:-1]]
    return Polygon([(each.real, each.imag) for each in places])


def _of_shape(solid: Solid) -> Iterator[str]:
    try:
        loops = boundary(solid.shape)
    except lw.LinkwrightError as problem:
        yield str(problem)
        return
    for loop in loops:
        ends = [edge.end for edge in loop.edges]
        starts = [edge.start for edge in loop.edges]
        if max(abs(a - b) for a, b in zip(ends, [*starts[1:], starts[0]], strict=True)) > 1e-9:
            yield "an outline is not closed"
    outer = [polygon_of(loop) for loop in loops if polygon_of(loop).exterior.is_ccw]
    if len(outer) != (2 if len(solid.shape.pieces[0].rings) == 3 else 1):
        yield f"consists of {len(outer)} parts"
    want = drawn(solid.shape)
    inner = unary_union([polygon_of(loop) for loop in loops[: len(loops) - len(solid.shape.holes)]][len(outer) :])
    mine = unary_union(outer).difference(inner)
    if len(outer) == 1 and mine.symmetric_difference(want).area > AREA * want.area:
        yield "the outline encloses another area than the pieces"
    for centre, radius in solid.shape.holes:
        if not want.buffer(1e-9).contains(Point(centre.real, centre.imag).buffer(radius)):
            yield f"the hole at {centre:.5g} is not in it"


def _contacts(mechanism: lw.Mechanism, found: Solids) -> Iterator[str]:
    """Plates that touch by intent, over the cycle."""
    motion = lw.solve_motion(mechanism, failures="mark")
    rows = np.flatnonzero(motion.ok)
    if not len(rows):
        return
    rows = rows[np.unique(np.linspace(0, len(rows) - 1, POSITIONS).round().astype(int))]
    placed = placements(motion)

    def frames(carrier: str) -> tuple[Complexes, Complexes]:
        each = placed[carrier]
        return _complex(each.origin[rows]), _complex(each.direction[rows])

    for pair in found.joined:
        first, second = (found.by_name[name] for name in pair)
        if first.carrier == second.carrier:
            continue
        (a, along_a), (b, along_b) = frames(first.carrier), frames(second.carrier)
        places, turns = (b - a) * along_a.conj(), np.angle(along_b * along_a.conj())
        poses = list(zip(places, turns, strict=True))
        sorts = {first.sort, second.sort}
        if "block" in sorts and sorts & {"guide", "link"} and not {"pin", "post"} & sorts:
            block, guide = (first, second) if first.sort == "block" else (second, first)
            if guide.name not in block.plates or guide.carrier != block.carrier:
                yield from _sliding(guide, block, poses if guide is first else _reversed(poses))
        elif sorts <= {"cam", "roller", "wheel", "link"}:
            gaps = [gap(first.shape, second.shape, (complex(at), float(turn))) for at, turn in poses]
            size = (CHORDS if "cam" in sorts else RING) * max(first.shape.bound[1], second.shape.bound[1])
            if max(gaps) > size:
                yield f"{pair} part by {max(gaps):.3g} m"
            if "cam" in sorts and min(gaps) < -size:
                yield f"{pair} overlap by {-min(gaps):.3g} m"


def _reversed(poses: list[tuple[complex, float]]) -> list[tuple[complex, float]]:
    return [(-at * np.exp(-1j * turn), -turn) for at, turn in poses]


def _sliding(guide: Solid, block: Solid, poses: list[tuple[complex, float]]) -> Iterator[str]:
    """A block is within an opening of its guide, and touches both sides of it."""
    loops = [polygon_of(loop) for loop in boundary(guide.shape)]
    slots = [each.buffer(1e-9) for each in loops if not each.exterior.is_ccw]
    corners = np.concatenate([ring for piece in block.shape.pieces for ring in piece.rings])
    for at, turn in poses:
        places = at + np.exp(1j * turn) * corners
        inside = Polygon(np.column_stack([places.real, places.imag]))
        if not any(slot.contains(inside) for slot in slots):
            yield f"{block.name} leaves the slot of {guide.name}"
            return


def _complex(rows: np.ndarray) -> Complexes:
    return np.asarray(rows[:, 0] + 1j * rows[:, 1])


def main() -> int:
    """The whole gallery, or the machines that are named; exit code 1 where something is wrong."""
    bad = 0
    for name in sys.argv[1:] or lw.gallery_names():
        for fault in faults(lw.load(f"gallery:{name}")):
            print(f"{name}: {fault}", flush=True)
            bad = 1
    return bad


if __name__ == "__main__":
    sys.exit(main())
