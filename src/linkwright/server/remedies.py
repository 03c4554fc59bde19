"""What would mend a machine that comes apart: another length, a driver that rocks, a pivot elsewhere."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from linkwright.core.data import Plain
from linkwright.core.outputs import row_names
from linkwright.drivers.rocking import MARGIN
from linkwright.errors import LinkwrightError
from linkwright.kinematics.names import canonical
from linkwright.kinematics.solve import solve_motion, try_motion
from linkwright.mechanism.link import Link, second_point_address
from linkwright.mechanism.mechanism import Mechanism
from linkwright.server.gap import Arm, Gap, written
from linkwright.units import number
from linkwright.words import Message, _
from linkwright.words.message import in_language

#: Positions of the cycle at which a remedy is tried; by how much more than needed it reaches, as share.
TRIED, SPARE = 120, 0.02
#: Places of a pivot that are tried, as shares of its distance.
NEARER, FARTHER = np.linspace(1.0, 0.0, 201), np.linspace(1.0, 3.0, 201)


@dataclass(frozen=True)
class Remedy:
    """``change``: numbers before and after; ``actions``: those of drawing that carry it out; ``lengths``: new lengths
    of links by it, m; ``places``: where points would be then, m."""

    title: Message
    change: str
    note: Message
    actions: list[Plain]
    lengths: Mapping[str, float] = field(default_factory=dict)
    places: Mapping[str, list[float]] = field(default_factory=dict)

    def data(self, language: str) -> Plain:
        """As plain data."""
        title, note = (in_language(each, language) for each in (self.title, self.note))
        own = {"change": self.change, "actions": self.actions, "places": dict(self.places)}
        return {"title": title, "note": note, **own}


_THROUGH, _SIZES, _GUIDED = _("turns through"), _("nothing changes in size"), _("slides through")
_LENGTHS = {
    True: _("Lengthen the {link}", code="studio.lengthen"),
    False: _("Shorten the {link}", code="studio.shorten"),
}


@dataclass(frozen=True)
class Loop:
    """The lengths that decide, m, by links, and what the chains have to span over all positions of the driver."""

    gap: Gap

    @cached_property
    def spans(self) -> tuple[float, float]:
        """Smallest and largest distance of the outer pins, m, over the positions at which both are placed."""
        distances = self.gap.sides(self.gap.group)[0]
        known = distances[np.isfinite(distances)]
        return float(known.min()), float(known.max())

    @property
    def lengths(self) -> dict[str, float]:
        """Lengths of the links of the loop: the crank, both chains, the frame."""
        gap, arms = self.gap, self.gap.arms
        if arms is None:
            return {}
        found, crank = {}, gap.crank if gap.crank and gap.crank[1] == arms[0].pin else None
        if crank is not None and gap.driver is not None:
            found[gap.driver.link] = abs(gap.placed[crank[0]] - gap.placed[crank[1]])
        found |= {arm.link: arm.radius for arm in arms if arm.radius is not None}
        if crank is not None and arms[1].pin in gap.machine.frame.points:
            found["frame"] = abs(gap.placed[crank[0]] - gap.placed[arms[1].pin])
        return found


def remedies(gap: Gap, *, rocks: bool) -> list[Remedy]:
    """Up to three: a length with which the machine turns through, rocking, a pivot elsewhere. ``rocks``: it does so
    already."""
    found = []
    if gap.arms is not None:
        found += [each for each in [next(_lengths(gap), None)] if each is not None]
    if gap.driver is not None and gap.possible and not rocks:
        found.append(_rock(gap))
    if gap.arms is not None and gap.group.signature == "RRR":
        found += [each for each in [_pivot(gap)] if each is not None]
    return found


def _rock(gap: Gap) -> Remedy:
    assert gap.driver is not None
    q = float(gap.motion.input[gap.drawn])
    turns = (0.0, 2 * math.pi, -2 * math.pi) if gap.rotary else (0.0,)
    here = (each for each in gap.possible if any(each[0] <= q + turn <= each[1] for turn in turns))
    low, high = next(here, gap.possible[0])
    unit, factor = ("°", 180 / math.pi) if gap.rotary else (" mm", 1e3)
    change = f"{_whole(factor * low)}{unit} … {_whole(factor * high)}{unit}"
    action = {"do": "set", "path": ["cycle"], "value": "rock"}
    free = MARGIN * (high - low)
    nearest = min((low + free, high - free), key=lambda end: _off(end - gap.input, gap.rotary))
    title = _("Rock the {link}", link=gap.driver.link)
    places = _places(gap.machine, nearest)
    return Remedy(title, change, _SIZES, [action, *_drawn(gap.machine, places)], places=places)


def _off(way: float, rotary: bool) -> float:
    return abs(math.remainder(way, 2 * math.pi)) if rotary else abs(way)


def _whole(value: float) -> str:
    return f"{value:.0f}".replace("-", "−")


# lengths --------------------------------------------------------------------------------------------
def _lengths(gap: Gap) -> Iterator[Remedy]:
    """Lengths of one of the two chains with which they meet at every position."""
    assert gap.arms is not None
    for own, other in ((0, 1), (1, 0)):
        arm = gap.arms[own]
        address = _address(gap.machine.links.get(arm.link), {arm.pin, gap.point})
        if arm.radius is None or address is None:
            continue
        for value in _values(gap, arm, gap.arms[other]):
            if path := _path(gap.machine, address):
                name = ".".join(path[1:]) if path[0] == "parameters" else address
                changed = _moving(gap.machine, {name: value})
                if changed is not None:
                    yield _length_remedy(gap, arm, path, value, changed)
                    break


def _address(link: Link | None, ends: set[str]) -> str | None:
    """The dimension that is the distance of a link's first two points, if these are the ends."""
    if link is None or set(list(link.points)[:2]) != ends or link.geometry not in ("length", "bent", "drawing"):
        return None
    return second_point_address(link, list(link.points)[1])


