"""Where the links of a motion are at every position: origins and directions of their axes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import row_names
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical


@dataclass(frozen=True)
class Placement:
    """Origin (n, 2) m and direction of the x axis (n, 2) of a link at every position."""

    origin: Floats
    direction: Floats

    def world(self, local: tuple[float, float]) -> Floats:
        """A point of the link in frame axes, (n, 2) m."""
        c, s = self.direction[:, 0], self.direction[:, 1]
        x, y = local
        return np.stack([self.origin[:, 0] + c * x - s * y, self.origin[:, 1] + s * x + c * y], axis=1)


def placements(motion: Motion) -> dict[str, Placement]:
    """Placement of every link, the frame included."""
    still = np.zeros((motion.steps, 2))
    found = {"frame": Placement(still, still + np.array([1.0, 0.0]))}
    links = motion.mechanism.links
    first = {name: canonical(motion.mechanism, name, next(iter(link.points))) for name, link in links.items()}
    wanted = [row_names("direction", name) for name in links]
    wanted += [row_names("position", point) for point in first.values()]
    motion.evaluate_together(each for pair in wanted for each in pair)
    for name, link in links.items():
        direction = motion.link(name).direction
        x, y = next(iter(link.points.values()))
        c, s = direction[:, 0], direction[:, 1]
        at = motion.point_of(first[name]).position
        found[name] = Placement(at - np.stack([c * x - s * y, s * x + c * y], axis=1), direction)
    return found


def with_placements_of(
    placed: Mapping[str, Placement], positions: Sequence[tuple[Motion, int]]
) -> dict[str, Placement]:
    """Placements with those at positions of other motions of the same mechanism after them."""
    rows = [(placements(motion), [index]) for motion, index in positions]

    def of(name: str, part: str) -> Floats:
        more = [getattr(other[name], part)[row] for other, row in rows]
        return np.concatenate([getattr(placed[name], part), *more])

    return {name: Placement(of(name, "origin"), of(name, "direction")) for name in placed}
