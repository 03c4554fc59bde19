"""A report as Typst: the one source of its PDF and its HTML."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache
from itertools import chain
from typing import Any
from unicodedata import category

from linkwright.errors import LinkwrightError
from linkwright.plot.svg.fonts import check_fonts, given_fonts
from linkwright.plot.svg.render import natural_size
from linkwright.report.document import (
    Block,
    Document,
    Figure,
    Formula,
    Heading,
    Numbers,
    Paragraph,
    Source,
    Table,
    plain,
    spans,
)
from linkwright.report.formula import (
    ACCENTS,
    Accent,
    Atom,
    Bracket,
    Fraction,
    Node,
    Root,
    Row,
    Script,
    formula,
    set_lines,
    width,
)
from linkwright.words.characters import cells

_ACCENTS = {"dot": "dot", "ddot": "dot.double", "vec": "arrow", "overrightarrow": "arrow", "bar": "macron"}
_SPACES = {",": "thin", ";": "med", ":": "med", " ": "med", "quad": "quad"}
_ESCAPED = '\\"'
assert _ACCENTS.keys() == ACCENTS.keys()


def typst(node: Node) -> str:
    """A formula between dollar signs of Typst."""
    match node:
        case Atom("letter" | "number", text):
            return text
        case Atom("space", text):
            return _SPACES[text]
        case Atom("open" | "close", text):
            return f"\\{text}"
        case Atom("sign", text):
            return f"\\{text}" if text in "/;,:!" else text
        case Atom(_, text):
            return quoted(text)
        case Row(items):
            return " ".join(typst(each) for each in items)
        case Fraction(above, below):
            return f"frac({typst(above)}, {typst(below)})"
        case Root(inside):
            return f"sqrt({typst(inside)})"
        case Script(base, below, above):
            found = '""' if base == Row() else f"lr({typst(base)})" if isinstance(base, Row) else typst(base)
            found += f"_({typst(below)})" if below is not None else ""
            return found + (f"^({typst(above)})" if above is not None else "")
        case Accent(mark, inside):
            return f"accent({typst(inside)}, {_ACCENTS[mark]})"
        case Bracket(inside, left, right):
            return (
                f"lr(({typst(inside)}))"
                if (left, right) == ("(", ")")
                else f"lr({left} {typst(inside)} {right})"
            )


def quoted(text: str) -> str:
    """A text as a string of Typst."""
    return '"' + "".join(f"\\{c}" if c in _ESCAPED else c for c in text).replace("\n", " ") + '"'


LATIN = ("Libertinus Serif", "DejaVu Serif", "DejaVu Sans")
MATHEMATICS = "New Computer Modern Math"
#: Families with Chinese characters, the one that reads best in print first.
CHINESE = (
    "Noto Serif CJK SC", "Source Han Serif SC", "Noto Serif SC", "Songti SC", "SimSun", "Noto Sans CJK SC",
    "Source Han Sans SC", "Noto Sans SC", "PingFang SC", "Microsoft YaHei", "WenQuanYi Micro Hei",
    "WenQuanYi Zen Hei", "Droid Sans Fallback", "AR PL UMing CN",
)  # fmt: skip
#: Families with the small pictures that people write among words.
PICTURES = ("Noto Color Emoji", "Segoe UI Emoji", "Apple Color Emoji", "Twemoji", "Noto Emoji", "Symbola")
#: Width of a line of formulas, em; and of a formula's left side beyond which its right side begins a new line.
LINE, LEFT = 41.0, 9.0
#: Formulas of up to this estimated width fit for certain; wider ones are measured and made smaller if they must be.
SURE = 35.0
#: Width of the text, mm, and rows of a table that stays on one page.
TEXT, TOGETHER = 170.0, 32
#: Characters across a table beyond which its long columns are wrapped.
ACROSS = 112
#: Warnings of Typst that say nothing about the page.
_EXPECTED = ("html export is under active", "was ignored during HTML export", "equation was ignored")
#: Categories of characters that leave no mark of their own: controls, formats, accents, spaces.
_NO_INK = ("Cc", "Cf", "Mn", "Zs", "Zl", "Zp")
#: What Typst says of a text for which no font has a glyph.
_NO_GLYPH = "could not be displayed"
_HEAD = """\
#set document(title: {title}, author: ())
#set page(paper: "a4", margin: (x: 20mm, top: 24mm, bottom: 22mm), numbering: "1", header: context {{
  if here().page() > 1 {{ text(8.5pt, fill: luma(90))[#{running}; #h(1fr) Linkwright] }} }})
#set text(font: {fonts}, size: 10.5pt, lang: {language})
#set par(justify: true, leading: 0.62em, spacing: 0.95em)
#set heading(numbering: none)
#show heading: set block(above: 1.3em, below: 0.7em)
#show heading.where(level: 1): set text(15pt)
#show heading.where(level: 2): set text(12.5pt)
#show heading.where(level: 3): set text(11pt)
#show math.equation: set text(font: {mathematics})
#show math.equation.where(block: true): set block(above: 0.55em, below: 0.55em)
#show math.equation.where(block: true): set align(left)
#show figure: set block(above: 1.1em, below: 1.1em)
#show figure.where(kind: table): set figure.caption(position: top)
#show figure.caption: set text(9.5pt)
#show figure.caption.where(kind: table): set block(sticky: true)
#set table(
  stroke: (x, y) => (top: if y == 0 {{ 0.9pt }} else if y == 1 {{ 0.6pt }} else {{ 0pt }}),
  inset: (x: 4.5pt, y: 3pt))
#let lw-is-html = sys.inputs.form == "html"
#let lw-title(body) = if lw-is-html {{ html.elem("h1", attrs: (class: "title"))[#body] }} else {{
  align(center, {{ set par(justify: false); text(19pt, weight: "bold", body) }}) }}
