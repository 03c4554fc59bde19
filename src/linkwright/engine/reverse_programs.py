"""Programs that take adjoints back: through formulas, over positions, and through solutions of equations.

The adjoint of a number is the derivative of the objective with respect to it; its name is :func:`bar`.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from linkwright.engine.adjoint import Adjoints
from linkwright.engine.linear import inverse, product, transposed
from linkwright.engine.program import Program
from linkwright.engine.reductions import VALID_COUNT, Accumulation, Reduction
from linkwright.engine.replay import Replay, depending, inlined
from linkwright.engine.tangent import tangents
from linkwright.engine.trace import Scalar, Trace


def bar(name: str) -> str:
    """The name of a number's adjoint."""
    return f"bar:{name}"


def back_from_formulas(program: Program, outputs: Sequence[str], active: Collection[str]) -> Program:
    """Adjoints of the active inputs from those of the outputs; all inputs are positions, one for a design."""
    replay = _across_designs(program)
    adjoints = Adjoints(replay, depending(program, active))
    places = dict(program.outputs)
    for name in outputs:
        adjoints.add(places[name], replay.trace.position(bar(name)))
    adjoints.sweep_back(set(range(len(program.nodes))))
    return Program.of(replay.trace, _of_inputs(program, active, [adjoints]))


def back_from_solution(
    program: Program, roots: Mapping[str, str], outputs: Sequence[str], active: Collection[str]
) -> Program:
    """The same through states that bring outputs to zero: g(x, p) = 0, λ = -g_xᵀ⁻¹ x̄, p̄ = h_pᵀ h̄ + g_pᵀ λ.

    ``roots``: the residual's output by the name of the state. An output that is the next value of a state
    counts as the state itself.
    """
    replay = _across_designs(program)
    t, places = replay.trace, dict(program.outputs)
    lines = depending(program, (*active, *roots))
    following = {index: state for state, index in program.next_states if state in roots}
    state_bars: dict[str, Scalar] = dict.fromkeys(roots, 0.0)
    direct = Adjoints(replay, lines)
    for name in outputs:
        given, state = t.position(bar(name)), following.get(places[name])
        if state is None:
            direct.add(places[name], given)
        else:
            state_bars[state] = t.add(state_bars[state], given)
    direct.sweep_back(set(range(len(program.nodes))))
    own = {node.name: index for index, node in enumerate(program.nodes) if node.op == "state"}
    jacobian: list[list[Scalar]] = [[] for _ in roots]
    for state in roots:
        found = direct.found.get(own[state])
        if found is not None:
            state_bars[state] = t.add(state_bars[state], found.value)
        change = tangents(replay, state)
        for row, residual in zip(jacobian, roots.values(), strict=True):
            row.append(change.get(places[residual], 0.0))
    factors = product(inverse(transposed(jacobian)), list(state_bars.values()))
    implicit = Adjoints(replay, lines)
    for residual, factor in zip(roots.values(), factors, strict=True):
        implicit.add(places[residual], t.neg(factor))
    implicit.sweep_back(set(range(len(program.nodes))))
    return Program.of(t, _of_inputs(program, active, [direct, implicit]))


def along_positions(
    program: Program, reductions: Sequence[Reduction], active: Collection[str], valid: str | None
) -> Accumulation:
    """Adjoints of the active parameters, summed over the positions.

    What a position's output weighs is a parameter, the adjoint of the reduction's name: of a sum the
    adjoint itself, of a mean divided by the count, of a root mean square divided by the count and the root.
    """
    t = Trace()
    replay = Replay(program, trace=t)
    lines = _lines(replay, {reduction: t.parameter(bar(reduction.name)) for reduction in reductions}, active)
    judged = {} if valid is None else {valid: replay.outputs[valid]}
    along = Program.of(t, {**judged, **lines})
    return Accumulation(along, (), valid, _after_positions(program, active, along), program.parameters)


def with_slopes(
    program: Program, reduction: Reduction, active: Collection[str], after: Program | None, prefix: str
) -> tuple[Program, Program]:
    """A program, and what follows it, that also find the slopes of one sum, mean or root mean square.

    The slopes are outputs of what follows, named by the prefix and the parameter.
    """
    replay = Replay(program)
    along = Program.of(replay.trace, {**replay.outputs, **_lines(replay, {reduction: 1.0}, active)})
    t = Trace()
    share: Scalar = 1.0
    if reduction.kind != "sum":
        share = 1.0 / t.parameter(VALID_COUNT)
    if reduction.kind == "rms":
        share = share / t.parameter(reduction.name)
    slopes = inlined(_after_positions(program, active, along), t, {})
    outputs: dict[str, Scalar | bool] = {} if after is None else inlined(after, t, {})
    for name, slope in slopes.items():
        outputs[prefix + name.removeprefix(bar(""))] = t.mul(slope, share)
    return along, Program.of(t, outputs)


def _lines(
    replay: Replay, weights: Mapping[Reduction, Scalar], active: Collection[str]
) -> dict[str, Scalar | bool]:
    """At one position the adjoints of the active lines per design."""
    program = replay.program
    lines, places = depending(program, active), dict(program.outputs)
    adjoints = Adjoints(replay, lines)
    for reduction, weight in weights.items():
        place = places[reduction.output]
        if reduction.kind == "rms":
            weight = replay.trace.mul(weight, replay.values[place])
        adjoints.add(place, weight)
    adjoints.sweep_back({i for i, node in enumerate(program.nodes) if node.varies})
    found = {index: adjoints.found.get(index) for index in boundary(program, lines)}
    return {f"line {index}": adjoint.value for index, adjoint in found.items() if adjoint is not None}


def _after_positions(program: Program, active: Collection[str], along: Program) -> Program:
    """From the sums of the adjoints of the lines per design those of the parameters."""
    fixed = [i for i, node in enumerate(program.nodes) if not node.varies]
    replay = Replay(program, fixed)
    adjoints = Adjoints(replay, depending(program, active))
    summed = set(along.output_names)
    for index in fixed:
        if f"line {index}" in summed:
            adjoints.add(index, replay.trace.parameter(f"line {index}.sum"))
    adjoints.sweep_back(set(fixed))
    return Program.of(replay.trace, _of_inputs(program, active, [adjoints]))


def boundary(program: Program, active: set[int]) -> list[int]:
    """Active lines per design that lines per position or outputs use."""
    used = {a for node in program.nodes if node.varies for a in node.args}
    used.update(i for _, i in program.outputs)
    return sorted(i for i in used if i in active and not program.nodes[i].varies)


def _across_designs(program: Program) -> Replay:
    t = Trace()
    names = (*program.parameters, *program.positions, *program.fields, *program.states)
    return Replay(program, trace=t, inputs={name: t.position(name) for name in names})


def _of_inputs(
    program: Program, active: Collection[str], adjoints: Sequence[Adjoints]
) -> dict[str, Scalar | bool]:
    """The adjoints of the active inputs by name; inputs without one are left out."""
    outputs: dict[str, Scalar | bool] = {}
    for index, node in enumerate(program.nodes):
        parts = [each.found[index].value for each in adjoints if index in each.found]
        if not node.args and node.name in active and parts:
            total: Scalar = 0.0
            for part in parts:
                total = total + part
            outputs[bar(node.name)] = total
    return outputs
