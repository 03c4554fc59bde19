"""Words of the inspector and its tabs."""

from __future__ import annotations

from linkwright.words import Message

INSPECTOR: dict[str, Message] = {}
