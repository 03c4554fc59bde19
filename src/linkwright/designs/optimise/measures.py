"""Values of everything that a problem asks, for many designs at once, and their exact gradients."""

from __future__ import annotations

import pickle
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cached_property, lru_cache

import numpy as np

from linkwright import units
from linkwright.analysis.by_name import Asked, ask
from linkwright.analysis.evaluate import unloaded
from linkwright.analysis.of_designs import MetricsOfDesigns
from linkwright.analysis.outputs import mechanism_outputs, usual_output
from linkwright.core.arrays import Floats
from linkwright.core.expressions import Expression
from linkwright.designs.alternatives import Alternative
from linkwright.designs.checkpoints import current_checkpoints, identity
from linkwright.designs.cluster import current, in_turn
from linkwright.designs.criteria import criterion
from linkwright.designs.metrics_of_designs import side_by_side
from linkwright.designs.named_numbers import expression_of
from linkwright.designs.optimise.dimensions import HeldDimensions
from linkwright.designs.optimise.paths import PathErrors
from linkwright.designs.optimise.problem import Problem
from linkwright.designs.varied_dimensions import refuse_moved_positions
from linkwright.errors import LinkwrightError, RequestError
from linkwright.formula.machine_code import available
from linkwright.formula.summaries import Backend
from linkwright.kinematics.cycle import over_cycle
from linkwright.mechanism.mechanism import Mechanism
from linkwright.units import powers
from linkwright.words import _

#: Designs that a worker of a cluster takes at a time where they go one by one.
FEW = 4


