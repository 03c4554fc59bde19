"""What can be opened: files and drafts of the folder with their times, machines of the gallery."""

from __future__ import annotations

from contextlib import suppress
from functools import cache

from linkwright.core.data import Plain
from linkwright.errors import LinkwrightError
from linkwright.files.gallery_entries import entry
from linkwright.files.model_file import gallery_names
from linkwright.server.files import Files
from linkwright.server.outline import outline
from linkwright.words.message import in_language


def listing(files: Files, language: str) -> Plain:
    """Files and drafts with their times (ms), drafts with their number of links; titles in the gallery."""
    return {
        "files": saved(files),
        "drafts": [_draft(each) for each in files.drafts()],
        "gallery": list(gallery(language)),
    }


def saved(files: Files) -> list[Plain]:
    """Model files by their times, the newest first."""
    found = []
    for name in files.names():
        with suppress(OSError, LinkwrightError):
            found.append({"name": name, "time": files.path(name).stat().st_mtime_ns // 1_000_000})
    return sorted(found, key=lambda each: each["time"], reverse=True)


def _draft(draft: Plain) -> Plain:
    links = outline(draft["text"])["entries"].get("links")
    return {
        "name": draft["name"],
        "time": draft["time"],
        "saved": draft["saved"],
        "links": len(links) if isinstance(links, dict) else 0,
    }


@cache
def gallery(language: str) -> tuple[Plain, ...]:
    """Machines of the gallery by name, with title and purpose."""
    found = []
    for each in map(entry, gallery_names()):
        found.append(
            {"name": each["name"], **{key: in_language(each[key], language) for key in ("title", "purpose")}}
        )
    return tuple(found)
