"""Every word that a user reads: messages, and the catalogues of texts that still have keys."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from functools import cache

from linkwright.core.entry_points import modules_within
from linkwright.words.contexts import CONTEXTS
from linkwright.words.message import LANGUAGES, Message, _, ngettext, pgettext

__all__ = ["LANGUAGES", "Message", "Say", "_", "has", "language_of", "ngettext", "pgettext", "say"]

Say = Callable[..., str]


def say(text: str, /, language: str = "en", **values: object) -> str:
    """A message, or the one of a key, in a language, with values; raises KeyError."""
    message = text if isinstance(text, Message) else message_of(text)
    return (message.format(**values) if values else message).translate(language)


def message_of(key: str, /, **values: object) -> Message:
    """The message of a key."""
    area, _dot, name = key.partition(".")
    return Message(catalogue(area)[name], values, context=CONTEXTS.get(key, ""), code=key)


def has(key: str) -> bool:
    """Whether the catalogue has a key."""
    area, _dot, name = key.partition(".")
    try:
        return name in catalogue(area)
    except KeyError:
        return False


def language_of(speaks: Say) -> str:
    """The language of a speaker."""
    return str(getattr(speaks, "keywords", {}).get("language", LANGUAGES[0]))


@cache
def catalogue(area: str) -> Mapping[str, str]:
    """All texts of an area; raises KeyError for one that does not exist."""
    name = f"{__name__}.en.{area}"
    try:
        module = importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name != name:
            raise
        raise KeyError(area) from None
    words: Mapping[str, str] = module.WORDS
    return words


def areas() -> tuple[str, ...]:
    """Names of all areas."""
    package = importlib.import_module(f"{__name__}.en")
    return tuple(modules_within(package.__path__))
