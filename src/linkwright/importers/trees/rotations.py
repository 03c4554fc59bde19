"""Rotations and displacements in space as URDF writes them: rpy about fixed axes x, y, z, one after the other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from linkwright.core.arrays import Floats


def rotation(rpy: Sequence[float]) -> Floats:
    """The rotation matrix (3, 3) of angles about x, then y, then z, rad."""
    (cr, cp, cy), (sr, sp, sy) = ([turn(each) for each in rpy] for turn in (math.cos, math.sin))
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


@dataclass(frozen=True)
class Frame:
    """Axes in space: ``turn`` (3, 3) and ``origin`` (3,) m."""

    turn: Floats = field(default_factory=lambda: np.eye(3))
    origin: Floats = field(default_factory=lambda: np.zeros(3))

    def place(self, point: Floats) -> Floats:
        """A point of these axes in space."""
        return np.asarray(self.origin + self.turn @ point)

    def then(self, xyz: Sequence[float], rpy: Sequence[float]) -> Frame:
        """Axes that lie in these ones."""
        return Frame(self.turn @ rotation(rpy), self.place(np.array(xyz, dtype=float)))
