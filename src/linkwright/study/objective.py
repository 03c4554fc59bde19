"""Objectives of designs: value and exact gradient of weighted summaries and path errors, for one design and many."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.given import one_of, require
from linkwright.core.outputs import Output
from linkwright.cycle.summary import KINDS, Summary, reductions
from linkwright.cycle_programs.iterated_groups import Following, following, limits_beside
from linkwright.cycle_programs.limit_stages import constants
from linkwright.cycle_programs.loaded_cycle import (
    FoundLimits,
    along_input,
    found_limits,
    friction_doubt,
    with_loads,
)
from linkwright.cycle_programs.traced_outputs import CLEAR, VALID, Traced, design_table
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.cycle_gradient import CycleGradient, cycle_gradient
from linkwright.engine.machine_code import available
from linkwright.engine.program import Program
from linkwright.engine.recently_made import Recent
from linkwright.engine.reductions import Reduction
from linkwright.engine.stage import BACKENDS, Backend, Stage
from linkwright.engine.states import states_as_fields
from linkwright.engine.table import Table
from linkwright.engine.trace import Mask, Scalar, Trace, absolute, maximum, select
from linkwright.errors import RequestError
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.names import point_key
from linkwright.kinematics.positions import Positions, at_inputs
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.named_outputs import Quantity
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.mechanism.mechanism import Mechanism
from linkwright.metrics.hulls_of_designs import hulls_of_designs, swept
from linkwright.metrics.of_designs import numbers_of_designs, refuse_unsteady
from linkwright.metrics.ranges_of_designs import ranged, ranges_of_designs
from linkwright.metrics.terms import refuse_obstacle
from linkwright.metrics.wanted import is_metric, wanted
from linkwright.study.design_numbers import Numbers
from linkwright.study.objective_terms import PathError, Terms, number_of_points, weighted
from linkwright.study.varied_dimensions import checked_addresses, refuse_moved_positions
from linkwright.units import LARGEST
from linkwright.words.sentence import Sentence

VALUE = "objective"


class Part(Protocol):
    """Some terms of an objective, that depend on the dimensions ``names``."""

    @property
    def names(self) -> tuple[str, ...]:
        """Dimensions that it depends on."""
        ...

    def many(self, columns: Mapping[str, Floats], threads: int | None) -> tuple[Floats, Floats]:
        """Values (designs,) and gradients (designs, names)."""
        ...

    def values(self, columns: Mapping[str, Floats], threads: int | None) -> Floats:
        """Values (designs,)."""
        ...


@dataclass(frozen=True, eq=False)
class OverPositions:
    """Summaries and path errors over the positions of the cycle, as one cycle program."""

    names: tuple[str, ...]
    gradient: CycleGradient
    arrays: Mapping[str, Floats]
    known: Mapping[str, float]
    tables: Mapping[str, Table]
    backend: Backend
    following: Following | None = None

    def many(self, columns: Mapping[str, Floats], threads: int | None) -> tuple[Floats, Floats]:
        """Values (designs,) and gradients (designs, names)."""
        table = self._table(columns)
        fields = self._states(columns, threads)
        return self.gradient.evaluate(
            table, self.arrays, fields, tables=self.tables, threads=threads, backend=self.backend
        )

    def values(self, columns: Mapping[str, Floats], threads: int | None) -> Floats:
        """Values (designs,)."""
        fields = self._states(columns, threads)
        found = self.gradient.plain.evaluate(
            self._table(columns),
            self.arrays,
            fields,
            tables=self.tables,
            threads=threads,
            backend=self.backend,
        )
        return np.asarray(found[self.gradient.value])

    def _states(self, columns: Mapping[str, Floats], threads: int | None) -> dict[str, Floats]:
        """Chain coordinates of groups without closed form, (designs, n)."""
        return {} if self.following is None else self.following.states(columns, threads, self.backend)

    def _table(self, columns: Mapping[str, Floats]) -> Floats:
        return design_table(self.gradient.cycle.dimensions, self.known, columns)


@dataclass(frozen=True, eq=False)
class OverMetrics:
    """Registered design numbers with their weights."""

    names: tuple[str, ...]
    cycle: Numbers
    weights: Mapping[str, float]
    backend: Backend

    def many(self, columns: Mapping[str, Floats], threads: int | None) -> tuple[Floats, Floats]:
        """Values (designs,) and gradients (designs, names)."""
        values, slopes = self.cycle.gradients(
            [self.weights], columns, self.names, threads=threads, backend=self.backend
        )
        return values[0], slopes[0]

    def values(self, columns: Mapping[str, Floats], threads: int | None) -> Floats:
        """Values (designs,)."""
        found = self.cycle.evaluate(columns, threads=threads, backend=self.backend)
        total = sum(weight * found.values[name] for name, weight in self.weights.items())
        return np.where(found.certain, total, np.nan)


class Objective:
    """A function of dimensions with its exact gradient; made by :func:`objective`.

    ``names``: the dimensions; ``start`` (k,): their values in the mechanism, SI. Called with (k,) values it gives
    the value and the gradient (k,), as ``scipy.optimize.minimize(f, f.start, jac=True)`` takes them; :meth:`many`
    does the same for (designs, k). NaN where a design does not pass its cycle.
    """

    def __init__(self, names: tuple[str, ...], start: Floats, parts: Sequence[Part]) -> None:
        self.names = names
        self.start: Floats = start
        self._parts = tuple(parts)

    def __call__(self, values: ArrayLike) -> tuple[float, Floats]:
        """Value and gradient (k,) of one design."""
        one: Any = [values]
        found, gradient = self.many(one)
        return float(found[0]), gradient[0]

    def many(self, values: ArrayLike, *, threads: int | None = 1) -> tuple[Floats, Floats]:
        """Values (designs,) and gradients (designs, k) of many designs (designs, k)."""
        columns, places = self._columns(values), {name: place for place, name in enumerate(self.names)}
        count = len(columns[self.names[0]])
        total, gradient = np.zeros(count), np.zeros((count, len(self.names)))
        for part in self._parts:
            found, slopes = part.many(columns, threads)
            total += found
            gradient[:, [places[name] for name in part.names]] += slopes
        gradient[np.isnan(total)] = np.nan
        return total, gradient

    def values(self, values: ArrayLike, *, threads: int | None = 1) -> Floats:
        """Values (designs,) alone of many designs (designs, k), for searches without gradients."""
        columns = self._columns(values)
        return np.asarray(sum(part.values(columns, threads) for part in self._parts))

    def _columns(self, values: ArrayLike) -> dict[str, Floats]:
        try:
            given = np.asarray(values, dtype=float)
        except (TypeError, ValueError):
            raise RequestError("study.objective_numbers", names=self.names, given=repr(values)[:60]) from None
        if given.ndim != 2 or given.shape[1] != len(self.names):
            raise RequestError("study.objective_shape", names=self.names, shape=str(np.shape(values)))
        return dict(zip(self.names, given.T, strict=True))

    def __repr__(self) -> str:
        return f"Objective({', '.join(self.names)})"


def objective(
    mechanism: Mechanism,
    terms: Terms,
    *,
    vary: Iterable[str],
    steps: int = 360,
    at: ArrayLike | None = None,
    backend: Backend = "auto",
) -> Objective:
    """A weighted sum of summaries over the cycle and of path errors, as a function of some dimensions.

    Args:
        mechanism: the design to start from; its assembly modes hold for all.
        terms: design numbers (``"peak_reaction O5"``, ``"rms_input_torque"``, those of :func:`metrics`, exact between
            positions), summaries such as ``"driver.effort rms"`` (see :func:`sweep`; kinds min, max, mean, rms,
            range, peak), and :class:`PathError`; several with their weights in a mapping.
        vary: addresses of dimensions, or names of parameters.
        steps: positions over the cycle; a path error sets them itself.
        at: inputs of the first driver, rad or m, instead of the cycle.
        backend: ``numpy``, ``llvm`` (compiled once, in some tenths of a second), or ``auto``: that where llvmlite is.

    Extremes of summaries are those of the positions; loads are included, limit positions with their derivatives;
    friction too, NaN where it is near locking.

    Raises:
        LinkwrightError: unknown names; the friction and loads that :func:`sweep` finds design by design; positions
            too far apart to count the turns of a link that a dyad places and a wheel follows.
    """
    require(mechanism, Mechanism)
    one_of("backend", backend, BACKENDS)
    names = checked_addresses(mechanism, vary)
    if not names:
        raise RequestError("study.nothing_varied")
    given = weighted(terms)
    numbers = {term: weight for term, weight in given.items() if isinstance(term, str) and is_metric(term)}
    others = {term: weight for term, weight in given.items() if term not in numbers}
    compiled: Backend = "llvm" if backend == "auto" and available() else backend
    parts: list[Part] = []
    hulls = {name: weight for name, weight in numbers.items() if swept(name, mechanism)}
    ranges = {name: weight for name, weight in numbers.items() if ranged(name)}
    formulas = {name: weight for name, weight in numbers.items() if name not in {*hulls, *ranges}}
    parts += [of_metrics(mechanism, names, each, steps, compiled) for each in (hulls, ranges) if each]
    if formulas:
        parts.append(of_metrics(mechanism, names, formulas, steps, compiled))
    if others:
        parts.append(_of_positions(mechanism, names, others, steps, at, compiled))
    idle = [name for name in names if not any(name in part.names for part in parts)]
    if idle:
        raise RequestError("study.objective_idle", names=tuple(idle))
    known = mechanism.dimensions()
    return Objective(names, np.array([known[name] for name in names]), parts)


def of_metrics(
    mechanism: Mechanism, names: tuple[str, ...], weights: Mapping[str, float], steps: int, backend: Backend
) -> Part:
    """The weighted sum of registered metrics, all of them areas of hulls, or ranges of motion, or none; raises
    RequestError where it has no gradient."""
    if (ranges := ranges_of_designs(mechanism, names, weights)) is not None:
        return OverMetrics(ranges.dimensions, ranges, weights, backend)
    if any(swept(name, mechanism) for name in weights):
        hulls = hulls_of_designs(mechanism, names, weights)
        if hulls is None:
            raise RequestError("study.objective_swept", names=tuple(weights), name=mechanism.name)
        return OverMetrics(hulls.dimensions, hulls, weights, backend)
    cycle = numbers_of_designs(mechanism, names, weights, steps=steps)
    if cycle is None:
        raise RequestError(_refusal(mechanism, steps))
    missing = [name for name in weights if name not in {term.name for term in cycle.terms}]
    if missing:
        raise RequestError("study.objective_metric", names=tuple(missing), name=mechanism.name)
    for name in weights:
        refuse_obstacle(name, cycle.analysis)
    refuse_unsteady(cycle)
    own = tuple(name for name in names if name in cycle.dimensions)
    return OverMetrics(own, cycle, weights, backend)


def _refusal(mechanism: Mechanism, steps: int) -> Sentence:
    """Why design numbers of a mechanism have no gradient."""
    signals = MotionSignals(solve_motion(mechanism, steps=steps))
    for name, load in mechanism.loads.items():
        output = load.reverses(mechanism)
        count = len(signals.limits(output)) if isinstance(output, Output) else 0
        if count > 2:
            values = {"load": name, "output": output, "count": count}
            return Sentence("study.objective_reverses", name=mechanism.name, **values)
    return Sentence("study.objective_loads", name=mechanism.name)


def of_path(mechanism: Mechanism, names: tuple[str, ...], path: PathError, backend: Backend) -> Part:
    """A path error over the cycle, kept for the machine; ``names`` on which it does not depend are left out."""
    target = np.array(path.target, dtype=float)
    key = (names, path.point, target.shape, target.tobytes(), backend)
    made = replace(path, target=target)
    return _paths.get(mechanism, key, lambda: _of_positions(mechanism, names, {made: 1.0}, 0, None, backend))


_paths: Recent[Mechanism, Part] = Recent(16)


def _of_positions(
    mechanism: Mechanism,
    names: tuple[str, ...],
    given: dict[str | PathError, float],
    steps: int,
    at: ArrayLike | None,
    backend: Backend,
) -> Part:
    points = number_of_points(given)
    positions = at_inputs(mechanism, at) if at is not None else over_cycle(mechanism, points or steps)
    if not positions.count:
        raise RequestError("motion.no_positions")
    if points and positions.count != points:
        raise RequestError("study.objective_count", points=points, positions=positions.count)
    known = mechanism.dimensions()
    if at is None:
        refuse_moved_positions(
            mechanism, positions, {name: np.array([1.001 * known[name] or 1e-3]) for name in names}
        )
    return _Builder(mechanism, names, positions, given).built(backend)


class _Builder:
    """Traces what the terms need into one cycle program."""

    def __init__(
        self,
        mechanism: Mechanism,
        names: tuple[str, ...],
        positions: Positions,
        terms: dict[str | PathError, float],
    ) -> None:
        self.terms = terms
        self.names = names
        plain = Traced(mechanism, names, positions)
        self.following: Following | None = None
        if any(placed.next_states for placed in plain.solver.motion.placed.values()):
            self.following = following(plain, (), ())
        self.turns = None if self.following else counted_turns(plain)
        outputs = [summary.output for summary in self.summaries]
        fields = plain.program(plain.quantities(outputs)).fields
        loads = along_input(plain, names, fields, over_time=self.following is None)
        if loads is None:
            raise RequestError("study.objective_loads", name=mechanism.name)
        self.loads = loads
        self.traced = with_loads(plain, loads)
        if self.following is not None:
            self._refuse_ways(plain)
        limits = self._limits()
        if limits is None:
            raise RequestError("study.objective_loads", name=mechanism.name)
        self.limits = limits

    def _refuse_ways(self, plain: Traced) -> None:
        """Refuses groups without closed form on other ways than the cycle, and loads by more limits than two."""
        cycle = over_cycle(plain.mechanism, plain.positions.steps)
        signals = MotionSignals(plain.nominal)
        more = any(len(signals.limits(output)) != 2 for output in self.loads.outputs)
        if more or plain.nominal.modes or plain.positions.key != cycle.key:
            raise RequestError("study.objective_iterates", name=plain.mechanism.name)

    @cached_property
    def summaries(self) -> dict[Summary, float]:
        """The summaries with their weights."""
        return {wanted([term])[0]: weight for term, weight in self.terms.items() if isinstance(term, str)}

    @cached_property
    def quantities(self) -> dict[str, Quantity]:
        """The outputs that are summarised."""
        return self.traced.quantities(summary.output for summary in self.summaries)

    @property
    def paths(self) -> list[tuple[PathError, float]]:
        """The path errors with their weights."""
        return [(term, weight) for term, weight in self.terms.items() if isinstance(term, PathError)]

    def built(self, backend: Backend) -> OverPositions:
        outputs, targets = self._outputs()
        program = Program.of(self.traced.solver.motion.trace, {**outputs, VALID: self._valid()})
        made = {each.name: each for each in reductions(self.summaries, self.quantities)}
        made |= {f"path {k}": Reduction(f"path {k}", "mean") for k in range(len(self.paths))}
        loaded = [*self.limits.stages]
        if self.following is not None:
            program = states_as_fields(program)
        if self.turns is not None:
            loaded = [self.turns, *loaded]
            refuse_turns(self.traced, loaded[1:], self.turns.keep)
            program = states_as_fields(program, self.turns.keep)
        stages = (
            *loaded,
            Stage(program, made, valid=VALID, complete=True),
            Stage(self._total(), {VALUE: Reduction(VALUE, "first")}, steps=1),
        )
        cycle = CycleProgram(stages)
        own = tuple(name for name in self.names if name in cycle.dimensions)
        known = {**self.traced.solver.nominal.parameters, **self.limits.constants, **self.loads.constants}
        arrays = {**self.traced.positions.arrays, **self.limits.positions, **targets}
        gradient = cycle_gradient(cycle, VALUE, own)
        return OverPositions(own, gradient, arrays, known, self.loads.tables, backend, self.following)

    def _limits(self) -> FoundLimits | None:
        """What finds the limit positions that the loads need."""
        if self.following is None:
            return found_limits(self.traced, self.loads, judged=False)
        stages = limits_beside(self.traced, self.loads.outputs, self.loads.valued)
        return FoundLimits(tuple(stages), constants(self.traced))

    def _valid(self) -> Mask:
        """Where a position is reached, all loads have values, and the friction is certain."""
        motion = self.traced.solver.motion
        valid = motion.valid
        if self.loads.fallible:
            exist = absolute(self.loads.sizes(motion)) <= LARGEST["torque"]
            valid = motion.trace.logic("and", valid, exist)
        if self.loads.rubbing:
            valid = motion.trace.logic("and", valid, friction_doubt(self.traced) < 0.5)
        return valid

    def _outputs(self) -> tuple[dict[str, Scalar], dict[str, Floats]]:
        """What is reduced, and the targets as inputs per position."""
        trace = self.traced.solver.motion.trace
        outputs = {name: each.carrier for name, each in self.quantities.items()}
        targets: dict[str, Floats] = {}
        for k, (term, _) in enumerate(self.paths):
            place = self.traced.solver.outputs.point(point_key(self.traced.mechanism, term.point))[0]
            points = np.asarray(term.target, dtype=float)
            squares: Scalar = 0.0
            for axis, value, column in (("x", place.x, points[:, 0]), ("y", place.y, points[:, 1])):
                name = f"target {k}.{axis}"
                targets[name] = np.ascontiguousarray(column)
                gap = value - trace.position(name)
                squares = squares + gap * gap
            outputs[f"path {k}"] = squares
        return outputs, targets

    def _total(self) -> Program:
        """The weighted sum, from the reductions."""
        t = Trace()
        total: Scalar = 0.0
        for summary, weight in self.summaries.items():
            total = total + weight * _summary(t, summary, self.quantities[summary.output])
        for k, (_, weight) in enumerate(self.paths):
            total = total + weight * t.parameter(f"path {k}")
        judged = self.following is not None or self.limits.positions
        for output in self.loads.outputs if judged else ():
            total = select(t.parameter(f"doubt:{output}") <= 0.0, total, np.nan)
        return Program.of(t, {VALUE: total})


def counted_turns(traced: Traced) -> Stage | None:
    """Rotations of links that a dyad places, counted from position to position, as fields that further stages take;
    None where nothing counts them.

    Raises:
        RequestError: a link turns too far between two positions for its turns to be told.
    """
    motion, positions = traced.solver.motion, traced.positions
    carried = motion.angles.carried
    if not carried:
        return None
    trace = motion.trace
    passed: Mask = motion.valid
    for name, value in carried.items():
        passed = trace.logic("and", passed, absolute(value - trace.state(name)) < CLEAR)
    known = traced.solver.states(positions)
    starts = {name: float(known[name][0]) for name in carried}
    program = Program.of(trace, {**carried, VALID: passed}, carried)
    stage = Stage(program, valid=VALID, complete=True, starts=starts, keep=tuple(carried))
    if any(np.nanmax(np.abs(np.diff(known[name])), initial=0.0) >= CLEAR for name in carried):
        links = tuple(motion.angles.counted)
        raise RequestError("study.objective_turns", name=traced.mechanism.name, links=links)
    return stage


def refuse_turns(traced: Traced, stages: Iterable[Stage], names: Collection[str]) -> None:
    """Refuses loads whose limits are found between positions by rotations that are counted at positions alone."""
    if any(set(names) & set(stage.program.states) for stage in stages):
        links = tuple(traced.solver.motion.angles.counted)
        raise RequestError("study.objective_turned_loads", name=traced.mechanism.name, links=links)


def _summary(t: Trace, summary: Summary, quantity: Quantity) -> Scalar:
    """A summary in its unit from the reductions of its carrier."""
    if summary.kind in ("argmin", "argmax"):
        raise RequestError("study.place_without_slope", name=summary.name)
    parts = [t.parameter(f"{summary.output}.{kind}") for kind in KINDS[summary.kind]]
    shown = [replace(quantity, carrier=part).value for part in parts]
    if summary.kind == "range":
        return shown[1] - shown[0]
    return maximum(absolute(shown[0]), absolute(shown[1])) if summary.kind == "peak" else shown[0]
