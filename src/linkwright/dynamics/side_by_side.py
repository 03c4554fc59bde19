"""Runs of many designs of one mechanism in the compiled loop: one program, whose varied dimensions are inputs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.applied_loads.site import Wrench
from linkwright.core.arrays import Flags, Floats
from linkwright.dynamics.description import CLOSING_STEPS
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.loop import Action, Event, Layout, Loop, Motions, Outcome
from linkwright.dynamics.run import STEADY
from linkwright.dynamics.surfaces import Surface, surfaces_of
from linkwright.dynamics.switches import gap_name, gap_rate_name, switch_name
from linkwright.formula.program import Program
from linkwright.formula.trace import Scalar, absolute, minimum, sqrt

#: Inputs of the program: where a turn begins and how long it is; the speed that is to be reached.
BEGIN, TURN, SPEED = "run:begin", "run:turn", "run:speed"
#: Outputs: what is left of the turn, how far the speed is beyond the one to be reached.
LEFT, BEYOND = "run:left", "run:beyond"
#: Output: the smallest quality of a group less that below which a design runs by itself, through dead points.
SINGULAR, NEARLY_SINGULAR = "run:singular", 0.01
#: Before the names of loads and actuators whose numbers are found from the machine's cycle.
_OF_CYCLE = ("limit:", "value:", "middle:")
#: Steps of one design; more are needed where its forces are too stiff, or rounding is all that changes.
MOST_STEPS = 200_000


@dataclass(frozen=True)
class Starts:
    """Where designs begin: coordinates and rates (designs, free), end (designs,) s; ``turns`` of the first coordinate
    after which they end (NaN: by the time), ``steady``: where a turn is as the one before; ``speed`` of the first
    coordinate to be reached, (designs,), NaN for none."""

    coordinates: Floats
    rates: Floats
    until: Floats
    turns: Floats
    steady: bool
    speed: Floats


@dataclass(frozen=True)
class Ends:
    """Where they end: ``outcomes``, ``time``, ``coordinates`` and ``rates`` (designs, free), ``reached`` (s),
    ``peaks`` and mean ``squares`` (designs, actuators), ``kinetic`` energy and ``work`` since the start (J),
    ``residual`` as share of the larger; ``met``: whether the turns are made, or a turn is as the one before;
    ``undecided``: designs in which something sticks, or that come near to a singular position."""

    outcomes: Sequence[Outcome]
    time: Floats
    coordinates: Floats
    rates: Floats
    reached: Floats
    peaks: Floats
    squares: Floats
    residual: Floats
    met: Flags
    undecided: Flags


class SideBySide:
    """The runs of designs by their equation of motion, which has the ``varied`` dimensions, by address, as inputs."""

    def __init__(self, equation: EquationOfMotion, varied: Sequence[str] = ()) -> None:
        self.equation, self.varied = equation, tuple(varied)

    @property
    def possible(self) -> bool:
        """Whether one program has the runs of all designs: no stops, no numbers of loads that are
        found from the cycle of each design, and nothing varied but what the program reads."""
        equation = self.equation
        if equation.mechanism.stops or any(name.startswith(_OF_CYCLE) for name in equation.load_numbers):
            return False
        return all(name in equation.numbers for name in self.varied)

    @cached_property
    def actuators(self) -> dict[str, Scalar]:
        """Efforts of the actuators by their names, values of the motion's trace: the torque of those that turn a
        link, N·m, the size of the force of the others, N."""
        wrenches = self.equation.forces.forces.wrenches
        return {name: _effort(wrenches[name]) for name in self.equation.source.actuators if wrenches[name]}

    @cached_property
    def effort_program(self) -> Program:
        """Efforts of the actuators at given accelerations, as ``EquationOfMotion.row_program``."""
        return self.equation.value_program(self.actuators)

    @cached_property
    def surfaces(self) -> list[Surface]:
        """The comparisons that are held, those together that go over together."""
        return surfaces_of(self.equation)

    @cached_property
    def layout(self) -> Layout:
        """What the loop integrates."""
        numbers = range(len(self.equation.switches.lines))
        events = [Event(gap_name(k), Action.FLIP, switch_name(k)) for k in numbers]
        events += [Event(SINGULAR)] if self.equation.groups else []
        events += [Event(LEFT), Event(BEYOND, Action.NOTE)]
        inputs = [*self.varied, *self.equation.switches.names, BEGIN, TURN, SPEED]
        carried = {name: f"next:{name}" for name in self.equation.states}
        return Layout(self.equation.free, events, [f"drive:{name}" for name in self.actuators], inputs, carried)

    @cached_property
    def program(self) -> Program:
        """All outputs of the loop."""
        t, out = self.equation.traced
        first = self.equation.free[0]
        q, w = t.position(f"q:{first}"), t.position(f"qd:{first}")
        more = {LEFT: t.position(TURN) - absolute(q - t.position(BEGIN)), BEYOND: w - t.position(SPEED)}
        least: Scalar = 1.0
        for group in self.equation.groups:
            least = minimum(least, _number(out[f"closure:{group}"]))
        more[SINGULAR] = least - NEARLY_SINGULAR
        seconds = {name: _number(out[f"qdd:{name}"]) for name in self.equation.free}
        efforts = self.equation.written(t, self.actuators, seconds)
        more |= {f"drive:{name}": value for name, value in efforts.items()}
        found = {**out, **more}
        return Program.of(t, {name: found[name] for name in self.layout.outputs})

    @cached_property
    def loop(self) -> Loop:
        """The compiled loop."""
        return Loop(self.program, self.equation.numbers, self.layout, tables=self.equation.tables)

    # the runs -------------------------------------------------------------------------------------------
    def run(self, columns: Mapping[str, Floats], starts: Starts, tolerance: float, threads: int) -> Ends:
        """All designs, ``columns`` (designs,) by address."""
        motions = self._motions(columns, starts)
        self._close(motions)
        undecided = self._take_sides(motions) | self._begins_singular(motions)
        before = self._kinetic(motions)
        met = self._advance(motions, starts, tolerance, threads, ~undecided)
        outcomes = motions.outcomes
        undecided |= np.array([each is Outcome.RETURNED for each in outcomes], dtype=np.bool_)
        undecided |= self._singular(motions)
        return self._ends(motions, before, self._kinetic(motions), met, undecided)

    def _singular(self, motions: Motions) -> Flags:
        """Designs that have come near to a singular position, which runs by themselves go through."""
        if not self.equation.groups:
            return np.zeros(len(motions.records), dtype=np.bool_)
        return np.isfinite(motions.times[:, -3])

    def _begins_singular(self, motions: Motions) -> Flags:
        """Designs that begin there."""
        names, count = [f"closure:{group}" for group in self.equation.groups], len(motions.records)
        if not names:
            return np.zeros(count, dtype=np.bool_)
        least = self.equation.evaluate(names, self._given(motions), count).min(axis=0)
        return np.asarray(least <= NEARLY_SINGULAR)

    def _motions(self, columns: Mapping[str, Floats], starts: Starts) -> Motions:
        n, (count, _) = len(self.equation.free), starts.coordinates.shape
        motions = self.loop.start(count)
        motions.state[:, :n], motions.state[:, n : 2 * n] = starts.coordinates, starts.rates
        motions.until[:] = starts.until
        inputs = self._given(motions)
        begin: dict[str, Floats | float] = {**self.equation.states, **columns}
        for name, column in begin.items():
            inputs[name][:] = column
        turns = np.ones(count) if starts.steady else starts.turns
        inputs[BEGIN][:], inputs[TURN][:] = starts.coordinates[:, 0], 2.0 * np.pi * np.nan_to_num(turns)
        inputs[SPEED][:] = np.nan_to_num(starts.speed)
        motions.sides[:, -2] = np.where(np.isnan(turns), 0.0, 1.0)
        motions.sides[:, -1] = np.where(np.isnan(starts.speed), 0.0, np.sign(starts.rates[:, 0] - starts.speed))
        return motions

    def _close(self, motions: Motions) -> None:
        """Newton's steps of groups without closed form at the starts."""
        names, given = list(self.equation.states), self._given(motions)
        for _step in range(CLOSING_STEPS if names else 0):
            found = self.equation.evaluate([f"next:{name}" for name in names], given, len(motions.records))
            for name, row in zip(names, found, strict=True):
                given[name][:] = row

    def _advance(self, motions: Motions, starts: Starts, tolerance: float, threads: int, active: Flags) -> Flags:
        """To the ends; with ``steady`` turn by turn. Whether the turns are made, or two are equal."""
        n, errors = len(self.equation.free), tolerance * self._scales(motions)
        met = np.zeros(len(active), dtype=np.bool_)
        before = np.full((len(active), n), np.nan)
        begin = self.layout.inputs.index(BEGIN)
        while active.any():
            rows = np.flatnonzero(active)
            self.loop.advance(
                motions, relative=tolerance, absolute=errors, most=MOST_STEPS, threads=threads, rows=rows
            )
            stopped = np.array([each is Outcome.STOPPED for each in motions.outcomes], dtype=np.bool_) & active
            stopped &= ~self._singular(motions)
            now = motions.state[:, n : 2 * n]
            change, size = np.abs(now - before).max(axis=1), np.abs(now).max(axis=1)
            met |= stopped & ((change <= STEADY * size) | (not starts.steady))
            active = stopped & ~met
            before[active], motions.inputs[active, begin] = now[active], motions.state[active, 0]
        return met

    def _scales(self, motions: Motions) -> Floats:
        """Sizes of coordinates, rates and energy to which errors are small (2 free + 1,): of the first radian, or
        the size of the machine, under the forces at the start."""
        equation, n = self.equation, len(self.equation.free)
        ways = np.array([1.0 if equation.rotary[name] else equation.mechanism.size for name in equation.free])
        names = [*(f"qdd:{name}" for name in equation.free), *(f"M:{name}:{name}" for name in equation.free)]
        found = np.abs(equation.evaluate(names, self._given(motions), len(motions.records)))
        found = np.where(np.isfinite(found), found, 0.0)
        rates = np.maximum(np.abs(motions.state[:, n : 2 * n]).T, np.sqrt(found[:n] * ways[:, None])).max(axis=1)
        rates[rates == 0.0] = 1.0
        energy = 0.5 * float(rates**2 @ found[n:].max(axis=1))
        return np.array([*ways, *rates, energy or 1.0])

    def _given(self, motions: Motions) -> dict[str, Floats]:
        """Inputs of the equation of motion at the states, where they lie in the motions."""
        given = {**dict(zip(self.layout.all_inputs, motions.inputs.T, strict=True)), "time": motions.time}
        for place, name in enumerate(self.equation.free):
            given[f"q:{name}"] = motions.state[:, place]
            given[f"qd:{name}"] = motions.state[:, len(self.equation.free) + place]
        return given

    def _kinetic(self, motions: Motions) -> Floats:
        found: Floats = self.equation.evaluate(["kinetic"], self._given(motions), len(motions.records))[0]
        return found

    def _ends(self, motions: Motions, before: Floats, kinetic: Floats, met: Flags, undecided: Flags) -> Ends:
        n = len(self.equation.free)
        work, squares = motions.state[:, 2 * n], motions.state[:, 2 * n + 1 :]
        size = np.maximum(np.maximum(kinetic, before), np.abs(work))
        with np.errstate(invalid="ignore", divide="ignore"):
            residual = np.where(size > 0.0, np.abs(kinetic - before - work) / size, 0.0)
            means = squares / motions.time[:, None]
        return Ends(
            motions.outcomes,
            motions.time.copy(),
            motions.state[:, :n].copy(),
            motions.state[:, n : 2 * n].copy(),
            motions.times[:, -1].copy(),
            motions.peaks.copy(),
            means,
            residual,
            met,
            undecided,
        )

    # sides of the switches at the start -----------------------------------------------------------------
    def _take_sides(self, motions: Motions) -> Flags:
        """Sets the switches to where they are, or go to where they are at their roots; the designs for which there is
        no such side, as something sticks."""
        count = len(motions.records)
        undecided = np.zeros(count, dtype=np.bool_)
        given = self._given(motions)
        for _again in range(2 if len(self.surfaces) > 1 else 1):
            undecided[:] = False
            for surface in self.surfaces:
                undecided |= self._side_of(surface, given, count)
        for number, name in enumerate(self.equation.switches.names):
            motions.sides[:, number] = 2.0 * given[name] - 1.0
        return undecided

    def _side_of(self, surface: Surface, given: Mapping[str, Floats], count: int) -> Flags:
        number, sign = surface.members[0]
        rates = []
        for above in (True, False):
            self._set(surface, given, np.full(count, above))
            gap, rate = sign * self.equation.evaluate([gap_name(number), gap_rate_name(number)], given, count)
            rates.append(np.where(gap == 0.0, rate, gap))
        up, down = rates[0] > 0.0, rates[1] < 0.0
        self._set(surface, given, up | ~(down | np.isnan(rates[0])))  # no rate at rest: as if it did not move
        undecided: Flags = ~(up | down) & (rates[0] < 0.0)
        return undecided

    @staticmethod
    def _set(surface: Surface, given: Mapping[str, Floats], above: Flags) -> None:
        for number, sign in surface.members:
            given[switch_name(number)][:] = above if sign > 0.0 else ~above


def _number(value: Scalar | bool) -> Scalar:
    return float(value) if isinstance(value, bool) else value


def _effort(wrenches: Sequence[Wrench]) -> Scalar:
    first = wrenches[0]
    if isinstance(first.torque, float | int) and first.torque == 0.0:
        return sqrt(first.force.square)
    return first.torque
