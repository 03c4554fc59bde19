"""Every word that a user reads, by key and language.

A key begins with its area: ``solve.summary`` is in ``words/en/solve.py`` and ``words/zh/solve.py``, each
with one mapping ``WORDS`` of keys without the area. A new area is one more file per language; both
languages have the same keys and the same ``{names}`` in their texts. What is the same text in all of them stands in
``words/untranslated.py``, by whole keys.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from functools import cache

from linkwright.core.entry_points import modules_within
from linkwright.words.untranslated import WORDS as ALIKE

LANGUAGES = ("en", "zh")
Say = Callable[..., str]


def say(key: str, language: str = "en", **values: object) -> str:
    """The text of a key in a language, its ``{names}`` replaced by ``values``, each said in that language; raises
    KeyError."""
    area, _, name = key.partition(".")
    text = catalogue(area, language)[name]
    told = {key: each.say(language) if hasattr(each, "say") else each for key, each in values.items()}
    return text.format(**told) if told else text


def has(key: str) -> bool:
    """Whether the catalogue has a key."""
    area, _, name = key.partition(".")
    try:
        return name in catalogue(area, LANGUAGES[0])
    except KeyError:
        return False


def language_of(speaks: Say) -> str:
    """The language of a speaker."""
    return str(getattr(speaks, "keywords", {}).get("language", LANGUAGES[0]))


@cache
def catalogue(area: str, language: str) -> Mapping[str, str]:
    """All texts of an area; raises KeyError for an area or a language that does not exist."""
    if language not in LANGUAGES:
        raise KeyError(language)
    name = f"{__name__}.{language}.{area}"
    try:
        module = importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name != name:
            raise
        raise KeyError(area) from None
    shared = {key.removeprefix(f"{area}."): text for key, text in ALIKE.items() if key.startswith(f"{area}.")}
    return {**module.WORDS, **shared}


def areas(language: str) -> tuple[str, ...]:
    """Names of all areas of a language."""
    package = importlib.import_module(f"{__name__}.{language}")
    return tuple(modules_within(package.__path__))
