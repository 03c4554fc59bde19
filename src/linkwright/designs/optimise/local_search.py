"""The local search: sequential quadratic programming with exact gradients, many designs side by side.

Each design minimizes the largest of its weighted objectives, within its demands. A step solves a quadratic program
of the linear models here and at the places tried last nearby, within a region of trust: the models of other places
are what extremes over the cycle need, whose place in the cycle changes from design to design (bundle of cutting
planes). Curvature is that of the Lagrangian: what is known of it (Gauss and Newton's, of mean squares), and the rest
from the slopes (damped BFGS). All designs are evaluated together, once a step.

Sources: Nocedal and Wright, *Numerical Optimization*, 2006, ch. 18; Bonnans et al., *Numerical Optimization*, 2006,
ch. 10 (bundles); Gembicki and Haimes 1975 (goal attainment); Dennis, Gay and Welsch 1981, *ACM Trans. Math. Softw.* 7
(squares).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.designs.optimise.evolution import SHARED, joined
from linkwright.designs.optimise.task import Judged, Side, Task

#: Most steps; the first and the largest half width of the region, the one with which a dearer demand is tried again,
#: and the one that ends the search.
STEPS, FIRST, LARGEST, AGAIN, SMALLEST = 30, 0.1, 0.5, 1e-3, 1e-6
#: What a demand's violation costs at first, how much more where that is too little, and at most; a violation and a
#: gain that are none.
PRICE, DEARER, DEAREST, MET, GAIN = 0.02, 5.0, 1e4, 1e-8, 1e-9
#: So many steps that gain less than this end a search.
PATIENCE, LITTLE = 5, 2e-6
#: Earlier points whose models are reused, and how far away they may lie, in half widths of the region.
MODELS, REACH = 2, 10.0
_FAR, _STEADY, _DEAR, _SLIGHT = 1e3, 1e-8, 10.0, 1e-12


class Model(NamedTuple):
    """At places x (K, n): objectives (K, g), what is left to the demands (K, c), the slopes (K, g or c, n), and
    what is known of the objectives' curvatures (K, g, n, n), 0 where nothing is."""

    x: Floats
    goals: Floats
    rooms: Floats
    goal_slopes: Floats
    room_slopes: Floats
    bends: Floats

    def taken(self, rows: Flags) -> Model:
        """Some of the places."""
        return Model(*(each[rows] for each in self))

    def with_some(self, other: Model, rows: Flags) -> Model:
        """Some of the places replaced by those of another one."""
        pairs = zip(self, other, strict=True)
        return Model(*(np.where(rows.reshape(-1, *[1] * (a.ndim - 1)), b, a) for a, b in pairs))


Evaluate = Callable[[Floats, Indices], Model]


def descended(evaluate: Evaluate, x: Floats, steps: int = STEPS, little: float = LITTLE) -> Floats:
    """Places (K, n) of the unit cube from which no step leads to a lower largest objective.

    ``evaluate(x, designs)``: the model at new places of some of the designs; objectives are weighted, those of weight
    0 far below the others; not finite where a design does not move. Some steps that gain less than ``little`` are the
    end.
    """
    search = _Searches(evaluate, x, little)
    for _ in range(steps):
        if not len(search.alive):
            break
        search.step()
    return search.found


def _merit(model: Model, price: Floats | float) -> Floats:
    """The largest objective with the price of what demands miss, (K,); infinite where a design does not move."""
    found = model.goals.max(axis=-1) + price * np.maximum(-model.rooms, 0.0).sum(axis=-1)
    return np.asarray(np.where(np.isfinite(found), found, np.inf))


