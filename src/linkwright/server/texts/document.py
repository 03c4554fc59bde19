"""Words of the open file, and of searches for machines."""

from __future__ import annotations

from linkwright.words import Message, _, pgettext

DOCUMENT: dict[str, Message] = {
    "large": _("the text is larger than {most} bytes"),
    "text": _("Model file"),
    "new": _("New"),
    "open": _("Open"),
    "gallery": _("Gallery"),
    "save": _("Save"),
    "saved": _("Saved."),
    "recovered": _("What was not saved last time is here again."),
    "elsewhere": _("Another window has changed this file."),
    "take_theirs": _("Take its text"),
    "keep_mine": _("Keep mine"),
    "typed_meanwhile": _(
        "The text was changed while that of the disk came, and is saved; load the disk's again "
        "to put it in its place."
    ),
    "there_already": _(
        "{name} is there already, as a file or as an unsaved drawing; save under another name, or overwrite it."
    ),
    "overwrite": _("Overwrite"),
    "mobility": _("mobility {value}"),
    "fine": _("No findings."),
    "gone": _("The server does not answer; changes remain in this window until it does."),
    "making": _("The file is being made …"),
    "add_dimension": _("Add a dimension …"),
    "range_of": _("Range of {name}"),
    "number_name": _("Name of the number"),
    "demand_text": _("Demand"),
    "forget": pgettext("studio", "Forget {name}"),
    "design": _("Design {number}"),
    "missed": _("misses {names}"),
    "take_design": _("Take these dimensions"),
    "semicolon": _("; "),
    "set_aside": _("Saved. The unsaved drawing that was called {name} is now {aside}."),
}