class Measures:
    """The quantities of a problem: texts of goals and demands, each a metric or an expression of some.

    ``side_by_side``: designs go together, with exact gradients; else one after the other, without. ``judged``: the
    numbers of these by the values of the addresses, in the order of the problem's.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem, self.mechanism = problem, problem.mechanism
        texts = dict.fromkeys([*(each.text for each in problem.goals), *(each.text for each in problem.demands)])
        self.expressions = {text: self._expression(text) for text in texts}
        self.numbers = tuple(
            dict.fromkeys(
                name
                for _unused, names in self.expressions.values()
                for name in names.values()
                if name not in self._dimensions and name not in problem.paths
            )
        )
        heaviest = {each.address: each.high for each in problem.variables}
        if (missing := unloaded(self.mechanism.with_dimensions(heaviest), self.numbers)) is not None:
            raise RequestError(missing)
        self.cycles = [] if self._moves_positions() else self._cycles()
        self.side_by_side = bool(self.cycles) or not self.numbers
        self.passing = [] if self.numbers or self._moves_positions() else self._full_cycle()
        self.backend: Backend = "llvm" if available() else "numpy"
        self.paths = PathErrors(self.mechanism, problem.addresses, problem.paths, self.backend)
        self.evaluations = 0
        self.judged: dict[tuple[float, ...], tuple[float, ...]] = {}

    @cached_property
    def _dimensions(self) -> Mapping[str, float]:
        return self.mechanism.dimensions()

    def _expression(self, text: str) -> tuple[Expression | None, dict[str, str]]:
        """An expression with the metrics of its names; None for a number on its own."""
        problem, mechanism = self.problem, self.mechanism
        found, names = expression_of(text, mechanism, self._dimensions, define=problem.define, paths=problem.paths)
        for name in {*names.values()} & {*self._dimensions} if found is not None else ():
            if name in mechanism.expressions and name not in problem.addresses:
                raise RequestError(
                    _(
                        '"{name}" follows from parameters; name the parameters in the expression instead',
                        code="optimize.derived",
                        name=name,
                    )
                )
        return found, names

    def _moves_positions(self) -> bool:
        """Whether designs have cycles of their own, as with numbers of teeth."""
        extremes = {each.address: np.array([each.low, each.high]) for each in self.problem.variables}
        try:
            refuse_moved_positions(self.mechanism, over_cycle(self.mechanism, self.problem.steps), extremes)
        except RequestError:
            return True
        return False

    # many designs ------------------------------------------------------------------------------------
    def _cycles(self) -> list[MetricsOfDesigns]:
        """What finds all numbers of all designs at once; none where some are found one by one."""
        found = self._side_by_side(self.numbers) if self.numbers else []
        return found if {name for each in found for name in each.kinds} == set(self.numbers) else []

    def _full_cycle(self) -> list[MetricsOfDesigns]:
        """Metrics that show which designs pass the full cycle where none of the problem does."""
        moves = mechanism_outputs(self.mechanism)
        return self._side_by_side([f"{self._asked.output.name} max"]) if moves else []

    def _side_by_side(self, numbers: Sequence[str]) -> list[MetricsOfDesigns]:
        problem = self.problem
        return side_by_side(self.mechanism, problem.addresses, numbers, self._asked, steps=problem.steps)

    def _where_they_pass(self, values: dict[str, Floats], columns: Mapping[str, Floats]) -> dict[str, Floats]:
        """Values of every text, NaN where a design does not pass the full cycle."""
        for each in self.passing:
            with np.errstate(all="ignore"):
                values_found, certain = each.evaluate(columns, backend=self.backend)
            passes = certain & np.isfinite([*values_found.values()]).all(axis=0)
            values = {text: np.where(passes, value, np.nan) for text, value in values.items()}
        return values

    def dimension(self, text: str) -> units.Dimension:
        """The dimension of a quantity."""
        expression, names = self.expressions[text]
        kinds = {name: self._kind(number) for name, number in names.items()}
        return kinds[""] if expression is None else expression.dimension(kinds)

    def _kind(self, name: str) -> units.Dimension:
        from linkwright.designs.ranges import dimension_of

        if name in self.paths:
            return units.DIMENSIONS["area"]
        if name in self._dimensions:
            return dimension_of(self.mechanism, name) or units.NONE
        for cycle in self.cycles:
            if name in cycle.kinds:
                return powers(cycle.kinds[name])
        asked = criterion(name)
        found = asked.measure(self._alternative(self.mechanism))
        if found is not None:
            return powers(found.dimension)
        return units.NONE if asked.metric is None else powers(asked.metric.dimension)

    def __call__(self, columns: Mapping[str, Floats]) -> dict[str, Floats]:
        """Values (designs,) of every text, by columns (designs,) of addresses; NaN where a design does not move."""
        count = len(next(iter(columns.values())))
        self.evaluations += count
        found = self._found(columns, count) | self._held.values(columns) | self.paths.values(columns)
        values = {text: self._combined(text, found) for text in self.expressions}
        return self._where_they_pass(values, columns)

    def _found(self, columns: Mapping[str, Floats], count: int) -> dict[str, Floats]:
        if not self.numbers:
            return {}
        if self.cycles:
            with np.errstate(all="ignore"):
                evaluated = [cycle.evaluate(columns, backend=self.backend) for cycle in self.cycles]
            return {name: np.where(sure, v, np.nan) for own, sure in evaluated for name, v in own.items()}
        designs = [*zip(*(column.tolist() for column in columns.values()), strict=True)]
        checkpoints = current_checkpoints()
        there = {
            each: checkpoints and checkpoints.part(identity(*each)) for each in designs if each not in self.judged
        }
        self.judged |= {each: part[0] for each, part in there.items() if part}
        for each, numbers in self._measured(tuple(columns), [each for each, part in there.items() if not part]):
            self.judged[each] = numbers
            if checkpoints is not None:
                checkpoints.add(identity(*each), numbers)
        rows = [self.judged[each] for each in designs]
        return {name: np.array([row[k] for row in rows]) for k, name in enumerate(self.numbers)}

    def measured(self, dimensions: dict[str, float]) -> tuple[float, ...]:
        """Numbers of one design, by its dimensions alone; NaN where it has none or does not move."""
        try:
            each = self._alternative(self.mechanism.with_dimensions(dimensions))
        except LinkwrightError:
            return (np.nan,) * len(self.numbers)
        with suppress(LinkwrightError):  # where nothing is solved, measuring tells
            ask(self.numbers, each.analysis, each.asked)
        return tuple(_number(name, each) for name in self.numbers)

    def _measured(
        self, addresses: tuple[str, ...], designs: list[tuple[float, ...]]
    ) -> Iterator[tuple[tuple[float, ...], tuple[float, ...]]]:
        """Designs with their numbers, one by one, or a few of them at a time on a cluster."""
        client = current()
        if client is None or len(designs) < 2:
            for each in designs:
                yield each, self.measured(dict(zip(addresses, each, strict=True)))
            return
        parts = [designs[first : first + FEW] for first in range(0, len(designs), FEW)]
        tasks = [(self._pickled, addresses, part) for part in parts]
        for number, found in in_turn(client, _designs, tasks):
            yield from zip(parts[number], found, strict=True)

    @cached_property
    def _pickled(self) -> bytes:
        return pickle.dumps(self.problem)

    def _alternative(self, design: Mechanism) -> Alternative:
        asked = self._asked
        return Alternative(design.name, design, asked.output, self.problem.steps, asked.fluctuation)

    @cached_property
    def _asked(self) -> Asked:
        """The output whose travel counts, and δ."""
        return Asked(usual_output(self.mechanism), self.problem.fluctuation)

    @cached_property
    def _held(self) -> HeldDimensions:
        """Dimensions that stand in expressions."""
        names = (name for _unused, each in self.expressions.values() for name in each.values())
        own = dict.fromkeys(name for name in names if name in self._dimensions)
        return HeldDimensions(self.mechanism, self.problem.addresses, [*own])

    def _combined(self, text: str, found: Mapping[str, Floats]) -> Floats:
        expression, names = self.expressions[text]
        if expression is None:
            return found[names[""]]
        with np.errstate(all="ignore"):
            return np.asarray(expression.over({n: found[m] for n, m in names.items()}))

    # gradients ---------------------------------------------------------------------------------------
    def with_slopes(
        self, columns: Mapping[str, Floats], by: tuple[str, ...]
    ) -> tuple[dict[str, Floats], dict[str, Floats]]:
        """Values (designs,) of every text and gradients (designs, k) by the addresses ``by``, from columns."""
        count = len(next(iter(columns.values())))
        self.evaluations += count
        found, slopes = self._held.values(columns), self._held.slopes(columns, by)
        for name in self.paths.parts:
            found[name], slopes[name] = self.paths.with_slopes(name, columns, by)
        for cycle in self.cycles:
            names = [*cycle.kinds]
            numbers, gradients = self._numbers_with_slopes(cycle, names, columns, by)
            found |= zip(names, numbers, strict=True)
            slopes |= zip(names, gradients, strict=True)
        values = {text: self._combined(text, found) for text in self.expressions}
        slopes = {text: self._chained(text, found, slopes) for text in self.expressions}
        return self._where_they_pass(values, columns), slopes

    def curvatures(self, text: str, columns: Mapping[str, Floats], by: tuple[str, ...]) -> Floats | None:
        """Curvature (designs, k, k) of a path error on its own, by the addresses ``by``; None: not known."""
        expression, names = self.expressions[text]
        path = names[""] if expression is None else ""
        return self.paths.curvatures(path, columns, by) if path in self.paths else None

    def _chained(self, text: str, found: Mapping[str, Floats], slopes: Mapping[str, Floats]) -> Floats:
        """The gradient of an expression from those of its numbers."""
        expression, names = self.expressions[text]
        if expression is None:
            return slopes[names[""]]
        values = {name: found[number] for name, number in names.items()}
        total = np.zeros_like(next(iter(slopes.values())))
        for name, number in names.items():
            (rate,) = expression.derivatives(values, name)
            total = total + rate[:, None] * slopes[number]
        return total

    def _numbers_with_slopes(
        self, cycle: MetricsOfDesigns, names: list[str], columns: Mapping[str, Floats], by: tuple[str, ...]
    ) -> tuple[Floats, Floats]:
        """Values (numbers, designs) and gradients (numbers, designs, k) of metrics that a cycle finds."""
        own = [k for k, address in enumerate(by) if address in cycle.dimensions]
        asked, mine = [{name: 1.0} for name in names], [by[k] for k in own]
        with np.errstate(all="ignore"):
            values, part = cycle.gradients(asked, columns, mine, backend=self.backend)
        slopes = np.zeros((*values.shape, len(by)))
        slopes[:, :, own] = part
        return values, slopes


def _designs(pickled: bytes, addresses: tuple[str, ...], designs: list[tuple[float, ...]]) -> list[tuple[float, ...]]:
    """Numbers of some designs, on a worker of a cluster."""
    measures = _of_problem(pickled)
    return [measures.measured(dict(zip(addresses, each, strict=True))) for each in designs]


@lru_cache(2)
def _of_problem(pickled: bytes) -> Measures:
    """Made once for all designs of a search."""
    return Measures(pickle.loads(pickled))


def _number(name: str, each: Alternative) -> float:
    """A number of a design; NaN where it has none."""
    try:
        found = criterion(name).measure(each)
    except RequestError:
        raise
    except LinkwrightError:
        return np.nan
    return np.nan if found is None else float(found.value)
