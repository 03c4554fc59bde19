"""The cycle of many designs at Gauss points of fixed times: whatever laws the drivers follow, closed or not.

The times are those between which the machine itself is smooth, see ``metrics/cycle_grid.py``: where laws of drivers
go over from one formula to the next and loads begin and end at given inputs, that is so in all its designs.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.core.piecewise import POINTS, WEIGHTS, nodes
from linkwright.cycle_programs.gauss_cycle import SHARE, GaussCycle, certain, side_by_side
from linkwright.cycle_programs.limit_stages import whole_turns
from linkwright.cycle_programs.traced import VALID, Traced
from linkwright.engine.stage import Stage
from linkwright.engine.trace import Scalar, Trace
from linkwright.errors import LinkwrightError
from linkwright.kinematics.cycle import at_times, over_cycle
from linkwright.kinetostatics.traced_loads import AlongInput
from linkwright.mechanism.mechanism import Mechanism
from linkwright.metrics import Analysis

#: Halvings of all pieces for designs that are less smooth than the machine itself.
HALVINGS = 3
#: Share by which a dimension is changed to see whether times and inputs follow from it.
_NUDGE = 1e-3


@dataclass(frozen=True)
class TimedCycle:
    """What ``GaussCycle`` is for whole turns, at times that no design changes; ``edges`` of the pieces, s."""

    traced: Traced
    edges: tuple[float, ...]
    halvings: int = 0

    @property
    def pieces(self) -> int:
        """Number of pieces of the cycle."""
        return len(self.edges) - 1

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
        return TimedCycle(self.traced, tuple(halved.tolist()), self.halvings + 1)

    @property
    def speed(self) -> float:
        """Rate of the first driver where the cycle begins, rad/s or m/s."""
        return float(next(iter(self.traced.positions.coordinates.values()))[1][0])

    @property
    def way(self) -> float:
        """What the first driver would go in the cycle at this rate, rad or m."""
        return abs(self.speed) * (self.edges[-1] - self.edges[0])

    @cached_property
    def positions(self) -> dict[str, Floats]:
        """Inputs (n,) of the programs, and the shares of the time, the first nodes of all pieces first."""
        edges = np.array(self.edges)
        known = at_times(self.traced.mechanism, nodes(edges).T.ravel())
        width = 0.5 * WEIGHTS[:, None] * np.diff(edges) / (edges[-1] - edges[0])
        return {**known.arrays, SHARE: width.ravel()}

    @property
    def constants(self) -> dict[str, float]:
        """None: no number of a cycle of turns is taken."""
        return {}

    def cut_stages(self, beside: Traced | None = None) -> list[Stage]:
        """None: no time follows from a design."""
        return []

    def signals(
        self, outputs: Mapping[str, Scalar], one_way: Iterable[Output] = ()
    ) -> tuple[Trace, dict[str, Scalar]]:
        """The trace of the motion with the outputs, whether they are valid, and the share of the time."""
        trace = self.traced.solver.motion.trace
        found = {**outputs, VALID: certain(self.traced, one_way), SHARE: trace.position(SHARE)}
        return trace, found


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
    """The Gauss points of designs that can go together; None where loads or friction go by limits, which move with
    the dimensions, or the machine itself is smooth nowhere, and the cycle is no whole number of turns."""
    if whole_turns(traced):
        return GaussCycle.of(traced, loads, pieces)
    if loads.outputs or loads.moving or loads.swinging or analysis.grid is None:
        return None
    return TimedCycle(traced, tuple(analysis.grid.edges.tolist()))
