"""A user's own text: Markdown as blocks, or Typst as it is."""

from __future__ import annotations

import re
from collections.abc import Iterator

from linkwright.report.document import Block, Heading, Paragraph, Source, Table

_HEADING = re.compile(r"(#{1,4})\s+(.*)")
_ITEM = re.compile(r"\s*(?:[-*+]|\d+[.)])\s+(.*)")


def own_text(text: str, level: int = 2) -> Iterator[Block]:
    """Blocks of a text; after a first line ``typst`` it is Typst. Headings begin at ``level``."""
    first, _, rest = text.strip().partition("\n")
    if first.strip().lower() == "typst":
        yield Source(rest)
        return
    for part in re.split(r"\n\s*\n", text.strip()):
        yield from _part(part.splitlines(), level)


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
