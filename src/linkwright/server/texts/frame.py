"""Words of the bar at the top, the rail, menus and the line at the foot."""

from __future__ import annotations

from linkwright.words import Message, _

FRAME: dict[str, Message] = {"tools": _("Tools")}
