"""A run at some times: coordinates, rates, accelerations, and any row of the motion and its forces."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.inputs import Input
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.integration import Piece
from linkwright.dynamics.stops import contact_name
from linkwright.dynamics.switches import switch_name
from linkwright.formula.trace import Scalar


@dataclass
class Samples:
    """A run at ``time`` (n,) s within its ``pieces``, which are one after the other."""

    equation: EquationOfMotion
    pieces: Sequence[Piece]
    time: Floats

    @cached_property
    def parts(self) -> list[Part]:
        """The times of each piece."""
        ends = np.array([piece.end for piece in self.pieces])
        which = np.minimum(np.searchsorted(ends, self.time, side="right"), len(ends) - 1)
        return [Part(piece, self.time[which == k]) for k, piece in enumerate(self.pieces) if (which == k).any()]

    @cached_property
    def course(self) -> dict[str, tuple[Floats, Floats, Floats]]:
        """Coordinate, rate and second derivative of every driver, (n,) each."""
        found = {}
        for name in self.equation.names:
            rows = [np.concatenate([part.course[name][order] for part in self.parts]) for order in range(3)]
            found[name] = (rows[0], rows[1], rows[2])
        return found

    @property
    def work(self) -> Floats:
        """Work of all forces since the beginning, (n,) J."""
        return np.concatenate([part.states[-1] for part in self.parts])

    def rows(self, names: Sequence[str], *, forces: bool) -> Floats:
        """Rows of the motion, or of it and its forces, by name (see ``core.outputs``), (names, n)."""
        return np.concatenate([part.rows(names, forces=forces) for part in self.parts], axis=1)

    def values(self, outputs: Mapping[str, Scalar]) -> Floats:
        """Values of the trace of motion and forces by any names, (outputs, n)."""
        return np.concatenate([part.values(outputs) for part in self.parts], axis=1)

    def outputs(self, names: Sequence[str]) -> Floats:
        """Outputs of the equation of motion by name, (names, n)."""
        return np.concatenate([part.outputs(names) for part in self.parts], axis=1)


class Part:
    """Times of one piece."""

    def __init__(self, piece: Piece, time: Floats) -> None:
        self.piece, self.time = piece, time
        self.system, self.equation = piece.system, piece.system.equation
        self.states = piece.at(time)

    @cached_property
    def _found(self) -> tuple[Floats, Floats, Floats]:
        """Accelerations (free, n), shares (held, n) of what holds, chain coordinates (states, n)."""
        system, n = self.system, len(self.equation.free)
        system.hold(self.piece.holding)
        seconds, held, chains = [], [], []
        for t, y, step in zip(self.time.tolist(), self.states.T, self.piece.steps(self.time), strict=True):
            system.set_states(dict(zip(self.equation.states, self.piece.chains[step].tolist(), strict=True)))
            if system.holding.constrained:
                found, share = system.constrained(t, y)
            else:
                found, share = system.evaluate(system.slim, t, y)[: n + 1].copy(), np.empty(0)
            seconds.append(found[:n])
            held.append(share)
            chains.append(system.chain(t, y))
        return np.array(seconds).T, np.array(held).T, np.array(chains).T

    @cached_property
    def course(self) -> dict[str, tuple[Floats, Floats, Floats]]:
        """Coordinate, rate and second derivative of every driver, (n,) each."""
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
        for name, (q, w, second) in self.course.items():
            found |= {f"q:{name}": q, f"w:{name}": w, Input("second", name).name: second}
        sides = holding.sides.copy()
        for group in holding.stick:
            for index, sign in group:
                sides[index] = -sign
        found |= self._switches(sides)
        _, held, chains = self._found
        for row, number in enumerate(holding.touch):
            found[contact_name(self.system.stops[number])] = held[len(holding.stick) + row]
        found |= dict(zip(equation.states, chains, strict=False))
        return found

    def _switches(self, sides: Floats) -> dict[str, Floats]:
        found = {}
        for surface, above in zip(self.system.surfaces, sides.tolist(), strict=True):
            for number, sign in surface.members:
                found[switch_name(number)] = np.full(len(self.time), 1.0 if above * sign > 0.0 else 0.0)
        return found

    def rows(self, names: Sequence[str], *, forces: bool) -> Floats:
        """As :meth:`Samples.rows`: forces where something sticks lie between those of slipping either way."""
        program = self.equation.row_program(names, forces=forces)
        return self._between(lambda given: self.equation.run(program, given, len(self.time)))

    def values(self, outputs: Mapping[str, Scalar]) -> Floats:
        """As :meth:`Samples.values`."""
        program = self.equation.value_program(outputs)
        return self._between(lambda given: self.equation.run(program, given, len(self.time)))

    def outputs(self, names: Sequence[str]) -> Floats:
        """As :meth:`Samples.outputs`."""
        return self._between(lambda given: self.equation.evaluate(names, given, len(self.time)))

    def _between(self, evaluate: Callable[[Mapping[str, Floats]], Floats]) -> Floats:
        found = evaluate(self.given)
        base = found.copy()
        for row, group in enumerate(self.piece.holding.stick):
            sides = self.piece.holding.sides.copy()
            for each in self.piece.holding.stick:
                for index, sign in each:
                    sides[index] = sign if each is group else -sign
            other = evaluate(self.given | self._switches(sides))
            found = found + self._found[1][row] * (other - base)
        return found
