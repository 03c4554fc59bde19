"""What a report is made of: blocks in reading order, numbered and referred to, before it has any file form.

Texts may hold formulas between dollar signs (LaTeX) or ``noted`` (as they stand on a line), ``**strong**`` words and
references ``[[label]]`` to what has a label; a dollar sign of its own is ``\\$``. What else marks a text comes from
``marked``, ``linked`` and ``cited``.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace

from linkwright.core.table import Table as Cells
from linkwright.equations.notation import Row
from linkwright.equations.reading import read_name
from linkwright.reports.formula import formula, width
from linkwright.words import Translate, _
from linkwright.words.characters import cells
from linkwright.words.message import in_language

#: Signs that switch a style on and off, and those around the target of a link, a source, the label of a link.
STYLES = {"strong": "\ue010", "emphasis": "\ue011", "raised": "\ue012", "struck": "\ue013"}
_LINK, _LINKED, _END, _BREAK, _CITE, _CITED, _NOTE, _NOTED = (chr(0xE014 + i) for i in range(8))
_PRIVATE = re.compile("[\ue000-\ue01f]")
_MARKS = re.compile(
    rf"({_NOTE}[^{_NOTED}]*{_NOTED}"
    r"|\$[^$]+\$|\*\*[^*]+\*\*|`[^`]+`|\[\[[^\]]+\]\]"
    f"|[{''.join(STYLES.values())}{_END}{_BREAK}]|{_LINK}[^{_LINKED}]*{_LINKED}|{_CITE}[^{_CITED}]*{_CITED})"
)
_HIDDEN = {"$": "\ue000", "*": "\ue001", "`": "\ue002", "[": "\ue003", "]": "\ue004"}
_INDEXED = re.compile(r"(?<![\w\ue000-\ue004])([A-Za-zα-ωΑ-Ω])_([A-Za-z0-9]+(?:,\d+)?)(?!\w)", re.ASCII)
_SHOWN = {code: sign for sign, code in _HIDDEN.items()}
#: How blocks are called, by their class.
NAMES = {
    "heading": _("section {number}"),
    "table": _("Table {number}"),
    "figure": _("Figure {number}"),
    "code": _("Listing {number}"),
    "formula": _("equation ({number})"),
    "paragraph": _("{number}"),
    "source": _("{number}"),
}


def literal(text: str) -> str:
    """A text that is printed as it is, whatever marks it holds: names, sentences, sources."""
    return "".join(_HIDDEN.get(c, c) for c in text)


def sentence_with_keys(text: str) -> str:
    """A sentence that is printed as it is, but for keys of the model file between backticks, which are code."""
    parts = text.split("`")
    return "".join(f"`{part}`" if number % 2 else literal(part) for number, part in enumerate(parts))


def unmarked(text: str) -> str:
    """A user's text without the signs that mark texts here."""
    return _PRIVATE.sub("", text)


def marked(text: str, style: str) -> str:
    """A text in one of the STYLES; it may hold others."""
    return f"{STYLES[style]}{text}{STYLES[style]}"


def linked(text: str, target: str) -> str:
    """A text that leads to an address, or to a block where ``target`` is ``#`` and its label."""
    return f"{_LINK}{target}{_LINKED}{text}{_END}"


def cited(source: str) -> str:
    """The number of a source; its text is looked for in the Sources of the document."""
    return f"{_CITE}{source}{_CITED}"


def broken() -> str:
    """The end of a line within a paragraph."""
    return _BREAK


def symbols(text: str) -> str:
    """A sentence printed as it is, but for symbols with an index, which become formulas: ``v_Ax``."""
    return _INDEXED.sub(lambda found: noted(found[0]), literal(text))


def noted(text: str) -> str:
    """A formula on a line, ``φ1``, as it is printed."""
    return f"{_NOTE}{literal(text)}{_NOTED}"


def strong(text: str) -> str:
    """Marked text in bold, its formulas as they are."""
    return "".join(
        f"**{part}**" if part and part[0] not in f"${_NOTE}" else part
        for part in re.split(rf"(\$[^$]+\$|{_NOTE}[^{_NOTED}]*{_NOTED})", text)
    )


def shown(text: str) -> str:
    """The text behind ``literal``."""
    return "".join(_SHOWN.get(c, c) for c in text)


