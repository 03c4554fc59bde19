"""The way back: derivatives of summaries by dimensions, through moving nodes, moving cuts and the events behind them.

Of every summary its weights are known: its derivatives by the values at the nodes and by the widths of the pieces.
One sweep back through the signals turns them into derivatives by the columns of the pieces; those by times go on to
the events, dx/dp = -g_p / g_x; extremes stay where they are (envelope theorem).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.curves.pieces import HIGH, LOW
from linkwright.curves.polynomials import NODES, WEIGHTS, weights_at
from linkwright.cycle.cycle import ByColumns
from linkwright.cycle.solved import Solved
from linkwright.cycle.summaries import Signal

#: Derivatives by the values of signals at the nodes, (POINTS, pieces), and by the widths of the pieces.
Weights = tuple[dict[Signal, Floats], Floats]


class Backward:
    """What is gathered on the way back through the cycles of some designs."""

    def __init__(self, solved: Solved) -> None:
        self.solved, self.cycle, self.pieces = solved, solved.cycle, solved.pieces
        self.back = ByColumns(solved)
        self.blocks = [solved] if solved.full is None else [solved.full, solved]
        for each in (*self.blocks, solved.loads):
            each.forget()
        for family in solved.stretches.families:
            family.bar[:] = 0.0

    def gradient(self, bars: Mapping[str, Floats], more: Weights | None = None) -> dict[str, Floats]:
        """Derivatives by the columns of the designs, (designs,) each, of the sum of ``bars`` (designs,) times parts,
        and of what has ``more`` weights."""
        weights, by_width = dict(more[0]) if more else {}, np.zeros(len(self.pieces.stretch))
        if more:
            by_width = by_width + more[1]
        for text, bar in bars.items():
            if text in self.cycle.limited:
                self._at_limits(text, bar)
                continue
            signal = self.cycle.words[text]
            weight, own = self._weights(text, bar)
            weights[signal] = weights.get(signal, 0.0) + weight
            by_width += own
        if weights:
            self._through_pieces(weights, by_width)
        for corners in self.solved.corners:
            roots, by_columns = self.back.through(corners)
            if len(roots):
                self.solved.loads.pull_columns(corners.design[roots], corners.within[roots], by_columns)
        self.solved.loads.pull(self.back)
        for block in self.blocks:
            block.pull(self.back)
        return self.back.found

    def _through_pieces(self, weights: Mapping[Signal, Floats], by_width: Floats) -> None:
        pieces = self.pieces
        named = {str(signal): each for signal, each in weights.items()}
        by_columns = self.cycle.formula.vjp(self.solved.known, pieces.columns, NODES, named)
        self.back.add(pieces.design, by_columns)
        low = by_columns.get(LOW, 0.0) - by_width
        high = by_columns.get(HIGH, 0.0) + by_width
        middle = pieces.columns[LOW] + 0.5 * pieces.width
        self.solved.loads.pull_columns(pieces.design, middle, by_columns)
        self.solved.stretches.move(pieces.stretch, pieces.first, pieces.last, low, high)

    def _at_limits(self, text: str, bar: Floats) -> None:
        kind, limits = self.cycle.parts[text].kind, self.solved.limits.get(self.cycle.limited[text])
        if limits is None:
            return
        if kind.startswith("arg"):
            place = limits.first[kind[3:]]
            by_time = self.solved.pull_input(bar, limits.time(kind[3:]), self.back)
            np.add.at(limits.events.bar, place[place >= 0], by_time[place >= 0])
            return
        for side, sign in (("max", 1.0), ("min", -1.0 if kind == "range" else 1.0)):
            if kind in (side, "range"):
                np.add.at(limits.bar, limits.outermost[side], sign * bar)

    def _weights(self, text: str, bar: Floats) -> tuple[Floats, Floats]:
        """Derivatives of bar · part by the values at the nodes, (POINTS, pieces), and by the pieces' widths."""
        every, part, signal = self.pieces, self.cycle.parts[text], self.cycle.words[text]
        k, kind = self.cycle.number[signal], part.kind
        values = every.values(k)
        if signal.squared or kind == "rms":
            size = self.solved.values[text]
            bar = np.divide(bar, 2.0 * size, out=np.zeros_like(bar), where=(bar != 0.0) & (size != 0.0))
        if kind in ("mean", "rms"):
            return self._of_mean(values, bar, square=kind == "rms" and not signal.squared)
        if kind == "excess":
            return self._of_excess(k, values, bar)
        weight, found, sides = np.zeros_like(values), self.solved.extremes, self.cycle.sides_of[text]
        sizes = np.abs(found.value[[*sides]])
        for n, side in enumerate(sides):
            factor = bar * (self.cycle.sides[side][1] if kind == "range" else 1.0)
            if kind == "peak" and not signal.squared:
                mine = sizes[0] > sizes[1] if n == 0 else sizes[1] >= sizes[0]
                factor = bar * np.sign(found.value[side]) * mine
            weight[:, found.piece[side]] += weights_at(found.place[side]) * factor
        return weight, np.zeros(len(every.stretch))

    def _of_mean(self, values: Floats, bar: Floats, *, square: bool) -> tuple[Floats, Floats]:
        every = self.pieces
        by_mean = every.each(bar / every.period)
        power = values * values if square else values
        weighted = WEIGHTS @ power
        by_width = (weighted - every.each(every.total(weighted * every.width) / every.period)) * by_mean
        return WEIGHTS[:, None] * every.width * by_mean * (2.0 * values if square else 1.0), by_width

    def _of_excess(self, k: int, values: Floats, bar: Floats) -> tuple[Floats, Floats]:
        """Largest less smallest of W(x) = ∫ (mean - signal): of the signal between both places, and of the mean's
        way there."""
        every, speed = self.pieces, np.abs(self.solved.speed)
        upto = np.zeros_like(values)
        high, low = self.solved.excess(k)
        for sign, (piece, place, _) in ((1.0, high), (-1.0, low)):
            upto[:, piece] += sign * weights_at(place) * (bar * speed)
        by_speed = bar * (high[2] - low[2]) * np.sign(self.solved.speed)
        self.back.add(np.arange(len(bar)), {f"{self.solved.machine.course.first.name}.speed": by_speed})
        return every.through_excess(k, self.solved.means[k], upto)
