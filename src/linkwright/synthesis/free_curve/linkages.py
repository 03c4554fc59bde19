"""From a design of the search to a named linkage that draws the curve, in which order it draws, how fast."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from string import ascii_uppercase

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.synthesis.free_curve.placing import BLOCK, GUIDE, PIVOT, POINT, SLIDER
from linkwright.synthesis.free_curve.target import LINE, Target, columns, even_points
from linkwright.synthesis.free_curve.topology import Design, Node, node_paths, rods_of
from linkwright.synthesis.linkage import Guide, Linkage

SLIDES = {SLIDER: "slider_crank", BLOCK: "crank_swinging_block"}
#: Positions of a turn at which the transmission angle is examined.
TURN = 1800
KINDS = {4: "four_bar", 6: "six_bar", 8: "eight_bar", 10: "ten_bar", 12: "twelve_bar"}


class Placed:
    """A design laid on its target: p ↦ z(p), m, from the crank's units to the place of the curve."""

    def __init__(self, design: Design, target: Target) -> None:
        self.design, self.target = design, target
        even = even_points(target.curve(design), LINE, target.closed)
        self.middle = complex(even.mean())
        rms = np.sqrt(np.mean(np.abs(even - self.middle) ** 2))
        self.factor = complex(target.radius / rms * np.exp(1j * design.x[-3]))

    def __call__(self, places: Complexes) -> Complexes:
        laid = self.factor * (places - self.middle)
        return np.asarray(self.target.centre + (laid.conj() if self.design.mirror else laid))

    def curve(self, count: int) -> Complexes:
        """The drawn curve at even crank angles in the order in which a crank that turns to the left draws it, m."""
        curve = self(self.target.curve(self.design, count))
        return curve[::-1] if self.design.mirror else curve

    def turn(self, crank: float) -> float:
        """Angle of the crank in the frame, rad."""
        angle = crank + float(np.angle(self.factor))
        return -angle if self.design.mirror else angle

    def size(self) -> float:
        """Maximum distance of a node from the curve's centroid where the demands hold, in rms radii."""
        paths = node_paths(self.design.nodes, self.design.x, self.target.judged(self.design, 721))[0]
        return float(np.abs(paths - self.middle).max() * abs(self.factor) / self.target.radius)

    def transmission_angle(self) -> float:
        """Minimum over all dyads where the demands hold, rad; 0 where one does not close."""
        return self._smallest_angle(self.target.judged(self.design, TURN + 1))

    def over_a_turn(self) -> float:
        """The same over a full turn of the crank."""
        return self._smallest_angle(np.linspace(0, 2 * np.pi, TURN + 1))

    def turns(self) -> bool:
        """Whether the crank turns fully within the demand."""
        return self.target.turning or self.over_a_turn() >= self.target.min_angle

    def _smallest_angle(self, crank: Floats) -> float:
        return math.asin(math.sqrt(max(node_paths(self.design.nodes, self.design.x, crank)[1], 0.0)))

    def keeps(self) -> bool:
        """Whether the target's demands hold."""
        return self.transmission_angle() >= self.target.min_angle and self.size() <= self.target.largest


def linkage_of(placed: Placed) -> Linkage:
    """The linkage in the pose in which the drawn part begins."""
    design, closed = placed.design, placed.target.closed
    names = node_names(design.rows)
    first, span = (0.0, 0.0) if closed else (float(design.x[-2]), float(design.x[-1]))
    ends = sorted((placed.turn(first), placed.turn(first + span)))
    begin = first + span if design.mirror else first
    pose = placed(node_paths(design.nodes, design.x, np.array([begin]))[0][:, 0])
    points = {name: complex(place) for name, place in zip(names, pose, strict=True)}
    frame = tuple(names[k] for k, row in enumerate(design.rows) if row[0] in (PIVOT, GUIDE) and k != 1)
    driven = "crank" if placed.turns() else "input"
    links = _links(design.rows, names, driven)
    return Linkage(
        kind_of(design),
        points,
        frame,
        links,
        (driven, "O"),
        _guides(placed, names, links),
        span=None if closed else (ends[0], ends[1]),
    )


def kind_of(design: Design) -> str:
    """What a linkage is called: by its number of links, one of four links by its slide."""
    slides = [SLIDES[row[0]] for row in design.rows if row[0] in SLIDES]
    return slides[0] if slides and design.links == 4 else KINDS[design.links]


