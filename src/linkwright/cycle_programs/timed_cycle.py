"""The cycle of many designs at Gauss points of the time: whatever laws the drivers follow, closed or not.

The pieces are those between which the machine itself is smooth, see ``metrics/cycle_grid.py``: where laws of drivers
go over from one formula to the next and loads begin and end at given inputs, that is so in all its designs. The times
at which friction turns round, and loads that go by a velocity, are put in among these times in every design.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import field, replace
from functools import cached_property, reduce
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.core.piecewise import NODES, POINTS, WEIGHTS, nodes
from linkwright.cycle_programs.corners import (
    AROUND,
    REACH,
    REST,
    Corner,
    Signed,
    corner_stages,
    corners_of,
    signed_values,
)
from linkwright.cycle_programs.gauss_cycle import SHARE, GaussCycle, certain, ordered_cuts, side_by_side
from linkwright.cycle_programs.limit_stages import whole_turns
from linkwright.cycle_programs.traced import VALID, Traced
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.program import Program
from linkwright.engine.stage import Stage
from linkwright.engine.trace import Scalar, Trace, floor, maximum, minimum
from linkwright.errors import LinkwrightError
from linkwright.kinematics.bends import law_bends
from linkwright.kinematics.cycle import at_times, over_cycle
from linkwright.kinetostatics.friction import Swinging
from linkwright.kinetostatics.traced_loads import AlongInput
from linkwright.mechanism.mechanism import Mechanism
from linkwright.metrics import Analysis

#: Halvings of all pieces for designs that are less smooth than the machine itself.
HALVINGS = 3
#: Places at least between two breaks of laws, and how close to these the outermost lie, as share of what is between.
FEW, BESIDE = 6, 1e-7
#: How near to a corner, as share of the cycle, an end of pieces is that corner.
NEAR = 1e-6
#: Share by which a dimension is changed to see whether times and inputs follow from it.
_NUDGE = 1e-3


@dataclass(frozen=True)
class TimedCycle:
    """What ``GaussCycle`` is for whole turns, over the time; ``edges`` of the pieces that no design moves, s;
    ``corners``: where ``signed`` values are zero, at other times in every design."""

    traced: Traced
    edges: tuple[float, ...]
    halvings: int = 0
    corners: tuple[Corner, ...] = ()
    signed: Mapping[str, Signed] = field(default_factory=dict)

    @property
    def pieces(self) -> int:
        """Number of pieces of the cycle."""
        return len(self.edges) - 1 + len(self.corners)

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
        """Inputs (n,) of the programs, and the shares of the time, the first nodes of all pieces first; with corners
        those at the places between which they are sought, and what the shares follow from."""
        if self.corners:
            return {**self.places, **self._among_cuts}
        edges = np.array(self.edges)
        known = at_times(self.traced.mechanism, nodes(edges).T.ravel())
        width = 0.5 * WEIGHTS[:, None] * np.diff(edges) / self._duration
        return {**known.arrays, SHARE: width.ravel()}

    @cached_property
    def places(self) -> dict[str, Floats]:
        """Inputs (n,) of the programs evenly between the breaks of the drivers' laws, and close to these."""
        breaks = self._breaks
        widths = np.diff(breaks)
        counts = np.maximum(FEW, np.floor(self.count * widths / self._duration).astype(int))
        counts[np.argmax(counts)] += self.count - counts.sum()
        time, reach = [], []
        for low, width, count in zip(breaks, widths, counts, strict=False):
            share = np.clip(np.linspace(0.0, 1.0, count), BESIDE, 1.0 - BESIDE)
            time.append(low + width * share)
            reach.append(width * np.minimum(REST / (count - 1), share))
        around = np.zeros(self.count)
        around[-1] = reach[-1].max() if self._joined else 0.0
        known = at_times(self.traced.mechanism, np.concatenate(time))
        return {**known.arrays, REACH: np.concatenate(reach), AROUND: around}

    @cached_property
    def _breaks(self) -> Floats:
        """Times, s, at which a driver's law goes over to another formula or turns round, and both ends of the
        cycle."""
        start, end = self.edges[0], self.edges[-1]
        found, near = law_bends(self.traced.nominal), BESIDE * self._duration
        inner = found[(found > start + near) & (found < end - near)]
        inner = inner[np.diff(inner, prepend=start) > near]
        return np.concatenate([[start], inner, [end]])

    @cached_property
    def _joined(self) -> bool:
        """Whether the end of the cycle goes over into its beginning by the same formulas."""
        apart = np.abs(law_bends(self.traced.nominal)[:, None] - np.array(self.edges)[[0, -1]])
        return self.traced.positions.closed and bool((apart > BESIDE * self._duration).all())

    @property
    def _among_cuts(self) -> dict[str, Floats]:
        """Shares (n,) of the time at which the pieces that can bound those of the Gauss points begin, place and width
        in their own pieces."""
        cuts, edges = len(self.corners), (np.array(self.edges) - self.edges[0]) / self._duration
        piece = np.tile(np.arange(self.pieces), POINTS)
        around = {f"edge {k}": edges[np.clip(piece - cuts + k, 0, len(edges) - 1)] for k in range(cuts + 2)}
        inside, width = (np.repeat(row, self.pieces) for row in (0.5 * (1.0 + NODES), 0.5 * WEIGHTS))
        return {**around, "inside": inside, "width": width}

    @property
    def constants(self) -> dict[str, float]:
        """None: no number of a cycle of turns is taken."""
        return {}

    # corners ----------------------------------------------------------------------------------------
    def cornered(
        self, loads: AlongInput, signals: Iterable[Scalar], rubbing: Iterable[Swinging]
    ) -> TimedCycle:
        """The same with cuts where friction and the forces of teeth in ``signals`` bend and what is ``rubbing``
        turns round, in the machine as it is, instead of the pieces' ends that lie there; drivers turn round
        between pieces."""
        signed = signed_values(self.traced, signals, rubbing)
        known = {**self.traced.solver.nominal.parameters, **loads.constants}
        corners = corners_of(self, signed, (), known, self.places, loads.tables)
        cut, breaks = replace(self, corners=corners, signed=signed), self._breaks
        stages = CycleProgram(tuple(cut.cut_stages()))
        table = np.array([[known[name] for name in stages.dimensions]])
        results = stages.evaluate(table, cut.places, tables=loads.tables, threads=1)
        at = [self.edges[0] + self._duration * float(results[f"cut {k}"][0]) for k in range(len(corners))]
        edges, near = np.array(self.edges), NEAR * self._duration
        edges = edges[(np.abs(edges[:, None] - np.append(breaks, at)) > near).all(axis=1)]
        return replace(cut, edges=tuple(np.sort(np.append(edges, breaks)).tolist()))

    def cut_stages(self, beside: Traced | None = None) -> list[Stage]:
        """The stages that find the times of corners, and bring them into order."""
        if not self.corners:
            return []
        t, start = Trace(), self.edges[0]
        shares: list[Scalar] = [(t.parameter(each.name) - start) / self._duration for each in self.corners]
        if self._joined:
            shares = [share - floor(share) for share in shares]
        return [*corner_stages(self, self.signed, self.corners), ordered_cuts(t, shares)]

    def span(self, t: Trace) -> tuple[Scalar, Scalar]:
        """The time, s, at which the cycle begins, and how long it is."""
        return self.edges[0], self._duration

    def place(self, t: Trace) -> Scalar:
        """The times, s, between which corners are sought."""
        return t.position("time")

    def over_places(self, program: Program) -> Program:
        """A program of the motion over these."""
        return program

    def there(self, program: Program, t: Trace, x: Scalar) -> dict[str, Any]:
        """The outputs of a program of the motion at a time, s."""
        start = self.edges[0]
        if self._joined:
            share = (x - start) / self._duration
            x = start + self._duration * (share - floor(share))
        return self.traced.at_time(program, t, x, (start, self.edges[-1]))

    # signals ----------------------------------------------------------------------------------------
    def signals(
        self, outputs: Mapping[str, Scalar], one_way: Iterable[Output] = ()
    ) -> tuple[Trace, dict[str, Scalar]]:
        """A trace over the Gauss points with the outputs, whether they are valid, and the share of the time."""
        trace, found = self.traced.solver.motion.trace, {**outputs, VALID: certain(self.traced, one_way)}
        if not self.corners:
            return trace, {**found, SHARE: trace.position(SHARE)}
        t = Trace()
        cuts: list[Scalar] = [t.parameter(f"cut {k}") for k in range(len(self.corners))]
        low, high = (self._end(t, cuts, following) for following in (0, 1))
        time = self.edges[0] + self._duration * (low + t.position("inside") * (high - low))
        return t, {**self.there(Program.of(trace, found), t, time), SHARE: t.position("width") * (high - low)}

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
    """The Gauss points of designs that can go together; None where loads go by limits, which move with the
    dimensions, or the machine itself is smooth nowhere, and the cycle is no whole number of turns."""
    if whole_turns(traced):
        return GaussCycle.of(traced, loads, pieces)
    if loads.outputs or analysis.grid is None:
        return None
    return TimedCycle(traced, tuple(analysis.grid.edges.tolist()))
