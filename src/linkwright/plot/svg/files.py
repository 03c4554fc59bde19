"""Files are written whole or not at all."""

from __future__ import annotations

import os
import tempfile
from contextlib import suppress
from pathlib import Path

from linkwright.errors import LinkwrightError


def write_whole(path: str | Path, content: bytes) -> Path:
    """Write ``content`` next to ``path`` and move it there in one step; nothing is left behind on failure.

    Raises LinkwrightError where the folder does not exist or cannot be written.
    """
    target = Path(path)
    try:
        handle, temporary = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    except OSError as problem:
        raise _refused(target, problem) from None
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
        os.chmod(temporary, 0o644)
        os.replace(temporary, target)
    except BaseException as problem:
        with suppress(OSError):
            os.unlink(temporary)
        if isinstance(problem, OSError):
            raise _refused(target, problem) from None
        raise
    return target


def _refused(target: Path, problem: OSError) -> LinkwrightError:
    reason = problem.strerror or str(problem)
    return LinkwrightError(f"{target} cannot be written: {reason}; choose a folder that exists and is yours")
