"""Names placed so that they cover neither each other nor lines.

Every label has candidate places round its anchor. The cost of a place is the ink under it, the labels under it, its
distance and a small preference. Labels are placed one after the other and then moved while that lowers the cost.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from linkwright.core.arrays import Flags, Floats, Integers
from linkwright.pictures.picture import (
    CAPITAL,
    TEXT,
    Picture,
    Runs,
    SvgNode,
    Text,
    Vec,
    indexed,
    line_width,
    name_runs,
)
from linkwright.pictures.svg import element, number
from linkwright.pictures.symbols.arrows import BEHIND, NARROW
from linkwright.pictures.symbols.base import vec, way

_STEPS = (0.0, 5.0, 11.0, 19.0, 30.0, 44.0)
_WAYS = tuple((math.cos(a), math.sin(a)) for a in np.radians(np.arange(-45, 315, 22.5)))
LEADER = 16.0
#: Where over its line a text may stand, its gap to the line, and what it costs to stand elsewhere.
_SHARES = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8)
_CLOSE, _MAX_DISTANCE = 2.5, 60.0


@dataclass(frozen=True)
class Label:
    """A name for one of the places ``anchors``, the first liked best; ``clearance`` keeps it off the symbol there.

    ``point``: the point that is named, as ``link.point``; ``index``: a small text behind and below; ``along``: a
    line, from its start to its end, over which the name is written in its direction.
    """

    text: str
    anchors: tuple[Vec, ...]
    style: str = "lw-name"
    size: float = 14.0
    clearance: float = 7.0
    leader: bool = True
    point: str = ""
    index: str = ""
    along: tuple[Vec, Vec] | None = None

    @property
    def extent(self) -> Vec:
        """Width and height of the text."""
        return line_width(self.runs, self.size), (0.95 + self.drop) * self.size

    @property
    def runs(self) -> Runs:
        """The text with its index."""
        return indexed(self.text, self.index) if self.index else name_runs(self.text)

    @property
    def drop(self) -> float:
        """How far an index hangs below the line, in sizes."""
        return 0.18 if len(self.runs) > 1 else 0.0


Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class Candidate:
    """A box (left, top, right, bottom) for a label, its own cost, and the anchor it belongs to.

    ``turned``: the text's direction on the paper, degrees clockwise; a text across its box is in the smaller boxes
    ``parts``.
    """

    box: Box
    dislike: float
    anchor: Vec
    gap: float
    turned: float = 0.0
    parts: tuple[Box, ...] = ()


@dataclass
class Obstacles:
    """Segments (m, 4) that labels avoid."""

    segments: Floats = field(default_factory=lambda: np.zeros((0, 4)))

    @staticmethod
    def of(polylines: Sequence[Floats]) -> Obstacles:
        """The segments of polylines; rows of NaN break them."""
        rows = [np.hstack([line[:-1], line[1:]]) for line in polylines if len(line) > 1]
        segments = np.concatenate([*rows, np.zeros((0, 4))])
        return Obstacles(segments[np.isfinite(segments).all(axis=1)])

    def under(self, boxes: Floats) -> Floats:
        """Length of ink in every box (k, 4), by clipping each segment to it."""
        near = self.segments[self._adjacent(boxes)]
        lows, highs = np.minimum(near[:, :2], near[:, 2:]), np.maximum(near[:, :2], near[:, 2:])
        may = (highs[:, 0] >= boxes[:, :1]) & (lows[:, 0] <= boxes[:, 2:3])
        may &= (highs[:, 1] >= boxes[:, 1:2]) & (lows[:, 1] <= boxes[:, 3:])
        rows, which = np.nonzero(may)
        start, way = near[which, :2], near[which, 2:] - near[which, :2]
        low, high = boxes[rows, :2], boxes[rows, 2:]
        with np.errstate(all="ignore"):
            a, b = (low - start) / way, (high - start) / way
            inside = (start >= low) & (start <= high)
            first = np.where(way == 0, np.where(inside, -np.inf, np.inf), np.minimum(a, b)).max(axis=1)
            last = np.where(way == 0, np.where(inside, np.inf, -np.inf), np.maximum(a, b)).min(axis=1)
        share = np.clip(np.minimum(last, 1.0) - np.maximum(first, 0.0), 0.0, None)
        touched = share > 0
        length = share * np.hypot(way[:, 0], way[:, 1]) + 4.0 * touched
        return np.asarray(np.bincount(rows, length, len(boxes)), dtype=float)

    def _adjacent(self, boxes: Floats) -> Flags:
        """Which segments (m,) may touch one of the boxes: those whose own boxes touch the box of all."""
        one, other = self.segments[:, :2], self.segments[:, 2:]
        low, high = boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)
        return np.asarray(((np.maximum(one, other) >= low) & (np.minimum(one, other) <= high)).all(axis=1))


def candidates(label: Label) -> list[Candidate]:
    """Places for a label: over its line, or round each of its anchors, the nearest first."""
    width, height = label.extent
    found = list(_over(label))
    for order, (x, y) in enumerate(label.anchors):
        for step in _STEPS:
            for dx, dy in _WAYS:
                gap = label.clearance + step
                centre = (x + dx * (gap + width / 2 * abs(dx)), y + dy * (gap + height / 2 * abs(dy)))
                liking = 0.6 * (dx < 0.2) + 0.6 * (dy > 0.2) + (_MAX_DISTANCE if label.along else 0.0)
                found.append(Candidate(_box(centre, width, height), 0.45 * step + liking + 1.5 * order, (x, y), step))
    return found


def _over(label: Label) -> Iterator[Candidate]:
    """Places over a label's line or under it, in its direction, to be read from below or from the right; behind its
    ends where it is too short for heads between them."""
    if label.along is None:
        return
    (width, height), (start, end) = label.extent, np.array(label.along)
    length, direct = way(start, end)
    along = np.array(direct)
    forwards = along[1] < 0 if abs(along[0]) < 1e-6 else along[0] > 0
    up = np.array([along[1], -along[0]]) * (1.0 if forwards else -1.0)
    for share in _SHARES:
        beyond = max(0.0, width / 2 - length * min(share, 1.0 - share))
        if beyond and share != 0.5:
            continue
        for side in (1.0, -1.0):
            middle = start + share * length * along + side * (height / 2 + _CLOSE) * up
            yield _turned(label, middle, up, 20.0 * abs(share - 0.5) + 0.1 * beyond + 2.0 * (side < 0))
    if length <= NARROW:
        for place in (-BEHIND - _CLOSE - width / 2, length + BEHIND + _CLOSE + width / 2):
            yield _turned(label, start + place * along, up, 3.0)


def _turned(label: Label, middle: Floats, up: Floats, dislike: float) -> Candidate:
    """A place for a text whose letters stand ``up`` on the paper."""
    (width, height), along = label.extent, np.array([-up[1], up[0]])
    square = height / float(np.abs(along).sum())
    count = math.ceil(width / square)
    places = middle + np.linspace(-0.5, 0.5, count)[:, None] * max(width - square, 0.0) * along
    parts = tuple(_box(vec(place), square, square) for place in places)
    corners = np.array(parts)
    box = vec(corners[:, :2].min(axis=0)) + vec(corners[:, 2:].max(axis=0))
    return Candidate(box, dislike, vec(middle), 0.0, math.degrees(math.atan2(along[1], along[0])), parts)


def _box(centre: Vec, width: float, height: float) -> Box:
    x, y = centre
    return (x - width / 2, y - height / 2, x + width / 2, y + height / 2)


def place(labels: Sequence[Label], obstacles: Obstacles) -> list[Candidate]:
    """The chosen place of every label."""
    return place_moving(labels, [(obstacles, np.zeros((len(labels), 2)))])


def place_moving(labels: Sequence[Label], frames: Sequence[tuple[Obstacles, Floats]]) -> list[Candidate]:
    """The chosen place of every label at the first frame, for labels that move with their points.

    ``frames``: the obstacles of each frame, and how far every label (k, 2) has moved since the first.
    """
    options = [candidates(label) for label in labels]
    covered = [Covered.of(some) for some in options]
    margin = np.array([-2.0, -1.0, 2.0, 1.0])
    own: list[Floats] = []
    for k, (cover, some) in enumerate(zip(covered, options, strict=True)):
        under = [obstacles.under(cover.boxes + margin + np.tile(shift[k], 2)) for obstacles, shift in frames]
        own.append(1.6 * cover.summed(np.mean(under, axis=0)) + [each.dislike for each in some])
    return [options[k][c] for k, c in enumerate(_settled(covered, own))]


@dataclass(frozen=True)
class Covered:
    """What the candidates of a label cover: boxes (m, 4), and where those of each candidate begin."""

    boxes: Floats
    begins: Integers

    @staticmethod
    def of(some: Sequence[Candidate]) -> Covered:
        parts = [each.parts or (each.box,) for each in some]
        begins = np.cumsum([0, *map(len, parts)])
        return Covered(np.array([box for each in parts for box in each]), begins)

    def one(self, candidate: int) -> Floats:
        """The boxes of one candidate."""
        return self.boxes[self.begins[candidate] : self.begins[candidate + 1]]

    def summed(self, values: Floats) -> Floats:
        """A sum for every candidate of values of its boxes."""
        return np.asarray(np.add.reduceat(values, self.begins[:-1]))


def _settled(covered: Sequence[Covered], own: Sequence[Floats], rounds: int = 4) -> list[int]:
    """Which place every label takes: one after the other, then each anew while that changes anything."""
    chosen = [-1] * len(covered)
    order = sorted(range(len(covered)), key=lambda k: -float(own[k].min()))
    meeting = _meeting(covered)
    for _ in range(rounds):
        before = list(chosen)
        for k in order:
            taken = [covered[i].one(chosen[i]) for i in meeting[k] if chosen[i] >= 0]
            shared = _overlap(covered[k].boxes, np.concatenate([*taken, np.zeros((0, 4))]))
            chosen[k] = int(np.argmin(own[k] + 3.0 * covered[k].summed(shared)))
        if chosen == before:
            break
    return chosen


def _meeting(covered: Sequence[Covered]) -> list[list[int]]:
    """Of every label the others of which some place may overlap with one of its own."""
    if not covered:
        return []
    low = np.array([each.boxes[:, :2].min(axis=0) for each in covered]) - _HAIR
    high = np.array([each.boxes[:, 2:].max(axis=0) for each in covered])
    meets = [((high >= low[k]) & (low <= high[k])).all(axis=1) for k in range(len(covered))]
    return [[i for i in np.flatnonzero(row).tolist() if i != k] for k, row in enumerate(meets)]


#: By how much overlapping boxes are grown, across and down.
_HAIR = np.array([4.0, 2.0])


def _overlap(boxes: Floats, others: Floats) -> Floats:
    """Area (k,) that boxes share with others, each grown by a hair's breadth."""
    if not len(others):
        return np.zeros(len(boxes))
    a, b = boxes[:, None, :], others[None, :, :]
    wide = np.minimum(a[..., 2], b[..., 2]) - np.maximum(a[..., 0], b[..., 0]) + _HAIR[0]
    high = np.minimum(a[..., 3], b[..., 3]) - np.maximum(a[..., 1], b[..., 1]) + _HAIR[1]
    shared: Floats = np.where((wide > 0) & (high > 0), wide * high, 0.0)
    return np.asarray(shared.sum(axis=1))


