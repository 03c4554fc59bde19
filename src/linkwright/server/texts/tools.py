"""Names of tools, their steps and refusals."""

from __future__ import annotations

from linkwright.words import Message, _, pgettext

#: Every tool by its name in the source; its key is in the front end.
NAMES: dict[str, Message] = {
    "tool.move": pgettext("tool", "Move"),
    "tool.pivot": pgettext("tool", "Pivot"),
    "tool.link": _("Link"),
    "tool.plate": pgettext("tool", "Plate"),
    "tool.slider": _("Slider"),
    "tool.slot": _("Slot"),
    "tool.weld": _("Weld"),
    "tool.gears": _("Gears"),
    "tool.rack": _("Rack"),
    "tool.cam": pgettext("tool", "Cam"),
    "tool.drive": _("Drive"),
    "tool.force": pgettext("tool", "Force"),
    "tool.torque": pgettext("tool", "Torque"),
    "tool.spring": pgettext("tool", "Spring"),
    "tool.mass": pgettext("tool", "Mass"),
    "tool.dimension": pgettext("tool", "Dimension"),
    "tool.target": _("Target curve"),
    "tool.photo": _("Photo"),
    "tool.erase": _("Erase"),
}

TOOLS: dict[str, Message] = NAMES
