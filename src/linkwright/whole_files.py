"""Files are written whole or not at all."""

from __future__ import annotations

import errno
import os
from contextlib import suppress
from pathlib import Path

from linkwright.errors import RequestError
from linkwright.words.sentence import reason_of


def refuse_target(path: str | Path, *, force: bool = True, remedy: str = "force=True") -> None:
    """Raise RequestError where a file could not be written, before any work is done.

    A file that is there already is refused unless ``force``; ``remedy`` says how it may be replaced.
    """
    target = Path(path)
    try:
        if target.is_dir():
            raise RequestError("file.is_folder", path=target)
        if not target.parent.is_dir():
            raise RequestError("file.no_folder", path=target.parent)
        target.lstat() if target.is_symlink() else os.stat(target)
    except FileNotFoundError:
        return
    except (OSError, ValueError) as problem:
        raise _refused(target, problem) from None
    if not force:
        raise RequestError("file.exists", path=target, remedy=remedy)


def refuse_folder(path: str | Path) -> None:
    """Raise RequestError where a folder is not there and could not be made, before any work is done."""
    target = Path(path)
    try:
        there = next(each for each in (target, *target.absolute().parents) if each.exists())
    except (OSError, ValueError) as problem:
        raise _refused(target, problem, "file.cannot_make") from None
    if not there.is_dir():
        raise RequestError("file.no_folder_there", path=target, there=there)
    if not os.access(there, os.W_OK | os.X_OK):
        raise _refused(target, PermissionError(errno.EACCES, ""), "file.cannot_make")


def make_folder(path: str | Path) -> Path:
    """Make a folder, and those that it lies in, where it is not there yet; raises RequestError where it cannot be."""
    target = Path(path)
    try:
        target.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as problem:
        raise _refused(target, problem, "file.cannot_make") from None
    return target


def write_whole(path: str | Path, content: bytes) -> Path:
    """Write ``content`` beside ``path`` and move it there in one step; nothing is left behind on failure.

    A symbolic link stays, and the file that it leads to is replaced; what is no file (a device, a pipe) is written
    to directly. A new file gets the usual permissions, an old one keeps its own.
    Raises RequestError where the folder does not exist or cannot be written.
    """
    target = Path(path)
    refuse_target(target)
    try:
        if target.exists() and not target.is_file():
            target.write_bytes(content)
        else:
            _replace(Path(os.path.realpath(target)), content)
    except (OSError, ValueError) as problem:
        raise _refused(target, problem) from None
    return target


def _replace(target: Path, content: bytes) -> None:
    import secrets

    beside = target.parent / f".linkwright-{secrets.token_hex(8)}"
    handle = os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o666)
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
        with suppress(FileNotFoundError):
            os.chmod(beside, target.stat().st_mode & 0o777)
        os.replace(beside, target)
    except BaseException:
        with suppress(OSError):
            os.unlink(beside)
        raise


def _refused(target: Path, problem: OSError | ValueError, said: str = "file.cannot_write") -> RequestError:
    shown = str(target) if len(str(target)) < 300 else f"{str(target)[:120]}…"
    return RequestError(said, path=shown, reason=reason_of(problem))