def _path(machine: Mechanism, address: str) -> list[str] | None:
    """Where a text holds a length: with its link, or as a parameter of its own; None where it follows from others."""
    expression = machine.expressions.get(address)
    if expression is None:
        return ["links", address.partition(".")[0], "lengths" if ".lengths." in address else "length"]
    text = expression.text.strip()
    return ["parameters", text] if text in machine.parameters and text not in machine.expressions else None


def _values(gap: Gap, arm: Arm, other: Arm) -> Iterator[float]:
    """Round lengths (m) with which the chains meet everywhere, the nearest first."""
    assert arm.radius is not None
    if other.radius is None:
        heights, _unused = gap.heights(gap.group)
        low, high = float(np.nanmax(np.abs(heights))), math.inf
    else:
        nearest, farthest = Loop(gap).spans
        low = max(farthest - other.radius, other.radius - nearest)
        high = nearest + other.radius
    longer = arm.radius < low
    bound = low * (1 + SPARE) if longer else high * (1 - SPARE)
    if not math.isfinite(bound) or bound <= 0:
        return
    step = _step(bound)
    first = math.ceil(bound / step - 1e-9) if longer else math.floor(bound / step + 1e-9)
    for k in range(3):
        value = step * (first + k if longer else first - k)
        if low < value < high:
            yield value


def _step(length: float) -> float:
    """What a length is rounded to, m: a tenth of its power of ten."""
    return 10.0 ** (math.floor(math.log10(length)) - 1)


def _length_remedy(gap: Gap, arm: Arm, path: list[str], value: float, changed: Mechanism) -> Remedy:
    before = arm.radius or 0.0
    link = gap.machine.links[arm.link]
    new: object = _text(value)
    if path[-1] == "lengths":
        new = [_text(value), _text(link.lengths[1])]
    title = _LENGTHS[value > before].format(link=arm.link)
    action = {"do": "set", "path": path, "value": new}
    places = _places(changed, gap.input)
    actions = [action, *_drawn(changed, places)]
    return Remedy(title, _change(before, value), _through(gap), actions, {arm.link: value}, places)


def _through(gap: Gap) -> Message:
    return _THROUGH if gap.rotary else _GUIDED


def _change(before: float, after: float) -> str:
    return f"{number(round(1e3 * before, 1))} → {number(round(1e3 * after, 1))} mm"


