"""Placing labels so that they cover neither each other nor lines.

Every label has candidate places round its anchor. The cost of a place is the ink under it, the labels under it, its
distance and a small preference. Labels are placed one after the other and then moved while that lowers the cost.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import field

import numpy as np

from linkwright.core.arrays import Flags, Floats, Whole
from linkwright.core.dataclass import dataclass
from linkwright.pictures.picture import SvgNode, Vec
from linkwright.pictures.svg.element import element, number
from linkwright.pictures.svg.text import name_width, split_index, text_element
from linkwright.pictures.symbols.arrows import BEHIND, NARROW
from linkwright.pictures.symbols.base import points, vec, way
from linkwright.plot.drawing.machine import Machine, flat
from linkwright.plot.drawing.scene import Scene
from linkwright.plot.drawing.view import moved

_STEPS = (0.0, 5.0, 11.0, 19.0, 30.0, 44.0)
_WAYS = tuple((math.cos(a), math.sin(a)) for a in np.radians(np.arange(-45, 315, 22.5)))
LEADER = 16.0
#: Where over its line a text may stand, its gap to the line, and what it costs to stand elsewhere.
_SHARES = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8)
_CLOSE, _APART = 2.5, 60.0


@dataclass(frozen=True)
class Label:
    """A text for one of the places ``anchors``, the first liked best; ``clearance`` keeps it off the symbol there.

    ``point``: the point that is named, as ``link.point``; ``index``: a small text behind and below; ``along``: a
    line, from its start to its end, over which the text is written in its direction.
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
        return name_width(self.text, self.size, self.index), (0.95 + self.drop) * self.size

    @property
    def drop(self) -> float:
        """How far an index hangs below the line, in sizes."""
        return 0.18 if self.index or split_index(self.text)[1] else 0.0


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
        near = self.segments[self._beside(boxes)]
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

    def _beside(self, boxes: Floats) -> Flags:
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
                liking = 0.6 * (dx < 0.2) + 0.6 * (dy > 0.2) + (_APART if label.along else 0.0)
                found.append(
                    Candidate(_box(centre, width, height), 0.45 * step + liking + 1.5 * order, (x, y), step)
                )
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
    begins: Whole

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


def written(label: Label, chosen: Candidate) -> list[SvgNode]:
    """The text at its place, with a leader where it stands far off."""
    left, top, right, bottom = chosen.box
    found = []
    if label.leader and chosen.gap > LEADER:
        x = min(max(chosen.anchor[0], left), right)
        y = min(max(chosen.anchor[1], top), bottom)
        dx, dy = chosen.anchor[0] - x, chosen.anchor[1] - y
        share = label.clearance / (math.hypot(dx, dy) or 1.0)
        end = (chosen.anchor[0] - share * dx, chosen.anchor[1] - share * dy)
        found.append(element("line", {"class": "lw-leader", "x1": x, "y1": y, "x2": end[0], "y2": end[1]}))
    middle, level = (left + right) / 2, (top + bottom) / 2
    baseline = level + 0.5 * label.extent[1] - (0.14 + label.drop) * label.size
    text = text_element(middle, baseline, label.text, label.style, label.size, "middle", index=label.index)
    if chosen.turned:
        turn = " ".join(map(number, (chosen.turned, middle, level)))
        text = element("g", {"transform": f"rotate({turn})"}, text)
    return [*found, text]


LINK_SIZE = 12.0


def point_labels(machine: Machine, index: int) -> Iterator[Label]:
    """Names of all pins and points at one position."""
    seen: set[tuple[str, float, float]] = set()
    for link in machine.motion.mechanism.links.values():
        for point in link.points:
            x, y = machine.paper(link.name, point, index)
            key = (point, round(x), round(y))
            if key not in seen:
                seen.add(key)
                yield Label(point, ((x, y),), clearance=8.0, point=f"{link.name}.{point}")


def link_labels(scene: Scene, index: int) -> Iterator[Label]:
    """Names of all moving links, beside their bodies."""
    machine = scene.machine
    for name in machine.motion.mechanism.links:
        cloud = machine.cloud(name)
        if len(cloud) < 2:
            cloud = _middle_of_ink(scene, name, cloud)
        cloud = moved(cloud, machine.view.transform(machine.placed[name], index))
        yield Label(name, _anchors(cloud), "lw-link", LINK_SIZE, clearance=5.0)


def _middle_of_ink(scene: Scene, link: str, cloud: Floats) -> Floats:
    """The middle of what is drawn of a link that has one point only."""
    layers = ("blocks", "bodies")
    ink = [line for layer in layers for p in scene.parts if p.carrier == link and p.layer == layer
           for line in p.shape.ink]  # fmt: skip
    if not ink:
        return cloud
    everything = np.concatenate(ink)
    return points([(everything.min(axis=0) + everything.max(axis=0)) / 2])


def _anchors(cloud: Floats) -> tuple[Vec, ...]:
    ends = flat(cloud)
    if ends is None:
        sides = (cloud + np.roll(cloud, 1, axis=0)) / 2
        return (vec(cloud.mean(axis=0)), *map(vec, sides))
    if len(ends) == 1 or np.hypot(*(ends[1] - ends[0])) < 1.0:
        return (vec(cloud[0]),)
    return tuple(vec(ends[0] + share * (ends[1] - ends[0])) for share in (0.5, 0.38, 0.62, 0.27, 0.73))
