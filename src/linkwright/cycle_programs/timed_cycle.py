"""The cycle of many designs at Gauss points of the time: whatever laws the drivers follow, closed or not.

The pieces are those between which the machine itself is smooth, see ``metrics/cycle_grid.py``: where laws of drivers
go over from one formula to the next and loads begin and end at given inputs, that is so in all its designs. The times
at which friction turns round, and loads begin and end that go by limits or a velocity, are put in among these times
in every design.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import field, replace
from functools import cached_property, reduce

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.core.piecewise import NODES, POINTS, WEIGHTS, nodes
from linkwright.cycle_programs.corners import (
    Corner,
    Signed,
    corner_stages,
    corners_of,
    rate_name,
    signed_values,
)
from linkwright.cycle_programs.gauss_cycle import (
    SHARE,
    GaussCycle,
    certain,
    ordered_cuts,
    side_by_side,
)
from linkwright.cycle_programs.limit_stages import part_edges, part_of_stroke, to_edge, whole_turns
from linkwright.cycle_programs.timed_limits import TimedLimits, timed_limits
from linkwright.cycle_programs.timed_search import TimedSearch
from linkwright.cycle_programs.traced_outputs import VALID, Traced
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.program import Program
from linkwright.engine.stage import Stage
from linkwright.engine.trace import Scalar, Trace, maximum, minimum, select
from linkwright.errors import LinkwrightError
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.positions import at_times
from linkwright.kinetostatics.friction import Swinging
from linkwright.kinetostatics.traced_loads import AlongInput
from linkwright.mechanism.mechanism import Mechanism
from linkwright.metrics import Analysis

#: Halvings of all pieces for designs that are less smooth than the machine itself.
HALVINGS = 3
#: How near to a corner, as share of the cycle, an end of pieces is that corner.
NEAR = 1e-6
#: Share by which a dimension is changed to see whether times and inputs follow from it.
_NUDGE = 1e-3


@dataclass(frozen=True)
class TimedCycle:
    """What ``GaussCycle`` is for whole turns, over the time; ``edges`` of the pieces that no design moves, s;
    ``limits`` that loads take; ``corners``: where ``signed`` values are zero, at other times in every design."""

    traced: Traced
    edges: tuple[float, ...]
    limits: TimedLimits
    halvings: int = 0
    corners: tuple[Corner, ...] = ()
    signed: Mapping[str, Signed] = field(default_factory=dict)

    @classmethod
    def of(cls, traced: Traced, loads: AlongInput, edges: Floats) -> TimedCycle | None:
        """Of the machine's own pieces; None where limits that loads take are not found over the time."""
        limits = timed_limits(traced, loads, (len(edges) - 1) * POINTS)
        return None if limits is None else cls(traced, tuple(edges.tolist()), limits)._cut(loads)

    @property
    def moving(self) -> tuple[Corner, ...]:
        """All cuts that move with the dimensions."""
        return (*self.limits.corners, *self.corners)

    @property
    def pieces(self) -> int:
        """Number of pieces of the cycle."""
        return len(self.edges) - 1 + len(self.moving)

    @property
    def count(self) -> int:
        """Number of Gauss points."""
        return self.pieces * POINTS

    @property
    def finer(self) -> TimedCycle | None:
        """The same with all pieces halved; None where they were often enough."""
        if self.halvings == HALVINGS:
            return None
        ends = np.array(self.edges)
        halved = np.sort(np.append(ends, 0.5 * (ends[:-1] + ends[1:])))
        return replace(self, edges=tuple(halved.tolist()), halvings=self.halvings + 1)

    @property
    def speed(self) -> float:
        """Rate of the first driver where the cycle begins, rad/s or m/s."""
        return float(next(iter(self.traced.positions.coordinates.values()))[1][0])

    @property
    def way(self) -> float:
        """What the first driver would go in the cycle at this rate, rad or m."""
        return abs(self.speed) * self._duration

    @property
    def _duration(self) -> float:
        return self.edges[-1] - self.edges[0]

    @cached_property
    def positions(self) -> dict[str, Floats]:
        """Inputs (n,) of the programs, and the shares of the time, the first nodes of all pieces first; with cuts
        those at the places between which they are sought, and what the shares follow from."""
        if self._searched:
            return {**self._search.positions, **self._among_cuts}
        edges = np.array(self.edges)
        known = at_times(self.traced.mechanism, nodes(edges).T.ravel())
        width = 0.5 * WEIGHTS[:, None] * np.diff(edges) / self._duration
        return {**known.arrays, SHARE: width.ravel()}

    @property
    def _searched(self) -> bool:
        return bool(self.limits.limits or self.corners)

    @cached_property
    def _search(self) -> TimedSearch:
        """Where corners and limits are sought, between as many places as there are Gauss points."""
        return TimedSearch(self.traced, self.edges[0], self.limits.lap, self.limits.closes, self.count)

    @property
    def constants(self) -> Mapping[str, float]:
        """Numbers of the cycle that programs take."""
        return self.limits.constants

    @property
    def _among_cuts(self) -> dict[str, Floats]:
        """Shares (n,) of the time at which the pieces that can bound those of the Gauss points begin, place and width
        in their own pieces."""
        cuts, edges = len(self.moving), (np.array(self.edges) - self.edges[0]) / self._duration
        piece = np.tile(np.arange(self.pieces), POINTS)
        around = {f"edge {k}": edges[np.clip(piece - cuts + k, 0, len(edges) - 1)] for k in range(cuts + 2)}
        inside, width = (np.repeat(row, self.pieces) for row in (0.5 * (1.0 + NODES), 0.5 * WEIGHTS))
        return {**around, "inside": inside, "width": width}

    # corners ----------------------------------------------------------------------------------------
    def cornered(
        self, loads: AlongInput, signals: Iterable[Scalar], rubbing: Iterable[Swinging]
    ) -> TimedCycle:
        """The same with cuts where friction and the forces of teeth in ``signals`` bend and what is ``rubbing``
        turns round, in the machine as it is, instead of the pieces' ends that lie there; drivers turn round
        between pieces."""
        known = {rate_name(each.output) for each in self.limits.limits}
        signed = {**signed_values(self.traced, signals, rubbing), **self._part_edges(loads)}
        signed = {name: value for name, value in signed.items() if name not in known}
        if not signed or not self._search.possible:
            return self
        search, numbers = self._search, self._numbers(loads)
        before = self.limits.stages(search)
        corners = corners_of(search, signed, before, numbers, search.positions, loads.tables)
        return replace(self, corners=corners, signed=signed)._cut(loads)

    def _part_edges(self, loads: AlongInput) -> dict[str, Signed]:
        """What is zero where parts of strokes begin and end, by name."""
        found: dict[str, Signed] = {}
        for name in sorted(loads.names):
            load = self.traced.mechanism.loads[name]
            if phase := part_of_stroke(load):
                stroke = float(np.ptp(self.traced.nominal.read(phase.output)))
                for which, edge in part_edges(load).items():
                    gap = to_edge(self.traced, load, phase, which)["gap"]
                    found[edge] = Signed(gap, stroke)
        return found

    def _numbers(self, loads: AlongInput) -> dict[str, float]:
        """Those of the machine as it is."""
        return {**self.traced.solver.nominal.parameters, **loads.constants, **self.constants}

    def _cut(self, loads: AlongInput) -> TimedCycle:
        """The same without edges where the machine as it is has cuts that move, and with such where drivers turn
        round."""
        known, moving = self._numbers(loads), len(self.moving)
        stages = CycleProgram((*self.limits.stages(self._search), *self.cut_stages()))
        table = np.array([[known[name] for name in stages.dimensions]])
        results = stages.evaluate(table, self._search.positions, tables=loads.tables, threads=1)
        at = [self.edges[0] + self._duration * float(results[f"cut {k}"][0]) for k in range(moving)]
        edges, near = np.array(self.edges), NEAR * self._duration
        breaks = self._search.breaks
        breaks = np.append(breaks[breaks < edges[-1] - near], edges[-1])
        edges = edges[(np.abs(edges[:, None] - np.append(breaks, at)) > near).all(axis=1)]
        return replace(self, edges=tuple(np.sort(np.append(edges, breaks)).tolist()))

    def limit_stages(
        self, outputs: Iterable[Swinging], valued: Iterable[Output], shown: Iterable[Output]
    ) -> list[Stage]:
        """The stages that find the limits that loads take."""
        return self.limits.stages(self._search)

    def cut_stages(self, beside: Traced | None = None) -> list[Stage]:
        """The stages that find the times of corners, and bring all cuts into order."""
        found = corner_stages(self._search, self.signed, self.corners)
        return [*found, self._ordering] if self.moving else found

    @property
    def _ordering(self) -> Stage:
        """The stage that brings the cuts into order; what lies beyond the cycle is put where nothing bends."""
        t, shares, moving = Trace(), list[Scalar](), self.moving
        for number, each in enumerate(moving):
            share = (self._search.inside(t.parameter(each.name)) - self.edges[0]) / self._duration
            shares.append(select(share <= 1.0, share, (number + 0.5) / len(moving)))
        return ordered_cuts(t, shares)

    # signals ----------------------------------------------------------------------------------------
    def signals(
        self, outputs: Mapping[str, Scalar], one_way: Iterable[Output] = ()
    ) -> tuple[Trace, dict[str, Scalar]]:
        """A trace over the Gauss points with the outputs, whether they are valid, and the share of the time."""
        trace, found = self.traced.solver.motion.trace, {**outputs, VALID: certain(self.traced, one_way)}
        if not self._searched:
            return trace, {**found, SHARE: trace.position(SHARE)}
        t = Trace()
        cuts: list[Scalar] = [t.parameter(f"cut {k}") for k in range(len(self.moving))]
        low, high = (self._end(t, cuts, following) for following in (0, 1))
        time = self.edges[0] + self._duration * (low + t.position("inside") * (high - low))
        return t, {
            **self._search.there(Program.of(trace, found), t, time),
            SHARE: t.position("width") * (high - low),
        }

    def _end(self, t: Trace, cuts: list[Scalar], following: int) -> Scalar:
        """Where a piece begins, or the ``following`` one: of the edges and the ``cuts``, each in order, together the
        one of this number."""
        edges: list[Scalar] = [t.position(f"edge {len(cuts) + following - k}") for k in range(len(cuts) + 1)]
        return reduce(minimum, map(maximum, edges[1:], cuts), edges[0])