def _text(length: float) -> str:
    return f"{number(round(1e3 * length, 3))} mm"


# pivots ---------------------------------------------------------------------------------------------
def _pivot(gap: Gap) -> Remedy | None:
    """The pivot of the second chain nearer to, or farther from, what the first one hangs on."""
    assert gap.arms is not None
    first, second = gap.arms
    name = second.pin
    if name not in gap.machine.frame.points or first.pin in gap.machine.frame.points:
        return None
    if any(f"frame.{name}.{axis}" in gap.machine.expressions for axis in "xy"):
        return None
    path = _way(gap, first)
    leads = gap.crank is not None and gap.crank[1] == first.pin
    middle = gap.placed[gap.crank[0]] if leads and gap.crank is not None else complex(path.mean())
    away = second.centre - middle
    both, between = first.radius + second.radius, abs(first.radius - second.radius)  # type: ignore[operator]
    far = bool(np.abs(path - second.centre).max() > both)
    for share in NEARER if far else FARTHER:
        distance = _rounded(share * abs(away), down=far)
        distances = np.abs(path - (middle + distance * away / abs(away)))
        if distance > 0 and distances.max() <= both * (1 - SPARE) and distances.min() >= between * (1 + SPARE):
            return _moved(gap, name, middle, away, distance, far=far)
    return None


def _rounded(length: float, *, down: bool) -> float:
    if length <= 0.0:
        return 0.0
    step = _step(length)
    return step * (math.floor(length / step + 1e-9) if down else math.ceil(length / step - 1e-9))


def _way(gap: Gap, arm: Arm) -> np.ndarray[tuple[int], np.dtype[np.complex128]]:
    """Places of an arm's pin over all positions at which it is placed."""
    key = canonical(gap.machine, arm.link, arm.pin)
    x, y = gap.rows(row_names("position", key))
    known = np.isfinite(x) & np.isfinite(y)
    return np.asarray(x[known] + 1j * y[known])


def _moved(gap: Gap, name: str, middle: complex, away: complex, distance: float, *, far: bool) -> Remedy | None:
    place = middle + distance * away / abs(away)
    x, y = (round(each, 4) for each in (place.real, place.imag))
    changed = _moving(gap.machine, {f"frame.{name}.x": x, f"frame.{name}.y": y})
    if changed is None:
        return None
    title = _("Move {point} nearer", point=written(name)) if far else _("Move {point} away", point=written(name))
    action = {"do": "set", "path": ["frame", "points", name], "value": [_text(x), _text(y)]}
    places = _places(changed, gap.input)
    actions = [action, *_drawn(changed, places)]
    return Remedy(title, _change(abs(away), distance), _through(gap), actions, {"frame": distance}, places)


def _moving(machine: Mechanism, changes: Mapping[str, float]) -> Mechanism | None:
    """The changed machine, if it passes its cycle."""
    try:
        changed = machine.with_dimensions(changes)
        return changed if try_motion(changed, TRIED).complete else None
    except LinkwrightError:
        return None


def _drawn(machine: Mechanism, places: Mapping[str, list[float]]) -> list[Plain]:
    """The action that draws the points where they would be, so that the assembly stays that of the drawing; none
    where the drawing gives links their sizes."""
    if any(link.geometry == "drawing" for link in machine.links.values()):
        return []
    drawn = {name: places[name] for name in machine.drawing if name in places}
    locked = [address for link in machine.links.values() for address in link.geometry_dimensions()]
    return [{"do": "move", "points": drawn, "locked": locked}] if drawn else []


def _places(machine: Mechanism, at: float) -> dict[str, list[float]]:
    """Where a machine's points are at a coordinate of its driver, m, by their names."""
    try:
        motion = solve_motion(machine, at=at)
    except LinkwrightError:
        return {}
    links = {"frame": machine.frame, **machine.links}
    keys = {point: canonical(machine, name, point) for name, link in links.items() for point in link.points}
    return {point: motion.point(key).position[0].tolist() for point, key in keys.items()}


def wanted(found: Sequence[Remedy]) -> dict[str, float]:
    """Lengths by links that the first remedy with a length asks for, m."""
    return next((dict(each.lengths) for each in found if each.lengths), {})
