"""pylinkage: compiled position, velocity and acceleration of dyads, no forces."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from pylinkage.actuators import Crank
from pylinkage.bridge.solver_conversion import linkage_to_solver_data
from pylinkage.components import Ground
from pylinkage.dyads import FixedDyad, RRRDyad
from pylinkage.simulation import Linkage
from pylinkage.solver.simulation import simulate_with_kinematics

from benchmarks import by_numpy
from benchmarks.cases import FOURBAR_OUTPUTS, SIXBAR_OUTPUTS, Floats, Work
from benchmarks.peers import Peer


def _fourbar_linkage(row: Floats, first: Mapping[str, Floats], steps: int) -> Linkage:
    crank, speed, ground, coupler, rocker, _, u, v = row.tolist()
    o1, o2 = Ground(0.0, 0.0), Ground(ground, 0.0)
    turning = Crank(anchor=o1, radius=crank, angular_velocity=2.0 * math.pi / steps)
    b = RRRDyad(turning.output, o2, distance1=coupler, distance2=rocker)
    p = FixedDyad(turning.output, b, distance=math.hypot(u, v), angle=math.atan2(v, u))
    linkage = Linkage([o1, o2, turning, b, p])
    return _started(linkage, turning, speed, [(0.0, 0.0), (ground, 0.0)], first, ("A", "B", "coupler.P"))


def _sixbar_linkage(row: Floats, first: Mapping[str, Floats], steps: int) -> Linkage:
    crank, speed, x3, y3, pitman, rocker, _, x5, y5, toggle, jaw = row.tolist()[:11]
    o1, o3, o5 = Ground(0.0, 0.0), Ground(x3, y3), Ground(x5, y5)
    turning = Crank(anchor=o1, radius=crank, angular_velocity=math.copysign(2.0 * math.pi / steps, speed))
    b = RRRDyad(turning.output, o3, distance1=pitman, distance2=rocker)
    c = RRRDyad(b, o5, distance1=toggle, distance2=jaw)
    linkage = Linkage([o1, o3, o5, turning, b, c])
    return _started(linkage, turning, speed, [(0.0, 0.0), (x3, y3), (x5, y5)], first, ("A", "B", "C"))


def _started(
    linkage: Linkage,
    crank: Crank,
    speed: float,
    fixed: list[tuple[float, float]],
    first: Mapping[str, Floats],
    points: tuple[str, ...],
) -> Linkage:
    linkage.rebuild(fixed + [(float(first[f"p:{p}.x"][0]), float(first[f"p:{p}.y"][0])) for p in points])
    linkage.set_input_velocity(crank, speed)
    return linkage


def _peer(linkage: Linkage, steps: int, points: Mapping[str, int], note: str) -> Peer:
    def run() -> tuple[Floats, Floats, Floats]:
        return linkage.step_fast_with_kinematics(steps, 1)  # type: ignore[no-any-return]

    def results() -> Mapping[str, Floats]:
        rows = {}
        for kind, array in zip("pva", run(), strict=True):
            for point, place in points.items():
                for axis, column in (("x", 0), ("y", 1)):
                    rows[f"{kind}:{point}.{axis}"] = np.roll(np.array(array[:, place, column]), 1)
        return rows

    return Peer("pylinkage", run, results, note=note)


def fourbar(work: Work) -> list[Peer]:
    """W2."""
    rows = dict(zip(FOURBAR_OUTPUTS, by_numpy.fourbar(work.cosine, work.sine, work.nominal()), strict=True))
    steps = work.positions.count
    linkage = _fourbar_linkage(work.nominal(), rows, steps)
    return [_peer(linkage, steps, {"B": 3, "coupler.P": 4}, "points only, no links")]


def sixbar(work: Work) -> list[Peer]:
    """The motion of W3."""
    rows = dict(zip(SIXBAR_OUTPUTS, by_numpy.sixbar(work.cosine, work.sine, work.nominal()), strict=True))
    steps = work.positions.count
    linkage = _sixbar_linkage(work.nominal(), rows, steps)
    return [_peer(linkage, steps, {"B": 4, "C": 5}, "points only, no forces")]


def fourbar_sweep(work: Work, designs: Floats, count: int) -> list[Peer]:
    """W4: the compiled solver once per design, without the summaries."""
    steps, few = work.positions.count, designs[:count]
    names = ("A", "B", "coupler.P")
    rows = dict(zip(FOURBAR_OUTPUTS, by_numpy.fourbar(np.ones(1), np.zeros(1), few.T[:, :, None]), strict=True))
    starts = np.zeros((len(few), 5, 2))
    starts[:, 1, 0] = few[:, 2]
    for place, name in enumerate(names, 2):
        for axis, column in (("x", 0), ("y", 1)):
            starts[:, place, column] = np.broadcast_to(rows[f"p:{name}.{axis}"], (len(few), 1))[:, 0]
    solvers = []
    for row, start in zip(few, starts, strict=True):
        first = {f"p:{n}.{a}": start[k : k + 1, i] for k, n in enumerate(names, 2) for i, a in enumerate("xy")}
        solvers.append(linkage_to_solver_data(_fourbar_linkage(row, first, steps)))
    crank, speed, still = np.array([2], dtype=np.int32), np.array([10.0]), np.zeros(1)

    def run() -> None:
        for data, start in zip(solvers, starts, strict=True):
            simulate_with_kinematics(
                *(start.copy(), np.zeros((5, 2)), np.zeros((5, 2)), data.constraints, data.joint_types),
                *(data.parent_indices, data.constraint_offsets, data.solve_order, speed, still, crank, steps, 1.0),
            )

    return [Peer("pylinkage", run, share=len(few) / len(designs), note=f"{len(few)} designs, scaled; no summaries")]
