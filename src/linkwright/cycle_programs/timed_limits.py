"""Limit positions of outputs over the time, in all designs at once: where their rates change their signs, or where
the drivers turn round or rest, at the same time in every design."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import field

import numpy as np

from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.cycle_programs.corners import (
    Corner,
    began_name,
    changes_name,
    corner_stages,
    corners_of,
    rate_name,
    rates_of,
)
from linkwright.cycle_programs.timed_search import TimedSearch
from linkwright.cycle_programs.traced_outputs import Traced
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.program import Program
from linkwright.engine.reductions import Reduction, Results
from linkwright.engine.stage import Stage
from linkwright.engine.table import Tables
from linkwright.engine.trace import Scalar, Trace, absolute, select
from linkwright.kinematics.bends import one_formula
from linkwright.kinetostatics.load_site import (
    DRIFT,
    LAP,
    limit_input_name,
    limit_name,
    output_value,
    turns_steadily,
    value_name,
)
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.kinetostatics.traced_loads import AlongInput
from linkwright.mechanism.mechanism import Mechanism

#: Share of the cycle within which a change of sign is a limit, and of a driver's largest rate below which it rests.
SAME, AT_REST = 1e-6, 1e-9


@dataclass(frozen=True)
class TimedLimit:
    """The limits of an output: ``corners`` by their kinds, which move with the dimensions, and ``fixed`` times, s, at
    which all drivers turn round or rest; ``began``: the sign of its rate where the cycle begins."""

    output: Output
    began: float
    corners: Mapping[str, Corner] = field(default_factory=dict)
    fixed: Mapping[str, float] = field(default_factory=dict)

    @property
    def constants(self) -> dict[str, float]:
        """The times that no design moves, by name."""
        return {self._fixed(kind): time for kind, time in self.fixed.items()}

    def _fixed(self, kind: str) -> str:
        return f"fixed limit:{self.output}:{kind}"

    def stage(self, along: TimedSearch, valued: bool) -> Stage:
        """The stage that gives both limits, where ``valued`` the output there, and ``doubt:OUTPUT``, above zero where
        these are not certain to be its only limits."""
        t, motion = Trace(), along.traced.solver.motion
        sought: dict[str, Scalar | bool] = {"input": motion.trace.position("input")}
        if valued:
            sought["value"] = output_value(motion, self.output)
        program, found = Program.of(motion.trace, sought), {f"doubt:{self.output}": self._doubt(t)}
        for kind, name in (
            *((kind, corner.name) for kind, corner in self.corners.items()),
            *((kind, self._fixed(kind)) for kind in self.fixed),
        ):
            time = along.inside(t.parameter(name))
            there = along.there(program, t, time)
            steady = turns_steadily(motion.mechanism)
            found[limit_name(self.output, kind)] = there["input"] if steady else time
            found[limit_input_name(self.output, kind)] = there["input"]
            if valued:
                found[value_name(self.output, kind)] = there["value"]
        return Stage(Program.of(t, found), {name: Reduction(name, "first") for name in found}, steps=1)

    def _doubt(self, t: Trace) -> Scalar:
        """Above zero where the rate has other signs than in the machine as it is."""
        rate = rate_name(self.output)
        more = absolute(t.parameter(changes_name(rate)) - float(len(self.corners)))
        doubt = select(more < 0.5, 0.0, 1.0) + select(
            t.parameter(began_name(rate)) * self.began > 0.0, 0.0, 1.0
        )
        for kind, corner in self.corners.items():
            sign = 1.0 if kind == "max" else -1.0
            doubt = doubt + select(t.parameter(corner.before) * sign > 0.0, 0.0, 1.0)
            doubt = doubt + select(t.parameter(corner.met) > 0.5, 0.0, 1.0)
        return doubt


@dataclass(frozen=True)
class TimedLimits:
    """All limits that loads take, of those outputs that are ``valued`` with their values; in a cycle of the length
    ``lap``, s, which ``closes`` or does not; ``constants``: numbers of the cycle that programs take."""

    lap: float
    closes: bool
    limits: tuple[TimedLimit, ...] = ()
    valued: tuple[Output, ...] = ()
    constants: Mapping[str, float] = field(default_factory=dict)

    @property
    def corners(self) -> tuple[Corner, ...]:
        """Those that move with the dimensions."""
        return tuple(corner for each in self.limits for corner in each.corners.values())

    def stages(self, along: TimedSearch) -> list[Stage]:
        """The stages that find them."""
        found = _rate_stages(along, [each.output for each in self.limits], self.corners)
        return [*found, *(each.stage(along, each.output in self.valued) for each in self.limits)]


def timed_limits(traced: Traced, loads: AlongInput, count: int) -> TimedLimits | None:
    """The limits that loads take, sought between ``count`` places; None where they are not found over the time: an
    output has not just one of each kind, or rests while the drivers do not."""
    positions, signals = traced.positions, MotionSignals(traced.nominal)
    length, whole = float(np.ptp(positions.around)), signals.whole
    if not loads.outputs:
        return TimedLimits(length, positions.closed)
    closes = whole.period is not None
    if not positions.cycle or (closes and not positions.closed and not one_formula(traced.mechanism)):
        return None
    lap = length if whole.period is None else whole.period
    along = TimedSearch(traced, float(positions.around.min()), lap, closes, count)
    if not along.possible or not (closes or _in_order(traced.mechanism, loads, signals)):
        return None
    numbers = {LAP: _way(traced, lap) * (1.0 if closes else 2.0), DRIFT: whole.drift}
    known = {**traced.solver.nominal.parameters, **loads.constants, **numbers}
    limits = _found(along, loads.outputs, signals, known, loads.tables)
    if limits is None:
        return None
    numbers |= {name: time for each in limits for name, time in each.constants.items()}
    return TimedLimits(lap, closes, limits, loads.valued, numbers)


def _way(traced: Traced, lap: float) -> float:
    """How far in a time, s, goes what limits are given over: the input, rad, of a driver that turns at constant
    speed, else the time."""
    if not turns_steadily(traced.mechanism):
        return lap
    return abs(float(next(iter(traced.positions.coordinates.values()))[1][0])) * lap


def _in_order(mechanism: Mechanism, loads: AlongInput, signals: MotionSignals) -> bool:
    """Whether the limits between which loads act follow each other in a cycle that does not close."""
    for name in loads.names:
        phase = mechanism.loads[name].magnitude.limits
        if phase is not None:
            times = {each.kind: each.time for each in signals.limits(phase.output)}
            if len(times) < 2 or times[phase.end] < times[phase.start]:
                return False
    return True


def _rate_stages(along: TimedSearch, outputs: Iterable[Output], corners: Iterable[Corner]) -> list[Stage]:
    """The stages that find where the rates of outputs change their signs."""
    rates = rates_of(along.traced, outputs)
    return corner_stages(along, rates, corners, counted=rates)


def _found(
    along: TimedSearch,
    outputs: Iterable[Output],
    signals: MotionSignals,
    known: Mapping[str, float],
    tables: Tables,
) -> tuple[TimedLimit, ...] | None:
    asked = tuple(outputs)
    corners = corners_of(along, rates_of(along.traced, asked), (), known, along.positions, tables)
    cycle = CycleProgram(tuple(_rate_stages(along, asked, corners)))
    table = np.array([[known[name] for name in cycle.dimensions]])
    results = cycle.evaluate(table, along.positions, tables=tables, threads=1)
    found = [_limit(along, signals, each, corners, results) for each in asked]
    return None if None in found else tuple(each for each in found if each is not None)


def _limit(
    along: TimedSearch,
    signals: MotionSignals,
    output: Output,
    corners: Iterable[Corner],
    results: Results,
) -> TimedLimit | None:
    known: dict[str, float] = {each.kind: each.time for each in signals.limits(output)}
    own = [corner for corner in corners if corner.of == rate_name(output)]
    moving: dict[str, Corner] = {}
    for corner in own:
        kind = "max" if results[corner.before][0] > 0.0 else "min"
        if (
            results[corner.met][0] == 1.0
            and kind in known
            and _same(along, results[corner.name][0], known[kind])
        ):
            moving[kind] = corner
    fixed: dict[str, float] = {kind: time for kind, time in known.items() if kind not in moving}
    if len(signals.limits(output)) != 2 or len(known) != 2 or len(moving) != len(own):
        return None
    if not all(_drivers_rest(along, time) for time in fixed.values()):
        return None
    return TimedLimit(output, float(np.sign(results[began_name(rate_name(output))][0])), moving, fixed)


def _same(along: TimedSearch, time: float, other: float) -> bool:
    """Whether two times are one, in the cycle."""
    apart = abs(time - other) % along.lap
    return min(apart, along.lap - apart) <= SAME * along.lap


def _drivers_rest(along: TimedSearch, time: float) -> bool:
    """Whether all drivers turn round or rest at a time, s."""
    paces = along.traced.positions.paces
    rates = {
        name: abs(float(driver.law.coordinate(np.array([time]))[1][0]))
        for name, driver in along.traced.mechanism.drivers.items()
    }
    return all(rate <= AT_REST * paces[name] for name, rate in rates.items())
