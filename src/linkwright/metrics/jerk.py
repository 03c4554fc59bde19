"""Third derivatives in time, exact, through the derivative of the traced program."""

from __future__ import annotations

import numpy as np

from linkwright.drivers.constant_speed import ConstantSpeed
from linkwright.engine.derivative import forward
from linkwright.engine.numpy_backend import NumpyProgram
from linkwright.engine.program import Program
from linkwright.engine.recent import Recent
from linkwright.kinematics.cycle import Floats
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.programs import MotionPrograms


def has_rates_in_time(motion: Motion) -> bool:
    """Whether exact derivatives of accelerations are known: every driver has a constant speed."""
    drivers = motion.mechanism.drivers.values()
    return bool(drivers) and all(isinstance(driver.law, ConstantSpeed) for driver in drivers)


class TimeDerivative:
    """d/dt of outputs of a motion's program: the chain rule over the drivers' inputs; constant speeds only."""

    def __init__(self, motion: Motion, names: tuple[str, ...]) -> None:
        programs = motion.solver.programs
        self._names = names
        self._program, self._inputs = _kept.get(programs, names, lambda: _traced(programs, names))

    def of(self, motion: Motion) -> Floats:
        """The derivatives at the positions of a motion of the same solver, (names, n)."""
        parameters = [motion.design.parameters[name] for name in self._program.program.parameters]
        arrays = {**motion.positions.arrays, **motion.modes}
        rows = self._program.run(parameters, arrays, None, motion.states or None, length=motion.steps)
        place = {name: i for i, name in enumerate(self._program.program.output_names)}
        found = np.zeros((len(self._names), motion.steps))
        for name in self._inputs:
            change = _change(motion, name)
            found += [rows[place[f"{output}|{name}"]] * change for output in self._names]
        found[:, ~motion.ok] = np.nan
        return found


_Traced = tuple[NumpyProgram, tuple[str, ...]]
_kept: Recent[MotionPrograms, _Traced] = Recent(64)


def _traced(programs: MotionPrograms, names: tuple[str, ...]) -> _Traced:
    """The derivatives of some outputs by the drivers' inputs, and these."""
    with programs.lock:
        program = Program.of(programs.motion.trace, {name: programs.outputs.value(name) for name in names})
    inputs = tuple(name for name in program.positions if not name.startswith("mode:"))
    return NumpyProgram(forward(program, inputs)), inputs


def _change(motion: Motion, name: str) -> Floats:
    """d/dt of an input of the program at constant speed."""
    kind, driver = name.split(":", 1)
    q, rate, second = motion.positions.coordinates[driver]
    if kind == "cos":
        return np.asarray(-np.sin(q) * rate)
    if kind == "sin":
        return np.asarray(np.cos(q) * rate)
    return rate if kind == "slide" else second
