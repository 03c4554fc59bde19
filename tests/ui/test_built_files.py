"""The built files of the front end are those of its sources."""

from __future__ import annotations

import hashlib
from importlib.resources import files
from pathlib import Path

import pytest

UI = Path(__file__).resolve().parents[2] / "ui"
MOST = 90_000  # bytes that every page carries beside its model and words


@pytest.mark.skipif(not UI.is_dir(), reason="the front end's sources are not here")
def test_built_files_fit_their_sources() -> None:
    """The hash that the build wrote; after a change of the sources: ``npm run build`` in ``ui``."""
    made = hashlib.sha256()
    names = [f"src/{path.name}" for path in sorted((UI / "src").iterdir(), key=lambda path: path.name)]
    for name in [
        *names,
        "package-lock.json",
        "vite.config.ts",
        "vite.engine.config.ts",
        "vite.studio.config.ts",
    ]:
        made.update(f"{name}\n".encode())
        made.update((UI / name).read_bytes())
    written = (files("linkwright") / "page" / "built" / "sources.sha256").read_text().strip()
    assert written == made.hexdigest()


def test_built_files_stay_small() -> None:
    folder = files("linkwright") / "page" / "built"
    assert sum(len((folder / name).read_bytes()) for name in ("page.js", "page.css")) < MOST
