"""What is found of the signals of some designs at Gauss points, and the summaries and weights that follow."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.core.piecewise import POINTS, WEIGHTS, Peak, weights_at, weights_up_to
from linkwright.cycle.summary import TRUE_SPEED, Summary
from linkwright.cycle_programs.piece_summaries import SIDES, Reduced
from linkwright.cycle_programs.steady_designs import SMOOTH, SteadyDesigns


class Seen:
    """What is found of the signals of some designs, and what is made of it.

    ``passed``: which designs pass the cycle; ``certain``: of which of them all that was asked is met by polynomials,
    but for the true speed; ``running``: of which that is met; ``fields`` (designs, n): what is carried in groups
    without closed form.
    """

    def __init__(
        self,
        values: Mapping[str, Floats],
        found: Reduced,
        steady: SteadyDesigns,
        pieces: int,
        passed: Flags,
        fields: Mapping[str, Floats],
    ) -> None:
        self.values, self.found, self.steady, self.pieces, self.fields = values, found, steady, pieces, fields
        self.passed, self.certain = passed, passed.copy()
        self.running = np.ones(len(passed), dtype=np.bool_)

    @property
    def sure(self) -> Flags:
        """Of which designs all that was asked is met."""
        return self.certain & self.running

    def summary(self, part: Summary) -> Floats:
        """A summary, (designs,)."""
        if part.kind in TRUE_SPEED:
            value, met = self.steady.number(part)
            self.running &= met
            return value
        if part.kind in ("mean", "rms"):
            mean, square = self.found.powers[part.output]
            self._met(self.found.bounds[part.output][2], self._size(part.output))
            return mean if part.kind == "mean" else np.sqrt(square)
        if part.kind == "excess":
            self._met(self.found.bounds[part.output][2], self._size(part.output))
            return self.steady.way * np.abs(
                sum(self.found.peaks[part.output, side][2] for side in SIDES[part.kind])
            )
        sides = [self._extreme(part.output, side)[2] for side in SIDES[part.kind]]
        if part.kind == "range":
            return sides[0] + sides[1]
        if part.kind == "peak":
            return np.maximum(np.abs(sides[0]), np.abs(sides[1]))
        return sides[0] if part.kind == "max" else -sides[0]

    def weights(self, part: Summary) -> dict[str, Floats]:
        """Weights (designs, n) of the Gauss points in a summary, by the names of the fields that take them; none for
        means, whose weights are the widths."""
        self.summary(part)
        if part.kind in TRUE_SPEED:
            return self.steady.weights(part)
        if part.kind == "excess":
            return {f"{part.output} excess": self._excess(part.output)}
        found: dict[str, Floats] = {}
        for side in SIDES.get(part.kind, ()):
            piece, place = self._extreme(part.output, side)[:2]
            rows = np.zeros((len(piece), POINTS, self.pieces))
            rows[np.arange(len(piece)), :, piece] = weights_at(place)
            found[f"{part.output} {side}"] = rows.reshape(len(piece), -1)
        return found

    def _extreme(self, output: str, side: str) -> Peak:
        found = self.found.peaks[output, side]
        self._met(found[3], self._size(output))
        return found

    def _size(self, output: str) -> Floats:
        top, bottom, _ = self.found.bounds[output]
        return np.maximum(top, -bottom)

    def _excess(self, output: str) -> Floats:
        """Weights with which widths times a signal's lack of its mean give the largest excess of its integral."""
        found = np.zeros((len(self.certain), POINTS, self.pieces))
        rows, pieces = np.arange(len(found)), np.arange(self.pieces)
        for sign, side in zip((1.0, -1.0), SIDES["excess"], strict=True):
            piece, place = self.found.peaks[output, side][:2]
            found += sign * (pieces < piece[:, None])[:, None, :]
            found[rows, :, piece] += sign * weights_up_to(place) / WEIGHTS
        return found.reshape(len(found), -1)

    def _met(self, rough: Floats, size: Floats) -> None:
        with np.errstate(invalid="ignore"):
            self.certain &= rough <= SMOOTH * size
