"""Metrics of many designs at once, with gradients: the formulas that serve one machine, over the same cycle."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import Number
from linkwright.analysis.by_name import Asked, metric_named, needs_forces, number_named
from linkwright.analysis.true_speed import EFFORT, INERTIA, TrueSpeedSummary
from linkwright.core.arguments import STEPS
from linkwright.core.arrays import Flags, Floats
from linkwright.cycle.cycle import Cycle
from linkwright.cycle.gradient import Backward
from linkwright.cycle.machine import Machine, NotTogether
from linkwright.cycle.solved import Solved
from linkwright.cycle.summaries import Signal
from linkwright.errors import RequestError
from linkwright.events.course import moves
from linkwright.formula.gradient import forward
from linkwright.formula.machine_code import available
from linkwright.formula.numpy_backend import numpy_program
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.replay import inlined
from linkwright.formula.summaries import Backend
from linkwright.formula.threads import cores, spread_over
from linkwright.formula.trace import Scalar, Trace
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.run import solve_forces
from linkwright.machine.speeds import SteadyDesigns
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: Designs of one block: what is found of them stays in a core's cache.
BLOCK = 512
#: Fewer designs than this are found before code is compiled.
FEW = 8
_SUM = "weighted sum"


class MetricsOfDesigns(ABC):
    """Metrics of one mechanism's designs at once; ``kinds``: the names of their dimensions by their own."""

    kinds: Mapping[str, str]

    @property
    @abstractmethod
    def dimensions(self) -> tuple[str, ...]:
        """Those of the varied dimensions on which the metrics depend."""

    @abstractmethod
    def evaluate(
        self, columns: Mapping[str, Floats], *, threads: int | None = None, backend: Backend = "auto"
    ) -> tuple[dict[str, Floats], Flags]:
        """The metrics of the designs with these columns, (designs,) each, and which designs are certain to have
        no others: they pass the full cycle."""

    @abstractmethod
    def gradients(
        self,
        sums: Sequence[Mapping[str, float]],
        columns: Mapping[str, Floats],
        by: Sequence[str],
        *,
        threads: int | None = 1,
        backend: Backend = "auto",
    ) -> tuple[Floats, Floats]:
        """Weighted sums of metrics (sums, designs) and their gradients (sums, designs, by), from one evaluation of
        the cycle; NaN where it is not certain."""


def numbers_of_designs(
    mechanism: Mechanism,
    varied: Iterable[str],
    names: Iterable[str],
    *,
    steps: int = STEPS,
    asked: Asked | None = None,
) -> NumbersOfDesigns | None:
    """Registered metrics (``peak_reaction``, ``peak_reaction O5``) and summaries (``driver.effort rms``) of all
    designs of a mechanism with some dimensions changed, those that apply to it and are formulas of summaries.

    ``steps``: of the motion by which it is judged what applies; ``asked``: see ``by_name.number_named``. None where
    the cycle is no formula of one position (see ``cycle.machine.Machine``), or the dimensions move its times. What is
    found for a machine is cached.
    """
    requested, addresses = tuple(names), tuple(varied)
    key = (addresses, requested, steps, asked)
    return _cache.get(mechanism, key, lambda: _numbers(mechanism, addresses, requested, steps, asked))


_cache: Recent[Mechanism, NumbersOfDesigns | None] = Recent(16)


def _numbers(
    mechanism: Mechanism, addresses: tuple[str, ...], requested: tuple[str, ...], steps: int, asked: Asked | None
) -> NumbersOfDesigns | None:
    nominal = solve_motion(mechanism, steps=steps, failures="mark")
    forces = any(needs_forces(name, mechanism, asked) for name in requested)
    try:
        machine = Machine(mechanism, nominal, addresses, unloaded=not forces)
        if any(moves(mechanism, address, steps) for address in addresses):
            return None
        analysis = Analysis.of(solve_forces(nominal) if forces else nominal)
        found = {name: number_named(name, analysis, asked) for name in requested}
        numbers = {name: each for name, each in found.items() if each is not None and _fits(each, machine)}
        return NumbersOfDesigns(machine, numbers, analysis)
    except NotTogether:
        return None


