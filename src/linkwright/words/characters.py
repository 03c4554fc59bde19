"""Texts as a terminal or a table can carry them, and how wide they are there."""

from __future__ import annotations

import re
from collections.abc import Sequence

#: Characters that no text should hold: control characters, halves of pairs, and what Unicode keeps free.
UNFIT = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\ufdd0-\ufdef\ufffe\uffff]")
_UNPRINTABLE = re.compile(rf"(?!\x1b\[[0-9;]*m|\r\x1b\[K){UNFIT.pattern}")
_FORMULA = re.compile(r"[=+\-@\t\r]")
_COLOUR = re.compile("\x1b\\[[0-9;]*m")
#: What stays together where lines break: a word with a number before it, up to a plus or dash; a Chinese character;
#: and the Chinese punctuation behind.
_PIECE = (
    r"\s*(?:\d[\d.]* )?(?:[\u2e80-\uffef]|[^\s+–\u2e80-\uffef]*[+–]|[^\s+–\u2e80-\uffef]+)[，。；：、）]*"
)
#: Space between columns of tables; the last one is folded where it has so many cells.
_COLUMNS = r"(?<=\S) {2,}(?=\S)"
NARROWEST = 12


def terminal_text(text: str) -> str:
    """The text for a terminal: unfit characters replaced; the codes of colours may pass."""
    return _UNPRINTABLE.sub("\ufffd", text)


def cell_text(text: str) -> str:
    """The text as a cell of a table that spreadsheets open: an apostrophe before what they would take for a formula.

    Numbers are no texts and stay as they are.
    """
    return f"'{text}" if _FORMULA.match(text) else text


def printable(text: str) -> str:
    """A text without what neither XML nor a font can hold; tabs and line ends stay."""
    return UNFIT.sub("", text)


def one_line(text: str) -> str:
    """A printable text on one line."""
    return " ".join(printable(text).split())


GAP = "  "


def cells(text: str) -> int:
    """Cells that a text takes: two for a wide (Chinese) character, none for a combining one."""
    text = _COLOUR.sub("", text) if "\x1b" in text else text
    if text.isascii():
        return len(text)
    from unicodedata import combining, east_asian_width

    return sum(0 if combining(c) else 2 if east_asian_width(c) in "WF" else 1 for c in text)


def padded(text: str, width: int, align: str = "<") -> str:
    """The text filled up with spaces to a width, to the left (``<``), right (``>``) or centre (``^``)."""
    space = max(width - cells(text), 0)
    if align == ">":
        return " " * space + text
    if align == "^":
        return " " * (space // 2) + text + " " * (space - space // 2)
    return text + " " * space


def aligned(rows: Sequence[Sequence[str]], align: str, gap: str = GAP) -> list[str]:
    """Lines of a table; ``align`` has one of ``<``, ``>``, ``^`` per column."""
    return [line for (line,) in aligned_within(rows, align, None, gap)]


def aligned_within(
    rows: Sequence[Sequence[str]], align: str, width: int | None, gap: str = GAP
) -> list[list[str]]:
    """Lines of every row of a table that takes at most a width: texts of its widest columns are folded."""
    widths = [max((cells(row[i]) for row in rows), default=0) for i in range(len(align))]
    if width is not None:
        widths = _narrowed(rows, widths, width - len(gap) * (len(align) - 1))
    found = []
    for row in rows:
        folds = [folded(text, wide) for text, wide in zip(row, widths, strict=True)]
        lines = [[fold[k] if k < len(fold) else "" for fold in folds] for k in range(max(map(len, folds)))]
        found.append(
            [
                gap.join(padded(*cell) for cell in zip(each, widths, align, strict=True)).rstrip()
                for each in lines
            ]
        )
    return found


def _narrowed(rows: Sequence[Sequence[str]], widths: Sequence[int], room: int) -> list[int]:
    """Widths of columns in a room: the widest are made narrower, none narrower than its widest word."""
    found = list(widths)
    narrowest = [
        max((cells(each.strip()) for row in rows for each in pieces(row[i])), default=0)
        for i in range(len(widths))
    ]
    while sum(found) > room:
        foldable = [i for i, each in enumerate(narrowest) if found[i] > each]
        if not foldable:
            break
        found[max(foldable, key=lambda i: found[i])] -= 1
    return found


def pieces(text: str) -> list[str]:
    """What a text consists of where lines may break, each with the blanks before it."""
    return re.findall(_PIECE, text)


def folded(text: str, width: int) -> list[str]:
    """A text in lines of at most so many cells; a wider word is not split."""
    if cells(text) <= width:
        return [text]
    lines = [""]
    for piece in pieces(text):
        if lines[-1] and cells(lines[-1] + piece) > width:
            lines.append("")
        lines[-1] += piece if lines[-1] else piece.lstrip()
    return lines


def folded_lines(text: str, width: int) -> str:
    """A text whose sentences are folded, what follows indented; of lines of tables the last column."""
    found = []
    for line in text.split("\n"):
        columns = [each.end() for each in re.finditer(_COLUMNS, line)]
        indent = cells(line) - cells(line.lstrip(" "))
        if cells(line) <= width:
            found.append(line)
        elif not columns:
            first, *rest = folded(line[indent:], width - indent - len(GAP))
            found += [" " * indent + first, *(" " * indent + GAP + each for each in rest)]
        else:
            found += _last_folded(line, columns[-1], width)
    return "\n".join(found)


def _last_folded(line: str, start: int, width: int) -> list[str]:
    """A line of a table with its last column, which begins at a place, folded below itself if there is room."""
    before = cells(line[:start])
    if width - before < NARROWEST:
        return [line]
    first, *rest = folded(line[start:], width - before)
    return [line[:start] + first, *(" " * before + each for each in rest)]
