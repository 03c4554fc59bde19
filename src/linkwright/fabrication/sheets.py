"""Sheets on which all plates of one material and thickness lie."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from linkwright.core.quantity import number, shown
from linkwright.errors import RequestError
from linkwright.fabrication.cut_lines import CutLines
from linkwright.fabrication.nesting import Placed, nest
from linkwright.fabrication.part import Part
from linkwright.shapes.loop import Edge, Loop
from linkwright.shapes.shape import Shape
from linkwright.words import Message, _

if TYPE_CHECKING:
    from linkwright.fabrication.cut_parts import CutParts

Size = tuple[float, float]
#: Usual sheets, m, of which the smallest is taken on which every plate has room.
USUAL: tuple[Size, ...] = (
    (0.3, 0.2),
    (0.6, 0.4),
    (1.0, 0.6),
    (1.2, 0.9),
    (2.0, 1.0),
    (2.5, 1.25),
    (3.0, 1.5),
    (6.0, 2.0),
)
#: Smallest distance of plates, m, and the same as a share of their thickness.
SPACING, OF_THICKNESS = 2e-3, 0.5


@dataclass(frozen=True, eq=False)
class Sheet:
    """A sheet of a ``material``, its ``size`` (width and height) and ``thickness`` m, its lower left corner at the
    origin, and the ``lines`` of the plates ``names`` on it; ``number`` counts from 1."""

    number: int
    size: Size
    material: str
    thickness: float
    names: tuple[str, ...]
    lines: tuple[CutLines, ...]

    @property
    def edge(self) -> Loop:
        """The edge of the sheet."""
        width, height = self.size
        corners = [0j, complex(width, 0.0), complex(width, height), complex(0.0, height)]
        return Loop(tuple(Edge(a, b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)))

    @property
    def name(self) -> str:
        """A name for its file: number, material and thickness."""
        return "-".join(
            filter(None, (f"sheet-{self.number}", self.material, f"{number(self.thickness, 'length')}mm"))
        )


def sheets_of(
    found: CutParts, lines: Mapping[str, CutLines], size: Size | None = None, kerf: float = 0.0
) -> tuple[Sheet, ...]:
    """All plates on sheets, those of one material and thickness together.

    ``lines``: of the plates by name; ``size``: width and height of the sheets, m, those of the file or usual ones
    unless given. Raises RequestError for a plate that has no room on a sheet of the size that is asked for.
    """
    construction = found.mechanism.construction
    asked = size or (None if construction is None else construction.sheet)
    groups: dict[tuple[str, str], list[Part]] = {}
    for each in found.parts:
        if each.sort == "plate":
            groups.setdefault((each.material, number(each.length, "length")), []).append(each)
    sheets: list[Sheet] = []
    for (material, _thickness), parts in groups.items():
        shapes = [found.layers.solids.by_name[each.name].shape for each in parts]  # of wheels without teeth
        for used, rows in _laid_out(parts, shapes, asked, kerf):
            names = tuple(part.name for part, _place in rows)
            placed = tuple(lines[part.name].moved(place.turn, place.place) for part, place in rows)
            sheets.append(Sheet(len(sheets) + 1, used, material, parts[0].length, names, placed))
    return tuple(sheets)


def _laid_out(
    parts: Sequence[Part], shapes: Sequence[Shape], asked: Size | None, kerf: float
) -> Iterator[tuple[Size, list[tuple[Part, Placed]]]]:
    """The size of every sheet, and the plates on it with their places."""
    spacing = max(SPACING, OF_THICKNESS * parts[0].length) + kerf
    for size in [asked] if asked else _sizes():
        places = nest(shapes, size, spacing)
        rows = [(part, place) for part, place in zip(parts, places, strict=True) if place is not None]
        if len(rows) == len(parts):
            for sheet in range(1 + max(place.sheet for _part, place in rows)):
                yield size, [(part, place) for part, place in rows if place.sheet == sheet]
            return
    raise RequestError(_no_room(next(part for part, place in zip(parts, places, strict=True) if place is None), size))


def _sizes() -> Iterator[Size]:
    """Usual sheets, then larger ones as long as it takes."""
    yield from USUAL
    width, height = USUAL[-1]
    while True:
        width, height = 2.0 * width, 2.0 * height
        yield width, height


def _no_room(part: Part, size: Size) -> Message:
    return _(
        "{part} has no room on a sheet of {width} × {height}; give a larger one (--sheet, construction.sheet)",
        code="cut.no_room",
        part=part.name,
        width=shown(size[0], "length"),
        height=shown(size[1], "length"),
    )
