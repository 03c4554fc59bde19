"""Where arrows and arcs stand on a link: to scale, on their lines of action, clear of the link and of each other."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.pictures.labels import Label
from linkwright.pictures.picture import Line, SvgNode
from linkwright.pictures.svg.element import group
from linkwright.pictures.symbols.base import SYMBOLS, points, vec
from linkwright.plot.drawing.machine import View
from linkwright.plot.drawing.vectors import NAME_SIZE
from linkwright.plot.free_bodies.actions import STYLES, Action

#: Printed width of a unit of the paper, mm.
MILLIMETRE = 0.25
#: Arrows shorter than SHORT mm are drawn STUB mm long and dashed.
SHORT, STUB = 2.5, 4.0
#: How far an arrow's point keeps from the place on which it presses, and how far it may be moved along its line.
GAP, MOVES = 6.0, (0.0, 42.0, 84.0, 126.0)
#: Nearer than this two lines cover each other; the part of an arrow next to its place does not count.
NEAR, FREE = 6.0, 12.0
#: Radius of the first arc at a place, and of the next ones.
RADIUS, WIDER = 17.0, 8.0


@dataclass(frozen=True)
class Arrow:
    """The arrow of a force on the paper: foot and point, (2,) units; ``to_scale``: whether its length is the force's.

    ``place``: where the force acts.
    """

    action: Action
    foot: Floats
    point: Floats
    place: Floats
    to_scale: bool

    @property
    def elements(self) -> tuple[SvgNode, ...]:
        """The arrow with its line of action up to its place, where it stands apart from that."""
        style = STYLES[self.action.role]
        shown = SYMBOLS["arrow"](start=vec(self.foot), end=vec(self.point), style=style).elements
        arrow = group(shown, None if self.to_scale else "lw-short", **{"data-action": self.action.symbol})
        near = min((self.foot, self.point), key=lambda end: math.dist(end, self.place))
        if math.dist(near, self.place) < 2 * GAP:
            return (arrow,)
        return Line(points([near, self.place]), "lw-leader"), arrow

    @property
    def ink(self) -> Floats:
        """Foot and point, (2, 2)."""
        return np.array([self.foot, self.point])

    @property
    def label(self) -> Label:
        """Its symbol, at its free end or along it."""
        ends = sorted((self.foot, self.point), key=lambda end: -math.dist(end, self.place))
        places = tuple(vec(ends[0] + share * (ends[1] - ends[0])) for share in (0.0, 0.25, 0.5, 0.75))
        return _label(self.action, places, 5.0)


def _label(action: Action, places: tuple[tuple[float, float], ...], clear: float) -> Label:
    style = f"{STYLES[action.role]}-name"
    return Label(action.letter, places, style, NAME_SIZE, clear, index=action.index)


def arranged(actions: Sequence[Action], view: View, per_newton: float, body: Sequence[Floats]) -> list[Arrow]:
    """The arrows of forces, the largest first; ``per_newton``: units of the paper; ``body``: the link's lines."""
    chosen: list[Arrow] = []
    link = _sampled(body)
    for action in sorted(actions, key=lambda each: -each.size):
        place = np.asarray(view.paper(action.place))
        options = list(_options(action, place, per_newton))
        costs = [
            0.02 * moved
            + _covered(each, link, 1.0)
            + sum(_covered(each, _sampled([o.ink]), 4.0) for o in chosen)
            for each, moved in options
        ]
        chosen.append(options[int(np.argmin(costs))][0])
    return chosen


def _options(action: Action, place: Floats, per_newton: float) -> Iterator[tuple[Arrow, float]]:
    """Arrows that go from the place or end at it, and the same moved along their line; how far they are moved."""
    along = action.force * (1.0, -1.0) / action.size
    length = per_newton * action.size
    to_scale = length * MILLIMETRE >= SHORT
    if not to_scale:
        length = STUB / MILLIMETRE
    for moved in MOVES:
        foot = place + moved * along
        yield Arrow(action, foot, foot + length * along, place, to_scale), moved
        point = place - (moved + GAP) * along
        yield Arrow(action, point - length * along, point, place, to_scale), moved + GAP


def _sampled(lines: Sequence[Floats]) -> Floats:
    """Points along polylines, (n, 2), nearer to each other than lines that cover each other."""
    found = [np.zeros((0, 2))]
    for line in lines:
        for start, end in pairwise(line):
            if np.isfinite([start, end]).all():
                count = 2 + int(math.dist(start, end) / (0.7 * NEAR))
                found.append(start + np.linspace(0.0, 1.0, count)[:, None] * (end - start))
    return np.concatenate(found)


def _covered(arrow: Arrow, others: Floats, weight: float) -> float:
    """Share of an arrow that lies on other lines, times a weight."""
    own = _sampled([arrow.ink])
    own = own[np.hypot(*(own - arrow.place).T) > FREE]
    if not len(own) or not len(others):
        return 0.0
    gaps = np.hypot(*(own[:, None] - others[None]).transpose(2, 0, 1))
    return weight * float(np.mean(gaps.min(axis=1) < NEAR))


def arcs(couples: Sequence[Action], view: View) -> tuple[list[SvgNode], list[Floats], list[Label]]:
    """Arcs of couples about their places, wider where several have one place, their ink, and their symbols."""
    found, ink, labels, used = list[SvgNode](), list[Floats](), [], list[Floats]()
    for each in couples:
        at = np.asarray(view.paper(each.place))
        radius = RADIUS + WIDER * sum(math.dist(at, other) < 4.0 for other in used)
        used.append(at)
        turning = 1 if each.torque > 0 else -1
        shape = SYMBOLS["moment"](at=vec(at), turning=turning, radius=radius, style=STYLES[each.role])
        found.append(group(shape.elements, None, **{"data-action": each.symbol}))
        ink += shape.ink
        sides = [(0.0, -1.0), (0.7, -0.7), (-0.7, -0.7), (1.0, 0.0), (-1.0, 0.0)]
        labels.append(_label(each, tuple((at[0] + radius * x, at[1] + radius * y) for x, y in sides), 6.0))
    return found, ink, labels