def text_of(label: Label, chosen: Candidate) -> Text:
    """The text at its place, before it is turned."""
    left, top, right, bottom = chosen.box
    baseline = 0.5 * (top + bottom + label.extent[1]) - (0.14 + label.drop) * label.size
    return Text((0.5 * (left + right), baseline), label.runs, label.style, label.size, "middle")


def written(label: Label, chosen: Candidate) -> list[SvgNode]:
    """The text at its place, with a leader where it is far off."""
    left, top, right, bottom = chosen.box
    found = []
    if label.leader and chosen.gap > LEADER:
        x = min(max(chosen.anchor[0], left), right)
        y = min(max(chosen.anchor[1], top), bottom)
        dx, dy = chosen.anchor[0] - x, chosen.anchor[1] - y
        share = label.clearance / (math.hypot(dx, dy) or 1.0)
        end = (chosen.anchor[0] - share * dx, chosen.anchor[1] - share * dy)
        found.append(element("line", {"class": "lw-leader", "x1": x, "y1": y, "x2": end[0], "y2": end[1]}))
    text = text_of(label, chosen)
    if chosen.turned:
        turn = " ".join(map(number, (chosen.turned, (left + right) / 2, (top + bottom) / 2)))
        return [*found, element("g", {"transform": f"rotate({turn})"}, text)]
    return [*found, text]


