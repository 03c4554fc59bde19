"""How the machine's metres become the paper's units."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.errors import LinkwrightError
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.placement import Placement
from linkwright.pictures.picture import Vec

DIAGONAL = 620.0
SHORTEST_BAR = 26.0


@dataclass(frozen=True)
class View:
    """Units of the paper per metre; the frame's origin is the paper's."""

    scale: float

    def paper(self, world: Floats) -> Floats:
        """Points (..., 2) in frame axes as points of the paper."""
        scaled: Floats = np.asarray(world) * (self.scale, -self.scale)
        return scaled

    def local(self, point: Vec) -> Vec:
        """A point in link axes as a point of the link's piece of paper."""
        return point[0] * self.scale, -point[1] * self.scale

    def transform(self, placement: Placement, index: int) -> tuple[float, float, float]:
        """Shift x, y and turn (degrees, clockwise) of a link's piece of paper at one position."""
        x, y = self.paper(placement.origin[index])
        c, s = placement.direction[index]
        return float(x), float(y), float(-np.degrees(np.arctan2(s, c)))


def moved(points: Floats, transform: tuple[float, float, float]) -> Floats:
    """Points of a link's piece of paper on the paper."""
    x, y, turn = transform
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    return np.stack(
        [x + c * points[:, 0] - s * points[:, 1], y + s * points[:, 0] + c * points[:, 1]], axis=1
    )


def fitted(motion: Motion, placed: Mapping[str, Placement], diagonal: float = DIAGONAL) -> View:
    """A view in which all that the machine reaches has this diagonal, larger where bars are short."""
    mechanism = motion.mechanism
    cloud = [placed[link.name].world(p) for link in mechanism.links.values() for p in link.points.values()]
    pins = [np.array([p]) for name, p in mechanism.frame.points.items() if name in mechanism.joints]
    everything = np.concatenate([*cloud, *pins])
    everything = everything[np.isfinite(everything).all(axis=1)]
    if not len(everything):
        raise LinkwrightError("picture.no_position_reached", name=mechanism.name)
    low, high = everything.min(axis=0), everything.max(axis=0)
    reach = float(np.hypot(*(high - low))) or 1.0
    scale = diagonal / reach
    shortest = min(
        (length for link in mechanism.links.values() for length in _bars(link.points)), default=reach
    )
    scale *= float(np.clip(SHORTEST_BAR / (shortest * scale), 1.0, 1.6))
    return View(scale)


def _bars(points: Mapping[str, Vec]) -> list[float]:
    rows = list(points.values())
    lengths = [float(np.hypot(a[0] - b[0], a[1] - b[1])) for i, a in enumerate(rows) for b in rows[:i]]
    return [length for length in lengths if length > 0]
