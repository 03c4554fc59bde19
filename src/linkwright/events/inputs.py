"""Cuts at which an input that turns steadily has set values, in the cycles of many designs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.events.stretches import Span


@dataclass
class AtInput:
    """When the input has a ``value`` (designs,), rad, and comes back to it after so many turns, ``every``: (k,) by
    design.

    ``address``: of the dimension that the value is; ``bar``: derivatives by the times.
    """

    span: Span
    value: Floats
    every: int
    address: str
    speed: Floats
    start: Floats

    def __post_init__(self) -> None:
        course, period = self.span.course, self.span.period
        laps = course.turns // self.every if course.turns % self.every == 0 else 1
        turn = 2.0 * pi * self.every / np.abs(self.speed)
        first = (self.value - self.start) / self.speed
        first = first - np.floor((first - course.begin) / turn) * turn
        time = first[:, None] + turn[:, None] * np.arange(laps)
        self.design: Indices = np.repeat(np.arange(len(period)), laps)
        at = self.span.within(self.design, time.ravel())
        order = np.lexsort((at, self.design))
        self.time: Floats = at[order]
        self.bar: Floats = np.zeros(len(at))

    def pull(self, driver: str) -> tuple[Indices, Mapping[str, Floats]]:
        """Derivatives by the dimensions of the designs that are the driver's and the value."""
        by_value = self.bar / self.speed[self.design]
        found = {f"{driver}.start": -by_value, f"{driver}.speed": -by_value * self.time}
        return self.design, {**found, self.address: by_value}
