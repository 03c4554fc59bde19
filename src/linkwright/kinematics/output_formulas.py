"""Outputs that a model names itself, over the positions of a motion and as traced values.

Of a formula f of places q the rate is f' = Σ ∂f/∂q · q', the second rate the same of f' with q' as well: both come
from the traced formula by the engine's differentiation, exact to rounding.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import pairwise

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.expression_tree import denominators, evaluate
from linkwright.core.expressions import ON_VALUES
from linkwright.core.outputs import NAMED, Output
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.replay import inlined
from linkwright.formula.tangent import slope
from linkwright.formula.trace import Scalar, Trace, absolute, minimum
from linkwright.kinematics.cycle_angles import CycleAngles
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import output_meant
from linkwright.kinematics.trace import MotionTrace
from linkwright.mechanism.mechanism import Mechanism
from linkwright.mechanism.named_output import NamedOutput

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
