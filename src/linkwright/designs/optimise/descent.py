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

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.designs.optimise.quadratic import quadratic

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
