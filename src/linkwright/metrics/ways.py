"""What a mechanism does on the stretches of its cycle or way that it reaches, where it does not reach all of it."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from math import remainder

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output
from linkwright.core.piecewise import POINTS, Piecewise, nodes
from linkwright.errors import LinkwrightError
from linkwright.kinematics.motion import Motion
from linkwright.metrics.cycle_grid import PIECES
from linkwright.metrics.resolve import Resolver

#: Share of its size to which polynomials meet an output: nothing is solved very near the ends.
MET = 3e-7


class Ways:
    """The motion on every stretch that is reached, at the Gauss points of ``PIECES`` pieces by the cosine of the
    place in it, as points come to the ends of their range with infinite rates."""

    def __init__(self, motion: Motion, resolver: Resolver) -> None:
        self._motion, self._resolver = motion, resolver

    @cached_property
    def motions(self) -> tuple[Motion, ...]:
        """One of every stretch; none where nothing can be solved between the positions."""
        if not self._resolver.possible or self._motion.steps < 2:
            return ()
        turn = np.cos(nodes(np.linspace(np.pi, 2.0 * np.pi, PIECES + 1)).ravel())
        try:
            return tuple(
                self._resolver.motion(0.5 * (start + end) + 0.5 * (end - start) * turn)
                for start, end in self._resolver.stretches
            )
        except LinkwrightError:
            return ()

    @property
    def known(self) -> bool:
        """Whether something is solved on every stretch."""
        return bool(self.motions) and all(way.ok.any() for way in self.motions)

    @property
    def whole(self) -> bool:
        """Whether everything is."""
        return bool(self.motions) and all(way.ok.all() for way in self.motions)

    def range(self, output: Output, limits: Iterable[tuple[float, float]]) -> tuple[float, bool]:
        """The way of an output between its outermost places, and whether polynomials meet it; ``limits``: the times,
        s, of the ends of all stretches, with the values of the output there, NaN where not known."""
        curves = [self._turned(output, way) for way in self.motions]
        known, exact = [], self.whole
        for way, values in zip(self.motions, curves, strict=True):
            if exact:
                ends = Piecewise(
                    np.arange(PIECES + 1.0), values.reshape(-1, POINTS), tolerance=MET
                ).extremes()
                exact = all(each.smooth for each in ends)
                known += [each.value for each in ends]
            known += values[way.ok].tolist()
        for time, value in limits:
            known.append(value + _turn(output, self._beside(curves, time) - value))
        found = np.array(known)[~np.isnan(known)]
        return (float("inf") if np.isinf(found).any() else float(np.ptp(found))), exact

    def _turned(self, output: Output, way: Motion) -> Floats:
        """An output on a way, an angle in the turn of the position beside the first place that is known."""
        values, first, ok = way.read(output), int(way.ok.argmax()), self._motion.ok
        beside = np.abs(self._motion.time[ok] - way.time[first]).argmin()
        return np.asarray(values + _turn(output, self._motion.read(output)[ok][beside] - values[first]))

    def _beside(self, curves: Iterable[Floats], time: float) -> float:
        """The value on a way nearest to a time, s, of an end."""
        positions = self._motion.positions
        period = positions.period if positions.closed else None
        rims = [
            (float(way.time[k]) - time, float(values[k]))
            for way, values in zip(self.motions, curves, strict=True)
            for k in np.flatnonzero(way.ok)[[0, -1]]
        ]
        return min(rims, key=lambda rim: abs(remainder(rim[0], period) if period else rim[0]))[1]


def _turn(output: Output, gap: float) -> float:
    """The whole turns, rad, nearest to a gap between two values of an angle; zero for other outputs."""
    return 2 * np.pi * round(gap / (2 * np.pi)) if output.kind == "angle" and np.isfinite(gap) else 0.0
