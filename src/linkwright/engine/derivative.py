"""Exact derivatives of programs with respect to their parameters, forward and reverse."""

from __future__ import annotations

from collections.abc import Sequence

from linkwright.engine.adjoint import Adjoints
from linkwright.engine.gradient import VALUE, ExtremePart, GradientProgram, Part, SummedPart, derivative_name
from linkwright.engine.objective import EXTREMES, Group, Term, TermKind, groups_of
from linkwright.engine.program import Program
from linkwright.engine.reductions import VALID_COUNT
from linkwright.engine.replay import Replay, depending
from linkwright.engine.reverse_programs import boundary
from linkwright.engine.tangent import numeric_outputs, tangents
from linkwright.engine.trace import Scalar

__all__ = ["GradientProgram", "Term", "forward", "reverse", "value_and_gradient"]


def forward(program: Program, wrt: Sequence[str]) -> Program:
    """A program with the outputs of ``program`` and ``output|input`` = d(output)/d(input).

    ``wrt``: names of parameters, positions or fields. What is under ``stop`` and the states
    count as constants; truth outputs have no derivative. Cost: about one to two evaluations
    per input. Raises ValueError for an input that the program does not have.
    """
    _check_inputs(program, wrt, (*program.parameters, *program.positions, *program.fields))
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
) -> GradientProgram:
    """The gradient of sum over positions of seed times output, for seeds given at evaluation.

    ``seeds``: names of outputs; each one's weights are a field ``seed:output`` (designs, n).
    Otherwise as :func:`value_and_gradient`.
    """
    group = Group(0, tuple(Term(name) for name in seeds), "sum", seeded=True)
    wanted = _wanted(program, seeds, wrt)
    return GradientProgram((_summed(program, [group], wanted, valid),), wanted)


def value_and_gradient(
    program: Program,
    objective: Sequence[Term | tuple[str, TermKind]],
    wrt: Sequence[str] | None = None,
    valid: str | None = "valid",
) -> GradientProgram:
    """Value and gradient of an objective, the sum of its terms.

    ``wrt``: names of parameters, None for all of them in the order of the program. Only the
    positions where the output ``valid`` holds enter (all, without such an output). ``stop`` and
    states are constants. Sums, means and root mean squares are found in one pass over the
    positions; all sums together, all means together, and every root mean square take a reverse
    sweep each. An extreme takes a pass of its own; its gradient is that at its first position,
    which is exact wherever the extreme changes smoothly. Raises ValueError for unknown names,
    and for programs that carry states (see :func:`~linkwright.engine.states.states_as_fields`).
    """
    terms = [t if isinstance(t, Term) else Term(*t) for t in objective]
    groups = groups_of(terms)
    wanted = _wanted(program, [t.output for t in terms], wrt)
    parts: list[Part] = [_summed(program, groups, wanted, valid)] if groups else []
    parts += [_extreme(program, t, wanted, valid) for t in terms if t.kind in EXTREMES]
    return GradientProgram(tuple(parts), wanted)


def _check_inputs(program: Program, names: Sequence[str], known: Sequence[str]) -> None:
    unknown = [name for name in names if name not in known]
    if unknown:
        raise ValueError(f"the program has no input {', '.join(unknown)} to differentiate by")


def _wanted(program: Program, outputs: Sequence[str], wrt: Sequence[str] | None) -> tuple[str, ...]:
    """The parameters to differentiate by, after a look at what is asked."""
    if program.next_states:
        raise ValueError("a program that carries states has no gradient: take its states as fields first")
    wanted = program.parameters if wrt is None else tuple(wrt)
    _check_inputs(program, wanted, program.parameters)
    known = dict(numeric_outputs(program))
    unknown = [name for name in outputs if name not in known]
    if unknown:
        raise ValueError(f"the program has no output {', '.join(unknown)} to differentiate")
    return wanted


def _summed(program: Program, groups: list[Group], wrt: tuple[str, ...], valid: str | None) -> SummedPart:
    active = depending(program, wrt)
    crossing = boundary(program, active)
    judged = valid if valid in program.output_names else None
    along = _along_positions(program, groups, active, crossing, judged)
    return SummedPart(along, _after_positions(program, groups, wrt, active, along), wrt, judged)


def _extreme(program: Program, term: Term, wrt: tuple[str, ...], valid: str | None) -> ExtremePart:
    judged = valid if valid in program.output_names else None
    kept = [term.output] if judged is None or judged == term.output else [term.output, judged]
    needed = program.only(kept)
    nodes = tuple(node._replace(op="field") if node.op == "position" else node for node in needed.nodes)
    group = Group(0, (Term(term.output, "sum", term.weight),), "sum")
    there = Program(nodes, needed.outputs).only([term.output])
    own = tuple(name for name in wrt if name in there.parameters)
    summed = _summed(there, [group], own, None)
    return ExtremePart(needed, term.output, term.kind, judged, _spread(summed, wrt))


def _spread(part: SummedPart, wrt: tuple[str, ...]) -> SummedPart:
    """The same part with zeros as derivatives by parameters that it does not have."""
    replay = Replay(part.after)
    outputs = replay.outputs
    missing = {derivative_name(name): 0.0 for name in wrt if derivative_name(name) not in outputs}
    return SummedPart(part.along, Program.of(replay.trace, {**outputs, **missing}), wrt, part.valid)


def _along_positions(
    program: Program, groups: list[Group], active: set[int], crossing: list[int], valid: str | None
) -> Program:
    """Each group's part of the objective and its adjoints of the boundary, at one position."""
    replay = Replay(program)
    places = dict(program.outputs)
    varying = {i for i, node in enumerate(program.nodes) if node.varies}
    outputs: dict[str, Scalar | bool] = {}
    if valid is not None:
        outputs[valid] = replay.values[places[valid]]
    for group in groups:
        values = [replay.values[places[term.output]] for term in group.terms]
        outputs[group.part] = group.at_position(replay.trace, values)
        adjoints = Adjoints(replay, active)
        for term, value in zip(group.terms, values, strict=True):
            adjoints.add(places[term.output], group.seed(replay.trace, term, value))
        adjoints.sweep_back(varying)
        for index in crossing:
            if index in adjoints.found:
                outputs[group.adjoint(index)] = adjoints.found[index].value
    return Program.of(replay.trace, outputs)


def _after_positions(
    program: Program, groups: list[Group], wrt: Sequence[str], active: set[int], along: Program
) -> Program:
    """The objective, and from the sums of the boundary's adjoints those of the parameters."""
    fixed = [i for i, node in enumerate(program.nodes) if not node.varies]
    replay = Replay(program, fixed)
    t = replay.trace
    adjoints = Adjoints(replay, active)
    summed = set(along.output_names)
    total: Scalar = 0.0
    for group in groups:
        count = 1.0 if group.kind == "sum" else t.parameter(VALID_COUNT)
        value, factor = group.after(t, t.parameter(f"{group.part}.sum"), count)
        total = t.add(total, value)
        for index in fixed:
            if group.adjoint(index) in summed:
                share = t.parameter(f"{group.adjoint(index)}.sum")
                adjoints.add(index, t.mul(factor, share))
    adjoints.sweep_back(set(fixed))
    place = {node.name: i for i, node in enumerate(program.nodes) if node.op == "parameter"}
    outputs: dict[str, Scalar | bool] = {VALUE: total}
    for name in wrt:
        adjoint = adjoints.found.get(place[name])
        outputs[derivative_name(name)] = 0.0 if adjoint is None else adjoint.value
    return Program.of(t, outputs)
