"""Groups without closed form at the Gauss points of many designs: followed over the cycle, then found in between.

Every design is followed over as many equal steps of its cycle as it has Gauss points, as in a sweep. A cubic through
four neighbouring positions tells where the chain coordinates of a Gauss point lie, from where Newton's method goes
on. It must stay near, close the groups, and keep the signs of their determinants; else the design is solved alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.cycle_programs.gauss_cycle import GaussCycle, at_point, iterated
from linkwright.cycle_programs.iterated_groups import Following, following
from linkwright.cycle_programs.traced_outputs import VALID, Traced, design_table
from linkwright.engine.cycle import CycleProgram, Known
from linkwright.engine.numpy_backend import numpy_program
from linkwright.engine.program import Program
from linkwright.engine.stage import Backend, Run, Stage
from linkwright.engine.trace import Mask, Scalar, Trace, select, sqrt
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.step_rule import CORRECTION
from linkwright.loads.strokes import TURN

#: Newton steps from the cubic.
ITERATIONS = 3
#: The most by which the step from the last position to the first one is larger than the largest of all others.
CLOSED = 2.0
SHARE, KEPT = "share of the way", "on the assembly"


class FollowedPoints:
    """Chain coordinates of the groups without closed form of one mechanism's designs, as fields.

    Designs that do not pass, or of which a Gauss point is not certain to lie on the assembly that is followed, are
    left to be solved alone.
    """

    def __init__(self, traced: Traced, gauss: GaussCycle) -> None:
        mechanism = traced.mechanism
        self.gauss, self.names = gauss, iterated(traced)
        self.traced = Traced(
            mechanism, traced.solver.manner.free, over_cycle(mechanism, gauss.count), iterations=ITERATIONS
        )
        self.scales = [mechanism.size if name.endswith(".s") else 1.0 for name in self.names]

    @cached_property
    def following(self) -> Following | None:
        """What follows the designs."""
        return following(self.traced, (), ())

    def at_positions(self, columns: Mapping[str, Floats], backend: Backend) -> dict[str, Floats]:
        """What is carried at the positions, (designs, n) by name; NaN for designs that do not pass."""
        assert self.following is not None
        return self.following.states(columns, 1, backend)

    @property
    def parameters(self) -> tuple[str, ...]:
        """What is taken of every design at the Gauss points: dimensions and cycle values."""
        return (*self._places.kept.parameters, *self._newton.kept.parameters)

    def of(
        self, columns: Mapping[str, Floats], numbers: Mapping[str, float], backend: Backend
    ) -> dict[str, Floats]:
        """The coordinates at the Gauss points of cycles that no load cuts, (designs, n) by name, from the ``numbers``
        that do not vary; NaN for designs that are not certain."""
        cuts = CycleProgram(tuple(self.gauss.cut_stages(self.traced)))
        more = (name for name in self.parameters if name not in cuts.results)
        cycle = CycleProgram(cuts.stages, tuple(dict.fromkeys([*cuts.dimensions, *more])))
        table = design_table(cycle.dimensions, numbers, columns)
        ((_, known, run),) = cycle.blocks(table, self.gauss.positions, threads=1, backend=backend)
        found, certain = self.at_points(known, run, self.at_positions(columns, backend))
        return {name: np.where(certain[:, None], row, np.nan) for name, row in found.items()}

    def at_points(
        self, known: Known, run: Run, states: Mapping[str, Floats]
    ) -> tuple[dict[str, Floats], Flags]:
        """The coordinates at the Gauss points, (designs, n) by name, and which designs are certain."""
        table = known.table(self._places.kept.parameters)
        share = self._places.fields(table, {}, None, run)[SHARE]
        place = share * self.gauss.count
        step = np.where(np.isfinite(place), np.minimum(np.floor(place), self.gauss.count - 1.0), 0.0)
        weights, before = _cubic(place - step), step.astype(np.intp)
        near, certain = {}, np.ones(len(table), dtype=np.bool_)
        change = np.zeros_like(share)
        for name, scale in zip(self.names, self.scales, strict=True):
            around = _around(states[name], name)
            certain &= _closes(around)
            near[f"near:{name}"] = _between(around, before, weights)
            steps = np.abs(np.diff(around[:, 1:-1])) / scale
            change = np.maximum(change, np.take_along_axis(steps, before, axis=1))
        table = known.table(self._newton.kept.parameters)
        found = self._newton.fields(table, near, None, run)
        for name, scale in zip(self.names, self.scales, strict=True):
            with np.errstate(invalid="ignore"):
                off = np.abs(found[at_point(name)] - near[f"near:{name}"]) / scale
                certain &= (off <= CORRECTION * change + 1e-10).all(axis=1)
        certain &= (found.pop(KEPT) == 1.0).all(axis=1)
        return {name: np.ascontiguousarray(row) for name, row in found.items()}, certain

    @cached_property
    def _places(self) -> Stage:
        """How far a Gauss point lies from the beginning of the cycle, as share of it."""
        t = Trace()
        point, _ = self.gauss.point(t)
        (driver,) = self.traced.mechanism.drivers
        speed = t.parameter(f"{driver}.speed")
        share = (
            (point["time"] - t.parameter("first time"))
            * select(speed < 0.0, -speed, speed)
            * (1.0 / self.gauss.way)
        )
        return Stage(Program.of(t, {SHARE: share}), keep=(SHARE,))

    @cached_property
    def _newton(self) -> Stage:
        """Newton's steps at the Gauss points."""
        motion, t = self.traced.solver.motion, Trace()
        carried = {name: motion.next_states[name] for name in self.names}
        sought: dict[str, Scalar | bool] = {**carried, VALID: motion.valid, **self._determinants}
        source = Program.of(motion.trace, sought)
        point, _ = self.gauss.point(t)
        start = {name: t.field_input(f"near:{name}") for name in self.names}
        there = self.traced.at_input(source, t, point["input"], {**point, **_of_unit_length(start)})
        kept: Mask = there[VALID]
        for name, sign in self._signs.items():
            kept = t.logic("and", kept, t.compare("less", 0.0, there[name] * sign))
        outputs = {at_point(name): there[name] for name in self.names}
        outputs[KEPT] = select(kept, 1.0, 0.0)
        return Stage(Program.of(t, outputs), keep=tuple(outputs))

    @cached_property
    def _determinants(self) -> dict[str, Scalar]:
        placed = self.traced.solver.motion.placed.items()
        return {f"determinant:{name}": each.determinant for name, each in placed if each.coordinates}

    @cached_property
    def _signs(self) -> dict[str, float]:
        """The signs of the determinants of the mechanism as it is, which all designs that are followed have."""
        motion = self.traced.solver.motion
        evaluator = numpy_program(Program.of(motion.trace, self._determinants))
        first = {name: row[:1] for name, row in self.traced.positions.arrays.items()}
        states = {name: row[None, :1] for name, row in self.traced.nominal.states.items()}
        table = self.traced.numbers(evaluator.program)[None, :]
        rows = evaluator.run_designs(table, first, {}, states, length=1)[0, :, 0]
        return dict(zip(self._determinants, np.sign(rows).tolist(), strict=True))


