"""Names of tools, their steps and refusals."""

from __future__ import annotations

from linkwright.words import Message

TOOLS: dict[str, Message] = {}
