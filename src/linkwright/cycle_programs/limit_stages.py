"""Stages of cycle programs that find the two limit positions of an output, in all designs at once.

The extremes over the positions bracket the limits; safeguarded Newton steps with the exact acceleration refine them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import product
from math import pi

import numpy as np

from linkwright.core.inputs import Input
from linkwright.core.outputs import Output
from linkwright.cycle_programs.loaded_cycle import whole_turns
from linkwright.cycle_programs.traced_outputs import VALID, Traced
from linkwright.engine.program import Program
from linkwright.engine.reductions import Reduction
from linkwright.engine.stage import Stage
from linkwright.engine.trace import Mask, Scalar, Trace, absolute, cos, minimum, select, sign, sin, sqrt
from linkwright.kinematics.names import program_names
from linkwright.kinetostatics.friction import Swinging
from linkwright.kinetostatics.load_site import LAP, TracedSite, limit_name, output_value, value_name
from linkwright.loads.base import Load
from linkwright.loads.phases import SwingPhase
from linkwright.loads.strokes import NEAR, TURN, turned

#: The step of the input between two positions, rad, and the number of positions that are reached.
STEP, ASSEMBLED = "step of the input", "assembled at limits"
#: How near the sum of directions of neighbouring places comes to the longest; others lack some (π/n)² of it.
TOGETHER = 1e-7
#: Newton steps (halvings among them), and the change of the input in the last one that ends the search well, rad.
STEPS, CONVERGED = 10, 1e-10
#: Newton steps from a limit of a design to that of one near it; how near to a position, rad, one counts as on it.
NEAR_STEPS, AT = 5, 1e-9
#: Steps to the edge of a part of a stroke, which may be far from the middle of it.
EDGE_STEPS = 40


def limit_stages(
    traced: Traced,
    outputs: Iterable[Swinging],
    *,
    judged: bool = True,
    valued: Iterable[Output] = (),
    shown: Iterable[Output] = (),
) -> list[Stage]:
    """For every output its cycle values ``limit:OUTPUT:max`` and ``:min`` (rad of the input), of the ``valued`` ones
    also ``value:OUTPUT:max`` and ``:min``, of those that are ``shown`` ``extreme:OUTPUT:max`` and ``:min`` (angles
    as the machine itself has them), and where ``judged`` ``doubt:OUTPUT``: above zero where these are not certain to
    be its only limits."""
    asked, known, named = tuple(dict.fromkeys(outputs)), set(valued), set(shown)
    if not asked:
        return []
    refined = []
    for each, kind in product(asked, ("max", "min")):
        there: dict[str, Scalar] = {}
        if isinstance(each, Output) and each in known:
            there[value_name(each, kind)] = output_value(traced.solver.motion, each)
        if isinstance(each, Output) and each in named:
            there[extreme_name(each, kind)] = traced.named.quantity(each.name).value
        refined.append(_refined(traced, each, kind, there))
    return [_seen(traced, asked, judged), *refined, *([_doubt(traced, asked)] if judged else [])]


def rates(traced: Traced, output: Swinging) -> tuple[Scalar, Scalar]:
    """Rate and second derivative of an output as traced values."""
    if not isinstance(output, Output):
        a, b = (traced.solver.motion.states[link] for link in (output.a, output.b))
        return b.omega - a.omega, b.alpha - a.alpha
    rate, second = (traced.solver.outputs.value(name) for name in program_names(traced.mechanism, output)[1])
    return rate, second


def _course(traced: Traced, output: Swinging) -> Scalar:
    """What has its largest and smallest value where an output has."""
    if isinstance(output, Output):
        return traced.named.quantity(output.name).carrier
    turned = traced.nominal.link(output.b).angle - traced.nominal.link(output.a).angle
    middle = 0.5 * float(np.nanmin(turned) + np.nanmax(turned))
    a, b = (traced.solver.motion.poses[link].direction for link in (output.a, output.b))
    c, s = float(np.cos(middle)), float(np.sin(middle))
    along, across = a.dot(b), a.cross(b)
    return (across * c - along * s) / (1.0 + along * c + across * s)


def _seen(traced: Traced, outputs: Iterable[Swinging], judged: bool) -> Stage:
    """The inputs of the positions with the largest and the smallest value; where ``judged`` how many positions have a
    growing value, and the sum of their directions on the circle of inputs."""
    trace, around = traced.solver.motion.trace, _direction(traced)
    found: dict[str, Scalar | bool] = {"input": trace.position("input"), VALID: traced.counted_for_certain}
    wanted: dict[str, Reduction] = {}
    for each in outputs:
        found[f"{each}"] = _course(traced, each)
        wanted |= {
            f"near:{each}:{kind}": Reduction("input", f"at_{kind}", f"{each}")  # type: ignore[arg-type]
            for kind in ("max", "min")
        }
        if judged:
            grows = select(rates(traced, each)[0] > 0.0, 1.0, 0.0)
            sums = {"grows": grows, **{part: grows * place for part, place in around.items()}}
            found |= {f"{part}:{each}": value for part, value in sums.items()}
            wanted |= {f"sum {part}:{each}": Reduction(f"{part}:{each}", "sum") for part in sums}
    count = ASSEMBLED if judged else ""
    program = Program.of(trace, found)
    if traced.lines:
        t = Trace()
        program = Program.of(t, traced.at_input(program, t, t.position("input")))
    return Stage(program, wanted, valid=VALID, count=count)


def _direction(traced: Traced) -> dict[str, Scalar]:
    """Where a position lies on the circle that stands for the whole cycle."""
    trace, turns = traced.solver.motion.trace, whole_turns(traced)
    if turns > 1:
        angle = trace.position("input") * (1.0 / turns)
        return {"cos": cos(angle), "sin": sin(angle)}
    (driver,) = traced.mechanism.drivers
    return {
        "cos": trace.position(Input("cos", driver).name),
        "sin": trace.position(Input("sin", driver).name),
    }


def extreme_name(output: Output, kind: str) -> str:
    """The cycle value that is the largest or the smallest value of an output."""
    return f"extreme:{output}:{kind}"


def _refined(traced: Traced, output: Swinging, kind: str, values: Mapping[str, Scalar]) -> Stage:
    """The input where the rate is zero, within one step of the nearest position, and values there."""
    t, near = Trace(), f"near:{output}:{kind}"
    rate, second = rates(traced, output)
    motion = Program.of(traced.solver.motion.trace, {"rate": rate, "second": second, **values})
    there = traced.at_input(motion, t, t.state("x"))
    sense = -1.0 if kind == "max" else 1.0
    more = {name: there[name] for name in values}
    wanted = {limit_name(output, kind): "x", f"moved:{output}:{kind}": "moved", **{n: n for n in values}}
    return _newton(
        traced,
        t,
        (sense * there["rate"], sense * there["second"]),
        _beside(traced, t, near),
        near,
        wanted,
        more,
    )


def narrowed(x: Scalar, low: Scalar, high: Scalar, before: Mask, better: Scalar) -> tuple[Scalar, ...]:
    """The next place of a search for a zero, and the bracket: a ``better`` place, the middle where that leaves it;
    ``before``: whether the zero lies towards ``high``."""
    low, high = select(before, x, low), select(before, high, x)
    return select((better - low) * (better - high) <= 0.0, better, 0.5 * (low + high)), low, high


def _beside(traced: Traced, t: Trace, near: str) -> tuple[Scalar, Scalar]:
    """The positions before and after one whose input is a cycle value."""
    (driver,) = traced.mechanism.drivers
    at, step = t.parameter(near), t.parameter(STEP) * sign(t.parameter(f"{driver}.speed"))
    return at - step, at + step


def _newton(
    traced: Traced,
    t: Trace,
    found: tuple[Scalar, Scalar],
    bracket: tuple[Scalar, Scalar],
    start: str,
    wanted: Mapping[str, str],
    more: Mapping[str, Scalar],
    steps: int = STEPS,
) -> Stage:
    """Newton's steps from a cycle value to where what is ``found`` at the state ``x``, with its rate, is zero in a
    bracket, below zero where that begins; ``wanted``: results, and what they are the last values of."""
    (driver,) = traced.mechanism.drivers
    x, low, high = (t.state(name) for name in ("x", "low", "high"))
    gap, rate = found
    first = absolute(low) + absolute(high) <= 0.0
    low0, high0 = (select(first, end, known) for end, known in zip(bracket, (low, high), strict=True))
    better = x - gap / rate * t.parameter(f"{driver}.speed")
    following, low1, high1 = narrowed(x, low0, high0, gap < 0.0, better)
    moved = absolute(following - x)
    program = Program.of(
        t, {**more, "x": following, "moved": moved, "gap": gap}, {"x": following, "low": low1, "high": high1}
    )
    return Stage(
        program,
        {name: Reduction(of, "last") for name, of in wanted.items()},
        steps=steps,
        starts={"x": start, "low": 0.0, "high": 0.0},
        roots={"x": "gap"},
    )


def edge_name(load: str, which: int) -> str:
    """The cycle value that is the input where a part of a stroke begins (0) or ends (1), rad."""
    return f"edge:{load}:{which}"


def part_of_stroke(load: Load) -> SwingPhase | None:
    """The phase of a load, where it is a part of a stroke."""
    phase = load.magnitude.phase
    return phase if isinstance(phase, SwingPhase) and phase.part is not None else None


def part_edges(load: Load) -> dict[int, str]:
    """Cycle values where a part of a stroke begins (0) or ends (1) between its limit positions."""
    phase = part_of_stroke(load)
    return {} if phase is None else {which: edge_name(load.name, which) for which in phase.part_edges}


def part_edge(traced: Traced, load: Load, phase: SwingPhase, which: int) -> Stage:
    """The input at which a part of a stroke begins or ends: between the limits, where the output only grows or falls,
    by Newton's steps, and halvings where these leave the bracket."""
    t = Trace()
    (driver,) = traced.mechanism.drivers
    motion = Program.of(traced.solver.motion.trace, to_edge(traced, load, phase, which))
    there, sense = traced.at_input(motion, t, t.state("x")), sign(t.parameter(f"{driver}.speed"))
    begins, ends = (t.parameter(limit_name(phase.output, kind)) for kind in (phase.start, phase.end))
    bracket = begins, begins + sense * turned(sense * (ends - begins), t.parameter(LAP))
    start, wanted = limit_name(phase.output, phase.start), {edge_name(load.name, which): "x"}
    return _newton(traced, t, (there["gap"], there["rate"]), bracket, start, wanted, {}, EDGE_STEPS)