@dataclass(frozen=True)
class Heading:
    """A heading of level 1 to 4; ``number``: whether that is printed before it."""

    text: str
    level: int = 1
    label: str = ""
    number: bool = True


@dataclass(frozen=True)
class Paragraph:
    """A paragraph; ``kind`` is empty, ``missing`` (why something is not there), ``note``, ``bullet``, ``footnote``,
    or ``lead``: it stays with what follows."""

    text: str
    kind: str = ""


@dataclass(frozen=True)
class Formula:
    """An equation: its sides, joined by equal signs; ``number``: whether it is counted."""

    sides: tuple[Row, ...]
    label: str = ""
    number: bool = True


@dataclass(frozen=True)
class Table:
    """A table, numbered where it has a caption; ``align``: ``<``, ``>`` or ``^`` per column; ``key``: columns that
    every part repeats where it is too wide for a page."""

    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    align: str = ""
    label: str = ""
    key: int = 1


def _bare(cell: str) -> str:
    """A cell as it is printed."""
    return literal(cell.strip())


def printed(source: Cells, language: str, label: str = "", first: Callable[[str], str] = _bare) -> Table:
    """A table as one of the document, its title as caption; title and heading may hold marks, ``first`` writes the
    cells of the first column."""
    head, *rows = source.texts(language)
    cells = tuple((first(row[0]), *map(_bare, row[1:])) for row in rows)
    return Table(in_language(source.title, language), tuple(head), cells, source.alignment, label)


@dataclass(frozen=True)
class Figure:
    """Pictures, numbered where they have a caption, each SVG with the share of the page's width that it takes, up
    to ``tallest`` mm."""

    caption: str
    pictures: tuple[tuple[str, float], ...]
    label: str = ""
    tallest: float = 150.0


@dataclass(frozen=True)
class Listed:
    """A list of items that hold blocks; ``start``: the number of the first one, None where they have dots."""

    items: tuple[tuple[Block, ...], ...]
    start: int | None = None


@dataclass(frozen=True)
class Quoted:
    """Blocks that are somebody else's words, set in."""

    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class Rule:
    """A line across the page."""


@dataclass(frozen=True)
class Sources:
    """The list of sources, each once: text that is cited and text that is printed. Cited ones come first."""

    entries: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Source:
    """Text that is Typst already; other forms print it as it is."""

    text: str


@dataclass(frozen=True)
class Code:
    """A listing, printed line by line as it is; one with a caption is numbered. ``language`` colours its words
    (``python``, ``yaml``; empty: none)."""

    text: str
    language: str = ""
    caption: str = ""
    label: str = ""


Block = Heading | Paragraph | Formula | Table | Figure | Code | Listed | Quoted | Rule | Sources | Source
#: What is numbered within its chapter, each kind for itself.
NUMBERED = (Formula, Table, Figure, Code)


#: A paragraph of fewer characters stays with the formula, table or figure that it leads to.
SHORT = 400


@dataclass(frozen=True)
class Cover:
    """A page before all others: picture (SVG text, share of the width), lines above the kind of document, the kind,
    its title, rows of name and value, a line at the end."""

    kind: str
    title: str
    above: tuple[str, ...] = ()
    rows: tuple[tuple[str, str], ...] = ()
    below: str = ""
    logo: str = ""


@dataclass
class Document:
    """A report: title, lines under it, blocks; ``number`` counts what is counted, in reading order.

    ``missing``: sentences on what is not there; ``broken``: whether an error of the program is the reason of one;
    ``contents``: whether it has a list of its sections.
    """

    title: str
    translate: Translate
    language: str = "en"
    lines: tuple[str, ...] = ()
    blocks: list[Block] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)
    broken: bool = False
    contents: bool = True
    cover: Cover | None = None

    def number(self) -> Numbers:
        """Numbers of headings, formulas, tables and figures, and where labels are."""
        return Numbers(self)


def walk(blocks: Iterable[Block]) -> Iterator[Block]:
    """Blocks in reading order, those within lists and quotations behind these."""
    for block in blocks:
        yield block
        yield from walk(within(block))


def within(block: Block) -> tuple[Block, ...]:
    """The blocks that a list or a quotation holds."""
    match block:
        case Listed(items):
            return tuple(each for item in items for each in item)
        case Quoted(blocks):
            return blocks
    return ()