def _fits(number: Number, machine: Machine) -> bool:
    """Whether the cycle has the summaries of a number."""
    return bool(machine.course.turns) or all(each.of_cycle for each in number.summaries)


class NumbersOfDesigns(MetricsOfDesigns):
    """Formulas of summaries; made by :func:`numbers_of_designs`."""

    def __init__(self, machine: Machine, numbers: Mapping[str, Number], analysis: Analysis) -> None:
        self.machine, self.numbers, self.analysis = machine, numbers, analysis
        summaries = [each for number in numbers.values() for each in number.summaries]
        self.running = {each.name: each for each in summaries if isinstance(each, TrueSpeedSummary)}
        limited = [output for output in analysis.outputs if analysis.complete and analysis.limits(output)]
        never = (output for number in numbers.values() for output in number.passed_over)
        even = (EFFORT, INERTIA) if self.running else ()
        self.cycle = Cycle(machine, (each for each in summaries if each.of_cycle), limited, never, even)
        self.kinds = {name: number.dimension or "" for name, number in numbers.items()}
        self._slopes: dict[tuple[tuple[str, float], ...], tuple[Program, list[str]]] = {}

    @property
    def dimensions(self) -> tuple[str, ...]:
        """What the numbers depend on."""
        taken = self.cycle.columns
        return tuple(address for address in self.machine.varied if address in taken)

    @cached_property
    def _formulas(self) -> Program:
        """All numbers from the summaries, the designs side by side."""
        t = Trace()
        parts: dict[str, Scalar] = {name: t.position(name) for name in (*self.cycle.parts, *self.running)}
        return Program.of(t, {name: number.value(parts) for name, number in self.numbers.items()})

    # values ---------------------------------------------------------------------------------------------
    def evaluate(
        self, columns: Mapping[str, Floats], *, threads: int | None = None, backend: Backend = "auto"
    ) -> tuple[dict[str, Floats], Flags]:
        """Values (designs,) by name, and which designs are certain."""
        designs = len(next(iter(columns.values())))
        values = {name: np.empty(designs) for name in self.numbers}
        certain = np.zeros(designs, dtype=np.bool_)
        cycle = self._compiled(designs, backend)

        def work(first: int, end: int) -> None:
            solved = Solved(cycle, {address: column[first:end] for address, column in columns.items()})
            parts, certain[first:end] = self._parts(solved)
            found = _of(self._formulas, parts)
            for name, number in self.numbers.items():
                row = self._of_two_limits(number, found[name], solved)
                values[name][first:end] = row
                certain[first:end] &= np.isfinite(row)

        spread_over(designs, BLOCK, cores() if threads is None else threads, work)
        return values, certain

    def _of_two_limits(self, number: Number, values: Floats, solved: Solved) -> Floats:
        """A number (designs,); NaN for one of the way between both limits where these are not the only outermost
        ones."""
        places = [each.name for each in number.summaries if each.kind in ("argmax", "argmin")]
        ends = [self.cycle.limited[name] for name in places if name in self.cycle.limited]
        for output in {each for each in ends if ends.count(each) > 1}:
            if output in solved.limits:
                values = np.where(solved.limits[output].single(outermost=True), values, np.nan)
        return values

    def _compiled(self, designs: int, backend: Backend) -> Cycle:
        """The cycle by code that is compiled where that pays."""
        compiled = designs >= FEW and available() if backend == "auto" else backend == "llvm"
        self.machine.compiled = compiled
        return self.cycle

    def _parts(self, solved: Solved) -> tuple[dict[str, Floats], Flags]:
        """All summaries, (designs,) each, and of which designs these are certain."""
        certain = solved.passed & ~solved.turned_round
        found = dict(solved.values)
        if self.running:
            steady = self._steady(solved)
            for name, part in self.running.items():
                found[name] = np.where(solved.passed, steady.number(part.kind, part.required), np.nan)
                certain &= steady.met(part.kind, part.required)
        return found, certain

    def _steady(self, solved: Solved) -> SteadyDesigns:
        effort, inertia = (self.cycle.number[Signal(words)] for words in (EFFORT, INERTIA))
        return SteadyDesigns(solved.pieces, effort, inertia, solved.speed)

    # gradients ------------------------------------------------------------------------------------------
    def gradients(
        self,
        sums: Sequence[Mapping[str, float]],
        columns: Mapping[str, Floats],
        by: Sequence[str],
        *,
        threads: int | None = 1,
        backend: Backend = "auto",
    ) -> tuple[Floats, Floats]:
        """Weighted sums and their gradients."""
        designs = len(next(iter(columns.values())))
        values, slopes = np.empty((len(sums), designs)), np.empty((len(sums), designs, len(by)))
        cycle = self._compiled(designs, backend)

        def work(first: int, end: int) -> None:
            solved = Solved(cycle, {address: column[first:end] for address, column in columns.items()})
            parts, sure = self._parts(solved)
            for number, weights in enumerate(sums):
                value, slope = self._gradient(solved, parts, weights)
                values[number, first:end] = np.where(sure, value, np.nan)
                for k, address in enumerate(by):
                    slopes[number, first:end, k] = np.where(sure, slope[address], np.nan)

        spread_over(designs, BLOCK, cores() if threads is None else threads, work)
        return values, slopes

    def _gradient(
        self, solved: Solved, parts: Mapping[str, Floats], weights: Mapping[str, float]
    ) -> tuple[Floats, dict[str, Floats]]:
        """A weighted sum of numbers, and its derivatives by the columns of the designs."""
        program, taken = self._sum(tuple(weights.items()))
        found = _of(program, parts)
        bars = {text: np.nan_to_num(found[f"{_SUM}|{text}"]) for text in taken}
        more = None
        running = {text: bars.pop(text) for text in list(bars) if text in self.running}
        if running:
            steady, pieces = self._steady(solved), solved.pieces
            signals = {Signal(words): np.zeros_like(pieces.values(0)) for words in (EFFORT, INERTIA)}
            by_width = np.zeros(len(pieces.stretch))
            for text, bar in running.items():
                part = self.running[text]
                *own, width = steady.weights(part.kind, part.required, bar)
                for words, each in zip((EFFORT, INERTIA), own, strict=True):
                    signals[Signal(words)] += each
                by_width += width
            more = signals, by_width
        return found[_SUM], Backward(solved).gradient(bars, more)

    def _sum(self, weights: tuple[tuple[str, float], ...]) -> tuple[Program, list[str]]:
        """A weighted sum of numbers with its derivatives by the summaries that it takes."""
        if weights not in self._slopes:
            found = inlined(self._formulas.only([name for name, _unused in weights]), t := Trace(), {})
            total: Scalar = 0.0
            for name, weight in weights:
                total = total + weight * found[name]
            program = Program.of(t, {_SUM: total})
            taken = list(program.positions)
            self._slopes[weights] = forward(program, taken), taken
        return self._slopes[weights]


def _of(program: Program, parts: Mapping[str, Floats]) -> dict[str, Floats]:
    """Outputs of a program over the designs."""
    requested = {name: parts[name] for name in program.positions}
    found = numpy_program(program).run((), requested, length=len(next(iter(parts.values()))))
    return dict(zip(program.output_names, found, strict=True))


def refuse_obstacles(numbers: NumbersOfDesigns) -> None:
    """Raises RequestError where the machine itself has an obstacle to a metric, as one that would stop, or no true
    speed that is asked for."""
    machine = numbers.machine
    for name in numbers.kinds:
        found = metric_named(name)
        if found is not None and (why := found[0].obstacle(numbers.analysis)) is not None:
            raise RequestError(_("{name}: {cause}", name=name, cause=why))
    start = {name: np.array([machine.mechanism.dimension(name)]) for name in machine.varied}
    if numbers.running and not numbers.evaluate(start)[1].all():
        raise RequestError(
            _(
                "the true speed of {name!r}, or the torque that it follows from, changes too "
                "suddenly for a gradient, as where it almost stops; find its numbers without "
                "one, by sweep or study",
                code="study.objective_speed",
                name=machine.mechanism.name,
            )
        )