def to_edge(traced: Traced, load: Load, phase: SwingPhase, which: int) -> dict[str, Scalar]:
    """How far an output has gone beyond the edge of a part of its stroke, and its rate on this way."""
    site = TracedSite(traced.solver.motion, load, along_input=True)
    begin, end, stroke = phase.part_ends(site)
    slack = NEAR * absolute(stroke)
    edge = end + slack if which else begin - slack
    way = (site.output(phase.output) - site.limit_value(phase.output, phase.start)) * sign(stroke)
    return {"gap": way - edge, "rate": rates(traced, phase.output)[0] * sign(stroke)}


def near_limits(traced: Traced, outputs: Iterable[Output], valued: Iterable[Output]) -> Program:
    """Limits by Newton's steps from the inputs ``near:OUTPUT`` per position: ``limit:OUTPUT``, the last step
    ``moved:OUTPUT``, of the ``valued`` ones also ``value:OUTPUT``."""
    t, known = Trace(), set(valued)
    (driver,) = traced.mechanism.drivers
    found: dict[str, Scalar | bool] = {}
    for output in outputs:
        rate, second = rates(traced, output)
        sought = {"step": rate / second, "value": 0.0}
        if output in known:
            sought["value"] = output_value(traced.solver.motion, output)
        motion = Program.of(traced.solver.motion.trace, sought)
        x: Scalar = t.position(f"near:{output}")
        for _ in range(NEAR_STEPS):
            there = traced.at_input(motion, t, x)
            moved = there["step"] * t.parameter(f"{driver}.speed")
            x = x - moved
        found |= {f"limit:{output}": x, f"moved:{output}": absolute(moved)}
        if output in known:
            found[f"value:{output}"] = there["value"]
    return Program.of(t, found)