def changed(block: Block, change: Callable[[Block], Iterable[Block]]) -> Iterator[Block]:
    """What becomes of a block, those within it first."""

    def inner(blocks: Iterable[Block]) -> tuple[Block, ...]:
        return tuple(new for each in blocks for new in changed(each, change))

    if isinstance(block, Listed):
        block = replace(block, items=tuple(inner(item) for item in block.items))
    elif isinstance(block, Quoted):
        block = replace(block, blocks=inner(block.blocks))
    yield from change(block)


def _counted(block: Formula | Table | Figure | Code) -> bool:
    """Whether a block has a number: a formula unless it is without one, all others with a caption."""
    return block.number if isinstance(block, Formula) else bool(block.caption)


class Numbers:
    """``blocks`` in reading order, those within others too; ``of[index]``: the number of one, as it is printed;
    ``labels``: block by label; ``sources``: number by the text of a source."""

    def __init__(self, document: Document) -> None:
        self.of: dict[int, str] = {}
        self.labels: dict[str, int] = {}
        self.document = document
        self.blocks = list(walk(document.blocks))
        self.sources = _numbered_sources(self.blocks)
        levels: list[int] = []
        chapter, counts = 0, dict.fromkeys(NUMBERED, 0)
        for index, block in enumerate(self.blocks):
            if isinstance(block, Heading):
                levels = [*(levels + [0] * 4)[: block.level]]
                levels[-1] += 1
                if block.number:
                    self.of[index] = ".".join(map(str, levels))
                if levels[0] != chapter:
                    chapter, counts = levels[0], dict.fromkeys(NUMBERED, 0)
            elif isinstance(block, NUMBERED) and _counted(block):
                counts[type(block)] += 1
                self.of[index] = f"{chapter}.{counts[type(block)]}"
            label = getattr(block, "label", "")
            if label and (index in self.of or isinstance(block, Heading)):
                self.labels[label] = index

    def leads(self, index: int) -> bool:
        """Whether a short paragraph stays with the formula, table or figure behind it, a section's first always."""
        block, before, after = (self.blocks[i : i + 1] for i in (index, max(index - 1, 0), index + 1))
        if not after or not isinstance(block[0], Paragraph) or len(block[0].text) >= SHORT:
            return False
        return isinstance(before[0], Heading) or isinstance(after[0], NUMBERED) or block[0].text.endswith((":", "："))

    def before(self, index: int) -> str:
        """The number before the text of a heading."""
        return f"{self.of[index]}  " if index in self.of else ""

    def shown(self, span: Span) -> tuple[str, str]:
        """What a part of a text shows, and where it leads: an address, ``#b`` and the place of a block, or ``#s`` and
        the number of a source."""
        if span.kind == "source":
            number = self.sources.get(span.text)
            listed = any(isinstance(each, Sources) for each in self.blocks)
            return (f"[{number}]" if number else span.text), (f"#s{number}" if number and listed else "")
        label = span.text if span.kind == "reference" else span.link[1:] if span.link[:1] == "#" else ""
        index = self.labels.get(label)
        text = self.name(index) if span.kind == "reference" and index is not None else span.text
        if label:
            return text, "" if index is None else f"#b{index}"
        return text, span.link

    def name(self, index: int) -> str:
        """How a block is called in a sentence: ``Table 3.1``."""
        block, translate = self.blocks[index], self.document.translate
        kind = type(block).__name__.lower()
        return translate(NAMES[kind].format(number=self.of.get(index, "")))


def _numbered_sources(blocks: Sequence[Block]) -> dict[str, int]:
    """Sources by number: those that are cited, in the order in which they are, then the others of the list."""
    known = {key for block in blocks if isinstance(block, Sources) for key, _ in block.entries}
    found = dict.fromkeys(
        span.text for block in blocks for text in texts(block) for span in spans(text) if span.kind == "source"
    )
    ordered = [key for key in found if key in known or not known]
    ordered += [key for block in blocks if isinstance(block, Sources) for key, _ in block.entries if key not in found]
    return {key: number for number, key in enumerate(dict.fromkeys(ordered), 1)}


