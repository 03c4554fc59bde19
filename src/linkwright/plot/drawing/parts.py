"""Pieces of a drawing that move with one link."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from linkwright.plot.symbols.base import Shape

Layer = Literal["ground", "bodies", "blocks", "pins", "tops", "marks"]
LAYERS: tuple[Layer, ...] = ("ground", "bodies", "blocks", "pins", "tops", "marks")


@dataclass(frozen=True)
class Part:
    """A shape in the units of the paper in the axes of the link ``carrier``, on one of the layers."""

    layer: Layer
    carrier: str
    shape: Shape
