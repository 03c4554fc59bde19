"""The texts of the translations, and a record of the messages that are made."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from itertools import zip_longest
from unittest.mock import patch

from babel.messages.pofile import read_po

from linkwright.words import LANGUAGES, message


@cache
def sentences(language: str) -> dict[str, str]:
    """All texts of a language, by the English ones, with their contexts where they have one."""
    path = message.LOCALES / (LANGUAGES[1] if language == "en" else language) / "LC_MESSAGES/linkwright.po"
    with path.open("rb") as file:
        known = [each for each in read_po(file) if each.id]
    return {
        f"{each.context or ''}|{english}": english if language == "en" else text
        for each in known
        for english, text in zip_longest(_forms(each.id), _forms(each.string), fillvalue=_forms(each.string)[-1])
    }


def _forms(text: str | tuple[str, ...] | list[str]) -> tuple[str, ...]:
    return (text,) if isinstance(text, str) else tuple(text)


@contextmanager
def recorded() -> Iterator[set[str]]:
    """The English texts of the messages that are made while it lasts."""
    made: set[str] = set()
    chosen = message._chosen

    def recording(msgid: str, *given: object) -> str:
        made.add(msgid)
        return chosen(msgid, *given)  # type: ignore[arg-type]

    def translating(self: message.Message, language: str) -> str:
        made.add(self.msgid)
        return translate(self, language)

    translate = message.Message.translate
    with patch.object(message, "_chosen", recording), patch.object(message.Message, "translate", translating):
        yield made
