"""Derivatives of outputs and of their summaries over the cycle with respect to dimensions."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal, get_args

import numpy as np

from linkwright.analysis.by_name import NO_OUTPUTS, wanted
from linkwright.core.arguments import STEPS, one_of, one_or_more, require
from linkwright.core.arrays import Floats
from linkwright.core.attached import PlotMixin
from linkwright.core.data import Frozen, locked
from linkwright.core.table import Amount, Cell, Table, Tabular, unused
from linkwright.cycle.summaries import Summary
from linkwright.designs.metrics_of_designs import OF_VALUES
from linkwright.designs.objective import over_metrics
from linkwright.designs.objective_terms import differentiable
from linkwright.designs.slopes import FRICTION_SLOPE, Slopes, known_loads
from linkwright.designs.traced_outputs import Traced
from linkwright.designs.varied_dimensions import checked_addresses, refuse_misfits, refuse_moved_limits
from linkwright.errors import LinkwrightError, RequestError
from linkwright.formula.summaries import BACKENDS, Backend
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinetostatics.named_outputs import Quantity
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

Way = Literal["auto", "forward", "reverse"]

#: What asks for the curve of an output, in place of a kind.
CURVE = "curve"
#: From this number of dimensions on, the gradient of a summary is found by a reverse sweep.
REVERSE_PAYS = 6


@dataclass(eq=False)
class Sensitivity(PlotMixin, Tabular, Frozen):
    """Values and exact derivatives at the mechanism as it is; SI units of the output per SI unit of the dimension.

    ``by``: the dimensions. An output asked by name alone has curves (n,): :meth:`curve`, :meth:`slope`; one asked
    with a kind (``driver.effort rms``) a number and a gradient: :meth:`value`, :meth:`gradient`.
    """

    row_names: ClassVar[str] = "number"
    mechanism: Mechanism
    by: tuple[str, ...]
    input: Floats
    curves: Mapping[str, Floats]
    slopes: Mapping[tuple[str, str], Floats]
    values: Mapping[Summary, float] = field(default_factory=dict)
    gradients: Mapping[Summary, Floats] = field(default_factory=dict)
    quantities: Mapping[str, Quantity] = field(default_factory=dict)

    def curve(self, output: str) -> Floats:
        """An output over the positions, (n,)."""
        self._asked(output)
        return self.curves[output]

    def slope(self, output: str, by: str) -> Floats:
        """Derivative of an output with respect to a dimension at fixed input, (n,)."""
        self._asked(output)
        if by not in self.by:
            raise RequestError(
                _(
                    "{name!r} is not among the dimensions {names}",
                    code="study.not_a_dimension",
                    name=by,
                    names=tuple(self.by),
                )
            )
        return self.slopes[output, by]

    def value(self, output: str, kind: str | None = None) -> float:
        """A summary over the cycle."""
        return self.values[self._summary(output, kind)]

    def gradient(self, output: str, kind: str | None = None) -> Floats:
        """Derivatives of a summary, (dimensions,) in the order of ``by``."""
        return self.gradients[self._summary(output, kind)]

    def by_name(self, output: str, kind: str | None = None) -> dict[str, float]:
        """The same by the dimensions' addresses."""
        return dict(zip(self.by, self.gradient(output, kind).tolist(), strict=True))

    def relative(self, output: str, kind: str | None = None) -> Floats:
        """Percent by which a summary changes per percent of each dimension: (p/y)·dy/dp, in the order of ``by``.

        NaN where y is zero.
        """
        value = self.values[self._summary(output, kind)]
        nominal = np.array([self.mechanism.dimension(by) for by in self.by])
        return locked(nominal * self.gradient(output, kind) / (value or np.nan))

    def columns(self) -> dict[str, Any]:
        """Summaries by name with their values and their derivatives by every dimension, SI."""
        found: dict[str, Any] = {"number": [summary.name for summary in self.values]}
        found["value"] = np.array(list(self.values.values()))
        for by, column in zip(self.by, np.array(list(self.gradients.values())).T, strict=False):
            found[unused(by, found)] = column
        return found

    def tables(self, language: str = "en") -> tuple[Table, ...]:
        """Every summary with its derivative by each dimension, SI, and what has curves."""
        rows: list[list[Cell]] = [
            [summary.name, *map(Amount, (self.values[summary], *row))] for summary, row in self.gradients.items()
        ]
        title = _("Sensitivity of {name!r} (SI units)", name=self.mechanism.name)
        curves = _("curves: {curves}; by {names}", curves=", ".join(self.curves), names=", ".join(self.by))
        head = ["", _("value"), *(f"∂/∂ {by}" for by in self.by)]
        return (Table(head if rows else (), rows, title=title, notes=[curves] if self.curves else []),)

    def data(self) -> dict[str, Any]:
        """Plain data, SI: values and gradients of summaries, curves with their derivatives."""
        return {
            "name": self.mechanism.name,
            "by": list(self.by),
            "input": self.input.tolist(),
            "summaries": [
                {"number": summary.name, "value": value, "gradient": self.gradients[summary].tolist()}
                for summary, value in self.values.items()
            ],
            "curves": [
                {"output": name, "values": v.tolist(), "slopes": [self.slopes[name, by].tolist() for by in self.by]}
                for name, v in self.curves.items()
            ],
        }

    def __repr__(self) -> str:
        return self.text()

    def _asked(self, output: str) -> None:
        if output not in self.curves:
            raise RequestError(
                _(
                    "no curve of {output!r} was asked for; name an output without a summary, as in of=['jaw.angle']",
                    code="study.no_curve",
                    output=output,
                )
            )

    def _summary(self, output: str, kind: str | None) -> Summary:
        found = split(output if kind is None else (output, kind))
        if not isinstance(found, Summary) or found not in self.values:
            raise RequestError(
                _(
                    "no summary {output!r} was asked for; there is {names}",
                    code="study.no_summary_asked",
                    output=output,
                    names=tuple(s.name for s in self.values),
                )
            )
        return found


