"""Words of the sheet: hints, snaps, selection, spoken elements, gaps."""

from __future__ import annotations

from linkwright.words import Message

SHEET: dict[str, Message] = {}
