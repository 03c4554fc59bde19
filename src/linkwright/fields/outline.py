"""Outlines in the plane: closed chains of places that neither cross themselves nor each other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from linkwright.fields.base import Field, Schema
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.references import PLACE
from linkwright.fields.tables import Listed
from linkwright.units import number
from linkwright.words import Message, _

if TYPE_CHECKING:
    from linkwright.core.arrays import Complexes

Ring = tuple[tuple[float, float], ...]
_FORM = "[[0 mm, 0 mm], [40 mm, 0 mm], [0 mm, 30 mm]]"


@dataclass(frozen=True)
class Outline(Field):
    """The corners of a polygon in order, ``[[x, y], …]``; the first one is not repeated at the end."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Ring | None:
        items = reader.items(node, place, None, _FORM)
        if items is None:
            return None
        with reader.plain_numbers(_("an outline")):
            places = [PLACE.read(reader, each, place.child(str(k)), {}) for k, each in enumerate(items)]
        if any(each is None for each in places):
            return None
        corners = [(x, y) for x, y in filter(None, places)]
        return without_repeats(corners)

    def shape(self) -> Schema:
        return {"type": "array", "items": PLACE.shape(), "minItems": 3}

    def written(self, value: Any) -> Any:
        return [PLACE.written(each) for each in value]


@dataclass(frozen=True)
class Holes(Listed):
    """The outlines of what is cut out of a plate."""

    item: Field = Outline()
    form: str = f"[{_FORM}]"

    def written(self, value: Any) -> Any:
        return [self.item.written(each) for each in value]


def without_repeats(corners: Sequence[tuple[float, float]]) -> Ring:
    """Corners without those that are at the place of the one before."""
    found = [each for each, before in zip(corners, (None, *corners), strict=False) if each != before]
    return tuple(found[:-1] if len(found) > 1 and found[0] == found[-1] else found)


def fault_of(rings: Sequence[Ring]) -> tuple[Message, Message] | None:
    """What is wrong with an outline and the holes in it, and what to do; None where nothing is."""
    import numpy as np

    if any(len(ring) < 3 for ring in rings):
        return _("an outline needs three corners or more", code="shapes.few_corners"), _("add corners")
    found = [np.array([complex(*each) for each in ring]) for ring in rings]
    if any(_flat(ring) for ring in found):
        return _("the outline has no area", code="shapes.no_area"), _("move a corner out of the line of the others")
    place = _crossing(found)
    if place is not None:
        x, y = (f"{number(each, 6)} m" for each in (place.real, place.imag))
        return (
            _("the outline meets itself at [{x}, {y}]", code="shapes.crosses", x=x, y=y),
            _("give the corners in the order in which they follow along the edge"),
        )
    return _misplaced(found)


def _misplaced(rings: Sequence[Complexes]) -> tuple[Message, Message] | None:
    """The same of the first hole that is not in the outline, or is in another hole."""
    from linkwright.shapes.distance import contains
    from linkwright.shapes.shape import polygon

    outer, *holes = map(polygon, rings)
    for index, hole in enumerate(rings[1:], 1):
        if not contains(outer, hole[:1])[0]:
            return (
                _("hole {number} is not within the outline", code="shapes.opening_outside", number=index),
                _("move it, or make the outline larger"),
            )
        if any(contains(other, hole[:1])[0] for number, other in enumerate(holes, 1) if number != index):
            return (
                _("hole {number} is within another hole", code="shapes.opening_in_opening", number=index),
                _("remove it: there is nothing to cut"),
            )
    return None


def _flat(ring: Complexes) -> bool:
    """Whether all corners are in line."""
    import numpy as np

    steps = ring - ring[0]
    longest = steps[int(np.argmax(np.abs(steps)))]
    return bool((np.abs((longest.conjugate() * steps).imag) <= 1e-12 * abs(longest) ** 2).all())


def _crossing(rings: Sequence[Complexes]) -> complex | None:
    """A place where two sides meet that do not follow each other, or where one turns back on the one before."""
    import numpy as np

    starts, ends = np.concatenate(rings), np.concatenate([np.roll(ring, -1) for ring in rings])
    firsts = np.cumsum([0, *(len(ring) for ring in rings)])
    before = np.arange(len(starts)) - 1
    before[firsts[:-1]] = firsts[1:] - 1
    ways = ends - starts
    turns = ways[before].conj() * ways
    back = (turns.real < 0.0) & (np.abs(turns.imag) <= 1e-12 * np.abs(turns))
    if back.any():
        return complex(starts[int(np.argmax(back))])
    for k, (start, way) in enumerate(zip(starts, ways, strict=True)):
        apart = np.arange(k + 1, len(starts))
        apart = apart[(before[apart] != k) & (apart != before[k])]
        met = _meeting(start, way, starts[apart], ways[apart])
        if met is not None:
            return met
    return None


def _meeting(start: complex, way: complex, starts: Complexes, ways: Complexes) -> complex | None:
    """A place where a side meets one of others."""
    import numpy as np

    def cross(a: Any, b: Any) -> Any:
        return (np.conj(a) * b).imag

    gaps, turn = starts - start, cross(way, ways)
    level = np.abs(turn) <= 1e-14 * abs(way) * np.abs(ways)
    safe = np.where(level, 1.0, turn)
    own, other = cross(gaps, ways) / safe, cross(gaps, way) / safe
    hits = ~level & (own >= 0.0) & (own <= 1.0) & (other >= 0.0) & (other <= 1.0)
    share = np.stack([(np.conj(way) * gaps).real, (np.conj(way) * (gaps + ways)).real]) / abs(way) ** 2
    on_line = level & (np.abs(cross(way, gaps)) <= 1e-12 * abs(way) * (np.abs(gaps) + abs(way)))
    overlap = on_line & (share.max(axis=0, initial=-np.inf) >= 0.0) & (share.min(axis=0, initial=np.inf) <= 1.0)
    if not (hits | overlap).any():
        return None
    index = int(np.argmax(hits | overlap))
    part = own[index] if hits[index] else min(max(float(share[:, index].min()), 0.0), 1.0)
    return complex(start + part * way)