def follows_times(traced: Traced, varied: Iterable[str]) -> bool:
    """Whether all designs can be read at the same times: passed without change points by groups in closed form,
    where nothing that varies moves the inputs."""
    motion = traced.solver.motion
    if motion.next_states or not traced.nominal.whole or traced.nominal.modes:
        return False
    steps = traced.positions.steps
    return traced.positions.count > 2 and not any(
        moves(traced.mechanism, address, steps) for address in varied
    )


def moves(mechanism: Mechanism, address: str, steps: int) -> bool:
    """Whether times or inputs of the cycle follow from a dimension."""
    value = mechanism.dimension(address)
    for factor in (1.0 + _NUDGE, 1.0 - _NUDGE):
        try:
            changed = mechanism.with_dimensions({address: factor * value if value else factor - 1.0})
            return over_cycle(changed, steps).key != over_cycle(mechanism, steps).key
        except LinkwrightError:
            continue
    return True


def can_go_together(traced: Traced, varied: Iterable[str]) -> bool:
    """Whether all designs can be read at Gauss points, of whole turns or of the same times."""
    names = tuple(varied)
    return side_by_side(traced, names) or follows_times(traced, names)


def gauss_points(
    traced: Traced, loads: AlongInput, analysis: Analysis, pieces: int
) -> GaussCycle | TimedCycle | None:
    """The Gauss points of designs that can go together; None where the cycle is no whole number of turns, and limits
    by which loads go are not found over the time, or the machine itself is smooth nowhere."""
    if whole_turns(traced):
        return GaussCycle.of(traced, loads, pieces)
    return None if analysis.grid is None else TimedCycle.of(traced, loads, analysis.grid.edges)
