"""Messages: English where they are written, translated by gettext when they are shown.

``_("links reach {reach}", reach=length)`` is the English text, a ``str``; ``translate("zh")`` of it is the same in
Chinese, from ``locale/zh/LC_MESSAGES/linkwright.po``. A text with fields but without values is a template: its
``format(reach=length)`` is a message, too. Texts that a file gives in several languages are translated the same way.
"""

from __future__ import annotations

import errno
import re
from collections.abc import Mapping, Sequence
from functools import cache
from gettext import NullTranslations, translation
from pathlib import Path
from types import MappingProxyType
from typing import Protocol, runtime_checkable

from linkwright.words.characters import one_line

LOCALES = Path(__file__).parent.parent / "locale"
LANGUAGES = ("en", *sorted(each.parts[-3] for each in LOCALES.glob("*/LC_MESSAGES/linkwright.mo")))
Characters = Mapping[int, int | str | None]
NO_VALUES: Mapping[str, object] = MappingProxyType({})
_BRACE = re.compile("[{}]")
_FIELD = re.compile(r"(?<!\{)(?:\{\{)*\{\w")


@runtime_checkable
class Translatable(Protocol):
    """What has a text in every language."""

    def translate(self, language: str = "en") -> str:
        """The text in a language."""


class Message(str):
    """The English text of a message with its values; ``translate("zh")`` is the same in Chinese.

    Values may be messages themselves, anything else that has ``translate(language)`` such as an error, or tuples of
    these, which are joined by commas, or lists, by semicolons; or functions of the language. ``code`` is a stable
    word for programs and tests, ``context`` distinguishes equal English texts with different translations.
    """

    msgid: str
    plural: str
    context: str
    code: str
    values: dict[str, object]

    def __new__(
        cls,
        msgid: str,
        values: Mapping[str, object] = NO_VALUES,
        *,
        plural: str = "",
        context: str = "",
        code: str = "",
    ) -> Message:
        message = super().__new__(cls, _filled(_chosen(msgid, plural, values), values, "en"))
        message.msgid, message.values = msgid, dict(values)
        message.plural, message.context, message.code = plural, context, code
        return message

    def __getnewargs_ex__(self) -> tuple[tuple[str, dict[str, object]], dict[str, str]]:
        return (self.msgid, self.values), {"plural": self.plural, "context": self.context, "code": self.code}

    def format(self, *args: object, **values: object) -> Message:
        """The message of a template with its values."""
        if args:
            raise TypeError("fields of messages have names")
        (msgid, own), about = self.__getnewargs_ex__()
        return Message(msgid, {**own, **values}, **about)

    def translate(self, language: str | Characters = "en") -> str:  # type: ignore[override]
        """The text in a language; raises KeyError for one that does not exist. With a table of characters it is
        ``str.translate``, which other packages call."""
        if not isinstance(language, str):
            return super().translate(language)
        if language == "en" or not self.msgid:
            return str.__str__(self)
        known = translations(language)
        if self.plural:
            text = known.ngettext(self.msgid, self.plural, int(str(self.values["count"])))
        elif self.context:
            text = known.pgettext(self.context, self.msgid)
        else:
            text = known.gettext(self.msgid)
        return _filled(text, self.values, language)


def _(msgid: str, /, *, code: str = "", **values: object) -> Message:
    """A message with its values."""
    return Message(msgid, values, code=code)


def pgettext(context: str, msgid: str, /, *, code: str = "", **values: object) -> Message:
    """A message whose English text has another translation elsewhere; ``context`` says which is meant."""
    return Message(msgid, values, context=context, code=code)


def ngettext(singular: str, plural: str, /, *, count: int, code: str = "", **values: object) -> Message:
    """A message about a number of things, with the plural forms of each language."""
    return Message(singular, {"count": count, **values}, plural=plural, code=code)


@cache
def translations(language: str) -> NullTranslations:
    """The translations into a language; raises KeyError for one that does not exist."""
    if language not in LANGUAGES:
        raise KeyError(language)
    if language == LANGUAGES[0]:
        return NullTranslations()
    return translation("linkwright", str(LOCALES), [language])


def translated(value: object, language: str) -> object:
    """A value of a message in a language; numbers and plain texts as they are."""
    if type(value) is str:
        return value
    if isinstance(value, tuple | list):
        between = _(", ") if isinstance(value, tuple) else _("; ")
        return between.translate(language).join(str(translated(each, language)) for each in value)
    if callable(value):
        return value(language)
    if isinstance(value, Translatable):
        return value.translate(language)
    return value


def _chosen(msgid: str, plural: str, values: Mapping[str, object]) -> str:
    return plural if plural and values["count"] != 1 else msgid


def _filled(text: str, values: Mapping[str, object], language: str) -> str:
    if not _BRACE.search(text) or (not values and _FIELD.search(text)):
        return text
    return text.format(**{name: translated(value, language) for name, value in values.items()})


_OWN_NAMES = re.compile(
    r"(?<![\w.-])(?:frame|driver)(?![\w-])|\b(?:max|min)(?=→)|(?<=→)(?:max|min)\b|(?<= )(?:max|min)$"
)


class LocalizedText(str):
    """A text that a file gives in several languages: ``texts``, by language.

    It reads as the text of one language, English unless ``translate("zh")`` gave it, or as the first one there is.
    """

    texts: Mapping[str, str]

    def __new__(cls, texts: Mapping[str, str], language: str = LANGUAGES[0]) -> LocalizedText:
        worded = super().__new__(cls, texts.get(language) or next(iter(texts.values())))
        worded.texts = dict(texts)
        return worded

    def __getnewargs__(self) -> tuple[Mapping[str, str]]:  # type: ignore[override]
        return (self.texts,)

    def translate(self, language: str | Characters = LANGUAGES[0]) -> LocalizedText:  # type: ignore[override]
        """The text in a language; with a table of characters, as ``str.translate``."""
        if not isinstance(language, str):
            return LocalizedText({each: text.translate(language) for each, text in self.texts.items()})
        return LocalizedText(self.texts, language)

    def on_one_line(self) -> LocalizedText:
        """The same, each text on one line."""
        return LocalizedText({language: one_line(text) for language, text in self.texts.items()})


def in_language(text: str, language: str) -> str:
    """A message or localized text in a language; plain texts as they are."""
    return text.translate(language) if isinstance(text, Message | LocalizedText) else text


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
