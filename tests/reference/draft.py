"""A mechanism under construction, placed in the plane: links with world points, pins, slides, welds, drivers.

The pieces (initial mechanisms, dyads, triads, welded plates) are put down assembled, at random places that
are comfortably away from their singular positions; `random_mechanisms` makes a file and a system of them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from math import pi

import numpy as np
from tests.reference.multibody import FRAME, Vec

WELL = 0.4  # smallest sine or cosine by which a piece keeps away from its singular position


class Awkward(Exception):
    """The piece could not be placed well; draw again."""


@dataclass
class Slide:
    name: str
    guide: str
    through: str
    direction: float  # in the plane
    block: str
    at: str
    along: str | None = None  # second point on the guide's line, if the direction is given by two points


@dataclass
class Weld:
    at: str
    a: str
    b: str


@dataclass
class Drive:
    name: str
    kind: str  # "turn" or "slide"
    joint: str
    link: str
    relative_to: str


@dataclass
class Draft:
    rng: np.random.Generator
    links: dict[str, dict[str, Vec]] = field(default_factory=lambda: {FRAME: {}})
    slides: list[Slide] = field(default_factory=list)
    welds: list[Weld] = field(default_factory=list)
    drives: list[Drive] = field(default_factory=list)
    # signature, first link, last link, inner joint
    dyads: list[tuple[str, str, str, str]] = field(default_factory=list)
    closed_form: bool = True
    by_words: bool = False  # the file names the assembly in words, and has no drawing

    def mark(self) -> tuple[dict[str, dict[str, Vec]], int, int, int]:
        links = {name: dict(points) for name, points in self.links.items()}
        return links, len(self.slides), len(self.welds), len(self.dyads)

    def restore(self, mark: tuple[dict[str, dict[str, Vec]], int, int, int]) -> None:
        self.links, slides, welds, dyads = mark
        del self.slides[slides:], self.welds[welds:], self.dyads[dyads:]

    def chance(self, p: float) -> bool:
        return bool(self.rng.random() < p)

    def pick(self, items: list[str]) -> str:
        return items[int(self.rng.integers(len(items)))]

    def angle(self) -> float:
        return float(self.rng.uniform(-pi, pi))

    def new_link(self) -> str:
        name = f"l{len(self.links)}"
        self.links[name] = {}
        return name

    def new_point(self, link: str, at: Vec) -> str:
        used = {p for points in self.links.values() for p in points}
        name = f"P{len(used)}"
        self.links[link][name] = at
        return name

    def join(self, name: str, link: str, other: str) -> None:
        self.links[link][name] = self.links[other][name]

    def around(self, centre: Vec, low: float, high: float) -> Vec:
        r, a = self.rng.uniform(low, high), self.angle()
        return float(centre[0] + r * np.cos(a)), float(centre[1] + r * np.sin(a))

    def point_on(self, link: str, share: float = 0.4) -> str:
        """A point of the link to hang something on: one that is there, or a new one not far away."""
        there = [p for p in self.links[link] if p not in {w.at for w in self.welds}]
        if there and self.chance(share):
            return self.pick(there)
        centre = self.links[link][self.pick(there)] if there else (0.0, 0.0)
        return self.new_point(link, self.around(centre, 0.3, 1.2))

    def two_parents(self) -> tuple[str, str]:
        names = list(self.links)
        for _ in range(20):
            a, b = self.pick(names), self.pick(names)
            if a != b and not any({a, b} == {w.a, w.b} for w in self.welds):
                return a, b
        raise Awkward

    def slide(self, guide: str, block: str, direction: float, at: str | None = None) -> Slide:
        """A prismatic joint; `at` is a point of `block` already placed, else a new one is made."""
        if at is None:
            there = list(self.links[guide]) + list(self.links[block])
            centre = (self.links[guide] | self.links[block])[self.pick(there)] if there else (0.0, 0.0)
            at = self.new_point(block, self.around(centre, 0.1, 0.7))
        x, y = self.links[block][at]
        u = (float(np.cos(direction)), float(np.sin(direction)))
        there = [p for p in self.links[guide] if p != at]
        if there and self.chance(0.5):
            through = self.pick(there)
        else:
            s = self.rng.uniform(-0.8, 0.8)
            h = 0.0 if self.chance(0.5) else self.rng.uniform(-0.3, 0.3)
            through = self.new_point(guide, (x - s * u[0] + h * u[1], y - s * u[1] - h * u[0]))
        slide = Slide(f"s{len(self.slides)}", guide, through, direction, block, at)
        if self.chance(0.2):
            t, r = self.links[guide][through], self.rng.uniform(0.4, 1.0)
            slide.along = self.new_point(guide, (t[0] + r * u[0], t[1] + r * u[1]))
        self.slides.append(slide)
        return slide

    def slide_either_way(self, a: str, b: str, direction: float, at: str | None = None) -> Slide:
        """The guide on a or on b; `at` is a point of b, used when b is the block."""
        if self.chance(0.5) and self.links[a]:
            return self.slide(b, a, direction)
        return self.slide(a, b, direction, at)

    def unit(self, a: Vec, b: Vec, least: float = 0.25) -> tuple[float, float]:
        d = float(np.hypot(b[0] - a[0], b[1] - a[1]))
        if d < least:
            raise Awkward
        return (b[0] - a[0]) / d, (b[1] - a[1]) / d

    def well_placed(self, draw: Callable[[], Vec], good: Callable[[Vec], bool]) -> Vec:
        for _ in range(30):
            at = draw()
            if good(at):
                return at
        raise Awkward


def cross(a: Vec, b: Vec) -> float:
    return a[0] * b[1] - a[1] * b[0]


def dot(a: Vec, b: Vec) -> float:
    return a[0] * b[0] + a[1] * b[1]


def middle(p: Vec, q: Vec) -> Vec:
    return (p[0] + q[0]) / 2, (p[1] + q[1]) / 2


def direction_away(d: Draft, singular: Callable[[Vec], float]) -> float:
    """A direction whose unit vector u has |singular(u)| large enough."""
    for _ in range(30):
        angle = d.angle()
        if abs(singular((float(np.cos(angle)), float(np.sin(angle))))) > WELL:
            return angle
    raise Awkward


# initial mechanisms


def driven_crank(d: Draft, about: str = FRAME) -> str:
    pin = d.point_on(about, share=0.3 if about != FRAME else 0.0)
    link = d.new_link()
    d.join(pin, link, about)
    d.new_point(link, d.around(d.links[link][pin], 0.2, 0.8))
    d.drives.append(Drive(f"d{len(d.drives)}", "turn", pin, link, about))
    return link


def driven_slider(d: Draft) -> str:
    link = d.new_link()
    at = d.new_point(link, d.around((0.0, 0.0), 0.0, 0.8))
    slide = d.slide(FRAME, link, d.angle(), at)
    if d.chance(0.5):
        d.new_point(link, d.around(d.links[link][at], 0.3, 0.8))
    d.drives.append(Drive(f"d{len(d.drives)}", "slide", slide.name, link, FRAME))
    return link


def cylinder_and_boom(d: Draft) -> str:
    """Boom on the frame, pushed by a driven cylinder between frame and boom."""
    boom, barrel, rod = d.new_link(), d.new_link(), d.new_link()
    foot, pivot = d.new_point(FRAME, d.around((0.0, 0.0), 0.0, 0.8)), d.new_point(FRAME, (0.0, 0.0))
    d.join(pivot, boom, FRAME)
    d.join(foot, barrel, FRAME)
    f = d.links[FRAME][foot]
    head = d.well_placed(
        lambda: d.around((0.0, 0.0), 0.5, 1.2), lambda p: abs(cross(d.unit((0.0, 0.0), p), d.unit(f, p, 0.0))) > WELL
    )
    pin = d.new_point(boom, head)
    d.join(pin, rod, boom)
    u = d.unit(f, head)
    slide = d.slide(barrel, rod, float(np.arctan2(u[1], u[0])), pin)
    d.drives.append(Drive(f"d{len(d.drives)}", "slide", slide.name, rod, barrel))
    d.closed_form = False
    return boom


def initial_mechanism(d: Draft, inner_drivers: bool) -> None:
    draw = d.rng.random()
    if draw < 0.1 and inner_drivers:
        cylinder_and_boom(d)
    elif draw < 0.25:
        driven_slider(d)
    elif draw < 0.35:
        driven_crank(d, about=driven_crank(d))
    elif draw < 0.45:
        driven_crank(d)
        driven_crank(d)
    else:
        driven_crank(d)


# groups


def rrr(d: Draft, a: str, b: str) -> None:
    first, last = d.new_link(), d.new_link()
    pa, pb = d.point_on(a), d.point_on(b)
    p, q = d.links[a][pa], d.links[b][pb]
    d.unit(p, q)
    d.join(pa, first, a)
    d.join(pb, last, b)
    at = d.well_placed(
        lambda: d.around(middle(p, q), 0.1, 1.2),
        lambda c: abs(cross(d.unit(p, c, 0.0), d.unit(q, c, 0.0))) > WELL and _apart(c, p, q),
    )
    inner = d.new_point(first, at)
    d.join(inner, last, first)
    d.dyads.append(("RRR", first, last, inner))


def rrp(d: Draft, a: str, b: str) -> None:
    first, last = d.new_link(), d.new_link()
    pa = d.point_on(a)
    p = d.links[a][pa]
    d.join(pa, first, a)
    inner = d.new_point(first, d.around(p, 0.3, 1.2))
    d.join(inner, last, first)
    arm = d.unit(p, d.links[first][inner])
    direction = direction_away(d, lambda u: dot(u, arm))
    slide = d.slide_either_way(b, last, direction, inner if d.chance(0.6) else None)
    d.dyads.append(("RRP", first, last, slide.name))


def rpr(d: Draft, a: str, b: str) -> None:
    first, last = d.new_link(), d.new_link()
    pa, pb = d.point_on(a), d.point_on(b)
    ray = d.unit(d.links[a][pa], d.links[b][pb])
    d.join(pa, first, a)
    d.join(pb, last, b)
    direction = direction_away(d, lambda u: dot(u, ray) * 0.8)
    slide = d.slide_either_way(first, last, direction, pb if d.chance(0.6) else None)
    if len(d.links[first]) == len(d.links[last]) == 1:
        d.new_point(first, d.around(d.links[first][pa], 0.3, 0.8))  # two points alone do not show the mode
    d.dyads.append(("RPR", first, last, slide.name))


def prp(d: Draft, a: str, b: str) -> None:
    first, last = d.new_link(), d.new_link()
    centre = d.links[a][d.pick(list(d.links[a]))] if d.links[a] else (0.0, 0.0)
    inner = d.new_point(first, d.around(centre, 0.2, 1.0))
    d.join(inner, last, first)
    angle = d.angle()
    v = (float(np.cos(angle)), float(np.sin(angle)))
    d.slide_either_way(a, first, angle, inner if d.chance(0.6) else None)
    other = direction_away(d, lambda u: cross(u, v))
    d.slide_either_way(b, last, other, inner if d.chance(0.6) else None)
    d.dyads.append(("PRP", first, last, inner))


def rpp(d: Draft, a: str, b: str) -> None:
    first, last = d.new_link(), d.new_link()
    pa = d.point_on(a)
    d.join(pa, first, a)
    angle = d.angle()
    v = (float(np.cos(angle)), float(np.sin(angle)))
    slide = d.slide_either_way(b, last, angle)
    other = direction_away(d, lambda u: cross(u, v))
    if not d.links[last]:
        d.new_point(last, d.around(d.links[first][pa], 0.1, 0.6))
    shared = slide.at if slide.block == last else slide.through
    inner = d.slide_either_way(first, last, other, shared if d.chance(0.5) else None)
    d.dyads.append(("RPP", first, last, inner.name))


def triad(d: Draft, a: str, b: str) -> None:
    """Class III group: a ternary link and three binary links to points of solved links."""
    c = d.pick(list(d.links))
    outer = [(link, d.point_on(link)) for link in (a, b, c)]
    plate = d.new_link()
    feet = [d.links[link][point] for link, point in outer]
    centre = (sum(f[0] for f in feet) / 3, sum(f[1] for f in feet) / 3)
    for (link, point), foot in zip(outer, feet, strict=True):
        bar = d.new_link()
        d.join(point, bar, link)
        at = d.well_placed(lambda: d.around(centre, 0.3, 1.0), lambda p, f=foot: _apart(p, f, f))  # type: ignore[misc]
        inner = d.new_point(plate, at)
        d.join(inner, bar, plate)
    _spread(d, plate)
    d.closed_form = False


def weld_plate(d: Draft) -> None:
    a = d.pick([name for name in d.links if name != FRAME])
    at = d.point_on(a, share=0.0)
    b = d.new_link()
    d.join(at, b, a)
    d.new_point(b, d.around(d.links[b][at], 0.3, 0.8))
    d.welds.append(Weld(at, a, b))


def _apart(c: Vec, p: Vec, q: Vec) -> bool:
    return bool(min(np.hypot(c[0] - p[0], c[1] - p[1]), np.hypot(c[0] - q[0], c[1] - q[1])) > 0.25)


def _spread(d: Draft, link: str) -> None:
    a, b, c = d.links[link].values()
    if abs(cross(d.unit(a, b), d.unit(a, c))) < WELL:
        raise Awkward


Piece = Callable[[Draft, str, str], None]
DYADS: dict[str, Piece] = {"RRR": rrr, "RRP": rrp, "RPR": rpr, "PRP": prp, "RPP": rpp}
