"""Path errors as quantities of a problem, and their curvature by Gauss and Newton."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations_with_replacement

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.designs.objective import Part, of_path
from linkwright.designs.objective_terms import PathError
from linkwright.designs.traced_outputs import VALID, Traced, design_table
from linkwright.formula.gradient import forward
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.reductions import VALID_COUNT, Reduction
from linkwright.formula.replay import Replay
from linkwright.formula.summaries import Arrays, Backend, Summaries
from linkwright.formula.trace import Scalar
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.names import point_key
from linkwright.mechanism.mechanism import Mechanism

#: Designs that one thread takes.
ALONE = 512


def _threads(columns: Mapping[str, Floats]) -> int | None:
    """One where a second one costs more than it takes off."""
    return None if len(next(iter(columns.values()))) > ALONE else 1


def _shared(names: Sequence[str], by: Sequence[str]) -> tuple[Indices, Indices]:
    """Where the names that are in both stand, in the one and in the other."""
    both = [(k, by.index(name)) for k, name in enumerate(names) if name in by]
    own, places = np.array(both, dtype=np.intp).reshape(-1, 2).T
    return own, places


class PathErrors:
    """Values (designs,) of path errors by name, and their exact gradients."""

    def __init__(
        self, mechanism: Mechanism, addresses: tuple[str, ...], asked: Mapping[str, PathError], backend: Backend
    ) -> None:
        self.parts: dict[str, Part] = {
            name: of_path(mechanism, addresses, each, backend) for name, each in asked.items()
        }
        self._bends = {
            name: partial(path_curvature, mechanism, addresses, each.point, len(np.array(each.target)), backend)
            for name, each in asked.items()
        }

    def __contains__(self, name: str) -> bool:
        return name in self.parts

    def values(self, columns: Mapping[str, Floats]) -> dict[str, Floats]:
        """m²; NaN where a design does not pass its cycle."""
        with np.errstate(all="ignore"):
            return {name: part.values(columns, _threads(columns)) for name, part in self.parts.items()}

    def with_slopes(self, name: str, columns: Mapping[str, Floats], by: tuple[str, ...]) -> tuple[Floats, Floats]:
        """Values (designs,) and gradients (designs, k) by the addresses ``by``."""
        part = self.parts[name]
        with np.errstate(all="ignore"):
            values, found = part.many(columns, _threads(columns))
        slope = np.zeros((len(found), len(by)))
        own, places = _shared(part.names, by)
        slope[:, places] = found[:, own]
        return values, slope

    def curvatures(self, name: str, columns: Mapping[str, Floats], by: tuple[str, ...]) -> Floats:
        """Curvatures (designs, k, k) by the addresses ``by``, from the path's slopes; 0 where these have none."""
        bend = self._bends[name]()
        found = np.zeros((len(next(iter(columns.values()))), len(by), len(by)))
        if bend is not None:
            own, places = _shared(bend.names, by)
            with np.errstate(all="ignore"):
                found[:, places[:, None], places] = bend(columns)[:, own[:, None], own]
        return found


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
