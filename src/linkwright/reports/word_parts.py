"""Parts of Word files that python-docx has no words for: fields, lists, lines, the cover."""

from __future__ import annotations

import io
from typing import Any
from xml.sax.saxutils import escape

from linkwright.reports.document import Cover
from linkwright.reports.word_formula import SPACE
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
