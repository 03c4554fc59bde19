"""Derivatives of load magnitudes that follow the motion: by the chain rule, never by differences.

A magnitude Q(p) depends on a dimension p through outputs y of the mechanism, dQ/dp = Σ ∂Q/∂y dy/dp, through its
own numbers, and for a ramp through the limit positions between which it runs: at a limit the rate r(φ, p) of the
output is zero, so the limit's input φ moves by dφ/dp = -(∂r/∂p)/(∂r/∂φ).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from linkwright.engine.derivative import forward
from linkwright.engine.numpy_backend import NumpyProgram
from linkwright.engine.program import Program
from linkwright.engine.states import states_as_fields
from linkwright.errors import LinkwrightError
from linkwright.kinematics.cycle import Positions, at_times
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.loads.base import Load
from linkwright.loads.formulas import output_named
from linkwright.loads.phases import Stretch, activity, outermost, stretches
from linkwright.loads.signals import Limit
from linkwright.loads.torsion_spring import TorsionSpring
from linkwright.model.expressions import Expression, array_functions
from linkwright.model.mechanism import Mechanism
from linkwright.model.signal_fields import MovingPhase, Output, SwingPhase, Table
from linkwright.study.traced import Traced
from linkwright.words.sentence import Sentence

Floats = NDArray[np.float64]


class LoadSlopes:
    """Derivatives (n,) of the inputs of a force program with respect to dimensions, at the mechanism as it is."""

    def __init__(self, traced: Traced, forces: Forces, by: tuple[str, ...]) -> None:
        self.traced = traced
        self.forces = forces
        self.by = by
        self.mechanism: Mechanism = traced.mechanism
        self.signals = MotionSignals(forces.motion)
        self.count = traced.positions.count
        self._known: dict[tuple[str, int], Mapping[str, Floats]] = {}

    def of(self, field: str) -> dict[str, Floats]:
        """Derivatives by dimension of one input; raises LinkwrightError for friction, which is an iteration."""
        kind, _, key = field.partition(":")
        if kind == "friction":
            raise LinkwrightError(Sentence("study.friction_slope"))
        if kind == "angle":
            a, b = key.split("|")
            return self._between(a, b)
        return self._load(self.mechanism.loads[key])

    # loads --------------------------------------------------------------------------------
    def _load(self, load: Load) -> dict[str, Floats]:
        if isinstance(load, TorsionSpring):
            return self._between(*load.links)
        if type(load).from_cycle is not Load.from_cycle:
            raise LinkwrightError(Sentence("study.cycle_load_slope", name=load.name, kind=load.kind))
        ramp: tuple[float, float] | None = getattr(load, "ramp", None)
        active = activity(getattr(load, "phase", None), self.signals, ramp=ramp is not None)
        slopes = self._ramp(load, ramp, active.share) if ramp is not None else self._magnitude(load)
        return {name: np.where(active.where, row, 0.0) for name, row in slopes.items()}

    def _magnitude(self, load: Load) -> dict[str, Floats]:
        magnitude = getattr(load, "magnitude", None)
        table: Table | None = getattr(load, "table", None)
        if isinstance(magnitude, Expression):
            return self._expression(magnitude)
        if table is not None:
            return self._table(load, table)
        own = f"loads.{load.name}.magnitude"
        return {name: self._own(own, name) * np.ones(self.count) for name in self.by}

    def _expression(self, expression: Expression) -> dict[str, Floats]:
        columns = {name: self._column(name) for name in expression.names}
        found = {name: np.zeros(self.count) for name in self.by}
        for name in expression.names - {"t", "input"}:
            partial = expression.diff(name).evaluate(columns, array_functions())
            if name in self.mechanism.parameters:
                slopes = {by: np.full(self.count, self._own(name, by)) for by in self.by}
            else:
                output = output_named(name, self.mechanism)
                assert output is not None
                slopes = self.output(output)
            found = {by: found[by] + partial * slopes[by] for by in self.by}
        return found

    def _column(self, name: str) -> Floats:
        if name in self.mechanism.parameters:
            return np.full(self.count, self.mechanism.parameters[name])
        if name in ("t", "input"):
            return self.signals.time if name == "t" else self.signals.input
        output = output_named(name, self.mechanism)
        assert output is not None
        return self.signals.output(output)[0]

    def _table(self, load: Load, table: Table) -> dict[str, Floats]:
        from linkwright.loads.tables import _across, _shifted

        across, dimension = _across(table, self.signals)
        x = _shifted(across, table.x[0], table.x[-1]) if dimension == "angle" else across
        knots, heights = np.array(table.x), np.array(table.y)
        part = np.clip(np.searchsorted(knots, x, side="right") - 1, 0, len(knots) - 2)
        rise = np.diff(heights)[part] / np.diff(knots)[part]
        weight = (x - knots[part]) / np.diff(knots)[part]
        found = {}
        for by in self.by:
            slope = np.zeros(self.count)
            for place in range(len(knots)):
                share = np.where(part == place, 1.0 - weight, 0.0) + np.where(part + 1 == place, weight, 0.0)
                slope += share * self._own(f"loads.{load.name}.table.y.{place}", by)
            found[by] = slope
        if isinstance(table.over, Output):
            moved = self.output(table.over)
            found = {by: found[by] + rise * moved[by] for by in self.by}
        return found

    # ramps --------------------------------------------------------------------------------
    def _ramp(self, load: Load, ramp: tuple[float, float], share: Floats | None) -> dict[str, Floats]:
        assert share is not None
        found = {}
        ends = [f"loads.{load.name}.ramp.{i}" for i in (0, 1)]
        moved = self._share_slopes(load, share)
        for by in self.by:
            slope = (ramp[1] - ramp[0]) * moved[by]
            found[by] = slope + (1.0 - share) * self._own(ends[0], by) + share * self._own(ends[1], by)
        return found

    def _share_slopes(self, load: Load, share: Floats) -> dict[str, Floats]:
        """How the share of the phase that is passed changes as the ends of the phase move."""
        phase = getattr(load, "phase", None)
        still = {by: np.zeros(self.count) for by in self.by}
        if not isinstance(phase, SwingPhase | MovingPhase):
            return still
        limits = list(self.signals.limits(phase.output))
        if isinstance(phase, SwingPhase):
            if phase.part is not None:
                raise LinkwrightError(Sentence("loads.no_slope_of_part", name=load.name))
            limits, ends = outermost(limits), (phase.start, phase.end)
        else:
            ends = ("min", "max") if phase.direction == "increasing" else ("max", "min")
        moved = self._limits(phase.output, limits)
        for stretch in stretches(limits, *ends, self.signals.whole):
            inside = self._inside(stretch)
            first, last = (self._nearest(limits, place[1]) for place in (stretch.begin, stretch.end))
            length = stretch.end[1] - stretch.begin[1]
            for by in self.by:
                slope = -((1.0 - share) * moved[by][first] + share * moved[by][last]) / length
                still[by] = np.where(inside, slope, still[by])
        return still

    def _inside(self, stretch: Stretch) -> NDArray[np.bool_]:
        from linkwright.loads.phases import _within

        return _within(stretch, self.signals)[0]

    def _nearest(self, limits: list[Limit], place: float) -> int:
        """The limit at an input, which may be a whole cycle away."""
        drift = self.signals.whole.drift or 1.0
        gaps = [abs((limit.input - place) / drift - round((limit.input - place) / drift)) for limit in limits]
        if self.signals.whole.period is None:
            gaps = [abs(limit.input - place) for limit in limits]
        return int(np.argmin(gaps))

    def _limits(self, output: Output, limits: list[Limit]) -> dict[str, Floats]:
        """How the input of every limit position changes, by the implicit function theorem."""
        positions = at_times(self.mechanism, [limit.time for limit in limits])
        pace = next(iter(positions.coordinates.values()))[1]
        rate, second = RATES[output.kind](output.owner)
        values = self._forward({"rate": rate, "second": second}, positions)
        return {by: -_slope(values, "rate", by, len(limits)) * pace / values["second"] for by in self.by}

    # outputs ------------------------------------------------------------------------------
    def output(self, output: Output) -> dict[str, Floats]:
        """Derivatives (n,) of an output at fixed input."""
        if output.kind == "angle":
            return self._between("frame", output.owner)
        name = {"x": f"p:{self._key(output)}.x", "y": f"p:{self._key(output)}.y"}.get(
            output.kind, f"s:{output.owner}"
        )
        values = self._forward({"value": name}, self.traced.positions)
        return {by: _slope(values, "value", by, self.count) for by in self.by}

    def _key(self, output: Output) -> str:
        from linkwright.kinematics.names import canonical, find_point

        return canonical(self.mechanism, *find_point(self.mechanism, output.owner))

    def _between(self, a: str, b: str) -> dict[str, Floats]:
        found = {by: np.zeros(self.count) for by in self.by}
        for link, sign in ((b, 1.0), (a, -1.0)):
            if link == "frame":
                continue
            values = self._forward({"x": f"e:{link}.x", "y": f"e:{link}.y"}, self.traced.positions)
            for by in self.by:
                dx, dy = (_slope(values, axis, by, self.count) for axis in "xy")
                found[by] = found[by] + sign * (values["x"] * dy - values["y"] * dx)
        return found

    def _forward(self, names: Mapping[str, str], positions: Positions) -> dict[str, Floats]:
        """Motion outputs and their derivatives at some positions."""
        solver = self.traced.solver
        outputs = {short: solver.outputs.value(name) for short, name in names.items()}
        program = states_as_fields(Program.of(solver.motion.trace, outputs))
        program = forward(program, [by for by in self.by if by in program.parameters])
        states = solver.states(positions) if program.fields else {}
        arrays = {**positions.arrays, **self._modes(positions)}
        rows = NumpyProgram(program).run(self.traced.numbers(program), arrays, states, length=positions.count)
        return dict(zip(program.output_names, rows, strict=True))

    def _modes(self, positions: Positions) -> dict[str, Floats]:
        """Signs of assembly modes at some positions, where they change over the cycle."""
        known = self.traced.positions
        order = np.argsort(known.time)
        before = np.searchsorted(known.time[order], positions.time * (1 + 1e-12), side="right") - 1
        place = order[np.maximum(before, 0)]
        return {name: row[place] for name, row in self.traced.arrays.items() if name.startswith("mode:")}

    def _own(self, address: str, by: str) -> float:
        """Derivative of a number of the model by another, through expressions of parameters."""
        if address == by:
            return 1.0
        expression = self.mechanism.expressions.get(address)
        if expression is None or address in self.by:
            return 0.0
        values = self.mechanism.dimensions()
        return float(
            sum(expression.diff(name).evaluate(values) * self._own(name, by) for name in expression.names)
        )


def _slope(values: Mapping[str, Floats], name: str, by: str, count: int) -> Floats:
    return values.get(f"{name}|{by}", np.zeros(count))


#: Names of an output's rate and second derivative among the motion's outputs.
RATES: Mapping[str, Callable[[str], tuple[str, str]]] = {
    "angle": lambda owner: (f"w:{owner}", f"g:{owner}"),
    "displacement": lambda owner: (f"sv:{owner}", f"sa:{owner}"),
    "x": lambda owner: (f"v:{owner}.x", f"a:{owner}.x"),
    "y": lambda owner: (f"v:{owner}.y", f"a:{owner}.y"),
}
