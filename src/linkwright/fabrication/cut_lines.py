"""What a cutter follows for one plate: its outline, slots and holes, and the names that are engraved."""

from __future__ import annotations

import cmath
from collections.abc import Iterable
from dataclasses import dataclass, replace

from linkwright.core.quantity import shown
from linkwright.errors import RequestError
from linkwright.fabrication.engraving import Engraving, engravings
from linkwright.fabrication.outlines import outline
from linkwright.fabrication.part import Part
from linkwright.shapes.loop import Loop
from linkwright.words import _


@dataclass(frozen=True, eq=False)
class CutLines:
    """``outer`` loops around material, ``inner`` ones around slots, ``holes``: circles by centre and radius, m, and
    the names that are engraved."""

    outer: tuple[Loop, ...]
    inner: tuple[Loop, ...]
    holes: tuple[tuple[complex, float], ...]
    names: tuple[Engraving, ...] = ()

    def moved(self, turn: float, to: complex) -> CutLines:
        """All turned about the origin by an angle (rad), then moved by a vector (m)."""
        way = cmath.exp(1j * turn)
        return CutLines(
            tuple(each.moved(turn, to) for each in self.outer),
            tuple(each.moved(turn, to) for each in self.inner),
            tuple((way * centre + to, radius) for centre, radius in self.holes),
            tuple(replace(each, at=way * each.at + to, turn=each.turn + turn) for each in self.names),
        )

    @property
    def box(self) -> tuple[complex, complex]:
        """Lowest and highest x and y, m."""
        return box_of(self.outer)


def box_of(loops: Iterable[Loop]) -> tuple[complex, complex]:
    """Lowest and highest x and y of loops, m."""
    lows, highs = zip(*(loop.box for loop in loops), strict=True)
    return (
        complex(min(each.real for each in lows), min(each.imag for each in lows)),
        complex(max(each.real for each in highs), max(each.imag for each in highs)),
    )


def cut_lines(part: Part, kerf: float = 0.0) -> CutLines:
    """The lines of a plate in its own axes, outside its edges by half the width of the cut (m)."""
    loops = outline(part.shape, 0.5 * kerf) if kerf else part.edge
    outer = tuple(loop for loop in loops if loop.area > 0.0)
    inner = tuple(loop for loop in loops if loop.area <= 0.0)
    holes = tuple((centre, radius - 0.5 * kerf) for centre, radius in part.shape.holes)
    if any(radius <= 0.0 for _centre, radius in holes):
        raise RequestError(
            _(
                "the kerf of {kerf} is as wide as a hole in {part}; give a smaller one, or make the pins thicker",
                code="cut.kerf",
                kerf=shown(kerf, "length"),
                part=part.name,
            )
        )
    return CutLines(outer, inner, holes, engravings(part))
