"""The catalogue: both languages have the same keys, with the same values in their texts."""

import re
import string

import pytest

from linkwright import words
from linkwright.cli import commands
from linkwright.errors import speaker


def fields(text: str) -> set[str]:
    return {name for _, name, _, _ in string.Formatter().parse(text) if name is not None}


def test_areas_are_the_same_in_every_language() -> None:
    assert {language: words.areas(language) for language in words.LANGUAGES} == dict.fromkeys(
        words.LANGUAGES, words.areas("en")
    )


@pytest.mark.parametrize("area", words.areas("en"))
def test_keys_and_values_are_the_same_in_every_language(area: str) -> None:
    english = words.catalogue(area, "en")
    assert english
    for language in words.LANGUAGES:
        other = words.catalogue(area, language)
        assert set(other) == set(english)
        assert {key: fields(text) for key, text in other.items()} == {
            key: fields(text) for key, text in english.items()
        }


@pytest.mark.parametrize("name", commands.names())
def test_every_command_has_its_words(name: str) -> None:
    assert {"summary", "description", "examples"} <= set(words.catalogue(name, "en"))


def test_unknown_keys_and_languages_are_refused() -> None:
    with pytest.raises(KeyError):
        words.say("cli.nothing_of_this_name")
    with pytest.raises(KeyError):
        words.say("nothing.summary")
    with pytest.raises(KeyError):
        speaker("de")


def test_values_are_put_in() -> None:
    for language in words.LANGUAGES:
        text = words.catalogue("cli", language)["written"]
        assert "{path}" in text
        assert speaker(language)("cli.written", path="a.csv") == text.replace("{path}", "a.csv")


#: Half-width marks where a Chinese sentence goes on; between a key and its value of the file format they stay.
HALF_WIDTH = re.compile(r"[一-鿿），。；][,;!?]|[,;?] ?[一-鿿]|[一-鿿）]:[^ 一-鿿]|\([^()]*[一-鿿][^()]*\)")
SYNTAX = re.compile(r"\[从, 到\]|\{\{.*?\}\}|gallery:名称|\d:[一-鿿]|=值,值")


@pytest.mark.parametrize("area", words.areas("zh"))
def test_chinese_sentences_have_chinese_punctuation(area: str) -> None:
    found = {
        key: HALF_WIDTH.findall(SYNTAX.sub("", text)) for key, text in words.catalogue(area, "zh").items()
    }
    assert {key: marks for key, marks in found.items() if marks} == {}