def sensitivity(
    mechanism: Mechanism,
    *,
    of: Iterable[str | tuple[str, str]],
    by: Iterable[str],
    steps: int | None = None,
    way: Way = "auto",
    backend: Backend = "auto",
) -> Sensitivity:
    """Exact derivatives of outputs, and of their summaries over the cycle, with respect to dimensions.

    Args:
        mechanism: where the derivatives are taken.
        of: outputs (see :func:`sweep`), alone for their curves, or with a kind: ``driver.effort rms``. Kinds: min,
            max, mean, rms, range, peak. Or metrics, as in :func:`objective`; the curve of an output that is
            called like one is ``("velocity_ratio jaw", "curve")``.
        by: addresses of dimensions (``pitman.length``, ``jaw.mass``) or names of parameters.
        steps: None for summaries of the cycle, exact between positions, as metrics always are; a number for
            those of so many positions, as curves have (without it 360).
        way: of summaries of positions: ``forward`` carries a derivative per dimension along with every line of the
            program, ``reverse`` sweeps back from a summary to all dimensions at once; ``auto`` chooses.
        backend: ``numpy``, ``llvm`` (compiled), or ``auto``.

    Returns:
        The derivatives at fixed input; those of loads that follow the motion (ramps between limit positions, tables,
        expressions) are included by the chain rule.

    Raises:
        LinkwrightError: unknown names (nearest ones offered); friction near self-locking, or in more than 16 pairs
            of one group; dimensions that wheels of given size fix, as the distance of their centres.
        PositionError: the mechanism does not pass its cycle.

    Where the size of a vector is zero its derivative is taken as zero.
    """
    require(mechanism, Mechanism)
    one_of("way", way, get_args(Way))
    one_of("backend", backend, BACKENDS)
    positions = over_cycle(mechanism, STEPS if steps is None else steps)
    dimensions = checked_addresses(mechanism, by)
    if not dimensions:
        raise RequestError(
            _(
                "no dimension is given to differentiate by; name some, such as by=['crank.length']",
                code="study.nothing_to_differentiate",
            )
        )
    _refuse_input(dimensions)
    refuse_misfits(mechanism, dimensions)
    refuse_moved_limits(mechanism, positions, dimensions)
    asked = [split(each) for each in one_or_more(of)]
    if not asked:
        raise RequestError(NO_OUTPUTS)
    traced = Traced(mechanism, dimensions, positions, turning=True)
    if not traced.nominal.complete:
        raise traced.nominal.refusal()
    if traced.nominal.modes:
        traced = Traced(mechanism, dimensions, positions, turning=True, flipping=True)
    sampled = steps is not None or not mechanism.drivers
    return _Derivation(traced, dimensions, asked, way, backend, sampled=sampled).result()


def split(each: str | tuple[str, str]) -> str | Summary:
    """An output alone, or a summary of it; raises LinkwrightError for a kind that has no derivative."""
    if isinstance(each, tuple) and each[1:] == (CURVE,):
        return each[0]
    if isinstance(each, str) and len(wanted([each])) == 2:
        return each
    return differentiable(each)


