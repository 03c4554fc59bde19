"""Change points in motion under forces: where assembly modes meet, and every coordinate's formulas fail.

The quality of a group touches zero there, √ of it goes through zero in a straight line, for every joint's coordinate,
as the ways of the loops branch. The smooth way through has the modes of all groups that touch zero flipped behind the
point. Close to it, what the formulas give is read from the polynomial through Chebyshev points on both sides, at the
same rates and time. Which of the ways a real machine takes is not decided by rigid bodies.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.inputs import Input, mode_inputs
from linkwright.dynamics.description import CLOSED, CLOSING_STEPS, Description
from linkwright.dynamics.right_side import RightSide

#: Chebyshev points on both sides of a change point.
NODES = 16
#: Within this share of the reach values are read from the polynomial.
NEAR = 0.25
#: Degree of the polynomials whose zeros are sought, and how often one that moves is sought anew.
DEGREE, FOLLOWED = 11, 3
#: Directions of links read from the polynomial differ by less, and places found anew by less of the reach.
SMOOTH = 1e-8


@dataclass
class ChangePoint:
    """A change point on the way of one coordinate, the others at rest: ``driver`` and its ``place`` (rad or m),
    ``modes`` below it of the groups whose modes flip; nodes go ``reach`` (rad or m) to both sides; ``states``
    (nodes,) of groups without closed form there.

    Where other coordinates move it, ``place`` is where it was last.
    """

    description: Description
    driver: str
    place: float
    modes: Mapping[str, float]
    reach: float
    states: Mapping[str, Floats] = field(default_factory=dict)

    @cached_property
    def nodes(self) -> Floats:
        """Distances of the nodes, (NODES,)."""
        return np.asarray(self.reach * _COSINES)

    def beyond(self, q: Floats) -> float:
        """How far coordinates q (drivers,) are behind it, rad or m."""
        k = self.description.names.index(self.driver)
        if len(q) > 1 and self.modes:
            self._follow(q, k)
        return float(q[k]) - self.place

    def _follow(self, q: Floats, k: int) -> None:
        """Finds the place anew, as the zero of the polynomial through signed roots of a quality at the nodes."""
        side, sign = self._roots, np.where(self.nodes < 0.0, 1.0, -1.0)
        rows = [side.inputs[f"q:{name}"] for name in self.description.names]
        for _step in range(FOLLOWED):
            side.x[rows] = q[:, None]
            side.x[rows[k]] = self.place + self.nodes
            side.call()
            roots = sign * np.sqrt(side.out[0])
            zero = next_zero(self.nodes, roots, 0.0, self.reach)
            if zero is None:
                return
            self.place += zero
            if abs(zero) < SMOOTH * self.reach:
                return

    @cached_property
    def _roots(self) -> RightSide:
        """The quality of one of the groups at the nodes, with the modes of each side."""
        equation = self.description.equation
        program = equation.program([f"closure:{next(iter(self.modes))}"])
        first = [f"q:{name}" for name in self.description.names]
        found = RightSide(program, {**equation.numbers, **self.description.held}, lanes=NODES, first=first)
        found.set_inputs(self.signs(self.nodes))
        return found

    def signs(self, beyond: Floats) -> dict[str, Floats]:
        """Signs of the modes that flip, by the names of inputs, at distances (n,) from it."""
        side = np.where(beyond < 0.0, 1.0, -1.0)
        return mode_inputs({group: sign * side for group, sign in self.modes.items()})


_ANGLES = (2 * np.arange(NODES) + 1) * np.pi / (2 * NODES)
_COSINES = np.cos(_ANGLES)
_WEIGHTS = np.sin(_ANGLES) * (-1.0) ** np.arange(NODES)


def shares(x: float, reach: float) -> Floats:
    """What every node has of the value at a distance x, (NODES,) (barycentric formula; Berrut and Trefethen 2004)."""
    gap = x / reach - _COSINES
    if not gap.all():
        return np.asarray(1.0 * (gap == 0.0))
    share = _WEIGHTS / gap
    return np.asarray(share / share.sum())


def next_zero(places: Floats, roots: Floats, near: float, within: float) -> float | None:
    """The zero of the polynomial through roots (n,) at places (n,) that is next to a place."""
    if not np.isfinite(roots).all():
        return None
    scale = float(np.ptp(places))
    zeros = np.roots(np.polyfit((places - near) / scale, roots, min(len(places) - 1, DEGREE)))
    zeros = zeros.real[np.abs(zeros.imag) < 1e-6] * scale
    zeros = zeros[np.abs(zeros) < within]
    return None if not len(zeros) else near + float(zeros[np.argmin(np.abs(zeros))])


def read_across(
    point: ChangePoint, evaluate: Callable[[Mapping[str, Floats]], Floats], given: Mapping[str, Floats]
) -> Floats:
    """Outputs (names, n) that ``evaluate`` finds at inputs (n,) by name, read from the nodes close to the point.

    Accelerations at the nodes are those that belong to the rates and times.
    """
    equation = point.description.equation
    names = point.description.names
    beyond = np.array([point.beyond(q) for q in np.array([given[f"q:{name}"] for name in names]).T])
    found = evaluate({**given, **point.signs(beyond)})
    near = np.flatnonzero(np.abs(beyond) < NEAR * point.reach)
    if not len(near):
        return found
    across = {name: np.repeat(row[near], NODES) for name, row in given.items()}
    nodes = np.tile(point.nodes, len(near))
    across[f"q:{point.driver}"] = across[f"q:{point.driver}"] - np.repeat(beyond[near], NODES) + nodes
    across |= point.signs(nodes)
    across |= {name: np.tile(row, len(near)) for name, row in point.states.items()}
    seconds = equation.evaluate([f"qdd:{name}" for name in equation.free], across, len(nodes))
    across |= {Input("second", name).name: row for name, row in zip(equation.free, seconds, strict=True)}
    weights = np.array([shares(x, point.reach) for x in beyond[near].tolist()])
    found[:, near] = np.einsum("kij,ij->ki", evaluate(across).reshape(len(found), len(near), NODES), weights)
    return found


class Bridged:
    """A right side through a change point: as :class:`RightSide`, with modes by the side on which it is called, and
    outputs read from the nodes close to the point, but for those of ``direct`` rows."""

    def __init__(self, right: RightSide, point: ChangePoint) -> None:
        description = point.description
        equation = description.equation
        self.point, self.right = point, right
        self.program, self.inputs, self.set_inputs = right.program, right.inputs, right.set_inputs
        self.x, self.out = right.x, right.out
        numbers = dict(zip(right.program.parameters, right.numbers.tolist(), strict=True))
        self.lanes = RightSide(
            right.program,
            numbers,
            lanes=NODES,
            tables=equation.tables,
            first=list(right.inputs),
            compiled=right.compiled,
        )
        self.row = right.inputs[f"q:{point.driver}"]
        self.rows = [right.inputs.get(f"q:{name}") for name in description.names]
        #: How far behind the change point it was called last, rad or m.
        self.beyond = 0.0
        self.modes = [
            (right.inputs[name], sign) for name, sign in mode_inputs(point.modes).items() if name in right.inputs
        ]
        self.states = [right.inputs[name] for name in point.states if name in right.inputs]
        names = right.program.output_names
        self._next = [names.index(f"next:{name}") for name in point.states if f"next:{name}" in names]
        self.lanes.set_inputs({**point.signs(point.nodes), **point.states})
        #: Rows that differ from node to node, but for the coordinate.
        self._own = [*self.states, *(row for row, _sign in self.modes)]
        direct = ("gap:", "closure:", "outcome", "next:")
        self.direct = np.array([k for k, name in enumerate(names) if name.startswith(direct)], dtype=np.intp)

    def call(self) -> None:
        """Evaluates ``x`` into ``out``."""
        self.beyond = beyond = self.point.beyond(np.array([0.0 if k is None else self.x[k] for k in self.rows]))
        for row, sign in self.modes:
            self.x[row] = sign if beyond < 0.0 else -sign
        if abs(beyond) > NEAR * self.point.reach:
            self.right.call()
            return
        least = 1e-6 * self.point.reach
        if abs(beyond) < least:
            self.x[self.row] = self.point.place + (least if beyond >= 0.0 else -least)
        if len(self.direct):
            self.right.call()
        self.x[self.row] = self.point.place + beyond
        kept = self.out[self.direct]
        self.out[:] = self._read(beyond)
        self.out[self.direct] = kept

    def _read(self, beyond: float) -> Floats:
        x, nodes = self.lanes.x, self.point.nodes
        own = x[self._own].copy()
        x[:] = self.x[:, None]
        x[self._own] = own
        x[self.row] = self.point.place + nodes
        for _step in range(CLOSING_STEPS if self.states else 1):
            self.lanes.call()
            if not self.states:
                break
            ahead = self.lanes.out[self._next]
            change = np.abs(ahead - x[self.states]).max()
            x[self.states] = ahead
            if change < CLOSED:
                break
        return np.asarray(self.lanes.out @ shares(beyond, self.point.reach))
