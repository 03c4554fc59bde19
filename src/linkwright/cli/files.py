"""Files that are written whole or not at all, and never over another one unless asked."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from linkwright.cli.errors import UsageError
from linkwright.words import Say


def refuse_existing(path: Path, say: Say, *, force: bool) -> None:
    """Raises UsageError where a file could not be written later, before any work is done."""
    if path.is_dir():
        raise UsageError(say("cli.is_folder", path=path))
    if not path.parent.is_dir():
        raise UsageError(say("cli.no_folder", path=path.parent))
    if path.exists() and not force:
        raise UsageError(say("cli.file_exists", path=path))


def write_whole(path: Path, content: str | bytes, say: Say, *, force: bool) -> None:
    """Writes a file by way of a temporary one beside it, so that a broken one is never seen."""
    refuse_existing(path, say, force=force)
    data = content.encode() if isinstance(content, str) else content
    try:
        handle, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
        try:
            with os.fdopen(handle, "wb") as stream:
                stream.write(data)
            os.chmod(name, 0o666 & ~_mask())
            os.replace(name, path)
        except BaseException:
            os.unlink(name)
            raise
    except OSError as error:
        raise UsageError(say("cli.cannot_write", path=path, reason=error.strerror or error)) from None


def _mask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
