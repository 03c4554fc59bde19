"""A studio at the address that browsers know it by, where that is free."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from linkwright.server.address import Address, recalled, remember
from linkwright.server.web import Studio


def started(folder: Path, name: str | None, *, port: int = 0, language: str = "en") -> Studio:
    """A studio of a folder at its port of last time, or at the one that is asked for; raises OSError."""
    known = recalled(folder)
    studio = None
    if known is not None and port in (0, known.port):
        with suppress(OSError):
            studio = Studio(folder, name, port=known.port, language=language, token=known.token)
    studio = studio or Studio(folder, name, port=port, language=language)
    remember(folder, Address(studio.server_port, studio.token))
    return studio
