"""Finished parts of long work in a file, from which the same work goes on after an interruption."""

from __future__ import annotations

import base64
import hashlib
import json
import math
import re
import sqlite3
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from itertools import count
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from linkwright.core import VERSION
from linkwright.core.progress import Progress, current_progress, reporting
from linkwright.errors import RequestError
from linkwright.filesystem import refuse_target, write_new
from linkwright.words import Message, _

T = TypeVar("T")
#: Shortest time between two writes to the file, s.
WRITTEN = 0.5
#: Largest result that is stored, in bytes per second of its computation: others are computed faster than read.
MAX_BYTES_PER_SECOND = 1e7
_current: ContextVar[Checkpoints | None] = ContextVar("checkpoints", default=None)


RESUME = _("Interrupted; run the same command with --state {path} to go on.", code="study.interrupted")


class Interrupted(KeyboardInterrupt):
    """Work was interrupted; ``state`` is the file from which it goes on."""

    def __init__(self, state: Path) -> None:
        super().__init__(str(RESUME.format(path=state)))
        self.state = state

    def __reduce__(self) -> tuple[type[Interrupted], tuple[Path]]:
        return Interrupted, (self.state,)


@contextmanager
def checkpointing(
    path: str | Path | None, name: str = "linkwright", *asked: object, progress: Progress | None = None
) -> Iterator[None]:
    """Context in which studies, tolerance runs and syntheses store finished parts in a file and resume from it.

    Stored parts are not computed again, and the results are equal bit for bit. A search with a time limit stores its
    population and the time spent. :func:`linkwright.optimize` has its own option, ``state``.

    Args:
        path: the file; None: a file named after ``name`` in the working directory, written on interruption only.
        asked: what identifies the task, such as the model's text and the ranges; a file of another task is refused.
            Without it several tasks can share a file.
        progress: as in :func:`reporting`.

    Raises:
        Interrupted: a KeyboardInterrupt with the file of all finished parts.
        RequestError: the file belongs to another task, or cannot be read or written.
    """
    checkpoints = Checkpoints(None if path is None else Path(path), name, identity(VERSION, *asked))
    token = _current.set(checkpoints)
    try:
        with reporting(progress or current_progress()):
            yield
    except KeyboardInterrupt:
        raise Interrupted(checkpoints.left()) from None
    finally:
        _current.reset(token)
        checkpoints.close()


def checkpointed(work: Callable[[], T], key: Callable[[], tuple[object, ...]]) -> T:
    """Result of ``work()``: read from the surrounding ``checkpointing`` if stored there, else computed and stored.

    ``key`` returns everything that the result depends on. Numbers, texts, arrays, tuples, lists and mappings of
    these are stored; other results, and those that take longer to read than to compute, are computed every time.
    """
    checkpoints = _current.get()
    if checkpoints is None:
        return work()
    name = identity(*key())
    found = checkpoints.part(name)
    if found is not None:
        return found[0]  # type: ignore[no-any-return]
    begun = time.perf_counter()
    made = work()
    checkpoints.add(name, made, time.perf_counter() - begun)
    return made


def current_checkpoints() -> Checkpoints | None:
    """Checkpoints of the surrounding ``checkpointing``; None outside of one."""
    return _current.get()


def identity(*things: object) -> str:
    """A digest of values and arrays, the same in every process."""
    digest = hashlib.blake2b(digest_size=16)
    for each in things:
        if isinstance(each, Mapping):
            digest.update(identity(*(part for pair in each.items() for part in pair)).encode())
        elif isinstance(each, np.ndarray):
            digest.update(f"{each.dtype.str}{each.shape}".encode() + each.tobytes())
        else:
            digest.update(repr(each).encode())
        digest.update(b"\0")
    return digest.hexdigest()


