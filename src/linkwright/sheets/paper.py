"""Paper of drawing sheets, in millimetres: sizes, frames and title blocks.

Sizes and margins after GB/T 14689-2008 (bound: 25 mm at the left, 10 or 5 mm elsewhere; not bound: 20 or 10 mm) and
ISO 5457:1999 (20 mm at the left, 10 mm elsewhere).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from linkwright.pictures.fonts import needs_chinese
from linkwright.pictures.picture import MIN_TEXT, TEXT, Box, Picture, as_runs, runs_width
from linkwright.words import Translate, _, pgettext

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


def control_bar(translate: Translate) -> Picture:
    """A line of 100 mm with ticks each 10 mm: the sheet is true to scale where it measures 100 mm in print."""
    picture = Picture()
    picture.line([(0.0, 6.5), (BAR, 6.5)])
    for place in range(0, int(BAR) + 1, 10):
        picture.line([(place, 6.5), (place, 9.5 if place % 50 == 0 else 8.0)])
    for number in (0, 50, 100):
        anchor = {0: "start", 50: "middle", 100: "end"}[number]
        picture.text((number, 10.5), str(number), MIN_TEXT, anchor)  # type: ignore[arg-type]
    picture.text((0.0, 1.2), translate(_("Print at 100 %: this bar is 100 mm long.")), TEXT)
    return picture


#: Minimum width of letters as a share of their own.
NARROWEST = 0.62


@dataclass(frozen=True)
class Fields:
    """What a title block tells: texts as they are printed; empty ones leave their cell empty."""

    title: str = ""
    drawing: str = ""
    number: str = ""
    scale: str = ""
    school: str = ""
    faculty: str = ""
    class_name: str = ""
    student: str = ""
    student_number: str = ""
    adviser: str = ""
    checker: str = ""
    date: str = ""
    sheet: int = 1
    sheets: int = 1


@dataclass(frozen=True)
class Cell:
    """A cell, mm from the upper left corner of its block: what it holds, in which height, and a small head above."""

    x: float
    y: float
    width: float
    height: float
    text: str = ""
    letters: float = 3.5
    head: str = ""
    thick: bool = False


@dataclass(frozen=True)
class TitleBlock:
    """The cells of a block and its size, mm."""

    width: float
    height: float
    cells: tuple[Cell, ...]

    def picture(self) -> Picture:
        """The block with its lower left corner at the origin."""
        found = Picture()
        for cell in self.cells:
            box = Box(cell.x, self.height - cell.y - cell.height, cell.x + cell.width, self.height - cell.y)
            found.box(box, "thick" if cell.thick else "thin")
            _write(found, cell, box)
        found.box(Box(0.0, 0.0, self.width, self.height), "thick")
        return found


def _write(picture: Picture, cell: Cell, box: Box) -> None:
    """Head and text of a cell; a long text is made smaller, then set in two lines, then cut."""
    room = box.height
    if cell.head:
        picture.text((box.left + 1.0, box.top - 1.0 - MIN_TEXT), cell.head, MIN_TEXT)
        room -= MIN_TEXT + 1.5
    if not cell.text:
        return
    width = box.width - 1.6
    lines, height = fitted(cell.text, width, room, cell.letters)
    step = 1.45 * height
    level = box.bottom + 0.5 * room + 0.5 * step * (len(lines) - 1) - 0.5 * height
    for line in lines:
        squeeze = min(1.0, width / max(runs_width(as_runs(line), height), 1e-9))
        picture.text((0.5 * (box.left + box.right), level), line, height, "middle", squeeze=squeeze)
        level -= step


def fitted(text: str, width: float, room: float, letters: float) -> tuple[list[str], float]:
    """A text in one or two lines that fit a width, and the height of its letters: at most ``letters``, mm.

    Chinese characters may be squeezed to 0.7 of their width, as in long imitation Song (GB/T 14691); others to
    NARROWEST where they would be cut.
    """
    if "\n" in text:
        parts = [part for part in text.split("\n") if part]
        heights = [fitted(part, width, room / len(parts), letters)[1] for part in parts]
        return [fitted(part, width, 1.3 * min(heights), min(heights))[0][0] for part in parts], min(heights)
    minimum = TEXT if needs_chinese(text) else MIN_TEXT
    width /= 0.7 if needs_chinese(text) else 1.0
    heights = [each for each in (letters, 7.0, 5.0, TEXT, MIN_TEXT) if minimum <= each <= max(letters, minimum)]
    for height in heights:
        if runs_width(as_runs(text), height) <= width and height <= room:
            return [text], height
        if 2.6 * height <= room and (lines := _halves(text, width, height)):
            return lines, height
    if not needs_chinese(text) and NARROWEST * runs_width(as_runs(text), minimum) <= width:
        return [text], minimum
    while text and runs_width(as_runs(text + "…"), minimum) > width:
        text = text[:-1]
    return [text + "…"], minimum


def _halves(text: str, width: float, height: float) -> list[str]:
    """A text in two lines of a width, parted at a space or between Chinese characters; empty where it is longer."""
    places = [k for k in range(1, len(text)) if text[k] == " " or ord(text[k]) > 0x2E7F]
    for k in sorted(places, key=lambda place: abs(place - len(text) / 2)):
        lines = [text[:k].strip(), text[k:].strip()]
        if all(runs_width(as_runs(line), height) <= width for line in lines):
            return lines
    return []


def gb_block(fields: Fields, translate: Translate) -> TitleBlock:
    """180 × 56 mm: changes, signatures, others, name and code, after the example of GB/T 10609.1-2008."""
    return TitleBlock(
        180.0, 56.0, (*_gb_changes(translate), *_gb_signatures(fields, translate), *_gb_rest(fields, translate))
    )


def _gb_changes(translate: Translate) -> Iterator[Cell]:
    heads = (_("Mark"), pgettext("sheet", "No."), _("Zone"), _("Change"), _("Signed"), _("Date"))
    x = 0.0
    for width, head in zip((10, 10, 16, 16, 12, 16), heads, strict=True):
        for row in range(3):
            yield Cell(x, 7.0 * row, width, 7.0)
        yield Cell(x, 21.0, width, 7.0, translate(head), 3.5 if width > 10 else 2.5)
        x += width
    yield Cell(0, 0, 80, 28, thick=True)


def _gb_signatures(fields: Fields, translate: Translate) -> Iterator[Cell]:
    people = (
        (_("Drawn"), fields.student, fields.date if fields.student else ""),
        (pgettext("sheet", "Adviser"), fields.adviser, ""),
        (_("Checked"), fields.checker, ""),
        (_("Process"), "", ""),
    )
    others = (_("Stand."), None, None, _("Appr."))
    for row, (head, name, date) in enumerate(people):
        y = 28.0 + 7.0 * row
        yield Cell(0, y, 12, 7, translate(head), 3.5)
        yield Cell(12, y, 12, 7, name, 3.5)
        yield Cell(24, y, 16, 7, date, 3.5)
        yield Cell(40, y, 12, 7, translate(other) if (other := others[row]) else "", 3.5)
        yield Cell(52, y, 12, 7)
        yield Cell(64, y, 16, 7)
    yield Cell(0, 28, 80, 28, thick=True)


def _gb_rest(fields: Fields, translate: Translate) -> Iterator[Cell]:
    yield Cell(80, 0, 50, 28, fields.title, 5.0, thick=True)
    yield Cell(80, 28, 26, 7, translate(_("Stage")), 3.5)
    yield Cell(106, 28, 12, 7, translate(_("Mass")), 3.5)
    yield Cell(118, 28, 12, 7, translate(_("Scale")), 3.5)
    for k in range(4):
        yield Cell(80 + 6.5 * k, 35, 6.5, 12)
    yield Cell(106, 35, 12, 12)
    yield Cell(118, 35, 12, 12, fields.scale, 3.5)
    yield Cell(
        80, 47, 50, 9, translate(_("Sheet {sheet} of {sheets}", sheet=fields.sheet, sheets=fields.sheets)), 3.5
    )
    yield Cell(80, 28, 50, 28, thick=True)
    yield Cell(130, 0, 50, 18, _joined(fields.school, fields.faculty), 5.0, thick=True)
    yield Cell(130, 18, 50, 20, fields.drawing, 7.0, thick=True)
    yield Cell(130, 38, 50, 9, fields.number or fields.student_number, 5.0, thick=True)
    yield Cell(130, 47, 50, 9, _joined(fields.class_name, fields.student_number if fields.number else ""), thick=True)


def school_block(fields: Fields, translate: Translate) -> TitleBlock:
    """140 × 40 mm: drawing, scale, number, class, persons, title of the task, school, sheet of sheets."""
    cells = [Cell(0, 0, 60, 16, fields.drawing, 7.0)]
    right = (
        (_("Scale"), fields.scale, pgettext("sheet.block.number", "No."), fields.number),
        (_("Class"), fields.class_name, _("Id. no."), fields.student_number),
    )
    for row, (head, text, other, value) in enumerate(right):
        y = 8.0 * row
        cells += [Cell(60, y, 15, 8, translate(head)), Cell(75, y, 25, 8, text)]
        cells += [Cell(100, y, 15, 8, translate(other)), Cell(115, y, 25, 8, value)]
    people = (
        (_("Drawn"), fields.student, fields.date),
        (pgettext("sheet", "Adviser"), fields.adviser, ""),
        (_("Checked"), fields.checker, ""),
    )
    for row, (head, name, date) in enumerate(people):
        y = 16.0 + 8.0 * row
        cells += [Cell(0, y, 18, 8, translate(head)), Cell(18, y, 22, 8, name), Cell(40, y, 20, 8, date)]
    cells += [
        Cell(60, 16, 80, 8, fields.title, 5.0),
        Cell(60, 24, 80, 8, _joined(fields.school, fields.faculty), 5.0),
        Cell(60, 32, 80, 8, translate(_("Sheet {sheet} of {sheets}", sheet=fields.sheet, sheets=fields.sheets))),
    ]
    return TitleBlock(140.0, 40.0, tuple(cells))


def iso_block(fields: Fields, translate: Translate) -> TitleBlock:
    """180 × 40 mm with the fields of ISO 7200, and the scale."""

    top = (
        (translate(_("Responsible dept.")), _joined(fields.faculty, fields.class_name)),
        (translate(_("Technical reference")), fields.student_number),
        (translate(_("Created by")), fields.student),
        (translate(_("Approved by")), _joined(fields.adviser, fields.checker)),
    )
    cells = [Cell(45.0 * k, 0, 45, 10, text, 3.5, name) for k, (name, text) in enumerate(top)]
    cells += [
        Cell(0, 10, 72, 20, fields.school, 5.0, translate(_("Legal owner"))),
        Cell(72, 10, 108, 20, f"{fields.title}\n{fields.drawing}", 5.0, translate(_("Title, supplementary title"))),
    ]
    bottom = (
        (40.0, translate(_("Document type")), translate(pgettext("sheet", "Kinematic drawing"))),
        (46.0, translate(_("Identification number")), fields.number),
        (28.0, translate(_("Date of issue")), fields.date),
        (24.0, translate(_("Scale")), fields.scale),
        (16.0, translate(_("Lang.")), translate(_("en"))),
        (26.0, translate(_("Sheet")), f"{fields.sheet}/{fields.sheets}"),
    )
    x = 0.0
    for width, name, text in bottom:
        cells.append(Cell(x, 30, width, 10, text, 3.5, name))
        x += width
    return TitleBlock(180.0, 40.0, tuple(cells))


def _joined(*texts: str) -> str:
    """Texts that are given, one after the other."""
    return " ".join(text for text in texts if text)
