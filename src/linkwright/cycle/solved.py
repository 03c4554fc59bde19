"""The cycles of some designs: events, the loads that they switch, pieces between them, and summaries of signals."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

import numpy as np

from linkwright.core.arrays import EQUAL, Flags, Floats, Indices
from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.curves.pieces import HIGH, LOW, Layout, Pieces, Wanted
from linkwright.curves.polynomials import NODES, Peak, best_of, climbed, largest
from linkwright.cycle.block import Block
from linkwright.cycle.cycle import Cycle
from linkwright.cycle.load_events import LoadEvents
from linkwright.cycle.summary import Summary
from linkwright.events.events import Events, events
from linkwright.events.formula import ROW
from linkwright.events.stretches import Cuts, Stretches

#: Pieces of a lap of the input to begin with, and where the whole course of signals is asked for, as of curves whose
#: hull is sought among their nodes.
PIECES, PIECES_OF_COURSES = 12, 24


@dataclass(frozen=True)
class Extremes:
    """Extremes of signals on their sides: the ``piece``, the ``place`` in it (-1 to 1), the ``value`` of the output,
    the ``time``, s, (sides, designs) each."""

    piece: Indices
    place: Floats
    value: Floats
    time: Floats


class Solved(Block):
    """The cycles of designs with some columns (designs,); of the machine itself where there are none."""

    def __init__(self, cycle: Cycle, designs: Mapping[str, Floats]) -> None:
        count = len(next(iter(designs.values()))) if designs else 1
        given = {name: np.asarray(each, dtype=float) for name, each in designs.items()}
        super().__init__(cycle.swings, {**given, ROW: np.arange(float(count))}, count)
        self.cycle = cycle
        self.whole = None if cycle.whole is None else Block(cycle.whole, self.designs, count)
        self.loads = LoadEvents(self, self.whole)
        bending = [self.reversals[each] for each in cycle.bending if each in self.reversals]
        found: list[Cuts] = [*self.bends, *self.loads.families, *bending]
        families = list({id(each): each for each in found}.values())
        self.stretches = Stretches(self.span, families, self.loads.knots)
        self.corners: list[Events] = []
        if cycle.signed is not None:
            self.corners = events(cycle.signed, self.known, self.designs, self.stretches, self.loads.columns)
            self.stretches = Stretches(self.span, [*families, *self.corners], self.loads.knots)

    @cached_property
    def pieces(self) -> Pieces:
        """The signals on pieces."""
        cycle = self.cycle
        return Pieces(
            lambda columns, nodes: cycle.formula.run(self.known, columns, nodes),
            Layout(self.stretches.design, self.count, self._columns),
            *self.stretches.first_pieces(PIECES_OF_COURSES if cycle.even_words else PIECES),
            Wanted(cycle.even, tuple((k, sign) for k, sign, _ in cycle.sides), alike=cycle.alike),
        )

    def _columns(self, stretch: Indices, first: Floats, last: Floats) -> dict[str, Floats]:
        design = self.stretches.design[stretch]
        low, high = self.stretches.ends(stretch, first, last)
        found = {name: each[design] for name, each in self.designs.items()} | {LOW: low, HIGH: high}
        return found | self.loads.columns(design, low, 0.5 * (low + high))

    @cached_property
    def passed(self) -> Flags:
        """Designs that pass the whole cycle, with friction that is certain, and loads that have values,
        (designs,)."""
        valid = self.pieces.most(-self.pieces.bottom[-1]) == -1.0
        tracked = self.known.paths is None or self.known.paths.passed
        return np.asarray(self.pieces.passed & valid & tracked & ~self.loads.lacking)

    @cached_property
    def turned_round(self) -> Flags:
        """Designs in which an output reverses that never does where the numbers are meant, (designs,)."""
        found = np.zeros(self.count, dtype=np.bool_)
        for output in self.cycle.never:
            if output in self.limits:
                found |= np.bincount(self.limits[output].events.design, minlength=self.count) > 0
        return found

    # summaries ------------------------------------------------------------------------------------------
    @cached_property
    def means(self) -> dict[int, Floats]:
        """Means over the time of signals that are met everywhere, (designs,)."""
        even = [*self.cycle.even]
        return dict(zip(even, self.pieces.mean(even), strict=True))

    @cached_property
    def extremes(self) -> Extremes:
        """The extremes of all sides."""
        sides, pieces = self.cycle.sides, self.pieces
        strokes = {
            stroke: self._on_stroke(stroke) for stroke in dict.fromkeys(stroke for *_, stroke in sides)
        }
        rows, side, piece = pieces.contenders(
            [(k, sign) for k, sign, _ in sides], [strokes[stroke] for *_, stroke in sides]
        )
        place, value = climbed(rows)
        signals = np.array([k for k, *_ in sides])
        design, signal = pieces.design[piece], signals[side]
        jumps = pieces.unresolved(signal, piece)
        if jumps.any():
            node = rows[:, jumps].argmax(axis=0)
            place[jumps], value[jumps] = 2.0 * NODES[node] - 1.0, rows[:, jumps].max(axis=0)
        alike = EQUAL * pieces.size[signal, design]
        place = np.where((pieces.top - pieces.bottom)[signal, piece] <= alike, -1.0, place)
        time = pieces.columns[LOW][piece] + 0.5 * (1.0 + place) * pieces.width[piece]
        time = self.inside(time, design)
        best = best_of(value, side * self.count + design, alike, time)
        value = value[best].reshape(len(sides), -1) * np.array([[sign] for _, sign, _ in sides])
        squared = np.array([each.squared for each in self.cycle.number])[signals][:, None]
        value = np.where(squared, np.sqrt(np.maximum(value, 0.0)), value)
        constant = pieces.most(pieces.top) + pieces.most(-pieces.bottom) <= EQUAL * pieces.size
        free = np.array([[stroke is None] for *_, stroke in sides])
        time = np.where(constant[signals] & free, self.span.begin, time[best].reshape(value.shape))
        return Extremes(piece[best].reshape(value.shape), place[best].reshape(value.shape), value, time)

    def _on_stroke(self, stroke: tuple[Output, str] | None) -> Flags | None:
        """The pieces in which an output rises, or falls; None for all."""
        if stroke is None:
            return None
        output, way = stroke
        pieces = self.pieces
        middle = pieces.columns[LOW] + 0.5 * pieces.width
        rising = self.limits[output].rising_at(pieces.design, middle)
        return np.asarray(pieces.each(self.limits[output].complete) & (rising == (way == "rising")))

    @cached_property
    def values(self) -> dict[str, Floats]:
        """All parts, (designs,) each; NaN of designs that do not pass."""
        with np.errstate(invalid="ignore"):
            found = {text: self._value(text, part) for text, part in self.cycle.parts.items()}
        return {text: np.where(self.passed, each, np.nan) for text, each in found.items()}

    def _value(self, text: str, part: Summary) -> Floats:
        kind = part.kind
        if kind.startswith("arg"):
            return self.input_at(self.time_of(text))
        if text in self.cycle.limited:
            limits = self.limits.get(self.cycle.limited[text])
            if limits is None:
                return np.full(self.count, np.nan)
            return limits.at("max") - limits.at("min") if kind == "range" else limits.at(kind)
        signal = self.cycle.words[text]
        k = self.cycle.number[signal]
        if kind == "mean":
            return self.means[k]
        if kind == "rms":
            return np.sqrt(self.means[k] if signal.squared else self.pieces.mean_square(k))
        if kind == "excess":
            high, low = self.excess(k)
            return (high[2] - low[2]) * np.abs(self.speed)
        sides: list[Floats] = [self.extremes.value[side] for side in self.cycle.sides_of[text]]
        if kind == "range":
            return sides[0] - sides[1]
        return np.maximum(np.abs(sides[0]), np.abs(sides[-1])) if kind == "peak" else sides[0]

    def time_of(self, text: str) -> Floats:
        """When a part is there, (designs,) s; NaN of what belongs to no time."""
        kind = self.cycle.parts[text].kind
        sides, output = self.cycle.sides_of.get(text, ()), self.cycle.limited.get(text)
        if kind != "range" and output in self.limits:
            return self.limits[output].time(kind.removeprefix("arg"))
        if kind == "range" or not sides:
            return np.full(self.count, np.nan)
        times: list[Floats] = [self.extremes.time[side] for side in sides]
        if len(times) > 1:
            high, low = (np.abs(self.extremes.value[side]) for side in sides)
            alike = np.abs(high - low) <= EQUAL * np.maximum(high, low)
            times[0] = np.where(np.where(alike, times[0] <= times[1], high > low), *times)
        return times[0]

    def excess(self, k: int) -> list[Peak]:
        """The largest and the smallest integral over the time of a signal's lack of its mean."""
        if k not in self._excess:
            lack, design = self.pieces.excess(k, self.means[k]), self.pieces.design
            both = np.append(design, design + self.count)
            piece, place, value = largest(np.append(lack, -lack, axis=1), both)
            high, low = slice(self.count), slice(self.count, None)
            self._excess[k] = [
                (piece[high], place[high], value[high]),
                (piece[low] - len(design), place[low], -value[low]),
            ]
        return self._excess[k]

    @cached_property
    def _excess(self) -> dict[int, list[Peak]]:
        return {}
