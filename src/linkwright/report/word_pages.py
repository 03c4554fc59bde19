"""A report as a Word file: headings, equations and tables that can be edited, pictures."""

from __future__ import annotations

import io
from typing import Any
from xml.sax.saxutils import escape

from linkwright.errors import LinkwrightError
from linkwright.report.document import (
    Block,
    Code,
    Document,
    Figure,
    Formula,
    Heading,
    Numbers,
    Paragraph,
    Source,
    Table,
    longest_part,
    plain,
    spans,
)
from linkwright.report.formula import Atom, Row, formula
from linkwright.report.formula_lines import set_lines
from linkwright.report.word_formula import SPACE, equation
from linkwright.words.characters import cells, printable

#: Width of the text, inches; pictures' dots per inch.
TEXT, DOTS = 6.69, 160.0
#: Width of a line of formulas, and of a left side beyond which the right side begins a new line, em.
LINE, LEFT = 33.0, 9.0
#: Levels of headings in the list of contents.
LISTED = 2
#: Width of a character of a table, inches.
LETTER = 0.062
#: What the margins of a cell take, inches; size of the letters of tables, points.
GAP, SMALL = 0.22, 8
#: Fonts by language: of Latin letters, of Chinese characters.
FONTS = ("Cambria", "SimSun")
#: The style of listings and its font.
CODE, MONOSPACED = "Code", "Consolas"


def word(document: Document) -> bytes:
    """The Word file of a document; raises LinkwrightError where python-docx is missing."""
    try:
        import docx
    except ImportError:
        raise LinkwrightError("report.needs_word") from None
    writer = _Writer(document, docx.Document())
    return writer.content()


