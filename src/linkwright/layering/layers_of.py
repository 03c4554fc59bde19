"""The layers of a machine."""

from __future__ import annotations

from linkwright.layering.arrangement import Layers
from linkwright.mechanism.mechanism import Mechanism


def layers(mechanism: Mechanism) -> Layers:
    """The fewest layers in which nothing of a machine collides over its whole cycle."""
    raise NotImplementedError
