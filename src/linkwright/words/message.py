"""Messages: English where they are written, translated by gettext when they are shown.

``_("links reach {reach}", reach=length)`` is the English text, a ``str``; ``translate("zh")`` of it is the same in
Chinese, from ``locale/zh/LC_MESSAGES/linkwright.po``. A text with fields but without values is a template: its
``format(reach=length)`` is a message, too.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache
from gettext import NullTranslations, translation
from pathlib import Path
from types import MappingProxyType
from typing import Protocol, runtime_checkable

LOCALES = Path(__file__).parent.parent / "locale"
LANGUAGES = ("en", *sorted(each.parts[-3] for each in LOCALES.glob("*/LC_MESSAGES/linkwright.mo")))
NO_VALUES: Mapping[str, object] = MappingProxyType({})
_BRACE = re.compile("[{}]")
_FIELD = re.compile(r"(?<!\{)(?:\{\{)*\{\w")


@runtime_checkable
class Translatable(Protocol):
    """What has a text in every language."""

    def say(self, language: str = "en") -> str:
        """The text in a language."""


class Message(str):
    """The English text of a message with its values; ``translate("zh")`` is the same in Chinese.

    Values may be messages themselves, anything else that has ``say(language)`` such as an error, or tuples of
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

    def translate(self, language: str) -> str:  # type: ignore[override]
        """The text in a language; raises KeyError for one that does not exist."""
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

    def say(self, language: str = "en") -> str:
        """The text in a language."""
        return self.translate(language)


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
    """A value of a message in a language; numbers as they are."""
    if isinstance(value, tuple | list):
        between = _(", ") if isinstance(value, tuple) else _("; ")
        return between.translate(language).join(str(translated(each, language)) for each in value)
    if callable(value):
        return value(language)
    if isinstance(value, Translatable):
        return value.say(language)
    return value


def _chosen(msgid: str, plural: str, values: Mapping[str, object]) -> str:
    return plural if plural and values["count"] != 1 else msgid


def _filled(text: str, values: Mapping[str, object], language: str) -> str:
    if not _BRACE.search(text) or (not values and _FIELD.search(text)):
        return text
    return text.format(**{name: translated(value, language) for name, value in values.items()})
