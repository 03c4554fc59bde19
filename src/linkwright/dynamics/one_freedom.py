"""All positions at rest along one free input, by the zeros of the effort that holds the machine."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.dynamics.equilibria import Equilibrium, Holding
from linkwright.dynamics.equilibrium_search import BALANCED, SAME, EquilibriumSearch
from linkwright.dynamics.extent import Extent
from linkwright.dynamics.static_forces import StaticForces
from linkwright.dynamics.vibration import Stability
from linkwright.dynamics.zeros import Sampled, Zero


class OneFreedom(EquilibriumSearch):
    """All positions at rest along one free input, in one extent of it."""

    def __init__(self, forces: StaticForces, extent: Extent) -> None:
        super().__init__(forces.of(extent.modes))
        self.name, self.extent = forces.free[0], extent
        rotary, start = forces.equation.rotary[self.name], float(forces.start[0])
        self.places = extent.places(rotary, start, forces.mechanism.size)
        self.scale = self.sizes(self.places[None])

    # efforts ----------------------------------------------------------------------------------------------
    def _effort(self, sense: int) -> Sampled:
        symbols = ("T", "B") if sense else ("S", "K")
        names = (f"{symbols[0]}:{self.name}", f"{symbols[1]}:{self.name}:{self.name}", "outcome")

        def function(q: Floats) -> Floats:
            value, slope, outcome = self.forces.evaluate(names, q[None], sense)
            return np.where(outcome == 0.0, [value, slope], np.nan)

        return Sampled(function, self.places, float(self.scale[0]))

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
        gap = np.abs(up.function(self.places)[0] - down.function(self.places)[0])
        return (up, down) if np.nanmax(gap, initial=0.0) > BALANCED * self.scale[0] else None

    # positions --------------------------------------------------------------------------------------------
    @cached_property
    def positions(self) -> list[Equilibrium]:
        """All of them, by coordinate."""
        zeros = self._merged(self.free_effort.zeros)
        found = [self._position(each, zeros) for each in zeros] if self.both is None else self._held_parts(zeros)
        found += self._at_stops(found, zeros)
        return sorted(found, key=lambda each: each.place[0])

    @property
    def work_of_turn(self) -> float | None:
        """Work of what acts over full turns, J, with the other sign: zero where it has a potential."""
        return self.free_effort.integral(self.extent.low, self.extent.high) if self.extent.closed else None

    def _at_stops(self, found: Sequence[Equilibrium], zeros: Sequence[Zero]) -> list[Equilibrium]:
        """Ends at which a stop keeps it from going on."""
        up, down = self.both or (self.free_effort, self.free_effort)
        stopped = []
        for side, stop in enumerate(self.extent.stops):
            place = self.extent.high if side else self.extent.low
            effort = down.value(place) if side else up.value(place)
            pushed = -effort if side else effort
            ends = (end for each in found for end in (each.low, each.high, each.place[0]) if end is not None)
            known = (abs(end - place) for end in ends)
            if stop and pushed > BALANCED * self.scale[0] and min(known, default=1.0) > SAME * self.units[0]:
                at = np.array([place])
                lever = abs(float(self.forces.stop_levers(stop, at[:, None])[0, 0]))
                barriers = self._barriers(Zero(place, "rising"), zeros)
                contact = pushed / lever
                stopped.append(self._described(at, "stopped", stop=stop, contact=contact, barriers=barriers))
        return stopped

    def _described(self, q: Floats, state: Stability, **more: object) -> Equilibrium:
        reach = None if self.extent.closed else (self.extent.low, self.extent.high)
        return self.described(q, state, reach=reach, beyond=bool(self.extent.modes), **more)

    def _merged(self, zeros: Sequence[Zero]) -> list[Zero]:
        """Without those that are found twice, at both ends of full turns too."""
        lap = self.extent.high - self.extent.low if self.extent.closed else np.inf
        found: list[Zero] = []
        for each in zeros:
            known = (abs(other.place - each.place) for other in found)
            if all(min(gap, lap - gap) > SAME * self.units[0] for gap in known):
                found.append(each)
        return found

    def _position(self, zero: Zero, zeros: Sequence[Zero]) -> Equilibrium:
        at = np.array([zero.place])
        if zero.kind == "flat":
            return self._described(at, "neutral", low=zero.low, high=zero.high)
        kinds: dict[str, Stability] = {"rising": "stable", "falling": "unstable", "touching": "one_sided"}
        barriers = self._barriers(zero, zeros) if zero.kind == "rising" else (None, None)
        return self._described(at, kinds[zero.kind], jump=zero.jump, barriers=barriers)

    def _barriers(self, zero: Zero, zeros: Sequence[Zero]) -> tuple[float | None, float | None]:
        """Work to the next position on both sides that does not come back."""
        lap = self.extent.high - self.extent.low if self.extent.closed else 0.0
        others = [other.place + turn for other in zeros if other.kind != "rising" for turn in {-lap, 0.0, lap}]
        below = max((each for each in others if each < zero.place), default=None)
        above = min((each for each in others if each > zero.place), default=None)
        found = [None if each is None else self._work(zero.place, each) for each in (below, above)]
        return found[0], found[1]

    def _work(self, begin: float, end: float) -> float:
        """Work of a hand that moves it slowly, without friction."""
        effort, (low, high) = self.free_effort, (self.extent.low, self.extent.high)
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
        low, high = self.extent.low, self.extent.high
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
        return self._described(np.array([place]), "held", low=begin, high=end)

    def holding(self) -> tuple[Holding | None, Holding | None]:
        """Largest and smallest size of the effort over the extent; no largest one towards dead points."""
        effort = self.free_effort
        sizes = np.where(np.isfinite(effort.values), np.abs(effort.values), np.nan)
        if np.isnan(sizes).all():
            return None, None
        found = []
        for index in (int(np.nanargmax(sizes)), int(np.nanargmin(sizes))):
            place = effort.extreme_near(index)
            found.append(Holding(effort.value(place), place))
        bounded = "dead_point" not in self.extent.ends
        return found[0] if bounded else None, found[1]


def _ends(zero: Zero) -> list[float]:
    return [zero.low, zero.high] if zero.kind == "flat" else [zero.place]