def _guides(placed: Placed, names: list[str], links: dict[str, tuple[str, ...]]) -> dict[str, Guide]:
    """The prismatic joints; their blocks are the links of a single point."""
    rows, x, found = placed.design.rows, placed.design.x, dict[str, Guide]()
    blocks = {points[0]: name for name, points in links.items() if len(points) == 1}
    for k, (kind, i, j, _) in enumerate(rows):
        name = f"slide{len(found) + 1}" if found else "slide"
        if kind == SLIDER:
            direction = placed.turn(float(x[2 * k - 3]))
            found[name] = Guide("frame", names[j], direction, blocks[names[k]], names[k])
        elif kind == BLOCK:
            rod = next(name for name, points in links.items() if points[:2] == (names[i], names[k]))
            offset = float(x[2 * k - 3]) * abs(placed.factor) * (-1 if placed.design.mirror else 1)
            found[name] = Guide(rod, names[i], (names[i], names[k]), blocks[names[j]], names[j], offset)
    return found


def _links(rows: list[Node], names: list[str], driven: str) -> dict[str, tuple[str, ...]]:
    links: dict[tuple[int, int], list[int]] = {(0, 1): [0, 1]}
    blocks = []
    for k, (kind, i, j, _) in enumerate(rows):
        links |= {(end, k): [end, k] for end in rods_of(rows[k])}
        if kind == POINT:
            links[i, j].append(k)
        elif kind in SLIDES:
            blocks.append([k if kind == SLIDER else j])
    named = [*zip(_link_names(driven), links.values(), strict=False)]
    named += [(f"block{number + 1}" if number else "block", each) for number, each in enumerate(blocks)]
    return {name: tuple(names[k] for k in nodes) for name, nodes in named}


def _link_names(driven: str) -> Iterator[str]:
    yield from (driven, "coupler", "rocker")
    number = 4
    while True:
        yield f"link{number}"
        number += 1


def node_names(rows: list[Node]) -> list[str]:
    """Pivots O, O2, O3 …; the crank's pin A, then B, C …; the drawing point P."""
    letters = iter([each for each in ascii_uppercase if each not in "AOP"])
    pivots, names = 1, []
    for k, row in enumerate(rows):
        if k == 0:
            names.append("O")
        elif k == 1:
            names.append("A")
        elif row[0] in (PIVOT, GUIDE):
            pivots += 1
            names.append(f"O{pivots}")
        else:
            names.append("P" if k == len(rows) - 1 else next(letters))
    return names


#: Positions of the drawn part at which order and speed are taken.
POSITIONS = 1440
#: As far as so many rms radii away a stroke counts that another direction would make unlike.
WAY = 0.2
#: Strokes both ways are one where these distances differ less: it tells nothing. Where all but this share of a curve
#: goes both ways, it is drawn as given.
UNLIKE, BOTH = 0.02, 0.02


@dataclass(frozen=True)
class Drawing:
    """How a curve is drawn.

    Args:
        along: share of the curve's length that is drawn in the direction of the given points, without strokes that
            these go both ways; 1: as given, 0: all backwards, between: strokes are drawn in another direction.
        fastest: maximum speed of the drawing point at one turn of the crank per second, m/s.
        unevenness: maximum over mean speed on the drawn part.
    """

    along: float
    fastest: float
    unevenness: float


def drawing(placed: Placed) -> Drawing:
    """Order and speed, from positions at even crank angles."""
    target, closed = placed.target, placed.target.closed
    curve, target_points = placed.curve(POSITIONS) - target.centre, target.radius * target.points
    if closed:
        curve, target_points = np.append(curve, curve[0]), np.append(target_points, target_points[0])
    steps = np.abs(np.diff(curve))
    span = 2 * np.pi if closed else float(placed.design.x[-1])
    speed = steps / (span / len(steps)) * 2 * np.pi
    with_it, against = _either_way(curve, target_points, target.radius)
    forward = steps[with_it < against - UNLIKE].sum()
    backward = steps[against < with_it - UNLIKE].sum()
    along = float(forward / (forward + backward)) if forward + backward > BOTH * steps.sum() else 1.0
    return Drawing(along, float(speed.max()), float(speed.max() / speed.mean()))


def _either_way(curve: Complexes, target_points: Complexes, radius: float) -> tuple[Floats, Floats]:
    """How far each step of the curve is from the nearest stroke that goes its way, and from one that goes against."""
    from scipy.spatial import cKDTree

    places, ways = _pieces(curve, radius)
    tree = cKDTree(np.hstack(_pieces(target_points, radius)))
    with_it, against = (tree.query(np.hstack([places, sign * ways]))[0] for sign in (1, -1))
    return with_it, against


def _pieces(line: Complexes, radius: float) -> tuple[Floats, Floats]:
    """Middles of a line's pieces in radii, and their directions, which weigh ``WAY`` radii."""
    steps = np.diff(line)
    unit = WAY * steps / np.maximum(np.abs(steps), 1e-300)
    return columns((line[1:] + line[:-1]) / (2 * radius)), columns(unit)
