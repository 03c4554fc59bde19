"""Names of files for parts, whatever the parts are called."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Mapping

#: Characters that a file system or a command line takes otherwise, and those that cannot be seen.
_UNSAFE = re.compile(r'[\x00-\x20\x7f-\x9f/\\:*?"<>|\u200b-\u200f\u2028-\u202e\u2066-\u2069\ufeff\ud800-\udfff]+')
#: Names that Windows keeps for devices.
_DEVICES = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\.|$)", re.IGNORECASE)
#: Most bytes of a name; file systems take 255, and an ending and a number come behind it.
_MOST = 120


def file_names(names: Iterable[str], taken: Iterable[str] = ()) -> Mapping[str, str]:
    """A name for the file of each part, without ending: its own as far as every file system takes it, letters of any
    script among them; with a number where two would be the same without regard to upper and lower case, or are
    ``taken``."""
    found: dict[str, str] = {}
    used = {each.casefold() for each in taken}
    for name in names:
        plain = _plain(name)
        number, own = 1, plain
        while own.casefold() in used:
            number += 1
            own = f"{plain}-{number}"
        used.add(own.casefold())
        found[name] = own
    return found


def _plain(name: str) -> str:
    text = _UNSAFE.sub("-", unicodedata.normalize("NFC", name)).strip("-. ")
    text = text.encode()[:_MOST].decode(errors="ignore").strip("-. ")
    if not text or _DEVICES.match(text):
        return f"part-{text}".strip("-")
    return text
