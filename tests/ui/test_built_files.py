"""The built files of the front end are those of its sources."""

from __future__ import annotations

import hashlib
from importlib.resources import files
from pathlib import Path

import pytest

import linkwright as lw

UI = Path(__file__).resolve().parents[2] / "ui"
MOST = 65_000  # bytes of a page with a small model


@pytest.mark.skipif(not UI.is_dir(), reason="the front end's sources are not here")
def test_built_files_fit_their_sources() -> None:
    """The hash that the build wrote; after a change of the sources: ``npm run build`` in ``ui``."""
    made = hashlib.sha256()
    names = sorted(path.relative_to(UI).as_posix() for path in (UI / "src").rglob("*") if path.is_file())
    names += ["package-lock.json", *sorted(path.name for path in UI.glob("vite.*ts"))]
    for name in names:
        made.update(f"{name}\n".encode())
        made.update((UI / name).read_bytes())
    written = (files("linkwright") / "page" / "built" / "sources.sha256").read_text().strip()
    assert written == made.hexdigest()


def test_pages_stay_small() -> None:
    assert len(lw.living_page(lw.read_document("gallery:crank_rocker")).html.encode()) < MOST
