"""Outputs that a model names itself: over the positions of a motion, with the turns of angles, and as traced values.

Of a formula f of places q the rate is f' = Σ ∂f/∂q · q', the second rate the same of f' with q' as well: both come
from the traced formula by the engine's differentiation, exact to rounding.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from itertools import pairwise

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.expression_tree import denominators, evaluate
from linkwright.core.expressions import ON_VALUES
from linkwright.core.outputs import NAMED, Output
from linkwright.formula.differentiation import slope
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.replay import inlined
from linkwright.formula.trace import Scalar, Trace, absolute, minimum
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import output_meant
from linkwright.kinematics.positions import CycleError, Positions
from linkwright.kinematics.solve import MotionRun
from linkwright.kinematics.trace import MotionTrace
from linkwright.mechanism.mechanism import Mechanism, NamedOutput

#: A divisor that is not above this, SI, is zero but for rounding: the formula has no value there.
ZERO = 1e-12


def formula_names(mechanism: Mechanism, named: NamedOutput) -> dict[str, Output | None]:
    """What moves in a formula: the outputs that its names mean, None for the input; parameters left out."""
    return {
        name: None if name == "input" else output_meant(mechanism, name)
        for name in sorted(named.expression.names)
        if name not in mechanism.parameters
    }


def named_course(motion: Motion, name: str) -> dict[str, Floats]:
    """Value and rates of a named output at the positions of a motion, (n,) each by kind; angles with their turns from
    the beginning of the mechanism's cycle."""
    mechanism = motion.mechanism
    named = mechanism.outputs[name]
    angles, arrays = CycleAngles(motion), dict[str, Floats]()
    for each, output in formula_names(mechanism, named).items():
        for order, values in enumerate(_arrays(motion, angles, output, len(named.outputs))):
            arrays[_place(each, order)] = values
    program = _formula(mechanism, named)
    numbers = [mechanism.parameters[each] for each in program.program.parameters]
    *rows, nearest = program.run(numbers, arrays, length=motion.steps)
    known = motion.ok & (nearest > ZERO)
    return {kind: np.where(known, row, np.nan) for kind, row in zip(NAMED, rows, strict=False)}


def _arrays(motion: Motion, angles: CycleAngles, output: Output | None, count: int) -> list[Floats]:
    """A place or rate over the positions with as many rates behind it as its formula needs, ``count`` in all."""
    if output is None:
        return list(next(iter(motion.positions.coordinates.values())))[:count]
    if output.kind in NAMED:
        course = named_course(motion, output.owner)
        return list(course.values())[NAMED.index(output.kind) :][:count]
    found, value = list[Floats](), output
    for order in range(count):
        found.append(angles.of(value.owner) if value.kind == "angle" else motion.read(value))
        if order + 1 < count:
            value = value.rate
    return found


def _place(name: str, order: int) -> str:
    """Name of an input of a formula's program: what moves in it, and which of its rates."""
    return f"{name}{order * chr(39)}"


def _formula(mechanism: Mechanism, named: NamedOutput) -> NumpyProgram:
    """The program of a formula and its rates, of what moves in it and of the parameters; and the smallest of what it
    divides by, as a share of the larger of its terms."""
    return _formulas.get(None, (named, tuple(mechanism.parameters)), lambda: NumpyProgram(_traced(mechanism, named)))


def _traced(mechanism: Mechanism, named: NamedOutput) -> Program:
    trace, count = Trace(), len(named.outputs)
    names = formula_names(mechanism, named)
    courses = {name: [trace.position(_place(name, order)) for order in range(count)] for name in names}
    values = {name: course[0] for name, course in courses.items()}
    own = [name for name in sorted(named.expression.names) if name in mechanism.parameters]
    values |= {name: trace.parameter(name) for name in own}
    seeds = {value: rate for course in courses.values() for value, rate in pairwise(course)}
    found: list[Scalar] = [named.expression.over(values)]
    while len(found) < count:
        found.append(slope(found[-1], seeds))
    return Program.of(trace, {**dict(zip(NAMED, found, strict=False)), "nearest": _nearest(named, values)})


def _nearest(named: NamedOutput, values: Mapping[str, Scalar]) -> Scalar:
    """The smallest of what a formula divides by."""
    found: Scalar = 1.0
    for each in denominators(named.expression.tree):
        found = minimum(found, absolute(evaluate(each, values, ON_VALUES)))
    return found


_formulas: Recent[None, NumpyProgram] = Recent(64)


def traced_course(
    motion: MotionTrace, named: NamedOutput, value: Callable[[Output | None, int], Scalar]
) -> list[Scalar]:
    """Value and rates of a named output as traced values; ``value``: that of an output, of the input for None, and
    of its rates by their order."""
    count, names = len(named.outputs), formula_names(motion.mechanism, named)
    inputs = {_place(name, order): value(each, order) for name, each in names.items() for order in range(count)}
    own = [name for name in named.expression.names if name in motion.mechanism.parameters]
    inputs |= {name: motion.dimensions(name) for name in own}
    found = inlined(_formula(motion.mechanism, named).program, motion.trace, inputs)
    return [found[kind] for kind in NAMED[:count]]


#: Steps of the cycle that anchors angles and brackets limit positions.
STEPS = 360
TURN = 2 * np.pi


class CycleAngles:
    """Angles refer to the mechanism's cycle, so they do not depend on which positions are asked."""

    def __init__(self, motion: Motion) -> None:
        self.motion = motion

    @cached_property
    def cycle(self) -> Motion:
        """The motion over the mechanism's cycle; the motion itself where no cycle is known."""
        positions = self.motion.positions
        if (positions.closed or positions.cycle) and self.motion.steps >= STEPS:
            return self.motion
        found = self.over(self.motion.mechanism)
        return self.motion if found is None else found

    def over(self, mechanism: Mechanism) -> Motion | None:
        """The motion of a mechanism of the same assembly over its cycle; None where no cycle is known."""
        try:
            positions: Positions = over_cycle(mechanism, STEPS)
        except CycleError:
            return None
        return MotionRun(self.motion.solver.for_design(self.motion.design), positions).solve("mark")

    def of(self, link: str) -> Floats:
        """The angle of a link, (n,) rad."""
        angle = self.motion.link(link).angle
        return angle if self.cycle is self.motion else self.anchored(angle, self.cycle.link(link).angle)

    def anchored(self, angle: Floats, on_cycle: Floats) -> Floats:
        """The same angle, moved by full turns next to what it is at that time of the cycle, of which a part may not
        be reached."""
        positions = self.cycle.positions
        time, values, laps, gain = positions.time, on_cycle, np.zeros(len(angle)), 0.0
        if positions.period is not None:
            gain = TURN * float(np.nan_to_num(np.round((values[-1] - values[0]) / TURN)))
            time, values = np.append(time, time[0] + positions.period), np.append(values, values[0] + gain)
            laps = np.floor((self.motion.time - time[0]) / positions.period)
        order = np.argsort(time)
        order = order[np.isfinite(values[order])]
        if not len(order):
            return angle
        there = np.interp(self.motion.time - laps * (positions.period or 0.0), time[order], values[order])
        return np.asarray(angle + TURN * np.round((there + laps * gain - angle) / TURN))
