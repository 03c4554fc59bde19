"""Exact derivatives of programs with respect to their inputs, forward and reverse."""

from __future__ import annotations

from collections.abc import Sequence

from linkwright.formula.gradient import Gradient
from linkwright.formula.program import Program
from linkwright.formula.reductions import Reduction
from linkwright.formula.replay import Replay
from linkwright.formula.tangent import numeric_outputs, tangents
from linkwright.formula.trace import Scalar

#: The result that is the sum of the seeds times the outputs.
_VALUE = "value"


def forward(program: Program, wrt: Sequence[str]) -> Program:
    """A program with the outputs of ``program`` and ``output|input`` = d(output)/d(input).

    ``wrt``: names of parameters, positions or fields. What is under ``stop``
    counts as constant; truth outputs have no derivative. Cost: about one to two evaluations
    per input. Raises ValueError for an input that the program does not have.
    """
    _check_inputs(wrt, (*program.parameters, *program.positions, *program.fields))
    replay = Replay(program)
    outputs = replay.outputs
    for name in wrt:
        found = tangents(replay, name)
        for output, index in numeric_outputs(program):
            outputs[f"{output}|{name}"] = found.get(index, 0.0)
    return Program.of(replay.trace, outputs)


def reverse(
    program: Program, seeds: Sequence[str], wrt: Sequence[str] | None = None, valid: str | None = "valid"
) -> Gradient:
    """The gradient of sum over positions of seed times output, for seeds at evaluation.

    ``seeds``: names of outputs; each one's weights are a field ``seed:output`` (designs, n). ``wrt``: names of
    parameters, None for all of them in the order of the program. Only the positions where the output ``valid`` holds
    enter (all, without such an output). ``stop`` and fields are constants. Raises ValueError for unknown names.
    """
    _check_inputs(wrt or (), program.parameters)
    unknown = [name for name in seeds if name not in dict(numeric_outputs(program))]
    if unknown:
        raise ValueError(f"the program has no output {', '.join(unknown)} to differentiate")
    replay = Replay(program)
    total: Scalar = 0.0
    for name in seeds:
        total = total + replay.trace.field_input(f"seed:{name}") * replay.outputs[name]
    outputs = {_VALUE: total} | ({valid: replay.outputs[valid]} if valid in program.output_names else {})
    return Gradient(Program.of(replay.trace, outputs), Reduction(_VALUE, "sum"), wrt, valid=valid)


def _check_inputs(names: Sequence[str], known: Sequence[str]) -> None:
    unknown = [name for name in names if name not in known]
    if unknown:
        raise ValueError(f"the program has no input {', '.join(unknown)} to differentiate by")
