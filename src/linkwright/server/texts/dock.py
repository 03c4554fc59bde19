"""Words of the dock: time line, curves, sweep, synthesis, optimisation, comparison."""

from __future__ import annotations

from linkwright.words import Message

DOCK: dict[str, Message] = {}
