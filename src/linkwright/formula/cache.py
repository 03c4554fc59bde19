"""Machine code in memory and in the user's cache folder.

The folder is ``LINKWRIGHT_CACHE`` where set (``off``: no folder), else ``linkwright`` in the
user's cache folder (``XDG_CACHE_HOME``, ``~/.cache``; on Windows ``LOCALAPPDATA``, on macOS
``~/Library/Caches``), made with mode 0700. A folder of another user, or one that others may
write, is not used. A file counts where its header is that of this machine and version and its
checksum fits; anything else is ignored and written anew.
"""

from __future__ import annotations

import hashlib
import os
import sys
import tempfile
import threading
import warnings
from collections import OrderedDict
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path

from linkwright.formula import machine_code
from linkwright.words import _

_IN_MEMORY = 128
#: Size limit of all files together, bytes; beyond it the oldest by use are removed.
SIZE_LIMIT = 64 * 1024 * 1024
_DIGEST = 32
_SUFFIX = ".lwcode"
_SOURCES = ("ir_*.py", "kernel*.py", "functions.py", "table.py", "lines.py", "reductions.py", "machine_code.py")

_memory: OrderedDict[str, machine_code.Loaded] = OrderedDict()
_lock = threading.RLock()


def loaded_code(key: str, text: Callable[[], tuple[str, int]], entry: str) -> machine_code.Loaded:
    """Code for ``key``: from memory, from the folder, or compiled from ``text()``, a module and a level."""
    place = f"{machine_code.host().description} {key}"
    with _lock:
        if place in _memory:
            _memory.move_to_end(place)
            return _memory[place]
        loaded = _from_folder(key, entry)
        if loaded is None:
            code = machine_code.object_code(*text())
            loaded = machine_code.Loaded(code, entry)
            with suppress(OSError):
                _write(key, code)
        _memory[place] = loaded
        while len(_memory) > _IN_MEMORY:
            _memory.popitem(last=False)
        return loaded


def forget() -> None:
    """Empty the memory; the folder stays."""
    with _lock:
        _memory.clear()


def folder() -> Path | None:
    """The folder of cached machine code, or None where it is not cached."""
    chosen = os.environ.get("LINKWRIGHT_CACHE")
    if chosen is not None:
        return None if chosen.lower() in ("off", "") else Path(chosen)
    if os.environ.get("XDG_CACHE_HOME"):
        base = Path(os.environ["XDG_CACHE_HOME"])
    elif sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA", Path.home() / "AppData" / "Local"))
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Caches"
    else:
        base = Path.home() / ".cache"
    return base / "linkwright"


@cache
def _stamp() -> str:
    """Digest of everything in this package that decides the code."""
    digest = hashlib.blake2b(digest_size=16)
    here = Path(__file__).parent
    for pattern in _SOURCES:
        for path in sorted(here.glob(pattern)):
            digest.update(path.read_bytes())
    return digest.hexdigest()


def _header(key: str) -> bytes:
    return f"linkwright machine code\n{_stamp()}\n{machine_code.host().description}\n{key}\n".encode()


def _path(base: Path, key: str) -> Path:
    return base / (hashlib.blake2b(_header(key), digest_size=20).hexdigest() + _SUFFIX)


def _from_folder(key: str, entry: str) -> machine_code.Loaded | None:
    with suppress(OSError, RuntimeError, ValueError):
        code = _read(key)
        if code is not None:
            return machine_code.Loaded(code, entry)
    return None


def _read(key: str) -> bytes | None:
    base = folder()
    if base is None or not base.is_dir() or not _private(base):
        return None
    path = _path(base, key)
    data, header = path.read_bytes(), _header(key)
    code = data[len(header) + _DIGEST :]
    if not code or not data.startswith(header + _checksum(code)):
        return None
    with suppress(OSError):
        os.utime(path)
    return code


def _write(key: str, code: bytes) -> None:
    base = folder()
    if base is None:
        return
    base.mkdir(parents=True, exist_ok=True, mode=0o700)
    if _private(base):
        _replace(_path(base, key), _header(key) + _checksum(code) + code)
        _remove_oldest(base)


def _checksum(code: bytes) -> bytes:
    return hashlib.blake2b(code, digest_size=_DIGEST).digest()


def _replace(path: Path, data: bytes) -> None:
    """Write to a temporary file, then rename, so that no reader sees half a file."""
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=".", suffix=_SUFFIX)  # mode 0600
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        os.replace(name, path)
    except OSError:
        Path(name).unlink(missing_ok=True)
        raise


def _private(base: Path) -> bool:
    """Whether a folder is the user's and nobody else may write in it; warns where not."""
    if sys.platform == "win32":
        return True
    status = base.stat()
    if status.st_uid == os.getuid() and not status.st_mode & 0o022:
        return True
    warnings.warn(
        _(
            "the cache folder {folder} belongs to another user or others may write in it, so compiled code "
            "is not cached; make it yours with mode 0700, or name another one in LINKWRIGHT_CACHE",
            folder=base,
        ),
        RuntimeWarning,
        stacklevel=2,
    )
    return False


def _remove_oldest(base: Path) -> None:
    files = [(path, path.stat()) for path in base.glob(f"*{_SUFFIX}")]
    total = sum(status.st_size for _, status in files)
    for path, status in sorted(files, key=lambda entry: entry[1].st_mtime):
        if total <= SIZE_LIMIT:
            return
        path.unlink(missing_ok=True)
        total -= status.st_size