class _Searches:
    """What is known of the searches that are not at their end, whose numbers are ``alive``."""

    def __init__(self, evaluate: Evaluate, x: Floats, little: float) -> None:
        self.evaluate, self.little, self.found = evaluate, little, x.copy()
        count, n = x.shape
        self.alive: Indices = np.arange(count)
        self.here = evaluate(x, self.alive)
        self.width, self.price = np.full(count, FIRST), np.full(count, PRICE)
        self.learned, self.idle = np.zeros((count, n, n)), np.zeros(count, dtype=np.intp)
        self.pushed = np.full(self.here.goals.shape, 1.0 / self.here.goals.shape[1])
        self.tried = Model(*(each[:, None] for each in self.here))
        self._keep(np.isfinite(_merit(self.here, self.price)))

    def step(self) -> None:
        """One step of all of them."""
        move, forces, hoped = self._solved()
        missing = (self.here.rooms < -MET).any(axis=1) & (hoped <= GAIN) & (self.price < DEAREST)
        cheap = missing | (forces[1] > 0.5 * self.price[:, None]).any(axis=1)
        trial = self.evaluate(np.clip(self.here.x + move, 0.0, 1.0), self.alive)
        gained = _merit(self.here, self.price) - _merit(trial, self.price)
        better = gained > 0.05 * np.maximum(hoped, 0.0)
        before, size = self.here, np.abs(move).max(axis=1)
        self._learn(before, trial, forces)
        self.pushed = forces[0]
        self.here = before.with_some(trial, better)
        self.found[self.alive] = self.here.x
        self.tried = Model(
            *(
                np.concatenate([new[:, None], other[:, None], old[:, 1:MODELS]], axis=1)
                for new, other, old in zip(self.here, trial.with_some(before, better), self.tried, strict=True)
            )
        )
        wider = better & (gained > 0.7 * hoped) & (size > 0.9 * self.width)
        self.width = np.where(wider, np.minimum(2.0 * self.width, LARGEST), self.width)
        self.width = np.where(better, self.width, 0.5 * np.minimum(self.width, size))
        self.price = np.where(cheap, np.minimum(DEARER * self.price, DEAREST), self.price)
        self.width = np.where(missing, np.maximum(self.width, AGAIN), self.width)
        self.idle = np.where(gained > self.little, 0, self.idle + better)
        self._keep((self.width > SMALLEST) & (self.idle < PATIENCE) & ((hoped > GAIN) | ~better) | missing)

    def _keep(self, rows: Flags) -> None:
        if not rows.all():
            self.alive, self.learned, self.pushed = self.alive[rows], self.learned[rows], self.pushed[rows]
            self.width, self.price, self.idle = self.width[rows], self.price[rows], self.idle[rows]
            self.here, self.tried = self.here.taken(rows), self.tried.taken(rows)

    def _solved(self) -> tuple[Floats, tuple[Floats, Floats], Floats]:
        """Moves (K, n), the forces of objectives and demands, and the gain that the models promise, (K,)."""
        rows, bounds = self._lines()
        width, (count, n), models = self.width, self.here.x.shape, self.tried.x.shape[1]
        curved = np.tile(_STEADY * np.eye(n + 1), (count, 1, 1))
        known = (self.pushed[:, :, None, None] * self.here.bends).sum(axis=1)
        curved[:, :n, :n] += width[:, None, None] * (self.learned + known)
        slope = np.zeros((count, n + 1))
        slope[:, n] = 1.0
        low, high = np.full((count, n + 1), -_FAR), np.full((count, n + 1), _FAR)
        low[:, :n] = np.maximum(-1.0, -self.here.x / width[:, None])
        high[:, :n] = np.minimum(1.0, (1.0 - self.here.x) / width[:, None])
        goals, kinds = self.here.goals.shape[1], bounds.shape[1] // models
        prices = np.tile(self.price[:, None], (1, kinds))
        prices[:, :goals] = _DEAR
        u, force = quadratic(curved, slope, rows, bounds, low, high, np.tile(prices, (1, models)))
        lack = (bounds - (rows @ u[..., None])[..., 0]).reshape(count, models, -1)
        top = u[:, n] + lack[:, :, :goals].max(axis=(1, 2))
        missed = np.maximum(lack[:, :, goals:].max(axis=1), 0.0).sum(axis=1)
        now = np.maximum(-self.here.rooms, 0.0).sum(axis=1)
        bent = 0.5 * np.einsum("ki,kij,kj->k", u, curved, u)
        hoped = self.price * now - width * (top + self.price * missed + bent)
        shared = force.reshape(count, models, -1).sum(axis=1)
        return width[:, None] * u[:, :n], (shared[:, :goals], shared[:, goals:]), hoped

    def _lines(self) -> tuple[Floats, Floats]:
        """Rows (K, m, n + 1) and lower bounds (K, m) of the models here and at the places tried, in widths; without
        weight where these lie too far away, or promise less here than there is: there the function bends."""
        here, tried = self.here, self.tried
        off = here.x[:, None] - tried.x
        top = here.goals.max(axis=1)[:, None, None]
        goals = tried.goals + (tried.goal_slopes @ off[..., None])[..., 0] - top
        rooms = tried.rooms + (tried.room_slopes @ off[..., None])[..., 0]
        false = np.concatenate(
            [goals > here.goals[:, None] - top + _SLIGHT, rooms < here.rooms[:, None] - _SLIGHT], axis=2
        )
        false |= (np.abs(off).max(axis=2) > REACH * self.width[:, None])[..., None]
        bounds = np.concatenate([goals, -rooms], axis=2) / self.width[:, None, None]
        slopes = np.concatenate([-tried.goal_slopes, tried.room_slopes], axis=2)
        up = np.zeros(bounds.shape)
        up[:, :, : goals.shape[2]] = 1.0
        rows = np.concatenate([slopes, up[..., None]], axis=3)
        false |= ~np.isfinite(bounds) | ~np.isfinite(slopes).all(axis=3)
        rows = np.where(false[..., None], 0.0, rows).reshape(len(off), -1, rows.shape[3])
        return rows, np.where(false, -_FAR, np.maximum(bounds, -_FAR)).reshape(len(off), -1)

    def _learn(self, before: Model, after: Model, forces: tuple[Floats, Floats]) -> None:
        """The curvature of the Lagrangian, but for what is known of it, from the slopes at two places (damped BFGS,
        Powell 1978; with a known part no larger before than the step shows, Dennis, Gay and Welsch 1981)."""
        objective_forces, demand_forces = forces

        def slope(model: Model) -> Floats:
            pushed = (objective_forces[:, None] @ model.goal_slopes)[:, 0]
            return np.asarray(pushed - (demand_forces[:, None] @ model.room_slopes)[:, 0])

        s = after.x - before.x
        known = (objective_forces[:, :, None] * (after.bends @ s[:, None, :, None])[..., 0]).sum(axis=1)
        y = slope(after) - slope(before) - known
        length, along = (s * s).sum(axis=1), (s * y).sum(axis=1)
        new = np.isfinite(y).all(axis=1) & (length > 0.0)
        s, y = np.where(new[:, None], s, 0.0), np.where(new[:, None], y, 0.0)
        unknown = ~after.bends.any(axis=(1, 2, 3))
        first = new & unknown & ~self.learned.any(axis=(1, 2)) & (along > 0.0)
        size = np.where(first, (y * y).sum(axis=1) / np.where(first, along, 1.0), 0.0)
        self.learned += size[:, None, None] * np.eye(s.shape[1])
        bs = (self.learned @ s[..., None])[..., 0]
        sbs, along = (s * bs).sum(axis=1), (s * y).sum(axis=1)
        much = np.minimum(1.0, np.abs(along) / np.where(sbs > 0.0, sbs, 1.0))
        much = np.where(unknown | (sbs <= 0.0), 1.0, much)
        self.learned, bs, sbs = much[:, None, None] * self.learned, much[:, None] * bs, much * sbs
        share = np.where(along >= 0.2 * sbs, 1.0, 0.8 * sbs / np.where(sbs > along, sbs - along, 1.0))
        y = share[:, None] * y + (1.0 - share)[:, None] * bs
        along = (s * y).sum(axis=1)
        new &= along > 0.0
        take, give = (
            np.where(new & (sbs > 0.0), 1.0 / np.where(sbs > 0.0, sbs, 1.0), 0.0),
            np.where(new, 1.0 / np.where(along > 0.0, along, 1.0), 0.0),
        )
        self.learned += give[:, None, None] * y[:, :, None] * y[:, None, :]
        self.learned -= take[:, None, None] * bs[:, :, None] * bs[:, None, :]


