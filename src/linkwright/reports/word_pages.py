"""A report as a Word file: headings, equations and tables that can be edited, pictures."""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from itertools import count
from typing import Any

from linkwright.equations.notation import Atom, Row
from linkwright.errors import LinkwrightError
from linkwright.reports.document import (
    Block,
    Code,
    Document,
    Figure,
    Formula,
    Heading,
    Listed,
    Numbers,
    Paragraph,
    Quoted,
    Rule,
    Source,
    Sources,
    Span,
    Table,
    longest_part,
    plain,
    spans,
)
from linkwright.reports.formula import set_lines
from linkwright.reports.word_parts import (
    SMALL,
    SPACE,
    TEXT,
    add_cover,
    as_item,
    equation,
    field_mark,
    listing,
    ruled,
    ruled_table,
    small,
)
from linkwright.words import _
from linkwright.words.characters import cells, printable

#: Dots per inch of pictures.
DOTS = 160.0
#: Width of a line of formulas, and of a left side beyond which the right side begins a new line, em.
LINE, LEFT = 33.0, 9.0
#: Levels of headings in the list of contents.
LISTED = 2
#: Width of a character of a table, inches.
LETTER = 0.062
#: What the margins of a cell take, what an item of a list, a quotation and the lines of a source are set in, inches.
GAP, LEVEL, QUOTED, HANGING = 0.22, 0.25, 0.35, 0.4
#: Fonts by language: of Latin letters, of Chinese characters.
FONTS = ("Cambria", "SimSun")
#: The style of listings and its font.
CODE, MONOSPACED = "Code", "Consolas"


def word(document: Document) -> bytes:
    """The Word file of a document; raises LinkwrightError where python-docx is missing."""
    try:
        import docx
    except ImportError:
        raise LinkwrightError(
            _(
                'Word files need python-docx; install it with: pip install "linkwright[report]"',
                code="report.needs_word",
            )
        ) from None
    writer = _Writer(document, docx.Document())
    return writer.content()


