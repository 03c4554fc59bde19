"""The search of change points about a position: along each coordinate, from the roots of the groups' qualities."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.dynamics.change_points import NODES, SMOOTH, ChangePoint, next_zero, shares
from linkwright.dynamics.description import CLOSED, CLOSING_STEPS, Description
from linkwright.dynamics.equation import group_quality
from linkwright.formula.trace import Scalar

#: Reaches of the nodes that are tried, rad (of guides: shares of UNIT), and where between the nodes, as shares of the
#: reach, what is read is compared.
REACHES = (0.4, 0.28, 0.2, 0.14, 0.1, 0.07, 0.05)
BETWEEN = np.array([-0.31, -0.21, -0.11, 0.13, 0.23, 0.37])
#: Step in which the surroundings are looked through, rad, how far, and the root of the quality that may be a zero.
STEP, LOOK, SMALL = 0.02, 0.8, 0.15
#: Points of a fit on one side of a zero; finer step for the second fit.
FIT, FINE = 6, 0.25
#: Roots of one change point, in steps.
TOGETHER = 1e-3
#: For guides, the share of the machine's size that counts as one radian.
UNIT = 0.25


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
        behind = round(REACHES[0] / STEP)
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
        every = (next_zero(places, row, near, within) for row in roots)
        found = [each for each in every if each is not None]
        return min(found, key=lambda each: abs(each - places[-1])) if found else None

    def _touching(self, name: str, places: Floats, near: float, step: float) -> tuple[float, list[str]]:
        """The place again from finer steps, and the groups whose qualities are zero there."""
        roots = self.roots(name, places)
        place = self._zeros(places, roots, near, step)
        if place is None:
            return near, []
        each = {group: next_zero(places, row, place, step) for group, row in zip(self.groups, roots, strict=True)}
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
