"""Where one free input can go: full turns, or from end to end: dead points, stops, what was asked for.

At a dead point of the input its group of links goes over into the other assembly mode, and the input turns back: the
machine moves on in another extent over the same coordinate.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal, NoReturn

import numpy as np

from linkwright.core.arrays import Flags, Floats, runs
from linkwright.core.inputs import Input
from linkwright.core.quantity import shown
from linkwright.core.search import edge
from linkwright.drivers.constant_speed import ConstantSpeed
from linkwright.drivers.free import Free
from linkwright.dynamics.static_forces import StaticForces
from linkwright.dynamics.zeros import root
from linkwright.errors import RequestError
from linkwright.kinematics.cycle import time_span
from linkwright.kinematics.input_range import FARTHEST, input_range
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

TURN = 2.0 * np.pi
#: Steps of a turn, or of a range, to begin with; places within which the end of an extent is sought.
STEPS = 360
#: How far from a dead point, as share of the extent, the group that is singular there is told.
NEXT = 1e-6
#: Extents that are passed through dead points at most.
MOST = 8
#: How far beyond a stop is at it.
TOUCHING = 1e-12
#: What ends an extent, besides the names of stops.
End = Literal["dead_point", "asked", "far", "stop"]


@dataclass(frozen=True)
class Extent:
    """From ``low`` to ``high``, rad or m; ``closed``: full turns, the ends are one position.

    ``ends``: what is at both; ``stops``: the stops there; ``modes``: values of parameters that are other assembly
    modes than those of the drawing.
    """

    low: float
    high: float
    closed: bool = False
    ends: tuple[End, End] = ("asked", "asked")
    stops: tuple[str, str] = ("", "")
    modes: Mapping[str, float] = field(default_factory=dict)

    def places(self, rotary: bool, start: float, size: float) -> Floats:
        """Places to begin a search with: even over turns, denser near dead points, and near the start of a slide that
        has no end."""
        steps = max(STEPS, round(STEPS * (self.high - self.low) / TURN)) if rotary else STEPS
        share = np.linspace(0.0, 1.0, steps + 1)
        if "far" in self.ends:
            unit = 0.1 * size
            first, last = np.arcsinh((np.array([self.low, self.high]) - start) / unit)
            return np.asarray(start + unit * np.sinh(first + (last - first) * share))
        if "dead_point" in self.ends:
            return np.asarray(0.5 * (self.low + self.high) - 0.5 * (self.high - self.low) * np.cos(np.pi * share))
        return np.asarray(self.low + (self.high - self.low) * share)


class Extents:
    """The extents of the one free input, that of the drawing first, and what its reach is."""

    def __init__(self, forces: StaticForces, asked: tuple[float, float] | None) -> None:
        self.forces, self.asked = forces, asked
        self.name = forces.free[0]
        self.rotary = forces.equation.rotary[self.name]
        self.start, self.size = float(forces.start[0]), forces.mechanism.size
        self.reach = input_range(_at_rest(forces), self.name)
        drawn = self._stopped(self._drawn())
        self.all = [drawn, *self._beyond(drawn)]

    # as drawn ---------------------------------------------------------------------------------------------
    def _drawn(self) -> Extent:
        reach, far = self.reach, FARTHEST * self.size
        if self.rotary and reach.full:
            if self.asked is not None:
                return Extent(*self.asked)
            return Extent(0.0, TURN * _turns(self.forces, self.name), closed=True)
        low = (-np.inf if self.rotary else self.start - far) if reach.start is None else reach.start
        high = (np.inf if self.rotary else self.start + far) if reach.end is None else reach.end
        ends: list[End] = ["far" if each is None else "dead_point" for each in (reach.start, reach.end)]
        return self._within(Extent(low, high, ends=(ends[0], ends[1])))

    def _within(self, extent: Extent) -> Extent:
        """The part of it that was asked for."""
        if self.asked is None:
            return extent
        low, high = max(extent.low, self.asked[0]), min(extent.high, self.asked[1])
        if not low < high:
            self._out_of_reach()
        ends = (extent.ends[0] if low == extent.low else "asked", extent.ends[1] if high == extent.high else "asked")
        return replace(extent, low=low, high=high, ends=ends)

    def _out_of_reach(self) -> NoReturn:
        assert self.asked is not None
        kind = "angle" if self.rotary else "length"
        low, high = (shown(each, kind) for each in self.asked)
        raise RequestError(
            _(
                "the range from {low} to {high} cannot be reached: {why}",
                code="dynamics.range_out_of_reach",
                low=low,
                high=high,
                why=self.reach.explain(),
            )
        )

    # stops ------------------------------------------------------------------------------------------------
    def _stopped(self, extent: Extent) -> Extent:
        """The part of an extent between stops, about the start or next to it."""
        if not self.forces.stops:
            return extent
        places = extent.places(self.rotary, self.start, self.size)
        if extent.closed:
            places = np.concatenate([places[:-1], places + (extent.high - extent.low)])
        good = (self._gaps(places, extent).min(axis=0) >= -TOUCHING) & self.forces.of(extent.modes).reached(
            places[None]
        )
        if good.all():
            return extent
        if not good.any():
            raise RequestError(
                _(
                    "no position of {name!r} is between its stops; check their sides and values",
                    code="dynamics.nothing_between_stops",
                    name=self.forces.mechanism.name,
                )
            )
        begin, end = self._run_about_start(places, good)
        low, high, low_stop, high_stop = float(places[begin]), float(places[end]), "", ""
        if begin > 0:
            low, low_stop = self._stop_between(places[begin - 1], low, extent)
        if end < len(places) - 1:
            high, high_stop = self._stop_between(places[end + 1], high, extent)
        if extent.closed:
            lap = extent.high - extent.low
            low, high = (each - lap * round((0.5 * (low + high) - self.start) / lap) for each in (low, high))
        ends: tuple[End, End] = ("stop" if low_stop else extent.ends[0], "stop" if high_stop else extent.ends[1])
        return replace(extent, low=low, high=high, closed=False, ends=ends, stops=(low_stop, high_stop))

    def _gaps(self, places: Floats, extent: Extent) -> Floats:
        return self.forces.of(extent.modes).stop_gaps(places[None])

    def _run_about_start(self, places: Floats, good: Flags) -> tuple[int, int]:
        """First and last place of the run of good ones that holds the start, or is next to it."""
        lap, near = TURN, []
        for first, last in runs(good):
            gaps = np.abs(places[first : last + 1] - self.start)
            gaps = np.minimum(gaps % lap, lap - gaps % lap) if self.rotary else gaps
            cut = first == 0 or last == len(places) - 1
            near.append((round(float(gaps.min()), 9), cut, first, last))
        _gap, _cut, first, last = min(near)
        return first, last

    def _stop_between(self, bad: float, good: float, extent: Extent) -> tuple[float, str]:
        """Where the stop that is passed between two places is, and its name."""
        gaps = self._gaps(np.array([bad, good]), extent)
        passed = int(np.argmin(gaps[:, 0]))
        if gaps[passed, 0] >= 0.0 or gaps[passed, 1] < 0.0:
            return good, self.forces.stops[passed]
        place = root(lambda x: float(self._gaps(np.array([x]), extent)[passed, 0]), bad, good)
        return place, self.forces.stops[passed]

    # beyond dead points -----------------------------------------------------------------------------------
    def _beyond(self, drawn: Extent) -> list[Extent]:
        """Extents that are reached through dead points, in other assembly modes."""
        found: list[Extent] = []
        if self.forces.equation.states:
            return found
        left = [(drawn, side) for side in (0, 1) if drawn.ends[side] == "dead_point"]
        while left and len(found) < MOST:
            extent, side = left.pop(0)
            other = self._through(extent, side)
            if other is None or any(_same(other, each) for each in (drawn, *found)):
                continue
            found.append(other)
            left += [(other, k) for k in (0, 1) if other.ends[k] == "dead_point"]
        return found

    def _through(self, extent: Extent, side: int) -> Extent | None:
        """The extent on the other side of a dead point; None where nothing tells its assembly modes."""
        end = extent.high if side else extent.low
        inwards = -1.0 if side else 1.0
        place = end + inwards * NEXT * (extent.high - extent.low)
        group = self.forces.of(extent.modes).weakest_group(np.array([place]))
        mode = Input("mode", group).name
        known = self.forces.equation.numbers
        if mode not in known:
            return None
        flipped = {mode: -extent.modes.get(mode, known[mode])}
        modes = {name: each for name, each in {**extent.modes, **flipped}.items() if each != known[name]}
        forces = self.forces.of(modes)
        span = TURN if self.rotary else FARTHEST * self.size
        places = end + inwards * span * np.linspace(0.0, 1.0, STEPS + 1)[1:]
        places = np.append(place, places[np.abs(places - end) > abs(place - end)])
        good = forces.reached(places[None])
        if not good[0]:
            return None
        if good.all():
            far, kind = float(places[-1]), "far"
        else:
            last = int(np.argmin(good)) - 1
            far = edge(lambda q: forces.reached(q[None]), float(places[last]), float(places[last + 1]))[0]
            kind = "dead_point"
        ends: tuple[End, End] = (kind, "dead_point") if side else ("dead_point", kind)  # type: ignore[assignment]
        low, high = sorted((end, far))
        if self.asked is not None and not max(low, self.asked[0]) < min(high, self.asked[1]):
            return None
        return self._stopped(self._within(Extent(low, high, ends=ends, modes=modes)))


def _same(one: Extent, other: Extent) -> bool:
    near = 1e-6 * (1.0 + abs(one.high - one.low))
    return one.modes == other.modes and abs(one.low - other.low) < near and abs(one.high - other.high) < near


def _at_rest(forces: StaticForces) -> Mechanism:
    """The mechanism with its held inputs where they are held."""
    drivers = dict(forces.mechanism.drivers)
    for name, value in forces.held.items():
        drivers[name] = replace(drivers[name], law=Free(value, 0.0, drivers[name].law.rotary))
    return replace(forces.mechanism, drivers=drivers)


def _turns(forces: StaticForces, name: str) -> int:
    """After how many turns of an input all wheels are back; 1 where they never are."""
    mechanism = _at_rest(forces)
    if not mechanism.higher:
        return 1
    drivers = {}
    for other, driver in mechanism.drivers.items():
        law = ConstantSpeed(1.0 if other == name else 0.0, driver.law.at(0.0), driver.law.rotary)
        drivers[other] = replace(driver, law=law)
    _start, duration, closed = time_span(replace(mechanism, drivers=drivers, loads={}, cycle=None))
    return max(1, round(duration / TURN)) if closed else 1
