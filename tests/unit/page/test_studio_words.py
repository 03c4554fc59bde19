"""What the sources of the studio's page say."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from linkwright.page.texts import TEXTS as OF_PAGES
from linkwright.server.texts import TEXTS

UI = Path(__file__).resolve().parents[3] / "ui"
pytestmark = pytest.mark.skipif(not UI.is_dir(), reason="the front end's sources are not here")


def sources() -> list[str]:
    return [path.read_text() for path in (UI / "src" / "studio").rglob("*.ts*")]


def test_every_sentence_that_the_studio_says_is_in_the_catalogues() -> None:
    """By the keys in its sources, in both languages."""
    said = {key for text in sources() for key in re.findall(r'(?:\.say|tell\?\.|\.refuse|\bsay)\("([\w.]+)"', text)}
    grouped = r'"((?:hint|refuse|tool|value)\.[a-z_0-9.]+[a-z0-9])"'
    said |= {key for text in sources() for key in re.findall(grouped, text)}
    assert len(said) > 300
    assert said - {key.partition(".")[2] for key in TEXTS | OF_PAGES} == set()


def test_the_studio_says_every_word_of_its_catalogue() -> None:
    """By its key, or by what a key that is put together begins with."""
    texts = sources()
    literal = {key for text in texts for key in re.findall(r'["\'`]([\w.]+)["\'`]', text)}
    begun = tuple({key for text in texts for key in re.findall(r"`([\w.]+)\$\{", text)})
    keys = {key.partition(".")[2] for key in TEXTS}
    assert {key for key in keys - literal if not key.startswith(begun)} == set()
