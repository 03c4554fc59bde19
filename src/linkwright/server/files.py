"""Model files below one folder, with drafts that survive a killed process and versions that tell windows apart."""

from __future__ import annotations

import hashlib
import json
import threading
from contextlib import suppress
from pathlib import Path

from linkwright.core.json_data import Plain
from linkwright.errors import LinkwrightError
from linkwright.files.source import decode
from linkwright.whole_files import make_folder, write_whole
from linkwright.words.sentence import reason_of

_ENDINGS = (".yaml", ".yml", ".json")
_DRAFTS = ".linkwright"
#: Bytes of a text that is taken.
LARGEST = 1_000_000


class Files:
    """Reads and writes model files of a folder; every change is kept as a draft until it is saved."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder.resolve()
        self._serial: dict[str, tuple[int, str]] = {}
        self._lock = threading.Lock()

    def path(self, name: str) -> Path:
        """The path of a file below the folder; raises LinkwrightError for any other."""
        path = self.folder
        with suppress(OSError, RuntimeError):  # links that lead in a circle
            path = (self.folder / name).resolve()
        if not path.is_relative_to(self.folder) or path.suffix.lower() not in _ENDINGS or "\0" in name:
            raise LinkwrightError("studio.outside", name=name)
        if any(part.startswith(".") for part in path.relative_to(self.folder).parts):
            raise LinkwrightError("studio.outside", name=name)
        return path

    def disk(self, name: str) -> Plain:
        """A file's text and version as they are on the disk; no text and the version "" where there is none."""
        path = self.path(name)
        try:
            if path.is_dir():
                raise LinkwrightError("file.is_folder", path=name)
            if not path.is_file():
                return {"text": "", "version": ""}
            if path.stat().st_size > LARGEST:
                raise LinkwrightError("studio.large", most=LARGEST)
            text = decode(path.read_bytes(), name)
        except OSError as problem:
            raise LinkwrightError("model.unreadable", reason=reason_of(problem)) from None
        return {"text": text, "version": hashlib.sha256(text.encode()).hexdigest()[:24]}

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
        """A file's text; a draft that is newer than what was saved comes first and is said (``recovered``)."""
        found = self.disk(name)
        draft = self._draft(name)
        recovered = draft is not None and _plain(draft["text"]) != _plain(found["text"])
        serial, _ = self._serial.get(name, (0, ""))
        shown = draft["text"] if draft is not None and recovered else found["text"]
        return {**found, "name": name, "text": shown, "serial": serial, "recovered": recovered}

    def fresh(self, stem: str) -> str:
        """A name that no file and no draft has."""
        place = 1
        while True:
            name = f"{stem}{place if place > 1 else ''}.yaml"
            if not (self.folder / name).exists() and self._draft(name) is None:
                return name
            place += 1

    def unsaved(self) -> str | None:
        """The name of the newest draft that was never saved as a file."""
        drafts = (self.folder / _DRAFTS).glob("*.json")
        for path in sorted(drafts, key=lambda each: each.stat().st_mtime, reverse=True):
            try:
                name = json.loads(path.read_bytes())["name"]
                if not self.path(name).exists():
                    return str(name)
            except (OSError, ValueError, KeyError, TypeError, LinkwrightError):
                continue
        return None

    def keep(self, name: str, text: str, window: str, serial: int) -> Plain:
        """Keeps a draft; where another window has kept one since ``serial``, its text instead (``other``)."""
        _small(text)
        self.path(name)
        with self._lock:
            known, writer = self._serial.get(name, (0, ""))
            if known != serial and writer != window:
                draft = self._draft(name)
                return {"serial": known, "other": draft["text"] if draft else None}
            self._serial[name] = (known + 1, window)
            make_folder(self.folder / _DRAFTS)
            write_whole(self._draft_path(name), json.dumps({"name": name, "text": text}).encode())
        return {"serial": known + 1, "other": None}

    def state(self, name: str, window: str) -> Plain:
        """Whether another window has changed the draft, and the version of the file on the disk."""
        version = self.disk(name)["version"]
        serial, writer = self._serial.get(name, (0, ""))
        return {"serial": serial, "other": writer not in ("", window), "version": version}

    def save(self, name: str, text: str, version: str, draft: str) -> Plain:
        """Writes the file, if it is still the one that was opened (``version``; "" for one that is not there yet).

        The ends of lines stay those of the file. Its draft, and the one that the text was kept in under another name
        (``draft``), are done with.
        """
        _small(text)
        path = self.path(name)
        there = self.disk(name)
        if there["version"] != version:
            return {"saved": False, "version": there["version"]}
        if "\r\n" in there["text"]:
            text = _plain(text).replace("\n", "\r\n")
        make_folder(path.parent)
        write_whole(path, text.encode())
        for each in (name, draft):
            with suppress(OSError):
                self._draft_path(each).unlink(missing_ok=True)
        serial, _ = self._serial.get(name, (0, ""))
        return {"saved": True, "version": self.disk(name)["version"], "serial": serial}

    def _draft_path(self, name: str) -> Path:
        return self.folder / _DRAFTS / f"{hashlib.sha256(name.encode()).hexdigest()[:24]}.json"

    def _draft(self, name: str) -> Plain | None:
        try:
            found: Plain = json.loads(self._draft_path(name).read_bytes())
        except (OSError, ValueError):
            return None
        return found if found.get("name") == name and isinstance(found.get("text"), str) else None


def _plain(text: str) -> str:
    return text.replace("\r\n", "\n")


def _small(text: str) -> None:
    if len(text.encode()) > LARGEST:
        raise LinkwrightError("studio.large", most=LARGEST)
