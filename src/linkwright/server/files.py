"""Model files below one folder, with drafts that survive a killed process and versions that distinguish windows."""

from __future__ import annotations

import hashlib
import json
import os
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from linkwright.core.data import Plain
from linkwright.errors import LinkwrightError
from linkwright.files.source import decode
from linkwright.filesystem import alone, atomic_write, below, make_folder
from linkwright.words import _
from linkwright.words.characters import UNFIT, printable
from linkwright.words.message import reason_of

_ENDINGS = (".yaml", ".yml", ".json")
_DRAFTS = ".linkwright"
#: Bytes of a text that is taken.
LARGEST = 1_000_000


class Files:
    """Reads and writes model files of a folder; every change is stored as a draft until it is saved.

    Windows and processes that share the folder see each other's changes: reading and writing are one step.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder.resolve()
        self._reserved: dict[str, str] = {}
        self._lock = threading.RLock()

    def path(self, name: str) -> Path:
        """The path of a file below the folder; raises LinkwrightError for any other."""
        path = below(self.folder, name)
        if path is None or path.suffix.lower() not in _ENDINGS or UNFIT.search(name) or "\n" in name:
            raise LinkwrightError(
                _(
                    "{name} is not a model file below the folder in which the studio was started",
                    code="studio.outside",
                    name=printable(name),
                )
            )
        return path

    def name(self, name: str) -> str:
        """The one name of a file, however it is written."""
        return self.path(name).relative_to(self.folder).as_posix()

    def disk(self, name: str) -> Plain:
        """A file's text and version as they are on the disk; no text and the version "" where there is none."""
        path = self.path(name)
        try:
            if path.is_dir():
                raise LinkwrightError(_('"{path}" is a folder; name a file', code="file.is_folder", path=name))
            if not path.is_file():
                return {"text": "", "version": ""}
            if path.stat().st_size > LARGEST:
                raise LinkwrightError(_("the text is larger than {most} bytes", code="studio.large", most=LARGEST))
            text = decode(path.read_bytes(), name)
        except OSError as problem:
            raise LinkwrightError(
                _("the file cannot be read ({reason})", code="model.unreadable", reason=reason_of(problem))
            ) from None
        return {"text": text, "version": _digest(text)}

    def names(self) -> list[str]:
        """Model files of the folder and those below, at most 500."""
        found = []
        for path in sorted(self.folder.rglob("*")):
            inner = path.relative_to(self.folder)
            hidden = any(part.startswith(".") for part in inner.parts)
            if not hidden and path.suffix.lower() in _ENDINGS and path.is_file():
                found.append(inner.as_posix())
            if len(found) == 500:
                break
        return found

    def open(self, name: str) -> Plain:
        """A file's text; a draft that is newer than what was saved comes first and is reported (``recovered``)."""
        name = self.name(name)
        found, draft = self.disk(name), self._draft(name)
        recovered = draft is not None and _plain(draft["text"]) != _plain(found["text"])
        shown = draft["text"] if draft is not None and recovered else found["text"]
        serial = 0 if draft is None else draft["serial"]
        return {**found, "name": name, "text": shown, "serial": serial, "recovered": recovered}

    def fresh(self, stem: str, window: str, *, numbered: bool = False) -> str:
        """A name that no file, no draft and no other window has; reserved for the window until it opens another.

        ``numbered``: with a number from the first one on.
        """
        with self._lock:
            self._reserved = {name: owner for name, owner in self._reserved.items() if owner != window}
            place = 1
            while self._taken(name := f"{stem}{place if place > 1 or numbered else ''}.yaml"):
                place += 1
            self._reserved[name] = window
            return name

    def unsaved(self) -> list[str]:
        """The names of drafts that were never saved as files, the newest first."""
        found = []
        for path in (self.folder / _DRAFTS).glob("*.json"):
            with suppress(OSError, ValueError, KeyError, TypeError, LinkwrightError):
                draft = self._draft(str(json.loads(path.read_bytes())["name"]))
                if draft is not None and not self.path(draft["name"]).exists():
                    found.append((draft["serial"], draft["name"]))
        return [name for _unused, name in sorted(found, reverse=True)]

    def drafts(self) -> list[Plain]:
        """Every draft that differs from its file, the newest first.

        ``time``: when it was stored, ms; ``saved``: whether the file is there.
        """
        found = []
        for path in (self.folder / _DRAFTS).glob("*.json"):
            with suppress(OSError, ValueError, KeyError, TypeError, LinkwrightError):
                name = str(json.loads(path.read_bytes())["name"])
                draft, there = self._draft(name), self.disk(name)
                if draft is not None and _plain(draft["text"]) != _plain(there["text"]):
                    time_ms = draft["serial"] // 1000
                    found.append(
                        {"name": name, "text": draft["text"], "time": time_ms, "saved": there["version"] != ""}
                    )
        return sorted(found, key=lambda each: each["time"], reverse=True)

    def rename(self, name: str, to: str, version: str) -> Plain:
        """Gives a file and its draft another name that nothing has; ``renamed``: whether it could."""
        source, target, name, to = self.path(name), self.path(to), self.name(name), self.name(to)
        with self._alone():
            there, draft = self.disk(name), self._draft(name)
            same = os.path.exists(source) and os.path.exists(target) and os.path.samefile(source, target)
            taken = self._draft(to) is not None or to in self._reserved or (os.path.exists(target) and not same)
            if taken or there["version"] != version:
                return {"renamed": False, "name": name, "version": version, "serial": 0}
            serial = 0
            if there["version"]:
                make_folder(target.parent)
                source.rename(target)
            if draft is not None:
                serial = self._store(to, draft["text"], draft["window"])
                self._draft_path(name).unlink(missing_ok=True)
            if name in self._reserved:
                self._reserved[to] = self._reserved.pop(name)
        return {"renamed": True, "name": to, "version": there["version"], "serial": serial}

    def discard(self, name: str) -> Plain:
        """Removes a draft; the file stays."""
        with self._alone():
            self._draft_path(self.name(name)).unlink(missing_ok=True)
        return {}

    def keep(self, name: str, text: str, window: str, serial: int) -> Plain:
        """Stores a draft; where another window has stored one since ``serial``, its text instead (``other``)."""
        _small(text)
        name = self.name(name)
        with self._alone():
            draft = self._draft(name)
            if draft is not None and draft["serial"] != serial and draft["window"] != window:
                return {"serial": draft["serial"], "other": draft["text"]}
            return {"serial": self._store(name, text, window), "other": None}

    def state(self, name: str, window: str) -> Plain:
        """Whether another window has changed the draft, and the version of the file on the disk."""
        version, draft = self.disk(name)["version"], self._draft(self.name(name))
        if draft is None:
            return {"serial": 0, "other": False, "version": version}
        return {"serial": draft["serial"], "other": draft["window"] not in ("", window), "version": version}

    def save(self, name: str, text: str, version: str, draft: str) -> Plain:
        """Writes the file, if what has its name is still what was there (``version``; "" for nothing at all).

        Under the name of another file than the open one, whose name is ``draft``, an unsaved drawing counts as well;
        one that is replaced gets a new name (``aside``). The ends of lines stay those of the file. Drafts of what is
        saved are done with, all others stay.
        """
        _small(text)
        path, name = self.path(name), self.name(name)
        with self._alone():
            there, hidden = self.disk(name), None
            if not draft or self.name(draft) != name:
                hidden = self._hidden(name, text, there["text"])
            known = there["version"] + ("" if hidden is None else f"+{_digest(hidden)}")
            if known != version:
                return {"saved": False, "version": known}
            aside = ""
            if hidden is not None:
                aside = self.fresh(name.removesuffix(path.suffix), "")
                self._store(aside, hidden, "")
                self._draft_path(name).unlink(missing_ok=True)
            if "\r\n" in there["text"]:
                text = _plain(text).replace("\n", "\r\n")
            make_folder(path.parent)
            atomic_write(path, text.encode())
            for each in {name, self.name(draft)} if draft else {name}:
                if self._hidden(each, text, text) is None:
                    with suppress(OSError):
                        self._draft_path(each).unlink(missing_ok=True)
        return {"saved": True, "name": name, "version": _digest(text), "aside": aside}

    @contextmanager
    def _alone(self) -> Iterator[None]:
        """Within it nobody else reads and writes drafts and files of the folder."""
        drafts = make_folder(self.folder / _DRAFTS)
        with self._lock, alone(drafts / "lock"):
            yield

    def _taken(self, name: str) -> bool:
        return os.path.exists(self.path(name)) or self._draft(name) is not None or name in self._reserved

    def _hidden(self, name: str, *shown: str) -> str | None:
        """The text of a draft that differs from all the shown ones."""
        draft = self._draft(name)
        if draft is None or _plain(draft["text"]) in map(_plain, shown):
            return None
        return str(draft["text"])

    def _store(self, name: str, text: str, window: str) -> int:
        """Writes a draft; gives its serial, which no draft of the name had before."""
        old, now = self._draft(name), time.time_ns() // 1000
        serial = now if old is None else max(now, old["serial"] + 1)
        found = {"name": name, "text": text, "window": window, "serial": serial}
        atomic_write(self._draft_path(name), json.dumps(found).encode())
        return serial

    def _draft_path(self, name: str) -> Path:
        return self.folder / _DRAFTS / f"{hashlib.sha256(name.encode()).hexdigest()[:24]}.json"

    def _draft(self, name: str) -> Plain | None:
        try:
            found: Plain = {"serial": 0, "window": "", **json.loads(self._draft_path(name).read_bytes())}
        except (OSError, ValueError, TypeError):
            return None
        fits = found.get("name") == name and isinstance(found.get("text"), str)
        return found if fits and isinstance(found["serial"], int) else None


def _plain(text: str) -> str:
    return text.replace("\r\n", "\n")


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:24]


def _small(text: str) -> None:
    if len(text.encode()) > LARGEST:
        raise LinkwrightError(_("the text is larger than {most} bytes", code="studio.large", most=LARGEST))
