"""Drawn places that agree with the sizes of links: nearest to where points are drawn, pivots stay."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.server.entries import section, texts, word
from linkwright.server.geometry import Line, Shape, Values, lines, plain, shape

if TYPE_CHECKING:
    from linkwright.server.draft import Draft

Places = Mapping[str, complex]
#: A condition is met within this share of the drawing's size; steps of Newton's method; other starts that are tried.
MET, STEPS, STARTS = 1e-6, 60, 6
#: Points that are to stay near move so many times less than others.
HOLD = 0.05
#: A link agrees with its drawing within so many steps of its coordinates, or this share of its length.
STEPS_OFF, SHARE_OFF = 1.5, 1e-3
#: Sizes that are rounded agree with coordinates that are within so many steps.
AGREED = 0.8
#: Few points move alone where they need not move so many times farther than all together.
FARTHER = 1.1


@dataclass(frozen=True)
class Condition:
    """What places of points must fulfil: residuals (m) of a link's sizes, a guide or a weld."""

    link: str
    points: tuple[str, ...]
    residual: Callable[[Places], list[float]]


def conditions(draft: Draft, held: Collection[str] | None = None) -> list[Condition]:
    """The conditions of a text on points whose places are known.

    ``held``: addresses of sizes that are held, those that are written as expressions too; None holds all.
    """
    values, places = Values(draft.root), draft.shown()["points"]
    shapes = {name: sized for name, node in draft.section("links") or () if (sized := shape(values, node))}
    found = [each for name, sized in shapes.items() if (each := _sized(draft, name, sized, held))]
    found += [each for line in lines(values, draft.root) for each in _guided(line, shapes)]
    found += _welded(values, draft, shapes)
    return [each for each in found if all(point in places for point in each.points)]


def _sized(draft: Draft, name: str, shape: Shape, held: Collection[str] | None) -> Condition | None:
    first, *others = shape.points
    if not others:
        return None
    if held is None or any(_is_held(draft, name, shape, each, held) for each in others[1:]):
        return Condition(name, (first, *others), lambda at: _off(shape.points, at, first, others))
    if not _is_held(draft, name, shape, others[0], held):
        return None
    second = others[0]
    return Condition(name, (first, second), lambda at: _off(shape.points, at, first, [second]))


def _is_held(draft: Draft, name: str, shape: Shape, point: str, held: Collection[str]) -> bool:
    """Whether a size that places a point is locked, or an expression of others."""
    entry = draft.link(name)
    listed = texts(entry.get("points"))
    if point not in listed:
        tables = (section(entry, key) for key in ("points", "also"))
        nodes = [table.get(point) for table in tables if table is not None]
        addresses = [f"{name}.{point}.x", f"{name}.{point}.y"]
    elif shape.form == "bent":
        nodes = [entry.get(key) for key in ("lengths", "angle")]
        addresses = [f"{name}.lengths.{listed.index(point) - 1}", *([f"{name}.angle"] if point == listed[2] else ())]
    else:
        nodes, addresses = [entry.get("length")], [f"{name}.length"]
    return not all(plain(each) for each in nodes if each is not None) or not set(addresses).isdisjoint(held)


def _off(local: Places, at: Places, first: str, others: list[str]) -> list[float]:
    """How far points are from where the first two have the others, and these from their distance."""
    second, *rest = others
    axis, base = at[second] - at[first], local[second] - local[first]
    found = [abs(axis) - abs(base)]
    for each in rest:
        gap = at[each] - at[first] - (local[each] - local[first]) / base * axis if base else 0j
        found += [gap.real, gap.imag]
    return found


def _guided(line: Line, shapes: Mapping[str, Shape]) -> Iterator[Condition]:
    ends = (line.through, line.at, *(line.direction if isinstance(line.direction, tuple) else ()))

    def residual(at: Places) -> list[float]:
        if isinstance(line.direction, tuple):
            start, end = (at[each] for each in line.direction)
            way = (end - start) / (abs(end - start) or 1.0)
        else:
            way = cmath.rect(1.0, line.direction)
        return [((at[line.at] - at[line.through]) * way.conjugate()).imag - line.offset]

    yield Condition("", ends, residual)
    block = shapes.get(line.block)
    if block is not None and len(block.points) > 1 and isinstance(line.direction, float):
        turn = cmath.rect(1.0, line.direction - line.block_angle)
        first, second = list(block.points)[:2]
        local = (block.points[second] - block.points[first]) * turn

        def kept(at: Places) -> list[float]:
            return [((at[second] - at[first]) * local.conjugate()).imag / (abs(local) or 1.0)]

        yield Condition("", (first, second), kept)


def _welded(values: Values, draft: Draft, shapes: Mapping[str, Shape]) -> Iterator[Condition]:
    for _unused, joint in draft.section("joints") or ():
        if not isinstance(joint, MappingNode) or word(joint, "kind") != "weld":
            continue
        pair = [shapes.get(each) for each in texts(joint.get("links"))]
        if len(pair) != 2 or any(each is None or len(each.points) < 2 for each in pair):
            continue
        turn = cmath.rect(1.0, values.of(joint.get("angle"), "angle") or 0.0)
        (a, b), (c, d) = (list(each.points)[:2] for each in pair if each)
        one, other = (_heading(each) for each in pair if each)

        def kept(
            at: Places, a: str = a, b: str = b, c: str = c, d: str = d, turned: complex = turn * other / one
        ) -> list[float]:
            first, second = at[b] - at[a], at[d] - at[c]
            return [(second * (first * turned).conjugate()).imag / (abs(first) or 1.0)]

        yield Condition("", (a, b, c, d), kept)


