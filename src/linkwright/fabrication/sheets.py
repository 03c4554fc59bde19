"""Sheets on which all plates of one material and thickness lie."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from linkwright.fabrication.cut_lines import CutLines
from linkwright.shapes.loop import Edge, Loop

if TYPE_CHECKING:
    from linkwright.fabrication.cut_parts import CutParts


@dataclass(frozen=True, eq=False)
class Sheet:
    """A sheet of a ``material``, its ``size`` (width and height) and ``thickness`` m, its lower left corner at the
    origin, and the ``lines`` of the plates ``names`` on it."""

    size: tuple[float, float]
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

    def title(self, language: str) -> str:
        return ""


def sheets_of(found: CutParts, lines: Mapping[str, CutLines], size: tuple[float, float] | None) -> tuple[Sheet, ...]:
    return ()
