"""The assembly that a rough drawing shows: of all that close, the one whose points lie nearest to the drawn ones."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.core.inputs import Input, Kind
from linkwright.formula.program import Program
from linkwright.formula.scalar_backend import ScalarProgram
from linkwright.formula.tangent import Slopes
from linkwright.formula.trace import Scalar, Value
from linkwright.kinematics.groups import counted
from linkwright.kinematics.trace import MotionTrace, trace_motion
from linkwright.kinematics.tracking_formula import TrackedGroups, state_places

#: Largest change of a coordinate in one step, and the change at which it is found: rad, or share of the size.
LARGEST, FOUND = 0.3, 1e-6
STEPS = 100
#: Below this share of the largest singular value the equations depend on each other.
RANK = 1e-14
#: Weight of the changes of coordinates against the squared distances of points, which holds what no point shows.
HOLD = 1e-6
#: Share of the promised descent that a step must bring (Armijo), and the smallest part of a step that is tried.
DESCENT, SMALLEST = 1e-4, 2.0**-12

Points = Mapping[tuple[str, str], tuple[float, float]]


class DrawnAssembly:
    """What groups leave open near a drawing, and how far points are from the ``drawn`` ones, by link and point.

    ``steps`` (n,): the joints of chains whose coordinates are unknown, of closed forms as well, by group; behind them
    come the drivers' coordinates.
    """

    def __init__(self, groups: TrackedGroups, drawn: Points) -> None:
        self.groups, formula, mechanism = groups, groups.formula, groups.design.mechanism
        self.steps = [(group, step) for group in formula.upstream for step in group.unknowns]
        scale = [1.0 if step.turns else groups.size for _, step in self.steps]
        self.unit = np.concatenate([np.array(scale), groups.unit])
        self.drawn = np.array([*drawn.values()]).ravel()
        structure = formula.programs.structure
        motion = trace_motion(mechanism, structure, rates=False, iterations=0)
        states = state_places(self.steps, [True] * len(scale), counted(structure, mechanism))
        rows = [row for group in formula.upstream for row in motion.placed[group.name].gap]
        self.count = len(rows)
        for link, point in drawn:
            place = motion.poses[link].point(motion.dimensions.point(link, point))
            rows += [place.x, place.y]
        columns = [Slopes(seeds) for seeds in self._seeds(motion, states)]
        slopes = [column(row) if isinstance(row, Value) else 0.0 for row in rows for column in columns]
        outputs = {str(k): each for k, each in enumerate([*rows, *slopes])}
        self._at = groups.evaluator(ScalarProgram(Program.of(motion.trace, outputs)), states)

    def _seeds(self, motion: MotionTrace, states: Mapping[str, tuple[int, str]]) -> list[dict[Value, Scalar]]:
        """Of every unknown the inputs of the trace that change with it."""
        trace, found = motion.trace, list[dict[Value, Scalar]]()
        for k in range(len(self.steps)):
            own = {kind: trace.field_input(name) for name, (at, kind) in states.items() if at == k}
            found.append({own["cos"]: -own["sin"], own["sin"]: own["cos"]} if "cos" in own else {own[""]: 1.0})
        for name, rotary in zip(motion.drivers, self.groups.formula.rotary, strict=True):
            kinds: tuple[Kind, ...] = ("cos", "sin", "turn", "slide")
            cosine, sine, turn, slide = (trace.position(Input(kind, name).name) for kind in kinds)
            found.append({cosine: -sine, sine: cosine, turn: 1.0} if rotary else {slide: 1.0})
        return found

    def at(self, z: Floats, q: Floats) -> tuple[Floats, Floats, Floats]:
        """What is open, distances of points, and the derivatives of both (rows, unknowns), over the size."""
        found = np.array(self._at(z.tolist(), q.tolist(), [0.0] * len(q))) / self.groups.size
        rows = self.count + len(self.drawn)
        off = found[self.count : rows] - self.drawn / self.groups.size
        return found[: self.count], off, found[rows:].reshape(rows, -1) * self.unit

    def moved(self, z: Floats, q: Floats, step: Floats) -> tuple[Floats, Floats]:
        """Coordinates and drivers after a step of the unknowns, rad or shares of the size."""
        ahead, driven = np.split(step * self.unit, [len(z)])
        return z + ahead, q + driven

    def nearest(self, z: Floats, q: Floats, free: Flags) -> tuple[Floats, Floats] | None:
        """Coordinates (n,) and drivers (d,) near z and q that close with the smallest squared distances of points.

        None where none are found. ``free`` (d,): which drivers may move.

        Gauss–Newton with the groups' equations as equality constraints, along which the exact penalty falls (Björck,
        Numerical Methods for Least Squares Problems, ch. 9.3; Nocedal and Wright, Numerical Optimization, ch. 18.4).
        """
        penalty, moving = 0.0, np.concatenate([np.ones(len(z), dtype=bool), free])
        count = len(moving)
        matrix = np.zeros((count + self.count, count + self.count))

        def worth(z: Floats, q: Floats) -> float:
            gap, off, _ = self.at(z, q)
            return float(0.5 * off @ off + penalty * np.abs(gap).sum())

        for _ in range(STEPS):
            gap, off, slopes = self.at(z, q)
            closing, shown = np.split(slopes * moving, [self.count])
            matrix[:count, :count] = shown.T @ shown + HOLD * np.eye(count)
            matrix[:count, count:], matrix[count:, :count] = closing.T, closing
            right = -np.concatenate([off @ shown, gap])
            if not (np.isfinite(matrix).all() and np.isfinite(right).all()):
                return None
            solved = np.asarray(np.linalg.lstsq(matrix, right, rcond=RANK)[0])
            step, size = solved[:count], float(np.abs(solved[:count]).max())
            if size < FOUND:
                return self.moved(z, q, step)
            penalty = max(penalty, 2.0 * float(np.abs(solved[count:]).max(initial=0.0)))
            falls, here = float(off @ shown @ step) - penalty * float(np.abs(gap).sum()), worth(z, q)
            share = min(1.0, LARGEST / size)
            while share > SMALLEST and not worth(*self.moved(z, q, share * step)) <= here + DESCENT * share * falls:
                share *= 0.5
            z, q = self.moved(z, q, share * step)
        return None
