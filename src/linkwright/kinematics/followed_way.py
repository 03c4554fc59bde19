"""What is followed of the groups without closed form: their ways through all positions, and what lies between."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.core.dataclass import dataclass
from linkwright.core.read_only import Frozen
from linkwright.kinematics.branch import Branch

if TYPE_CHECKING:
    from linkwright.kinematics.continuation import Follower


@dataclass(frozen=True)
class Stop:
    """Where a way ends: the drivers' coordinates, and the name of the group that becomes singular."""

    inputs: Floats
    group: str


@dataclass(frozen=True)
class Stretch:
    """A branch through positions: their ``places`` (n,) on its way; what their coordinates have ``gained`` on its."""

    branch: Branch
    places: Floats
    gained: Floats | float = 0.0

    def at(self, numbers: Floats) -> Floats:
        """Places on the way at numbers of positions, counted on in between; behind the last one as before it."""
        n = len(self.places)
        step = self.places[-1] - self.places[-2]
        return np.asarray(
            np.interp(numbers, np.arange(n + 1), np.append(self.places, self.places[-1] + step))
        )

    def read(self, follower: Follower, x: Floats, q: Floats) -> Floats:
        """Coordinates (m, n) at places x (m,) with the drivers at q (m, d); NaN where it does not go."""
        return np.asarray(follower.read(self.branch, x, q - self.branch.way.lap) + self.gained)


@dataclass(frozen=True)
class Followed(Frozen):
    """The way of the groups without closed form through n positions.

    ``inputs`` (n, d): coordinates of the drivers; ``states``: their chain coordinates (n,) by name, NaN where the
    way is barred; ``coordinates`` (n, unknowns): the same with angles as such; ``stops`` and ``stop_of`` (n,): where
    the way to a position ends, -1 for none; ``breaks``: positions after which it ends before the next one;
    ``closed``: whether the first position follows the last one; ``returns``: whether such a cycle comes back to
    its first assembly (None: it was not passed); ``stretches``: the branches on which the drivers move from each
    position to the next.
    """

    follower: Follower
    inputs: Floats
    states: Mapping[str, Floats]
    coordinates: Floats
    stops: tuple[Stop, ...]
    stop_of: Indices
    breaks: frozenset[int]
    closed: bool
    returns: bool | None
    stretches: tuple[Stretch, ...] = ()

    def taken(self, order: Indices) -> Followed:
        """Some of the positions in another order, each for itself."""
        return replace(
            self,
            inputs=self.inputs[order],
            states={name: row[order] for name, row in self.states.items()},
            coordinates=self.coordinates[order],
            stop_of=self.stop_of[order],
            breaks=frozenset(), closed=False, returns=None, stretches=(),
        )  # fmt: skip

    def between(self, places: Floats, inputs: Floats) -> dict[str, Floats]:
        """States (m,) at places (numbers of positions, counted on in between) with given drivers (m, d).

        NaN where one of the two neighbours is not reached.
        """
        n = len(self.inputs)
        a = np.minimum(np.floor(places).astype(int), n - 1)
        around = self.closed and self.returns is not False
        b = (a + 1) % n if around else np.minimum(a + 1, n - 1)
        found = np.full((len(places), self.coordinates.shape[1]), math.nan)
        known = np.flatnonzero(
            np.isfinite(self.coordinates[a]).all(axis=1)
            & np.isfinite(self.coordinates[b]).all(axis=1)
            & ((a != b) | (places == a))
            & ((places == a) | ~np.isin(a, list(self.breaks)))
        )
        for stretch in self.stretches:
            left = known[~np.isfinite(found[known]).all(axis=1)]
            if len(left):
                found[left] = stretch.read(self.follower, stretch.at(places[left]), inputs[left])
        for i in known[~np.isfinite(found[known]).all(axis=1)]:
            here = self.inputs[a[i]]
            goal = here + self.follower.nearest_drive(inputs[i] - here)
            own = self.follower.between(here, goal, self.coordinates[a[i]])
            if own.complete and own.last is not None:
                found[i] = own.last
        return self.follower.states(found)
