"""Texts that a file gives in several languages, and messages put together: codes, values, lists."""

from __future__ import annotations

import errno
import re
from collections.abc import Mapping, Sequence

from linkwright.words.characters import one_line
from linkwright.words.message import LANGUAGES, Message, _

_OWN_NAMES = re.compile(
    r"(?<![\w.-])(?:frame|driver)(?![\w-])|\b(?:max|min)(?=→)|(?<=→)(?:max|min)\b|(?<= )(?:max|min)$"
)


class LocalizedText(str):
    """A text that a file gives in several languages: ``texts``, by language.

    It reads as the text of one language, English unless ``say("zh")`` gave it, or as the first one that there is.
    """

    texts: Mapping[str, str]

    def __new__(cls, texts: Mapping[str, str], language: str = LANGUAGES[0]) -> LocalizedText:
        worded = super().__new__(cls, texts.get(language) or next(iter(texts.values())))
        worded.texts = dict(texts)
        return worded

    def __getnewargs__(self) -> tuple[Mapping[str, str]]:  # type: ignore[override]
        return (self.texts,)

    def say(self, language: str = LANGUAGES[0]) -> LocalizedText:
        """The text in a language."""
        return LocalizedText(self.texts, language)

    def on_one_line(self) -> LocalizedText:
        """The same, each text on one line."""
        return LocalizedText({language: one_line(text) for language, text in self.texts.items()})


def in_language(text: str, language: str) -> str:
    """A message or localized text in a language; plain texts as they are."""
    return text.say(language) if isinstance(text, Message | LocalizedText) else text


NAMES = {"frame": _("frame"), "driver": _("driver"), "max": _("max"), "min": _("min")}
_SYSTEM = {
    "ENOENT": _("No such file or directory"),
    "EACCES": _("Permission denied"),
    "EPERM": _("Operation not permitted"),
    "EISDIR": _("Is a directory"),
    "ENOTDIR": _("Not a directory"),
    "ENOSPC": _("No space left on device"),
    "EROFS": _("Read-only file system"),
    "ENAMETOOLONG": _("File name too long"),
    "EADDRINUSE": _("Address already in use"),
    "EIO": _("Input/output error"),
}


def in_words(subject: str, language: str) -> str:
    """A subject with the names that the program itself gives (frame, driver, max→min) in a language."""
    if language == "en":
        return subject
    translated_subject = _OWN_NAMES.sub(lambda found: NAMES[found[0]].translate(language), subject)
    joint, on, link = translated_subject.partition(" on ")
    return _("{joint} on {link}", joint=joint, link=link).translate(language) if on else translated_subject


def link_label(name: str, language: str) -> str:
    """A link's name; the frame's is translated."""
    return _("frame").translate(language) if name == "frame" else name


def numbered_links(numbers: Mapping[str, int], language: str) -> list[str]:
    """Links with their numbers: ``0 frame``, ``1 crank``."""
    return [f"{number} {link_label(name, language)}" for name, number in numbers.items()]


def code_of(text: object) -> str:
    """The code of a message, or of what is within it where it only says what that is about (``--at: …``)."""
    if isinstance(text, tuple | list):
        return next(filter(None, map(code_of, text)), "")
    if not isinstance(text, Message):
        return getattr(text, "code", "") or getattr(getattr(text, "sentence", None), "code", "")
    return text.code or code_of(tuple(text.values.values()))


def values_of(text: str) -> dict[str, object]:
    """The values of a sentence and, where the names are not taken, of those within it; none of a plain text."""
    own: dict[str, object] = getattr(text, "values", {})
    found = dict(own)
    for value in own.values():
        for each in value if isinstance(value, tuple | list) else (value,):
            inner = getattr(each, "sentence", each)
            found = {**values_of(inner), **found} if isinstance(inner, Message) else found
    return found


def together(items: Sequence[str]) -> str:
    """One or more texts as a list with "and" before the last."""
    *first, last = items
    return _("{first} and {last}", first=tuple(first), last=last) if first else last


def lines(items: Sequence[str]) -> str:
    """One or more sentences, each on a line of its own."""
    first, *rest = items
    return _("{first}\n{second}", first=first, second=lines(rest)) if rest else first


def reason_of(problem: Exception) -> str:
    """Why a file cannot be read or written."""
    name = errno.errorcode.get(getattr(problem, "errno", None) or 0, "")
    if name in _SYSTEM:
        return _SYSTEM[name]
    return getattr(problem, "strerror", None) or str(problem)