class _Writer:
    """Adds block after block; ``indent`` of blocks within a list or a quotation, inches."""

    def __init__(self, document: Document, file: Any) -> None:
        self.document, self.file = document, file
        self.numbers: Numbers = document.number()
        self.places = count()
        self.mark, self.indent, self.depth = 0, 0.0, 0

    def content(self) -> bytes:
        self._page()
        if self.document.cover is not None:
            add_cover(self.file, self.document.cover)
        else:
            self.file.add_heading(self.document.title, 0)
            for line in self.document.lines:
                self.file.add_paragraph(line)
        if self.document.contents:
            self._contents()
            if self.document.cover is not None:
                self.file.add_page_break()
        self._blocks(self.document.blocks)
        self.file.core_properties.title = self.document.title[:255]
        self.file.core_properties.author = ""
        stream = io.BytesIO()
        self.file.save(stream)
        return stream.getvalue()

    def _blocks(self, blocks: Iterable[Block]) -> None:
        for block in blocks:
            self._block(next(self.places), block)

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
        head.add_run(self.document.translate(_("Contents"))).bold = True
        headings = [
            (i, block)
            for i, block in enumerate(self.numbers.blocks)
            if isinstance(block, Heading) and block.level <= LISTED
        ]
        line = head
        for index, block in headings:
            line = self.file.add_paragraph()
            line.paragraph_format.left_indent = Inches(0.25 * (block.level - 1))
            line.paragraph_format.space_after = Pt(0)
            if index == headings[0][0]:
                field_mark(line, "begin", f'TOC \\o "1-{LISTED}" \\h \\z \\u')
            self._entry(line, index, block)
        if headings:
            field_mark(line, "end")

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
                self._bookmark(shown, f"b{index}")
            case Paragraph():
                self._paragraph(index, block)
            case Formula():
                self._formula(index, block)
            case Table():
                self._table(index, block)
            case Figure():
                self._figure(index, block)
            case Code():
                self._code(index, block)
            case Listed():
                self._list(block)
            case Quoted():
                with self._moved(QUOTED):
                    self._blocks(block.blocks)
            case Rule():
                ruled(self.file.add_paragraph())
            case Sources():
                self._sources(block)
            case Source():
                self.file.add_paragraph(printable(block.text))

    def _paragraph(self, index: int, block: Paragraph) -> Any:
        from docx.shared import Inches, Pt

        style = {"bullet": "List Bullet", "missing": "Intense Quote", "note": "Intense Quote"}.get(block.kind)
        line = self.file.add_paragraph(style=style)
        leads = not self.indent and index >= 0 and self.numbers.leads(index)
        line.paragraph_format.keep_with_next = block.kind == "lead" or leads
        if self.indent:
            line.paragraph_format.left_indent = Inches(self.indent)
        self._inline(line, block.text)
        if block.kind == "footnote":
            for run in line.runs:
                run.font.size = Pt(SMALL + 1)
        return line

    @contextmanager
    def _moved(self, inches: float) -> Iterator[None]:
        self.indent += inches
        yield
        self.indent -= inches

    def _list(self, block: Listed) -> None:
        """Items with numbers or dots of their own list; what else an item holds is set in as its text is."""
        number = listing(self.file, block.start)
        for item in block.items:
            first, *rest = item or (Paragraph(""),)
            own = first if isinstance(first, Paragraph) else Paragraph("")
            line = self._paragraph(next(self.places) if item and own is first else -1, own)
            as_item(line, number, self.depth, LEVEL, self.indent)
            self.depth += 1
            with self._moved(LEVEL):
                self._blocks(rest if own is first else item)
            self.depth -= 1

    def _sources(self, block: Sources) -> None:
        from docx.shared import Inches

        entries = dict(sorted(block.entries, key=lambda each: self.numbers.sources[each[0]]))
        for key, text in entries.items():
            number = self.numbers.sources[key]
            line = self.file.add_paragraph()
            line.paragraph_format.left_indent = Inches(HANGING)
            line.paragraph_format.first_line_indent = Inches(-HANGING)
            line.add_run(f"[{number}]\t")
            line.paragraph_format.tab_stops.add_tab_stop(Inches(HANGING))
            self._inline(line, text)
            self._bookmark(line, f"s{number}")

    def _formula(self, index: int, block: Formula) -> None:
        from docx.enum.text import WD_TAB_ALIGNMENT
        from docx.shared import Inches

        line = self.file.add_paragraph()
        line.paragraph_format.left_indent = Inches(0.3 + self.indent)
        line.paragraph_format.tab_stops.add_tab_stop(Inches(TEXT), WD_TAB_ALIGNMENT.RIGHT)
        line.paragraph_format.keep_together = True
        for row in _lines(block):
            if line._p.findall(f"{{{SPACE}}}oMath"):
                line.add_run().add_break()
            line._p.append(equation(row))
        number = self.numbers.of.get(index, "")
        if number:
            line.add_run(f"\t({number})")
            self._bookmark(line, f"b{index}")

    def _caption(self, index: int, text: str) -> None:
        from docx.enum.text import WD_ALIGN_PARAGRAPH

        line = self.file.add_paragraph(style="Caption")
        line.alignment = WD_ALIGN_PARAGRAPH.CENTER
        line.paragraph_format.keep_with_next = isinstance(self.numbers.blocks[index], Table | Code)
        line.add_run(f"{self.numbers.name(index)}  ")
        self._inline(line, text)
        self._bookmark(line, f"b{index}")

    def _table(self, index: int, block: Table) -> None:
        from docx.enum.text import WD_ALIGN_PARAGRAPH
        from docx.oxml.ns import qn
        from docx.shared import Pt

        sides = {"<": WD_ALIGN_PARAGRAPH.LEFT, ">": WD_ALIGN_PARAGRAPH.RIGHT, "^": WD_ALIGN_PARAGRAPH.CENTER}
        if block.caption:
            self._caption(index, block.caption)
        grid = self.file.add_table(rows=1 + len(block.rows), cols=len(block.head))
        ruled_table(grid, _widths(block))
        align = block.align or "<" * len(block.head)
        for number, (texts, row) in enumerate(zip((block.head, *block.rows), grid._tbl.tr_lst, strict=True)):
            for text, cell, mark in zip(texts, row.tc_lst, align, strict=True):
                line = self._cell(cell)
                line.alignment = sides[mark]
                line.paragraph_format.space_after = Pt(0)
                self._inline(line, text)
                small(line)
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

        from linkwright.pictures.svg import png

        line = self.file.add_paragraph()
        line.alignment = WD_ALIGN_PARAGRAPH.CENTER
        line.paragraph_format.keep_with_next = bool(block.caption)
        for svg, share in block.pictures:
            wide = TEXT * min(share, 1.0)
            picture = line.add_run().add_picture(io.BytesIO(png(svg, width=int(wide * DOTS))), width=Inches(wide))
            tallest = Mm(block.tallest)
            if picture.height > tallest:
                picture.width, picture.height = int(picture.width * tallest / picture.height), tallest
        if block.caption:
            self._caption(index, block.caption)

    def _code(self, index: int, block: Code) -> None:
        """The lines of a listing, each a paragraph, so that a long one breaks over pages."""
        from docx.shared import Inches

        if block.caption:
            self._caption(index, block.caption)
        for text in block.text.expandtabs(4).rstrip("\n").split("\n"):
            line = self.file.add_paragraph(printable(text), style=self._code_style())
            if self.indent:
                line.paragraph_format.left_indent = Inches(self.indent)

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
        for span in spans(text):
            if span.formula:
                line._p.append(equation(span.formula))
                continue
            if span.kind == "break":
                line.add_run().add_break()
                continue
            shown, target = self.numbers.shown(span)
            run = line.add_run(printable(shown))
            self._look(run, span)
            if target:
                self._link(line, run, target)

    def _look(self, run: Any, span: Span) -> None:
        from docx.oxml.ns import qn

        run.bold = True if "strong" in span.styles else None
        run.italic = True if "emphasis" in span.styles else None
        run.font.superscript = True if "raised" in span.styles else None
        run.font.strike = True if "struck" in span.styles else None
        if span.kind == "code":
            run.font.name = MONOSPACED
        if "emphasis" in span.styles and any("\u2e80" <= c <= "\u9fff" for c in span.text):
            run.italic = None
            mark = run._r.makeelement(qn("w:em"), {qn("w:val"): "underDot"})
            run._r.get_or_add_rPr().append(mark)

    def _link(self, line: Any, run: Any, target: str) -> None:
        from docx.opc.constants import RELATIONSHIP_TYPE
        from docx.oxml.ns import qn
        from docx.shared import RGBColor

        if target[0] == "#":
            attributes = {qn("w:anchor"): target[1:]}
        else:
            attributes = {qn("r:id"): self.file.part.relate_to(target, RELATIONSHIP_TYPE.HYPERLINK, is_external=True)}
            run.font.color.rgb, run.font.underline = RGBColor(0x0B, 0x57, 0xA4), True
        link = line._p.makeelement(qn("w:hyperlink"), attributes)
        link.append(run._r)
        line._p.append(link)

    def _bookmark(self, line: Any, name: str) -> None:
        from docx.oxml.ns import qn

        self.mark += 1
        number = str(self.mark)
        begin = line._p.makeelement(qn("w:bookmarkStart"), {qn("w:id"): number, qn("w:name"): name})
        end = line._p.makeelement(qn("w:bookmarkEnd"), {qn("w:id"): number})
        line._p.append(begin)
        line._p.append(end)


