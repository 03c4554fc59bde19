"""Words of the page."""

from __future__ import annotations

from linkwright.words import _, pgettext

STUDIO = {
    "large": _("the text is larger than {most} bytes"),
    "text": _("Model file"),
    "new": _("New"),
    "open": _("Open"),
    "gallery": _("Gallery"),
    "save": _("Save"),
    "name": _("File name"),
    "saved": _("Saved."),
    "unsaved": _("Not saved; stored as a draft."),
    "recovered": _("What was not saved last time is here again."),
    "elsewhere": _("Another window has changed this file."),
    "take_theirs": _("Take its text"),
    "keep_mine": _("Keep mine"),
    "on_disk": _("The file on the disk has changed since it was opened; save under another name, or overwrite it."),
    "typed_meanwhile": _(
        "The text was changed while that of the disk came, and is saved; load the disk's again "
        "to put it in its place."
    ),
    "there_already": _(
        "{name} is there already, as a file or as an unsaved drawing; save under another name, or overwrite it."
    ),
    "overwrite": _("Overwrite"),
    "draw": _("Draw"),
    "run": _("Run"),
    "select": _("Move"),
    "fixed": _("Fixed point"),
    "link": _("Link"),
    "driver": _("Drive"),
    "guide": _("Slide"),
    "mass": pgettext("studio", "Mass"),
    "load": _("Load"),
    "remove": _("Remove"),
    "grid": _("Grid"),
    "help_select": _("Drag a point; a click on a load chooses it."),
    "help_fixed": _("Click where the frame has a pivot."),
    "help_link": _("Click two or more points, existing or new; Enter or the last point again ends, Escape drops it."),
    "help_driver": _("Click a link that has a fixed point: it is driven about it."),
    "help_guide": _("Click a point of a link, then where its guide leads."),
    "help_mass": _("Click a link; it gets the mass {value} and the moment of inertia of an even bar."),
    "help_load": _(
        "Click a link near one of its points, then where the force {value} points; a second "
        "click on the point takes the next link of its pin."
    ),
    "help_remove": _("Click a link, a load, or a pin: the links of a pin come apart."),
    "mobility": _("mobility {value}"),
    "findings": _("Findings"),
    "fine": _("No findings."),
    "line": _("line {line}"),
    "gone": _("The server does not answer; changes remain in this window until it does."),
    "paper": _("Drawing paper"),
    "placed": _("{name} is where its lengths put it; change them in the text, or drag it under Run."),
    "value": _("Value"),
    "slot": _("Slot"),
    "gear": _("Gears"),
    "curve": _("Target curve"),
    "photo": _("Photo"),
    "help_slot": _("Click the slotted link, then the point that slides in it."),
    "help_gear": _("Click two links with fixed points: they mesh, with {value} teeth."),
    "help_curve": _(
        "Draw a curve with the pointer: linkages that draw it are searched for at once. It "
        "is closed where it ends near its beginning."
    ),
    "help_photo": _("Choose a picture; then click two points of it that are {value} apart, and it is to scale."),
    "choose_photo": _("Choose a picture"),
    "without_photo": _("Without the picture"),
    "candidates": _("Linkages for the curve"),
    "searching": _("Searching …"),
    "enough": _("Enough"),
    "candidate": _("{links} links: at most {error} off, transmission angle at least {angle}"),
    "take": _("Report and export"),
    "take_report": _("Report"),
    "making": _("The file is being made …"),
    "cam": pgettext("studio", "Cam"),
    "rack": _("Rack"),
    "help_cam": _(
        "Click the link that turns as a cam, then a point of a link that slides or turns on "
        "the frame: a roller there is lifted by {value}. The base circle goes where the "
        "roller is."
    ),
    "help_rack": _(
        "Click a link with a fixed point, then a link that slides: they mesh as pinion and "
        "rack, with the pinion as large as it is drawn."
    ),
    "optimize": _("Optimise"),
    "vary": _("What varies"),
    "goals": _("What is minimized or maximized"),
    "demands": _("Demands"),
    "least": _("minimum"),
    "most": _("maximum"),
    "add_dimension": _("Add a dimension …"),
    "add_goal": _("Add a number"),
    "add_demand": _("Add a demand"),
    "range_of": _("Range of {name}"),
    "number_name": _("Name of the number"),
    "demand_text": _("Demand"),
    "forget": pgettext("studio", "Forget {name}"),
    "begin": _("Begin"),
    "tried": _("{done} of at most {most} machines tried"),
    "design": _("Design {number}"),
    "missed": _("misses {names}"),
    "take_design": _("Take these dimensions"),
    "help_optimize": _(
        "Choose dimensions with their ranges and a number; the file keeps the settings. "
        "Every design passes the full cycle in the assembly of the present one. The pointer "
        "over a design shows its paths; taking one writes its dimensions into the file."
    ),
    "beside": _("Compare with …"),
    "without_beside": _("End the comparison"),
    "semicolon": _("; "),
    "finding": _("{name}: {sentence}"),
    "cannot_run": _("It cannot run yet: {reason}."),
    "no_machine": _("the text makes no machine that moves"),
    "set_aside": _("Saved. The unsaved drawing that was called {name} is now {aside}."),
    "never_saved": _("{name} (not saved yet)"),
    "loads": _("Loads"),
    "load_is": _("{name}: {size} on {on}"),
    "remove_load": _("Remove {name}"),
    "load_chosen": _("{name}: {size} on {on} {at}. Delete removes it; its values stand in the text."),
    "no_drive": _("{link} has no fixed point about which it could be driven."),
    "no_link_there": _("No link has the point {point}; draw one first."),
    "no_length_given": _("{text} is not a length; write it as 100 mm."),
    "demand_hint": _("at least 40 deg"),
}