#: Most steps, the share of the mean product that is aimed at, the same after a step of at least this length, and how
#: near to the boundary a step goes.
INTERIOR_STEPS, AIM, SOON, GOOD, NEAR = 40, 0.1, 0.01, 0.9, 0.995
#: Mean product of a row and its multiplier that ends the search.
SMALL = 1e-11
#: What is added to the diagonal, as share of its largest number, against rounding.
STEADY = 1e-13


def quadratic(
    curved: Floats, slope: Floats, rows: Floats, bounds: Floats, low: Floats, high: Floats, price: Floats
) -> tuple[Floats, Floats]:
    """The u (K, n) between ``low`` and ``high`` that make ½ u·C·u + s·u + Σ p max(l − R·u, 0) minimal, and the
    multipliers (K, m) of the rows, 0 to p.

    ``curved`` C (K, n, n), positive definite; ``slope`` s (K, n); ``rows`` R (K, m, n); ``bounds`` l (K, m);
    ``low`` < ``high``; ``price`` p (K, m), exact where it is above the multipliers.
    Source: Nocedal and Wright, *Numerical Optimization*, 2006, ch. 16.6.
    """
    (count, m), n = bounds.shape, slope.shape[1]
    own, turned = range(n), np.ascontiguousarray(rows.swapaxes(1, 2))
    u = 0.5 * (low + high)
    lack = np.maximum(bounds - _times(rows, u), 0.0) + 1.0
    force = np.minimum(1.0, 0.5 * price)
    # positive numbers in pairs whose products go to zero: multipliers in the first half, what they hold in the second
    values = np.concatenate(
        [force, price - force, np.ones((count, 2 * n)), _times(rows, u) + lack - bounds, lack, u - low, high - u],
        axis=1,
    )
    half, moves, share = 2 * (m + n), np.empty(values.shape), np.full((count, 1), AIM)
    ends = (m, 2 * m, 2 * m + n)
    force, rest, below, above = np.split(values[:, :half], ends, axis=1)
    room, lack, down, up = np.split(values[:, half:], ends, axis=1)
    for _ in range(INTERIOR_STEPS):
        products = np.einsum("ki,ki->k", values[:, :half], values[:, half:])[:, None]
        left = products >= SMALL * half
        if not left.any():
            break
        aim = share / half * products
        stiff = force / (room + force * lack / rest)
        push = stiff * (aim / force - room - aim / rest + lack)
        pulls = np.concatenate([aim / down, aim / up, below / down, above / up], axis=1)
        matrix = curved + turned @ (stiff[:, :, None] * rows)
        matrix[:, own, own] += pulls[:, 2 * n : 3 * n] + pulls[:, 3 * n :]
        matrix[:, own, own] += STEADY * matrix[:, own, own].max(axis=1, keepdims=True)
        wanted = _times(turned, force + push) - _times(curved, u) - slope + pulls[:, :n] - pulls[:, n : 2 * n]
        du = np.linalg.solve(matrix, wanted[..., None])[..., 0]
        dforce = push - stiff * _times(rows, du)
        dlack = (aim - rest * lack + lack * dforce) / rest
        moves[:, :m], moves[:, m : 2 * m] = dforce, -dforce
        moves[:, 2 * m : half] = pulls[:, : 2 * n] - values[:, 2 * m : half]
        moves[:, 2 * m : half] -= pulls[:, 2 * n :] * np.concatenate([du, -du], axis=1)
        moves[:, half : half + m] = _times(rows, du) + dlack
        moves[:, half + m : half + 2 * m] = dlack
        moves[:, half + 2 * m : half + 2 * m + n], moves[:, half + 2 * m + n :] = du, -du
        fall = -(moves / values).min(axis=1, keepdims=True)
        step = np.where(left, np.minimum(1.0, NEAR / np.maximum(fall, 1e-300)), 0.0)
        values += step * moves
        u += step * du
        share = np.where(step > GOOD, SOON, AIM)
    return u, force


