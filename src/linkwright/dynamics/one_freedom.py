"""All positions at rest along one free input, by the zeros of the effort that holds the machine."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NoReturn

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.drivers.constant_speed import ConstantSpeed
from linkwright.drivers.free import Free
from linkwright.dynamics.equilibria import Equilibria, Equilibrium, Holding
from linkwright.dynamics.equilibrium_search import BALANCED, SAME, TURN, EquilibriumSearch
from linkwright.dynamics.static_forces import StaticForces
from linkwright.dynamics.vibration import Stability
from linkwright.dynamics.zeros import Sampled, Zero
from linkwright.errors import RequestError
from linkwright.kinematics.cycle import time_span
from linkwright.kinematics.input_range import FARTHEST, InputRange, input_range
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: Steps of a turn, or of a range, to begin with.
STEPS = 360


@dataclass(frozen=True)
class _Range:
    """Where the one free input is searched; ``closed``: the ends are one position."""

    low: float
    high: float
    closed: bool
    reach: InputRange


class OneFreedom(EquilibriumSearch):
    """All positions at rest along one free input."""

    def __init__(self, forces: StaticForces, asked: tuple[float, float] | None) -> None:
        super().__init__(forces)
        self.name = forces.free[0]
        self.rotary = forces.equation.rotary[self.name]
        self.range = self._range(asked)
        self.scale = self.sizes(self._places[None])

    # range ------------------------------------------------------------------------------------------------
    def _range(self, asked: tuple[float, float] | None) -> _Range:
        reach = input_range(_at_rest(self.forces), self.name)
        start, size = float(self.forces.start[0]), self.forces.mechanism.size
        low = -np.inf if reach.start is None else reach.start
        high = np.inf if reach.end is None else reach.end
        if self.rotary and reach.full:
            turns = _turns(self.forces, self.name)
            low, high = asked or (0.0, TURN * turns)
            return _Range(low, high, asked is None, reach)
        if asked is not None:
            low, high = max(low, asked[0]), min(high, asked[1])
            if not low < high:
                _out_of_reach(self.forces, asked, reach)
            return _Range(low, high, False, reach)
        far = FARTHEST * size
        return _Range(max(low, start - far), min(high, start + far), False, reach)

    @cached_property
    def _places(self) -> Floats:
        """Places to begin with: even over full turns, denser near the ends of a range, near the start of a slide that
        has none."""
        low, high = self.range.low, self.range.high
        steps = max(STEPS, round(STEPS * (high - low) / TURN)) if self.rotary else STEPS
        share = np.linspace(0.0, 1.0, steps + 1)
        if self.range.reach.full and not self.rotary:
            start, size = float(self.forces.start[0]), self.forces.mechanism.size
            first, last = np.arcsinh((np.array([low, high]) - start) / (0.1 * size))
            wide = np.linspace(float(first), float(last), steps + 1)
            return np.asarray(start + 0.1 * size * np.sinh(wide))
        if self.range.reach.full:
            return np.asarray(low + (high - low) * share)
        return np.asarray(0.5 * (low + high) - 0.5 * (high - low) * np.cos(np.pi * share))

    # efforts ----------------------------------------------------------------------------------------------
    def _effort(self, sense: int) -> Sampled:
        symbols = ("T", "B") if sense else ("S", "K")
        names = (f"{symbols[0]}:{self.name}", f"{symbols[1]}:{self.name}:{self.name}", "outcome")

        def function(q: Floats) -> Floats:
            value, slope, outcome = self.forces.evaluate(names, q[None], sense)
            return np.where(outcome == 0.0, [value, slope], np.nan)

        return Sampled(function, self._places, float(self.scale[0]))

    @cached_property
    def free_effort(self) -> Sampled:
        """Effort without friction, the mean of both senses where brakes act."""
        return self._effort(0)

    @cached_property
    def both(self) -> tuple[Sampled, Sampled] | None:
        """Efforts as it begins to move up and down, where they differ."""
        if not self.forces.directed:
            return None
        up, down = self._effort(1), self._effort(-1)
        gap = np.abs(up.function(self._places)[0] - down.function(self._places)[0])
        return (up, down) if np.nanmax(gap, initial=0.0) > BALANCED * self.scale[0] else None

    # positions --------------------------------------------------------------------------------------------
    @cached_property
    def found(self) -> Equilibria:
        """The result."""
        zeros = self._merged(self.free_effort.zeros)
        positions = [self._position(each, zeros) for each in zeros] if self.both is None else self._held_parts(zeros)
        largest, least = self._holding()
        turn = self.free_effort.integral(self.range.low, self.range.high) if self.range.closed else None
        return Equilibria(
            self.forces,
            tuple(positions),
            {self.name: (self.range.low, self.range.high)},
            self.range.closed,
            self.range.reach,
            largest,
            least,
            turn,
        )

    def _merged(self, zeros: Sequence[Zero]) -> list[Zero]:
        """Without those that are found twice, at both ends of full turns too."""
        lap = self.range.high - self.range.low if self.range.closed else np.inf
        found: list[Zero] = []
        for each in zeros:
            known = (abs(other.place - each.place) for other in found)
            if all(min(gap, lap - gap) > SAME * self.units[0] for gap in known):
                found.append(each)
        return found

    def _position(self, zero: Zero, zeros: Sequence[Zero]) -> Equilibrium:
        reach = None if self.range.closed else (self.range.low, self.range.high)
        more: dict[str, object] = {"reach": reach, "jump": zero.jump}
        if zero.kind == "flat":
            return self.described(np.array([zero.place]), "neutral", low=zero.low, high=zero.high, **more)
        kinds: dict[str, Stability] = {"rising": "stable", "falling": "unstable", "touching": "one_sided"}
        more["barriers"] = self._barriers(zero, zeros) if zero.kind == "rising" else (None, None)
        return self.described(np.array([zero.place]), kinds[zero.kind], **more)

    def _barriers(self, zero: Zero, zeros: Sequence[Zero]) -> tuple[float | None, float | None]:
        """Work to the next position on both sides that does not come back."""
        lap = self.range.high - self.range.low if self.range.closed else 0.0
        others = [other.place + turn for other in zeros if other.kind != "rising" for turn in {-lap, 0.0, lap}]
        below = max((each for each in others if each < zero.place), default=None)
        above = min((each for each in others if each > zero.place), default=None)
        found = [None if each is None else self._work(zero.place, each) for each in (below, above)]
        return found[0], found[1]

    def _work(self, begin: float, end: float) -> float:
        """Work of a hand that moves it slowly, without friction."""
        effort, (low, high) = self.free_effort, (self.range.low, self.range.high)
        if low <= end <= high:
            low_end, high_end = sorted((begin, end))
            work = effort.integral(low_end, high_end)
            return work if end > begin else -work
        if end > high:
            return effort.integral(begin, high) + effort.integral(low, end - (high - low))
        return -effort.integral(low, begin) - effort.integral(end + (high - low), high)

    def _held_parts(self, zeros: Sequence[Zero]) -> list[Equilibrium]:
        """Parts of the range in which it would have to be pushed up to move up, and down to move down."""
        assert self.both is not None
        up, down = self.both
        low, high = self.range.low, self.range.high
        ends = [each for sampled in (up, down) for zero in sampled.zeros for each in _ends(zero)]
        edges = np.unique(np.clip([low, *ends, high], low, high))
        middles = 0.5 * (edges[:-1] + edges[1:])
        tolerance = BALANCED * self.scale[0]
        rests = (up.function(middles)[0] >= -tolerance) & (down.function(middles)[0] <= tolerance)
        parts: list[tuple[float, float]] = []
        for begin, end in zip(edges[:-1][rests], edges[1:][rests], strict=True):
            if parts and abs(parts[-1][1] - begin) <= SAME * self.units[0]:
                parts[-1] = parts[-1][0], float(end)
            else:
                parts.append((float(begin), float(end)))
        return [self._held_part(begin, end, zeros) for begin, end in parts]

    def _held_part(self, begin: float, end: float, zeros: Sequence[Zero]) -> Equilibrium:
        inside = [each.place for each in zeros if begin <= each.place <= end]
        place = inside[0] if len(inside) == 1 else 0.5 * (begin + end)
        reach = None if self.range.closed else (self.range.low, self.range.high)
        return self.described(np.array([place]), "held", low=begin, high=end, reach=reach)

    def _holding(self) -> tuple[Holding | None, Holding | None]:
        """Largest and smallest size of the effort over the range; none where it has no bound at an end."""
        effort = self.free_effort
        sizes = np.where(np.isfinite(effort.values), np.abs(effort.values), np.nan)
        if np.isnan(sizes).all():
            return None, None
        found = []
        for index in (int(np.nanargmax(sizes)), int(np.nanargmin(sizes))):
            place = effort.extreme_near(index)
            found.append(Holding(effort.value(place), place))
        return found[0], found[1]


def _ends(zero: Zero) -> list[float]:
    return [zero.low, zero.high] if zero.kind == "flat" else [zero.place]


def _out_of_reach(forces: StaticForces, asked: tuple[float, float], reach: InputRange) -> NoReturn:
    kind = "angle" if reach.rotary else "length"
    raise RequestError(
        _(
            "the range from {low} to {high} cannot be reached: {why}",
            code="dynamics.range_out_of_reach",
            low=shown(asked[0], kind),
            high=shown(asked[1], kind),
            why=reach.explain(),
        )
    )


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
