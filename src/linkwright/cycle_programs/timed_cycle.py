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
    rate_name,
    signed_values,
)
from linkwright.cycle_programs.gauss_cycle import (
    SHARE,
    GaussCycle,
    certain,
    ordered_cuts,
    part_edges,
    side_by_side,
)
from linkwright.cycle_programs.limit_stages import to_edge, whole_turns
from linkwright.cycle_programs.timed_limits import TimedLimit, rate_stages, timed_limits
from linkwright.cycle_programs.traced import VALID, Traced
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.program import Program
from linkwright.engine.stage import Stage
from linkwright.engine.trace import Scalar, Trace, floor, maximum, minimum, select
from linkwright.errors import LinkwrightError
from linkwright.fields.signals import MovingPhase, SwingPhase
from linkwright.kinematics.bends import law_bends, one_formula
from linkwright.kinematics.cycle import at_times, over_cycle
from linkwright.kinetostatics.friction import Swinging
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.kinetostatics.site import DRIFT, LAP, turns_steadily
from linkwright.kinetostatics.traced_loads import AlongInput
from linkwright.loads.magnitude import by_limits
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
    """What ``GaussCycle`` is for whole turns, over the time; ``edges`` of the pieces that no design moves, s.

    ``lap``: how long the cycle is, s, in which limits are found, and whether it ``closes``; ``limits`` that loads
    take, those that are ``valued`` with the outputs there; ``corners``: where ``signed`` values are zero, at other
    times in every design; ``constants``: numbers of the cycle that programs take.
    """

    traced: Traced
    edges: tuple[float, ...]
    lap: float
    closes: bool
    halvings: int = 0
    limits: tuple[TimedLimit, ...] = ()
    valued: tuple[Output, ...] = ()
    corners: tuple[Corner, ...] = ()
    signed: Mapping[str, Signed] = field(default_factory=dict)
    constants: Mapping[str, float] = field(default_factory=dict)

    @classmethod
    def of(cls, traced: Traced, loads: AlongInput, edges: Floats) -> TimedCycle | None:
        """With the limits that loads take; None where these are not found over the time."""
        whole, closed = MotionSignals(traced.nominal).whole, traced.positions.closed
        length = float(edges[-1] - edges[0])
        cycle = cls(traced, tuple(edges.tolist()), length, closed)
        if not loads.outputs:
            return cycle
        closes = whole.period is not None
        if closes and not closed and not one_formula(traced.mechanism):
            return None
        lap = length if whole.period is None else whole.period
        steady = turns_steadily(traced.mechanism)
        way = abs(whole.drift) if steady and closes else abs(cycle.speed) * lap if steady else lap
        numbers = {LAP: way if closes else 2.0 * way, DRIFT: whole.drift}
        cycle = replace(cycle, lap=lap, closes=closes, valued=loads.valued, constants=numbers)
        known = {**traced.solver.nominal.parameters, **loads.constants, **numbers}
        limits = timed_limits(cycle, loads.outputs, known, cycle.places, loads.tables)
        if limits is None or not (closes or _in_order(traced, loads)):
            return None
        numbers |= {name: time for each in limits for name, time in each.constants.items()}
        return replace(cycle, limits=limits, constants=numbers)._cut(loads)

    @property
    def moving(self) -> tuple[Corner, ...]:
        """All cuts that move with the dimensions."""
        return (*(corner for each in self.limits for corner in each.corners.values()), *self.corners)

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
            return {**self.places, **self._among_cuts}
        edges = np.array(self.edges)
        known = at_times(self.traced.mechanism, nodes(edges).T.ravel())
        width = 0.5 * WEIGHTS[:, None] * np.diff(edges) / self._duration
        return {**known.arrays, SHARE: width.ravel()}

    @property
    def _searched(self) -> bool:
        return bool(self.limits or self.corners)

    @cached_property
    def places(self) -> dict[str, Floats]:
        """Inputs (n,) of the programs evenly between the breaks of the drivers' laws, and close to these."""
        breaks = self._breaks
        widths = np.diff(breaks)
        counts = np.maximum(FEW, np.floor(self.count * widths / self.lap).astype(int))
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
        """Times, s, at which a driver's law goes over to another formula or turns round, and both ends of the cycle
        in which limits are found."""
        start, end = self.edges[0], self.edges[0] + self.lap
        found, near = law_bends(self.traced.nominal), BESIDE * self.lap
        inner = found[(found > start + near) & (found < end - near)]
        inner = inner[np.diff(inner, prepend=start) > near]
        return np.concatenate([[start], inner, [end]])

    @cached_property
    def _joined(self) -> bool:
        """Whether the end of that cycle goes over into its beginning by the same formulas."""
        ends = self.edges[0] + np.array([0.0, self.lap])
        apart = np.abs(law_bends(self.traced.nominal)[:, None] - ends)
        return self.closes and bool((apart > BESIDE * self.lap).all())

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
        known = {rate_name(each.output) for each in self.limits}
        signed = {**signed_values(self.traced, signals, rubbing), **self._part_edges(loads)}
        signed = {name: value for name, value in signed.items() if name not in known}
        numbers = self._numbers(loads)
        corners = corners_of(self, signed, self._limit_stages, numbers, self.places, loads.tables)
        return replace(self, corners=corners, signed=signed)._cut(loads)

    def _part_edges(self, loads: AlongInput) -> dict[str, Signed]:
        """What is zero where parts of strokes begin and end, by name."""
        found: dict[str, Signed] = {}
        for name in sorted(loads.names):
            load = self.traced.mechanism.loads[name]
            phase = getattr(load, "phase", None)
            if isinstance(phase, SwingPhase):
                stroke = float(np.ptp(self.traced.nominal.read(phase.output)))
                for which, edge in part_edges(name, phase).items():
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
        stages = CycleProgram(tuple(self.cut_stages()))
        table = np.array([[known[name] for name in stages.dimensions]])
        results = stages.evaluate(table, self.places, tables=loads.tables, threads=1)
        at = [self.edges[0] + self._duration * float(results[f"cut {k}"][0]) for k in range(moving)]
        edges, near = np.array(self.edges), NEAR * self._duration
        breaks = np.append(self._breaks[self._breaks < edges[-1] - near], edges[-1])
        edges = edges[(np.abs(edges[:, None] - np.append(breaks, at)) > near).all(axis=1)]
        return replace(self, edges=tuple(np.sort(np.append(edges, breaks)).tolist()))

    @property
    def _limit_stages(self) -> list[Stage]:
        """The stages that find limits."""
        outputs = [each.output for each in self.limits]
        corners = [corner for each in self.limits for corner in each.corners.values()]
        found = rate_stages(self, outputs, corners)
        return [*found, *(each.stage(self, each.output in self.valued) for each in self.limits)]

    def cut_stages(self, beside: Traced | None = None) -> list[Stage]:
        """The stages that find limits, and the times of all cuts, and bring these into order."""
        found = [*self._limit_stages, *corner_stages(self, self.signed, self.corners)]
        return [*found, self._ordering] if self.moving else found

    @property
    def _ordering(self) -> Stage:
        """The stage that brings the cuts into order; what lies beyond the cycle is put where nothing bends."""
        t, shares, moving = Trace(), list[Scalar](), self.moving
        for number, each in enumerate(moving):
            share = (self.inside(t.parameter(each.name)) - self.edges[0]) / self._duration
            shares.append(select(share <= 1.0, share, (number + 0.5) / len(moving)))
        return ordered_cuts(t, shares)

    def span(self, t: Trace) -> tuple[Scalar, Scalar]:
        """The time, s, at which the cycle begins in which corners are sought, and how long it is."""
        return self.edges[0], self.lap

    def inside(self, time: Scalar) -> Scalar:
        """A time within that cycle, s."""
        if not self._joined:
            return time
        share = (time - self.edges[0]) / self.lap
        return self.edges[0] + self.lap * (share - floor(share))

    def place(self, t: Trace) -> Scalar:
        """The times, s, between which corners are sought."""
        return t.position("time")

    def over_places(self, program: Program) -> Program:
        """A program of the motion over these."""
        return program

    def there(self, program: Program, t: Trace, x: Scalar) -> dict[str, Any]:
        """The outputs of a program of the motion at a time, s."""
        return self.traced.at_time(program, t, self.inside(x), (self.edges[0], self.edges[0] + self.lap))

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
        return t, {**self.there(Program.of(trace, found), t, time), SHARE: t.position("width") * (high - low)}

    def _end(self, t: Trace, cuts: list[Scalar], following: int) -> Scalar:
        """Where a piece begins, or the ``following`` one: of the edges and the ``cuts``, each in order, together the
        one of this number."""
        edges: list[Scalar] = [t.position(f"edge {len(cuts) + following - k}") for k in range(len(cuts) + 1)]
        return reduce(minimum, map(maximum, edges[1:], cuts), edges[0])


def _in_order(traced: Traced, loads: AlongInput) -> bool:
    """Whether the limits between which loads act follow each other in a cycle that does not close."""
    signals = MotionSignals(traced.nominal)
    for name in loads.names:
        load = traced.mechanism.loads[name]
        if by_limits(load):
            phase: MovingPhase | SwingPhase = load.phase  # type: ignore[attr-defined]
            times = {each.kind: each.time for each in signals.limits(phase.output)}
            if times[phase.end] < times[phase.start]:
                return False
    return True


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
