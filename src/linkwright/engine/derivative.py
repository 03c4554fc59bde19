"""Exact derivatives of programs with respect to their inputs, forward and reverse."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, get_args

from linkwright.core.dataclass import dataclass
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.cycle_gradient import CycleGradient, cycle_gradient
from linkwright.engine.program import Program
from linkwright.engine.reductions import Reduction
from linkwright.engine.replay import Replay
from linkwright.engine.stage import Stage
from linkwright.engine.tangent import numeric_outputs, tangents
from linkwright.engine.trace import Scalar, Trace

__all__ = ["Term", "forward", "reverse", "value_and_gradient"]

TermKind = Literal["sum", "mean", "rms", "max", "min"]
#: The result that is an objective's value.
_VALUE = "value"


@dataclass(frozen=True, slots=True)
class Term:
    """A part of an objective: ``weight`` times a summary of an output over the valid positions.

    ``rms``: root of the mean square; ``max``, ``min``: extremes.
    """

    output: str
    kind: TermKind = "sum"
    weight: float = 1.0


def forward(program: Program, wrt: Sequence[str]) -> Program:
    """A program with the outputs of ``program`` and ``output|input`` = d(output)/d(input).

    ``wrt``: names of parameters, positions or fields. What is under ``stop`` and the states
    count as constants; truth outputs have no derivative. Cost: about one to two evaluations
    per input. Raises ValueError for an input that the program does not have.
    """
    _check_inputs(wrt, (*program.parameters, *program.positions, *program.fields))
    replay = Replay(program)
    outputs = replay.outputs
    for name in wrt:
        found = tangents(replay, name)
        for output, index in numeric_outputs(program):
            outputs[f"{output}|{name}"] = found.get(index, 0.0)
    following = {name: replay.values[i] for name, i in program.next_states}
    return Program.of(replay.trace, outputs, following)


def reverse(
    program: Program, seeds: Sequence[str], wrt: Sequence[str] | None = None, valid: str | None = "valid"
) -> CycleGradient:
    """The gradient of sum over positions of seed times output, for seeds given at evaluation.

    ``seeds``: names of outputs; each one's weights are a field ``seed:output`` (designs, n).
    Otherwise as :func:`value_and_gradient`.
    """
    _check_outputs(program, seeds)
    replay = Replay(program)
    total: Scalar = 0.0
    for name in seeds:
        total = total + replay.trace.field_input(f"seed:{name}") * replay.outputs[name]
    outputs = {_VALUE: total} | ({valid: replay.outputs[valid]} if valid in program.output_names else {})
    stage = Stage(Program.of(replay.trace, outputs), {_VALUE: Reduction(_VALUE, "sum")}, valid=valid)
    return _gradient(program, stage, wrt)


def value_and_gradient(
    program: Program,
    objective: Sequence[Term | tuple[str, TermKind]],
    wrt: Sequence[str] | None = None,
    valid: str | None = "valid",
) -> CycleGradient:
    """Value and gradient of an objective, the sum of its terms.

    ``wrt``: names of parameters, None for all of them in the order of the program. Only the
    positions where the output ``valid`` holds enter (all, without such an output). ``stop`` and
    fields are constants. An objective of sums, of means, or of one root mean square takes one pass over
    the positions, others a second one; an extreme's gradient is that at its first position, which is
    exact wherever the extreme changes smoothly. Raises ValueError for unknown names, and for programs
    that carry states (see :func:`~linkwright.engine.states.states_as_fields`).
    """
    terms = [t if isinstance(t, Term) else Term(*t) for t in objective]
    kinds = get_args(TermKind)
    unknown = sorted({t.kind for t in terms} - set(kinds))
    if unknown or not terms:
        raise ValueError(f"an objective has terms of the kinds {', '.join(kinds)}, not {unknown}")
    _check_outputs(program, [t.output for t in terms])
    replay = Replay(program)
    outputs: dict[str, Scalar | bool] = replay.outputs
    parts: dict[Reduction, float] = {}
    for kind in kinds:
        same = [term for term in terms if term.kind == kind]
        if same and kind in ("sum", "mean"):
            together: Scalar = 0.0
            for term in same:
                together = together + term.weight * outputs[term.output]
            outputs[f"{kind} of terms"] = together
            parts[Reduction(f"{kind} of terms", kind)] = 1.0
        else:
            for term in same:
                reduction = Reduction(term.output, kind)
                parts[reduction] = parts.get(reduction, 0.0) + term.weight
    along = Program.of(replay.trace, outputs)
    if list(parts.values()) == [1.0]:
        return _gradient(program, Stage(along, {_VALUE: next(iter(parts))}, valid=valid), wrt)
    t = Trace()
    total: Scalar = 0.0
    for reduction, weight in parts.items():
        total = total + weight * t.parameter(reduction.name)
    return _gradient(program, Stage(along, after=Program.of(t, {_VALUE: total}), valid=valid), wrt)


def _gradient(program: Program, stage: Stage, wrt: Sequence[str] | None) -> CycleGradient:
    if program.next_states:
        raise ValueError("a program that carries states has no gradient: take its states as fields first")
    _check_inputs(wrt or (), program.parameters)
    return cycle_gradient(CycleProgram((stage,), program.parameters), _VALUE, wrt)


def _check_inputs(names: Sequence[str], known: Sequence[str]) -> None:
    unknown = [name for name in names if name not in known]
    if unknown:
        raise ValueError(f"the program has no input {', '.join(unknown)} to differentiate by")


def _check_outputs(program: Program, outputs: Sequence[str]) -> None:
    known = dict(numeric_outputs(program))
    unknown = [name for name in outputs if name not in known]
    if unknown:
        raise ValueError(f"the program has no output {', '.join(unknown)} to differentiate")