def _refuse_input(by: Iterable[str]) -> None:
    for address in by:
        if address.startswith("cycle.") or address.endswith(".start"):
            raise RequestError(
                _(
                    "{address} moves the positions of the input; derivatives are taken at fixed input, "
                    "so leave it out",
                    code="study.moves_input",
                    address=address,
                )
            )


class _Derivation:
    """The work of one call."""

    def __init__(
        self,
        traced: Traced,
        by: tuple[str, ...],
        asked: list[str | Summary],
        way: Way,
        backend: Backend,
        *,
        sampled: bool,
    ) -> None:
        self.by, self.alone = by, [each for each in asked if isinstance(each, str)]
        summaries = [each for each in asked if isinstance(each, Summary)]
        self.numbers = [each for each in summaries if not (sampled and each.kind)]
        self.sampled = [each for each in summaries if sampled and each.kind]
        names = [*self.alone, *(each.output for each in self.sampled)]
        loads = known_loads(traced, traced.program(traced.quantities(names)).fields, by)
        if loads.names or loads.rubbing:
            traced = traced.with_loads(loads.names, rubbing=loads.rubbing)
        self.traced = traced
        self.quantities = traced.quantities([*names, *(each.output for each in self.numbers if each.kind)])
        self.work = Slopes(traced, {name: self.quantities[name] for name in names}, by, backend, loads)
        if not self.work.certain:
            raise LinkwrightError(FRICTION_SLOPE)
        self.back = way == "reverse" or (way == "auto" and len(by) >= REVERSE_PAYS)

    def result(self) -> Sensitivity:
        slopes: dict[tuple[str, str], Floats] = {}
        curves: dict[str, Floats] = {}
        for name in self.alone:
            curves[name] = self._curve(name)
            slopes |= {(name, by): row for by, row in zip(self.by, self.work.forward(name), strict=True)}
        found = {each: (self._value(each), self._gradient(each)) for each in self.sampled} | self._of_cycle()
        values = {each: found[each][0] for each in (*self.sampled, *self.numbers)}
        gradients = {each: found[each][1] for each in values}
        input_ = self.traced.nominal.input if self.traced.mechanism.drivers else np.zeros(1)
        return Sensitivity(self.traced.mechanism, self.by, input_, curves, slopes, values, gradients, self.quantities)

    def _curve(self, name: str) -> Floats:
        """Values of an output; an angle and what has one in its formula as the motion gives it, continuous over the
        positions."""
        quantity = self.quantities[name]
        if quantity.output.of_course:
            return self.traced.nominal.read(quantity.output)
        return quantity.shown(self.work.values(name))

    def _value(self, summary: Summary) -> float:
        curve = self._curve(summary.output)
        return float(OF_VALUES[summary.kind](curve))

    def _of_cycle(self) -> dict[Summary, tuple[float, Floats]]:
        """Metrics and summaries of the cycle with their gradients."""
        mechanism, asked = self.traced.mechanism, {each.name: each for each in self.numbers}
        every: dict[Summary, tuple[float, Floats]] = {}
        columns = {by: np.array([mechanism.dimension(by)]) for by in self.by}
        backend = self.work.backend
        for part in over_metrics(mechanism, self.by, dict.fromkeys(asked, 1.0), backend) if asked else []:
            sums = [{name: 1.0} for name in part.weights]
            found, slopes = part.cycle.gradients(sums, columns, self.by, backend=backend)
            for name, value, slope in zip(part.weights, found, slopes, strict=True):
                every[asked[name]] = float(value[0]), slope[0]
        return every

    def _gradient(self, summary: Summary) -> Floats:
        """Derivatives of a summary, as a weighted sum of those at the positions."""
        weights = self._weights(summary)
        if self.back:
            found = self.work.reverse(summary.output, weights)
            if np.isfinite(found).all():
                return found
        return np.asarray(self.work.forward(summary.output) @ weights)

    def _weights(self, summary: Summary) -> Floats:
        """Derivative of the summary by the value at every position."""
        curve = self._curve(summary.output)
        n = len(curve)
        if summary.kind == "mean":
            return np.full(n, 1.0 / n)
        if summary.kind == "rms":
            value = self._value(summary)
            return curve / (n * value) if value > 0.0 else np.zeros(n)
        weights = np.zeros(n)
        if summary.kind == "peak":
            place = int(np.abs(curve).argmax())
            weights[place] = 1.0 if curve[place] >= 0.0 else -1.0
        if summary.kind in ("max", "range"):
            weights[int(curve.argmax())] += 1.0
        if summary.kind in ("min", "range"):
            weights[int(curve.argmin())] -= 1.0 if summary.kind == "range" else -1.0
        return weights