def _lines(block: Formula) -> list[Row]:
    """Lines of an equation, moved to the right where they go on from the one before."""
    found: list[Row] = []
    for line in set_lines(block.sides, LINE, LEFT):
        if line.place == "right":
            found[-1] = Row((*found[-1].items, *line.row.items))
            continue
        moved = {"left": 0, "below": 1}.get(line.place, 2)
        found.append(Row((*[Atom("space", "quad")] * moved, *line.row.items)))
    return found


def _widths(block: Table) -> list[float]:
    """Widths of columns, inches: as their longest parts ask for, together no wider than the text."""
    asked = [
        GAP + LETTER * max(longest_part(row[i]) for row in (block.head, *block.rows)) for i in range(len(block.head))
    ]
    full = [
        GAP + LETTER * max(cells(plain(row[i])) for row in (block.head, *block.rows)) for i in range(len(block.head))
    ]
    spare = max(TEXT - sum(asked), 0.0)
    wanted = sum(w - a for w, a in zip(full, asked, strict=True) if w > a)
    more = min(1.0, spare / wanted) if wanted else 0.0
    found = [a + more * max(w - a, 0.0) for w, a in zip(full, asked, strict=True)]
    shrink = min(1.0, TEXT / sum(found))
    return [shrink * each for each in found]
