"""Words of the sheet: hints, snaps, selection, spoken elements, gaps."""

from __future__ import annotations

from linkwright.words import Message, _, pgettext

SHEET: dict[str, Message] = {
    "sheet.label": _("Sheet: the drawing of the mechanism"),
    "sheet.keys": _(
        "Enter starts a cross at the middle, arrows move it by the grid, Enter clicks; "
        "brackets go from joint to joint and from link to link."
    ),
    "sheet.cross": _("Cross at the middle of the sheet"),
    "sheet.move_step": _("Drag a joint or a link. Click selects, [Shift] adds, [Del] removes"),
    "sheet.erase_step": _("Click what is to go, or drag over it"),
    "sheet.pivot_named": _("Pivot {name}"),
    "sheet.joint_named": _("Joint {name}"),
    "sheet.point_named": _("Point {name}"),
    "sheet.point_spoken": _("{name}, at {x}, {y}"),
    "sheet.link_spoken": _("{name}, link from {from} to {to}, {length}"),
    "sheet.plate_spoken": _("{name}, link with {points}"),
    "sheet.snap_as_long": _("As long as {name}"),
    "sheet.snap_on_link": _("On {name}"),
    "sheet.snap_horizontal": _("Horizontal"),
    "sheet.snap_vertical": _("Vertical"),
    "sheet.snap_square_to": _("Square to {name}"),
    "sheet.snap_parallel_to": _("Parallel to {name}"),
    "sheet.snap_kept": _("Direction held, {angle}"),
    "sheet.gap_reach": _("reach of {link}"),
    "sheet.gap_aside": _("Put aside"),
    "sheet.room_go": _("Show this position"),
    "sheet.room_free": _("No two parts that move against each other share a layer"),
    "sheet.set": pgettext("value", "Set"),
    "sheet.key_next": pgettext("key", "next"),
    "sheet.key_set": pgettext("key", "set"),
    "sheet.key_no_snap": pgettext("key", "no snap"),
    "sheet.unreadable": _("{text} cannot be read here; type a number, with a unit if it is another one"),
    "sheet.menu_duplicate": _("Duplicate"),
    "sheet.menu_mirror": pgettext("menu", "Mirror"),
    "sheet.menu_copy": pgettext("menu", "Copy"),
    "sheet.menu_cut": pgettext("menu", "Cut"),
    "sheet.menu_paste": pgettext("menu", "Paste"),
    "sheet.menu_nothing_copied": _("Nothing has been copied yet"),
    "sheet.menu_delete": pgettext("menu", "Delete"),
    "sheet.menu_all": _("Select all"),
    "sheet.menu_fit": _("Fit the drawing into the sheet"),
    "sheet.menu_fix": _("Fix to the frame"),
    "sheet.menu_free": _("Free from the frame"),
    "sheet.menu_weld": _("Weld the links here"),
    "sheet.menu_pin": _("Let the links turn here"),
    "sheet.menu_drive": _("Drive this link"),
    "sheet.menu_split": _("Split here"),
    "sheet.menu_point": _("Add a point here"),
}
