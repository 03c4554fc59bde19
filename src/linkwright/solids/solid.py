"""One thing that takes room: its shape on the link that carries it, and the plates between which it reaches."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from linkwright.shapes.shape import Shape

Sort = Literal["link", "wheel", "cam", "roller", "guide", "block", "pin", "post", "frame"]


@dataclass(frozen=True, eq=False)
class Solid:
    """A prism on one link.

    ``name``: that of the link, joint or part (``crank``, ``pin A``, ``guide slide``); ``carrier``: the link with
    which it moves; ``shape``: m, in the carrier's axes. A plate lies in one layer and has itself as its only one of
    ``plates``; anything else reaches from the lowest to the highest layer of its ``plates``: a pin through the links
    it joins, a post from the frame to a guide, a block from its guide to its own link. ``head``: radius, m, of the
    heads that stick out into the layers below the lowest and above the highest one; 0 without.
    ``thickness`` m and ``density`` kg/m³ of a plate.
    """

    name: str
    sort: Sort
    carrier: str
    shape: Shape
    plates: tuple[str, ...]
    head: float = 0.0
    thickness: float = 0.0
    density: float = 0.0

    @property
    def is_plate(self) -> bool:
        """Whether it lies in a layer of its own."""
        return self.plates == (self.name,)


@dataclass(frozen=True, eq=False)
class Solids:
    """All solids of a machine by their names.

    ``level``: pairs of plates in one layer, as those of wheels in mesh, of a cam and its roller, of a guide and the
    block in it; ``joined``: pairs (of any solids, sorted) whose contact is meant, so that no gap between them is
    asked for; ``notes``: what was taken by rule, sentences.
    """

    by_name: Mapping[str, Solid]
    level: tuple[tuple[str, str], ...] = ()
    joined: frozenset[tuple[str, str]] = frozenset()
    notes: tuple[str, ...] = ()
