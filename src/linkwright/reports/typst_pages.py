"""A report as Typst: the one source of its PDF and its HTML."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from functools import lru_cache
from itertools import chain, count
from typing import Any
from unicodedata import category

from linkwright.equations.notation import Row
from linkwright.errors import LinkwrightError
from linkwright.pictures.fonts import check_fonts, own_fonts
from linkwright.pictures.svg import natural_size
from linkwright.reports.document import (
    Block,
    Code,
    Cover,
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
    plain,
    spans,
    walk,
)
from linkwright.reports.formula import set_lines, width
from linkwright.reports.typst_parts import COVER, HEAD, STYLE, quoted, typst
from linkwright.words import _
from linkwright.words.characters import cells

LATIN = ("Libertinus Serif", "DejaVu Serif", "DejaVu Sans")
MATHEMATICS, MONOSPACED = "New Computer Modern Math", "DejaVu Sans Mono"
#: Families with Chinese characters, the one that reads best in print first.
CHINESE = (
    "Noto Serif CJK SC",
    "Source Han Serif SC",
    "Noto Serif SC",
    "Songti SC",
    "SimSun",
    "Noto Sans CJK SC",
    "Source Han Sans SC",
    "Noto Sans SC",
    "PingFang SC",
    "Microsoft YaHei",
    "WenQuanYi Micro Hei",
    "WenQuanYi Zen Hei",
    "Droid Sans Fallback",
    "AR PL UMing CN",
)
#: Families with the small pictures that people write among words.
PICTURES = ("Noto Color Emoji", "Segoe UI Emoji", "Apple Color Emoji", "Twemoji", "Noto Emoji", "Symbola")
#: Weight from which on a face is bold.
BOLD = 600
#: Width of a line of formulas, em; and of a formula's left side beyond which its right side begins a new line.
LINE, LEFT = 41.0, 9.0
#: Formulas of up to this estimated width fit for certain; wider ones are measured and made smaller if they must be.
SURE = 35.0
#: Width of the text, mm, and rows of a table that stays on one page.
TEXT, TOGETHER = 170.0, 32
#: Share of the width and height, mm, of a cover's picture.
LOGO, TALL_LOGO = 0.4, 40.0
#: Characters across a table beyond which its long columns are wrapped.
ACROSS = 112
#: Warnings of Typst that say nothing about the page.
_EXPECTED = ("html export is under active", "was ignored during HTML export", "equation was ignored")
#: Categories of characters that leave no mark of their own: controls, formats, accents, spaces.
_NO_INK = ("Cc", "Cf", "Mn", "Zs", "Zl", "Zp")
#: What Typst says of a text for which no font has a glyph.
_NO_GLYPH = "could not be displayed"


def pages(document: Document) -> tuple[str, dict[str, str]]:
    """The Typst text of a document, and the pictures that it asks for by name."""
    writer = _Writer(document)
    return writer.text(), writer.pictures


def compiled(document: Document, form: str) -> bytes:
    """The PDF or HTML of a document. Raises LinkwrightError where Typst or a font is missing."""
    try:
        import typst as program
    except ImportError:
        raise LinkwrightError(
            _('reports need typst; install it with: pip install "linkwright[report]"', code="report.needs_typst")
        ) from None
    text, pictures = pages(document)
    output_format: Any = form
    try:
        found, warnings = program.compile_with_warnings(
            text.encode(), sys_inputs={**pictures, "form": form}, format=output_format, font_paths=[*_folders()]
        )
    except program.TypstError as error:
        raise LinkwrightError(
            _("the report cannot be set: {sentence}", code="report.typst_says", sentence=str(error))
        ) from None
    messages = [w.message for w in warnings if not any(each in w.message for each in _EXPECTED)]
    if messages:
        raise LinkwrightError(
            _(
                "the report cannot be set: {sentence}",
                code="report.typst_says",
                sentence="; ".join(dict.fromkeys(messages)),
            )
        )
    assert isinstance(found, bytes)
    return found if form == "pdf" else _styled(found, document)


def without_glyph(document: Document) -> str:
    """The characters of a document for which no font is found: the PDF has boxes there."""
    text, pictures = pages(document)
    rare = {c for c in chain(text, *pictures.values()) if not c.isascii() and category(c) not in _NO_INK}
    families = fonts(document.language)
    if _printed("".join(sorted(rare)), families, _folders()):
        return ""
    return "".join(c for c in sorted(rare) if not _printed(c, families, _folders()))


@lru_cache(maxsize=512)
def _printed(text: str, families: tuple[str, ...], folders: tuple[Any, ...] = ()) -> bool:
    """Whether Typst finds a glyph for every character; PDF/A is the form that it refuses without one."""
    import typst as program

    source = (
        f"#set document(date: datetime(year: 2000, month: 1, day: 1), title: {quoted('-')})\n"
        f"#set text(font: {_listed(families)})\n#{quoted(text)}"
    )
    try:
        program.compile(source.encode(), format="pdf", pdf_standards="a-2b", font_paths=[*folders])
    except program.TypstError as error:
        return _NO_GLYPH not in str(error)
    return True


def typst_fault(text: str) -> str:
    """What Typst has against a text; empty where it has nothing, or is not there."""
    try:
        import typst as program
    except ImportError:
        return ""
    try:
        program.compile(text.encode())
    except program.TypstError as error:
        return " ".join(str(error).split())
    return ""


def _styled(page: bytes, document: Document) -> bytes:
    """The page with its style, and a rule for every way in which columns of its tables are aligned."""
    alignments = {table.align or "<" * len(table.head) for table in walk(document.blocks) if isinstance(table, Table)}
    rules = [
        f".{aligned_by(each)} :is(td,th):nth-child({i}){{text-align:{'right' if mark == '>' else 'center'}}}"
        for each in sorted(alignments)
        for i, mark in enumerate(each, 1)
        if mark != "<"
    ]
    style = f"{STYLE}<style>{''.join(rules)}</style>"
    return page.replace(b"</head>", style.encode() + b"</head>", 1)


def aligned_by(alignment: str) -> str:
    """The class of tables with these columns."""
    return "by-" + alignment.translate(str.maketrans("<>^", "lrc"))


def _folders() -> tuple[Any, ...]:
    """Folders of the fonts that are given."""
    return tuple(dict.fromkeys(str(file.parent) for file in own_fonts()))


@lru_cache(maxsize=8)
def _families(folders: tuple[Any, ...] = ()) -> dict[str, int]:
    """Families that are there, with the weight of their boldest face."""
    import typst as program

    found: dict[str, int] = {}
    for font in program.Fonts(font_paths=list(folders)).fonts():
        found[font.family] = max(found.get(font.family, 0), font.weight)
    return found


def without_bold(families: tuple[str, ...]) -> bool:
    """Whether Chinese characters have no bold face in the first of families that has them: they are then made bold
    by a line around them."""
    chinese = [name for name in families if name not in (*LATIN, *PICTURES)]
    return bool(chinese) and _families(_folders())[chinese[0]] < BOLD


def fonts(language: str) -> tuple[str, ...]:
    """Families for texts, those that are there; Chinese ones for every language, since names may be Chinese."""
    known = _families(_folders())
    added = known.keys() - _families().keys() if own_fonts() else set[str]()
    chinese = tuple(name for found in (added, known.keys() - added) for name in CHINESE if name in found)
    chinese = (*chinese, *sorted(added - {*CHINESE}))
    if language == "zh" and not chinese:
        _families.cache_clear()
        known = _families(_folders())
        chinese = tuple(name for name in CHINESE if name in known)
        check_fonts("中", ())
    latin, pictures = (tuple(name for name in each if name in known) for each in (LATIN, PICTURES))
    return (*latin, *chinese, *pictures)


class _Writer:
    """Writes block after block."""

    def __init__(self, document: Document) -> None:
        self.document = document
        self.numbers: Numbers = document.number()
        self.places = count()
        self.pictures: dict[str, str] = {}
        #: How deep in lists and quotations it is.
        self.depth = 0

    def text(self) -> str:
        document, families = self.document, fonts(self.document.language)
        head = HEAD.format(
            title=quoted(document.title),
            running=quoted(shortened(document.title)),
            fonts=_listed(families),
            mathematics=_listed((MATHEMATICS, *families)),
            monospaced=_listed((MONOSPACED, *families)),
            language=quoted(document.language),
            thin=str(without_bold(families)).lower(),
        )
        if document.cover is not None:
            title = self._cover(document.cover)
        else:
            title = f"#lw-title[{_words(document.title)}]\n"
            title += "".join(f"#lw-under[{_words(line)}]\n" for line in document.lines)
        contents = (
            ""
            if not document.contents
            else f"#outline(title: [{_words(document.translate(_('Contents')))}], depth: 2)\n"
        )
        if document.contents and document.cover is not None:
            contents += "#if not lw-is-html { pagebreak(weak: true) }\n"
        return "\n".join([head, title, contents, *self._blocks(document.blocks)])

    def _cover(self, cover: Cover) -> str:
        rows = "".join(f"([{_words(name)}], [{_words(value)}])," for name, value in cover.rows)
        above = "".join(f"[{_words(line)}]," for line in cover.above)
        logo = self._picture(cover.logo, LOGO, TALL_LOGO) if cover.logo else "none"
        return (
            f"{COVER}#lw-cover([{_words(cover.kind)}], [{_words(cover.title)}], ({above}), ({rows}), "
            f"[{_words(cover.below)}], {logo})\n"
        )

    def _blocks(self, blocks: Iterable[Block]) -> list[str]:
        return [self._block(next(self.places), block) for block in blocks]

    def _block(self, index: int, block: Block) -> str:
        match block:
            case Heading():
                number = _words(self.numbers.before(index))
                return f"{'=' * block.level} {number}{self.inline(block.text)} <{_place(index)}>\n"
            case Paragraph():
                return self._paragraph(block, sticky=not self.depth and self.numbers.leads(index))
            case Formula():
                return self._formula(index, block)
            case Table():
                return self._table(index, block)
            case Figure():
                return self._figure(index, block)
            case Code():
                return self._code(index, block)
            case Listed():
                items = "".join(f"[{self._inside(item, tight=_tight(block))}], " for item in block.items)
                kind = "list(" if block.start is None else f"enum(start: {block.start}, "
                return f"#{kind}tight: {str(_tight(block)).lower()}, {items})\n"
            case Quoted():
                return f"#lw-quote[{self._inside(block.blocks)}]\n"
            case Rule():
                return "#lw-rule\n"
            case Sources():
                return self._sources(index, block)
            case Source():
                return f"{block.text}\n"

    def _inside(self, blocks: Iterable[Block], *, tight: bool = False) -> str:
        """Blocks within another one, ``tight``: without room between them."""
        self.depth += 1
        found = [each.strip() for each in self._blocks(blocks)]
        self.depth -= 1
        return ("\n" if tight else "\n\n").join(found)

    def _sources(self, index: int, block: Sources) -> str:
        ordered = sorted(block.entries, key=lambda each: self.numbers.sources[each[0]])
        lines = []
        for key, text in dict(ordered).items():
            number = self.numbers.sources[key]
            lines.append(f"#lw-source([#box[{_words(f'[{number}]')}] <{_source(number)}>], [{self.inline(text)}])\n")
        return "\n".join(lines)

    def _paragraph(self, block: Paragraph, *, sticky: bool) -> str:
        text = self.inline(block.text)
        if block.kind == "bullet":
            return f"- {text}"
        if block.kind == "footnote":
            return f"#lw-small[{text}]\n"
        if block.kind == "lead" or (not block.kind and sticky):
            return f"#block(sticky: true)[{text}]\n"
        return f"#lw-note[{text}]\n" if block.kind else f"{text}\n"

    def _formula(self, index: int, block: Formula) -> str:
        number = self.numbers.of.get(index, "")
        shown = f"[({number}) <{_place(index)}>]" if number else "[]"
        text, wide = aligned(block.sides)
        return f"#lw-{'wide' if wide > SURE else 'formula'}($ {text} $, {shown})"

    def _caption(self, index: int, caption: str) -> str:
        return f"[#strong[{_words(self.numbers.name(index))}] #h(0.4em) {self.inline(caption)}]"

    def _table(self, index: int, table: Table) -> str:
        align = {"<": "left", ">": "right", "^": "center"}
        alignment = table.align or "<" * len(table.head)
        columns = ", ".join("1fr" if each else "auto" for each in _wrapping(table))
        name = quoted(aligned_by(alignment))
        sides = ", ".join(f"{align[mark]} + horizon" for mark in alignment)
        head = ", ".join(f"strong[{self.inline(cell)}]" for cell in table.head)
        cells = ", ".join(f"[{self.inline(cell)}]" for row in table.rows for cell in row)
        caption = f"caption: {self._caption(index, table.caption)}" if table.caption else ""
        parted = "#lw-need\n#[#show figure: set block(breakable: true)\n" if len(table.rows) > TOGETHER else "#["
        return (
            f"{parted}#figure(lw-table(({columns},), ({sides},), {name}, ({head},), {cells}), "
            "kind: table, numbering: none, supplement: none, "
            f"{caption}) <{_place(index)}>]\n"
        )

    def _figure(self, index: int, figure: Figure) -> str:
        found = [self._picture(svg, share, figure.tallest) for svg, share in figure.pictures]
        body = found[0] if len(found) == 1 else f"lw-pictures({', '.join(found)})"
        caption = f"caption: {self._caption(index, figure.caption)}" if figure.caption else ""
        return f"#figure({body}, kind: image, numbering: none, supplement: none, {caption}) <{_place(index)}>\n"

    def _picture(self, svg: str, share: float, tallest: float) -> str:
        name = f"picture{len(self.pictures)}"
        self.pictures[name] = svg
        wide, high = placed(svg, share, tallest)
        return f"lw-picture(sys.inputs.{name}, {wide:.4f}, {high:.2f})"

    def _code(self, index: int, code: Code) -> str:
        lines = code.text.expandtabs(4).rstrip("\n").split("\n")
        text = "\\n".join(quoted(line)[1:-1] for line in lines)
        body = f'lw-code("{text}", {quoted(code.language) if code.language else "none"})'
        if not code.caption:
            return f"#{body}\n"
        return (
            f"#figure({body}, kind: raw, numbering: none, supplement: none, "
            f"caption: {self._caption(index, code.caption)}) <{_place(index)}>\n"
        )

    def inline(self, text: str) -> str:
        """A text with its formulas, styles, links and references."""
        return "".join(self._span(span) for span in spans(text))

    def _span(self, span: Span) -> str:
        text, target = self.numbers.shown(span)
        match span.kind:
            case "formula" | "symbol" if span.formula:
                found = f"${typst(span.formula)}$"
            case "code":
                found = f"#raw({quoted(text)});"
            case "break":
                return "#linebreak();"
            case _:
                found = _emphasised(text) if "emphasis" in span.styles else _words(text)
        for style, command in _COMMANDS.items():
            found = f"#{command}[{found}]" if style in span.styles else found
        if not target:
            return found
        return f"#link(<{target[1:]}>)[{found}]" if target[0] == "#" else f"#lw-url({quoted(target)}, [{found}])"


#: Styles in Typst.
_COMMANDS = {"strong": "strong", "raised": "super", "struck": "strike"}


def _emphasised(text: str) -> str:
    """A text in italics; Chinese characters, which have none, with dots below them."""
    parts = re.split(r"([\u2e80-\u9fff\uf900-\ufaff]+)", text)
    return "".join(
        f"#lw-dots({quoted(part)});" if i % 2 else f"#emph[{_words(part)}]" for i, part in enumerate(parts) if part
    )


def _tight(listed: Listed) -> bool:
    """Whether the items of a list are single lines."""
    return all(len(item) <= 1 or isinstance(item[-1], Listed) for item in listed.items)


def _wrapping(table: Table) -> list[bool]:
    """The columns that share the room left over, since the table would be wider than the page."""
    wide = [max(cells(plain(row[i])) for row in (table.head, *table.rows)) for i in range(len(table.head))]
    return [sum(wide) + 2 * len(wide) > ACROSS and each > 40 for each in wide]


def aligned(sides: Sequence[Row]) -> tuple[str, float]:
    """Sides of an equation in Typst, on one line or with their equal signs below each other; the widest line, em."""
    begun = {"left": "", "right": " & ", "below": " \\\n quad & ", "sign": " \\\n & "}
    begun["further"] = " \\\n & quad " if len(sides) > 1 else " \\\n quad "
    found, widest, margin = "", 0.0, 0.0
    for line in set_lines(sides, LINE, LEFT):
        found += begun[line.place] + typst(line.row)
        margin = {"right": widest + 0.25, "below": 1.5}.get(line.place, margin)
        widest = max(widest, margin + width(line.row))
    return found, widest


def placed(svg: str, share: float, tallest: float) -> tuple[float, float]:
    """Share of the width and height, mm, of a picture, smaller where it would be taller than ``tallest``."""
    wide, high = natural_size(svg)
    tall = share * TEXT * high / wide
    return (share, tall) if tall <= tallest else (share * tallest / tall, tallest)


def shortened(title: str) -> str:
    """A title for the head of the pages."""
    return title if len(title) <= 80 else f"{title[:78]} …"


def _words(text: str) -> str:
    """A text as content: printed as it is, long names breakable."""
    return f"#{quoted(breakable(text))};" if text else ""


def breakable(text: str) -> str:
    """Zero-width spaces where a long name may break."""
    return re.sub(
        r"[^\s\u2e80-\u9fff]{22,}", lambda found: re.sub(r"([_.,/\\:;-]|\w{16}(?=\w))", "\\1\u200b", found[0]), text
    )


def _listed(names: tuple[str, ...]) -> str:
    return "(" + "".join(f"{quoted(name)}, " for name in names) + ")"


def _source(number: int) -> str:
    return f"s{number}"


def _place(index: int) -> str:
    return f"b{index}"
