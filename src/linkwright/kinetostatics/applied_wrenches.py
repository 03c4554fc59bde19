"""Loads and friction link by link at one position: every force with its place, every couple."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.trace import Scalar
from linkwright.kinetostatics.forces import Forces


@dataclass(frozen=True)
class AppliedWrench:
    """What a load or the friction of a joint does to one link: force (N) at a place (m), both in frame axes, and
    torque (N·m); ``name``: of the load, or of the row that holds the friction."""

    name: str
    link: str
    force: tuple[float, float]
    place: tuple[float, float]
    torque: float

    @property
    def idle(self) -> bool:
        """Whether it does nothing."""
        return not (any(self.force) or self.torque)


def applied_wrenches(forces: Forces, index: int) -> list[AppliedWrench]:
    """All of them at one position, in the order of the model; those on the frame among them."""
    order = [(name, i, w) for name, group in forces.solver.forces.wrenches.items() for i, w in enumerate(group)]
    outputs: dict[str, Scalar] = {}
    for name, i, w in order:
        parts = (w.force.x, w.force.y, w.place.x, w.place.y, w.torque)
        outputs |= {f"{name}#{i}#{j}": part for j, part in enumerate(parts)}
    if not outputs:
        return []
    rows = _evaluated(forces, outputs)[:, index].reshape(-1, 5).tolist()
    return [
        AppliedWrench(name, w.link, (fx, fy), (px, py), torque)
        for (name, _, w), (fx, fy, px, py, torque) in zip(order, rows, strict=True)
    ]


def _evaluated(forces: Forces, outputs: dict[str, Scalar]) -> Floats:
    """The outputs at all positions, (outputs, n)."""
    motion = forces.motion
    program = NumpyProgram(Program.of(motion.solver.motion.trace, outputs))
    inner = program.program
    parameters = [motion.design.parameters[name] for name in inner.parameters]
    arrays, fields = {**motion.positions.arrays, **motion.modes}, {**motion.states, **forces.fields}
    return np.asarray(program.run(parameters, arrays, fields, length=motion.steps))