def texts(block: Block) -> Iterator[str]:
    """The marked texts of a block, without those of blocks within it."""
    match block:
        case Heading(text) | Paragraph(text):
            yield text
        case Table():
            yield from (block.caption, *block.head, *(cell for row in block.rows for cell in row))
        case Figure() | Code():
            yield block.caption
        case Sources(entries):
            yield from (text for _, text in entries)


def with_prefix(block: Block, prefix: str) -> Block:
    """A block whose texts refer to labels that begin so."""

    def own(text: str) -> str:
        return text.replace("[[", f"[[{prefix}").replace(f"{_LINK}#", f"{_LINK}#{prefix}")

    match block:
        case Paragraph() | Heading():
            return replace(block, text=own(block.text))
        case Table():
            rows = tuple(tuple(map(own, row)) for row in block.rows)
            return replace(block, caption=own(block.caption), head=tuple(map(own, block.head)), rows=rows)
        case Figure() | Code():
            return replace(block, caption=own(block.caption))
    return block


@dataclass(frozen=True)
class Span:
    """Part of a text: ``kind`` is ``text``, ``formula`` (LaTeX), ``symbol`` (a formula on a line), ``code``,
    ``reference`` (to a label), ``source`` or ``break``; the styles it is in, and where it leads."""

    kind: str
    text: str
    styles: frozenset[str] = frozenset()
    link: str = ""

    @property
    def formula(self) -> Row | None:
        """The formula that it is, as it is printed."""
        if self.kind == "symbol":
            return read_name(self.text)
        return formula(self.text) if self.kind == "formula" else None


_SINGLE = {code: style for style, code in STYLES.items()}


def spans(text: str) -> Iterator[Span]:
    """Parts of a text."""
    styles, link = frozenset[str](), ""
    for part in _MARKS.split(text):
        if not part:
            continue
        if part in _SINGLE:
            styles ^= {_SINGLE[part]}
        elif part[0] == _LINK:
            link = part[1:-1]
        elif part == _END:
            link = ""
        elif part == _BREAK:
            yield Span("break", "\n", styles, link)
        elif part[0] == _CITE:
            yield Span("source", part[1:-1], styles, link)
        elif part[0] == "$" and len(part) > 2:
            yield Span("formula", part[1:-1], styles, link)
        elif part[0] == _NOTE:
            yield Span("symbol", shown(part[1:-1]), styles, link)
        elif part.startswith("**"):
            yield Span("text", shown(part[2:-2]), styles | {"strong"}, link)
        elif part[0] == "`":
            yield Span("code", shown(part[1:-1]), styles, link)
        elif part.startswith("[["):
            yield Span("reference", part[2:-2], styles, link)
        else:
            yield Span("text", shown(part), styles, link)


def plain(text: str) -> str:
    """A text without its marks."""
    return "".join(span.text for span in spans(text))


def longest_part(text: str) -> int:
    """Characters of the longest part of a text that does not break; a formula is one."""
    joined = "".join("m" * round(2.6 * width(span.formula)) if span.formula else span.text for span in spans(text))
    return max((cells(word) for word in joined.split(" ")), default=1)


def fitted(table: Table, widest: int) -> Sequence[Table]:
    """A table in parts that are no wider than so many characters; the key columns come in each."""

    widths = [
        2 + max(longest_part(text) for text in (table.head[i], *(row[i] for row in table.rows)))
        for i in range(len(table.head))
    ]
    key, total = sum(widths[: table.key]), sum(widths)
    if total <= widest:
        return [table]
    room = max(widest - key, 1)
    share = (total - key) / -(-(total - key) // room)
    groups: list[list[int]] = [[]]
    used = 0
    for i in range(table.key, len(widths)):
        if groups[-1] and (used + widths[i] > room or used >= share):
            groups.append([])
            used = 0
        groups[-1].append(i)
        used += widths[i]
    keys = list(range(table.key))
    align = table.align or "<" * len(widths)
    return [
        Table(
            table.caption,
            tuple(table.head[i] for i in keys + chosen),
            tuple(tuple(row[i] for i in keys + chosen) for row in table.rows),
            "".join(align[i] for i in keys + chosen),
            table.label if number == 0 else "",
            table.key,
        )
        for number, chosen in enumerate(groups)
    ]
