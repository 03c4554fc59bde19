"""The side view of a machine: a section through all its pins, developed into one plane, heights to scale."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.fabrication.bodies import colours, link_poses
from linkwright.fabrication.columns import Piece
from linkwright.fabrication.cut_parts import CutParts
from linkwright.fabrication.stack import Axis, Stack, across
from linkwright.kinematics.motion import Motion
from linkwright.pictures.drawing import Sketch
from linkwright.pictures.picture import Line, line_width, name_runs
from linkwright.pictures.svg import element, path_data
from linkwright.solids.solid import Solid

#: Units of the paper: of the thinnest plate, of the whole height at most; sizes of letters; room between names and
#: what is next to them; smallest gap between axes; largest width of a plate to one side of a pin.
THIN, HIGH, LETTERS, ROOM, GAP, HALF = 20.0, 620.0, 12.0, 9.0, 54.0, 46.0
#: Distance between the lines of a hatching, how far axes stand out, how far a broken plate goes on behind its end,
#: the depth of the wave there.
HATCH, OUT, BROKEN, WAVE = 7.0, 14.0, 12.0, 2.4
CSS = (
    ".lw-cut{stroke:#1c2733;stroke-width:1.4;stroke-linejoin:round}.lw-hatching{fill:none;stroke:#1c2733;"
    "stroke-width:.6;stroke-opacity:.75}.lw-shaft{fill:#fff;stroke:#1c2733;stroke-width:1.4;stroke-linejoin:round}"
    ".lw-ring{fill:#f1ebe0;stroke:#1c2733;stroke-width:1}.lw-break{fill:none;stroke:#1c2733;stroke-width:.8}"
    ".lw-centre{fill:none;stroke:#5b6672;stroke-width:.9;stroke-dasharray:12 3 2 3}"
    ".lw-level{fill:none;stroke:#9aa4ae;stroke-width:.7;stroke-dasharray:2 4}"
)


def side_view(cut: CutParts, motion: Motion) -> Sketch:
    """The section of a machine through its pins; from left to right about as they are at the first position."""
    return _View(Stack(cut, link_poses(motion, 0))).drawn()


@dataclass(frozen=True)
class _Text:
    """The name of a piece of a plate in the gap behind a place in the order: inside it, or next to its end."""

    piece: Piece
    gap: int
    inside: bool


class _View:
    """A section in the making: the axes at their places on the paper, heights to scale."""

    def __init__(self, stack: Stack) -> None:
        self.stack = stack
        self.development = stack.development()
        self.axes = [stack.axes[k] for k in self.development.order]
        self.pieces = list(self.development.pieces())
        heights = [part.length for part in stack.plates.values()]
        reach = [stack.reach(axis) for axis in self.axes]
        self.low, self.high = min(low for low, _ in reach), max(high for _, high in reach)
        self.scale = min(THIN / min(heights), HIGH / (self.high - self.low))
        self.colours = colours(stack.cut)
        self.gaps = [GAP] * (len(self.axes) + 1)
        self.texts = self._texts()
        self.x = np.cumsum([0.0, *self.gaps[1:-1]]).tolist()

    def y(self, height: float) -> float:
        """The place of a height on the paper."""
        return -self.scale * height

    def half(self, piece: Piece, place: int) -> float:
        """How far a plate goes on behind an axis at its end, on the paper."""
        axis = self.axes[place]
        if piece.bar.name not in axis.plates:
            return HALF
        wide = self.scale * self.stack.half_width(piece.bar.name, axis)
        return max(min(HALF, wide), self.shaft(axis) + 7.0)

    def shaft(self, axis: Axis) -> float:
        """Half the width of the pin or block on an axis, on the paper."""
        wide = [self.scale * across(block) for block in axis.blocks]
        return max([*wide, self.radius(axis)])

    def radius(self, axis: Axis) -> float:
        """The radius of a pin on the paper; 0 of other axes."""
        return self.scale * axis.solid.shape.pieces[0].radius if axis.solid.sort in ("pin", "post") else 0.0

    def _widest(self, place: int) -> float:
        """How far all that is on an axis reaches to its sides."""
        axis = self.axes[place]
        rings = [self.scale * 0.5 * ring.diameter for ring in axis.rings]
        head = self.scale * axis.solid.head if axis.solid.sort == "pin" else 0.0
        return max([self.shaft(axis), head, *rings])

    def _texts(self) -> list[_Text]:
        """Where names are written; gaps are made wide enough for them and for what lies in them."""
        ends = self._ends()
        for gap in range(1, len(self.axes)):
            names = [self._wide(self.axes[k].solid.name) for k in (gap - 1, gap)]
            self.gaps[gap] = max(GAP, ends[gap - 1][1] + ends[gap][0] + ROOM, 0.5 * sum(names) + ROOM)
        found: list[_Text] = []
        for piece in sorted(self.pieces, key=lambda each: each.last - each.first or len(self.axes)):
            wide = self._wide(piece.bar.name) + 2.0 * ROOM
            inside = range(piece.first + 1, piece.last + 1)
            if inside:
                gap = self._widest_gap(inside, wide)
                wide += self.shaft(self.axes[gap - 1]) + self.shaft(self.axes[gap])
            else:
                gap = self._next_to(piece, found)
                wide += sum(self._in_gap(piece, gap))
            self.gaps[gap] = max(self.gaps[gap], wide)
            found.append(_Text(piece, gap, bool(inside)))
        return found

    def _widest_gap(self, inside: range, wide: float) -> int:
        """The middle one of the gaps that are wide enough for a name between any axes, else the widest one."""
        room = {k: self.gaps[k] - self.shaft(self.axes[k - 1]) - self.shaft(self.axes[k]) for k in inside}
        middle = 0.5 * (inside[0] + inside[-1])
        return max(inside, key=lambda k: (min(room[k], wide), -abs(k - middle)))

    def _wide(self, name: str) -> float:
        """The width of a name."""
        return line_width(name_runs(name), LETTERS)

    def _ends(self) -> list[list[float]]:
        """How far everything reaches to the left and to the right of every axis in the gaps."""
        found = [[self._widest(k)] * 2 for k in range(len(self.axes))]
        for piece in self.pieces:
            left = self.half(piece, piece.first) + BROKEN * piece.broken_left
            right = self.half(piece, piece.last) + BROKEN * piece.broken_right
            found[piece.first][0] = max(found[piece.first][0], left)
            found[piece.last][1] = max(found[piece.last][1], right)
        return found

    def _next_to(self, piece: Piece, texts: Sequence[_Text]) -> int:
        """The gap next to a plate with one axis in which nothing else is at its height, the right one if both."""
        for gap in (piece.first + 1, piece.first):
            taken = any(
                each.first < gap <= each.last
                for each in self.pieces
                if each is not piece and each.bar.meets(piece.bar)
            )
            named = any(text.gap == gap and not text.inside and text.piece.bar.meets(piece.bar) for text in texts)
            if not taken and not named:
                return gap
        return piece.first + 1

    def _in_gap(self, piece: Piece, gap: int) -> list[float]:
        """How far plates at the height of a piece reach into a gap from both sides."""
        found = []
        for place, right in ((gap - 1, True), (gap, False)):
            ends = [0.0]
            for each in self.pieces:
                if each.bar.meets(piece.bar) and place == (each.last if right else each.first):
                    ends.append(self.half(each, place) + BROKEN * (each.broken_right if right else each.broken_left))
            column = self.development.columns[self.development.order[place]] if 0 <= place < len(self.axes) else None
            if column is not None and piece.bar.meets(column):
                ends.append(self._widest(place))
            found.append(max(ends))
        return found

    def drawn(self) -> Sketch:
        """The whole view."""
        paper = Sketch()
        paper.content.append(element("style", None, CSS))
        for x, axis in zip(self.x, self.axes, strict=True):
            top = self.y(self.high) - OUT
            paper.line([(x, self.y(self.stack.reach(axis)[0])), (x, top)], "lw-centre")
            paper.text((x, top - 6.0), name_runs(axis.solid.name), "lw-name", LETTERS, "middle")
        for piece in self.pieces:
            self._plate(paper, piece)
        for x, axis in zip(self.x, self.axes, strict=True):
            self._axis(paper, x, axis)
        for text in self.texts:
            self._name(paper, text)
        self._levels(paper)
        return paper

    def _plate(self, paper: Sketch, piece: Piece) -> None:
        left = self.x[piece.first] - self.half(piece, piece.first) - BROKEN * piece.broken_left
        right = self.x[piece.last] + self.half(piece, piece.last) + BROKEN * piece.broken_right
        bottom, top = self.y(piece.bar.low), self.y(piece.bar.high)
        names = list(self.stack.plates)
        slope = 1.0 if names.index(piece.bar.name) % 2 else -1.0
        outline = [*_side(left, bottom, top, piece.broken_left), *_side(right, top, bottom, piece.broken_right)]
        _cut(paper, np.array(outline), self.colours[piece.bar.name], slope, WAVE if len(outline) > 4 else 0.0)

    def _axis(self, paper: Sketch, x: float, axis: Axis) -> None:
        """Blocks, washers and the pin on an axis, and its line."""
        low, high = self.stack.reach(axis)
        for block in axis.blocks:
            ends = self._block(block)
            half = self.scale * across(block)
            colour = self.colours.get(block.name, "#cfd6de")
            _cut(paper, _rectangle(x, half, self.y(ends[0]), self.y(ends[1])), colour, 1.0)
        for ring in axis.rings:
            for place in ring.places:
                if place.on == axis.solid.name:
                    z = self.y(place.z), self.y(place.z + ring.length)
                    paper.line(_rectangle(x, 0.5 * self.scale * ring.diameter, *z), "lw-ring", closed=True)
        if axis.solid.sort in ("pin", "post"):
            paper.line(self._shaft(x, axis), "lw-shaft", closed=True)
        paper.line([(x, self.y(low) + OUT), (x, self.y(high) - OUT)], "lw-centre")

    def _block(self, block: Solid) -> tuple[float, float]:
        """Between which heights a block is."""
        ends = [self.stack.height(plate) for plate in block.plates]
        return min(low for low, _ in ends), max(high for _, high in ends)

    def _shaft(self, x: float, axis: Axis) -> Floats:
        """The outline of a pin with its heads."""
        if axis.pin is None:
            return _rectangle(x, self.radius(axis), *map(self.y, self.stack.reach(axis)))
        z, steps = axis.pin.places[0].z, []
        for prism in axis.pin.prisms():
            radius = self.scale * prism.shape.pieces[0].radius
            steps += [(radius, self.y(z + prism.low)), (radius, self.y(z + prism.high))]
        return np.array([(x + dx, y) for dx, y in steps] + [(x - dx, y) for dx, y in reversed(steps)])

    def _name(self, paper: Sketch, text: _Text) -> None:
        """The name of a plate: on it where the hatching leaves room, else next to its end."""
        bar = text.piece.bar
        wide = self._wide(bar.name)
        y = 0.5 * (self.y(bar.low) + self.y(bar.high))
        if text.inside:
            one, other = self.axes[text.gap - 1], self.axes[text.gap]
            x = 0.5 * (self.x[text.gap - 1] + self.shaft(one) + self.x[text.gap] - self.shaft(other))
            box = {"x": x - 0.5 * wide - 3.0, "y": y - 7.5, "width": wide + 6.0, "height": 15.0}
            paper.content.append(element("rect", {"fill": _pale(self.colours[bar.name]), **box}))
        else:
            left, right = self._in_gap(text.piece, text.gap)
            x = (
                self.x[text.gap - 1] + left + ROOM + 0.5 * wide
                if text.gap > text.piece.first
                else (self.x[text.gap] - right - ROOM - 0.5 * wide)
            )
        paper.text((x, y + 4.3), name_runs(bar.name), "lw-legend", LETTERS, "middle")

    def _levels(self, paper: Sketch) -> None:
        """The numbers of the layers on the left, the height of the machine on the right."""
        left, _top, right, _bottom = paper.box
        layers = self.stack.cut.layers
        for layer in sorted(set(layers.layer.values())):
            ends = [self.stack.height(plate) for plate, own in layers.layer.items() if own == layer]
            low, high = min(low for low, _ in ends), max(high for _, high in ends)
            y = 0.5 * (self.y(low) + self.y(high))
            paper.circle((left - 26.0, y), 9.0, "lw-shaft")
            paper.text((left - 26.0, y + 4.2), str(layer), "lw-legend", LETTERS, "middle")
            paper.line([(left - 15.0, y), (left - 4.0, y)], "lw-level")
        x = right + 30.0
        for height in (self.low, self.high):
            paper.line([(right + 6.0, self.y(height)), (x + 6.0, self.y(height))], "lw-dimension")
        paper.dimension((x, self.y(self.low)), (x, self.y(self.high)), shown(self.high - self.low, "length", 4))


def _rectangle(x: float, half: float, bottom: float, top: float) -> Floats:
    return np.array([(x - half, bottom), (x - half, top), (x + half, top), (x + half, bottom)])


def _side(x: float, start: float, end: float, broken: bool) -> Iterator[tuple[float, float]]:
    """The end of a plate: a line, or a wave where it is broken off."""
    if not broken:
        yield from ((x, start), (x, end))
        return
    for share in np.linspace(0.0, 1.0, 13):
        yield x + WAVE * np.sin(2 * np.pi * share), start + share * (end - start)


def _cut(paper: Sketch, outline: Floats, colour: str, slope: float, wave: float = 0.0) -> None:
    """A face in section: pale in its colour, hatched at 45 degrees within the straight part of its outline."""
    paper.draw(
        [element("path", {"class": "lw-cut", "fill": _pale(colour), "d": path_data(outline, closed=True)})],
        [np.vstack([outline, outline[:1]])],
    )
    inset = np.array([wave, 0.0])
    straight = np.array([outline.min(axis=0) + inset, outline.max(axis=0) - inset])
    paper.draw([Line(_hatching(straight, slope), "lw-hatching")])


def _hatching(outline: Floats, slope: float) -> Floats:
    """Lines at 45 degrees within the box of an outline, parted by rows of NaN."""
    (left, top), (right, bottom) = outline.min(axis=0), outline.max(axis=0)
    rows: list[tuple[float, float]] = []
    for c in np.arange(left - (bottom - top), right, HATCH) + HATCH:
        low, high = max(c, left), min(c + bottom - top, right)
        if high > low:
            ends = [(low, bottom - (low - c)), (high, bottom - (high - c))]
            rows += [(x, y if slope > 0 else top + bottom - y) for x, y in ends] + [(np.nan, np.nan)]
    return np.array(rows).reshape(-1, 2)


def _pale(colour: str, share: float = 0.55) -> str:
    """A colour on its way to white."""
    return "#" + "".join(f"{round(255 - share * (255 - int(colour[k : k + 2], 16))):02x}" for k in (1, 3, 5))