def agree(traced: Traced, outputs: Iterable[Output]) -> Mask:
    """Whether every output falls at this position just where it lies between the limits ``max`` and ``min``, with
    positions on both ways; on a limit its rate may have either sign."""
    motion, logic = traced.solver.motion, traced.solver.motion.trace.logic
    found: Mask = True
    for output in outputs:
        (driver,) = traced.mechanism.drivers
        sense = sign(motion.trace.parameter(f"{driver}.speed"))
        step, lap = motion.trace.parameter(STEP), motion.trace.parameter(LAP)
        highest, lowest = (motion.trace.parameter(limit_name(output, kind)) for kind in ("max", "min"))
        way = turned(sense * (motion.trace.position("input") - highest), lap)
        length = turned(sense * (lowest - highest), lap)
        gone = way - length
        follows = rates(traced, output)[0] * gone >= 0.0
        beside = minimum(minimum(way, lap - way), absolute(gone)) <= AT
        apart = minimum(length, lap - length) > step
        found = logic("and", found, logic("and", apart, logic("or", follows, beside)))
    return found


def _doubt(traced: Traced, outputs: Iterable[Swinging]) -> Stage:
    """Whether the value grows in one stretch of the positions, and all steps came to an end.

    Of all choices of m of n places evenly round a circle, m beside each other have the longest sum of directions,
    sin(mπ/n)/sin(π/n), and no others reach it.
    """
    t = Trace()
    half = pi / t.parameter("positions")
    doubts: dict[str, Scalar] = {}
    for each in outputs:
        grows, across, up = (t.parameter(f"sum {part}:{each}") for part in ("grows", "cos", "sin"))
        lacking = sin(half * grows) / sin(half) - sqrt(across * across + up * up)
        doubt: Scalar = select(absolute(lacking) <= TOGETHER, 0.0, 1.0)
        doubt = doubt + select(t.parameter(ASSEMBLED) < t.parameter("positions"), 1.0, 0.0)
        for kind in ("max", "min"):
            moved = t.parameter(f"moved:{each}:{kind}")
            doubt = doubt + select(moved <= CONVERGED, 0.0, 1.0)
        doubts[f"doubt:{each}"] = doubt
    return Stage(Program.of(t, doubts), {name: Reduction(name, "first") for name in doubts}, steps=1)


def constants(traced: Traced, count: int | None = None) -> dict[str, float]:
    """What the stages take besides dimensions: how far the input turns in the cycle and from one of ``count``
    positions to the next, rad, and their number, by default that of the study."""
    count = traced.positions.count if count is None else count
    lap = TURN * max(1, whole_turns(traced))
    return {LAP: lap, STEP: lap / count, "positions": float(count)}
