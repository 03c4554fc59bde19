"""The translations: complete, with the same values in their texts."""

import re
import string

import pytest
from tests.unit.words.catalogued import sentences

from linkwright import words
from linkwright.cli import commands
from linkwright.errors import speaker
from linkwright.words import _


def fields(text: str) -> set[str]:
    return {name for _unused, name, _unused2, _unused3 in string.Formatter().parse(text) if name is not None}


@pytest.mark.parametrize("language", words.LANGUAGES[1:])
def test_every_text_is_translated_with_the_same_values(language: str) -> None:
    english, other = sentences("en"), sentences(language)
    assert set(other) == set(english) and len(english) > 4000
    assert [key for key, text in other.items() if not text] == []
    assert [key for key, text in other.items() if "$" not in text and fields(text) != fields(english[key])] == []


@pytest.mark.parametrize("name", commands.names())
def test_every_command_has_its_words(name: str) -> None:
    command = commands.command(name)
    assert command.examples
    for message in (command.summary, command.description):
        assert all(message.translate(language) != message for language in words.LANGUAGES[1:])


def test_unknown_languages_are_refused() -> None:
    with pytest.raises(KeyError):
        speaker("de")


def test_values_are_put_in() -> None:
    for language in words.LANGUAGES:
        text = _("written: {path}").translate(language)
        assert "{path}" in text
        assert speaker(language)(_("written: {path}", path="a.csv")) == text.replace("{path}", "a.csv")


#: Half-width marks where a Chinese sentence goes on; between a key and its value of the file format they stay.
HALF_WIDTH = re.compile(r"[一-鿿），。；][,;!?]|[,;?] ?[一-鿿]|[一-鿿）]:[^ 一-鿿]|\([^()]*[一-鿿][^()]*\)")
SYNTAX = re.compile(r"\[从, 到\]|\[(?:构件\.)?点, (?:构件\.)?点\]|\{\{.*?\}\}|gallery:名称|\d:[一-鿿]|=值,值")


def test_chinese_sentences_have_chinese_punctuation() -> None:
    found = {key: HALF_WIDTH.findall(SYNTAX.sub("", text)) for key, text in sentences("zh").items()}
    assert {key: marks for key, marks in found.items() if marks} == {}
