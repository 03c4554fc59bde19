"""What reading a model finds, before anything is made of it."""

from __future__ import annotations

from pathlib import Path

from linkwright import Finding
from linkwright.files.model_file import read_text
from linkwright.files.source import read_source


def found_in(source: str | Path) -> list[Finding]:
    """All findings of reading a model; its cycle is not turned. Raises ModelError where there is nothing to read."""
    return read_text(*read_source(source))[1]
