"""The cover of a report: what the settings say of it, with the words of its rows."""

from __future__ import annotations

from linkwright.reports.document import Cover, Document
from linkwright.reports.settings import COVER_ROWS, Settings
from linkwright.words import _


def cover(own: Settings, document: Document) -> Cover | None:
    """The page before all others, None where the file asks for none."""
    words, say = own.cover, document.say
    if words is None:
        return None
    rows = [(say(COVER_ROWS[key]), value) for key, value in words.rows]
    above = tuple(filter(None, (words.school, own.course)))
    return Cover(
        words.kind or say(_("Course design report")),
        document.title,
        above,
        (*rows, *words.fields),
        words.date,
        words.logo,
    )