def followed_points(traced: Traced, gauss: GaussCycle) -> FollowedPoints | None:
    """What finds the chain coordinates of designs at Gauss points; None where all groups have a closed form."""
    return FollowedPoints(traced, gauss) if iterated(traced) else None


def _of_unit_length(states: Mapping[str, Scalar]) -> dict[str, Scalar]:
    """The same with directions of unit length."""
    found = dict(states)
    for name in states:
        if name.endswith(".x"):
            x, y = states[name], states[f"{name[:-2]}.y"]
            scale = 1.0 / sqrt(x * x + y * y)
            found[name], found[f"{name[:-2]}.y"] = x * scale, y * scale
    return found


def _around(rows: Floats, name: str) -> Floats:
    """The rows (designs, n) with the last position before the first, and the first two after the last; rotations
    count on by whole turns."""
    lap: Floats | float = 0.0
    if name.endswith(".angle"):
        turned = 2.0 * rows[:, -1] - rows[:, -2] - rows[:, 0]
        lap = (TURN * np.round(turned / TURN))[:, None]
    return np.concatenate([rows[:, -1:] - lap, rows, rows[:, :2] + lap], axis=1)


def _closes(around: Floats) -> Flags:
    """Of which designs the first position follows the last as others follow each other."""
    steps = np.abs(np.diff(around[:, 1:-1], axis=1))
    with np.errstate(invalid="ignore"):
        return np.asarray(steps[:, -1] <= CLOSED * steps[:, :-1].max(axis=1))


def _cubic(part: Floats) -> tuple[Floats, ...]:
    """Weights of four neighbouring values at a ``part`` of the way from the second to the third (Lagrange)."""
    before, after, last = part + 1.0, 1.0 - part, 2.0 - part
    return (
        part * after * last * (-1.0 / 6.0),
        before * after * last * 0.5,
        before * part * last * 0.5,
        before * part * after * (-1.0 / 6.0),
    )


def _between(around: Floats, before: Indices, weights: tuple[Floats, ...]) -> Floats:
    found = np.zeros_like(weights[0])
    for place, weight in enumerate(weights):
        found += weight * np.take_along_axis(around, before + place, axis=1)
    return found
