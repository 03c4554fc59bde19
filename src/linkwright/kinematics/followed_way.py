"""What is followed of the groups without closed form: their ways through all positions, and what lies between."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.dataclass import dataclass
from linkwright.core.read_only import Frozen
from linkwright.kinematics.branch import CORRECTION, follow, straight
from linkwright.kinematics.positions import Positions, at_times

if TYPE_CHECKING:
    from linkwright.kinematics.continuation import Follower

#: Positions of a cycle that are near enough for most that is read between them.
ENOUGH = 720


@dataclass(frozen=True)
class Stop:
    """Where a way ends: the drivers' coordinates, and the name of the group that becomes singular."""

    inputs: Floats
    group: str


@dataclass(frozen=True)
class Followed(Frozen):
    """The way of the groups without closed form through n positions.

    ``inputs`` (n, d): coordinates of drivers and lifts; ``states``: their chain coordinates (n,) by name, NaN
    where the way is barred; ``coordinates`` (n, unknowns): the same as unknowns of the closed loops;
    ``certified`` (n,): whether it is proved that the assembly is the one of the drawing; ``margin`` (n,): no
    other assembly lies nearer (rad, or share of the mechanism's size); ``stops`` and ``stop_of`` (n,): where the
    way to a position ends, -1 for none; ``breaks``: positions after which it ends before the next one;
    ``closed``: whether the first position follows the last one; ``returns``: whether such a cycle comes back to
    its first assembly (None: it was not passed); ``positions``: where the drivers follow their laws from each to
    the next.
    """

    follower: Follower
    inputs: Floats
    states: Mapping[str, Floats]
    coordinates: Floats
    certified: Flags
    margin: Floats
    stops: tuple[Stop, ...]
    stop_of: Indices
    breaks: frozenset[int]
    closed: bool
    returns: bool | None
    positions: Positions | None = None

    def taken(self, order: Indices) -> Followed:
        """Some of the positions in another order, each for itself."""
        return replace(
            self,
            inputs=self.inputs[order],
            states={name: row[order] for name, row in self.states.items()},
            coordinates=self.coordinates[order],
            certified=self.certified[order],
            margin=self.margin[order],
            stop_of=self.stop_of[order],
            breaks=frozenset(), closed=False, returns=None, positions=None,
        )  # fmt: skip

    def between(self, places: Floats, inputs: Floats) -> dict[str, Floats]:
        """States (m,) at places (numbers of positions, counted on in between) with given drivers (m, drivers).

        NaN where one of the two neighbours is not reached.
        """
        q = self.follower.driven(inputs)
        return self.follower.states(self._unknowns(places, q), q)

    def _unknowns(self, places: Floats, inputs: Floats) -> Floats:
        n = len(self.inputs)
        a = np.minimum(np.floor(places).astype(int), n - 1)
        around = self.closed and self.returns is not False
        b = (a + 1) % n if around else np.minimum(a + 1, n - 1)
        found = np.full((len(places), self.follower.loops.n), math.nan)
        known = np.flatnonzero(
            np.isfinite(self.coordinates[a]).all(axis=1)
            & np.isfinite(self.coordinates[b]).all(axis=1)
            & ((a != b) | (places == a))
            & ((places == a) | ~np.isin(a, list(self.breaks)))
        )
        if len(known):
            found[known], sure = self._read(a[known], b[known], (places - a)[known], inputs[known])
            rest = known[~sure]
            if len(rest) and self._finer is not None:
                finer, times = self._finer
                found[rest] = finer._unknowns(places[rest] * times, inputs[rest])
                rest = rest[~np.isfinite(found[rest]).all(axis=1)]
            for i in np.unique(a[rest]):
                these = rest[a[rest] == i]
                found[these] = self._walked(int(i), int(b[these[0]]), places[these] - i, inputs[these])
        return found

    @cached_property
    def _finer(self) -> tuple[Followed, int] | None:
        """The same cycle at so many times more positions; None where they are enough, or not all of it is passed."""
        positions = self.positions
        if (
            positions is None
            or positions.count >= ENOUGH
            or not np.isfinite(self.coordinates).all()
            or self.breaks
        ):
            return None
        times = -(-ENOUGH // positions.steps)
        ends = positions.around[:-1] if positions.repeated else positions.around
        count = (len(ends) - 1) * times + (0 if positions.closed else 1)
        at = np.interp(np.arange(count) / times, np.arange(len(ends)), ends)
        finer = replace(at_times(self.follower.mechanism, at, positions.period), cycle=True)
        return self.follower.follow(finer), times

    def _read(self, a: Indices, b: Indices, share: Floats, q: Floats) -> tuple[Floats, Flags]:
        """Unknowns (m, n) from the cubics between neighbours, and their tangents where drivers go no straight way,
        corrected by Newton's method; whether the correction is small against these ways."""
        follower, loops = self.follower, self.follower.loops
        start, end = (np.concatenate([self.coordinates[i], self.inputs[i]], axis=1) for i in (a, b))
        end = start + follower.nearest_way(end - start)
        way = end - start
        slopes = [loops.tangents(y, way[:, loops.n :]) for y in (start, end)]
        t = share[:, None]
        near = start + (3.0 - 2.0 * t) * t * t * way
        near[:, : loops.n] += t * (1.0 - t) ** 2 * slopes[0] - t * t * (1.0 - t) * slopes[1]
        near[:, loops.n :] = (start + t * way)[:, loops.n :]
        aside = follower.nearest_drive(q - near[:, loops.n :])
        beside = loops.tangents(near, aside)
        near += np.concatenate([beside, aside], axis=1)
        exact, last = loops.polished(near, 4)
        moved = (np.abs(exact - near)[:, : loops.n] / loops.scale).max(axis=1)
        gone = np.maximum(np.abs(way[:, : loops.n]), np.abs(beside)) / loops.scale
        room = CORRECTION * gone.max(axis=1) + 1e-9
        return exact[:, : loops.n], (moved <= room) & (last < 1e-9)

    def _walked(self, a: int, b: int, share: Floats, q: Floats) -> Floats:
        """Unknowns (m, n) between two neighbours, followed from the first towards the second."""
        follower, loops = self.follower, self.follower.loops
        goal = self.inputs[a] + follower.nearest_drive(self.inputs[b] - self.inputs[a])
        q = self.inputs[a] + follower.nearest_drive(q - self.inputs[a])
        order = np.argsort(share, kind="stable")
        places, back = np.unique(share[order], return_inverse=True)
        way = replace(straight(loops, self.inputs[a], goal, follower.unit), places=places)
        branch = follow(loops, way, self.coordinates[a])
        found = np.full((len(share), loops.n), math.nan)
        reached = back < len(branch.found)
        rows = branch.found[back[reached]].copy()
        rows[:, loops.n :] = q[order][reached]
        exact, last = loops.polished(rows, 4)
        exact, moved = exact[:, : loops.n], np.abs(exact - rows)[:, : loops.n] / loops.scale
        found[order[reached]] = exact
        room = CORRECTION * np.abs((exact - self.coordinates[a]) / loops.scale).max(axis=1) + 1e-9
        for i in order[reached][(moved.max(axis=1) > room) | (last > 1e-9)]:
            own = follower.between(self.inputs[a], q[i], self.coordinates[a])
            found[i] = own.last[: loops.n] if own.complete else math.nan
        return found
