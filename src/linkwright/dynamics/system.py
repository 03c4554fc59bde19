"""A machine between two events: its right-hand side with switches held, what sticks, and which stops touch."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from typing import Literal, NamedTuple, get_args

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.dynamics.change_points import Bridged
from linkwright.dynamics.complementarity import one_way, shares
from linkwright.dynamics.description import CLOSED, CLOSING_STEPS
from linkwright.dynamics.right_side import RightSide
from linkwright.dynamics.singular import Stretch
from linkwright.dynamics.site import near_name
from linkwright.dynamics.stops import contact_name
from linkwright.dynamics.surfaces import surfaces_of
from linkwright.dynamics.switches import gap_name, gap_rate_name, switch_name

#: A rate is zero below this share of the largest one seen; a jump of accelerations, below this share of their size.
ZERO, NO_JUMP = 1e-9, 1e-12
#: Rounding of shares and rates where it is decided what slips; of so many groups and stops all ways are tried.
SLACK, MOST_TRIED = 1e-9, 5

Side = RightSide | Bridged
#: Outputs of the equation about a stop: its distance, the rate of that, and the rate of the rate.
StopOutput = Literal["stop", "stop_rate", "stop_second"]
STOP_OUTPUTS: tuple[StopOutput, ...] = get_args(StopOutput)
#: Surfaces, each with its side where the first is above, that stick and slip together.
Group = tuple[tuple[int, float], ...]


@dataclass
class Holding:
    """What holds between two events: ``sides`` (surfaces,) 1 above or -1 below; sets of surfaces that ``stick``
    together, with the sides of the others where the first is above; stops that ``touch``."""

    sides: Floats
    stick: list[Group] = field(default_factory=list)
    touch: list[int] = field(default_factory=list)

    @property
    def constrained(self) -> bool:
        """Whether forces follow from what holds."""
        return bool(self.stick or self.touch)

    def copy(self) -> Holding:
        """The same, to be changed."""
        return Holding(self.sides.copy(), list(self.stick), list(self.touch))


class Slip(NamedTuple):
    """A way in which all slips that may stick: what holds then, accelerations (free,), whether it ``goes_on`` so."""

    holding: Holding
    accelerations: Floats
    goes_on: bool


class System:
    """The right-hand side of an equation of motion: y = (free coordinates, their rates, work), (2 n + 1,)."""

    def __init__(self, stretch: Stretch) -> None:
        self.stretch = stretch
        self.equation = equation = stretch.description.equation
        self.free, self.stops = equation.free, list(equation.mechanism.stops)
        self.surfaces = surfaces_of(equation)
        self.following = [k for k, each in enumerate(self.surfaces) if each.follows]
        names = [*(f"qdd:{name}" for name in self.free), "power"]
        carried = list(equation.states)
        names += [f"next:{name}" for name in carried]
        count = len(equation.switches.lines)
        more = ["kinetic", "outcome"]
        more += [gap_name(k) for k in range(count)] + [gap_rate_name(k) for k in range(count)]
        more += [f"by:{k}:{name}" for k in range(count) for name in self.free]
        more += [f"{kind}:{stop}" for kind in STOP_OUTPUTS for stop in self.stops]
        more += [f"stop_by:{stop}:{name}" for stop in self.stops for name in self.free]
        more += [f"M:{a}:{b}" for a in self.free for b in self.free]
        more += [f"closure:{group}" for group in equation.groups]
        more += [f"{kind}:{name}" for kind in ("input", "input_rate") for name in equation.replaced]
        first = [f"{kind}:{name}" for kind in ("q", "qd") for name in self.free]
        self.slim, self.full = (
            stretch.side(
                RightSide(equation.program(wanted), equation.numbers, tables=equation.tables, first=[*first, "time"])
            )
            for wanted in (names, names + more)
        )
        self.place = {name: k for k, name in enumerate(self.full.program.output_names)}
        self._qualities = self._places(f"closure:{group}" for group in equation.groups)
        self._signs = np.array([each.members[0][1] for each in self.surfaces])
        self._gaps, self._gap_rates = (
            self._places(name(each.number) for each in self.surfaces) for name in (gap_name, gap_rate_name)
        )
        self._stops = {kind: self._places(f"{kind}:{stop}" for stop in self.stops) for kind in STOP_OUTPUTS}
        self._states = {
            side: np.array([side.inputs[name] for name in carried if name in side.inputs], dtype=np.intp)
            for side in (self.slim, self.full)
        }
        self._switches = {side: self._rows(side) for side in (self.slim, self.full)}
        self.prescribed = equation.prescribed
        self.holding = Holding(np.ones(len(self.surfaces)))
        self.missed = 0
        self.pace = np.zeros(len(self.free))

    def __hash__(self) -> int:
        return id(self)

    def __reduce__(self) -> tuple[type[System], tuple[Stretch]]:
        """Made anew from its stretch: compiled code and its buffers stay with their process."""
        return System, (self.stretch,)

    def _places(self, names: Iterable[str]) -> Indices:
        """Where outputs of ``full`` are."""
        return np.array([self.place[name] for name in names], dtype=np.intp)

    @staticmethod
    def _rows(side: Side) -> dict[int, int]:
        names = {switch_name(k): k for k in range(len(side.inputs))}
        return {names[name]: row for name, row in side.inputs.items() if name in names}

    # inputs ---------------------------------------------------------------------------------------------
    def set_inputs(self, values: Mapping[str, float]) -> None:
        """Sets inputs by name, such as where Newton's steps of groups without closed form begin."""
        for side in (self.slim, self.full):
            side.set_inputs(values)

    def hold(self, holding: Holding) -> None:
        """What holds from here on."""
        self.holding = holding
        self._set_sides(holding.sides)

    def _set_sides(self, sides: Floats) -> None:
        for surface, above in zip(self.surfaces, sides.tolist(), strict=True):
            for number, sign in surface.members:
                on = 1.0 if above * sign > 0.0 else 0.0
                for side in (self.slim, self.full):
                    row = self._switches[side].get(number)
                    if row is not None:
                        side.x[row] = on

    def evaluate(self, side: Side, t: float, y: Floats) -> Floats:
        """Outputs at a time and a state, in place."""
        n, x = len(self.free), side.x
        x[: 2 * n] = y[: 2 * n]
        x[2 * n] = t
        if self.prescribed:
            self._prescribe(side, t)
        side.call()
        if len(self._states[side]):
            self._close(side)
        return side.out

    def _prescribe(self, side: Side, t: float) -> None:
        """Coordinates and rates of the inputs that have laws."""
        for name in self.prescribed:
            course = self.equation.source.drivers[name].law.coordinate(np.array([t]))
            for kind, value in zip(("q", "qd", "second"), course, strict=True):
                row = side.inputs.get(f"{kind}:{name}")
                if row is not None:
                    side.x[row] = float(value[0])

    def _close(self, side: Side) -> None:
        """Goes on with Newton's steps until the groups without closed form are closed."""
        rows, n = self._states[side], len(self.free) + 1
        found, begin = side.out[n : n + len(rows)], side.x[self._states[side]].copy()
        for _step in range(CLOSING_STEPS):
            change = np.abs(found - side.x[rows]).max()
            side.x[rows] = found
            if change <= CLOSED:
                return
            side.call()
        self.missed += 1
        side.x[rows] = begin  # a trial out of reach must not be where the next one begins
        side.out[:n] = np.nan

    # what it is described by ------------------------------------------------------------------------------
    def assembled(self, t: float, y: Floats) -> bool:
        """Whether all links can be put together in a state, also those without mass, which accelerations need not."""
        return bool(self.evaluate(self.full, t, y)[self.place["outcome"]] == 0.0)

    @property
    def margin(self) -> float:
        """Positive until something must be done about a singular position, where ``full`` was called last."""
        return self.stretch.margin(self.full.out[self._qualities], self.full)

    @property
    def carried(self) -> dict[str, float]:
        """Inputs that go on from step to step, as they are: where Newton's steps begin, and turns of drivers."""
        names = [*self.equation.states, *map(near_name, self.equation.replaced)]
        return {name: float(self.full.x[self.full.inputs[name]]) for name in names if name in self.full.inputs}

    def follow(self) -> None:
        """Notes the angles of drivers that are no coordinates, where ``full`` was called last."""
        out, place = self.full.out, self.place
        self.set_inputs({near_name(k): float(out[place[f"input:{k}"]]) for k in self.equation.replaced})

    def drivers(self, t: float, y: Floats) -> dict[str, tuple[float, float]]:
        """Coordinate and rate of each of the model's drivers."""
        n, out = len(self.free), self.evaluate(self.full, t, y)
        found = {name: (float(y[k]), float(y[n + k])) for k, name in enumerate(self.free)}
        for name in self.equation.replaced:
            found[name] = float(out[self.place[f"input:{name}"]]), float(out[self.place[f"input_rate:{name}"]])
        for name in self.prescribed:
            q, w, _second = self.equation.source.drivers[name].law.coordinate(np.array([t]))
            found[name] = float(q[0]), float(w[0])
        return {name: found[name] for name in self.equation.source.drivers}

    def coordinates(self, t: float, y: Floats) -> tuple[Floats, Floats]:
        """Coordinates and rates (drivers,) of the equation, those with laws as well."""
        n, found = len(self.free), self.drivers(t, y)
        found |= {name: (float(y[k]), float(y[n + k])) for k, name in enumerate(self.free)}
        both = np.array([found[name] for name in self.equation.names])
        return both[:, 0], both[:, 1]

    def now(self) -> Stretch:
        """The stretch with what has been carried on."""
        carried, description = self.carried, self.stretch.description
        states = {name: carried.get(name, value) for name, value in description.states.items()}
        near = {name: carried.get(near_name(name), value) for name, value in description.near.items()}
        return replace(self.stretch, description=replace(description, states=states, near=near))

    def chain(self, t: float, y: Floats) -> Floats:
        """Chain coordinates of the groups without closed form at a state, in the order of the equation's states."""
        names = list(self.equation.states)
        if not names:
            return np.empty(0)
        self.evaluate(self.full, t, y)
        begin = len(self.free) + 1
        return self.full.out[begin : begin + len(names)].copy()

    # the right-hand side --------------------------------------------------------------------------------
    def __call__(self, t: float, y: Floats) -> Floats:
        """dy/dt."""
        n = len(self.free)
        found = np.empty(2 * n + 1)
        found[:n] = y[n : 2 * n]
        if self.holding.constrained:
            found[n:] = self.constrained(t, y)[0]
        else:
            found[n:] = self.evaluate(self.slim, t, y)[: n + 1]
        return found

    def constrained(self, t: float, y: Floats) -> tuple[Floats, Floats]:
        """Accelerations and power where something sticks or touches; the shares of what does that."""
        base, first, gains, turns = self._answers(t, y, self.holding.stick, self.holding.touch)
        held: Floats = np.asarray(np.linalg.lstsq(gains, -first, rcond=None)[0], dtype=np.float64)
        return np.asarray(base + held @ turns), held

    def on(self, t: float, y: Floats, sides: Floats) -> tuple[Floats, Floats]:
        """Outputs where surfaces are on some sides, and these; phases of loads, say, go by the sense of the motion,
        and are where that brings them."""
        found = sides.copy()
        self._set_sides(found)
        out = self.outputs(t, y)
        for _round in self.following:
            gaps = self.gaps(out)
            moved = [k for k in self.following if gaps[k] * found[k] < 0.0]
            if not moved:
                break
            found[moved] *= -1.0
            self._set_sides(found)
            out = self.outputs(t, y)
        return out, found

    def below(self, groups: Sequence[Group], above: Group = ()) -> Floats:
        """The sides where groups are below, but for one that is above."""
        sides = self.holding.sides.copy()
        for group in groups:
            for index, sign in group:
                sides[index] = sign if group is above else -sign
        return sides

    def _answers(
        self, t: float, y: Floats, stick: Sequence[Group], touch: Sequence[int]
    ) -> tuple[Floats, Floats, Floats, Floats]:
        """Accelerations and power (n + 1,) with all that may stick on the side below and no force at stops; then the
        rates (k,) of what must stay zero, what unit shares change of them (k, k), and of the former (k, n + 1)."""
        n = len(self.free)
        out, sides = self.on(t, y, self.below(stick))
        base = out[: n + 1]
        changes, rows, first = [], [], []
        for group in stick:
            changes.append(self.on(t, y, self.below(stick, group))[0][: n + 1] - base)
            index, sign = group[0]
            rows.append(sign * self.gap_by(out, index))
            first.append(sign * self.gap_rates(out)[index])
        self._set_sides(sides)
        for number in touch:
            row = self.full.inputs[contact_name(self.stops[number])]
            self.full.x[row] = 1.0
            changes.append(self.evaluate(self.full, t, y)[: n + 1] - base)
            self.full.x[row] = 0.0
            rows.append(self.stop_by(out, number))
            first.append(self.at_stops("stop_second", out)[number])
        self._set_sides(self.holding.sides)
        turns = np.array(changes).reshape(-1, n + 1)
        return base, np.array(first), np.array(rows).reshape(-1, n) @ turns[:, :n].T, turns

    def outputs(self, t: float, y: Floats) -> Floats:
        """All outputs at a time and a state."""
        return self.evaluate(self.full, t, y).copy()

    def gaps(self, out: Floats) -> Floats:
        """Gaps of the surfaces (surfaces,), positive above."""
        return np.asarray(self._signs * out[self._gaps])

    def gap_rates(self, out: Floats) -> Floats:
        """Their rates (surfaces,)."""
        return np.asarray(self._signs * out[self._gap_rates])

    def gap_by(self, out: Floats, index: int) -> Floats:
        """Derivatives of the gap of a surface by the free rates, (n,)."""
        begin = self.place[f"by:{self.surfaces[index].number}:{self.free[0]}"]
        return np.asarray(self._signs[index] * out[begin : begin + len(self.free)])

    def at_stops(self, kind: StopOutput, out: Floats) -> Floats:
        """Distances from the stops, ``stop``, their rates, or the rates of these, (stops,)."""
        return out[self._stops[kind]]

    def stop_by(self, out: Floats, number: int) -> Floats:
        """Derivatives of the rate of a stop's gap by the free rates, (n,)."""
        begin = self.place[f"stop_by:{self.stops[number]}:{self.free[0]}"]
        return out[begin : begin + len(self.free)]

    def mass(self, out: Floats) -> Floats:
        """M of the free coordinates, (n, n)."""
        n, begin = len(self.free), self.place[f"M:{self.free[0]}:{self.free[0]}"]
        return out[begin : begin + n * n].reshape(n, n)

    # deciding -------------------------------------------------------------------------------------------
    def zero(self, out: Floats, y: Floats) -> list[int]:
        """Surfaces by rates that are zero because the machine's own rates are, not because it stands where they do
        not move them; ``pace`` (n,): the largest rates so far."""
        n, gaps, found = len(self.free), self.gaps(out), []
        pace = ZERO * float(np.abs([self.pace, y[n : 2 * n]]).max(initial=0.0))
        for index, surface in enumerate(self.surfaces):
            if surface.by_rate:
                size = float(np.linalg.norm(self.gap_by(out, index)))
                if size > 0.0 and abs(gaps[index]) <= pace * size:
                    found.append(index)
        return found

    def decide(self, t: float, y: Floats, touch: Iterable[int], slips: Mapping[int, int] | None = None) -> Holding:
        """What holds from a time on; stops that ``touch`` are neither left nor run into; ``slips``: surfaces that
        have just begun to slip, with the way.

        Forces that do not jump let a surface by rates that is zero go over as its rate tells; of the others it is
        found which stick.
        """
        holding = Holding(self.holding.sides.copy())
        self.hold(holding)
        groups, touching = self._together(t, y), list(touch)
        if not groups and not touching:
            return holding
        _, first, gains, _ = self._answers(t, y, groups, touching)
        most = np.array([1.0] * len(groups) + [np.inf] * len(touching))
        ways = [_way(share, end) for share, end in zip(shares(first, gains, most).tolist(), most, strict=True)]
        choices = [(-1, 0, 1)] * len(groups) + [(-1, 0)] * len(touching)
        others = product(*choices) if len(choices) <= MOST_TRIED else ()
        for k, group in enumerate(groups):
            ways[k] = next((int(way * sign) for index, sign in group if (way := (slips or {}).get(index))), ways[k])
        for each in (tuple(ways), *others):
            self._choose(t, y, self._chosen(holding, groups, touching, each))
            if self._consistent(t, y, groups, each):
                return self.holding
        self._choose(t, y, self._chosen(holding, groups, touching, tuple(ways)))
        return self.holding

    def slipping(self, t: float, y: Floats) -> list[Slip]:
        """The ways in which all slips that may stick, forth first, none where nothing may; what holds stays."""
        now, n, found = self.holding, len(self.free), []
        start = Holding(now.sides.copy())
        self.hold(start)
        groups, out = self._together(t, y), self.outputs(t, y)
        rates = np.array([sign * self.gap_by(out, index) for (index, sign), *_others in groups])
        senses = [(1, -1) if each.sum() > 0.0 else (-1, 1) for each in rates]
        for ways in product(*senses) if groups else ():
            if one_way(rates * np.array(ways)[:, None]):
                self._choose(t, y, self._chosen(start, groups, (), ways))
                goes_on = self._consistent(t, y, groups, ways)
                found.append(Slip(self.holding, self(t, y)[n : 2 * n], goes_on))
        self.hold(now)
        return found

    def _choose(self, t: float, y: Floats, holding: Holding) -> None:
        """Holds it, with what follows from its sides."""
        self.hold(Holding(self.on(t, y, holding.sides)[1], holding.stick, holding.touch))

    @staticmethod
    def _chosen(start: Holding, groups: Sequence[Group], touching: Sequence[int], ways: tuple[int, ...]) -> Holding:
        """What holds where each group slips below or above, -1 and 1, or sticks, 0, and each stop is left or held."""
        found = start.copy()
        for group, way in zip(groups, ways, strict=False):
            if way == 0:
                found.stick.append(group)
            for index, sign in group:
                found.sides[index] = sign * (way or 1)
        found.touch = [stop for stop, way in zip(touching, ways[len(groups) :], strict=True) if way == 0]
        return found

    def _consistent(self, t: float, y: Floats, groups: Sequence[Group], ways: tuple[int, ...]) -> bool:
        """Whether what slips goes on that way, and what holds needs no more than there is."""
        out, accelerations = self.outputs(t, y), None
        if self.holding.constrained:
            found, held = self.constrained(t, y)
            accelerations = found[: len(self.free)]
            sticking = held[: len(self.holding.stick)]
            if (sticking < -SLACK).any() or (sticking > 1.0 + SLACK).any() or (held[len(sticking) :] < 0.0).any():
                return False
        else:
            accelerations = out[: len(self.free)]
        size = float(np.abs(accelerations).max())
        for group, way in zip(groups, ways, strict=False):
            index, sign = group[0]
            by = self.gap_by(out, index)
            change = self.gap_rates(out)[index] + by @ (accelerations - out[: len(self.free)])
            if way and way * sign * change < -SLACK * size * float(np.linalg.norm(by)):
                return False
        return True

    def _together(self, t: float, y: Floats) -> list[Group]:
        """Surfaces that are zero, those in one group whose rates are multiples of one another, as they stick and slip
        together; those across which no force jumps are set to the side to which they go where none of a group is."""
        out = self.outputs(t, y)
        found: list[tuple[list[tuple[int, float]], Floats]] = []
        smooth: list[tuple[int, Floats]] = []
        for index in self.zero(out, y):
            by = self.gap_by(out, index)
            size = float(np.linalg.norm(by))
            jump, scale = self._jump(t, y, index)
            if size == 0.0 or jump <= NO_JUMP * scale:
                smooth.append((index, by / (size or 1.0)))
            elif not _joined(found, index, by / size):
                found.append(([(index, 1.0)], by / size))
        for index, unit in smooth:
            if not _joined(found, index, unit):
                self.holding.sides[index] = 1.0 if self.gap_rates(out)[index] >= 0.0 else -1.0
        self._set_sides(self.holding.sides)
        return [tuple(group) for group, _unit in found]

    def _jump(self, t: float, y: Floats, index: int) -> tuple[float, float]:
        """How far the accelerations jump across a surface, and how large they are."""
        n, sides = len(self.free), self.holding.sides.copy()
        values = []
        for side in (-1.0, 1.0):
            sides[index] = side
            values.append(self.on(t, y, sides)[0][:n])
        self._set_sides(self.holding.sides)
        return float(np.abs(values[1] - values[0]).max()), float(np.abs(values).max())


def _joined(groups: Sequence[tuple[list[tuple[int, float]], Floats]], index: int, unit: Floats) -> bool:
    """Puts a surface into the group whose rates are multiples of its own, (n,) of length 1; whether there is one."""
    for group, other in groups:
        along = float(unit @ other)
        if abs(abs(along) - 1.0) <= 1e-12:
            group.append((index, 1.0 if along > 0.0 else -1.0))
            return True
    return False


def _way(share: float, most: float) -> int:
    """Below, 0 of what sticks or is held, or above."""
    if share <= 0.0:
        return -1
    return 1 if share >= most else 0
