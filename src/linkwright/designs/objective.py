"""Objectives of designs: value and exact gradient of weighted summaries and path errors, for one design and many."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from linkwright.analysis.by_name import is_metric
from linkwright.analysis.extents_of_designs import swept
from linkwright.analysis.of_designs import MetricsOfDesigns, NumbersOfDesigns, numbers_of_designs, refuse_obstacles
from linkwright.core.arguments import STEPS, one_of, require
from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output
from linkwright.designs.metrics_of_designs import side_by_side
from linkwright.designs.objective_terms import (
    NO_GRADIENTS,
    Builder,
    PathError,
    Terms,
    differentiable,
    number_of_points,
    weighted,
)
from linkwright.designs.varied_dimensions import checked_addresses, refuse_moved_positions
from linkwright.errors import RequestError
from linkwright.formula.machine_code import available
from linkwright.formula.recently_made import Recent
from linkwright.formula.summaries import BACKENDS, Backend
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.positions import Positions, at_inputs
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _


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
class OverMetrics:
    """Metrics, and summaries of the cycle, with their weights."""

    names: tuple[str, ...]
    cycle: MetricsOfDesigns
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
        found, certain = self.cycle.evaluate(columns, threads=threads, backend=self.backend)
        total = sum(weight * found[name] for name, weight in self.weights.items())
        return np.where(certain, total, np.nan)


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
            array = np.asarray(values, dtype=float)
        except (TypeError, ValueError):
            raise RequestError(
                _(
                    "a design is given by one number for each of {names}, not by {given}",
                    code="study.objective_numbers",
                    names=self.names,
                    given=repr(values)[:60],
                )
            ) from None
        if array.ndim != 2 or array.shape[1] != len(self.names):
            raise RequestError(
                _(
                    "the designs must have the columns {names}, not the shape {shape}",
                    code="study.objective_shape",
                    names=self.names,
                    shape=str(np.shape(values)),
                )
            )
        return dict(zip(self.names, array.T, strict=True))

    def __repr__(self) -> str:
        return f"Objective({', '.join(self.names)})"


def objective(
    mechanism: Mechanism,
    terms: Terms,
    *,
    vary: Iterable[str],
    steps: int | None = None,
    at: ArrayLike | None = None,
    backend: Backend = "auto",
) -> Objective:
    """A weighted sum of summaries over the cycle and of path errors, as a function of some dimensions.

    Args:
        mechanism: the design to start from; its assembly modes hold for all.
        terms: metrics (``"peak_reaction O5"``, ``"rms_input_torque"``, those of :func:`metrics`), summaries
            such as ``"driver.effort rms"`` (see :func:`sweep`; kinds min, max, mean, rms, range, peak), and
            :class:`PathError`; several with their weights in a mapping.
        vary: addresses of dimensions, or names of parameters.
        steps: None for summaries of the cycle, exact between positions, as metrics always are; a number for
            those of so many positions. A path error has as many positions as points.
        at: inputs of the first driver, rad or m, instead of the cycle: summaries and path errors are of these.
        backend: ``numpy``, ``llvm`` (compiled once, in some tenths of a second), or ``auto``: that where llvmlite is.

    Loads are included, limit positions with their derivatives; friction too, NaN where it is near locking.

    Raises:
        LinkwrightError: unknown names; the friction and loads that :func:`sweep` finds design by design; positions
            too far apart to count the turns of a link that a dyad places and a wheel follows.
    """
    require(mechanism, Mechanism)
    one_of("backend", backend, BACKENDS)
    names = checked_addresses(mechanism, vary)
    if not names:
        raise RequestError(
            _(
                'nothing varies; give dimensions with their values: {{"crank.length": values}}',
                code="study.nothing_varied",
            )
        )
    weights = weighted(terms)
    sampled = steps is not None or at is not None or not mechanism.drivers
    numbers = {
        term: weight for term, weight in weights.items() if isinstance(term, str) and (is_metric(term) or not sampled)
    }
    others = {term: weight for term, weight in weights.items() if term not in numbers}
    compiled: Backend = "llvm" if backend == "auto" and available() else backend
    parts: list[Part] = []
    if numbers:
        named = {differentiable(term).name: weight for term, weight in numbers.items()}
        parts += over_metrics(mechanism, names, named, compiled)
    if others:
        parts.append(_of_positions(mechanism, names, others, steps or STEPS, at, compiled))
    idle = [name for name in names if not any(name in part.names for part in parts)]
    if idle:
        raise RequestError(
            _(
                "{names} has no influence on what is asked; leave it out",
                code="study.objective_idle",
                names=tuple(idle),
            )
        )
    known = mechanism.dimensions()
    return Objective(names, np.array([known[name] for name in names]), parts)


def over_metrics(
    mechanism: Mechanism, names: tuple[str, ...], weights: Mapping[str, float], backend: Backend
) -> list[OverMetrics]:
    """The weighted sum of metrics and summaries of the cycle, by what finds them; raises RequestError where one has
    no gradient."""
    found = side_by_side(mechanism, names, [*weights])
    missing = [name for name in weights if not any(name in each.kinds for each in found)]
    if missing:
        raise RequestError(_refusal(mechanism, names, missing))
    for each in found:
        if isinstance(each, NumbersOfDesigns):
            refuse_obstacles(each)
    return [
        OverMetrics(
            tuple(name for name in names if name in each.dimensions),
            each,
            {name: weights[name] for name in each.kinds},
            backend,
        )
        for each in found
    ]


def _refusal(mechanism: Mechanism, names: tuple[str, ...], missing: list[str]) -> Message:
    """Why metrics of a mechanism have no gradient."""
    if hulls := tuple(name for name in missing if swept(name, mechanism)):
        return _(
            "{names} of {name!r} has a gradient where no change point is passed and, over other "
            "cycles than full turns at constant speed, groups have closed forms and no "
            "dimension moves the inputs; for its value use sweep",
            code="study.objective_swept",
            names=hulls,
            name=mechanism.name,
        )
    if numbers_of_designs(mechanism, names, missing) is not None:
        return _(
            "{names} of {name!r} has no gradient over the cycle, or does not apply to it; choose another one",
            code="study.objective_metric",
            names=tuple(missing),
            name=mechanism.name,
        )
    _refuse_moved_cycle(mechanism, names, over_cycle(mechanism, STEPS))
    signals = MotionSignals(solve_motion(mechanism))
    for name, load in mechanism.loads.items():
        output = load.reverses(mechanism)
        count = len(signals.limits(output)) if isinstance(output, Output) else 0
        if count > 2:
            values = {"load": name, "output": output, "count": count}
            return _(
                "{name!r}: the load {load!r} has the sign of the rate of {output}, which changes it "
                "{count} times in a turn, where gradients with groups without closed form take two "
                "changes; for summaries use sensitivity with steps, for metrics study"
            ).format(name=mechanism.name, **values)
    return NO_GRADIENTS.format(name=mechanism.name)


def of_path(mechanism: Mechanism, names: tuple[str, ...], path: PathError, backend: Backend) -> Part:
    """A path error over the cycle, cached for the machine; ``names`` on which it does not depend are left out."""
    target = np.array(path.target, dtype=float)
    key = (names, path.point, target.shape, target.tobytes(), backend)
    made = replace(path, target=target)
    return _paths.get(mechanism, key, lambda: _of_positions(mechanism, names, {made: 1.0}, 0, None, backend))


_paths: Recent[Mechanism, Part] = Recent(16)


def _of_positions(
    mechanism: Mechanism,
    names: tuple[str, ...],
    weights: dict[str | PathError, float],
    steps: int,
    at: ArrayLike | None,
    backend: Backend,
) -> Part:
    points = number_of_points(weights)
    positions = at_inputs(mechanism, at) if at is not None else over_cycle(mechanism, points or steps)
    if not positions.count:
        raise RequestError(
            _(
                "no positions; give an input or a time, or leave at and times out for the full cycle",
                code="motion.no_positions",
            )
        )
    if points and positions.count != points:
        raise RequestError(
            _(
                "{points} target points do not belong to {positions} positions; give as many inputs (at)",
                code="study.objective_count",
                points=points,
                positions=positions.count,
            )
        )
    if at is None:
        _refuse_moved_cycle(mechanism, names, positions)
    return Builder(mechanism, names, positions, weights).built(backend)


def _refuse_moved_cycle(mechanism: Mechanism, names: Iterable[str], positions: Positions) -> None:
    """Raises RequestError for a dimension with which the cycle changes, so that its numbers have no derivative."""
    known = mechanism.dimensions()
    refuse_moved_positions(mechanism, positions, {name: np.array([1.001 * known[name] or 1e-3]) for name in names})