class Checkpoints:
    """Finished parts by key in an SQLite database, in memory while no file is named."""

    def __init__(self, path: Path | None, name: str, digest: str) -> None:
        self.path, self.name, self.written = path, name, time.monotonic()
        self._unwritten: dict[str, str] = {}
        if path is not None:
            refuse_target(path)
        try:
            self.parts = sqlite3.connect(":memory:" if path is None else path)
            self.parts.execute("create table if not exists parts (key text primary key, content text)")
            self.parts.execute("insert or ignore into parts values ('work', ?)", (digest,))
            self.parts.commit()
            found = self._content("work")
        except (sqlite3.Error, OSError, ValueError) as problem:
            raise self._bad(problem) from None
        if found != digest:
            self.parts.close()
            raise RequestError(
                _(
                    'the state "{path}" belongs to another problem; name another file, or remove it',
                    code="optimize.other_state",
                    path=path,
                )
            )

    def part(self, key: str) -> tuple[Any] | None:
        """The part stored under a key, in a tuple of one; None: not stored."""
        try:
            content = self._content(key)
            return None if content is None else (_made(json.loads(content)),)
        except (sqlite3.Error, ValueError, KeyError, TypeError, AttributeError, RecursionError) as problem:
            raise self._bad(problem) from None

    def resumed(self, key: str, make: Callable[[Any], T]) -> T | None:
        """``make(part)`` of the part stored under a key; None: not stored."""
        there = self.part(key)
        try:
            return None if there is None else make(there[0])
        except (ValueError, KeyError, TypeError, IndexError) as problem:
            raise self._bad(problem) from None

    def add(self, key: str, found: Any, seconds: float = math.inf) -> None:
        """Stores a result computed in so many seconds, replacing an earlier one."""
        if seconds < math.inf and _bytes(found) > MAX_BYTES_PER_SECOND * seconds:
            return
        try:
            content = json.dumps(_plain(found))
        except TypeError:
            return
        self._unwritten[key] = content
        if time.monotonic() - self.written > WRITTEN:
            self._write()

    def left(self) -> Path:
        """Writes all parts; returns the file."""
        self._write()
        if self.path is None:
            stem = re.sub(r"[^\w-]+", "_", self.name).strip("_") or "machine"
            names = (Path(f"{stem}{'' if k == 1 else f'_{k}'}.state") for k in count(1))
            self.path = write_new(names, self.parts.serialize())
        return self.path

    def close(self) -> None:
        """Writes pending parts and closes the database."""
        self._write()
        self.parts.close()

    def _write(self) -> None:
        """Writes pending parts in one short transaction, so that processes sharing the file hardly wait."""
        try:
            with self.parts:
                self.parts.executemany("insert or replace into parts values (?, ?)", self._unwritten.items())
        except sqlite3.Error as problem:
            raise self._bad(problem) from None
        self._unwritten.clear()
        self.written = time.monotonic()

    def _content(self, key: str) -> str | None:
        if key in self._unwritten:
            return self._unwritten[key]
        row = self.parts.execute("select content from parts where key = ?", (key,)).fetchone()
        return None if row is None else str(row[0])

    def _bad(self, problem: Exception) -> RequestError:
        return RequestError(
            _(
                'the state "{path}" cannot be used ({reason}); name another file, or remove it',
                code="study.bad_state",
                path=self.path,
                reason=str(problem)[:200],
            )
        )


def _bytes(value: Any) -> int:
    """Size of the arrays of a part, bytes."""
    if isinstance(value, np.ndarray):
        return value.nbytes
    items = value.values() if isinstance(value, Mapping) else value if isinstance(value, tuple | list) else ()
    return sum(map(_bytes, items))


def _plain(value: Any) -> Any:
    """A value as JSON; TypeError where there is no such form."""
    if value is None or type(value) in (bool, int, float, str):
        return value
    if isinstance(value, np.number | np.bool_):
        return _plain(value.item())
    if isinstance(value, Message):
        (text, values), about = value.__getnewargs_ex__()
        return {"message": text, "values": _plain(values), "about": about}
    if isinstance(value, np.ndarray) and not value.dtype.hasobject:
        data = base64.b64encode(np.ascontiguousarray(value).tobytes()).decode()
        return {"array": value.dtype.str, "shape": value.shape, "data": data}
    if isinstance(value, Mapping):
        return {"pairs": [[_plain(key), _plain(each)] for key, each in value.items()]}
    if type(value) in (tuple, list):
        return {type(value).__name__: [_plain(each) for each in value]}
    raise TypeError(type(value))


def _made(plain: Any) -> Any:
    """The value of its JSON form."""
    if not isinstance(plain, dict):
        return plain
    if "message" in plain:
        return Message(plain["message"], _made(plain["values"]), **plain["about"])
    if "array" in plain:
        data = np.frombuffer(base64.b64decode(plain["data"]), np.dtype(plain["array"]))
        return data.reshape(plain["shape"]).copy()
    if "pairs" in plain:
        return {_made(key): _made(each) for key, each in plain["pairs"]}
    ((kind, items),) = plain.items()
    return {"tuple": tuple, "list": list}[kind](map(_made, items))
