"""Words of the bar at the top, the rail, menus and the line at the foot."""

from __future__ import annotations

from linkwright.words import Message, _, pgettext

RAIL: dict[str, Message] = {
    "tools": _("Tools"),
    "rail.icons": _("Icons only"),
    "rail.names": _("Show names"),
    "variant.spring": pgettext("tool", "Spring"),
    "variant.damper": _("Damper"),
    "variant.gas_spring": _("Gas spring"),
    "variant.cylinder": _("Cylinder"),
    "variant.torsion_spring": _("Torsion spring"),
    "divider.inspector": _("Width of the inspector"),
    "divider.dock": _("Height of the curves"),
}

FRAME: dict[str, Message] = RAIL