#: Millimetres of paper per unit in which symbols and labels are laid out: a pin of 10 units is 3 mm wide.
UNIT = 0.3
#: To units of symbols, whose y is down.
TO_UNITS = np.array([1.0, -1.0]) / UNIT


@dataclass(frozen=True)
class Name:
    """A text for the best of some places (mm); ``runs`` with its indices; ``clear``: distance from the place, mm.

    ``leader``: whether a line leads to a place that is far off; ``symbol``: set in italics.
    """

    runs: Runs
    places: Sequence[Floats]
    height: float = TEXT
    clear: float = 1.5
    leader: bool = False
    symbol: bool = False


def put(picture: Picture, names: Iterable[Name], *, more: Iterable[Floats] = ()) -> None:
    """Writes names on a picture, clear of its lines, its texts and ``more`` polylines (k, 2), mm."""
    wanted = list(names)
    labels = [_label(each) for each in wanted]
    ink = [line * TO_UNITS for line in (*(item.outline for item in picture.items), *more)]
    for name, label, chosen in zip(wanted, labels, place(labels, Obstacles.of(ink)), strict=True):
        at = np.array([chosen.box[0], text_of(label, chosen).at[1]]) / TO_UNITS
        if name.leader and chosen.gap > 16.0:
            _lead(picture, chosen.box, chosen.anchor)
        picture.text(at, name.runs, name.height, symbol=name.symbol)


def _lead(picture: Picture, box: tuple[float, float, float, float], anchor: tuple[float, float]) -> None:
    left, top, right, bottom = box
    start = np.clip(anchor, (left, top), (right, bottom))
    picture.line(np.array([start, anchor]) / TO_UNITS)


def _label(name: Name) -> Label:
    stem = "".join(text for text, level in name.runs if level == 0)
    index = max((text for text, level in name.runs if level), key=len, default="")
    places = tuple(vec(np.asarray(at) * TO_UNITS) for at in name.places)
    size = name.height / CAPITAL / UNIT
    return Label(stem, places, size=size, clearance=name.clear / UNIT, index=index)