#let lw-under(body) = if lw-is-html {{ html.elem("p", attrs: (class: "under"))[#body] }} else {{
  align(center, {{ set par(justify: false); body }}) }}
#let lw-table(columns, align, kind, head, ..cells) = {{
  set text(8.8pt)
  set par(justify: false)
  if lw-is-html {{ html.elem("div", attrs: (class: kind))[#table(
    columns: columns.len(), table.header(..head), ..cells)] }} else {{
    table(columns: columns, align: align, table.header(..head), ..cells, table.hline(stroke: 0.9pt)) }}
}}
#let lw-row(body, number) = block(width: 100%, above: 0.6em, below: 0.6em, breakable: false,
  grid(columns: (1fr, auto), column-gutter: 6pt, align: (left + horizon, right + horizon),
    pad(left: 1.2em, body), number))
#let lw-html(body, number) = html.elem("div", attrs: (class: "formula"))[
  #html.elem("div")[#body] #html.elem("span")[#number]]
#let lw-formula(body, number) = {{
  if lw-is-html {{ lw-html(body, number) }} else {{ lw-row(body, number) }}
}}
#let lw-wide(body, number) = {{
  if lw-is-html {{ lw-html(body, number) }} else {{
    lw-row(layout(room => {{
      let wide = measure(body).width
      if wide > room.width {{
        scale(100% * (room.width / wide), origin: left, reflow: true, body)
      }} else {{ body }}
    }}), number)
  }}
}}
#let lw-picture(svg, share, high) = {{
  if lw-is-html {{ image(bytes(svg), format: "svg", width: share * 100%) }} else {{
    image(bytes(svg), format: "svg", width: share * 170mm, height: high * 1mm)
  }}
}}
#let lw-pictures(..given) = {{
  if lw-is-html {{ html.elem("div", attrs: (class: "pictures"))[#given.pos().join()] }} else {{
    align(center, given.pos().map(each => box(each)).join(h(1fr, weak: true)))
  }}
}}
#let lw-need = if not lw-is-html {{
  block(height: 7em, breakable: false, above: 0pt, below: 0pt)
  v(-7em)
}}
#let lw-note(body) = {{
  if lw-is-html {{ html.elem("p", attrs: (class: "note"))[#body] }} else {{
    block(width: 100%, inset: 7pt, fill: luma(244), stroke: (left: 2pt + rgb("#c8501e")), body) }}
}}
"""
_STYLE = """\
<style>body{font:16px/1.55 "Noto Serif","Libertinus Serif","DejaVu Serif","Noto Serif CJK SC","Songti SC",serif;\
max-width:52rem;margin:2rem auto;padding:0 1rem;color:#1c2733;background:#fff}table{border-collapse:collapse;\
font-size:.84rem;margin:.4rem auto}th,td{padding:.2rem .55rem;text-align:left}th{border-top:2px solid;\
border-bottom:1px solid}.title,.under{text-align:center}tbody tr:last-child td{border-bottom:2px solid}\
figure{margin:1.4rem 0;text-align:center;overflow-x:auto}figure img{max-width:100%;height:auto;display:inline-block\
!important}figcaption{font-size:.9rem;margin:.4rem}.pictures{display:flex;flex-wrap:wrap;\
justify-content:space-evenly;gap:.6rem}a{color:#0b57a4}.formula{display:flex;justify-content:space-between;align-items:\
center;margin:.2rem 0 .2rem 1.2rem;padding:.15rem 0;overflow:auto hidden}\
.note{background:#f4f4f4;border-left:3px solid #c8501e;\
padding:.5rem .8rem}nav ol{padding-left:1.2rem}nav a{color:inherit;text-decoration:none}nav a:hover{text-decoration:\
underline}@media print{figure{break-inside:avoid}}body>div:not(.formula,.note){margin:1em 0}\
@media screen and (prefers-color-scheme:dark){body{color:#dfe5ec;background:#15191e}figure img{background:#fff}\
.note{background:#242a32}a{color:#8cc4ff}}\
@media screen and (max-width:40rem){table:has(th:nth-child(5)){min-width:34rem}\
table:has(th:nth-child(8)){min-width:46rem}}</style>"""


def pages(document: Document) -> tuple[str, dict[str, str]]:
    """The Typst text of a document, and the pictures that it asks for by name."""
    writer = _Writer(document)
    return writer.text(), writer.pictures


def compiled(document: Document, form: str) -> bytes:
    """The PDF or HTML of a document. Raises LinkwrightError where Typst or a font is missing."""
    try:
        import typst as program
    except ImportError:
        raise LinkwrightError("report.needs_typst") from None
    text, pictures = pages(document)
    given: Any = form
    try:
        found, warnings = program.compile_with_warnings(
            text.encode(), sys_inputs={**pictures, "form": form}, format=given, font_paths=[*_folders()]
        )
    except program.TypstError as error:
        raise LinkwrightError("report.typst_says", sentence=str(error)) from None
    said = [w.message for w in warnings if not any(each in w.message for each in _EXPECTED)]
    if said:
        raise LinkwrightError("report.typst_says", sentence="; ".join(dict.fromkeys(said)))
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
    marks = {table.align or "<" * len(table.head) for table in document.blocks if isinstance(table, Table)}
    rules = [
        f".{aligned_by(each)} :is(td,th):nth-child({i}){{text-align:{'right' if mark == '>' else 'center'}}}"
        for each in sorted(marks)
        for i, mark in enumerate(each, 1)
        if mark != "<"
    ]
    style = f"{_STYLE}<style>{''.join(rules)}</style>"
    return page.replace(b"</head>", style.encode() + b"</head>", 1)


def aligned_by(marks: str) -> str:
    """The class of tables with these columns."""
    return "by-" + marks.translate(str.maketrans("<>^", "lrc"))


def _folders() -> tuple[Any, ...]:
    """Folders of the fonts that are given."""
    return tuple(dict.fromkeys(str(file.parent) for file in given_fonts()))


@lru_cache(maxsize=8)
def _families(folders: tuple[Any, ...] = ()) -> frozenset[str]:
    import typst as program

    return frozenset(program.Fonts(font_paths=list(folders)).families())


def fonts(language: str) -> tuple[str, ...]:
    """Families for texts, those that are there; Chinese ones for every language, since names may be Chinese."""
    known = _families(_folders())
    given = known - _families() if given_fonts() else frozenset()
    chinese = tuple(name for found in (given, known - given) for name in CHINESE if name in found)
    chinese = (*chinese, *sorted(given - {*CHINESE}))
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
        self.pictures: dict[str, str] = {}

    def text(self) -> str:
        document, families = self.document, fonts(self.document.language)
        head = _HEAD.format(
            title=quoted(document.title),
            running=quoted(shortened(document.title)),
            fonts=_listed(families),
            mathematics=_listed((MATHEMATICS, *families)),
            language=quoted(document.language),
        )
        title = f"#lw-title[{_words(document.title)}]\n"
        under = "".join(f"#lw-under[{_words(line)}]\n" for line in document.lines)
        contents = (
            ""
            if not document.contents
            else f"#outline(title: [{_words(document.say('report.contents'))}], depth: 2)\n"
        )
        parts = [self._block(i, block) for i, block in enumerate(document.blocks)]
        return "\n".join([head, title, under, contents, *parts])

    def _block(self, index: int, block: Block) -> str:
        match block:
            case Heading():
                number = _words(self.numbers.before(index))
                return f"{'=' * block.level} {number}{self.inline(block.text)} <{_place(index)}>\n"
            case Paragraph():
                return self._paragraph(block, sticky=self.document.leads(index))
            case Formula():
                return self._formula(index, block)
            case Table():
                return self._table(index, block)
            case Figure():
                return self._figure(index, block)
            case Source():
                return f"{block.text}\n"

    def _paragraph(self, block: Paragraph, *, sticky: bool) -> str:
        text = self.inline(block.text)
        if block.kind == "bullet":
            return f"- {text}"
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
        marks = table.align or "<" * len(table.head)
        columns = ", ".join("1fr" if each else "auto" for each in _wrapping(table))
        sides = ", ".join(f"{align[mark]} + horizon" for mark in marks)
        head = ", ".join(f"strong[{self.inline(cell)}]" for cell in table.head)
        cells = ", ".join(f"[{self.inline(cell)}]" for row in table.rows for cell in row)
        parted = (
            "#lw-need\n#[#show figure: set block(breakable: true)\n" if len(table.rows) > TOGETHER else "#["
        )
        return (
            f"{parted}#figure(lw-table(({columns},), ({sides},), {quoted(aligned_by(marks))}, ({head},), {cells}), "
            "kind: table, numbering: none, supplement: none, "
            f"caption: {self._caption(index, table.caption)}) <{_place(index)}>]\n"
        )

    def _figure(self, index: int, figure: Figure) -> str:
        found = []
        for svg, share in figure.pictures:
            name = f"picture{len(self.pictures)}"
            self.pictures[name] = svg
            wide, high = placed(svg, share, figure.tallest)
            found.append(f"lw-picture(sys.inputs.{name}, {wide:.4f}, {high:.2f})")
        body = found[0] if len(found) == 1 else f"lw-pictures({', '.join(found)})"
        return (
            f"#figure({body}, kind: image, numbering: none, supplement: none, "
            f"caption: {self._caption(index, figure.caption)}) <{_place(index)}>\n"
        )

    def inline(self, text: str) -> str:
        """A text with its formulas, strong words and references."""
        return "".join(self._spans(text))

    def _spans(self, text: str) -> Iterator[str]:
        for kind, part in spans(text):
            if kind == "formula":
                yield f"${typst(formula(part))}$"
            elif kind == "strong":
                yield f"#strong[{_words(part)}]"
            elif kind == "code":
                yield f"#raw({quoted(part)});"
            elif kind == "reference":
                index = self.numbers.labels.get(part)
                yield (
                    _words(part)
                    if index is None
                    else (f"#link(<{_place(index)}>)[{_words(self.numbers.name(index))}]")
                )
            else:
                yield _words(part)


def _wrapping(table: Table) -> list[bool]:
    """The columns that share the room left over, since the table would be wider than the page."""
    wide = [max(cells(plain(row[i])) for row in (table.head, *table.rows)) for i in range(len(table.head))]
    return [sum(wide) + 2 * len(wide) > ACROSS and each > 40 for each in wide]


def aligned(sides: tuple[str, ...]) -> tuple[str, float]:
    """Sides of an equation in Typst, on one line or with their equal signs below each other; the widest line, em."""
    begun = {"left": "", "right": " & ", "below": " \\\n quad & ", "sign": " \\\n & "}
    begun["further"] = " \\\n & quad " if len(sides) > 1 else " \\\n quad "
    found, widest, margin = "", 0.0, 0.0
    for line in set_lines([formula(side) for side in sides], LINE, LEFT):
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
        r"[^\s\u2e80-\u9fff]{22,}",
        lambda found: re.sub(r"([_.,/\\:;-]|\w{16}(?=\w))", "\\1\u200b", found[0]),
        text,
    )


def _listed(names: tuple[str, ...]) -> str:
    return "(" + "".join(f"{quoted(name)}, " for name in names) + ")"


def _place(index: int) -> str:
    return f"b{index}"
