"""The cycles of some designs: events, the loads that they switch, pieces between them, and summaries of signals."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.curves.pieces import HIGH, LOW, Layout, Pieces
from linkwright.cycle.block import Block
from linkwright.cycle.cycle import Cycle
from linkwright.cycle.load_events import LoadEvents
from linkwright.cycle.summaries import Summaries
from linkwright.events.events import Events, events
from linkwright.events.formula import ROW
from linkwright.events.stretches import Cuts, Stretches

#: Pieces of a lap of the input to begin with, and where the full course of signals is asked for, as of curves whose
#: hull is sought among their nodes.
PIECES, PIECES_OF_COURSES = 12, 24


class Solved(Block, Summaries):
    """The cycles of designs with some columns (designs,); of the machine itself where there are none."""

    def __init__(self, cycle: Cycle, designs: Mapping[str, Floats]) -> None:
        count = len(next(iter(designs.values()))) if designs else 1
        arrays = {name: np.asarray(each, dtype=float) for name, each in designs.items()}
        super().__init__(cycle.swings, {**arrays, ROW: np.arange(float(count))}, count)
        self.cycle = self.asked = cycle
        self.full = None if cycle.full is None else Block(cycle.full, self.designs, count)
        self.loads = LoadEvents(self, self.full)
        bending = [self.reversals[each] for each in cycle.bending if each in self.reversals]
        found: list[Cuts] = [*self.kinks, *self.loads.families, *bending]
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
            cycle.wanted(cycle.same_dimension, joined=cycle.bent),
        )

    def _columns(self, stretch: Indices, first: Floats, last: Floats) -> dict[str, Floats]:
        design = self.stretches.design[stretch]
        low, high = self.stretches.ends(stretch, first, last)
        found = {name: each[design] for name, each in self.designs.items()} | {LOW: low, HIGH: high}
        return found | self.loads.columns(design, low, 0.5 * (low + high))

    @cached_property
    def passed(self) -> Flags:
        """Designs that pass the full cycle, with friction that is certain, and loads that have values,
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