def _heading(shape: Shape) -> complex:
    """Direction from a link's first point to its second in its axes."""
    first, second = list(shape.points.values())[:2]
    return (second - first) / (abs(second - first) or 1.0)


def nearest(
    wanted: list[Condition], places: Places, free: Collection[str], near: Collection[str] = (), starts: int = STARTS
) -> dict[str, complex] | None:
    """The places of free points nearest to those given, of ``near`` ones above all, that meet the conditions; None
    where Newton's method finds none, from there or so many other ``starts``."""
    names = [each for each in places if each in free]
    wanted = [each for each in wanted if not set(names).isdisjoint(each.points)]
    size = max((abs(a - b) for a in places.values() for b in places.values()), default=0.0) or 1.0
    ease = np.repeat([HOLD if name in near else 1.0 for name in names], 2)
    start = np.array([places[name] for name in names], complex).view(float) / ease

    def off(x: Floats) -> Floats:
        at = {**places, **dict(zip(names, (x * ease).view(complex).tolist(), strict=True))}
        return np.array([each for condition in wanted for each in condition.residual(at)])

    if not wanted or not names:
        return {}
    found = _newton(off, start, size)
    if found is None:
        rng = np.random.default_rng(0)
        tried = (_newton(off, start + 0.5 * size * rng.normal(size=start.size), size) for _unused in range(starts))
        found = min((each for each in tried if each is not None), key=lambda x: _distance(x, start), default=None)
    return None if found is None else dict(zip(names, (found * ease).view(complex).tolist(), strict=True))


def _distance(x: Floats, start: Floats) -> float:
    return float(np.linalg.norm(x - start))


def _newton(off: Callable[[Floats], Floats], start: Floats, size: float) -> Floats | None:
    """Steps of least length towards where ``off`` is zero."""
    x, now = start.copy(), off(start)
    for _unused in range(STEPS):
        if np.abs(now).max() < 1e-3 * MET * size:
            break
        step = np.linalg.lstsq(_slopes(off, x, 1e-7 * size), -now, rcond=1e-8)[0]
        step *= min(1.0, 0.5 * size / (float(np.linalg.norm(step)) or 1.0))
        share, then = 1.0, off(x + step)
        while np.linalg.norm(then) > (1 - 1e-4 * share) * np.linalg.norm(now) and share > 1e-4:
            share *= 0.5
            then = off(x + share * step)
        if share <= 1e-4:
            break
        x, now = x + share * step, then
    return x if np.abs(now).max() < MET * size else None


def _slopes(off: Callable[[Floats], Floats], x: Floats, h: float) -> Floats:
    return np.array([(off(x + d) - off(x - d)) / (2 * h) for d in h * np.eye(x.size)]).T


def unmet(draft: Draft) -> list[str]:
    """Links whose drawn points do not stand as their sizes say."""
    at = {name: complex(*place) for name, place in draft.picture()["points"].items()}
    there = [each for each in conditions(draft) if each.link and all(point in at for point in each.points)]
    return list(dict.fromkeys(each.link for each in there if not _met(draft, each, at)))


def _met(draft: Draft, condition: Condition, at: Places) -> bool:
    length = abs(at[condition.points[1]] - at[condition.points[0]])
    return max(map(abs, condition.residual(at))) <= max(STEPS_OFF * draft.step, SHARE_OFF * length)


def agree(draft: Draft, new: Collection[str] = (), excused: Collection[str] = ()) -> None:
    """Moves drawn points to where the sizes have them, new ones alone where that is enough; leaves all as they are
    where no places agree. ``excused``: links that need not agree where not all can."""
    wanted, shown = conditions(draft), draft.shown()
    at = {name: complex(*place) for name, place in shown["points"].items()}
    movable = [name for name in at if name not in shown["fixed"]]
    left = [each for each in wanted if each.link not in excused]
    for held, starts in ((wanted, 0), (left, STARTS)) if excused else ((wanted, STARTS),):
        if _agrees(draft, held, at):
            return
        found = _places(draft, held, at, [[name for name in movable if name in new], movable], starts)
        if found is not None:
            move(draft, at, found)
            return


def _places(
    draft: Draft, held: list[Condition], at: Places, free: list[list[str]], starts: int
) -> dict[str, complex] | None:
    """Places that agree: of new points alone, else of the ends of what does not agree where these need not move much
    farther than all together, else of all."""
    fresh, movable = free
    if (found := nearest(held, at, fresh, starts=starts)) and _agrees(draft, held, {**at, **found}):
        return found
    off = {point for each in held if not _agrees(draft, [each], at) for point in each.points}
    ends = [name for name in movable if name in off]
    found = nearest(held, at, movable, starts=starts)
    if not found or not _agrees(draft, held, {**at, **found}):
        return None
    few = nearest(held, at, ends, starts=0) if len(ends) < len(movable) else None
    if few and _agrees(draft, held, {**at, **few}) and _way(at, few) <= FARTHER * _way(at, found):
        return few
    return found


def _way(at: Places, found: Places) -> float:
    return math.hypot(*(abs(place - at[name]) for name, place in found.items()))


def _agrees(draft: Draft, wanted: list[Condition], at: Places) -> bool:
    near = AGREED * draft.step
    return all(abs(each) <= near for condition in wanted for each in condition.residual(at))


def move(draft: Draft, at: Places, found: Places) -> None:
    """Draws drawn points at other places, in fine steps; where others stand the solved machine tells."""
    drawn = draft.picture()["points"]
    for name, place in found.items():
        if name in drawn and abs(place - at[name]) > 0.05 * draft.step:
            draft.draw(name, place, fine=True)
