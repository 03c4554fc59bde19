"""Pages of free-body diagrams: pictures in rows, the numbers of each below it, with scales and symbols."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from linkwright.core.quantity import fixed
from linkwright.errors import LinkwrightError
from linkwright.kinetostatics.forces import Forces
from linkwright.pictures.drawing import Sketch
from linkwright.pictures.picture import GRAPHICAL, indexed, name_runs, round_up, sentence_runs
from linkwright.pictures.svg import fold
from linkwright.plotting.diagrams.scaled_page import page
from linkwright.plotting.drawing.vectors import with_unit
from linkwright.plotting.free_bodies import (
    MILLIMETRE,
    SHORT,
    STUB,
    STYLES,
    Action,
    BodySketch,
    FreeBody,
    LinkShapes,
    body_sketch,
    free_bodies,
)
from linkwright.words import Translate, _, pgettext
from linkwright.words.message import link_label

#: Width of a cell, space between cells, height of a page's pictures, mm.
WIDE, SPACING, TALLEST = 82.0, 6.0, 216.0
#: Width and height, units of the paper, that a picture may take.
ROOM = (WIDE / MILLIMETRE, 260.0)
#: Sizes of letters and heights of lines: of titles, of tables.
TITLE, TITLE_LINE, SIZE, LINE = 13.0, 20.0, 10.5, 14.0
#: Right ends of a table's columns, shares of the width of a cell.
COLUMNS = (0.42, 0.61, 0.8, 1.0)
#: Significant digits of the largest number of a table; from here on forces are in kN.
DIGITS, KILO = 5, 1e5
#: What the arrows are.
ROLES = {
    "reaction": _("F, M: joint force, couple of a joint"),
    "weight": _("G: weight"),
    "inertia": _("F_I = −m·a, M_I = −J·α: inertia"),
    "friction": _("index f: friction"),
    "driver": _("index d: driver"),
    "load": _("loads by their names"),
}


@dataclass(frozen=True)
class Cell:
    """A picture with its title and its table, its upper left corner at the origin."""

    sketch: Sketch
    height: float
    body: FreeBody
    shortened: bool

    title: ClassVar[tuple[str, ...]] = ()
    width: ClassVar[float] = ROOM[0] + SPACING / MILLIMETRE

    def put(self, page: Sketch, left: float, top: float, head: int) -> float:
        """Puts it on the page; where it ends below."""
        page.put_sketch(self.sketch, (left, top))
        return top + self.height + SPACING / MILLIMETRE


def free_body_pages(
    forces: Forces,
    index: int,
    translate: Translate,
    language: str,
    *,
    of: Sequence[str] = (),
    columns: int = 2,
    tallest: float = TALLEST,
    first: float | None = None,
    heading: str = "",
) -> list[str]:
    """SVG text of every page, to be printed in its own size: the links at one position, those of ``of`` where given.

    ``tallest``: height of a page's pictures, mm, ``first``: of the first page's. Raises LinkwrightError where nothing
    acts on them.
    """
    bodies = [body for body in free_bodies(forces, index) if not of or body.link in of]
    if not bodies:
        raise LinkwrightError(_("no forces act on the moving links at this position", code="free_bodies.none"))
    shapes = LinkShapes(forces.motion, index)
    reach = max(shapes.reach(body.link) for body in bodies) or 1.0
    usual = round_up(reach / 46.0, GRAPHICAL)
    cells = [_cell(body_sketch(shapes, body, usual, ROOM), translate, language) for body in bodies]
    sheets = _sheets(cells, min(columns, len(cells)), tallest if first is None else first, tallest)
    return [_page(sheet, translate, heading) for sheet in sheets]


# one link -------------------------------------------------------------------------------------
def _cell(drawn: BodySketch, translate: Translate, language: str) -> Cell:
    body, sketch = drawn.body, Sketch()
    named = translate(_("{number} {link}", number=body.number, link=link_label(body.link, language)))
    sketch.text((0.0, TITLE), sentence_runs(named), "lw-legend lw-flow-call", TITLE)
    sketch.text((0.0, TITLE_LINE + SIZE + 2.0), sentence_runs(_scales(drawn)), size=SIZE)
    left, top, right, bottom = drawn.box
    across = 0.5 * (ROOM[0] - (right - left)) - left
    sketch.put_sketch(drawn, (across, 2 * TITLE_LINE + 4.0 - top), **{"data-link": body.link})
    height = _table(sketch, body, translate, 2 * TITLE_LINE + 12.0 + bottom - top)
    return Cell(sketch, height, body, drawn.shortened)


def _scales(drawn: BodySketch) -> str:
    """The scales of a picture: lengths, and forces where it has some."""
    lengths = f"μ_l = {drawn.metres * 1e3:.6g} mm/mm"
    return lengths if drawn.newtons is None else f"{lengths}, μ_F = {with_unit(drawn.newtons, 'N')}/mm"


# numbers --------------------------------------------------------------------------------------
def _table(found: Sketch, body: FreeBody, translate: Translate, y: float) -> float:
    """Components, sizes and directions of forces, and couples, below a height; where the table ends."""
    if body.forces:
        unit, factor = _force_unit(body.forces)
        head = (f"Fx / {unit}", f"Fy / {unit}", f"F / {unit}", translate(pgettext("free_bodies", "angle")) + " / °")
        y = _head(found, y, head)
        place = _places(max(each.size for each in body.forces) * factor)
        for each in body.forces:
            x_part, y_part = (float(part) * factor for part in each.force)
            angle = math.degrees(math.atan2(y_part, x_part)) % 360.0
            cells = (fixed(x_part, place), fixed(y_part, place), fixed(each.size * factor, place), f"{angle:.2f}")
            y = _row(found, y, each, cells)
        total = np.sum([each.force for each in body.forces], axis=0) * factor
        y = _line(found, y, translate(_("sum")), tuple(fixed(float(part), place) for part in total))
    if body.couples:
        y = _head(found, y, ("M / N·m",))
        place = _places(max(abs(each.torque) for each in body.couples))
        for each in body.couples:
            y = _row(found, y, each, (fixed(each.torque, place),))
    return _moments(found, y, body, translate)


def _moments(found: Sketch, y: float, body: FreeBody, translate: Translate) -> float:
    """The sum of all moments, about the mass centre; of forces through one point there is none."""
    moments = [each.moment(body.centre) for each in body.actions]
    arms = [each.size * math.dist(each.place, body.centre) for each in body.actions]
    largest = max(map(abs, [*moments, *arms]))
    if largest <= 0.0:
        return y
    value = f"{fixed(sum(moments), _places(largest))} N·m"
    text = translate(_("sum of moments: {value}", value=value))
    found.text((0.0, y + SIZE), sentence_runs(text), size=SIZE)
    return y + LINE


def _force_unit(forces: Sequence[Action]) -> tuple[str, float]:
    return ("kN", 1e-3) if max(each.size for each in forces) >= KILO else ("N", 1.0)


def _places(largest: float) -> int:
    """Decimals with which a number has DIGITS digits."""
    return max(0, min(9, DIGITS - 1 - math.floor(math.log10(largest))))


def _head(found: Sketch, y: float, texts: Sequence[str]) -> float:
    for share, text in zip(COLUMNS, texts, strict=False):
        found.text((share * ROOM[0], y + SIZE), sentence_runs(text), "lw-legend", SIZE, "end")
    found.line([(0.0, y + LINE), (ROOM[0], y + LINE)], "lw-rule")
    return y + LINE + 2.0


def _row(found: Sketch, y: float, action: Action, cells: Sequence[str]) -> float:
    """The row of an action; a long name takes several lines."""
    style = f"{STYLES[action.role]}-name"
    names = fold(action.letter, COLUMNS[0] * ROOM[0] - 62.0, SIZE)
    for line, text in enumerate(names):
        runs = indexed(text, action.index) if line == len(names) - 1 and action.index else name_runs(text)
        found.text((0.0, y + SIZE + LINE * line), runs, style, SIZE)
    _cells(found, y, cells)
    return y + LINE * len(names)


def _line(found: Sketch, y: float, name: str, cells: Sequence[str]) -> float:
    found.line([(0.0, y + 1.0), (ROOM[0], y + 1.0)], "lw-rule")
    found.text((0.0, y + SIZE + 3.0), sentence_runs(name), size=SIZE)
    _cells(found, y + 3.0, cells)
    return y + LINE + 6.0


def _cells(found: Sketch, y: float, cells: Sequence[str]) -> None:
    for share, text in zip(COLUMNS, cells, strict=False):
        found.text((share * ROOM[0], y + SIZE), sentence_runs(text), "lw-value", SIZE, "end")


# pages ----------------------------------------------------------------------------------------
def _sheets(cells: Sequence[Cell], columns: int, first: float, tallest: float) -> list[list[list[Cell]]]:
    """Pages of rows of cells; heights of the first page and of the others, mm."""
    rows = [list(cells[i : i + columns]) for i in range(0, len(cells), columns)]
    sheets: list[list[list[Cell]]] = [[]]
    used = 0.0
    for row in rows:
        height = max(cell.height for cell in row) + SPACING / MILLIMETRE
        if sheets[-1] and used + height > (first if len(sheets) == 1 else tallest) / MILLIMETRE:
            sheets.append([])
            used = 0.0
        sheets[-1].append(row)
        used += height
    return sheets


def _page(rows: Sequence[Sequence[Cell]], translate: Translate, heading: str) -> str:
    columns = max(map(len, rows))
    cells = [cell for row in rows for cell in row]
    wide = columns * Cell.width - SPACING / MILLIMETRE
    key = fold(translate(_("; ")).join(_key(cells, translate)), wide, SIZE)
    below = [[((sentence_runs(line), "lw-legend"), 0.0)] for line in key]
    return page(cells, columns, below, heading, translate(_("Free-body diagrams of the links"))).svg


def _key(cells: Sequence[Cell], translate: Translate) -> Iterator[str]:
    """What the symbols of a page mean, and what is not to scale."""
    roles = {each.role for cell in cells for each in cell.body.actions}
    for role in STYLES:
        if role in roles:
            yield translate(ROLES[role])
    if any(cell.shortened for cell in cells):
        yield translate(
            _(
                "dashed arrows are shorter than {minimum} mm to scale and drawn {drawn} mm long",
                minimum=f"{SHORT:g}",
                drawn=f"{STUB:g}",
            )
        )
