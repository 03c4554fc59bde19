"""Paper sizes and the frames of drawing sheets, in millimetres.

Sizes and margins after GB/T 14689-2008 (bound: 25 mm at the left, 10 or 5 mm elsewhere; not bound: 20 or 10 mm) and
ISO 5457:1999 (20 mm at the left, 10 mm elsewhere).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from linkwright.pictures.picture import MIN_TEXT, TEXT, Box, Picture
from linkwright.words import Translate, _

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
    def outer(self) -> Box:
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


#: How far centring marks reach into the frame; aim for the length of a zone; depth of the zones' border, mm.
INTO, ZONE, BORDER = 5.0, 50.0, 5.0
LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ"
#: The control bar: its length, and the room for it with its text.
BAR, BAR_HEIGHT = 100.0, 11.0


def frame(paper: Paper, *, zones: bool, block: Box) -> Picture:
    """Edge of the paper, frame, centring marks (left out in the title block) and, if asked for, zones."""
    picture = Picture()
    inner = paper.frame
    picture.box(paper.outer)
    picture.box(inner, "frame")
    across, up = paper.width / 2, paper.height / 2
    marks = [
        ((across, paper.height), (across, inner.top - INTO)),
        ((0.0, up), (inner.left + INTO, up)),
        ((paper.width, up), (inner.right - INTO, up)),
        ((across, 0.0), (across, inner.bottom + (0.0 if block.left < across < block.right else INTO))),
    ]
    for mark in marks:
        picture.line(mark, "frame")
    if zones:
        _zones(picture, paper)
    return picture


def _zones(picture: Picture, paper: Paper) -> None:
    """Fields of equal length, an even number on each side: figures from the left, letters from the top."""
    inner = paper.frame
    for side in ("top", "bottom", "left", "right"):
        lying = side in ("top", "bottom")
        start, length = (inner.left, inner.width) if lying else (inner.bottom, inner.height)
        edge = getattr(inner, side)
        out = 1.0 if side in ("top", "right") else -1.0
        margin = min(BORDER, abs(edge - {"top": paper.height, "right": paper.width}.get(side, 0.0)))
        count = zone_count(length)
        for number in range(count + 1):
            along = start + number * length / count
            ends = (
                ((along, edge), (along, edge + out * margin))
                if lying
                else ((edge, along), (edge + out * margin, along))
            )
            if 0 < number < count:
                picture.line(ends)
        for number in range(count):
            middle = start + (number + 0.5) * length / count
            name = str(number + 1) if lying else LETTERS[count - 1 - number]
            aside = edge + out * 0.5 * margin
            place = (middle, aside) if lying else (aside, middle)
            height = TEXT if margin >= BORDER else MIN_TEXT
            picture.text((place[0], place[1] - 0.5 * height), name, height, "middle")


def zone_count(length: float) -> int:
    """The even number of fields whose length is nearest to 50 mm, within 25 to 75 mm."""
    return max(2, 2 * round(length / ZONE / 2))


def control_bar(say: Translate) -> Picture:
    """A line of 100 mm with ticks each 10 mm: the sheet is true to scale where it measures 100 mm in print."""
    picture = Picture()
    picture.line([(0.0, 6.5), (BAR, 6.5)])
    for place in range(0, int(BAR) + 1, 10):
        picture.line([(place, 6.5), (place, 9.5 if place % 50 == 0 else 8.0)])
    for number in (0, 50, 100):
        anchor = {0: "start", 50: "middle", 100: "end"}[number]
        picture.text((number, 10.5), str(number), MIN_TEXT, anchor)  # type: ignore[arg-type]
    picture.text((0.0, 1.2), say(_("Print at 100 %: this bar is 100 mm long.")), TEXT)
    return picture
