"""What a report is made of: blocks in reading order, numbered and referred to, before it has any file form.

Texts may hold formulas between dollar signs (LaTeX), ``**strong**`` words and references ``[[label]]`` to what has a
label; a dollar sign of its own is ``\\$``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import field

from linkwright.core.dataclass import dataclass
from linkwright.words import Say

_MARKS = re.compile(r"(\$[^$]+\$|\*\*[^*]+\*\*|`[^`]+`|\[\[[^\]]+\]\])")
_HIDDEN = {"$": "\ue000", "*": "\ue001", "`": "\ue002", "[": "\ue003", "]": "\ue004"}
_INDEXED = re.compile(r"(?<![\w\ue000-\ue004])([A-Za-zα-ωΑ-Ω])_([A-Za-z0-9]+(?:,\d+)?)(?!\w)", re.ASCII)
_SHOWN = {code: sign for sign, code in _HIDDEN.items()}


def literal(text: str) -> str:
    """A text that is printed as it is, whatever marks it holds: names, sentences, sources."""
    return "".join(_HIDDEN.get(c, c) for c in text)


def symbols(text: str) -> str:
    """A sentence printed as it is, but for symbols with an index, which become formulas: ``v_Ax``."""
    return _INDEXED.sub(lambda found: f"${found[1]}_{{{found[2]}}}$", literal(text))


def strong(text: str) -> str:
    """Marked text in bold, its formulas as they are."""
    return "".join(f"**{part}**" if part and not part.startswith("$") else part
                   for part in re.split(r"(\$[^$]+\$)", text))  # fmt: skip


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
    """A paragraph; ``kind`` is empty, ``missing`` (why something is not there), ``note``, ``bullet``, or ``lead``: it
    stays with what follows."""

    text: str
    kind: str = ""


@dataclass(frozen=True)
class Formula:
    """An equation: LaTeX of its sides, joined by equal signs; ``number``: whether it is counted."""

    sides: tuple[str, ...]
    label: str = ""
    number: bool = True


@dataclass(frozen=True)
class Table:
    """A table with a caption; ``align``: ``<``, ``>`` or ``^`` per column; ``key``: columns that every part repeats
    where it is too wide for a page."""

    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    align: str = ""
    label: str = ""
    key: int = 1


@dataclass(frozen=True)
class Figure:
    """Pictures with a caption, each SVG with the share of the page's width that it takes, up to ``tallest`` mm."""

    caption: str
    pictures: tuple[tuple[str, float], ...]
    label: str = ""
    tallest: float = 150.0


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


Block = Heading | Paragraph | Formula | Table | Figure | Code | Source
#: What is numbered within its chapter, each kind for itself.
NUMBERED = (Formula, Table, Figure, Code)


#: A paragraph of fewer characters stays with the formula, table or figure that it leads to.
SHORT = 400


@dataclass
class Document:
    """A report: title, lines under it, blocks; ``number`` counts what is counted, in reading order.

    ``missing``: sentences on what is not there; ``broken``: whether an error of the program is the reason of one;
    ``contents``: whether it has a list of its sections.
    """

    title: str
    say: Say
    language: str = "en"
    lines: tuple[str, ...] = ()
    blocks: list[Block] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)
    broken: bool = False
    contents: bool = True

    def number(self) -> Numbers:
        """Numbers of headings, formulas, tables and figures, and where labels are."""
        return Numbers(self)

    def leads(self, index: int) -> bool:
        """Whether a short paragraph stays with the formula, table or figure behind it, a section's first always."""
        block, before, after = (self.blocks[i : i + 1] for i in (index, max(index - 1, 0), index + 1))
        if not after or not isinstance(block[0], Paragraph) or len(block[0].text) >= SHORT:
            return False
        return (
            isinstance(before[0], Heading)
            or isinstance(after[0], NUMBERED)
            or block[0].text.endswith((":", "："))
        )


def _counted(block: Formula | Table | Figure | Code) -> bool:
    """Whether a block has a number: a formula unless it is without one, a listing with a caption, all others."""
    return bool(block.caption) if isinstance(block, Code) else getattr(block, "number", True)


class Numbers:
    """``of[index]``: the number of a block, as it is printed; ``labels``: block by label."""

    def __init__(self, document: Document) -> None:
        self.of: dict[int, str] = {}
        self.labels: dict[str, int] = {}
        self.document = document
        levels: list[int] = []
        chapter, counts = 0, dict.fromkeys(NUMBERED, 0)
        for index, block in enumerate(document.blocks):
            if isinstance(block, Heading):
                levels = [*(levels + [0] * 4)[: block.level]]
                levels[-1] += 1
                if block.number:
                    self.of[index] = ".".join(map(str, levels))
                if levels[0] != chapter:
                    chapter, counts = levels[0], dict.fromkeys(counts, 0)
            elif isinstance(block, NUMBERED) and _counted(block):
                counts[type(block)] += 1
                self.of[index] = f"{chapter}.{counts[type(block)]}"
            if getattr(block, "label", ""):
                self.labels[block.label] = index  # type: ignore[union-attr]

    def before(self, index: int) -> str:
        """What stands before the text of a heading: its number."""
        return f"{self.of[index]}  " if index in self.of else ""

    def name(self, index: int) -> str:
        """How a block is called in a sentence: ``Table 3.1``."""
        block, say = self.document.blocks[index], self.document.say
        kind = type(block).__name__.lower()
        return say(f"report.name_{kind}", number=self.of.get(index, ""))


Span = tuple[str, str]


def spans(text: str) -> Iterator[Span]:
    """Parts of a text: (``text`` | ``formula`` | ``strong`` | ``code`` | ``reference``, what it holds)."""
    for part in _MARKS.split(text):
        if not part:
            continue
        if part[0] == "$" and len(part) > 2:
            yield "formula", part[1:-1]
        elif part.startswith("**"):
            yield "strong", shown(part[2:-2])
        elif part[0] == "`":
            yield "code", shown(part[1:-1])
        elif part.startswith("[["):
            yield "reference", part[2:-2]
        else:
            yield "text", shown(part)


def plain(text: str) -> str:
    """A text without its marks."""
    return "".join(part for _, part in spans(text))


def longest_part(text: str) -> int:
    """Characters of the longest part of a text that does not break; a formula is one."""
    from linkwright.report.formula import formula, width
    from linkwright.words.characters import cells

    joined = "".join("m" * round(2.6 * width(formula(part))) if kind == "formula" else part
                     for kind, part in spans(text))  # fmt: skip
    return max((cells(word) for word in joined.split(" ")), default=1)


def fitted(table: Table, widest: int) -> Sequence[Table]:
    """A table in parts that are no wider than so many characters; the key columns come in each."""

    widths = [
        2 + max(longest_part(text) for text in (table.head[i], *(row[i] for row in table.rows)))
        for i in range(len(table.head))
    ]
    key, whole = sum(widths[: table.key]), sum(widths)
    if whole <= widest:
        return [table]
    room = max(widest - key, 1)
    share = (whole - key) / -(-(whole - key) // room)
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
