"""Every word that a user reads: messages in English where they stand, translated when they are shown."""

from __future__ import annotations

from collections.abc import Callable

from linkwright.words.message import LANGUAGES, Message, _, in_language, ngettext, pgettext

__all__ = [
    "LANGUAGES",
    "Message",
    "Translate",
    "_",
    "in_language",
    "language_of",
    "ngettext",
    "pgettext",
    "translate",
]

Translate = Callable[[Message], str]


def translate(message: Message, /, language: str = "en") -> str:
    """A message in a language; raises KeyError for one that does not exist."""
    return message.translate(language)


def language_of(speaks: Translate) -> str:
    """The language of a speaker."""
    return str(getattr(speaks, "keywords", {}).get("language", LANGUAGES[0]))
