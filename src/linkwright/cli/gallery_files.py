"""The files of the gallery as ``gallery`` lists, prints and copies them."""

from __future__ import annotations

from rich.text import Text

from linkwright.cli.errors import UsageError
from linkwright.cli.session import Session
from linkwright.cli.usage import did_you_mean
from linkwright.words import _
from linkwright.words.sentence import LocalizedText, in_language

CALCULATIONS = _("Calculations of machine parts (linkwright beam, statics, vibration, …):")
TASKS = _("Tasks of synthesis (linkwright synthesize gallery:NAME):")
NEXT = _("linkwright gallery show NAME prints a file; linkwright solve gallery:NAME solves it.")
WHICH = _("gallery {action}: which one? give a name; linkwright gallery list shows all", code="gallery.which")
UNKNOWN = _('the gallery has no model "{name}"', code="gallery.unknown")


def show_list(part: str, session: Session) -> None:
    """Prints names and titles of the models, calculations and tasks whose names have a part."""
    from linkwright import gallery

    kinds = [
        [title_and_purpose(name) for name in names if part in name]
        for names in (gallery.names(), gallery.calculations(), gallery.tasks())
    ]
    if session.json:
        session.show_data([entry for entries in kinds for entry in entries])
        return
    wide = max((len(entry["name"]) for entries in kinds for entry in entries), default=0)
    for title, entries in zip((None, CALCULATIONS, TASKS), kinds, strict=True):
        if title and entries:
            session.show("", session.say(title))
        for entry in entries:
            text = in_language(entry["title"], session.language)
            session.show(Text.assemble((entry["name"].ljust(wide), "bold"), f"  {text}"))
    session.show("", session.say(NEXT))


def file_text(name: str | None, action: str) -> tuple[str, str]:
    """Name and text of a file; raises UsageError with the nearest name."""
    from linkwright import gallery

    if name is None:
        raise UsageError(WHICH.format(action=action))
    name = name.removeprefix("gallery:").removesuffix(".yaml")
    known = (*gallery.names(), *gallery.calculations(), *gallery.tasks())
    if name not in known:
        hint = _("see {command} --help", command="linkwright gallery")
        raise UsageError(did_you_mean(UNKNOWN.format(name=name), name, known, hint))
    return name, gallery.file(name).read_text(encoding="utf-8")


def title_and_purpose(name: str) -> dict[str, str]:
    """Title and purpose from the first lines of a gallery file, without reading the model."""
    from linkwright import gallery
    from linkwright.files.model_file import read_nodes
    from linkwright.files.reader import Reader

    first, _unused, _unused2 = gallery.file(name).read_text(encoding="utf-8").partition("\nsource:")
    root, _unused3 = read_nodes(first, name)
    assert root is not None
    given = Reader(name).free(root)
    return {"name": name, "title": LocalizedText(given["name"]), "purpose": LocalizedText(given["purpose"])}
