"""What the sources of the studio's page say."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from linkwright.page.texts import TEXTS as OF_PAGES
from linkwright.server.web import TEXTS

UI = Path(__file__).resolve().parents[3] / "ui"


@pytest.mark.skipif(not UI.is_dir(), reason="the front end's sources are not here")
def test_every_sentence_that_the_studio_says_is_in_the_catalogues() -> None:
    """By the keys in its sources, those of its tools among them, in both languages."""
    named = [UI / "src" / name for name in ("desk.ts", "optimise.tsx", "paper.ts", "studio.tsx")]
    sources = [path.read_text() for path in (*named, *(UI / "src" / "studio").rglob("*.ts*"))]
    said = {key for text in sources for key in re.findall(r'(?:\.say|tell\?\.|\.refuse|\bsay)\("([\w.]+)"', text)}
    grouped = r'"((?:hint|refuse|tool|value)\.[a-z_0-9.]+[a-z0-9])"'
    said |= {key for text in sources for key in re.findall(grouped, text)}
    (tools,) = (found[1] for text in sources if (found := re.search(r"const TOOLS: Tool\[\] = \[(.*)\]", text)))
    names = re.findall(r'"(\w+)"', tools)
    said |= {*names, *(f"help_{name}" for name in names)}
    assert len(said) > 60
    assert said - {key.partition(".")[2] for key in TEXTS | OF_PAGES} == set()
