"""Which plate lies in which layer, and what keeps a machine from having layers at all."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from linkwright.collisions.gaps import Gap
from linkwright.mechanism.mechanism import Mechanism
from linkwright.solids.solid import Solids


@dataclass(frozen=True)
class Conflict:
    """Two solids that no layers keep apart: their names, and where they meet."""

    first: str
    second: str
    gap: Gap


@dataclass(frozen=True, eq=False)
class Layers:
    """The fewest layers in which nothing collides: ``layer`` of every plate by name, the frame's own is 0; ``count``
    without it; ``conflicts``: what keeps a machine from having layers, then ``layer`` is empty; ``height``: z of the
    lower and upper face of every plate, m."""

    mechanism: Mechanism
    solids: Solids
    layer: Mapping[str, int]
    height: Mapping[str, tuple[float, float]]
    conflicts: tuple[Conflict, ...] = ()

    @property
    def count(self) -> int:
        """How many layers there are besides the frame's own."""
        return max(self.layer.values(), default=0)