class _Writer:
    """Adds block after block."""

    def __init__(self, document: Document, file: Any) -> None:
        self.document, self.file = document, file
        self.numbers: Numbers = document.number()
        self.mark = 0

    def content(self) -> bytes:
        self._page()
        self.file.add_heading(self.document.title, 0)
        for line in self.document.lines:
            self.file.add_paragraph(line)
        if self.document.contents:
            self._contents()
        for index, block in enumerate(self.document.blocks):
            self._block(index, block)
        self.file.core_properties.title = self.document.title[:255]
        self.file.core_properties.author = ""
        stream = io.BytesIO()
        self.file.save(stream)
        return stream.getvalue()

    def _page(self) -> None:
        from docx.oxml.ns import qn
        from docx.shared import Mm, Pt

        section = self.file.sections[0]
        section.page_width, section.page_height = Mm(210), Mm(297)
        section.left_margin = section.right_margin = Mm(20)
        section.top_margin = section.bottom_margin = Mm(22)
        for name in ("Normal", "Title", "Heading 1", "Heading 2", "Heading 3", "Heading 4", "Caption"):
            style = self.file.styles[name]
            style.font.name = FONTS[0]
            style.element.get_or_add_rPr().get_or_add_rFonts().set(qn("w:eastAsia"), FONTS[1])
        self.file.styles["Normal"].font.size = Pt(10.5)

    def _contents(self) -> None:
        """The list of sections: a field that Word renews, with entries that every program shows."""
        from docx.shared import Inches, Pt

        head = self.file.add_paragraph()
        head.add_run(self.document.say("report.contents")).bold = True
        headings = [(i, block) for i, block in enumerate(self.document.blocks)
                    if isinstance(block, Heading) and block.level <= LISTED]  # fmt: skip
        line = head
        for index, block in headings:
            line = self.file.add_paragraph()
            line.paragraph_format.left_indent = Inches(0.25 * (block.level - 1))
            line.paragraph_format.space_after = Pt(0)
            if index == headings[0][0]:
                _mark(line, "begin", f'TOC \\o "1-{LISTED}" \\h \\z \\u')
            self._entry(line, index, block)
        if headings:
            _mark(line, "end")

    def _entry(self, line: Any, index: int, block: Heading) -> None:
        """A section's number and title, leading there; its page is added where Word renews the field."""
        from docx.oxml.ns import qn

        before = len(line._p)
        self._inline(line, f"{self.numbers.before(index)}{block.text}")
        link = line._p.makeelement(qn("w:hyperlink"), {qn("w:anchor"): f"b{index}"})
        for part in line._p[before:]:
            link.append(part)
        line._p.append(link)

    def _block(self, index: int, block: Block) -> None:
        match block:
            case Heading():
                shown = self.file.add_heading(level=block.level)
                shown.add_run(self.numbers.before(index))
                self._inline(shown, block.text)
                self._bookmark(shown, index)
            case Paragraph():
                style = {"bullet": "List Bullet", "missing": "Intense Quote", "note": "Intense Quote"}
                line = self.file.add_paragraph(style=style.get(block.kind))
                line.paragraph_format.keep_with_next = block.kind == "lead" or self.document.leads(index)
                self._inline(line, block.text)
            case Formula():
                self._formula(index, block)
            case Table():
                self._table(index, block)
            case Figure():
                self._figure(index, block)
            case Code():
                self._code(index, block)
            case Source():
                self.file.add_paragraph(block.text)

    def _formula(self, index: int, block: Formula) -> None:
        from docx.enum.text import WD_TAB_ALIGNMENT
        from docx.shared import Inches

        line = self.file.add_paragraph()
        line.paragraph_format.left_indent = Inches(0.3)
        line.paragraph_format.tab_stops.add_tab_stop(Inches(TEXT), WD_TAB_ALIGNMENT.RIGHT)
        line.paragraph_format.keep_together = True
        for row in _lines(block):
            if line._p.findall(f"{{{SPACE}}}oMath"):
                line.add_run().add_break()
            line._p.append(equation(row))
        number = self.numbers.of.get(index, "")
        if number:
            line.add_run(f"\t({number})")
            self._bookmark(line, index)

    def _caption(self, index: int, text: str) -> None:
        from docx.enum.text import WD_ALIGN_PARAGRAPH

        line = self.file.add_paragraph(style="Caption")
        line.alignment = WD_ALIGN_PARAGRAPH.CENTER
        line.paragraph_format.keep_with_next = isinstance(self.document.blocks[index], Table | Code)
        line.add_run(f"{self.numbers.name(index)}  ")
        self._inline(line, text)
        self._bookmark(line, index)

    def _table(self, index: int, block: Table) -> None:
        from docx.enum.text import WD_ALIGN_PARAGRAPH
        from docx.oxml.ns import qn
        from docx.shared import Pt

        sides = {"<": WD_ALIGN_PARAGRAPH.LEFT, ">": WD_ALIGN_PARAGRAPH.RIGHT, "^": WD_ALIGN_PARAGRAPH.CENTER}
        self._caption(index, block.caption)
        grid = self.file.add_table(rows=1 + len(block.rows), cols=len(block.head))
        _ruled(grid, _widths(block))
        align = block.align or "<" * len(block.head)
        for number, (texts, row) in enumerate(zip((block.head, *block.rows), grid._tbl.tr_lst, strict=True)):
            for text, cell, mark in zip(texts, row.tc_lst, align, strict=True):
                line = self._cell(cell)
                line.alignment = sides[mark]
                line.paragraph_format.space_after = Pt(0)
                self._inline(line, text)
                _small(line)
                for run in line.runs:
                    run.font.size = Pt(SMALL)
                    run.bold = True if number == 0 else run.bold
        repeated = grid.rows[0]._tr.get_or_add_trPr()
        repeated.append(repeated.makeelement(qn("w:tblHeader"), {}))
        self.file.add_paragraph()

    def _cell(self, cell: Any) -> Any:
        from docx.text.paragraph import Paragraph as Line

        return Line(cell.p_lst[0], self.file)

    def _figure(self, index: int, block: Figure) -> None:
        from docx.enum.text import WD_ALIGN_PARAGRAPH
        from docx.shared import Inches, Mm

        from linkwright.plot.svg.render import png

        line = self.file.add_paragraph()
        line.alignment = WD_ALIGN_PARAGRAPH.CENTER
        line.paragraph_format.keep_with_next = True
        for svg, share in block.pictures:
            wide = TEXT * min(share, 1.0)
            picture = line.add_run().add_picture(
                io.BytesIO(png(svg, width=int(wide * DOTS))), width=Inches(wide)
            )
            tallest = Mm(block.tallest)
            if picture.height > tallest:
                picture.width, picture.height = int(picture.width * tallest / picture.height), tallest
        self._caption(index, block.caption)

    def _code(self, index: int, block: Code) -> None:
        """The lines of a listing, each a paragraph, so that a long one breaks over pages."""
        if block.caption:
            self._caption(index, block.caption)
        for text in block.text.expandtabs(4).rstrip("\n").split("\n"):
            self.file.add_paragraph(printable(text), style=self._code_style())

    def _code_style(self) -> Any:
        """The paragraph style of listings: letters of one width, lines without gaps."""
        from docx.enum.style import WD_STYLE_TYPE
        from docx.oxml import parse_xml
        from docx.oxml.ns import nsdecls, qn
        from docx.shared import Pt

        styles = self.file.styles
        if CODE in styles:
            return styles[CODE]
        style = styles.add_style(CODE, WD_STYLE_TYPE.PARAGRAPH)
        style.base_style = styles["Normal"]
        style.font.name, style.font.size = MONOSPACED, Pt(8.5)
        style.element.get_or_add_rPr().get_or_add_rFonts().set(qn("w:eastAsia"), FONTS[1])
        style.paragraph_format.space_before = style.paragraph_format.space_after = Pt(0)
        style.paragraph_format.line_spacing = 1.0
        shade = f'<w:shd {nsdecls("w")} w:val="clear" w:color="auto" w:fill="F4F4F4"/>'
        style.element.get_or_add_pPr().insert_element_before(parse_xml(shade), "w:spacing", "w:ind", "w:jc")
        return style

    def _inline(self, line: Any, text: str) -> None:
        for kind, part in spans(text):
            if kind == "formula":
                line._p.append(equation(formula(part)))
            elif kind == "reference" and part in self.numbers.labels:
                self._link(line, self.numbers.labels[part])
            else:
                run = line.add_run(printable(part))
                run.bold = True if kind == "strong" else None

    def _link(self, line: Any, index: int) -> None:
        from docx.oxml.ns import qn

        link = line._p.makeelement(qn("w:hyperlink"), {qn("w:anchor"): f"b{index}"})
        run = line.add_run(self.numbers.name(index))
        link.append(run._r)
        line._p.append(link)

    def _bookmark(self, line: Any, index: int) -> None:
        from docx.oxml.ns import qn

        self.mark += 1
        number = str(self.mark)
        begin = line._p.makeelement(qn("w:bookmarkStart"), {qn("w:id"): number, qn("w:name"): f"b{index}"})
        end = line._p.makeelement(qn("w:bookmarkEnd"), {qn("w:id"): number})
        line._p.append(begin)
        line._p.append(end)


