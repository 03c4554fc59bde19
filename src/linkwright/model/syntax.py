"""What a YAML reader's complaint means for the user, and what to do about it."""

from __future__ import annotations

import re
from typing import Any

from linkwright.model.nodes import Remark

_MEANINGS: tuple[tuple[str, str, str], ...] = (
    (
        "mapping values are not allowed",
        "a colon is not expected here",
        'check the indentation, brackets and quotes above, or put a text with ": " in quotes',
    ),
    (
        "could not find expected ':'",
        "a key without a colon",
        'write "key: value", with a space after the colon',
    ),
    (
        "expected ',' or '}'",
        "a mapping in braces is not closed or a comma is missing",
        "separate entries by commas and close with }",
    ),
    (
        "expected ',' or ']'",
        "a list in brackets is not closed or a comma is missing",
        "separate entries by commas and close with ]",
    ),
    ("cannot start any token", "this character cannot begin a value", "put the value in quotes"),
    ("unexpected end of stream", "a quoted text is not closed", "add the closing quote"),
    (
        "expected <block end>",
        "the indentation does not fit the lines above",
        "indent entries of one level by the same number of spaces",
    ),
    (
        "expected key",
        "the indentation does not fit the lines above, or a bracket is closed that was not opened",
        "indent entries of one level by the same number of spaces, and check the brackets",
    ),
    (
        "expected '-' indicator",
        "the indentation does not fit the lines above",
        "indent entries of one level by the same number of spaces",
    ),
    (
        "expected <document start>",
        "this does not belong to what is above: a bracket too many, or an indentation that does not fit",
        "check brackets and indentation",
    ),
    ("expected the node content", "a value is missing here", "write the value"),
    ("expected node content", "a value is missing here", "write the value"),
    ("Unicode character escape code", "half of an escaped character", "write the character itself"),
    ("unacceptable character", "a control character", "remove it: a model is plain text"),
    ("control characters are not allowed", "a control character", "remove it: a model is plain text"),
    ("special characters are not allowed", "a control character", "remove it: a model is plain text"),
    ("unknown escape character", "an unknown escape in a quoted text", "write \\\\ for a backslash"),
    ("undefined tag", "an unknown tag", "remove the tag (the word with !)"),
    ("duplicate", "given twice", "remove one"),
)


def explain(error: Any, text: str) -> Remark:
    """The remark for an exception of the YAML reader."""
    mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
    line, column = _within(text, mark.line, mark.column) if mark is not None else _place(error, text)
    said = str(getattr(error, "problem", None) or getattr(error, "reason", None) or "the text is not YAML")
    context = str(getattr(error, "context", None) or "")
    for sign, message, remedy in _MEANINGS:
        if sign in said:
            return Remark(
                line, column, f"not readable as YAML: {message}{_since(error, line)}", remedy, "syntax"
            )
    where = f" {context}" if context else ""
    return Remark(
        line,
        column,
        f"not readable as YAML{where}: {said}{_since(error, line)}",
        "check indentation, brackets and quotes",
        "syntax",
    )


def _since(error: Any, line: int) -> str:
    opened = getattr(error, "context_mark", None)
    return f" (it began in line {opened.line + 1})" if opened is not None and opened.line != line else ""


def _within(text: str, line: int, column: int) -> tuple[int, int]:
    """The place, or the end of the text where it is behind that."""
    last = text.count("\n")
    return (line, column) if line <= last else (last, len(text) - text.rfind("\n") - 1)


def _place(error: Any, text: str) -> tuple[int, int]:
    position = getattr(error, "position", None)
    if not isinstance(position, int):
        return 0, 0
    before = text.encode("utf-8", "replace")[:position].decode("utf-8", "ignore")
    return before.count("\n"), len(before) - before.rfind("\n") - 1


def tab_remarks(text: str) -> list[Remark]:
    """A remark for each line that is indented with a tab, at most ten."""
    found = []
    for number, line in enumerate(text.split("\n")):
        indentation = re.match(r"[ ]*\t[ \t]*(?=\S)", line)
        if indentation:
            found.append(
                Remark(number, line.index("\t"), "a tab in the indentation", "indent with spaces", "tab")
            )
    return found[:10]
