"""Title blocks: after GB/T 10609.1, the short one of schools, and after ISO 7200; each is made of cells."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from linkwright.pictures.fonts import needs_chinese
from linkwright.pictures.picture import MIN_TEXT, TEXT, Box, Picture, as_runs, runs_width
from linkwright.words import Translate, _, pgettext

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


def gb_block(fields: Fields, say: Translate) -> TitleBlock:
    """180 × 56 mm: changes, signatures, others, name and code, after the example of GB/T 10609.1-2008."""
    return TitleBlock(180.0, 56.0, (*_gb_changes(say), *_gb_signatures(fields, say), *_gb_rest(fields, say)))


def _gb_changes(say: Translate) -> Iterator[Cell]:
    heads = (_("Mark"), pgettext("sheet", "No."), _("Zone"), _("Change"), _("Signed"), _("Date"))
    x = 0.0
    for width, head in zip((10, 10, 16, 16, 12, 16), heads, strict=True):
        for row in range(3):
            yield Cell(x, 7.0 * row, width, 7.0)
        yield Cell(x, 21.0, width, 7.0, say(head), 3.5 if width > 10 else 2.5)
        x += width
    yield Cell(0, 0, 80, 28, thick=True)


def _gb_signatures(fields: Fields, say: Translate) -> Iterator[Cell]:
    people = (
        (_("Drawn"), fields.student, fields.date if fields.student else ""),
        (pgettext("sheet", "Adviser"), fields.adviser, ""),
        (_("Checked"), fields.checker, ""),
        (_("Process"), "", ""),
    )
    others = (_("Stand."), None, None, _("Appr."))
    for row, (head, name, date) in enumerate(people):
        y = 28.0 + 7.0 * row
        yield Cell(0, y, 12, 7, say(head), 3.5)
        yield Cell(12, y, 12, 7, name, 3.5)
        yield Cell(24, y, 16, 7, date, 3.5)
        yield Cell(40, y, 12, 7, say(other) if (other := others[row]) else "", 3.5)
        yield Cell(52, y, 12, 7)
        yield Cell(64, y, 16, 7)
    yield Cell(0, 28, 80, 28, thick=True)


def _gb_rest(fields: Fields, say: Translate) -> Iterator[Cell]:
    yield Cell(80, 0, 50, 28, fields.title, 5.0, thick=True)
    yield Cell(80, 28, 26, 7, say(_("Stage")), 3.5)
    yield Cell(106, 28, 12, 7, say(_("Mass")), 3.5)
    yield Cell(118, 28, 12, 7, say(_("Scale")), 3.5)
    for k in range(4):
        yield Cell(80 + 6.5 * k, 35, 6.5, 12)
    yield Cell(106, 35, 12, 12)
    yield Cell(118, 35, 12, 12, fields.scale, 3.5)
    yield Cell(80, 47, 50, 9, say(_("Sheet {sheet} of {sheets}", sheet=fields.sheet, sheets=fields.sheets)), 3.5)
    yield Cell(80, 28, 50, 28, thick=True)
    yield Cell(130, 0, 50, 18, _joined(fields.school, fields.faculty), 5.0, thick=True)
    yield Cell(130, 18, 50, 20, fields.drawing, 7.0, thick=True)
    yield Cell(130, 38, 50, 9, fields.number or fields.student_number, 5.0, thick=True)
    yield Cell(130, 47, 50, 9, _joined(fields.class_name, fields.student_number if fields.number else ""), thick=True)


def school_block(fields: Fields, say: Translate) -> TitleBlock:
    """140 × 40 mm: drawing, scale, number, class, persons, title of the task, school, sheet of sheets."""
    cells = [Cell(0, 0, 60, 16, fields.drawing, 7.0)]
    right = (
        (_("Scale"), fields.scale, pgettext("sheet.block.number", "No."), fields.number),
        (_("Class"), fields.class_name, _("Id. no."), fields.student_number),
    )
    for row, (head, text, other, value) in enumerate(right):
        y = 8.0 * row
        cells += [Cell(60, y, 15, 8, say(head)), Cell(75, y, 25, 8, text)]
        cells += [Cell(100, y, 15, 8, say(other)), Cell(115, y, 25, 8, value)]
    people = (
        (_("Drawn"), fields.student, fields.date),
        (pgettext("sheet", "Adviser"), fields.adviser, ""),
        (_("Checked"), fields.checker, ""),
    )
    for row, (head, name, date) in enumerate(people):
        y = 16.0 + 8.0 * row
        cells += [Cell(0, y, 18, 8, say(head)), Cell(18, y, 22, 8, name), Cell(40, y, 20, 8, date)]
    cells += [
        Cell(60, 16, 80, 8, fields.title, 5.0),
        Cell(60, 24, 80, 8, _joined(fields.school, fields.faculty), 5.0),
        Cell(60, 32, 80, 8, say(_("Sheet {sheet} of {sheets}", sheet=fields.sheet, sheets=fields.sheets))),
    ]
    return TitleBlock(140.0, 40.0, tuple(cells))


def iso_block(fields: Fields, say: Translate) -> TitleBlock:
    """180 × 40 mm with the fields of ISO 7200, and the scale."""

    top = (
        (say(_("Responsible dept.")), _joined(fields.faculty, fields.class_name)),
        (say(_("Technical reference")), fields.student_number),
        (say(_("Created by")), fields.student),
        (say(_("Approved by")), _joined(fields.adviser, fields.checker)),
    )
    cells = [Cell(45.0 * k, 0, 45, 10, text, 3.5, name) for k, (name, text) in enumerate(top)]
    cells += [
        Cell(0, 10, 72, 20, fields.school, 5.0, say(_("Legal owner"))),
        Cell(72, 10, 108, 20, f"{fields.title}\n{fields.drawing}", 5.0, say(_("Title, supplementary title"))),
    ]
    bottom = (
        (40.0, say(_("Document type")), say(pgettext("sheet", "Kinematic drawing"))),
        (46.0, say(_("Identification number")), fields.number),
        (28.0, say(_("Date of issue")), fields.date),
        (24.0, say(_("Scale")), fields.scale),
        (16.0, say(_("Lang.")), say(_("en"))),
        (26.0, say(_("Sheet")), f"{fields.sheet}/{fields.sheets}"),
    )
    x = 0.0
    for width, name, text in bottom:
        cells.append(Cell(x, 30, width, 10, text, 3.5, name))
        x += width
    return TitleBlock(180.0, 40.0, tuple(cells))


def _joined(*texts: str) -> str:
    """Texts that are given, one after the other."""
    return " ".join(text for text in texts if text)
