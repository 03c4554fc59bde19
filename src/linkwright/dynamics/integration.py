"""From event to event: error-controlled steps of SciPy, events located on their dense output."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Literal

import numpy as np
from scipy.integrate import DOP853, Radau
from scipy.optimize import brentq

from linkwright.core.arrays import Flags, Floats
from linkwright.dynamics.system import Holding, System
from linkwright.errors import LinkwrightError
from linkwright.words import _

Method = Literal["explicit", "implicit"]
SOLVERS: dict[Method, Any] = {"explicit": DOP853, "implicit": Radau}
#: Shares of a step at which events are looked for.
PLACES = (0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0)
#: Below this share of the largest value seen a watched value is zero.
NEAR = 1e-11
#: Events at one time, and steps of a run, at most.
AT_ONCE, STEPS = 60, 400_000


@dataclass
class Watched:
    """Values that are positive as long as nothing happens: ``kind`` of what happens where ``number`` is zero."""

    kind: Literal["surface", "stop", "slip", "leave", "end", "singular"]
    number: int
    sense: float = 1.0


@dataclass
class Piece:
    """The motion between two events; ``ends`` (steps,) s of its steps; inputs that are ``carried`` on as they were at
    these, and when it ``begun``."""

    system: System
    holding: Holding
    begin: float
    dense: list[Any] = field(default_factory=list)
    ends: list[float] = field(default_factory=list)
    begun: dict[str, float] = field(default_factory=dict)
    carried: list[dict[str, float]] = field(default_factory=list)

    @classmethod
    def resting(cls, system: System, t: float, y: Floats) -> Piece:
        """The moment at which a machine has come to rest."""
        state, carried = partial(_kept, y.copy()), system.carried
        return cls(system, system.holding.copy(), t, [state], [t], carried, [carried])

    @property
    def end(self) -> float:
        """Where it ends, s."""
        return self.ends[-1] if self.ends else self.begin

    def steps(self, times: Floats) -> list[int]:
        """The numbers of the steps in which times are."""
        return [min(int(step), len(self.ends) - 1) for step in np.searchsorted(self.ends, times)]

    def at(self, times: Floats) -> Floats:
        """States (2 n + 1, times)."""
        found = [self.dense[k](time) for k, time in zip(self.steps(times), times.tolist(), strict=True)]
        return np.column_stack(found) if found else np.empty((2 * len(self.system.free) + 1, 0))


def _kept(state: Floats, _time: float) -> Floats:
    return state


class StepTooSmall(Exception):
    """Steps that cannot go on."""


class Stepper:
    """Steps through one piece at a time; ``ends``: values, positive until the run ends, of a time and a state."""

    def __init__(
        self, tolerance: float, absolute: Floats, method: Method, ends: Callable[[float, Floats], Floats]
    ) -> None:
        self.tolerance, self.absolute, self.method, self.ends = tolerance, absolute, method, ends
        self.seen: dict[tuple[str, int], float] = {}
        self.steps = 0

    def piece(
        self, system: System, t: float, y: Floats, last: float
    ) -> Iterator[tuple[Piece, float, Floats, list[Watched]]]:
        """The piece so far after each step, with its end, the state there and what happens there, nothing before the
        last: raises StepTooSmall where steps become too small."""
        watched = self._watched(system)
        found = Piece(system, system.holding.copy(), t, begun=system.carried)
        before = self._values(system, watched, t, y)
        armed = before > self._near(watched, before)
        solver = SOLVERS[self.method](system, t, y, last, rtol=self.tolerance, atol=self.absolute)
        while solver.status == "running":
            self.steps += 1
            solver.step()
            if solver.status == "failed":
                raise StepTooSmall
            if self.steps > STEPS:
                raise LinkwrightError(
                    _(
                        "the run needs steps of {step:.1e} s, {count} of them in {time:.3g} s: a spring or a motor "
                        "is so stiff; take method implicit, a larger tolerance, or a shorter time",
                        code="dynamics.stiff",
                        step=solver.step_size or 0.0,
                        count=self.steps,
                        time=solver.t - t,
                    )
                )
            dense = solver.dense_output()
            hit, armed = self._look(system, watched, dense, solver.t_old, solver.t, armed)
            end = solver.t if hit is None else hit[0]
            if not system.assembled(end, dense(end)):
                raise StepTooSmall
            found.dense.append(dense)
            found.ends.append(end)
            if hit is not None:
                time, happens = hit
                yield found, time, np.asarray(dense(time)), happens
                return
            yield found, solver.t, solver.y.copy(), []

    # what is watched ------------------------------------------------------------------------------------
    def _watched(self, system: System) -> list[Watched]:
        holding = system.holding
        stuck = {index for group in holding.stick for index, _sign in group}
        found = [
            Watched("surface", index, float(holding.sides[index]))
            for index in range(len(system.surfaces))
            if index not in stuck
        ]
        found += [Watched("stop", k) for k in range(len(system.stops)) if k not in holding.touch]
        found += [Watched("slip", k, sense) for k in range(len(holding.stick)) for sense in (1.0, -1.0)]
        found += [Watched("leave", k) for k in range(len(holding.touch))]
        return [*found, Watched("singular", 0)] if system.equation.groups else found

    def _values(self, system: System, watched: list[Watched], t: float, y: Floats) -> Floats:
        """Values of what is watched, and those of the ends behind them."""
        held = system.constrained(t, y)[1] if system.holding.constrained else np.empty(0)
        out = system.evaluate(system.full, t, y)
        gaps, stops, sticking = system.gaps(out), system.at_stops("stop", out), len(system.holding.stick)
        found = []
        for each in watched:
            if each.kind == "surface":
                found.append(each.sense * gaps[each.number])
            elif each.kind == "stop":
                found.append(stops[each.number])
            elif each.kind == "slip":
                share = held[each.number]
                found.append(share if each.sense > 0.0 else 1.0 - share)
            elif each.kind == "singular":
                found.append(system.margin)
            else:
                found.append(held[sticking + each.number])
        return np.append(found, self.ends(t, y))

    def _near(self, watched: list[Watched], values: Floats) -> Floats:
        """Sizes below which the values are zero, of those seen so far."""
        keys = [(each.kind, each.number) for each in watched]
        keys += [("end", k) for k in range(len(values) - len(watched))]
        for key, value in zip(keys, np.abs(values).tolist(), strict=True):
            self.seen[key] = max(self.seen.get(key, 0.0), value)
        return NEAR * np.array([self.seen[key] for key in keys])

    def _look(
        self, system: System, watched: list[Watched], dense: Any, start: float, end: float, armed: Flags
    ) -> tuple[tuple[float, list[Watched]] | None, Flags]:
        """The first event within a step, and which values are armed: those that have been positive since they were
        zero."""
        low = start
        for share in PLACES:
            high = start + share * (end - start) if share < 1.0 else end
            values = self._values(system, watched, high, dense(high))
            near = self._near(watched, values)
            crossed = np.flatnonzero((values < 0.0) & (armed | (values < -1e3 * near)))
            if len(crossed):
                return self._first(system, watched, dense, low, high, crossed.tolist()), armed
            armed = armed | (values > near)
            low = high
        return None, armed

    def _first(
        self, system: System, watched: list[Watched], dense: Any, low: float, high: float, crossed: list[int]
    ) -> tuple[float, list[Watched]]:
        """The earliest of the crossings between two times, and those at the same time."""

        times = {}
        for number in crossed:

            def of(t: float, number: int = number) -> float:
                return float(self._values(system, watched, t, dense(t))[number])

            begin, end = low, high
            if of(low) <= 0.0:
                begin, end = _positive(of, low, high)
            times[number] = _past(of, begin, end) if begin < end else begin
        time = min(times.values())
        close = 4e-15 * max(abs(time), high - low) + 1e-15
        every = [*watched, *(Watched("end", k) for k in range(len(self.ends(time, dense(time)))))]
        return time, [every[number] for number, each in times.items() if each <= time + close]


def _positive(value: Callable[[float], float], low: float, high: float) -> tuple[float, float]:
    """Times between which a value that is zero at the first one, and below zero at the last, goes through zero from
    above: a flight shorter than a step; twice the first one where it is never above."""
    end = high
    for halving in range(1, 60):
        time = low + (high - low) * 0.5**halving
        if value(time) > 0.0:
            return time, end
        end = time
    return low, low


def _past(value: Callable[[float], float], low: float, high: float) -> float:
    """The first time, to rounding, at which a value is no longer positive; it may jump there."""
    time = float(brentq(value, low, high, xtol=1e-15, rtol=8.9e-16))
    step = float(np.spacing(time))
    while time < high and value(time) > 0.0:
        time, step = min(time + step, high), 2.0 * step
    return time
