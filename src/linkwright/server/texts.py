"""Texts of the studio by the keys under which its page asks for them."""

from __future__ import annotations

from linkwright.words import _, pgettext

TEXTS = {
    "studio.large": _("the text is larger than {most} bytes"),
    "studio.text": _("Model file"),
    "studio.new": _("New"),
    "studio.open": _("Open"),
    "studio.gallery": _("Gallery"),
    "studio.save": _("Save"),
    "studio.name": _("File name"),
    "studio.saved": _("Saved."),
    "studio.unsaved": _("Not saved; stored as a draft."),
    "studio.recovered": _("What was not saved last time is here again."),
    "studio.elsewhere": _("Another window has changed this file."),
    "studio.take_theirs": _("Take its text"),
    "studio.keep_mine": _("Keep mine"),
    "studio.on_disk": _(
        "The file on the disk has changed since it was opened; save under another name, or overwrite it."
    ),
    "studio.typed_meanwhile": _(
        "The text was changed while that of the disk came, and is kept; take the disk's again to put it in its place."
    ),
    "studio.there_already": _(
        "{name} is there already, as a file or as an unsaved drawing; save under another name, or overwrite it."
    ),
    "studio.overwrite": _("Overwrite"),
    "studio.draw": _("Draw"),
    "studio.run": _("Run"),
    "studio.select": _("Move"),
    "studio.fixed": _("Fixed point"),
    "studio.link": _("Link"),
    "studio.driver": _("Drive"),
    "studio.guide": _("Slide"),
    "studio.mass": pgettext("studio", "Mass"),
    "studio.load": _("Load"),
    "studio.remove": _("Remove"),
    "studio.grid": _("Grid"),
    "studio.help_select": _("Drag a point; a click on a load chooses it."),
    "studio.help_fixed": _("Click where the frame has a pivot."),
    "studio.help_link": _(
        "Click two or more points, existing or new; Enter or the last point again ends, Escape drops it."
    ),
    "studio.help_driver": _("Click a link that has a fixed point: it is driven about it."),
    "studio.help_guide": _("Click a point of a link, then where its guide leads."),
    "studio.help_mass": _("Click a link; it gets the mass {value} and the moment of inertia of an even bar."),
    "studio.help_load": _(
        "Click a link near one of its points, then where the force {value} points; a second "
        "click on the point takes the next link of its pin."
    ),
    "studio.help_remove": _("Click a link, a load, or a pin: the links of a pin come apart."),
    "studio.mobility": _("mobility {value}"),
    "studio.findings": _("Findings"),
    "studio.fine": _("No findings."),
    "studio.line": _("line {line}"),
    "studio.gone": _("The server does not answer; changes remain in this window until it does."),
    "studio.paper": _("Drawing paper"),
    "studio.placed": _("{name} is where its lengths put it; change them in the text, or drag it under Run."),
    "studio.value": _("Value"),
    "studio.slot": _("Slot"),
    "studio.gear": _("Gears"),
    "studio.curve": _("Target curve"),
    "studio.photo": _("Photo"),
    "studio.help_slot": _("Click the slotted link, then the point that slides in it."),
    "studio.help_gear": _("Click two links with fixed points: they mesh, with {value} teeth."),
    "studio.help_curve": _(
        "Draw a curve with the pointer: linkages that draw it are searched for at once. It "
        "is closed where it ends near its beginning."
    ),
    "studio.help_photo": _(
        "Choose a picture; then click two points of it that are {value} apart, and it is to scale."
    ),
    "studio.choose_photo": _("Choose a picture"),
    "studio.without_photo": _("Without the picture"),
    "studio.candidates": _("Linkages for the curve"),
    "studio.searching": _("Searching …"),
    "studio.enough": _("Enough"),
    "studio.candidate": _("{links} links: at most {error} off, transmission angle at least {angle}"),
    "studio.take": _("Report and export"),
    "studio.take_report": _("Report"),
    "studio.making": _("The file is being made …"),
    "studio.cam": pgettext("studio", "Cam"),
    "studio.rack": _("Rack"),
    "studio.help_cam": _(
        "Click the link that turns as a cam, then a point of a link that slides or turns on "
        "the frame: a roller there is lifted by {value}. The base circle goes where the "
        "roller is."
    ),
    "studio.help_rack": _(
        "Click a link with a fixed point, then a link that slides: they mesh as pinion and "
        "rack, with the pinion as large as it is drawn."
    ),
    "studio.optimize": _("Optimise"),
    "studio.vary": _("What varies"),
    "studio.goals": _("What is minimized or maximized"),
    "studio.demands": _("Demands"),
    "studio.least": _("least"),
    "studio.most": _("greatest"),
    "studio.add_dimension": _("Add a dimension …"),
    "studio.add_goal": _("Add a number"),
    "studio.add_demand": _("Add a demand"),
    "studio.range_of": _("Range of {name}"),
    "studio.number_name": _("Name of the number"),
    "studio.demand_text": _("Demand"),
    "studio.forget": pgettext("studio", "Forget {name}"),
    "studio.begin": _("Begin"),
    "studio.tried": _("{done} of at most {most} machines tried"),
    "studio.design": _("Design {number}"),
    "studio.missed": _("misses {names}"),
    "studio.take_design": _("Take these dimensions"),
    "studio.help_optimize": _(
        "Choose dimensions with their ranges and a number; the file keeps the settings. "
        "Every design passes the full cycle in the assembly of the present one. The pointer "
        "over a design shows its paths; taking one writes its dimensions into the file."
    ),
    "studio.beside": _("Compare with …"),
    "studio.without_beside": _("End the comparison"),
    "studio.semicolon": _("; "),
    "studio.finding": _("{name}: {sentence}"),
    "studio.cannot_run": _("It cannot run yet: {reason}."),
    "studio.no_machine": _("the text makes no machine that moves"),
    "studio.set_aside": _("Saved. The unsaved drawing that was called {name} is now {aside}."),
    "studio.never_saved": _("{name} (not saved yet)"),
    "studio.loads": _("Loads"),
    "studio.load_is": _("{name}: {size} on {on}"),
    "studio.remove_load": _("Remove {name}"),
    "studio.load_chosen": _("{name}: {size} on {on} {at}. Delete removes it; its values stand in the text."),
    "studio.no_drive": _("{link} has no fixed point about which it could be driven."),
    "studio.no_link_there": _("No link has the point {point}; draw one first."),
    "studio.no_length_given": _("{text} is not a length; write it as 100 mm."),
    "studio.demand_hint": _("at least 40 deg"),
}
