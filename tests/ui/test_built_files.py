"""The built files of the front end are those of its sources."""

from __future__ import annotations

import hashlib
import re
from importlib.resources import files
from pathlib import Path

import pytest

import linkwright as lw
from linkwright.words import catalogue

UI = Path(__file__).resolve().parents[2] / "ui"
MOST = 65_000  # bytes of a page with a small model


@pytest.mark.skipif(not UI.is_dir(), reason="the front end's sources are not here")
def test_built_files_fit_their_sources() -> None:
    """The hash that the build wrote; after a change of the sources: ``npm run build`` in ``ui``."""
    made = hashlib.sha256()
    names = [f"src/{path.name}" for path in sorted((UI / "src").iterdir(), key=lambda path: path.name)]
    names += ["package-lock.json", *sorted(path.name for path in UI.glob("vite.*ts"))]
    for name in names:
        made.update(f"{name}\n".encode())
        made.update((UI / name).read_bytes())
    written = (files("linkwright") / "page" / "built" / "sources.sha256").read_text().strip()
    assert written == made.hexdigest()


def test_pages_stay_small() -> None:
    assert len(lw.living_page(lw.read_document("gallery:crank_rocker")).html.encode()) < MOST


@pytest.mark.skipif(not UI.is_dir(), reason="the front end's sources are not here")
def test_every_sentence_that_the_studio_says_is_in_the_catalogues() -> None:
    """By the keys in its sources, those of its tools among them, in both languages."""
    sources = [
        (UI / "src" / name).read_text() for name in ("desk.ts", "optimise.tsx", "paper.ts", "studio.tsx")
    ]
    said = {
        key
        for text in sources
        for key in re.findall(r'(?:desk\.say|this\.say|tell\?\.|\bsay)\("(\w+)"', text)
    }
    (tools,) = (
        found[1] for text in sources if (found := re.search(r"const TOOLS: Tool\[\] = \[(.*)\]", text))
    )
    names = re.findall(r'"(\w+)"', tools)
    said |= {*names, *(f"help_{name}" for name in names)}
    assert len(said) > 60
    for language in ("en", "zh"):
        known = {**catalogue("studio", language), **catalogue("page", language)}
        assert said - set(known) == set()
