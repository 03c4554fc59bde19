"""A crank that turns evenly, and the motion of a jaw that loads follow."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkwright.applied_loads.signals import FullCycle, Limit
from linkwright.core.outputs import Output

JAW = Output("angle", "jaw")
PERIOD = 2.0


class Turning:
    """A crank that turns once in 2 s; the jaw's angle is cos(input - lag)."""

    ok = np.ones(1, dtype=bool)
    closes = None

    def __init__(self, degrees: Sequence[float], *, speed: float = 1.0, lag: float = 0.0, rotary: bool = True):
        self.input = np.radians(np.asarray(degrees, dtype=float))
        self.heading, self.lag, self.rotary = int(np.sign(speed)), np.radians(lag), rotary
        self.rate = speed * 2 * np.pi / PERIOD
        self.time = self.input / self.rate
        self.full_cycle = FullCycle(PERIOD, 2 * np.pi * self.heading)
        self.mechanism: Any = SimpleNamespace(drivers={"driver": None}, parameters={})

    def output(self, output: Output) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        phase = self.input - self.lag
        return np.cos(phase), -np.sin(phase) * self.rate

    def limits(self, output: Output) -> list[Limit]:
        top, bottom = self._first(self.lag), self._first(self.lag + np.pi)
        found = [Limit(top[0], top[1], 1.0, "max"), Limit(bottom[0], bottom[1], -1.0, "min")]
        return sorted(found, key=lambda each: each.time)

    def _first(self, angle: float) -> tuple[float, float]:
        time = (angle / self.rate) % PERIOD
        return time * self.rate, time

    def angle_between(self, a: str, b: str, near: float) -> NDArray[np.float64]:
        raise AssertionError
