"""A user's own text: Markdown as blocks, or Typst as it is."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from linkwright.errors import LinkwrightError
from linkwright.report.document import Block, Heading, Paragraph, Source, Table, literal
from linkwright.report.formula import formula
from linkwright.report.typst_pages import typst_fault
from linkwright.words.sentence import Sentence

_HEADING = re.compile(r"(#{1,4})\s+(.*)")
_ITEM = re.compile(r"\s*(?:[-*+]|\d+[.)])\s+(.*)")


def own_text(text: str, level: int = 2) -> Iterator[Block]:
    """Blocks of a text; after a first line ``typst`` it is Typst. Headings begin at ``level``."""
    first, _, rest = text.strip().partition("\n")
    if first.strip().lower() == "typst":
        yield Source(rest)
        return
    text = re.sub(r"\\([$*`\[\]])", lambda found: literal(found[1]), text)
    for part in re.split(r"\n\s*\n", text.strip()):
        yield from _part(part.splitlines(), level)


def printable(block: Block) -> tuple[Block, list[str]]:
    """A block of own text that every form can print, and sentences on what had to be changed.

    What stands between dollar signs and is no formula comes as it is written; Typst that does not compile is shown
    as text.
    """
    if isinstance(block, Source) and (fault := typst_fault(block.text)):
        return Paragraph(literal(block.text)), [Sentence("report.bad_typst", message=fault)]
    said: list[str] = []
    if isinstance(block, Paragraph | Heading):
        block = replace(block, text=_formulas(block.text, said))
    elif isinstance(block, Table):
        head, *rows = (tuple(_formulas(cell, said) for cell in row) for row in (block.head, *block.rows))
        block = replace(block, head=head, rows=tuple(rows))
    return block, said


def _formulas(text: str, said: list[str]) -> str:
    """A text whose formulas that cannot be printed are texts; why goes to ``said``."""
    parts = []
    for part in re.split(r"(\$[^$]+\$)", text):
        if part.startswith("$") and len(part) > 2:
            try:
                formula(part[1:-1])
            except LinkwrightError as error:
                said.append(error.sentence)
                part = literal(part)
        parts.append(part)
    return "".join(parts)


def _part(lines: list[str], level: int) -> Iterator[Block]:
    if len(lines) > 1 and lines[0].lstrip().startswith("|") and set(lines[1]) <= set("|:- "):
        yield _table(lines)
        return
    words: list[str] = []
    for line in lines:
        heading, item = _HEADING.fullmatch(line.strip()), _ITEM.fullmatch(line)
        if (heading or item) and words:
            yield Paragraph(" ".join(words))
            words = []
        if heading:
            yield Heading(heading[2], min(level + len(heading[1]) - 1, 4))
        elif item:
            yield Paragraph(item[1], "bullet")
        else:
            words.append(line.strip())
    if words:
        yield Paragraph(" ".join(words))


def _table(lines: list[str]) -> Table:
    cells = [tuple(cell.strip() for cell in line.strip().strip("|").split("|")) for line in lines]
    head, marks, *rows = cells
    align = "".join("^" if m[:1] == m[-1:] == ":" else ">" if m[-1:] == ":" else "<" for m in marks)
    width = len(head)
    return Table(
        "", head, tuple((*row, *[""] * width)[:width] for row in rows), (align + "<" * width)[:width]
    )
