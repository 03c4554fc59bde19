"""The curvature of path errors by Gauss and Newton, from exact slopes of the path."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations_with_replacement

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.designs.traced_outputs import VALID, Traced, design_table
from linkwright.formula.derivative import forward
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.reductions import VALID_COUNT, Reduction
from linkwright.formula.replay import Replay
from linkwright.formula.summaries import Arrays, Backend, Summaries
from linkwright.formula.trace import Scalar
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.names import point_key
from linkwright.mechanism.mechanism import Mechanism


@dataclass(frozen=True, eq=False)
class PathCurvature:
    """2 · mean over the positions of (∂x/∂p)ᵀ ∂x/∂p + (∂y/∂p)ᵀ ∂y/∂p for the point (x, y) of a path error: its
    curvature by the dimensions ``names``, but for what the distances left add.

    Source: Nocedal and Wright, *Numerical Optimization*, 2006, ch. 10.3.
    """

    names: tuple[str, ...]
    means: Summaries
    arrays: Arrays
    known: Mapping[str, float]
    backend: Backend

    def __call__(self, columns: Mapping[str, Floats]) -> Floats:
        """Curvatures (designs, names, names), m² over the squares of the dimensions; NaN where a design does not
        pass its cycle."""
        table = design_table(self.means.parameters, self.known, columns)
        found = self.means.evaluate(table, self.arrays, threads=1, backend=self.backend)
        count = len(np.asarray(next(iter(self.arrays.values()))))
        bent = np.full((len(table), len(self.names), len(self.names)), np.nan)
        passed = found[VALID_COUNT] == count
        for i, j in combinations_with_replacement(range(len(self.names)), 2):
            mean = found[f"{_product(i, j)}.mean"][passed]
            bent[passed, i, j] = bent[passed, j, i] = 2.0 * mean
        return bent


def path_curvature(
    mechanism: Mechanism, names: tuple[str, ...], point: str, positions: int, backend: Backend
) -> PathCurvature | None:
    """That of a path error of a point at so many positions of the cycle, by those of the dimensions ``names`` on
    which it depends; None where there is none, and where positions follow from others before them."""
    key = (names, point, positions, backend)
    return _cache.get(mechanism, key, lambda: _made(mechanism, names, point, positions, backend))


_cache: Recent[Mechanism, PathCurvature | None] = Recent(16)


def _made(
    mechanism: Mechanism, names: tuple[str, ...], point: str, count: int, backend: Backend
) -> PathCurvature | None:
    positions = over_cycle(mechanism, count)
    traced = Traced(mechanism, names, positions)
    motion = traced.solver.motion
    if motion.angles.carried or any(placed.next_states for placed in motion.placed.values()):
        return None
    place = traced.solver.outputs.point(point_key(mechanism, point))[0]
    program = Program.of(motion.trace, {"x": place.x, "y": place.y, VALID: motion.valid})
    own = tuple(name for name in names if name in program.parameters)
    if not own:
        return None
    replay = Replay(forward(program, own))
    slopes = replay.outputs
    outputs: dict[str, Scalar | bool] = {VALID: slopes[VALID]}
    for i, j in combinations_with_replacement(range(len(own)), 2):
        parts = [slopes[f"{axis}|{own[i]}"] * slopes[f"{axis}|{own[j]}"] for axis in "xy"]
        outputs[_product(i, j)] = parts[0] + parts[1]
    means = [Reduction(name, "mean") for name in outputs if name != VALID]
    found = Summaries(Program.of(replay.trace, outputs), means, VALID)
    return PathCurvature(own, found, positions.arrays, traced.solver.nominal.parameters, backend)


def _product(i: int, j: int) -> str:
    return f"product {i} {j}"
