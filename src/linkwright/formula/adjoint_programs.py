"""Programs that take adjoints back: through formulas, and over positions.

The adjoint of a number is the derivative of the objective with respect to it; its name is :func:`bar`.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from linkwright.formula.adjoint import Adjoints
from linkwright.formula.program import Program
from linkwright.formula.reductions import Reduction
from linkwright.formula.replay import Replay, across_designs, depending
from linkwright.formula.trace import Scalar, Trace


def bar(name: str) -> str:
    """The name of a number's adjoint."""
    return f"bar:{name}"


def back_from_formulas(program: Program, outputs: Sequence[str], active: Collection[str]) -> Program:
    """Adjoints of the active inputs from those of the outputs; all inputs are positions, one for a design."""
    t = Trace()
    names = (*program.parameters, *program.positions, *program.fields)
    replay = Replay(program, trace=t, inputs={name: t.position(name) for name in names})
    adjoints = Adjoints(replay, depending(program, active))
    places = dict(program.outputs)
    for name in outputs:
        adjoints.add(places[name], replay.trace.position(bar(name)))
    adjoints.sweep_back(set(range(len(program.nodes))))
    return Program.of(replay.trace, _of_inputs(program, active, adjoints))


def along_positions(
    program: Program, reductions: Sequence[Reduction], active: Collection[str], *, fused: bool
) -> tuple[Program, Program]:
    """What of the adjoints of the active parameters is summed over the positions, besides the outputs, and from the
    sums, ``line.sum``, and the parameters the adjoints themselves, across designs.

    What a position's output weighs is a parameter, the adjoint of the reduction's name: of a sum the adjoint itself,
    of a mean divided by the count, of a root mean square divided by the count and the root. ``fused``: for the only
    reduction it is 1.
    """
    replay = Replay(program)
    weights: dict[Reduction, Scalar] = {
        each: 1.0 if fused else replay.trace.parameter(bar(each.name)) for each in reductions
    }
    along = Program.of(replay.trace, {**replay.outputs, **_lines(replay, weights, active)})
    return along, across_designs(_after_positions(program, active, along))


def _lines(replay: Replay, weights: Mapping[Reduction, Scalar], active: Collection[str]) -> dict[str, Scalar | bool]:
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
    return Program.of(replay.trace, _of_inputs(program, active, adjoints))


def boundary(program: Program, active: set[int]) -> list[int]:
    """Active lines per design that lines per position or outputs use."""
    used = {a for node in program.nodes if node.varies for a in node.args}
    used.update(i for _, i in program.outputs)
    return sorted(i for i in used if i in active and not program.nodes[i].varies)


def _of_inputs(program: Program, active: Collection[str], adjoints: Adjoints) -> dict[str, Scalar | bool]:
    """The adjoints of the active inputs by name; inputs without one are left out."""
    found: dict[str, Scalar] = {}
    for index, node in enumerate(program.nodes):
        if not node.args and node.name in active and index in adjoints.found:
            found[bar(node.name)] = found.get(bar(node.name), 0.0) + adjoints.found[index].value
    return dict(found)
