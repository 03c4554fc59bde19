"""Loads that act while an output swings from one limit position to the other, for many designs at once.

The sign changes of the output's exact rate bracket its two limit positions in every design; Newton's steps with the
exact acceleration, kept inside their brackets, refine all of them together.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from linkwright.core.search import zeros
from linkwright.drivers.constant_speed import ConstantSpeed
from linkwright.engine.numpy_backend import NumpyProgram
from linkwright.engine.program import Program
from linkwright.engine.trace import select
from linkwright.kinetostatics.signals import STILL
from linkwright.loads.base import Load
from linkwright.loads.phases import NEAR
from linkwright.model.signal_fields import SwingPhase
from linkwright.study.load_slopes import RATES
from linkwright.study.traced import Traced

Floats = NDArray[np.float64]
Numbers = NDArray[np.intp]

TURN = 2 * np.pi


def swings(traced: Traced, names: tuple[str, ...], columns: Mapping[str, Floats]) -> bool:
    """Whether all inputs are magnitudes of such loads, over a closed turn of one driver of constant speed."""
    mechanism = traced.mechanism
    drivers = list(mechanism.drivers.values())
    if len(drivers) != 1 or not isinstance(drivers[0].law, ConstantSpeed) or traced.solver.motion.next_states:
        return False
    turning = traced.positions.closed and traced.positions.rotary[drivers[0].name]
    span = abs(drivers[0].law.speed) * (traced.positions.period or 0.0)
    if not turning or abs(span - TURN) > 1e-9 or f"{drivers[0].name}.speed" in columns:
        return False
    loads = [mechanism.loads[name.removeprefix("load:")] for name in names if name.startswith("load:")]
    return len(loads) == len(names) and all(_simple(traced, load) for load in loads)


def _simple(traced: Traced, load: Load) -> bool:
    phase = getattr(load, "phase", None)
    if (
        not isinstance(phase, SwingPhase)
        or phase.part is not None
        or type(load).from_cycle is not Load.from_cycle
    ):
        return False
    own = [a for a in traced.mechanism.expressions if a.startswith(f"loads.{load.name}.")]
    ramp, magnitude = getattr(load, "ramp", None), getattr(load, "magnitude", None)
    return not own and (ramp is not None or isinstance(magnitude, float))


class SwingLoads:
    """Magnitudes (designs, n) of such loads; ``unsure``: designs that must be looked at one by one."""

    def __init__(self, traced: Traced) -> None:
        self.traced = traced
        (driver,) = traced.mechanism.drivers.values()
        assert isinstance(driver.law, ConstantSpeed)
        self.name, self.sign = driver.name, float(np.sign(driver.law.speed))
        self.input = traced.positions.coordinates[driver.name][0]
        self._programs: dict[str, tuple[NumpyProgram, NumpyProgram]] = {}

    def rows(
        self, names: tuple[str, ...], columns: Mapping[str, Floats]
    ) -> tuple[dict[str, Floats], Numbers]:
        """Magnitudes by name, and the numbers of the designs for which they are not certain."""
        designs = len(next(iter(columns.values())))
        unsure = np.zeros(designs, dtype=bool)
        rows = {}
        for name in names:
            load = self.traced.mechanism.loads[name.removeprefix("load:")]
            rows[name], doubtful = self._magnitude(load, columns)
            unsure |= doubtful
        return rows, np.flatnonzero(unsure)

    def _magnitude(self, load: Load, columns: Mapping[str, Floats]) -> tuple[Floats, NDArray[np.bool_]]:
        phase: SwingPhase = load.phase  # type: ignore[attr-defined]
        limits, doubtful = self._limits(phase, columns)
        begin, end = limits[phase.start], limits[phase.end]
        length = (self.sign * (end - begin)) % TURN
        gone = (self.sign * (self.input - begin[:, None])) % TURN
        gone = np.where(gone > TURN * (1 - NEAR), gone - TURN, gone)
        with np.errstate(invalid="ignore", divide="ignore"):
            inside = gone <= length[:, None] + NEAR * TURN
            share = np.clip(gone / length[:, None], 0.0, 1.0)
        ramp: tuple[float, float] | None = getattr(load, "ramp", None)
        if ramp is None:
            size = self._given(load, "magnitude", load.magnitude, columns)  # type: ignore[attr-defined]
            return np.where(inside, size, 0.0), doubtful
        first, last = (self._given(load, f"ramp.{i}", ramp[i], columns) for i in (0, 1))
        return np.where(inside, first + (last - first) * share, 0.0), doubtful

    def _given(self, load: Load, field: str, nominal: float, columns: Mapping[str, Floats]) -> Floats:
        column = columns.get(f"loads.{load.name}.{field}")
        return np.array([[nominal]]) if column is None else np.asarray(column)[:, None]

    def _limits(
        self, phase: SwingPhase, columns: Mapping[str, Floats]
    ) -> tuple[dict[str, Floats], NDArray[np.bool_]]:
        """Input of the only maximum and of the only minimum of every design, and where there are not just these."""
        coarse, fine = self._evaluators(phase)
        table = self.traced.table(coarse.program, columns)
        rate, valid = coarse.run_designs(table, self.traced.positions.arrays).transpose(1, 0, 2)
        following = np.roll(rate, -1, axis=1)
        size = np.abs(rate).max(axis=1, keepdims=True)
        with np.errstate(invalid="ignore"):
            found = {"max": (rate > 0) & (following < 0), "min": (rate < 0) & (following > 0)}
            still = (np.abs(rate) <= STILL * size).any(axis=1)
        good = (
            (found["max"].sum(axis=1) == 1)
            & (found["min"].sum(axis=1) == 1)
            & ~still
            & (valid > 0).all(axis=1)
        )
        limits = {}
        for kind, places in found.items():
            low = self.input[places.argmax(axis=1)]
            limits[kind] = self._refined(fine, self.traced.table(fine.program, columns), low, kind)
        return limits, ~good

    def _refined(self, fine: NumpyProgram, table: Floats, low: Floats, kind: str) -> Floats:
        """The input (designs,) at which the rate changes its sign, from the position before it."""
        step = TURN / len(self.input) * self.sign

        def rate_and_slope(place: Floats) -> tuple[Floats, Floats]:
            arrays = {f"cos:{self.name}": np.cos(place)[:, None], f"sin:{self.name}": np.sin(place)[:, None]}
            rate, second = fine.run_designs(table, {}, arrays, length=1)[:, :, 0].T
            return rate, second / self._speed()

        return zeros(rate_and_slope, low, low + step, np.full(len(low), 1.0 if kind == "max" else -1.0))

    def _speed(self) -> float:
        (driver,) = self.traced.mechanism.drivers.values()
        assert isinstance(driver.law, ConstantSpeed)
        return driver.law.speed

    def _evaluators(self, phase: SwingPhase) -> tuple[NumpyProgram, NumpyProgram]:
        """Programs of the rate over the positions, and of rate and acceleration at inputs of each design's own."""
        key = str(phase.output)
        if key not in self._programs:
            solver = self.traced.solver
            names = RATES[phase.output.kind](phase.output.owner)
            rate, second = (solver.outputs.value(name) for name in names)
            valid = select(solver.motion.valid, 1.0, 0.0)
            coarse = Program.of(solver.motion.trace, {"rate": rate, "valid": valid})
            own = Program.of(solver.motion.trace, {"rate": rate, "second": second})
            nodes = tuple(node._replace(op="field") if node.op == "position" else node for node in own.nodes)
            self._programs[key] = NumpyProgram(coarse), NumpyProgram(Program(nodes, own.outputs))
        return self._programs[key]
