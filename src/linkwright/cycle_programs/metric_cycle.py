"""Design numbers of many designs at once, with gradients: the formulas that serve one machine, as cycle values."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property, partial

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.dataclass import dataclass
from linkwright.cycle.summary import STROKES, TRUE_SPEED, Summary, one, output_of, signal_of
from linkwright.cycle_programs.followed_points import FollowedPoints, followed_points
from linkwright.cycle_programs.gauss_cycle import PIECES, SHARE, GaussCycle, can_have_corners, reversing
from linkwright.cycle_programs.limit_stages import constants, rates, whole_turns
from linkwright.cycle_programs.loaded_cycle import along_input, with_loads
from linkwright.cycle_programs.piece_summaries import SIDES, PieceSummaries
from linkwright.cycle_programs.signal_summaries import Seen
from linkwright.cycle_programs.steady_designs import REST, SIGNALS, SteadyDesigns
from linkwright.cycle_programs.term_parts import (
    AT_LIMITS,
    PLACES,
    least_of,
    of_sides,
    outputs_of,
    stroke_parts,
    without_limits,
    without_more_limits,
)
from linkwright.cycle_programs.terms import Asked, Term, all_parts, term
from linkwright.cycle_programs.timed_cycle import TimedCycle, can_go_together, gauss_points
from linkwright.cycle_programs.traced_outputs import VALID, Traced, TurnsThrough, design_table
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.cycle_gradient import CycleGradient, cycle_gradient
from linkwright.engine.machine_code import available
from linkwright.engine.numpy_backend import numpy_program
from linkwright.engine.program import Program
from linkwright.engine.recently_made import Recent
from linkwright.engine.reductions import Reduction
from linkwright.engine.replay import across_designs
from linkwright.engine.stage import Backend, Stage
from linkwright.engine.threads import cores, spread_over
from linkwright.engine.trace import Scalar, Trace, absolute, atan, minimum, select, sqrt
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinetostatics.run import solve_forces
from linkwright.kinetostatics.traced_loads import AlongInput
from linkwright.mechanism.mechanism import Mechanism
from linkwright.metrics import Analysis

#: Designs of one call.
BLOCK = 2048
#: Designs whose weights of Gauss points are kept at the same time, and whose signals, for the true speed.
WEIGHED, RUNNING = 256, 512
#: More configurations than there are: signals are wanted at once.
_WHOLE = 1 << 62
VALUE = "value"


def metric_cycle(
    mechanism: Mechanism,
    varied: Iterable[str],
    names: Iterable[str | Term],
    *,
    steps: int = 360,
    asked: Asked | None = None,
) -> MetricCycle | None:
    """Registered metrics (``peak_reaction``, ``peak_reaction O5``) of all designs of a mechanism with some dimensions
    changed, as cycle values; those that apply to it and are formulas of summaries. Terms are taken as they are.

    ``steps``: of the motion by which it is judged what applies; ``asked``: see ``terms.term``. None where the
    designs cannot go side by side: the way passes change points, loads do not follow the input, polynomials do not
    meet the machine itself, or the cycle is no whole number of turns of one driver of constant speed and the
    dimensions move its times or inputs, an output by whose limits a load goes has more than two, a group has no
    closed form, or an angle that is taken goes through more than a turn. What is found for a machine is kept.
    """
    given, addresses = tuple(names), tuple(varied)
    key = (addresses, given, steps, asked)
    try:
        return _cycles.get(mechanism, key, lambda: _metric_cycle(mechanism, addresses, given, steps, asked))
    except TurnsThrough:
        return None


def _metric_cycle(
    mechanism: Mechanism,
    addresses: tuple[str, ...],
    given: tuple[str | Term, ...],
    steps: int,
    asked: Asked | None,
) -> MetricCycle | None:
    plain = Traced(mechanism, addresses, over_cycle(mechanism, steps))
    if not can_go_together(plain, addresses):
        return None
    turns = whole_turns(plain)
    analysis = Analysis.of(solve_forces(plain.nominal))
    offered = (each if isinstance(each, Term) else term(each, analysis, asked) for each in given)
    fitting = without_more_limits if turns else without_limits
    terms = [each for each in offered if each is not None and fitting(each, analysis)]
    outputs = tuple(outputs_of(map(one, all_parts(terms))))
    program = plain.program(plain.quantities(outputs))
    loads = along_input(plain, addresses, program.fields, over_time=True)
    if loads is None:
        return None
    opposed, apart = reversing(plain, program)
    turning = (*loads.swinging, *apart)
    if turns:
        ways = (analysis.output(output_of(part)) for part in stroke_parts(all_parts(terms)).values())
        others = (*opposed, *(each for each in ways if each is not None))
        rubbing = turning if can_have_corners(plain) else turning[:0]
        swinging = others if rubbing else (*turning, *others)
        loads = replace(loads, swinging=tuple(dict.fromkeys(swinging)))
    else:
        rubbing, loads = (*turning, *loads.moving, *opposed), replace(loads, swinging=(), moving=())
    traced = with_loads(plain, loads)
    gauss = gauss_points(traced, loads, analysis, PIECES[0])
    nominal = {address: np.array([mechanism.dimension(address)]) for address in addresses}
    if gauss is None:
        return None
    first = MetricCycle(traced, gauss, terms, analysis, loads)
    signals = [each.value for each in traced.quantities(outputs).values()]
    cut = gauss.cornered(loads, signals, rubbing)
    limited = rubbing if turns else (*rubbing, *loads.outputs)
    if cut is not gauss and (limited or not first.met(nominal)[1].all()):
        first = MetricCycle(traced, cut, terms, analysis, loads)
    return _met(first, nominal)


def _met(first: MetricCycle, nominal: Mapping[str, Floats]) -> MetricCycle | None:
    """The same with the pieces that the machine itself needs; terms that are met by no polynomials left out."""
    coarsest: MetricCycle | None = None
    following: MetricCycle | None = first
    while following is not None:
        finest = following
        sure, running = finest.met(nominal)
        if running.all():
            return finest
        coarsest = coarsest or (finest if sure.all() else None)
        following = finest.finer
    met = () if coarsest else finest.terms_met(nominal)
    if not met or len(met) == len(first.terms):
        return coarsest
    return _met(MetricCycle(first.traced, first.gauss, met, first.analysis, first.loads), nominal)


_cycles: Recent[Mechanism, MetricCycle | None] = Recent(16)


@dataclass(frozen=True)
class Found:
    """Values (designs,) by name, and which designs' are ``certain``: cycles that are passed, and met by the Gauss
    points."""

    values: Mapping[str, Floats]
    certain: Flags


class MetricCycle:
    """Terms of one mechanism's designs; made by :func:`metric_cycle`."""

    def __init__(
        self,
        traced: Traced,
        gauss: GaussCycle | TimedCycle,
        terms: Sequence[Term],
        analysis: Analysis,
        loads: AlongInput,
    ) -> None:
        self.analysis, self.loads = analysis, loads
        self.traced, self.gauss, self.terms = traced, gauss, tuple(terms)
        texts = all_parts(terms)
        on_strokes = stroke_parts(texts)
        self.least = least_of(map(one, texts), on_strokes)
        self.one_way = tuple(dict.fromkeys(output for each in terms for output in each.passed_over))
        self.parts = {
            text: Summary(text, "min") if text in on_strokes else one(text)
            for text in texts
            if text not in self.least
        }
        plain = {text: part for text, part in self.parts.items() if text not in on_strokes}
        named = {text: analysis.output(p.output) for text, p in plain.items() if p.kind in AT_LIMITS}
        own = {text: output for text, output in named.items() if output is not None}
        places = [output for text, output in own.items() if plain[text].kind in PLACES]
        self.outputs = tuple(dict.fromkeys([*loads.outputs, *loads.moving, *loads.swinging, *places]))
        own = {
            text: output
            for text, output in own.items()
            if isinstance(gauss, GaussCycle) and output in self.outputs and len(analysis.limits(output)) == 2
        }
        self.shown = {output for text, output in own.items() if plain[text].kind not in PLACES}
        self.limited: dict[str, tuple[str, ...]] = {
            text: tuple(name(output, side) for side in sides)
            for text, output in own.items()
            for name, sides in [AT_LIMITS[plain[text].kind]]
        }
        found_apart = {*self.limited, *on_strokes}
        outputs = outputs_of(part for text, part in self.parts.items() if text not in found_apart)
        self.courses = {name: each.value for name, each in traced.quantities(outputs).items()}
        self.courses |= {text: self._half_on_stroke(part) for text, part in on_strokes.items()}
        self.halves = tuple(on_strokes)
        self.constant = self._constants()
        self.limited |= {text: (text,) for text in self.constant.output_names}

    def _constants(self) -> Program:
        """The means of lengths and the like, which no position changes, as formulas of the dimensions."""
        trace, found = self.traced.solver.motion.trace, dict[str, Scalar]()
        for text, part in self.parts.items():
            if part.kind == "mean" and text not in self.limited:
                value = self.courses[part.output]
                program = Program.of(trace, {text: value})
                if not (program.positions or program.fields or program.states):
                    found[text] = value
        needed = {part.output for text, part in self.parts.items() if text not in found}
        for name in (
            {self.parts[text].output for text in found} - needed - set(SIGNALS if self.running else ())
        ):
            self.courses.pop(name, None)
        return Program.of(trace, found)

    def _half_on_stroke(self, part: Summary) -> Scalar:
        """Tangent of half a transmission angle while an output goes one way, else the largest one that there is."""
        output, signal = self.analysis.output(output_of(part)), signal_of(part)
        assert output is not None
        rate, _ = rates(self.traced, output)
        going = rate < 0.0 if part.kind == STROKES["max"] else rate > 0.0
        return select(going, self.traced.named.half_transmission(signal), 1.0)

    # values -----------------------------------------------------------------------------------------
    def evaluate(
        self, columns: Mapping[str, Floats], *, threads: int | None = None, backend: Backend = "auto"
    ) -> Found:
        """The terms of the designs with the given columns, (designs,) each."""
        designs = len(next(iter(columns.values())))
        values = {each.name: np.empty(designs) for each in self.terms}
        certain = np.zeros(designs, dtype=np.bool_)
        block = WEIGHED if self.followed else RUNNING if self.running else BLOCK
        # what is compiled serves all blocks, and all pieces on a cluster, however few designs are in the last
        many = designs > min(block, RUNNING)
        own: Backend = "llvm" if backend == "auto" and many and available() else backend

        def work(first: int, end: int) -> None:
            part = {address: column[first:end] for address, column in columns.items()}
            rows, certain[first:end] = self._block(part, own)
            for name, row in zip(self._formulas.output_names, rows, strict=True):
                values[name][first:end] = row

        spread_over(designs, block, cores() if threads is None else threads, work)
        return Found(values, certain)

    @property
    def dimensions(self) -> tuple[str, ...]:
        """What the terms depend on."""
        return self._forwards.dimensions

    def met(self, columns: Mapping[str, Floats]) -> tuple[Flags, Flags]:
        """Which designs are certain with these pieces alone: but for their true speed, and altogether."""
        seen, rows = self._read(columns, "auto")
        found = np.isfinite(rows).all(axis=0)
        return seen.certain & (found | ~seen.running), seen.sure & found

    def terms_met(self, columns: Mapping[str, Floats]) -> tuple[Term, ...]:
        """The terms that are certain of all designs, each for itself."""
        seen, unmet = self._seen(columns, "auto"), set[str]()
        for text, part in self.parts.items():
            if text not in self.limited:
                seen.certain, seen.running = seen.passed.copy(), np.ones_like(seen.passed)
                found = seen.summary(part)
                unmet |= set() if (seen.sure & np.isfinite(found)).all() else {text}
        return tuple(each for each in self.terms if unmet.isdisjoint(each.parts))

    @cached_property
    def finer(self) -> MetricCycle | None:
        """The same with the next number of pieces."""
        gauss = self.gauss.finer
        if gauss is None:
            return None
        return MetricCycle(self.traced, gauss, self.terms, self.analysis, self.loads)

    def _block(self, columns: Mapping[str, Floats], backend: Backend) -> tuple[Floats, Flags]:
        """Rows (terms, designs), and which are certain; designs that pass, but are not met, with finer pieces."""
        rows, sure, left = self._found(columns, backend)
        if len(left) and self.finer is not None:
            again, certain = self.finer._block({a: c[left] for a, c in columns.items()}, backend)
            rows[:, left], sure[left] = again, certain
        return rows, sure

    def _found(self, columns: Mapping[str, Floats], backend: Backend) -> tuple[Floats, Flags, Indices]:
        """The same with these pieces alone, and the numbers of those that pass, but are not met."""
        seen, rows = self._read(columns, backend)
        sure = seen.sure & np.isfinite(rows).all(axis=0)
        return rows, sure, np.flatnonzero(seen.passed & ~seen.sure)

    def _read(self, columns: Mapping[str, Floats], backend: Backend) -> tuple[Seen, Floats]:
        """What is seen of the signals with these pieces, and the rows."""
        seen = self._seen(columns, backend)
        parts = {text: seen.summary(part) for text, part in self.parts.items() if text not in self.limited}
        parts |= {name: seen.values[name] for names in self.limited.values() for name in names}
        return seen, numpy_program(self._formulas).run((), parts, length=len(seen.passed))

    @cached_property
    def followed(self) -> FollowedPoints | None:
        """What finds groups without closed form at the Gauss points."""
        return followed_points(self.traced, self.gauss) if isinstance(self.gauss, GaussCycle) else None

    def _seen(self, columns: Mapping[str, Floats], backend: Backend) -> Seen:
        states = {} if self.followed is None else self.followed.at_positions(columns, backend)
        ((_, known, run),) = self._forwards.blocks(
            self._table(self._forwards, columns),
            self._positions,
            states,
            tables=self.loads.tables,
            threads=1,
            backend=backend,
            size=_WHOLE,
        )
        kept: Flags | bool = True
        if self.followed is not None:
            points, kept = self.followed.at_points(known, run, states)
            known.fields |= points
        found = self._signals.reduced(known.table(self._signals.program.parameters), known.fields, run)
        results = {name: np.asarray(column, dtype=float) for name, column in known.values.items()}
        with np.errstate(invalid="ignore"):
            passed = found.bounds[VALID][1] == 1.0
            for _, _, rough in found.bounds.values():
                passed &= np.isfinite(rough)
            for output in self.outputs:
                passed &= results[f"doubt:{output}"] == 0.0
        gauss = self.gauss
        steady = SteadyDesigns(self._signals.program, known, run, gauss.pieces, gauss.speed, gauss.way)
        seen = Seen(results, found, steady, self.gauss.pieces, passed, known.fields)
        seen.certain &= kept
        return seen

    def _seen_again(self, columns: Mapping[str, Floats], backend: Backend) -> Seen:
        """The same, kept for the last designs: several gradients are often wanted of them."""
        table = self._table(self._forwards, columns)
        key, last = (table.tobytes(), backend), self._last.get("seen")
        if last is None or last[0] != key:
            last = self._last["seen"] = key, self._seen(columns, backend)
        return last[1]

    @cached_property
    def _last(self) -> dict[str, tuple[tuple[bytes, Backend], Seen]]:
        return {}

    @cached_property
    def _positions(self) -> dict[str, Floats]:
        return self.gauss.positions

    @cached_property
    def _formulas(self) -> Program:
        """All terms from the summaries, the designs side by side."""
        t = Trace()
        parts = self._whole(t, t.parameter)
        return across_designs(Program.of(t, {term.name: term.value(parts) for term in self.terms}))

    @cached_property
    def _before(self) -> list[Stage]:
        limits = self.gauss.limit_stages(self.outputs, self.loads.valued, self.shown)
        cuts = self.gauss.cut_stages(None if self.followed is None else self.followed.traced)
        if names := self.constant.output_names:
            cuts.append(Stage(self.constant, {text: Reduction(text, "first") for text in names}, steps=1))
        return [*limits, *cuts]

    @cached_property
    def _forwards(self) -> CycleProgram:
        """What is found before the signals."""
        before = CycleProgram(tuple(self._before))
        taken = [*self._signals.program.parameters]
        if self.followed is not None:
            taken += self.followed.parameters
        more = (name for name in taken if name not in before.results)
        return CycleProgram(before.stages, tuple(dict.fromkeys([*before.dimensions, *more])))

    @cached_property
    def _signals(self) -> PieceSummaries:
        """All signals at the Gauss points, and what is asked of them."""
        program = Program.of(*self.gauss.signals(self.courses, self.one_way))
        return PieceSummaries(program, self._summaries, self.gauss.pieces, SHARE, [VALID])

    @property
    def _summaries(self) -> list[Summary]:
        apart = {*self.limited, *self.running}
        return [part for text, part in self.parts.items() if text not in apart]

    @cached_property
    def running(self) -> set[str]:
        """The parts that the true speed gives."""
        return {text for text, part in self.parts.items() if part.kind in TRUE_SPEED}

    def _table(self, cycle: CycleProgram, columns: Mapping[str, Floats]) -> Floats:
        known = {**self.traced.solver.nominal.parameters, **constants(self.traced, self.gauss.count)}
        known |= {**self.gauss.constants, **self.loads.constants}
        return design_table(cycle.dimensions, known, columns)

    # gradients --------------------------------------------------------------------------------------
    def gradients(
        self,
        sums: Sequence[Mapping[str, float]],
        columns: Mapping[str, Floats],
        by: Sequence[str],
        *,
        threads: int | None = 1,
        backend: Backend = "auto",
    ) -> tuple[Floats, Floats]:
        """Weighted sums of terms (sums, designs) and their gradients (sums, designs, by), from one evaluation of the
        cycle; NaN where it is not certain."""
        designs = len(next(iter(columns.values())))
        values, slopes = np.empty((len(sums), designs)), np.empty((len(sums), designs, len(by)))
        backwards = self._backwards(tuple(tuple(each.items()) for each in sums), tuple(by))

        def work(first: int, end: int) -> None:
            part = {address: column[first:end] for address, column in columns.items()}
            seen = self._seen_again(part, backend)
            fields = dict(seen.fields)
            for text, summary in self.parts.items():
                fields |= {} if text in self.limited else seen.weights(summary)
            table = self._table(backwards.cycle, part)
            found, slope = backwards.evaluate_all(
                table, self._positions, fields, tables=self.loads.tables, threads=1, backend=backend
            )
            found[:, ~seen.sure], slope[:, ~seen.sure] = np.nan, np.nan
            left = np.flatnonzero(seen.passed & ~seen.sure)
            if len(left) and self.finer is not None:
                rest = {a: c[left] for a, c in part.items()}
                found[:, left], slope[:, left] = self.finer.gradients(sums, rest, by, backend=backend)
            values[:, first:end], slopes[:, first:end] = found, slope

        spread_over(designs, WEIGHED, cores() if threads is None else threads, work)
        return values, slopes

    def _backwards(
        self, sums: tuple[tuple[tuple[str, float], ...], ...], by: tuple[str, ...]
    ) -> CycleGradient:
        key = (sums, by)
        if key not in self._kept:
            self._kept[key] = self._differentiable([dict(each) for each in sums], by)
        return self._kept[key]

    @cached_property
    def _kept(self) -> dict[object, CycleGradient]:
        return {}

    def _differentiable(self, asked: Sequence[Mapping[str, float]], by: tuple[str, ...]) -> CycleGradient:
        """The same summaries as sums over the Gauss points with known weights, whose places stay in their pieces."""
        trace, found = self.gauss.signals(self.courses, self.one_way)
        width = found[SHARE]
        sums: dict[str, Scalar] = {}
        for text, part in self.parts.items():
            if text in self.limited:
                continue
            if text in self.running:
                weighted = (trace.field_input(f"{text} {name}") * found[name] for name in SIGNALS)
                sums[text] = sum(weighted, start=trace.field_input(f"{text} {REST}"))
                continue
            signal = found[part.output]
            if part.kind in ("mean", "rms"):
                sums[text] = width * (signal * signal if part.kind == "rms" else signal)
            elif part.kind == "excess":
                sums[f"{text} mean"] = width * signal
                sums[f"{text} all"] = width * trace.field_input(f"{part.output} excess")
                sums[text] = width * trace.field_input(f"{part.output} excess") * signal
            else:
                for side in SIDES[part.kind]:
                    sums[f"{part.output} {side}"] = signal * trace.field_input(f"{part.output} {side}")
        motion = Stage(
            Program.of(trace, {**sums, VALID: found[VALID]}),
            {name: Reduction(name, "sum") for name in sums},
            valid=VALID,
            complete=True,
        )
        t = Trace()
        parts = self._whole(t, partial(self._part, t))
        totals: dict[str, Scalar] = {}
        for number, weights in enumerate(asked):
            known = (weights[each.name] * each.value(parts) for each in self.terms if each.name in weights)
            totals[f"{VALUE} {number}"] = sum(known, start=0.0)
        last = Stage(Program.of(t, totals), {name: Reduction(name, "first") for name in totals}, steps=1)
        return cycle_gradient(CycleProgram((*self._before, motion, last)), tuple(totals), by)

    def _part(self, t: Trace, text: str) -> Scalar:
        """A summary from the sums."""
        part = self.parts[text]
        if part.kind == "mean" or text in self.running:
            return t.parameter(text)
        if part.kind == "rms":
            return sqrt(t.parameter(text))
        if part.kind == "excess":
            return self.gauss.way * absolute(
                t.parameter(f"{text} mean") * t.parameter(f"{text} all") - t.parameter(text)
            )
        return of_sides(part.kind, [t.parameter(f"{part.output} {side}") for side in SIDES[part.kind]])

    def _whole(self, t: Trace, part: Callable[[str], Scalar]) -> dict[str, Scalar]:
        """All parts: from the signals, from values at limits and those that no position changes, and from others."""
        found = {text: part(text) for text in self.parts if text not in self.limited}
        found |= {text: 2.0 * atan(found[text]) for text in self.halves}
        for text, names in self.limited.items():
            found[text] = of_sides(self.parts[text].kind, [t.parameter(name) for name in names])
        return found | {text: minimum(*(found[each] for each in of)) for text, of in self.least.items()}
