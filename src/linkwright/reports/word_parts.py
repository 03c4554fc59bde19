"""Parts of Word files that python-docx has no words for: formulas, fields, lists, lines, the cover."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from typing import Any
from xml.sax.saxutils import escape

from linkwright.equations.latex import ACCENTS, BRACES, INTEGRALS
from linkwright.equations.notation import Accent, Atom, Bracket, Fraction, Limits, Matrix, Node, Root, Row, Script
from linkwright.reports.document import Cover
from linkwright.reports.formula import large, relation
from linkwright.words.characters import printable

#: Width of the text, inches; size of the letters of tables, points; deepest level of lists.
TEXT, SMALL, DEEPEST = 6.69, 8, 8
#: Width and height of the picture of a cover, inches.
LOGO, TALL_LOGO = 2.7, 1.6
_DOTS = "•◦▪"
_LINE = '<w:{} w:val="single" w:sz="{}" w:space="0" w:color="auto"/>'


def listing(file: Any, start: int | None) -> int:
    """A list of its own, with numbers from ``start`` or with dots: its number in the file."""
    from docx.oxml import parse_xml
    from docx.oxml.ns import nsdecls, qn

    root = file.part.numbering_part.element
    kinds = root.findall(qn("w:abstractNum"))
    kind = 1 + max((int(each.get(qn("w:abstractNumId"))) for each in kinds), default=0)
    number = 1 + max((int(each.get(qn("w:numId"))) for each in root.findall(qn("w:num"))), default=0)
    levels = "".join(_level(i, start) for i in range(DEEPEST + 1))
    made = parse_xml(
        f'<w:abstractNum {nsdecls("w")} w:abstractNumId="{kind}">'
        f'<w:multiLevelType w:val="multilevel"/>{levels}</w:abstractNum>'
    )
    kinds[-1].addnext(made)
    own = f'<w:num {nsdecls("w")} w:numId="{number}"><w:abstractNumId w:val="{kind}"/></w:num>'
    root.append(parse_xml(own))
    return number


def _level(level: int, start: int | None) -> str:
    dotted = start is None
    form = "bullet" if dotted else "decimal"
    text = _DOTS[level % len(_DOTS)] if dotted else f"%{level + 1}."
    return (
        f'<w:lvl w:ilvl="{level}"><w:start w:val="{1 if start is None else start}"/><w:numFmt w:val="{form}"/>'
        f'<w:lvlText w:val="{text}"/><w:lvlJc w:val="left"/></w:lvl>'
    )


def as_item(line: Any, number: int, depth: int, width: float, indent: float) -> None:
    """Makes a paragraph an item of a list, its number within ``width`` inches before its text."""
    from docx.oxml import parse_xml
    from docx.oxml.ns import nsdecls
    from docx.shared import Inches, Pt

    level = min(depth, DEEPEST)
    asked = f'<w:numPr {nsdecls("w")}><w:ilvl w:val="{level}"/><w:numId w:val="{number}"/></w:numPr>'
    line._p.get_or_add_pPr().insert_element_before(
        parse_xml(asked), "w:suppressLineNumbers", "w:pBdr", "w:shd", "w:tabs", "w:spacing", "w:ind", "w:jc"
    )
    line.paragraph_format.left_indent = Inches(indent + width)
    line.paragraph_format.first_line_indent = Inches(-width)
    line.paragraph_format.space_after = Pt(2)


def ruled(line: Any) -> None:
    """Draws a line below a paragraph, across the page."""
    from docx.oxml import parse_xml
    from docx.oxml.ns import nsdecls

    border = f"<w:pBdr {nsdecls('w')}>{_LINE.format('bottom', 6)}</w:pBdr>"
    line._p.get_or_add_pPr().insert_element_before(parse_xml(border), "w:shd", "w:tabs", "w:spacing", "w:ind", "w:jc")


def add_cover(file: Any, cover: Cover) -> None:
    """The page before all others."""
    from docx.enum.text import WD_ALIGN_PARAGRAPH, WD_BREAK
    from docx.shared import Inches, Pt

    def line(text: str, size: float, above: float, *, bold: bool = False) -> Any:
        made = file.add_paragraph()
        made.alignment = WD_ALIGN_PARAGRAPH.CENTER
        made.paragraph_format.space_before = Pt(above)
        run = made.add_run(printable(text))
        run.font.size, run.bold = Pt(size), bold or None
        return made

    if cover.logo:
        from linkwright.pictures.svg import png

        made = line("", 12, 24)
        picture = made.runs[0].add_picture(io.BytesIO(png(cover.logo, width=800)), width=Inches(LOGO))
        if picture.height > Inches(TALL_LOGO):
            wide = int(picture.width * Inches(TALL_LOGO) / picture.height)
            picture.width, picture.height = wide, Inches(TALL_LOGO)
    for number, text in enumerate(cover.above):
        line(text, 16, 6 if number or cover.logo else 60)
    line(cover.kind, 28, 60, bold=True)
    line(cover.title, 19, 24, bold=True)
    _rows(file, cover.rows)
    last = line(cover.below, 13, 48)
    last.add_run().add_break(WD_BREAK.PAGE)


def _rows(file: Any, rows: tuple[tuple[str, str], ...]) -> None:
    """Names and values of a cover, a line below each value."""
    from docx.enum.table import WD_TABLE_ALIGNMENT
    from docx.enum.text import WD_ALIGN_PARAGRAPH
    from docx.oxml import parse_xml
    from docx.oxml.ns import nsdecls
    from docx.shared import Inches, Pt

    file.add_paragraph().paragraph_format.space_before = Pt(60)
    if not rows:
        return
    grid = file.add_table(rows=len(rows), cols=2)
    grid.alignment = WD_TABLE_ALIGNMENT.CENTER
    grid.autofit = False
    for (name, value), row in zip(rows, grid.rows, strict=True):
        for text, cell, width in zip((name, value), row.cells, (1.5, 3.2), strict=True):
            cell.width = Inches(width)
            cell.paragraphs[0].add_run(printable(text)).font.size = Pt(13)
        row.cells[1].paragraphs[0].alignment = WD_ALIGN_PARAGRAPH.CENTER
        below = f"<w:tcBorders {nsdecls('w')}>{_LINE.format('bottom', 4)}</w:tcBorders>"
        row.cells[1]._tc.get_or_add_tcPr().append(parse_xml(below))


def field_mark(line: Any, kind: str, asks: str = "") -> None:
    """The begin of a field that is renewed when the file is opened, up to its result, or the end of one."""
    from docx.oxml import parse_xml
    from docx.oxml.ns import nsdecls

    def run(inside: str) -> None:
        line._p.append(parse_xml(f"<w:r {nsdecls('w')}>{inside}</w:r>"))

    if kind == "end":
        run('<w:fldChar w:fldCharType="end"/>')
        return
    run('<w:fldChar w:fldCharType="begin" w:dirty="true"/>')
    run(f'<w:instrText xml:space="preserve"> {escape(asks)} </w:instrText>')
    run('<w:fldChar w:fldCharType="separate"/>')


def small(line: Any) -> None:
    """Sets the equations of a line in the size of tables."""
    from docx.oxml import parse_xml
    from docx.oxml.ns import nsdecls

    for run in line._p.iter(f"{{{SPACE}}}r"):
        look = parse_xml(f'<w:rPr {nsdecls("w")}><w:sz w:val="{2 * SMALL}"/></w:rPr>')
        run.insert(len(run) - 1, look)


def ruled_table(grid: Any, widths: list[float]) -> None:
    """Lines above and below a table and under its head; columns of these widths, inches."""
    from docx.enum.table import WD_TABLE_ALIGNMENT
    from docx.oxml import parse_xml
    from docx.oxml.ns import nsdecls
    from docx.shared import Inches

    grid.alignment = WD_TABLE_ALIGNMENT.CENTER
    grid.autofit = False
    borders = f"<w:tblBorders {nsdecls('w')}>{_LINE.format('top', 8)}{_LINE.format('bottom', 8)}</w:tblBorders>"
    grid._tbl.tblPr.append(parse_xml(borders))
    for column, wide in zip(grid.columns, widths, strict=True):
        column.width = Inches(wide)
    for number, row in enumerate(grid._tbl.tr_lst):
        row.get_or_add_trPr().append(parse_xml(f"<w:cantSplit {nsdecls('w')}/>"))
        for cell, wide in zip(row.tc_lst, widths, strict=True):
            cell.width = Inches(wide)
            if number == 0:
                below = f"<w:tcBorders {nsdecls('w')}>{_LINE.format('bottom', 6)}</w:tcBorders>"
                cell.get_or_add_tcPr().append(parse_xml(below))


SPACE = "http://schemas.openxmlformats.org/officeDocument/2006/math"
_SPACES = {",": "\u2009", ":": "\u2005", ";": "\u2004", " ": "\u2005", "quad": "\u2003", "qquad": "\u2003\u2003"}
_STYLES = {
    "bold": (("sty", "b"),),
    "slanted bold": (("sty", "bi"),),
    "script": (("scr", "script"), ("sty", "p")),
    "double": (("scr", "double-struck"), ("sty", "p")),
}
_ALIGN = {"<": "left", "^": "center", ">": "right"}


def equation(row: Row) -> Any:
    """The element ``m:oMath`` of a formula."""
    return _part("oMath", row)


def _element(name: str, *inside: Any, **attributes: str) -> Any:
    from lxml import etree

    found = etree.Element(f"{{{SPACE}}}{name}", nsmap={"m": SPACE})
    for key, value in attributes.items():
        found.set(f"{{{SPACE}}}{key}", value)
    found.extend(inside)
    return found


def _part(name: str, *nodes: Node | None) -> Any:
    return _element(name, *_elements(Row(tuple(each for each in nodes if each is not None))))


def _elements(node: Node) -> Iterator[Any]:
    match node:
        case Row(items):
            yield from _row(items)
        case Atom(kind, text):
            yield _run(kind, text)
        case Fraction(above, below):
            yield _element("f", _part("num", above), _part("den", below))
        case Root(inside, degree):
            look = [] if degree is not None else [_element("radPr", _element("degHide", val="1"))]
            yield _element("rad", *look, _part("deg", degree), _part("e", inside))
        case Script(base, below, None) if below is not None:
            yield _element("sSub", _part("e", base), _part("sub", below))
        case Script(base, None, above) if above is not None:
            yield _element("sSup", _part("e", base), _part("sup", above))
        case Script(base, below, above) if below is not None and above is not None:
            yield _element("sSubSup", _part("e", base), _part("sub", below), _part("sup", above))
        case Script(base):
            yield from _elements(base)
        case Limits(base, below, above):
            yield from _limits(base, below, above)
        case Accent(mark, inside):
            yield _accent(mark, inside)
        case Bracket(inside, left, right):
            sides = _element("dPr", _element("begChr", val=left), _element("endChr", val=right))
            yield _element("d", sides, _part("e", inside))
        case Matrix():
            yield _matrix(node)


def _row(items: Sequence[Node]) -> Iterator[Any]:
    """Formulas side by side; a sum or an integral holds what follows up to the next sum or equal sign."""
    rest = list(items)
    while rest:
        first = rest.pop(0)
        own = first if isinstance(first, Script) else Script(first)
        if not large(own.base):
            yield from _elements(first)
            continue
        applied: list[Node] = []
        while rest and not (relation(rest[0]) or (applied and rest[0] in _SUMMED)):
            applied.append(rest.pop(0))
        assert isinstance(own.base, Atom)
        place = "subSup" if own.base.text in INTEGRALS else "undOvr"
        hidden = [
            _element(name, val="1") for name, part in (("subHide", own.below), ("supHide", own.above)) if part is None
        ]
        look = _element("naryPr", _element("chr", val=own.base.text), _element("limLoc", val=place), *hidden)
        yield _element("nary", look, _part("sub", own.below), _part("sup", own.above), _part("e", *applied))


_SUMMED = (Atom("sign", "+"), Atom("sign", "−"), Atom("sign", ","), Atom("sign", ";"))


def _limits(base: Node, below: Node | None, above: Node | None) -> Iterator[Any]:
    found = list(_elements(base))
    for name, part in (("limLow", below), ("limUpp", above)):
        if part is not None:
            found = [_element(name, _element("e", *found), _part("lim", part))]
    yield from found


def _accent(mark: str, inside: Node) -> Any:
    if mark == "overline":
        return _element("bar", _element("barPr", _element("pos", val="top")), _part("e", inside))
    if mark in BRACES:
        place = "top" if mark == "overbrace" else "bot"
        look = [_element("chr", val=BRACES[mark]), _element("pos", val=place)]
        if place == "top":
            look.append(_element("vertJc", val="bot"))
        return _element("groupChr", _element("groupChrPr", *look), _part("e", inside))
    return _element("acc", _element("accPr", _element("chr", val=ACCENTS[mark])), _part("e", inside))


def _matrix(matrix: Matrix) -> Any:
    """A matrix between its delimiters; equations below each other without gaps between their columns."""
    number = len(matrix.rows[0])
    aligned = matrix.align == "="
    sides = [("right", "left")[i % 2] if aligned else _ALIGN[matrix.align] for i in range(number)]
    if aligned and number == 1:
        sides = ["left"]
    columns = [
        _element("mc", _element("mcPr", _element("count", val="1"), _element("mcJc", val=each))) for each in sides
    ]
    gaps = [_element("cGpRule", val="3"), _element("cGp", val="0")] if aligned else []
    look = _element("mPr", *gaps, _element("mcs", *columns))
    rows = [_element("mr", *(_part("e", cell) for cell in row)) for row in matrix.rows]
    found = _element("m", look, *rows)
    if not (matrix.left or matrix.right):
        return found
    ends = _element("dPr", _element("begChr", val=matrix.left), _element("endChr", val=matrix.right))
    return _element("d", ends, _element("e", found))


def _run(kind: str, text: str) -> Any:
    written = _element("t")
    written.text = _SPACES[text] if kind == "space" else text
    written.set("{http://www.w3.org/XML/1998/namespace}space", "preserve")
    if kind in ("upright", "space", "open", "close"):
        return _element("r", _element("rPr", _element("nor")), written)
    if kind in _STYLES:
        return _element("r", _element("rPr", *(_element(k, val=v) for k, v in _STYLES[kind])), written)
    return _element("r", written)
