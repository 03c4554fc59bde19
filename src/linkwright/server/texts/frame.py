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

BAR: dict[str, Message] = {
    "state.new": _("Not yet saved"),
    "state.kept": _("Draft kept {time}"),
    "state.saved": pgettext("file", "Saved"),
    "state.gone": _("Not kept: no server"),
    "when.today": _("today {time}"),
    "when.yesterday": _("yesterday {time}"),
    "theme": _("Light or dark"),
    "theme.light": pgettext("theme", "Light"),
    "theme.dark": pgettext("theme", "Dark"),
    "theme.system": _("As the system has it"),
}

FOOT: dict[str, Message] = {
    "status.empty": _("Empty sheet"),
    "snap": _("Snap"),
    "snap.help": _("Snap to joints, links, directions and the grid; hold Alt to pass over"),
    "grid.spacing": _("Spacing of the grid"),
    "grid.now": _("Grid {value}"),
    "grid.auto": _("by zoom"),
    "grid.by_zoom": _("By the zoom"),
    "grid.hide": _("Hide the grid"),
    "grid.show": _("Show the grid"),
    "unit": _("Unit of lengths"),
    "unit.now": _("Unit of lengths: {unit}"),
    "unit.mm": _("Millimetres"),
    "unit.cm": _("Centimetres"),
    "unit.m": _("Metres"),
    "unit.in": _("Inches"),
    "zoom": pgettext("sheet", "Zoom"),
    "zoom.in": _("Zoom in"),
    "zoom.out": _("Zoom out"),
    "zoom.full": _("Zoom to 100 %"),
    "zoom.fit": _("Fit all"),
}

FRAME: dict[str, Message] = RAIL | BAR | FOOT
