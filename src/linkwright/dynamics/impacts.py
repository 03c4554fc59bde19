"""Impacts at end stops by Newton's law: the speed after is the restitution times the speed before."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.dynamics.integration import AT_ONCE
from linkwright.dynamics.system import System

#: Below this share of the fastest approach so far a stop is no longer bounced off; below the second one, rounding.
BOUNCES, ROUNDING = 1e-6, 1e-14


class Impacts:
    """The impacts of a run; ``fastest``: the fastest approach to each stop so far, m/s or rad/s."""

    def __init__(self) -> None:
        self.fastest: dict[int, float] = {}

    def at(
        self, system: System, t: float, y: Floats, hit: list[int], touch: list[int]
    ) -> tuple[Floats, list[int], list[tuple[int, float]]]:
        """The state after impacts at stops that are ``hit``, one after the other until none is run into; the stops
        that are touched then, those that were before among them; the impulses, N·s or N·m·s, by stop."""
        n, found, held = len(system.free), y.copy(), set(touch)
        stops = [system.equation.mechanism.stops[name] for name in system.stops]
        impulses: list[tuple[int, float]] = []
        for _round in range(AT_ONCE):
            out = system.outputs(t, found)
            rates = system.at_stops("stop_rate", out)
            number = min({*hit, *held}, key=rates.__getitem__)
            rate = float(rates[number])
            if rate >= -ROUNDING * self.fastest.get(number, 0.0):
                break
            fastest = self.fastest[number] = max(self.fastest.get(number, 0.0), -rate)
            rebound = 0.0 if number in held else stops[number].restitution
            if -rate * rebound <= BOUNCES * fastest:
                rebound = 0.0
                held.add(number)
            by = system.stop_by(out, number)
            turn = np.linalg.solve(system.mass(out), by)
            impulse = -(1.0 + rebound) * rate / float(by @ turn)
            found[n : 2 * n] += turn * impulse
            impulses.append((number, impulse))
        return found, sorted(held), impulses
