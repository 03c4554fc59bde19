"""A run at some times: coordinates, rates, accelerations, and any row of the motion and its forces."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.inputs import Input
from linkwright.core.outputs import Output, row_name
from linkwright.dynamics.change_points import read_across
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.integration import Piece
from linkwright.dynamics.site import near_name
from linkwright.dynamics.stops import contact_name
from linkwright.dynamics.switches import switch_name
from linkwright.dynamics.system import Group
from linkwright.errors import RequestError
from linkwright.formula.trace import Scalar
from linkwright.kinematics.positions import Positions
from linkwright.kinetostatics.solver import ForceSolver


@dataclass
class Samples:
    """States of a machine at n times, those of each piece a part; ``cycle``: they follow each other as one motion."""

    equation: EquationOfMotion
    parts: Sequence[Part]
    cycle: bool = True
    states: Mapping[str, Floats] = field(default_factory=dict)
    modes: Mapping[str, Floats] = field(default_factory=dict)

    @classmethod
    def of(cls, equation: EquationOfMotion, pieces: Sequence[Piece], time: Floats) -> Samples:
        """A run at ``time`` (n,) s within its ``pieces``, which are one after the other."""
        ends = np.array([piece.end for piece in pieces])
        which = np.minimum(np.searchsorted(ends, time, side="right"), len(ends) - 1)
        parts = [Part(equation, piece, time[which == k]) for k, piece in enumerate(pieces) if (which == k).any()]
        return cls(equation, parts)

    @classmethod
    def apart(cls, found: Sequence[Samples]) -> Samples:
        """Samples of one equation, one after the other, each for itself."""
        states = {name: np.concatenate([each.states[name] for each in found]) for name in found[0].states}
        return cls(found[0].equation, [part for each in found for part in each.parts], cycle=False, states=states)

    @cached_property
    def time(self) -> Floats:
        """(n,) s."""
        return np.concatenate([part.time for part in self.parts])

    @cached_property
    def course(self) -> dict[str, tuple[Floats, Floats, Floats]]:
        """Coordinate, rate and second derivative of every driver, (n,) each."""
        found = {}
        for name in self.equation.source.drivers:
            rows = [np.concatenate([part.course[name][order] for part in self.parts]) for order in range(3)]
            found[name] = (rows[0], rows[1], rows[2])
        return found

    @property
    def positions(self) -> Positions:
        """The same as positions of a motion."""
        return Positions(self.time, self.course, self.equation.rotary, cycle=self.cycle)

    @property
    def work(self) -> Floats:
        """Work of all forces since the beginning, (n,) J."""
        return np.concatenate([part.states[-1] for part in self.parts])

    def rows(self, names: Sequence[str], *, forces: bool) -> Floats:
        """Rows of the motion, or of it and its forces, by name (see ``core.outputs``), (names, n)."""
        return np.concatenate([part.rows(names, forces=forces) for part in self.parts], axis=1)

    def values(self, outputs: Callable[[ForceSolver], dict[str, Scalar]]) -> Floats:
        """Values of the trace of motion and forces by any names, (outputs, n), that it names of a solver."""
        return np.concatenate([part.values(outputs) for part in self.parts], axis=1)

    def outputs(self, names: Sequence[str]) -> Floats:
        """Outputs of the equation of motion by name, (names, n)."""
        return np.concatenate([part.outputs(names) for part in self.parts], axis=1)


#: How rows of drivers' efforts and of angles with turns begin.
EFFORT, TURNED = row_name("effort") + ":", row_name("turned_angle") + ":"
#: Coordinate, rate and second derivative by name, (n,) each.
Course = Mapping[str, tuple[Floats, Floats, Floats]]
#: Outputs (names, n) at inputs (n,) by name.
Evaluate = Callable[[Mapping[str, Floats]], Floats]


class Part:
    """Times of one piece; ``first``: the equation by the model's own drivers."""

    def __init__(self, first: EquationOfMotion, piece: Piece, time: Floats) -> None:
        self.first, self.piece, self.time = first, piece, time
        self.system, self.equation = piece.system, piece.system.equation
        self.states = piece.at(time)

    def going(self, course: Course) -> Part:
        """The same positions with other rates and accelerations, what holds as it is."""
        other = Part(self.first, self.piece, self.time)
        other._course, other.shares = dict(course), self.shares
        return other

    @cached_property
    def _found(self) -> tuple[Floats, Floats, Floats]:
        """Accelerations (free, n), shares (held, n) of what holds, chain coordinates (states, n)."""
        system, n = self.system, len(self.equation.free)
        system.hold(self.piece.holding)
        seconds, held, chains = [], [], []
        for k, t, y in zip(self.piece.steps(self.time), self.time.tolist(), self.states.T, strict=True):
            system.set_inputs(self._carried[k])
            if system.holding.constrained:
                found, share = system.constrained(t, y)
            else:
                found, share = system.evaluate(system.slim, t, y)[: n + 1].copy(), np.empty(0)
            seconds.append(found[:n])
            held.append(share)
            chains.append(system.chain(t, y))
        return np.array(seconds).T, np.array(held).T, np.array(chains).T

    @property
    def _carried(self) -> list[dict[str, float]]:
        """What is carried on from step to step, where each begins."""
        return [self.piece.begun, *self.piece.carried]

    @cached_property
    def course(self) -> dict[str, tuple[Floats, Floats, Floats]]:
        """Coordinate, rate and second derivative of each of the model's drivers, (n,) each."""
        found = dict(self._course)
        for name in self.equation.replaced:
            driver = self.equation.source.drivers[name]
            q, w = self.outputs([f"input:{name}", f"input_rate:{name}"])
            kind = "angular_acceleration" if driver.law.rotary else "slide_acceleration"
            ends = (driver.link, driver.relative_to) if driver.law.rotary else (driver.joint,)
            rows = [row_name(kind, end) for end in ends if end != "frame"]
            signs = [-1.0 if end == driver.relative_to else 1.0 for end in ends if end != "frame"]
            found[name] = q, w, np.array(signs) @ self.rows(rows, forces=False)
        return found

    @cached_property
    def _course(self) -> dict[str, tuple[Floats, Floats, Floats]]:
        """The same of the coordinates of its equation."""
        equation, n = self.equation, len(self.equation.free)
        seconds = self._found[0]
        found = {name: (self.states[k], self.states[n + k], seconds[k]) for k, name in enumerate(equation.free)}
        for name in equation.names:
            if name not in found:
                found[name] = equation.source.drivers[name].law.coordinate(self.time)
        return found

    @cached_property
    def given(self) -> dict[str, Floats]:
        """Inputs of programs, what sticks on the side below."""
        equation, holding = self.equation, self.piece.holding
        found = {"time": self.time}
        for name, (q, w, second) in self._course.items():
            found |= {f"q:{name}": q, f"qd:{name}": w, Input("second", name).name: second}
        found |= self._switches(self._sides())
        _, held, chains = self._found
        for row, number in enumerate(holding.touch):
            found[contact_name(self.system.stops[number])] = held[len(holding.stick) + row]
        held_inputs = self.system.stretch.description.held
        found |= {name: np.full(len(self.time), each) for name, each in held_inputs.items()}
        found |= dict(zip(equation.states, chains, strict=False))
        for name in map(near_name, equation.replaced):
            found[name] = np.array([self._carried[k].get(name, 0.0) for k in self.piece.steps(self.time)])
        return found

    def _sides(self, above: Group = ()) -> Floats:
        """The sides of surfaces where what sticks is below, but for one group."""
        system, stick = self.system, self.piece.holding.stick
        system.hold(self.piece.holding)
        sides = system.below(stick, above)
        return system.on(float(self.time[0]), self.states[:, 0], sides)[1] if stick else sides

    def _switches(self, sides: Floats) -> dict[str, Floats]:
        found = {}
        for surface, above in zip(self.system.surfaces, sides.tolist(), strict=True):
            for number, sign in surface.members:
                found[switch_name(number)] = np.full(len(self.time), 1.0 if above * sign > 0.0 else 0.0)
        return found

    def rows(self, names: Sequence[str], *, forces: bool) -> Floats:
        """As :meth:`Samples.rows`: forces where something sticks lie between those of slipping either way."""
        known = [k for k, name in enumerate(names) if not self.equation.replaced or self._known(name, forces)]
        program = self.equation.row_program([names[k] for k in known], forces=forces)
        found = np.array([self._missing(name) for name in names]).reshape(len(names), -1)
        found[known] = self._between(lambda given: self.equation.run(program, given, len(given["time"])))
        return found

    def _known(self, name: str, forces: bool) -> bool:
        """Whether its coordinates have a row: efforts of drivers, and what groups tell, are those of a structure."""
        if name.startswith(TURNED):
            return self.equation.solver.motion.angles.follows(Output.of_row(name).owner)
        value = self.equation.forces.programs.value if forces else self.equation.solver.outputs.value
        try:
            value(name)
        except (KeyError, RequestError):
            return False
        return True

    def _missing(self, name: str) -> Floats:
        """A row that its coordinates do not have, (n,): a free driver supplies nothing, angles are by the model's
        drivers, and of groups nothing is told."""
        if name.startswith(EFFORT):
            return np.zeros(len(self.time))
        if not name.startswith(TURNED):
            return np.full(len(self.time), np.nan)
        given = {f"q:{name}": q for name, (q, _rate, _second) in self.course.items()}
        return np.asarray(self.first.run(self.first.row_program([name], forces=False), given, len(self.time))[0])

    def values(self, outputs: Callable[[ForceSolver], dict[str, Scalar]]) -> Floats:
        """As :meth:`Samples.values`."""
        program = self.equation.value_program(outputs(self.equation.forces))
        return self._between(lambda given: self.equation.run(program, given, len(given["time"])))

    def outputs(self, names: Sequence[str]) -> Floats:
        """As :meth:`Samples.outputs`."""
        return self._between(lambda given: self.equation.evaluate(names, given, len(given["time"])))

    def _across(self, evaluate: Evaluate, given: Mapping[str, Floats]) -> Floats:
        """Outputs at all times; near a change point read from both sides of it."""
        point = self.system.stretch.point
        return evaluate(given) if point is None else read_across(point, evaluate, given)

    def _between(self, evaluate: Evaluate) -> Floats:
        base, turns = self._turns(evaluate)
        return np.asarray(base + np.einsum("kn,krn->rn", self.shares, turns)) if len(turns) else base

    def _turns(self, evaluate: Evaluate) -> tuple[Floats, Floats]:
        """Outputs where all that sticks is on the side below, and how they change where a group is above (groups,
        outputs, n)."""
        base = self._across(evaluate, self.given)
        above = [self.given | self._switches(self._sides(group)) for group in self.piece.holding.stick]
        return base, np.array([self._across(evaluate, given) - base for given in above])

    @cached_property
    def shares(self) -> Floats:
        """Share of the side above in what holds of each group that sticks, (groups, n).

        Where joints rub, forces are not linear in accelerations, so that shares by which these are zero leave
        efforts: the free inputs have none, where any shares do so.
        """
        of_accelerations = self._found[1][: len(self.piece.holding.stick)]
        if not len(of_accelerations) or not self.equation.rubs:
            return of_accelerations
        program = self.equation.row_program([row_name("effort", name) for name in self.equation.free], forces=True)
        base, turns = self._turns(lambda given: self.equation.run(program, given, len(given["time"])))
        steps = range(len(self.time))
        found = np.array([np.linalg.lstsq(turns[:, :, k].T, -base[:, k], rcond=None)[0] for k in steps]).T
        between = ((found >= 0.0) & (found <= 1.0)).all(axis=0)
        return np.where(between, found, of_accelerations)
