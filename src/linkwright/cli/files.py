"""Files that are written whole or not at all, and never over another one unless asked."""

from __future__ import annotations

from pathlib import Path

from linkwright import whole_files


def refuse_existing(path: Path, *, force: bool) -> None:
    """Raises RequestError where a file could not be written later, before any work is done."""
    whole_files.refuse_target(path, force=force, remedy="--force")


def write_whole(path: Path, content: str | bytes, *, force: bool) -> None:
    """Writes a file by way of a temporary one beside it, so that a broken one is never seen."""
    refuse_existing(path, force=force)
    whole_files.write_whole(path, content.encode() if isinstance(content, str) else content)
