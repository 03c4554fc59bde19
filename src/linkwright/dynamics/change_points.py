"""Change points in motion under forces: where assembly modes meet, and every coordinate's formulas fail.

The quality of a group touches zero there, √ of it goes through zero in a straight line, for every joint's coordinate,
as the ways of the loops branch. The smooth way through has the modes of all groups that touch zero flipped behind the
point. Close to it, what the formulas give is read from the polynomial through Chebyshev points on both sides, at the
same rates and time. Which of the ways a real machine takes is not decided by rigid bodies.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.inputs import Input, mode_inputs
from linkwright.dynamics.description import CLOSED, CLOSING_STEPS, Description
from linkwright.dynamics.equation import group_quality
from linkwright.dynamics.right_side import RightSide
from linkwright.formula.trace import Scalar

#: Chebyshev points on both sides of a change point, and how far they go, rad (of guides: shares of UNIT).
NODES, REACH = 16, 0.4
#: Reaches that are tried, and where between the nodes, as shares of the reach, what is read is compared.
REACHES = (0.4, 0.28, 0.2, 0.14, 0.1, 0.07, 0.05)
BETWEEN = np.array([-0.31, -0.21, -0.11, 0.13, 0.23, 0.37])
#: Within this share of the reach values are read from the polynomial.
NEAR = 0.25
#: Step in which the surroundings are looked through, rad, how far, and the root of the quality that may be a zero.
STEP, LOOK, SMALL = 0.02, 0.8, 0.15
#: Points of a fit on one side of a zero; finer step for the second fit.
FIT, FINE = 6, 0.25
#: Degree of the polynomials whose zeros are sought, and how often one that moves is sought anew.
DEGREE, FOLLOWED = 11, 3
#: Roots of one change point, in steps; directions of links read from the polynomial differ by less.
TOGETHER, SMOOTH = 1e-3, 1e-8
#: For guides, the share of the machine's size that counts as one radian.
UNIT = 0.25


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
            zero = _zero(self.nodes, roots, 0.0, self.reach)
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


def change_point(description: Description, q: Floats, w: Floats) -> ChangePoint | None:
    """The nearest change point about a position, coordinates and rates (drivers,) each; None where there is none.

    Of several freedoms, the coordinate is the one that has the shortest way to it.
    """
    surroundings = _Surroundings(description, q, w)
    found = []
    for name in description.equation.free:
        k = description.names.index(name)
        for sense in (1.0, -1.0) if w[k] >= 0.0 else (-1.0, 1.0):
            near = surroundings.along(name, sense)
            if near is not None:
                found.append((abs(near.place - q[k]) / surroundings.unit(name), near))
    return min(found, key=lambda each: each[0])[1] if found else None


def _zero(places: Floats, roots: Floats, near: float, within: float) -> float | None:
    """The zero of the polynomial through roots (n,) at places (n,) that is next to a place."""
    if not np.isfinite(roots).all():
        return None
    scale = float(np.ptp(places))
    zeros = np.roots(np.polyfit((places - near) / scale, roots, min(len(places) - 1, DEGREE)))
    zeros = zeros.real[np.abs(zeros.imag) < 1e-6] * scale
    zeros = zeros[np.abs(zeros) < within]
    return None if not len(zeros) else near + float(zeros[np.argmin(np.abs(zeros))])


class _Surroundings:
    """Roots of qualities, and directions of links, about a position."""

    def __init__(self, description: Description, q: Floats, w: Floats) -> None:
        self.description, self.q, self.w = description, q, w
        equation = description.equation
        motion = equation.solver.motion
        self.groups = equation.groups
        self.outputs: dict[str, Scalar] = {name: group_quality(motion, name) for name in self.groups}
        for link in equation.mechanism.links:
            e = motion.poses[link].direction
            self.outputs |= {f"x:{link}": e.x, f"y:{link}": e.y}
        self.outputs |= {f"next:{name}": each for name, each in motion.next_states.items()}

    def unit(self, name: str) -> float:
        """What counts as one radian of a coordinate."""
        equation = self.description.equation
        return 1.0 if equation.rotary[name] else UNIT * equation.mechanism.size

    def at(self, name: str, places: Floats, signs: Mapping[str, Floats]) -> dict[str, Floats]:
        """The outputs with one coordinate at places (n,), ``signs`` of some modes there.

        Groups without closed form are followed from place to place, from the present one to both sides.
        """
        description, k = self.description, self.description.names.index(name)
        q = np.repeat(self.q[:, None], len(places), axis=1)
        q[k] = places
        if not description.states:
            with np.errstate(invalid="ignore", divide="ignore"):
                return description.motion(self.outputs, q, 0.0 * q, signs)
        found = {each: np.full(len(places), np.nan) for each in self.outputs}
        order = np.argsort(places)
        for way in (order[places[order] >= self.q[k]], order[places[order] < self.q[k]][::-1]):
            states = dict(description.states)
            for i in way.tolist():
                held = {each: row[i : i + 1] for each, row in signs.items()}
                here = self._closed(q[:, i : i + 1], held, states)
                if here is None:
                    break
                for each, value in here.items():
                    found[each][i] = value[0]
        return found

    def _closed(self, q: Floats, held: Mapping[str, Floats], states: dict[str, float]) -> dict[str, Floats] | None:
        """The outputs at one place, states carried on; None where Newton's steps do not come to an end."""
        for _step in range(CLOSING_STEPS):
            given = {**held, **{each: np.array([value]) for each, value in states.items()}}
            here = self.description.motion(self.outputs, q, 0.0 * q, given)
            ahead = {each: float(here[f"next:{each}"][0]) for each in states}
            change = max(abs(ahead[each] - value) for each, value in states.items())
            states |= ahead
            if change < CLOSED:
                return here
        return None

    def roots(self, name: str, places: Floats) -> Floats:
        """Roots of the qualities, (groups, n), with the modes as they are."""
        found = self.at(name, places, {})
        with np.errstate(invalid="ignore"):
            return np.asarray(np.sqrt(np.array([found[group] for group in self.groups])))

    def along(self, name: str, sense: float) -> ChangePoint | None:
        """The first change point ahead on the way of one coordinate."""
        unit, here = self.unit(name), self.q[self.description.names.index(name)]
        step = sense * STEP * unit
        behind = round(REACH / STEP)
        grid = here + step * np.arange(-behind, round(LOOK / STEP))
        roots = self.roots(name, grid)
        for j in range(behind, len(grid) - 1):
            if not self._lowest(roots, j):
                continue
            first = self._zeros(grid[j - FIT : j], roots[:, j - FIT : j], grid[j], 2.0 * abs(step))
            if first is None:
                continue
            fine: Floats = first - FINE * step * np.arange(FIT + 1.0, 1.0, -1.0)
            place, groups = self._touching(name, fine, first, abs(step))
            return self._verified(name, place, sense, groups) if groups else None
        return None

    def _lowest(self, roots: Floats, j: int) -> bool:
        """Whether some root has a small value that is the smallest one about there, or no value beyond."""
        before, here, after = roots[:, j - 1], roots[:, j], roots[:, j + 1]
        with np.errstate(invalid="ignore"):
            small = np.where(np.isnan(here), before, here) < SMALL
            falls = np.isnan(here) | (here <= before)
            return bool((small & falls & ~(after < here)).any())

    def _zeros(self, places: Floats, roots: Floats, near: float, within: float) -> float | None:
        """The first zero of any group's root."""
        every = (_zero(places, row, near, within) for row in roots)
        found = [each for each in every if each is not None]
        return min(found, key=lambda each: abs(each - places[-1])) if found else None

    def _touching(self, name: str, places: Floats, near: float, step: float) -> tuple[float, list[str]]:
        """The place again from finer steps, and the groups whose qualities are zero there."""
        roots = self.roots(name, places)
        place = self._zeros(places, roots, near, step)
        if place is None:
            return near, []
        each = {group: _zero(places, row, place, step) for group, row in zip(self.groups, roots, strict=True)}
        return place, [k for k, zero in each.items() if zero is not None and abs(zero - place) < TOGETHER * step]

    def _verified(self, name: str, place: float, sense: float, groups: Sequence[str]) -> ChangePoint | None:
        """The change point, with a reach in which links turn smoothly through it; None where none is found, as at a
        dead point, beyond which there is no position."""
        modes = self.description.modes
        flips = {group: sense * modes[group] for group in groups if group in modes}
        best: tuple[float, ChangePoint] | None = None
        for share in REACHES if flips else ():
            point = ChangePoint(self.description, name, place, flips, share * self.unit(name))
            error = self._error(point)
            if error is not None and (best is None or error < best[0]):
                best = error, point
        return None if best is None else best[1]

    def _error(self, point: ChangePoint) -> float | None:
        """What accelerations read from the nodes differ from those of the formulas, as share of their size; None
        where links do not turn smoothly through the point."""
        beyond = np.concatenate([point.nodes, point.reach * BETWEEN])
        signs = point.signs(beyond)
        found = self.at(point.driver, point.place + beyond, signs)
        weights = np.array([shares(x, point.reach) for x in point.reach * BETWEEN])
        rows = np.array([row for each, row in found.items() if each[:2] in ("x:", "y:")])
        if not np.abs(rows[:, :NODES] @ weights.T - rows[:, NODES:]).max() < SMOOTH:
            return None
        description = self.description
        states = {each: found[f"next:{each}"] for each in description.states}
        point.states = {each: row[:NODES] for each, row in states.items()}
        given: dict[str, Floats | float] = {**description.held, **signs, **states}
        for each, q, w in zip(description.names, self.q.tolist(), self.w.tolist(), strict=True):
            given |= {f"q:{each}": q, f"qd:{each}": w}
        given[f"q:{point.driver}"] = point.place + beyond
        accelerations = [f"qdd:{each}" for each in description.equation.free]
        rows = description.equation.evaluate(accelerations, given, len(beyond))
        off = np.abs(rows[:, :NODES] @ weights.T - rows[:, NODES:]).max() / (np.abs(rows).max() or 1.0)
        return float(off) if off == off else np.inf


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
