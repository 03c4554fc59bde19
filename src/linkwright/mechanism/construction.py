"""How a machine is made: shapes of its links, material, thickness, pins, supports and layers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from linkwright.core.data import Frozen
from linkwright.mechanism.link import Vec

ShapeKind = Literal["bar", "plate", "path", "outline", "disc", "none"]
Supports = Literal["cantilevered", "both"]
Ends = Literal["heads", "flush"]


@dataclass(frozen=True)
class Material:
    """``density`` kg/m³, yield ``strength`` Pa, ``modulus`` of elasticity Pa."""

    name: str
    density: float
    strength: float
    modulus: float


@dataclass(frozen=True)
class LinkShape(Frozen):
    """The key ``shape`` of a link.

    ``kind``: ``bar``, a bar with round ends along the link's points in order (the usual one of links whose points
    are in line); ``plate``, their convex hull widened by half the width (the usual one of all others); ``path``, a
    bar ``through`` points by name and places in the link's axes (bent bars, hooks); ``outline``: ``rings``, the outer
    one first, in the link's axes; ``disc``: about the first point; ``none``: takes no room. ``width``, ``radius``,
    ``thickness``: m, None for those of the construction; ``material``: empty for that of the construction.
    """

    kind: ShapeKind
    width: float | None = None
    radius: float | None = None
    through: tuple[str | Vec, ...] = ()
    rings: tuple[tuple[Vec, ...], ...] = ()
    thickness: float | None = None
    material: str = ""


@dataclass(frozen=True)
class Construction(Frozen):
    """The section ``construction`` of a model file; lengths in m, None for the usual ones.

    ``supports``: the frame on one side of the machine (``cantilevered``) or on ``both``; ``ends`` of pins: ``heads``
    that stick out into the next layers, or ``flush``; ``clearance``: smallest gap between what moves in one layer;
    ``layers``: layers of plates that are fixed by name, 0 the frame's own, None in all layers (``frame: all``);
    ``washer``: thickness between two layers; ``fit``: by how much a hole's diameter is larger than its pin's;
    ``kerf``: width that a cut takes; ``sheet``: width and height of the sheets.
    """

    material: Material
    thickness: float | None = None
    width: float | None = None
    pin_radius: float | None = None
    supports: Supports = "cantilevered"
    ends: Ends = "heads"
    clearance: float | None = None
    layers: Mapping[str, int | None] = field(default_factory=dict)
    washer: float | None = None
    fit: float = 0.0
    kerf: float = 0.0
    sheet: Vec | None = None
    safety: float = 2.0
