"""Writing of files and folders: atomic, with a reason where it fails."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path

from linkwright.errors import RequestError
from linkwright.words import Message, _
from linkwright.words.characters import printable
from linkwright.words.message import reason_of

#: Permissions of new files, before the user's mask.
_USUAL, _PRIVATE = 0o666, 0o600


_CANNOT_WRITE = _(
    'the file "{path}" cannot be written ({reason}); choose another name or a folder of your own',
    code="file.cannot_write",
)
_CANNOT_MAKE = _(
    'the folder "{path}" cannot be made ({reason}); choose another name or a folder of your own',
    code="file.cannot_make",
)


_folder: ContextVar[Path | None] = ContextVar("folder", default=None)
_EXISTS = _('"{path}" exists; choose another name, or replace it with {remedy}', code="file.exists")


def below(folder: Path, name: str | Path) -> Path | None:
    """The path of a name within a folder without links, its own links followed; None where it leads out of the folder
    or into what is hidden there, or no file can have it."""
    with suppress(OSError, RuntimeError, ValueError):  # links may lead in a circle, and some names no file can have
        path = (folder / name).resolve()
        if path.is_relative_to(folder) and not any(part.startswith(".") for part in path.relative_to(folder).parts):
            return path
    return None


@contextmanager
def confined(folder: Path) -> Iterator[None]:
    """Within it models, the files that they name and files that are written lie below a folder, or are refused."""
    token = _folder.set(folder.resolve())
    try:
        yield
    finally:
        _folder.reset(token)


def is_confined() -> bool:
    """Whether files are bound to a folder."""
    return _folder.get() is not None


def within(folder: Path, name: str | Path) -> Path:
    """The same as :func:`below`; raises RequestError where it leads out of the folder."""
    path = below(folder, name)
    if path is None:
        raise RequestError(
            _(
                '"{path}" does not lie below the folder to which files are bound here; name a file in that folder',
                code="file.outside",
                path=printable(str(name)),
            )
        )
    return path


def allowed(path: str | Path) -> Path:
    """The path of a file; raises RequestError where files are bound to a folder and it does not lie there."""
    folder, target = _folder.get(), Path(path)
    if folder is not None:
        within(folder, target.absolute())
    return target


def refuse_target(path: str | Path, *, force: bool = True, remedy: str = "force=True") -> None:
    """Raise RequestError where a file could not be written, before any work is done.

    A file that is there already is refused unless ``force``; ``remedy`` says how it may be replaced.
    """
    target = Path(path)
    try:
        if target.is_dir():
            raise RequestError(_('"{path}" is a folder; name a file', code="file.is_folder", path=target))
        if not target.parent.is_dir():
            raise RequestError(
                _('there is no folder "{path}"; create it first', code="file.no_folder", path=target.parent)
            )
        target.lstat() if target.is_symlink() else os.stat(target)
    except FileNotFoundError:
        return
    except (OSError, ValueError) as problem:
        raise _refused(target, problem) from None
    if not force:
        raise RequestError(_EXISTS.format(path=target, remedy=remedy))


def refuse_folder(path: str | Path) -> None:
    """Raise RequestError where a folder is not there and could not be made, before any work is done."""
    target = Path(path)
    try:
        there = next(each for each in (target, *target.absolute().parents) if each.exists())
    except (OSError, ValueError) as problem:
        raise _refused(target, problem, _CANNOT_MAKE) from None
    if not there.is_dir():
        raise RequestError(
            _(
                '"{there}" is a file, so there can be no folder "{path}"; choose another name',
                code="file.no_folder_there",
                path=target,
                there=there,
            )
        )
    if not os.access(there, os.W_OK | os.X_OK):
        raise _refused(target, PermissionError(errno.EACCES, ""), _CANNOT_MAKE)


def make_folder(path: str | Path) -> Path:
    """Make a folder, and those that it lies in, where it is not there yet; raises RequestError where it cannot be."""
    target = Path(path)
    try:
        target.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as problem:
        raise _refused(target, problem, _CANNOT_MAKE) from None
    return target


def atomic_write(
    path: str | Path, content: bytes, *, force: bool = True, remedy: str = "force=True", private: bool = False
) -> Path:
    """Write ``content`` to a temporary file next to ``path`` and rename it; a failure leaves nothing.

    A symbolic link stays, and the file that it leads to is replaced; what is no file (a device, a pipe) is written
    to directly. A new file gets the usual permissions, an old one keeps its own; ``private``: only this user may read
    it. A file that is there already, or comes there meanwhile, is refused unless ``force``; ``remedy`` says how it
    may be replaced.
    Raises RequestError where the folder does not exist or cannot be written.
    """
    target = allowed(path)
    refuse_target(target, force=force, remedy=remedy)
    try:
        if target.exists() and not target.is_file():
            target.write_bytes(content)
        else:
            _replace(Path(os.path.realpath(target)), content, force, _PRIVATE if private else _USUAL)
    except FileExistsError:
        raise RequestError(_EXISTS.format(path=target, remedy=remedy)) from None
    except (OSError, ValueError) as problem:
        raise _refused(target, problem) from None
    return target


def write_together(contents: Mapping[Path, bytes], *, force: bool = True, remedy: str = "force=True") -> list[Path]:
    """Write files, all of them or none, each to a temporary file first; folders are made where they are missing.

    Raises RequestError where one cannot be written, and for a file that is there already unless ``force``.
    """
    targets = [allowed(path) for path in contents]
    for target in targets:
        refuse_folder(target.parent)
    made = [make_folder(each) for each in dict.fromkeys(target.parent for target in targets) if not each.exists()]
    waiting: dict[Path, Path] = {}
    try:
        for target, content in zip(targets, contents.values(), strict=True):
            refuse_target(target, force=force, remedy=remedy)
            waiting[target] = _temporary(target)
            try:
                with os.fdopen(_made(waiting[target], _USUAL), "wb") as stream:
                    stream.write(content)
            except OSError as problem:
                raise _refused(target, problem) from None
        for target, temporary in waiting.items():
            os.replace(temporary, target)
    except BaseException:
        for temporary in waiting.values():
            with suppress(OSError):
                os.unlink(temporary)
        for folder in reversed(made):
            with suppress(OSError):
                folder.rmdir()
        raise
    return targets


def write_new(paths: Iterable[Path], content: bytes) -> Path:
    """Write to the first of the paths where no file is; raises RequestError where it cannot be written."""
    for path in paths:
        try:
            return atomic_write(path, content, force=False)
        except RequestError:
            if not path.exists():
                raise
    raise ValueError("no path is free")


@contextmanager
def alone(path: Path) -> Iterator[None]:
    """Within it no other process and no other thread is within it for the same file, which is made and stays.

    Where the file system has no locks, processes are not separated.
    """
    try:
        stream = path.open("ab")
    except OSError as problem:
        raise _refused(path, problem) from None
    with stream:
        with suppress(OSError):
            _lock(stream.fileno())
        yield  # closing the file ends the lock


def _lock(handle: int) -> None:
    if sys.platform == "win32":
        import msvcrt

        os.lseek(handle, 0, os.SEEK_SET)
        msvcrt.locking(handle, msvcrt.LK_LOCK, 1)
    else:
        import fcntl

        fcntl.flock(handle, fcntl.LOCK_EX)


def _replace(target: Path, content: bytes, force: bool, mode: int) -> None:
    """Unless ``force`` the name is taken first, so that one of two writers is refused."""
    temporary = _temporary(target)
    created = [temporary]
    try:
        with os.fdopen(_made(temporary, mode), "wb") as stream:
            stream.write(content)
        if not force:
            os.close(_made(target, mode))
            created.append(target)
        elif mode == _USUAL:
            with suppress(FileNotFoundError):
                os.chmod(temporary, target.stat().st_mode & 0o777)
        os.replace(temporary, target)
    except BaseException:
        for each in created:
            with suppress(OSError):
                os.unlink(each)
        raise


def _temporary(target: Path) -> Path:
    """A name that no file next to one has."""
    import secrets

    return target.parent / f".linkwright-{secrets.token_hex(8)}"


def _made(path: Path, mode: int) -> int:
    """A handle of a file that was not there before."""
    return os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), mode)


def _refused(target: Path, problem: OSError | ValueError, problem_of: Message = _CANNOT_WRITE) -> RequestError:
    shown = str(target) if len(str(target)) < 300 else f"{str(target)[:120]}…"
    return RequestError(problem_of.format(path=shown, reason=reason_of(problem)))
