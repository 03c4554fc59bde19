"""One part to make: a plate, pin, spacer or washer, where it goes and what is cut or turned."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from linkwright.fabrication.outlines import outline
from linkwright.shapes.loop import Loop, circle
from linkwright.shapes.shape import Shape, disc

Sort = Literal["plate", "pin", "spacer", "washer"]


@dataclass(frozen=True)
class Hole:
    """A bored hole of a plate for the ``pin`` (or post) of that name: centre in the plate's axes and radius, m;
    ``fixed``: the pin is pressed into it, else it turns in it."""

    pin: str
    centre: complex
    radius: float
    fixed: bool


@dataclass(frozen=True)
class Place:
    """Where one of the equal parts is: on the link ``carrier``, its axes' origin at ``at`` (m) in those of the link,
    its lower face at the height ``z`` (m); ``on``: the pin on which a spacer or washer is, or the part's own name."""

    carrier: str
    at: complex
    z: float
    on: str


@dataclass(frozen=True, eq=False)
class Prism:
    """A shape between two heights above the lower face of a part, m."""

    shape: Shape
    low: float
    high: float


@dataclass(frozen=True, eq=False)
class Part:
    """A part to make, as often as it has ``places``.

    ``shape``: m, with all its holes; of a plate in the axes of its link, of anything round about its own axis.
    ``length`` along the pins: the thickness of a plate or washer, of a pin between its heads, m. ``diameter`` of
    what is round and its ``bore``, m, 0 of plates; ``head``: diameter of a pin's heads, ``heads``: height of the
    lower and of the upper one, m, 0 without. ``layer``: the lowest in which it is; ``mass``: of one, kg.
    """

    name: str
    sort: Sort
    shape: Shape
    length: float
    material: str
    mass: float
    layer: int
    places: tuple[Place, ...]
    holes: tuple[Hole, ...] = ()
    diameter: float = 0.0
    bore: float = 0.0
    head: float = 0.0
    heads: tuple[float, float] = (0.0, 0.0)

    @property
    def count(self) -> int:
        """How many are needed."""
        return len(self.places)

    @cached_property
    def edge(self) -> tuple[Loop, ...]:
        """The outline without the bored holes."""
        return outline(self.shape)

    @cached_property
    def loops(self) -> tuple[Loop, ...]:
        """The outline: loops around material counter-clockwise, then those around openings and holes clockwise."""
        bored = (circle(centre, radius, clockwise=True) for centre, radius in self.shape.holes)
        return (*self.edge, *bored)

    def prisms(self) -> Iterator[Prism]:
        """What it consists of from below: a pin with heads of up to three, else of one."""
        below, above = self.heads
        if below > 0.0:
            yield Prism(disc(0j, 0.5 * self.head), -below, 0.0)
        yield Prism(self.shape, 0.0, self.length)
        if above > 0.0:
            yield Prism(disc(0j, 0.5 * self.head), self.length, self.length + above)
