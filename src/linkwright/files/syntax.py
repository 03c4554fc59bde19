"""What a YAML reader's complaint means for the user, and what to do about it."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import islice
from typing import Any

from linkwright.fields.nodes import Remark
from linkwright.words import Message, _, pgettext

#: What the reader's complaints mean, by keys of ``_PROBLEMS``.
_MEANINGS: tuple[tuple[str, str], ...] = (
    ("mapping values are not allowed", "colon"),
    ("could not find expected ':'", "no_colon"),
    ("expected ',' or '}'", "open_brace"),
    ("expected ',' or ']'", "open_bracket"),
    ("cannot start any token", "beginning"),
    ("expected alphabetic or numeric character", "beginning"),
    ("unexpected non-alphabetical character", "beginning"),
    ("unknown directive name", "beginning"),
    ("could not find expected directive name", "beginning"),
    ("unexpected end of stream", "open_quote"),
    ("expected <block end>", "indentation"),
    ("expected key", "indentation_or_bracket"),
    ("expected '-' indicator", "no_item"),
    ("sequence entries are not allowed", "item"),
    ("expected <document start>", "apart"),
    ("expected the node content", "no_value"),
    ("expected comment or line break", "block"),
    ("expected a comment or a line break", "block"),
    ("expected node content", "no_value"),
    ("Unicode character escape code", "half_character"),
    ("unacceptable character", "some_control"),
    ("control characters are not allowed", "some_control"),
    ("special characters are not allowed", "some_control"),
    ("unknown escape character", "escape"),
    ("undefined tag", "unknown_tag"),
    ("duplicate", "given_twice"),
)


#: What these complaints and slips are, and what to do about them.
_PROBLEMS = {
    "colon": (
        _("a colon is not expected here"),
        _('check the indentation, brackets and quotes above, or put a text with ": " in quotes'),
    ),
    "no_colon": (_("a key without a colon"), _('write "key: value", with a space after the colon')),
    "open_brace": (
        _("a mapping in braces is not closed or a comma is missing"),
        _("separate entries by commas and close with }}"),
    ),
    "open_bracket": (
        _("a list in brackets is not closed or a comma is missing"),
        _("separate entries by commas and close with ]"),
    ),
    "beginning": (_('the character "{sign}" cannot begin a value'), _("put the value in quotes")),
    "open_quote": (_("a quoted text is not closed"), _("add the closing quote")),
    "indentation": (
        _("the indentation does not fit the lines above"),
        _("indent entries of one level by the same number of spaces"),
    ),
    "indentation_or_bracket": (
        _("the indentation does not fit the lines above, or a bracket is closed that was not opened"),
        _("indent entries of one level by the same number of spaces, and check the brackets"),
    ),
    "no_item": (
        _("an entry of a list has no dash"),
        _('begin every item of the list with "- ", or none, and check the indentation'),
    ),
    "item": (
        _("an item of a list cannot begin in the middle of a line"),
        _("write the list as [A, B] or each item on a line of its own, and a minus without a space behind it"),
    ),
    "apart": (
        _("this does not belong to what is above: a bracket too many, or an indentation that does not fit"),
        _("check brackets and indentation"),
    ),
    "no_value": (_("a value is missing here"), _("write the value")),
    "block": (
        _("a value that begins with > or | is the text of the lines below it"),
        _("put a text that begins so in quotes; a bound is written at least 30 deg or at most 60 kN"),
    ),
    "half_character": (_("half of an escaped character"), _("write the character itself")),
    "some_control": (_("a control character"), _("remove it: a model is plain text")),
    "escape": (_("an unknown escape in a quoted text"), _("write \\\\ for a backslash")),
    "unknown_tag": (_("an unknown tag"), _("remove the tag (the word with !)")),
    "given_twice": (_("duplicate"), _("remove one")),
    "blank_after": (
        _('the blank after the colon of "{key_}" is not a space ({character})'),
        _("write a space there"),
    ),
    "no_space": (_('there is no space after the colon of "{key_}"'), _("write {key_}: {rest}")),
    "no_space_item": (_("there is no space after the dash of a list's item"), _("write - {rest}")),
    "equals_sign": (_('an equals sign follows the key "{key_}"'), _("write {key_}: {rest}")),
    "odd_quote": (_("the quotation mark {sign} is none of YAML"), _('write "…" in its place, or none')),
    "comment": (_('a line cannot begin with "{sign}"'), _("begin a comment with #, or put the value in quotes")),
}
#: Problems whose cause is where the unreadable part begins.
_AT_THE_BEGINNING = ("no_colon", "open_quote", "beginning")
#: Slips by which a line is no key with its value, and what the line looks like; groups are what is to be written.
_KEY_OF = r"\s*(?:- )?(?P<key_>[^\W\d][\w.-]*)"
_SLIPS = {
    "blank_after": rf"{_KEY_OF}:(?P<sign>[\xa0\u2000-\u200b\u202f\u205f\u3000\ufeff])",
    "no_space": rf"{_KEY_OF}:(?P<rest>[^\s/].*)",
    "no_space_item": r"\s*-(?P<rest>[^\W\d].*)",
    "equals_sign": rf"{_KEY_OF}\s*=\s*(?P<rest>\S.*)",
    "odd_quote": rf"(?:{_KEY_OF}:)?\s+(?P<sign>[“”‘’])",
    "comment": r"\s*(?P<sign>//|/\*|%|;|--(?!-))",
}


def explain(error: Any, text: str) -> Remark:
    """The remark for an exception of the YAML reader."""
    context_mark = getattr(error, "context_mark", None)
    mark = getattr(error, "problem_mark", None) or context_mark
    line, column = _place(error, text) if mark is None else _within(text, mark)
    began = None if context_mark is None else _within(text, context_mark)
    mistake = _known_mistake(text, line if began is None else began[0], line)
    if mistake is not None:
        return mistake
    problem = str(getattr(error, "problem", None) or getattr(error, "reason", None) or "the text is not YAML")
    key = next((key for sign, key in _MEANINGS if sign in problem), None)
    ended = mark is not None and not text[mark.index :].strip()
    if began is not None and (ended or key in _AT_THE_BEGINNING):
        line, column = began
    since = _(" (it began in line {line})", line=began[0] + 1) if began is not None and began[0] != line else ""
    if key is not None:
        sign, (message, remedy) = text.split("\n")[line][column : column + 1], _PROBLEMS[key]
        message = _("not readable as YAML: {message}{since}", message=message.format(sign=sign), since=since)
        return Remark(line, column, message, remedy.format(), "syntax")
    context = str(getattr(error, "context", None) or "")
    where = f" {context}" if context else ""
    message = _("not readable as YAML{where}: {problem}{since}", where=where, problem=problem, since=since)
    return Remark(line, column, message, _("check indentation, brackets and quotes"), "syntax")


def _known_mistake(text: str, began: int, line: int) -> Remark | None:
    """The remark about a typing mistake in the line where the unreadable part begins, in the one where it could
    not be read any further, or in the one above that."""
    lines = text.split("\n")
    above = next((number for number in range(line - 1, -1, -1) if lines[number].strip()), line)
    for number in dict.fromkeys((began, line, above)):
        shown = lines[number].rstrip()
        for key, pattern in _SLIPS.items():
            if found := re.match(pattern, shown):
                values = found.groupdict()
                character = f"U+{ord(values.get('sign', ' ')[0]):04X}"
                message, remedy = (each.format(character=character, **values) for each in _PROBLEMS[key])
                return Remark(number, len(shown) - len(shown.lstrip()), message, remedy, "syntax")
    return None


def _within(text: str, mark: Any) -> tuple[int, int]:
    """The line and column of a mark, or the end of the text where it is behind that: the reader ends every text with
    a line of its own."""
    last = text.count("\n")
    return (mark.line, mark.column) if mark.line <= last else (last, len(text) - text.rfind("\n") - 1)


def _place(error: Any, text: str) -> tuple[int, int]:
    position = getattr(error, "position", None)
    if not isinstance(position, int):
        return 0, 0
    before = text.encode("utf-8", "replace")[:position].decode("utf-8", "ignore")
    return before.count("\n"), len(before) - before.rfind("\n") - 1


#: Most remarks of one kind about a text.
_MOST = 10
#: What separates the two versions of a merge, alone in its line or with the name of a version.
_CONFLICT = re.compile(r"^(<{7}|={7}|>{7}|\|{7})(?= |$)", re.M)
#: What looks like the space of an indentation and is none, before a key or an item.
_BLANK = re.compile(r"^ *([\xa0\u2000-\u200b\u202f\u205f\u3000\ufeff])(?=\s*(?:- |[\w.-]+ *:(?: |$)))", re.M)
_TAB = re.compile(r"^ *(\t)(?=[ \t]*\S)", re.M)


def _remarks(found: Iterable[re.Match[str]], text: str, message: Message, remedy: Message, code: str) -> list[Remark]:
    """The remark for the first places of a text."""
    remarks = []
    for each in islice(found, _MOST):
        start = text.rfind("\n", 0, each.start(1)) + 1
        line, values = text.count("\n", 0, start), {"sign": each[1], "character": f"U+{ord(each[1][0]):04X}"}
        remarks.append(Remark(line, each.start(1) - start, message.format(**values), remedy, code))
    return remarks


def accident_remarks(text: str) -> list[Remark]:
    """Remarks about what no text should hold, readable or not: conflict markers of an unfinished merge, blanks in
    the indentation that are no spaces."""
    if "<<<<<<<" in text or ">>>>>>>" in text:
        conflicts = _remarks(
            _CONFLICT.finditer(text),
            text,
            _('the mark "{sign}" of an unfinished merge of two versions'),
            _("keep one of the two versions, and remove the other and the lines <<<<<<<, =======, >>>>>>>"),
            "conflict",
        )
        if conflicts:
            return conflicts
    return (
        []
        if text.isascii()
        else _remarks(
            _BLANK.finditer(text),
            text,
            _("a blank in the indentation that is not a space ({character})"),
            _("indent with spaces"),
            "blank",
        )
    )


def tab_remarks(text: str) -> list[Remark]:
    """A remark for each line that is indented with a tab, at most ten."""
    return _remarks(
        _TAB.finditer(text), text, _("a tab in the indentation"), pgettext("yaml", "indent with spaces"), "tab"
    )


#: Full-width punctuation with what YAML writes for it, in a key, and anywhere in braces and brackets.
_HALF = {
    "：": ": ",
    "，": ",",
    "｛": "{",
    "｝": "}",
    "［": "[",
    "］": "]",
    "【": "[",
    "】": "]",
    "、": ",",
    "（": "(",
    "）": ")",
}
_QUOTES = {"“": '"', "”": '"', "‘": "'", "’": "'"}
_WIDE = re.compile("[" + "".join({**_HALF, **_QUOTES}) + "]")
_KEY = re.compile(r"(?:^|[{,｛，])\s*(?:- )?[\w.]+\s*(：)")
_QUOTED = re.compile(r"\"(?:[^\"\\]|\\.)*\"|'(?:[^']|'')*'|#.*")


def wide_remarks(text: str) -> list[Remark]:
    """A remark for each line of a text that cannot be read with full-width punctuation in the place of YAML's own,
    at most ten."""
    found = []
    for number, line in enumerate(text.split("\n")):
        plain = _QUOTED.sub(lambda quoted: " " * len(quoted[0]), line)
        places = [key.start(1) for key in _KEY.finditer(plain)]
        opened = min((plain.find(each) for each in "{[｛［【" if each in plain), default=len(plain))
        places += [
            at for at, each in enumerate(plain) if each in "｛｝［］【】" or (each in "，、“”‘’" and at > opened)
        ]
        if places:
            wide = line[min(places)]
            message = _('the full-width character "{wide}" is not punctuation of YAML', code="yaml.wide", wide=wide)
            found.append(Remark(number, min(places), message, wide_remedy(wide), "syntax"))
    return found[:_MOST]


def wide_remedy(text: str) -> str:
    """What to write for the first full-width punctuation of a text, nothing where there is none."""
    found = _WIDE.search(text)
    if found is None:
        return ""
    if found[0] in _QUOTES:
        return _(
            "write the quotation mark {half} in place of {wide}, or none",
            code="yaml.quotes_do",
            wide=found[0],
            half=_QUOTES[found[0]],
        )
    return _('write "{half}" in place of "{wide}"', half=_HALF[found[0]], wide=found[0])
