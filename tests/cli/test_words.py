"""The catalogue: both languages have the same keys, with the same values in their texts."""

import string

import pytest

from linkwright import words
from linkwright.cli import commands


def fields(text: str) -> set[str]:
    return {name for _, name, _, _ in string.Formatter().parse(text) if name is not None}


def test_areas_are_the_same_in_every_language() -> None:
    assert {language: words.areas(language) for language in words.LANGUAGES} == dict.fromkeys(
        words.LANGUAGES, words.areas("en")
    )


@pytest.mark.parametrize("area", words.areas("en"))
def test_keys_and_values_are_the_same_in_every_language(area: str) -> None:
    english = words.catalogue(area, "en")
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
        words.speaker("de")


def test_values_are_put_in() -> None:
    assert words.speaker("en")("cli.written", path="a.csv") == "written: a.csv"
    assert "a.csv" in words.speaker("zh")("cli.written", path="a.csv")
