"""What a mechanism does on the stretches of its cycle or way that it reaches, where it does not reach all of it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import cached_property
from math import remainder
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output
from linkwright.curves.curve import Curve, nodes
from linkwright.curves.polynomials import PLACES, POINTS, WEIGHTS, weights_at
from linkwright.errors import LinkwrightError
from linkwright.kinematics.motion import Motion
from linkwright.metrics.solved_again import Resolver

#: Pieces of a stretch.
PIECES = 24
#: Share of its size to which polynomials meet an output: nothing is solved very near the ends.
MET = 3e-7
#: Shares of the first and the last piece, next to the ends, that are left out where nothing is solved so near.
LEFT_OUT = (0.0, 0.05, 0.15, 0.25)


class Ways:
    """The motion on every stretch that is reached, at the Gauss points of ``PIECES`` pieces by the cosine of the
    place in it, as points come to the ends of their range with infinite rates."""

    def __init__(self, motion: Motion, resolver: Resolver) -> None:
        self._motion, self._resolver = motion, resolver
        self._results: dict[str, list[Any]] = {}

    @property
    def motions(self) -> tuple[Motion, ...]:
        """One of every stretch; none where nothing can be solved between the positions."""
        return tuple(way for way, _ in self._solved)

    @cached_property
    def _solved(self) -> tuple[tuple[Motion, float], ...]:
        """These, with the share of the pieces next to the ends that is left out."""
        if not self._resolver.possible or self._motion.steps < 2:
            return ()
        try:
            return tuple(self._way(*stretch) for stretch in self._resolver.stretches)
        except LinkwrightError:
            return ()

    def _way(self, start: float, end: float) -> tuple[Motion, float]:
        found: list[Motion] = []
        for share in LEFT_OUT:
            edges = np.linspace(np.pi, 2.0 * np.pi, PIECES + 1)
            edges[[0, -1]] += share * np.pi / PIECES * np.array([1.0, -1.0])
            turn = np.cos(nodes(edges).T.ravel())
            found.append(self._resolver.motion(0.5 * (start + end) + 0.5 * (end - start) * turn))
            if found[-1].ok.all():
                return found[-1], share
        return found[0], 0.0

    def read(self, signal: Callable[[Any], Floats], of: str) -> list[tuple[Floats, Floats]]:
        """Times, s, and a signal of the motion, or of the forces, on every stretch."""
        if of not in self._results:
            self._results[of] = [
                way if of == "motion" else self._resolver.forces(way) for way in self.motions
            ]
        return [
            (way.time, np.asarray(signal(solved), dtype=float))
            for way, solved in zip(self.motions, self._results[of], strict=True)
        ]

    def mean(self, signal: Callable[[Any], Floats], of: str) -> float:
        """The mean over their time of a signal, which is finite at their ends."""
        total = span = 0.0
        for number, (time, values) in enumerate(self.read(signal, of)):
            start, end = self._resolver.stretches[number]
            pace = np.sqrt(np.maximum((time - start) * (end - time), 0.0))
            pieces = self.to_ends(values * pace, number)
            total += np.pi / PIECES * float(np.nansum(pieces @ WEIGHTS))
            span += end - start
        return total / span

    def to_ends(self, values: Floats, number: int) -> Floats:
        """Values (..., PIECES * POINTS) on a way at the Gauss points of pieces up to its ends, (..., PIECES, POINTS):
        by the polynomials of the outer pieces where their ends were left out."""
        found, share = values.reshape(*values.shape[:-1], PIECES, POINTS).copy(), self._solved[number][1]
        if share:
            weights = weights_at((PLACES + 1.0 - 2.0 * share) / (1.0 - share) - 1.0)
            found[..., 0, :] = found[..., 0, :] @ weights
            found[..., -1, :] = (found[..., -1, ::-1] @ weights)[..., ::-1]
        return found

    @property
    def known(self) -> bool:
        """Whether something is solved on every stretch."""
        return bool(self.motions) and all(way.ok.any() for way in self.motions)

    @property
    def whole(self) -> bool:
        """Whether everything is."""
        return bool(self.motions) and all(way.ok.all() for way in self.motions)

    def ranges(self, output: Output, limits: Iterable[tuple[float, float]]) -> Iterator[tuple[float, bool]]:
        """The way of an output between its outermost places on every stretch, and whether polynomials meet it;
        ``limits``: the times, s, of the ends of all stretches, with the values of the output there, NaN where not
        known."""
        curves, ends = [way.read(output) for way in self.motions], list(limits)
        for number, (way, values) in enumerate(zip(self.motions, curves, strict=True)):
            known, exact = values[way.ok].tolist(), bool(way.ok.all())
            if exact:
                curve = self.to_ends(values, number)
                outer = Curve(np.arange(PIECES + 1.0), curve.T, MET).extremes()
                exact = all(each.smooth for each in outer)
                known += [each.value for each in outer]
            for time, value in ends:
                nearest, beside = self._beside(curves, time)
                if nearest == number:
                    known.append(value + _turn(output, beside - value))
            found = np.array(known)[~np.isnan(known)]
            yield (float("inf") if np.isinf(found).any() else float(np.ptp(found))), exact

    def _beside(self, curves: Iterable[Floats], time: float) -> tuple[int, float]:
        """The number of the way nearest to a time, s, of an end, and the value on it there."""
        period = self._motion.positions.period
        rims = [
            (float(way.time[k]) - time, number, float(values[k]))
            for number, (way, values) in enumerate(zip(self.motions, curves, strict=True))
            for k in np.flatnonzero(way.ok)[[0, -1]]
        ]
        return min(rims, key=lambda rim: abs(remainder(rim[0], period) if period else rim[0]))[1:]


def _turn(output: Output, gap: float) -> float:
    """The whole turns, rad, nearest to a gap between two values of an angle; zero for other outputs."""
    return 2 * np.pi * round(gap / (2 * np.pi)) if output.kind == "angle" and np.isfinite(gap) else 0.0
