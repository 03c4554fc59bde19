"""The way back: derivatives of summaries by dimensions, through moving nodes, moving cuts and the events behind them.

Of every summary its weights are known: its derivatives by the values at the nodes and by the widths of the pieces.
One sweep back
through the signals turns them into derivatives by the columns of the pieces; those by times go on to the events,
dx/dp = -g_p / g_x; extremes stay where they are (envelope theorem).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.curves.pieces import HIGH, LOW
from linkwright.curves.polynomials import NODES, WEIGHTS, weights_at
from linkwright.cycle.cycle import REACH, Signal, Solved
from linkwright.cycle.loads import WithinInput
from linkwright.events.events import Events

#: Derivatives by the values of signals at the nodes, (POINTS, pieces), and by the widths of the pieces.
Weights = tuple[dict[Signal, Floats], Floats]


class Backward:
    """What is gathered on the way back through the cycles of some designs."""

    def __init__(self, solved: Solved) -> None:
        self.solved, self.cycle, self.pieces = solved, solved.cycle, solved.pieces
        self.found = {name: np.zeros(solved.count) for name in solved.designs}

    def gradient(self, bars: Mapping[str, Floats], more: Weights | None = None) -> dict[str, Floats]:
        """Derivatives by the columns of the designs, (designs,) each, of the sum of ``bars`` (designs,) times parts,
        and of what has ``more`` weights."""
        self._forget()
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
        for each in self.solved.corners:
            self._through_corner(each)
        for events, part, which in self.solved.reached:
            roots, by_columns = self._through_events(events)
            if REACH in by_columns:
                part.pull_reach(which, events.design[roots], by_columns[REACH])
        for acting in self.solved.acting:
            if isinstance(acting, WithinInput):
                for which, bar in enumerate(acting.by_ends):
                    address = f"loads.{acting.name}.phase.input.{which}"
                    if address in self.found:
                        self.found[address] += bar
        for inputs in self.solved.inputs:
            if isinstance(inputs, Events):
                roots, by_columns = self._through_events(inputs)
                address = self.solved.reached_inputs[id(inputs)]
                if REACH in by_columns and address in self.found:
                    np.add.at(self.found[address], inputs.design[roots], by_columns[REACH])
            else:
                self._gather(*inputs.pull(self.solved.machine.course.first.name))
        for repeated in self.solved.repeated:
            repeated.push()
        whole = () if self.solved.whole is None else self.solved.whole.limits.values()
        for limits in (*self.solved.limits.values(), *whole):
            for mine, kept in self.solved.kept_limits:
                if mine is limits and kept is not limits.events:
                    limits.events.bar[np.flatnonzero(limits.is_outermost())] += kept.bar
            self._gather(*limits.pull())
            self._through_events(limits.events)
        for each in (*self.solved.reversals, *self.solved.bends):
            self._through_events(each)
        speed = f"{self.solved.machine.course.first.name}.speed"
        if speed in self.found and self.solved.machine.course.turns:
            self.found[speed] -= self.solved.span.bar * self.solved.span.period / self.solved.speed
        return self.found

    def _forget(self) -> None:
        """Begins anew."""
        self.solved.span.bar[:] = 0.0
        solved = self.solved
        every = [*solved.limits.values(), *(solved.whole.limits.values() if solved.whole else ())]
        ends = [each for acting in solved.acting for each in acting.events]
        for each in (*solved.stretches.families, *(limits.events for limits in every), *ends):
            each.bar[:] = 0.0
        for limits in every:
            limits.bar[:] = 0.0
        for acting in solved.acting:
            if isinstance(acting, WithinInput):
                acting.by_ends[:] = 0.0
        self.found = {name: np.zeros(self.solved.count) for name in self.solved.designs}

    def _gather(self, design: Indices, by_columns: Mapping[str, Floats]) -> None:
        for name, bars in by_columns.items():
            if name in self.found:
                np.add.at(self.found[name], design, bars)

    def _through_events(self, events: Events) -> tuple[Indices, dict[str, Floats]]:
        """From derivatives by the times of events those by the designs' columns."""
        if not events.bar.any():
            return np.empty(0, dtype=np.intp), {}
        design, by_columns, roots = events.pull()
        self._gather(design, by_columns)
        return roots, by_columns

    def _through_corner(self, events: Events) -> None:
        """The same of events of what loads move."""
        roots, by_columns = self._through_events(events)
        if len(roots):
            for acting in self.solved.acting:
                acting.pull(events.design[roots], events.within[roots], by_columns)

    def _through_pieces(self, weights: Mapping[Signal, Floats], by_width: Floats) -> None:
        pieces = self.pieces
        named = {str(signal): each for signal, each in weights.items()}
        by_columns = self.cycle.formula.vjp(self.solved.known, pieces.columns, NODES, named)
        self._gather(pieces.design, by_columns)
        low = by_columns.get(LOW, 0.0) - by_width
        high = by_columns.get(HIGH, 0.0) + by_width
        middle = pieces.columns[LOW] + 0.5 * pieces.width
        for acting in self.solved.acting:
            acting.pull(pieces.design, middle, by_columns)
        self.solved.stretches.move(pieces.stretch, pieces.first, pieces.last, low, high)

    def _at_limits(self, text: str, bar: Floats) -> None:
        kind, limits = self.cycle.parts[text].kind, self.solved.limits.get(self.cycle.limited[text])
        if limits is None:
            return
        if kind.startswith("arg"):
            place = limits.first[kind[3:]]
            has = place >= 0
            np.add.at(limits.events.bar, place[has], (bar * self.solved.speed)[has])
            self._by_speed(bar, limits.time(kind[3:]))
            return
        for side, sign in (("max", 1.0), ("min", -1.0 if kind == "range" else 1.0)):
            if kind in (side, "range"):
                np.add.at(limits.bar, limits.outermost[side], sign * bar)

    def _by_speed(self, bar: Floats, time: Floats) -> None:
        """What the input at a time changes with the driver's own dimensions."""
        name = self.solved.machine.course.first.name
        if f"{name}.speed" in self.found:
            self.found[f"{name}.speed"] += np.nan_to_num(bar * time)
        if f"{name}.start" in self.found:
            self.found[f"{name}.start"] += bar

    def _weights(self, text: str, bar: Floats) -> tuple[Floats, Floats]:
        """Derivatives of bar · part by the values at the nodes, (POINTS, pieces), and by the pieces' widths."""
        every, part, signal = self.pieces, self.cycle.parts[text], self.cycle.words[text]
        k, kind = self.cycle.number[signal], part.kind
        values = every.values(k)
        if signal.squared:
            with np.errstate(divide="ignore", invalid="ignore"):
                bar = np.where(bar == 0.0, 0.0, bar / (2.0 * self.solved.values[text]))
            kind = "mean" if kind == "rms" else kind
        if kind in ("mean", "rms"):
            if kind == "rms":
                with np.errstate(divide="ignore", invalid="ignore"):
                    bar = np.where(bar == 0.0, 0.0, bar / (2.0 * self.solved.values[text]))
            return self._of_mean(values, bar, square=kind == "rms")
        if kind == "excess":
            return self._of_excess(k, values, bar)
        weight = np.zeros_like(values)
        sides = self.cycle.sides_of[text]
        found = [self.solved.extremes[side] for side in sides]
        for n, (side, (piece, place, value)) in enumerate(zip(sides, found, strict=True)):
            factor = bar * (side[1] if kind == "range" else 1.0)
            if kind == "peak" and not signal.squared:
                mine = np.abs(value) > np.abs(found[1][2]) if n == 0 else np.abs(value) >= np.abs(found[0][2])
                factor = bar * np.sign(value) * mine
            weight[:, piece] += weights_at(place) * factor
        return weight, np.zeros(len(every.stretch))

    def _of_mean(self, values: Floats, bar: Floats, *, square: bool) -> tuple[Floats, Floats]:
        every = self.pieces
        by_mean = every.each(bar / every.period)
        power = values * values if square else values
        whole = WEIGHTS @ power
        by_width = (whole - every.each(every.total(whole * every.width) / every.period)) * by_mean
        return WEIGHTS[:, None] * every.width * by_mean * (2.0 * values if square else 1.0), by_width

    def _of_excess(self, k: int, values: Floats, bar: Floats) -> tuple[Floats, Floats]:
        """Largest less smallest of W(x) = ∫ (mean - signal): of the signal between both places, and of the mean's
        way there."""
        every, speed = self.pieces, np.abs(self.solved.speed)
        upto = np.zeros_like(values)
        high, low = self.solved.excess(k)
        for sign, (piece, place, _) in ((1.0, high), (-1.0, low)):
            upto[:, piece] += sign * weights_at(place) * (bar * speed)
        name = f"{self.solved.machine.course.first.name}.speed"
        if name in self.found:
            self.found[name] += bar * (high[2] - low[2]) * np.sign(self.solved.speed)
        return every.through_excess(k, self.solved.means[k], upto)
