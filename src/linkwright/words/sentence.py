"""Sentences that know their key and values, so that they can be said again in another language."""

from __future__ import annotations

from linkwright.words import say


class Sentence(str):
    """The English text of a key with its values; ``say("zh")`` is the same in Chinese.

    Values may be sentences themselves, or tuples, which are said with commas in between.
    """

    key: str
    values: dict[str, object]

    def __new__(cls, key: str, **values: object) -> Sentence:
        sentence = super().__new__(cls, _said(key, "en", values))
        sentence.key = key
        sentence.values = values
        return sentence

    def __getnewargs_ex__(self) -> tuple[tuple[str], dict[str, object]]:
        return (self.key,), self.values

    def say(self, language: str = "en") -> str:
        """The text in a language; raises KeyError for one that does not exist."""
        return _said(self.key, language, self.values)


def in_language(text: str, language: str) -> str:
    """A sentence in a language; other texts as they are."""
    return text.say(language) if isinstance(text, Sentence) else text


def _said(key: str, language: str, values: dict[str, object]) -> str:
    return say(key, language, **{name: _value(value, language) for name, value in values.items()})


def _value(value: object, language: str) -> object:
    if isinstance(value, tuple):
        return ", ".join(str(_value(each, language)) for each in value)
    return in_language(value, language) if isinstance(value, str) else value
