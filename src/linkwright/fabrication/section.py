"""A section through all pins of a machine, developed into one plane: faces, axes and names, heights to scale.

Nothing lies over anything else: plates have gaps where pins, hubs and blocks go through them, so that the section can
be drawn with pens alone. Units are those of sketches, y down.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.fabrication.bodies import colours
from linkwright.fabrication.columns import Bar, Piece
from linkwright.fabrication.cut_parts import CutParts
from linkwright.fabrication.parts_list import called
from linkwright.fabrication.stack import Axis, Stack
from linkwright.pictures.picture import Vec, line_width, name_runs
from linkwright.words import Translate

#: Units of the paper: of the thinnest plate, of the whole height at most; sizes of letters; room between names and
#: what is next to them; smallest gap between axes; largest width of a plate to one side of a pin.
THIN, HIGH, LETTERS, ROOM, GAP, HALF = 20.0, 620.0, 12.0, 9.0, 54.0, 46.0
#: Distance between the lines of a hatching, how far axes stand out, how far a broken plate goes on behind its end,
#: the depth of the wave there, the wall of a guide around its block.
HATCH, OUT, BROKEN, WAVE, WALL = 7.0, 14.0, 12.0, 2.4, 10.0
Span = tuple[float, float]


@dataclass(frozen=True, eq=False)
class Face:
    """Material: its outline (k, 2), a colour, and the lines (k, 2) of its hatching, parted by rows of NaN, none where
    it is not cut."""

    outline: Floats
    colour: str
    hatching: Floats


@dataclass(frozen=True)
class Caption:
    """A name about a place: of an axis, of a plate, or the number of a layer."""

    text: str
    at: Vec
    of: Literal["axis", "plate", "layer"]


@dataclass(frozen=True, eq=False)
class Section:
    """The section: ``faces``, ``centres`` (each two places), ``captions``, and the heights of the lowest and highest
    face with what is between them in m."""

    faces: tuple[Face, ...]
    centres: tuple[Floats, ...]
    captions: tuple[Caption, ...]
    ends: Span
    height: float


def section(cut: CutParts, translate: Translate) -> Section:
    """The section of a machine; from left to right about as its pins are at the first position."""
    return _Section(Stack(cut), {part.name: called([part], translate) for part in cut.parts}).made()


@dataclass(frozen=True)
class _Text:
    """The name of a piece of a plate in the gap behind a place in the order: inside it, or next to its end."""

    piece: Piece
    gap: int
    inside: bool


class _Section:
    """A section in the making: the axes at their places on the paper, heights to scale."""

    def __init__(self, stack: Stack, names: Mapping[str, str]) -> None:
        self.stack, self.names = stack, names
        self.development = stack.development()
        self.axes = [stack.axes[k] for k in self.development.order]
        self.pieces = list(self.development.pieces())
        thinnest = min(part.length for part in stack.plates.values())
        reach = [stack.reach(axis) for axis in self.axes]
        self.low, self.high = min(low for low, _ in reach), max(high for _, high in reach)
        self.scale = min(THIN / thinnest, HIGH / (self.high - self.low))
        self.colours = colours(stack.cut)
        self.gaps = [GAP] * (len(self.axes) + 1)
        self.texts = self._texts()

    @cached_property
    def x(self) -> list[float]:
        """Where the axes are on the paper."""
        return list(np.cumsum([0.0, *self.gaps[1:-1]]).tolist())

    def y(self, height: float) -> float:
        """The place of a height on the paper."""
        return -self.scale * height

    def made(self) -> Section:
        """The whole section."""
        faces = [face for piece in self.pieces for face in self._plate(piece)]
        faces += [face for k in range(len(self.axes)) for face in self._on_axis(k)]
        centres = [line for k in range(len(self.axes)) for line in self._centre(k)]
        return Section(
            tuple(faces),
            tuple(centres),
            tuple(self._captions(min(float(face.outline[:, 0].min()) for face in faces))),
            (self.y(self.low), self.y(self.high)),
            self.high - self.low,
        )

    def half(self, piece: Piece, place: int) -> float:
        """How far a plate goes on behind an axis at its end."""
        axis, name = self.axes[place], piece.bar.name
        if name not in axis.plates:
            return HALF
        inserts = [self.half(each, place) for each in self._inserts(piece.bar, place)]
        if inserts:
            return max(inserts) + WALL
        wide = self.scale * self.stack.half_width(name, axis)
        return max(min(HALF, wide), self._through(piece.bar, place) + 7.0)

    def _inserts(self, bar: Bar, place: int | None = None) -> list[Piece]:
        """Pieces of the blocks that slide in a plate, all or those at one axis."""
        found = [each for each in self.pieces if self.stack.slides_in(each.bar.name, bar.name)]
        return found if place is None else [each for each in found if each.first <= place <= each.last]

    def _through(self, bar: Bar, place: int) -> float:
        """Half the width of what goes through a plate at an axis; 0 where nothing does."""
        axis = self.axes[place]
        if bar.name not in axis.plates:
            return 0.0
        found = [self._radius(axis)]
        found += [0.5 * self.scale * hub.diameter for hub in axis.hubs if _meets(bar, self._span(hub.name))]
        found += [self.half(each, place) for each in self._inserts(bar, place)]
        return max(found)

    def _span(self, name: str) -> Span:
        """Between which heights a part is, m."""
        part = self.stack.cut[name]
        return part.places[0].z, part.places[0].z + part.length

    def _radius(self, axis: Axis) -> float:
        """The radius of a pin; 0 of other axes."""
        return 0.5 * self.scale * axis.pin.diameter if axis.pin is not None else 0.0

    def _widest(self, place: int) -> float:
        """How far all that is on an axis reaches to its sides."""
        axis = self.axes[place]
        found = [0.5 * part.diameter for part in (*axis.hubs, *axis.rings)]
        if axis.pin is not None:
            found += [0.5 * axis.pin.diameter, 0.5 * axis.pin.head]
        return self.scale * max(found, default=0.0)

    def _texts(self) -> list[_Text]:
        """Where names are written; gaps are made wide enough for them and for what lies in them."""
        ends = self._ends()
        for gap in range(1, len(self.axes)):
            names = [self._wide(self.axes[k].solid.name) for k in (gap - 1, gap)]
            self.gaps[gap] = max(GAP, ends[gap - 1][1] + ends[gap][0] + ROOM, 0.5 * sum(names) + ROOM)
        found: list[_Text] = []
        for piece in sorted(self.pieces, key=lambda each: each.last - each.first or len(self.axes)):
            wide = self._wide(piece.bar.name) + 2.0 * ROOM
            inside = self._free_gaps(piece)
            if inside:
                gap = self._widest_gap(piece.bar, inside, wide)
                wide += self._through(piece.bar, gap - 1) + self._through(piece.bar, gap)
            else:
                gap = self._next_to(piece, found)
                wide += sum(self._in_gap(piece, gap))
            self.gaps[gap] = max(self.gaps[gap], wide)
            found.append(_Text(piece, gap, bool(inside)))
        return found

    def _free_gaps(self, piece: Piece) -> list[int]:
        """The gaps between axes through which a piece goes as one."""
        filled = {gap for each in self._inserts(piece.bar) for gap in range(each.first + 1, each.last + 1)}
        return [gap for gap in range(piece.first + 1, piece.last + 1) if gap not in filled]

    def _widest_gap(self, bar: Bar, inside: Sequence[int], wide: float) -> int:
        """The middle one of the gaps that are wide enough for a name between any axes, else the widest one."""
        room = {k: self.gaps[k] - self._through(bar, k - 1) - self._through(bar, k) for k in inside}
        middle = 0.5 * (inside[0] + inside[-1])
        return max(inside, key=lambda k: (min(room[k], wide), -abs(k - middle)))

    def _wide(self, name: str) -> float:
        """The width of the name of a part."""
        return line_width(name_runs(self.names[name]), LETTERS)

    def _ends(self) -> list[list[float]]:
        """How far everything reaches to the left and to the right of every axis in the gaps."""
        found = [[self._widest(k)] * 2 for k in range(len(self.axes))]
        for piece in self.pieces:
            left, right = self._beyond(piece)
            found[piece.first][0] = max(found[piece.first][0], left)
            found[piece.last][1] = max(found[piece.last][1], right)
        return found

    def _beyond(self, piece: Piece) -> Span:
        """How far a piece goes on to the left of its first axis and to the right of its last one."""
        left = self.half(piece, piece.first) + BROKEN * piece.broken_left
        return left, self.half(piece, piece.last) + BROKEN * piece.broken_right

    def _next_to(self, piece: Piece, texts: Sequence[_Text]) -> int:
        """The gap next to a plate with one axis in which nothing else is at its height, the right one if both."""
        others = [each for each in self.pieces if each is not piece and each.bar.meets(piece.bar)]
        for gap in (piece.first + 1, piece.first):
            taken = any(each.first < gap <= each.last for each in others)
            named = any(text.gap == gap and not text.inside and text.piece in others for text in texts)
            if not taken and not named:
                return gap
        return piece.first + 1

    def _in_gap(self, piece: Piece, gap: int) -> Span:
        """How far all at the height of a piece reaches into a gap from the left and from the right."""
        return self._reaching(piece.bar, gap - 1, 1), self._reaching(piece.bar, gap, 0)

    def _reaching(self, bar: Bar, place: int, side: int) -> float:
        if not 0 <= place < len(self.axes):
            return 0.0
        here = (each for each in self.pieces if each.bar.meets(bar) and place == (each.first, each.last)[side])
        column = self.development.columns[self.development.order[place]]
        return max([self._beyond(each)[side] for each in here] + [self._widest(place) if bar.meets(column) else 0.0])

    def _plate(self, piece: Piece) -> Iterator[Face]:
        """The material of a piece between all that goes through it."""
        bar, (beyond_left, beyond_right) = piece.bar, self._beyond(piece)
        left, right = self.x[piece.first] - beyond_left, self.x[piece.last] + beyond_right
        through = [
            (self.x[k] - half, self.x[k] + half)
            for k in range(piece.first, piece.last + 1)
            if (half := self._through(bar, k))
        ]
        for each in self._inserts(bar):
            before, behind = self._beyond(each)
            through.append((self.x[each.first] - before, self.x[each.last] + behind))
        slope = 1.0 if list(self.stack.plates).index(bar.name) % 2 else -1.0
        text = next(each for each in self.texts if each.piece is piece)
        for start, end in without((left, right), through):
            waves = (piece.broken_left and start == left, piece.broken_right and end == right)
            outline = self._outline((start, end), bar, waves)
            straight = (start + WAVE * waves[0], end - WAVE * waves[1])
            cut = without(straight, [self._box(text)] if text.inside else [])
            yield Face(outline, self.colours[bar.name], self._hatching(cut, (bar.low, bar.high), slope))

    def _outline(self, span: Span, bar: Bar, waves: tuple[bool, bool]) -> Floats:
        """A rectangle, with a wave at an end that is broken off."""
        bottom, top = self.y(bar.low), self.y(bar.high)
        return np.array([*_side(span[0], bottom, top, waves[0]), *_side(span[1], top, bottom, waves[1])])

    def _hatching(self, spans: Iterable[Span], heights: Span, slope: float) -> Floats:
        """Lines at 45 degrees within rectangles between two heights, parted by rows of NaN; one pattern for all."""
        bottom, top = self.y(heights[0]), self.y(heights[1])
        rows: list[Vec] = []
        for left, right in spans:
            first = np.floor((left - (bottom - top)) / HATCH) + 1
            for c in np.arange(first * HATCH, right, HATCH).tolist():
                low, high = max(c, left), min(c + bottom - top, right)
                if high > low:
                    ends = ((low, bottom - (low - c)), (high, bottom - (high - c)))
                    rows += [(x, y if slope > 0 else top + bottom - y) for x, y in ends] + [(np.nan, np.nan)]
        return np.array(rows).reshape(-1, 2)

    def _on_axis(self, place: int) -> Iterator[Face]:
        """Hubs, washers and the pin on an axis."""
        axis, radius = self.axes[place], self._radius(self.axes[place])
        for hub in axis.hubs:
            yield from self._sleeve(place, radius, 0.5 * self.scale * hub.diameter, self._span(hub.name), hub.name)
        for ring in axis.rings:
            for each in ring.places:
                if each.on == axis.solid.name:
                    heights = (each.z, each.z + ring.length)
                    yield from self._sleeve(place, radius, 0.5 * self.scale * ring.diameter, heights, ring.name)
        if axis.pin is not None:
            yield self._pin(self.x[place], axis)

    def _sleeve(self, place: int, inner: float, outer: float, heights: Span, name: str) -> Iterator[Face]:
        """What is around a pin, on both sides of it; washers are not hatched, nor are pins."""
        x = self.x[place]
        spans = [(x - outer, x - inner), (x + inner, x + outer)] if inner else [(x - outer, x + outer)]
        hatched = self.stack.cut[name].sort != "washer"
        for span in spans:
            outline = _rectangle(span, self.y(heights[0]), self.y(heights[1]))
            hatching = self._hatching([span] if hatched else [], heights, -1.0)
            yield Face(outline, self.colours[name], hatching)

    def _pin(self, x: float, axis: Axis) -> Face:
        """A pin with its heads."""
        assert axis.pin is not None
        z, steps = axis.pin.places[0].z, []
        for prism in axis.pin.prisms():
            radius = self.scale * prism.shape.pieces[0].radius
            steps += [(radius, self.y(z + prism.low)), (radius, self.y(z + prism.high))]
        outline = np.array([(x + dx, y) for dx, y in steps] + [(x - dx, y) for dx, y in reversed(steps)])
        return Face(outline, "#ffffff", np.zeros((0, 2)))

    def _centre(self, place: int) -> Iterator[Floats]:
        """The line of an axis, without what plates hide through which it does not go."""
        x, axis = self.x[place], self.axes[place]
        hidden = []
        for piece in self.pieces:
            left, right = self._beyond(piece)
            across_it = self.x[piece.first] - left < x < self.x[piece.last] + right
            if across_it and piece.bar.name not in axis.plates:
                hidden.append((self.y(piece.bar.high) - 1.0, self.y(piece.bar.low) + 1.0))
        low, _high = self.stack.reach(axis)
        for top, bottom in without((self.y(self.high) - OUT, self.y(low) + OUT), hidden):
            yield np.array([(x, bottom), (x, top)])

    def _captions(self, left: float) -> Iterator[Caption]:
        """The names of axes above, of plates on them, the numbers of layers on the left."""
        for x, axis in zip(self.x, self.axes, strict=True):
            yield Caption(self.names[axis.solid.name], (x, self.y(self.high) - OUT - 10.0), "axis")
        for text in self.texts:
            bar = text.piece.bar
            start, end = self._box(text)
            yield Caption(
                self.names[bar.name], (0.5 * (start + end), 0.5 * (self.y(bar.low) + self.y(bar.high))), "plate"
            )
        layers = self.stack.cut.layers.layer
        for layer in sorted(set(layers.values())):
            ends = [each for plate, own in layers.items() if own == layer for each in self.stack.height(plate)]
            yield Caption(str(layer), (left - 30.0, 0.5 * (self.y(min(ends)) + self.y(max(ends)))), "layer")

    def _box(self, text: _Text) -> Span:
        """From where to where the name of a plate is."""
        wide, gap = self._wide(text.piece.bar.name), text.gap
        if text.inside:
            start = self.x[gap - 1] + self._through(text.piece.bar, gap - 1)
            end = self.x[gap] - self._through(text.piece.bar, gap)
            middle = 0.5 * (start + end)
        else:
            left, right = self._in_gap(text.piece, gap)
            on_the_right = gap > text.piece.first
            middle = self.x[gap - 1] + left + ROOM + 0.5 * wide if on_the_right else 0.0
            middle = middle if on_the_right else self.x[gap] - right - ROOM - 0.5 * wide
        return middle - 0.5 * wide - 3.0, middle + 0.5 * wide + 3.0


def without(span: Span, holes: Iterable[Span]) -> list[Span]:
    """What is left of an interval without others."""
    found, start = [], span[0]
    for low, high in sorted(holes):
        if low > start:
            found.append((start, min(low, span[1])))
        start = max(start, high)
    return [each for each in [*found, (start, span[1])] if each[1] > each[0]]


def _meets(bar: Bar, heights: Span) -> bool:
    return bar.low < heights[1] - 1e-9 and heights[0] < bar.high - 1e-9


def _rectangle(span: Span, bottom: float, top: float) -> Floats:
    return np.array([(span[0], bottom), (span[0], top), (span[1], top), (span[1], bottom)])


def _side(x: float, start: float, end: float, broken: bool) -> Iterator[Vec]:
    """The end of a plate: a line, or a wave where it is broken off."""
    if not broken:
        yield from ((x, start), (x, end))
        return
    for share in np.linspace(0.0, 1.0, 13).tolist():
        yield x + WAVE * float(np.sin(2 * np.pi * share)), start + share * (end - start)