def _lines(block: Formula) -> list[Row]:
    """Lines of an equation, moved to the right where they go on from the one before."""
    found: list[Row] = []
    for line in set_lines([formula(side) for side in block.sides], LINE, LEFT):
        if line.place == "right":
            found[-1] = Row((*found[-1].items, *line.row.items))
            continue
        moved = {"left": 0, "below": 1}.get(line.place, 2)
        found.append(Row((*[Atom("space", "quad")] * moved, *line.row.items)))
    return found


def _widths(block: Table) -> list[float]:
    """Widths of columns, inches: as their longest parts ask for, together no wider than the text."""
    asked = [
        GAP + LETTER * max(longest_part(row[i]) for row in (block.head, *block.rows))
        for i in range(len(block.head))
    ]
    whole = [
        GAP + LETTER * max(cells(plain(row[i])) for row in (block.head, *block.rows))
        for i in range(len(block.head))
    ]
    spare = max(TEXT - sum(asked), 0.0)
    wanted = sum(w - a for w, a in zip(whole, asked, strict=True) if w > a)
    more = min(1.0, spare / wanted) if wanted else 0.0
    found = [a + more * max(w - a, 0.0) for w, a in zip(whole, asked, strict=True)]
    shrink = min(1.0, TEXT / sum(found))
    return [shrink * each for each in found]


def _mark(line: Any, kind: str, asks: str = "") -> None:
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


def _small(line: Any) -> None:
    """Sets the equations of a line in the size of tables."""
    from docx.oxml import parse_xml
    from docx.oxml.ns import nsdecls

    for run in line._p.iter(f"{{{SPACE}}}r"):
        look = parse_xml(f'<w:rPr {nsdecls("w")}><w:sz w:val="{2 * SMALL}"/></w:rPr>')
        run.insert(len(run) - 1, look)


def _ruled(grid: Any, widths: list[float]) -> None:
    """Lines above and below a table and under its head; columns of these widths, inches."""
    from docx.enum.table import WD_TABLE_ALIGNMENT
    from docx.oxml import parse_xml
    from docx.oxml.ns import nsdecls
    from docx.shared import Inches

    grid.alignment = WD_TABLE_ALIGNMENT.CENTER
    grid.autofit = False
    line = '<w:{} w:val="single" w:sz="{}" w:space="0" w:color="auto"/>'
    borders = f"<w:tblBorders {nsdecls('w')}>{line.format('top', 8)}{line.format('bottom', 8)}</w:tblBorders>"
    grid._tbl.tblPr.append(parse_xml(borders))
    for column, wide in zip(grid.columns, widths, strict=True):
        column.width = Inches(wide)
    for number, row in enumerate(grid._tbl.tr_lst):
        row.get_or_add_trPr().append(parse_xml(f"<w:cantSplit {nsdecls('w')}/>"))
        for cell, wide in zip(row.tc_lst, widths, strict=True):
            cell.width = Inches(wide)
            if number == 0:
                below = f"<w:tcBorders {nsdecls('w')}>{line.format('bottom', 6)}</w:tcBorders>"
                cell.get_or_add_tcPr().append(parse_xml(below))