def _times(matrix: Floats, vector: Floats) -> Floats:
    return np.asarray((matrix @ vector[..., None])[..., 0])


#: Margin to the limit of a demand, in its scales, and the step of differences where no exact slope is had.
ROOM, STEP = 2e-7, 1e-5
#: A place in the cube nearer to a bound lies on it.
AT_BOUND = 1e-8
#: Minimum size of a demand relative to the start's value.
FINE = 1e-3
#: What demands leave to a machine that does not move, and the share of the machines on either side of a quantile
#: whose slopes count for it, one in so many.
STUCK, QUANTILE_SHARE = -1.0, 64
#: The value of an objective without weight: below all others.
_NONE = -1e6


class Polish:
    """Moves designs to the nearest optimum; variables with choices stay as they are."""

    def __init__(self, task: Task) -> None:
        self.task = task
        self.free = np.array([each.choices is None and each.high > each.low for each in task.problem.variables])
        self.names = tuple(each.address for each in task.problem.variables)
        self.span = np.where(task.high > task.low, task.high - task.low, 1.0)
        self.limits: list[tuple[str, float, float]] = []
        for each in task.bounds:
            start = abs(task.at_start[each.text])
            size = max(each.scale, FINE * start) if np.isfinite(start) else each.scale
            edge = ROOM * each.scale / size
            if np.isfinite(each.low):
                self.limits.append((each.text, 1 / size, -each.low / size - edge))
            if np.isfinite(each.high):
                self.limits.append((each.text, -1 / size, each.high / size - edge))

    def polished(
        self, before: Judged, weights: Floats, aims: Floats, steps: int = STEPS, little: float = LITTLE
    ) -> Judged:
        """The designs (K) with the largest of ``weights`` · (objective − ``aims``), (K, goals) each, minimised with
        the demands met; each where it became better, or violates less, else as it was."""
        sampled = self.task.problem.robust and not self.task.exact
        if not self.free.any() or sampled or not len(before.x):
            return before

        def evaluate(free: Floats, rows: Indices) -> Model:
            return self._model(self._all_variables(before.x[rows], free), weights[rows], aims[rows])

        moved = descended(evaluate, before.x[:, self.free], steps, little)
        moved = np.where(np.minimum(moved, 1.0 - moved) < AT_BOUND, np.round(moved), moved)
        after = self.task.judge(self._all_variables(before.x, moved))
        was, now = (_weighed(each.goals, weights, aims).max(axis=1) for each in (before, after))
        with np.errstate(invalid="ignore"):
            better = (after.total < before.total) | ((after.total == before.total) & (now <= was))
        return joined(before, after, np.flatnonzero(better), np.array([], dtype=np.intp))

    def _all_variables(self, x: Floats, free: Floats) -> Floats:
        found = x.copy()
        found[:, self.free] = free
        return found

    def _model(self, x: Floats, weights: Floats, aims: Floats) -> Model:
        """Objectives, what is left to demands, and the slopes of both by the free variables."""
        columns = self.task.columns_of(self.task.place(x))
        found = self._with_slopes(x, columns)
        own = [(goal.sign, *found[goal.text, goal.sign]) for goal in self.task.problem.goals]
        goals = np.column_stack([sign * value for sign, value, _ in own])
        falls = np.stack([sign * slope for sign, _, slope in own], axis=1)
        if self.task.problem.robust == "yield" and self.limits:
            rooms, climbs = self._left_to_share(columns)
        else:
            rooms, climbs = self._left(found)
        falls = weights[:, :, None] * falls
        falls += SHARED * falls.sum(axis=1, keepdims=True)
        goals = np.where(weights > 0.0, _weighed(goals, weights, aims), _NONE)
        bends = self._bends(columns, weights)
        return Model(x[:, self.free], goals, rooms, falls[:, :, self.free], climbs[:, :, self.free], bends)

    def _left(self, found: Mapping[Side, tuple[Floats, Floats]]) -> tuple[Floats, Floats]:
        """What is left to the demands, (K, demands), and its slopes, (K, demands, k)."""
        each = [(weight, offset, *found[text, -np.sign(weight)]) for text, weight, offset in self.limits]
        rooms = [weight * value + offset for weight, offset, value, _ in each]
        climbs = [weight * slope for weight, _, _, slope in each]
        shape = len(next(iter(found.values()))[0]), 0, len(self.names)
        return (np.stack(rooms, 1), np.stack(climbs, 1)) if each else (np.empty(shape[:2]), np.empty(shape))

    def _left_to_share(self, columns: Mapping[str, Floats]) -> tuple[Floats, Floats]:
        """What all demands leave to the best machine that must not be missed, (K, 1), and its slope, (K, 1, k).

        A share of the machines made meets the demands where a quantile of what these leave to the machines is not
        negative; its slope is that of the machine there (Hong 2009, *Operations Research* 57, 118), here the mean
        of some neighbours.
        """
        made, count = self.task.made(columns, self.task.samples), len(next(iter(columns.values())))
        values, slopes = self.task.measures.with_slopes(made, self.names)
        sides = {(text, sign): (values[text], slopes[text] * self.span) for text, sign in self.task.sides}
        rooms, climbs = self._left(sides)
        tightest = np.argmin(np.where(np.isnan(rooms), -np.inf, rooms), axis=1)
        room = np.take_along_axis(rooms, tightest[:, None], 1).reshape(count, -1)[:, 1:]
        climb = np.take_along_axis(climbs, tightest[:, None, None], 1).reshape(count, -1, len(self.names))[:, 1:]
        lost = ~np.isfinite(room)
        room, climb = np.where(lost, STUCK, room), np.where(lost[:, :, None], 0.0, climb)
        order, machines = np.argsort(room, axis=1), room.shape[1]
        last = min(int((1.0 - self.task.wanted) * machines + 1e-9), machines - 1)
        near = machines // QUANTILE_SHARE
        around = order[:, max(0, last - near) : last + near + 1]
        slope = np.take_along_axis(climb, around[:, :, None], 1).mean(axis=1)
        return np.take_along_axis(room, order[:, last : last + 1], 1), slope[:, None, :]

    def _bends(self, columns: Mapping[str, Floats], weights: Floats) -> Floats:
        """What is known of the weighted objectives' curvatures by the free variables, (K, goals, n, n)."""
        span = self.span[self.free]
        found = np.zeros((*weights.shape, len(span), len(span)))
        for k, goal in enumerate(self.task.problem.goals):
            bent = self.task.measures.curvatures(goal.text, columns, self.names)
            if bent is not None and goal.sign > 0.0:
                free = bent[:, self.free][:, :, self.free] * span[:, None] * span
                found[:, k] = weights[:, k, None, None] * free
        return np.asarray(found + SHARED * found.sum(axis=1, keepdims=True))

    def _with_slopes(self, x: Floats, columns: Mapping[str, Floats]) -> dict[Side, tuple[Floats, Floats]]:
        """Values (K,) and gradients (K, k) by the cube's coordinates, exact where they can be had, of what must not
        become larger (1) or smaller (-1): of the worst machine within the tolerances where that is asked."""
        measures, sides = self.task.measures, self.task.sides
        if not measures.side_by_side:
            values, slopes = self._by_differences(x)
            return {(text, sign): (values[text], slopes[text]) for text, sign in sides}
        if self.task.at_corners:
            columns, _ = self.task.corners(columns)
        values, slopes = measures.with_slopes(columns, self.names)
        per_design, found = len(next(iter(columns.values()))) // len(x), {}
        for k, (text, sign) in enumerate(sides):
            rows = slice(k if per_design > 1 else 0, None, per_design)
            found[text, sign] = values[text][rows], slopes[text][rows] * self.span
        return found

    def _by_differences(self, x: Floats) -> tuple[dict[str, Floats], dict[str, Floats]]:
        """The same by central differences, all designs in one go."""
        (count, k), free = x.shape, np.flatnonzero(self.free)
        step = np.zeros((2 * len(free) + 1, k))
        step[1 + np.arange(len(free)), free] = STEP
        step[1 + len(free) + np.arange(len(free)), free] = -STEP
        rows = np.clip(x[:, None, :] + step, 0.0, 1.0)
        found = self.task.measures(self.task.columns_of(self.task.place(rows.reshape(-1, k))))
        width = np.maximum((rows[:, 1 : len(free) + 1] - rows[:, len(free) + 1 :])[:, range(len(free)), free], 1e-12)
        values, slopes = {}, {}
        for text, column in found.items():
            each = column.reshape(count, -1)
            values[text], slopes[text] = each[:, 0], np.zeros((count, k))
            slopes[text][:, free] = (each[:, 1 : len(free) + 1] - each[:, len(free) + 1 :]) / width
        return values, slopes


def _weighed(goals: Floats, weights: Floats, aims: Floats) -> Floats:
    """What is minimized, (K, goals): the largest counts."""
    with np.errstate(invalid="ignore"):
        found = np.where(weights > 0.0, weights * (goals - aims), 0.0)
        return np.asarray(found + SHARED * found.sum(axis=1, keepdims=True))
