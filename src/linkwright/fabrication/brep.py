"""Bodies by their exact faces: planes and cylinders, between edges that are lines and arcs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from linkwright.fabrication.body import Section
from linkwright.shapes.loop import Edge, Loop

Place = tuple[float, float, float]


@dataclass(frozen=True)
class Curve:
    """The curve of an edge: an arc about ``centre`` with a ``radius``, counter-clockwise from above or not; with
    radius 0 a line."""

    centre: Place = (0.0, 0.0, 0.0)
    radius: float = 0.0
    counter_clockwise: bool = True


@dataclass(frozen=True)
class Surface:
    """A plane through ``place`` with a ``normal``; with a ``radius`` a cylinder about a vertical axis through it."""

    place: Place
    normal: Place = (0.0, 0.0, 1.0)
    radius: float = 0.0


#: An edge by its number, and whether it is passed from its start to its end.
Passed = tuple[int, bool]


@dataclass(frozen=True)
class Face:
    """A piece of a surface; ``bounds``: the outer one first, counter-clockwise as seen from outside the body;
    ``outward``: whether the surface's own normal, of a cylinder away from its axis, points out of the body."""

    surface: Surface
    bounds: tuple[tuple[Passed, ...], ...]
    outward: bool = True


@dataclass
class Brep:
    """The boundary of one solid: ``vertices`` m, ``edges`` from vertex to vertex, ``faces``."""

    vertices: list[Place] = field(default_factory=list)
    edges: list[tuple[int, int, Curve]] = field(default_factory=list)
    faces: list[Face] = field(default_factory=list)


@dataclass(frozen=True)
class _Rim:
    """The edges of a loop at one height, in its order."""

    edges: tuple[int, ...]

    def along(self) -> tuple[Passed, ...]:
        return tuple((each, True) for each in self.edges)

    def back(self) -> tuple[Passed, ...]:
        return tuple((each, False) for each in reversed(self.edges))


def brep_of(sections: Sequence[Section]) -> Brep:
    """The boundary of sections that are stacked, each of one outer loop with its inner ones, the outer one first."""
    brep = Brep()
    rims = [_walls(brep, section) for section in sections]
    for below, above in zip((None, *rims), (*rims, None), strict=True):
        _level(brep, below, above)
    return brep


@dataclass(frozen=True)
class _Rims:
    """The rims of a section: of its loops at the lower and at the upper height."""

    section: Section
    lower: tuple[_Rim, ...]
    upper: tuple[_Rim, ...]


def _walls(brep: Brep, section: Section) -> _Rims:
    """Adds the edges and upright faces of a section."""
    rims = [_loop_walls(brep, loop, section) for loop in section.loops]
    return _Rims(section, tuple(low for low, _ in rims), tuple(high for _, high in rims))


def _loop_walls(brep: Brep, loop: Loop, section: Section) -> tuple[_Rim, _Rim]:
    count = len(loop.edges)
    low, high = (_rim(brep, loop, height) for height in (section.low, section.high))
    uprights = len(brep.edges)
    for below, above in zip(low.edges, high.edges, strict=True):
        brep.edges.append((brep.edges[below][0], brep.edges[above][0], Curve()))
    for k, edge in enumerate(loop.edges):
        bound = (
            (low.edges[k], True),
            (uprights + (k + 1) % count, True),
            (high.edges[k], False),
            (uprights + k, False),
        )
        brep.faces.append(_upright(edge, section.low, bound))
    return low, high


def _rim(brep: Brep, loop: Loop, height: float) -> _Rim:
    """Adds the corners and the edges of a loop at a height."""
    first, count, start = len(brep.vertices), len(loop.edges), len(brep.edges)
    for k, edge in enumerate(loop.edges):
        brep.vertices.append((edge.start.real, edge.start.imag, height))
        curve = Curve()
        if edge.bulge:
            curve = Curve((edge.centre.real, edge.centre.imag, height), edge.radius, edge.bulge > 0)
        brep.edges.append((first + k, first + (k + 1) % count, curve))
    return _Rim(tuple(range(start, start + count)))


def _upright(edge: Edge, height: float, bound: tuple[Passed, ...]) -> Face:
    """The face over an edge; the body is on its left."""
    if edge.bulge:
        axis = (edge.centre.real, edge.centre.imag, height)
        return Face(Surface(axis, radius=edge.radius), (bound,), edge.bulge > 0)
    way = (edge.end - edge.start) / abs(edge.end - edge.start)
    return Face(Surface((edge.start.real, edge.start.imag, height), (way.imag, -way.real, 0.0)), (bound,))


def _level(brep: Brep, below: _Rims | None, above: _Rims | None) -> None:
    """Adds the level face between two sections, up where the lower one is wider, else down."""
    upwards = above is None or (below is not None and below.section.extent > above.section.extent)
    wide, narrow = (below, above) if upwards else (above, below)
    assert wide is not None
    bounds: Iterable[tuple[Passed, ...]]
    if upwards:
        bounds = [rim.along() for rim in wide.upper]
        bounds += [rim.back() for rim in narrow.lower] if narrow else []
    else:
        bounds = [rim.back() for rim in wide.lower]
        bounds += [rim.along() for rim in narrow.upper] if narrow else []
    height = wide.section.high if upwards else wide.section.low
    brep.faces.append(Face(Surface((0.0, 0.0, height), (0.0, 0.0, 1.0 if upwards else -1.0)), tuple(bounds)))
