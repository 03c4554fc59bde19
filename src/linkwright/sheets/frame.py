"""The frame of a sheet with its centring marks and zones, and the bar that shows whether it is printed at 100 %."""

from __future__ import annotations

from linkwright.pictures.picture import LEAST, TEXT, Box, Picture
from linkwright.sheets.paper import Paper
from linkwright.words import Say

#: How far centring marks reach into the frame; aim for the length of a zone; depth of the zones' border, mm.
INTO, ZONE, BORDER = 5.0, 50.0, 5.0
LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ"
#: The control bar: its length, and the room for it with its text.
BAR, BAR_HEIGHT = 100.0, 11.0


def frame(paper: Paper, *, zones: bool, block: Box) -> Picture:
    """Edge of the paper, frame, centring marks (left out in the title block) and, if asked for, zones."""
    picture = Picture()
    inner = paper.frame
    picture.box(paper.whole)
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
            height = TEXT if margin >= BORDER else LEAST
            picture.text((place[0], place[1] - 0.5 * height), name, height, "middle")


def zone_count(length: float) -> int:
    """The even number of fields whose length is nearest to 50 mm, within 25 to 75 mm."""
    return max(2, 2 * round(length / ZONE / 2))


def control_bar(say: Say) -> Picture:
    """A line of 100 mm with ticks each 10 mm: the sheet is true to scale where it measures 100 mm in print."""
    picture = Picture()
    picture.line([(0.0, 6.5), (BAR, 6.5)])
    for place in range(0, int(BAR) + 1, 10):
        picture.line([(place, 6.5), (place, 9.5 if place % 50 == 0 else 8.0)])
    for number in (0, 50, 100):
        anchor = {0: "start", 50: "middle", 100: "end"}[number]
        picture.text((number, 10.5), str(number), LEAST, anchor)  # type: ignore[arg-type]
    picture.text((0.0, 1.2), say("sheet.print_full_size"), TEXT)
    return picture
