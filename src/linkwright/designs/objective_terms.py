"""Terms of an objective: weighted summaries and path errors, and one formula of them over the positions."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from linkwright.analysis.by_name import NO_OUTPUTS, NO_TEXT, wanted
from linkwright.core.arguments import real
from linkwright.core.arrays import Floats
from linkwright.cycle.load_limits import FoundLimits
from linkwright.cycle.machine import CLEAR
from linkwright.cycle.summaries import KINDS, Summary
from linkwright.designs.traced_outputs import VALID, LoadedCycle, Traced, friction_doubt, loaded_cycle
from linkwright.errors import RequestError
from linkwright.events.path_tracker import TrackedStates, tracked_states
from linkwright.events.tracked_groups import ITERATIONS
from linkwright.formula.gradient import Gradient
from linkwright.formula.program import Program
from linkwright.formula.summaries import Backend
from linkwright.formula.threads import cores
from linkwright.formula.trace import Mask, Scalar, Trace, absolute, maximum
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.groups import iterated
from linkwright.kinematics.names import point_key
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.structure_with_rank import analysed
from linkwright.kinetostatics.named_outputs import Quantity
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.mechanism.mechanism import Mechanism
from linkwright.units import LARGEST
from linkwright.words import _

_BAD_TARGET = _(
    "the target of a path error is a list of points [x, y] in m, and all targets have as many points",
    code="study.objective_target",
)


@dataclass(frozen=True, eq=False)
class PathError:
    """Mean square distance, m², of a point from target points (n, 2), m, position by position.

    ``point``: ``C`` or ``coupler.P``. There are as many positions as targets: over the cycle, or at the inputs that
    the objective is given.
    """

    point: str
    target: ArrayLike


Terms = str | PathError | Mapping[str | PathError, float] | Sequence[str | PathError]


def weighted(terms: Terms) -> dict[str | PathError, float]:
    """The terms with their weights, 1 where none is given; raises RequestError where there is none, or no number."""
    if isinstance(terms, Mapping):
        found = {term: real(f"weights[{term!r}]", weight) for term, weight in terms.items()}
    elif isinstance(terms, Sequence) and not isinstance(terms, str):
        found = dict.fromkeys(terms, 1.0)
    else:
        found = {terms: 1.0}
    if not found:
        raise RequestError(NO_OUTPUTS)
    for term in found:
        if not isinstance(term, str | PathError):
            raise RequestError(NO_TEXT.format(value=repr(term)[:60]))
    return found


def differentiable(asked: str | tuple[str, str]) -> Summary:
    """The summary, or metric, that is asked for; raises RequestError for a place."""
    found = wanted([asked])[0]
    if found.kind in ("argmin", "argmax"):
        raise RequestError(
            _(
                "{name!r} is a place, which has no derivative here; ask for its extreme",
                code="study.place_without_slope",
                name=found.name,
            )
        )
    return found


def number_of_points(terms: Iterable[str | PathError]) -> int | None:
    """How many points the targets of all path errors have, None without any; raises RequestError where they differ or
    are none."""
    targets = [_points(term.target) for term in terms if isinstance(term, PathError)]
    if any(target.ndim != 2 or target.shape[1] != 2 or not len(target) for target in targets):
        raise RequestError(_BAD_TARGET)
    if len({len(target) for target in targets}) > 1:
        raise RequestError(_BAD_TARGET)
    if not all(np.isfinite(target).all() for target in targets):
        raise RequestError(
            _(
                "the target of a path error has points that are not finite; leave them out, and give "
                "the inputs of the others by at",
                code="study.objective_gaps",
            )
        )
    return len(targets[0]) if targets else None


def _points(target: ArrayLike) -> Floats:
    try:
        return np.asarray(target, dtype=float)
    except (TypeError, ValueError):
        raise RequestError(_BAD_TARGET) from None


VALUE = "objective"
NO_GRADIENTS = _(
    "{name!r} has friction in more than 16 pairs of one group, or (for numbers of the cycle) "
    "passes change points, or has friction with cams or groups without closed form, on a "
    "guide that is pressed from both sides or teeth and chains that pull both ways, loads "
    "that divide by an output or follow a link that turns through, or, over other cycles "
    "than full turns at constant speed, phases by outputs with more limits than two, groups "
    "without closed form, or dimensions that move the inputs, so no gradient of many designs "
    "is found; for summaries use sensitivity with steps, which takes one design at a time, "
    "for metrics study",
    code="study.objective_loads",
)


@dataclass(frozen=True, eq=False)
class OverPositions:
    """Summaries and path errors over the positions of the cycle, with the loads there; ``names``: dimensions on which
    they depend; ``judged``: whether designs need the limits of the machine as it is."""

    names: tuple[str, ...]
    gradient: Gradient
    arrays: Mapping[str, Floats]
    loaded: LoadedCycle
    backend: Backend
    tracked: TrackedStates | None = None
    judged: bool = False

    def many(self, columns: Mapping[str, Floats], threads: int | None) -> tuple[Floats, Floats]:
        """Values (designs,) and gradients (designs, names)."""
        states = self._states(columns, threads)
        limits = self.loaded.solve(columns)
        values, slopes = self.gradient.evaluate(
            self.loaded.table(self.gradient.parameters, columns, limits.numbers if limits else {}),
            self.arrays,
            states,
            tables=self.loaded.loads.tables,
            threads=threads,
            backend=self.backend,
        )
        bars = dict(zip(self.gradient.wrt, slopes.T, strict=True))
        found = {name: bars.get(name, np.zeros(len(values))) for name in self.names}
        if limits is not None:
            for name, slope in limits.pull({k: bar for k, bar in bars.items() if k in limits.numbers}).items():
                if name in found:
                    found[name] = found[name] + slope
        values = self._known(values, limits)
        gradient = np.stack([found[name] for name in self.names], axis=1)
        gradient[np.isnan(values)] = np.nan
        return values, gradient

    def values(self, columns: Mapping[str, Floats], threads: int | None) -> Floats:
        """Values (designs,)."""
        states = self._states(columns, threads)
        limits = self.loaded.solve(columns)
        found = self.gradient.values(
            self.loaded.table(self.gradient.parameters, columns, limits.numbers if limits else {}),
            self.arrays,
            states,
            tables=self.loaded.loads.tables,
            threads=threads,
            backend=self.backend,
        )
        return self._known(found, limits)

    def _known(self, values: Floats, limits: FoundLimits | None) -> Floats:
        """NaN for designs whose limits are others than those of the machine as it is."""
        return values if limits is None or not self.judged else np.where(limits.certain, values, np.nan)

    def _states(self, columns: Mapping[str, Floats], threads: int | None) -> dict[str, Floats]:
        """Chain coordinates of groups without closed form, (designs, n)."""
        return {} if self.tracked is None else self.tracked.of(columns, threads or cores())[0]


class Builder:
    """Traces what the terms need into one program."""

    def __init__(
        self, mechanism: Mechanism, names: tuple[str, ...], positions: Positions, terms: dict[str | PathError, float]
    ) -> None:
        self.terms, self.names = terms, names
        self.iterated = bool(iterated(analysed(mechanism)))
        plain = Traced(mechanism, names, positions, iterations=ITERATIONS if self.iterated else 1)
        self.turns = {} if self.iterated else counted_turns(plain)
        outputs = [summary.output for summary in self.summaries]
        fields = plain.program(plain.quantities(outputs)).fields
        loaded = loaded_cycle(plain, names, fields)
        if self.iterated:
            self._refuse_ways(plain, loaded)
        if loaded is None:
            raise RequestError(NO_GRADIENTS.format(name=mechanism.name))
        self.loaded, self.loads, self.traced = loaded, loaded.loads, loaded.traced

    def _refuse_ways(self, plain: Traced, loaded: LoadedCycle | None) -> None:
        """Refuses groups without closed form on other ways than the cycle, and loads by more limits than two."""
        cycle = over_cycle(plain.mechanism, plain.positions.steps)
        outputs = () if loaded is None else loaded.loads.outputs
        more = any(len(MotionSignals(plain.nominal).limits(output)) != 2 for output in outputs)
        if more or plain.nominal.modes or plain.positions.key != cycle.key:
            raise RequestError(
                _(
                    "{name!r} has a group without closed form, and passes change points, is given inputs "
                    "other than its cycle, or has loads by an output with more than two limits, so no "
                    "gradient of many designs is found; for summaries use sensitivity with steps, for "
                    "metrics study",
                    code="study.objective_iterates",
                    name=plain.mechanism.name,
                )
            )

    @cached_property
    def summaries(self) -> dict[Summary, float]:
        """The summaries with their weights."""
        return {differentiable(term): weight for term, weight in self.terms.items() if isinstance(term, str)}

    @cached_property
    def quantities(self) -> dict[str, Quantity]:
        """The outputs that are summarised."""
        return self.traced.quantities(summary.output for summary in self.summaries)

    @property
    def paths(self) -> list[tuple[PathError, float]]:
        """The path errors with their weights."""
        return [(term, weight) for term, weight in self.terms.items() if isinstance(term, PathError)]

    def built(self, backend: Backend) -> OverPositions:
        """What is evaluated."""
        outputs, targets = self._outputs()
        tracked = None
        if self.iterated:
            tracked = tracked_states(self.traced.nominal, self.traced.solver, backend != "numpy")
        program = Program.of(self.traced.solver.motion.trace, {**outputs, VALID: self._valid(tracked)})
        program = program.with_inputs(self.turns, "position")
        limits = self.loaded.limits
        moving = [name for name in program.parameters if name.startswith(("limit:", "limit input:", "value:"))]
        own = [name for name in self.names if name in program.parameters]
        arrays = {**self.traced.positions.arrays, **self.turns, **targets}
        behind = limits.dimensions if limits is not None and moving else ()
        names = tuple(name for name in self.names if name in own or name in behind)
        gradient = Gradient(program, self._total(), [*own, *moving], valid=VALID, complete=True)
        judged = limits is not None and (self.iterated or not limits.machine.course.turns)
        return OverPositions(names, gradient, arrays, self.loaded, backend, tracked, judged)

    def _valid(self, tracked: TrackedStates | None) -> Mask:
        """Where a position is reached, its turns are counted, all loads have values, and the friction is certain."""
        motion = self.traced.solver.motion
        valid = self.traced.counted_for_certain if self.turns else motion.valid
        if tracked is not None:
            valid = motion.trace.logic("and", valid, tracked.on_path)
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
        for k, (term, _unused) in enumerate(self.paths):
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
        """The weighted sum, from the summaries."""
        t = Trace()
        total: Scalar = 0.0
        for summary, weight in self.summaries.items():
            total = total + weight * _summary(t, summary, self.quantities[summary.output])
        for k, (_unused, weight) in enumerate(self.paths):
            total = total + weight * t.parameter(f"path {k}.mean")
        return Program.of(t, {VALUE: total})


def counted_turns(traced: Traced) -> dict[str, Floats]:
    """Rotations of links that a dyad places in the machine as it is, (n,) by name, near which those of designs are.

    Raises:
        RequestError: a link turns too far between two positions to count its turns.
    """
    carried = traced.solver.motion.angles.carried
    if not carried:
        return {}
    known = traced.solver.states(traced.positions)
    if any(np.nanmax(np.abs(np.diff(known[name])), initial=0.0) >= CLEAR for name in carried):
        links = tuple(traced.solver.motion.angles.counted)
        raise RequestError(
            _(
                "{name!r}: {links} turns so far between two positions that its turns cannot be "
                "counted; give more steps, or more inputs",
                code="study.objective_turns",
                name=traced.mechanism.name,
                links=links,
            )
        )
    return {name: known[name] for name in carried}


def _summary(t: Trace, summary: Summary, quantity: Quantity) -> Scalar:
    """A summary in its unit from the reductions of its carrier."""
    parts = [t.parameter(f"{summary.output}.{kind}") for kind in KINDS[summary.kind]]
    shown = [replace(quantity, carrier=part).value for part in parts]
    if summary.kind == "range":
        return shown[1] - shown[0]
    return maximum(absolute(shown[0]), absolute(shown[1])) if summary.kind == "peak" else shown[0]
