"""Paper sizes and the frames of drawing sheets, in millimetres.

Sizes and margins after GB/T 14689-2008 (bound: 25 mm at the left, 10 or 5 mm elsewhere; not bound: 20 or 10 mm) and
ISO 5457:1999 (20 mm at the left, 10 mm elsewhere).
"""

from __future__ import annotations

from typing import Literal

from linkwright.core.dataclass import dataclass
from linkwright.pictures.picture import Box

Standard = Literal["gb", "iso"]
#: Short and long side of the basic sizes.
SIZES = {"A0": (841, 1189), "A1": (594, 841), "A2": (420, 594), "A3": (297, 420), "A4": (210, 297)}
#: Margins of GB/T 14689: at the three sides of a bound sheet, at all sides of one that is not bound.
_GB = {"A0": (10, 20), "A1": (10, 20), "A2": (10, 10), "A3": (5, 10), "A4": (5, 10)}
#: Margins of ISO 5457, and of the bound side of GB/T 14689.
_ISO, _ISO_LEFT, _BINDING = 10, 20, 25


@dataclass(frozen=True)
class Paper:
    """A sheet of paper: ``size`` A0 to A4, upright or not, its standard, with or without a margin for binding."""

    size: str = "A1"
    upright: bool = False
    standard: Standard = "iso"
    bound: bool = True

    @property
    def width(self) -> float:
        """Width, mm."""
        return float(SIZES[self.size][0 if self.upright else 1])

    @property
    def height(self) -> float:
        """Height, mm."""
        return float(SIZES[self.size][1 if self.upright else 0])

    @property
    def whole(self) -> Box:
        """The sheet's own rectangle."""
        return Box(0.0, 0.0, self.width, self.height)

    @property
    def frame(self) -> Box:
        """The rectangle of the frame."""
        if self.standard == "iso":
            left, other = _ISO_LEFT, _ISO
        else:
            bound, free = _GB[self.size]
            left, other = (_BINDING, bound) if self.bound else (free, free)
        return Box(float(left), float(other), self.width - other, self.height - other)

    @property
    def thick(self) -> float:
        """Width of thick lines, mm; thin ones have half of it (GB/T 4457.4)."""
        return 0.7 if self.size in ("A0", "A1") else 0.5
