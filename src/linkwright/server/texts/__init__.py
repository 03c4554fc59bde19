"""The words of the studio's page, region by region."""

from __future__ import annotations

from linkwright.server.texts.dock import DOCK
from linkwright.server.texts.document import DOCUMENT
from linkwright.server.texts.frame import FRAME
from linkwright.server.texts.inspector import INSPECTOR
from linkwright.server.texts.loads import LOADS
from linkwright.server.texts.sheet import SHEET
from linkwright.server.texts.tools import TOOLS
from linkwright.words import Message

TEXTS: dict[str, Message] = {
    f"studio.{key}": text for key, text in (DOCUMENT | FRAME | SHEET | TOOLS | LOADS | INSPECTOR | DOCK).items()
}
